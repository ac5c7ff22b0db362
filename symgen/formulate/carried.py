"""What the frames of bodies are made of: coordinates of their own, or those of a tree of joints."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

from symgen.describe.mechanism import SpatialBody
from symgen.formulate.equations import DriverPower, MassBlock
from symgen.vocabulary.measures import Measure

if TYPE_CHECKING:
    from symgen.formulate.measures import ModelNodes
    from symgen.formulate.of_time import Coordinate


class TreeBodies(Protocol):
    """Bodies on a tree of joints.

    Rows and forces of a mechanism are derived over the velocities of bodies: of a point of each, and its angular
    velocity. Here these follow from the velocities of the state: u = B v + b, with derivative B v' + c.

    Attributes
    ----------
    size : int
        Number of velocities of the state.
    velocities, biases : tuple of int
        u, and c; one node for each velocity of a body.
    q_rates : tuple of int
        q' of the state.
    spins : tuple of (int, int)
        Where Euler parameters begin in q, and their angular velocities in v.
    """

    size: int
    velocities: tuple[int, ...]
    biases: tuple[int, ...]
    q_rates: tuple[int, ...]
    spins: tuple[tuple[int, int], ...]

    @property
    def names(self) -> Mapping[str, int]:
        """Nodes of the coordinates and velocities of bodies, centres of mass among them, by their names."""
        ...

    @property
    def known(self) -> Mapping[Measure, tuple[int, int, float]]:
        """Measures that are coordinates of the state, see `symgen.describe.topology.known_coordinates`."""
        ...

    def frame(self, body: str) -> list[int]:
        """Return the nodes of a frame's slots."""
        ...

    @property
    def coordinates(self) -> Mapping[int, Coordinate]:
        """The coordinates of joints by `Coordinate.number`."""
        ...

    def column(self, index: int) -> Mapping[int, int]:
        """Return the row of B for a velocity of a body: velocities of the state and nodes.

        What drivers prescribe has an index below 0: the velocity of a body has a part with that column and its rate.
        """
        ...

    def accelerations(self, rates: tuple[int, ...]) -> dict[str, int]:
        """Return the accelerations of bodies by the names of their velocities, from v' of the state."""
        ...

    def speed(self, body: str) -> list[int]:
        """Return the velocity of a centre of mass in some axes."""
        ...

    def weight(self, body: str, force: list[int]) -> dict[int, int]:
        """Return what a force at the centre of mass, in ground axes, is on the velocities of bodies."""
        ...

    def dynamics(self, forces: list[int]) -> tuple[tuple[MassBlock, ...], list[int], DriverPower | None]:
        """Return M and f of the state, from forces on the velocities of bodies, inertia apart; the power of drivers."""
        ...

    def metric(self) -> tuple[MassBlock, ...]:
        """Return the metric of the velocities of bodies, centres of mass and angular ones, pulled back."""
        ...


def carried_energies(model: ModelNodes, forces: list[int]) -> tuple[int, int]:
    """Return the kinetic energy and gravity's potential of bodies on a tree; adds weights to `forces`.

    Energies are those of the bodies' own velocities, not of M: they hold M to account in the balance of a run.
    """
    g, names = model.graph, model.names
    gravity = tuple(model.expression(e) for e in model.mechanism.gravity)
    kinetic = potential = g.zero
    half = g.constant(0.5)
    axes = "xyz"[: len(gravity)]
    for body in model.mechanism.bodies:
        mass = model.expression(body.mass)
        assert model.tree is not None, "bodies are carried"
        speeds = model.tree.speed(body.name)
        kinetic = g.add(kinetic, g.mul(g.mul(half, mass), g.dot(speeds, speeds)))
        if isinstance(body, SpatialBody):
            if body.inertia is not None:
                xx, yy, zz, xy, xz, yz = (model.expression(e) for e in body.inertia)
                omega = [names[f"{body.name}.w{axis}"] for axis in axes]
                momentum = [g.dot(row, omega) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))]
                kinetic = g.add(kinetic, g.mul(half, g.dot(momentum, omega)))
        elif body.inertia is not None:
            omega_z = names[f"{body.name}.omega"]
            kinetic = g.add(kinetic, g.mul(g.mul(half, model.expression(body.inertia)), g.mul(omega_z, omega_z)))
        weight = [g.mul(mass, a) for a in gravity]
        potential = g.sub(potential, g.dot(weight, [names[f"{body.name}.{axis}"] for axis in axes]))
        for index, node in model.tree.weight(body.name, weight).items():
            forces[index] = g.add(forces[index], node)
    return kinetic, potential
