"""Bodies on a tree of joints: the common part of trees in the plane and in space, and the energies of bodies."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from symgen.derive.formulate.equations import DriverPower, MassBlock, mass_blocks
from symgen.derive.formulate.of_time import Coordinate, prescribed_coordinates
from symgen.describe.mechanism import SpatialBody
from symgen.describe.parts.topology import state_measures
from symgen.describe.spanning_tree import Link

if TYPE_CHECKING:
    from symgen.derive.formulate.measure_nodes import ModelNodes


class Tree(ABC):
    """Bodies on a tree of joints.

    Rows and forces of a mechanism are derived over the velocities of bodies: of a point of each body, and its angular
    velocity. Here these follow from the velocities of the state: u = B v + b, with derivative B v' + c.

    Attributes
    ----------
    size, count : int
        Number of velocities and of coordinates of the state.
    velocities, biases : tuple of int
        u, and c; one node for each velocity of a body.
    columns : list of mapping
        Rows of B: velocities of the state and nodes. Prescribed coordinates have indices below 0: the velocity of a
        body contains that column times their rate.
    q_rates : list of int
        q' of the state.
    spins : list of (int, int)
        First indices of Euler parameters in q and of their angular velocities in v.
    names : dict of str to int
        Nodes of the coordinates and velocities of bodies, centres of mass among them, by their names.
    coordinates : dict of int to Coordinate
        Joint coordinates by `Coordinate.number`.
    measures : dict
        Measures that are coordinates of the state, see `symgen.describe.parts.topology.state_measures`.
    """

    def __init__(self, model: ModelNodes) -> None:
        self.model, self.graph = model, model.graph
        topology = model.mechanism.topology
        assert topology is not None, "a tree belongs to it"
        self.size = self.count = 0
        self.q_rates: list[int] = []
        self.spins: list[tuple[int, int]] = []
        self.names: dict[str, int] = {}
        self.columns: list[Mapping[int, int]] = []
        self.prescribed = prescribed_coordinates(model, topology)
        self.coordinates: dict[int, Coordinate] = {}
        self.place_ground()
        for link in topology.links:
            self.place_body(link)
        velocities, biases = self.velocities_of_bodies()
        g = self.graph
        self.columns += [{i: g.one} for i in range(self.size)]
        self.velocities = (*velocities, *(g.input("v", i) for i in range(self.size)))
        self.biases = (*biases, *(g.zero for _ in range(self.size)))
        self.measures = state_measures(model.mechanism, topology)

    @abstractmethod
    def place_ground(self) -> None:
        """Place the ground."""

    @abstractmethod
    def place_body(self, link: Link) -> None:
        """Place the body of a link after its ancestors."""

    @abstractmethod
    def velocities_of_bodies(self) -> tuple[Sequence[int], Sequence[int]]:
        """Return u and c of all bodies, and store the rows of B and the nodes of their coordinates and velocities."""

    @abstractmethod
    def frame(self, body: str) -> list[int]:
        """Return the nodes of a frame's slots."""

    @abstractmethod
    def accelerations(self, rates: tuple[int, ...]) -> dict[str, int]:
        """Return the accelerations of bodies by the names of their velocities, from v' of the state."""

    @abstractmethod
    def speed(self, body: str) -> list[int]:
        """Return the velocity of a centre of mass, in ground or body axes."""

    @abstractmethod
    def force_over_velocities(self, body: str, force: list[int]) -> dict[int, int]:
        """Return a force at the centre of mass, in ground axes, over the velocities of bodies."""

    @abstractmethod
    def dynamics(self, forces: list[int]) -> tuple[tuple[MassBlock, ...], list[int], DriverPower | None]:
        """Return M and f of the state and the power of drivers; `forces` are over the velocities of bodies."""

    @abstractmethod
    def metric_of_bodies(self) -> tuple[MassBlock, ...]:
        """Return the metric of the bodies' centre-of-mass and angular velocities, pulled back."""

    def add_velocity(self) -> int:
        """Add a velocity to the state that is the rate of its coordinate; return its index."""
        self.q_rates.append(self.graph.input("v", self.size))
        self.size, self.count = self.size + 1, self.count + 1
        return self.size - 1

    def add_coordinate(self, body: str, label: str) -> Coordinate:
        """Return a prescribed coordinate, or else a new coordinate of the state."""
        g, coordinate = self.graph, self.prescribed.get((body, label))
        if coordinate is None:
            q, i = g.input("q", self.count), self.add_velocity()
            coordinate = Coordinate(i, q, g.input("v", i), g.zero)
        self.coordinates[coordinate.number] = coordinate
        return coordinate

    def mass_without_prescribed(self, mass: Mapping[tuple[int, int], int]) -> tuple[MassBlock, ...]:
        """Return the blocks of M without prescribed coordinates."""
        own = {(i, j): node for (i, j), node in mass.items() if min(i, j) >= 0}
        return mass_blocks(own, self.size, self.graph.zero)


def energies_on_tree(model: ModelNodes, forces: list[int]) -> tuple[int, int]:
    """Return the kinetic energy and gravity's potential of bodies on a tree; add weights to `forces`.

    Energies come from the bodies' velocities, not from M: the energy balance of a run thus checks M.
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
        for index, node in model.tree.force_over_velocities(body.name, weight).items():
            forces[index] = g.add(forces[index], node)
    return kinetic, potential
