"""Trees of bodies in the coordinates of their joints, with closed loops: positions, rates, masses and forces.

Everything is in space; a planar mechanism is one whose axes are all along z.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

GROUND = -1


def skew(x: Array) -> Array:
    """Return the matrix of a cross product from the left."""
    return np.array([[0.0, -x[2], x[1]], [x[2], 0.0, -x[0]], [-x[1], x[0], 0.0]])


def cross(x: Array, y: Array) -> Array:
    """Return a cross product."""
    return np.array([x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]])


def turn(axis: Array, angle: float) -> Array:
    """Return the matrix of a turn about an axis."""
    k = skew(axis)
    rotation: Array = np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * (k @ k)
    return rotation


@dataclass(frozen=True, eq=False)
class Link:
    """A joint with one coordinate and the body behind it.

    Attributes
    ----------
    parent : int
        Number of the body before it, or `GROUND`.
    slide : bool
        Whether it slides along its axis or turns about it.
    axis : Array
        In the frame of the body.
    turned : Array, shape (3, 3)
        From the frame of the body to that of its parent where the coordinate is 0.
    before, behind : Array
        The joint's point, in the frame of the parent and of the body, from their centres of mass [m].
    mass : float
        0 for half of a joint with two coordinates.
    inertia : Array, shape (3, 3)
        About the centre of mass.
    force, frequency, phase : Array, float, float
        The force ``force * sin(frequency t + phase)`` acts on the centre of mass.
    torque : Array
        A torque on the body that swings like it.
    stiffness : float
        Of a spring along the coordinate, without force where this is 0.
    rotor : float
        Inertia of a rotor that turns with the coordinate, times the square of its gear ratio.
    """

    parent: int
    slide: bool
    axis: Array
    turned: Array
    before: Array
    behind: Array
    mass: float
    inertia: Array
    force: Array = field(default_factory=lambda: np.zeros(3))
    frequency: float = 0.0
    phase: float = 0.0
    torque: Array = field(default_factory=lambda: np.zeros(3))
    stiffness: float = 0.0
    rotor: float = 0.0


@dataclass(frozen=True, eq=False)
class Point:
    """A point of a body, from its centre of mass in its frame; of the ground in ground axes."""

    body: int
    at: Array


@dataclass(frozen=True, eq=False)
class Closure:
    """Two points that coincide, along some of the axes of the ground; or, with a length, that have this distance."""

    first: Point
    second: Point
    axes: tuple[int, ...] = (0, 1, 2)
    length: float | None = None


@dataclass(frozen=True)
class Moving:
    """A vector or number that moves.

    Attributes
    ----------
    value, slopes : Array
        Itself, and its derivatives by the coordinates.
    bias : Array
        Its second rate less ``slopes @ v'``.
    drift : float
        Its rate less ``slopes @ v``.
    """

    value: Array
    slopes: Array
    bias: Array
    drift: float = 0.0


class Bodies:
    """Positions and rates of all bodies: by number, what `State` has by the same names."""

    def __init__(self, tree: Tree, u: Array, v: Array) -> None:
        n = len(tree.links)
        self.turns: list[Array] = []
        self.places: list[Array] = []
        self.spin_slopes: list[Array] = []
        self.slopes: list[Array] = []
        self.spins: list[Array] = []
        self.spin_bias: list[Array] = []
        self.bias: list[Array] = []
        ground = np.eye(3), np.zeros(3), np.zeros((3, n)), np.zeros((3, n)), np.zeros(3), np.zeros(3), np.zeros(3)
        for k, link in enumerate(tree.links):
            p = link.parent
            turned, place, about, along, spin, spinning, rising = (
                ground
                if p == GROUND
                else (
                    *(self.turns[p], self.places[p], self.spin_slopes[p], self.slopes[p]),
                    *(self.spins[p], self.spin_bias[p], self.bias[p]),
                )
            )
            frame = turned @ link.turned
            if not link.slide:
                frame = frame @ turn(link.axis, u[k])
            axis = frame @ link.axis
            arm, back = turned @ link.before, -(frame @ link.behind)
            one = np.zeros((3, n))
            one[:, k] = axis
            if link.slide:
                arm = arm + axis * u[k]
                own_about, own_spin, own_spinning = about, spin, spinning
                along = along + one
                rising = rising + 2.0 * v[k] * cross(spin, axis)
            else:
                own_about, own_spin = about + one, spin + v[k] * axis
                own_spinning = spinning + v[k] * cross(spin, axis)
            self.turns.append(frame)
            self.places.append(place + arm + back)
            self.spin_slopes.append(own_about)
            self.slopes.append(along - skew(arm) @ about - skew(back) @ own_about)
            self.spins.append(own_spin)
            self.spin_bias.append(own_spinning)
            self.bias.append(
                rising
                + cross(spinning, arm)
                + cross(spin, cross(spin, arm))
                + cross(own_spinning, back)
                + cross(own_spin, cross(own_spin, back))
            )


class State:
    """One state, whose bodies are looked at where something asks for them."""

    def __init__(self, tree: Tree, t: float, u: Array, v: Array) -> None:
        self.tree, self.t, self.u, self.v = tree, t, u, v

    @cached_property
    def bodies(self) -> Bodies:
        """Positions and rates of all bodies."""
        return Bodies(self.tree, self.u, self.v)

    @property
    def turns(self) -> list[Array]:
        """Rotation matrices from bodies to the ground."""
        return self.bodies.turns

    @property
    def places(self) -> list[Array]:
        """Centres of mass."""
        return self.bodies.places

    @property
    def slopes(self) -> list[Array]:
        """Derivatives of the centres' velocities by the rates."""
        return self.bodies.slopes

    @property
    def spins(self) -> list[Array]:
        """Angular velocities in ground axes."""
        return self.bodies.spins

    @property
    def spin_slopes(self) -> list[Array]:
        """Derivatives of angular velocities by the rates."""
        return self.bodies.spin_slopes

    @property
    def bias(self) -> list[Array]:
        """Accelerations of the centres where those of all coordinates are 0."""
        return self.bodies.bias

    @property
    def spin_bias(self) -> list[Array]:
        """Angular accelerations where those of all coordinates are 0."""
        return self.bodies.spin_bias

    def point(self, point: Point) -> Moving:
        """Return where a point is."""
        k = point.body
        if k == GROUND:
            return Moving(point.at, np.zeros((3, len(self.u))), np.zeros(3))
        arm, spin = self.turns[k] @ point.at, self.spins[k]
        return Moving(
            self.places[k] + arm,
            self.slopes[k] - skew(arm) @ self.spin_slopes[k],
            self.bias[k] + cross(self.spin_bias[k], arm) + cross(spin, cross(spin, arm)),
        )

    def between(self, first: Point, second: Point) -> Moving:
        """Return the vector from one point to another."""
        a, b = self.point(first), self.point(second)
        return Moving(b.value - a.value, b.slopes - a.slopes, b.bias - a.bias)

    def distance(self, first: Point, second: Point) -> Moving:
        """Return the distance of two points."""
        d = self.between(first, second)
        length = float(np.sqrt(d.value @ d.value))
        e, rate = d.value / length, d.slopes @ self.v
        along = float(e @ rate)
        bias = e @ d.bias + (rate @ rate - along**2) / length
        return Moving(np.asarray(length), e @ d.slopes, np.asarray(bias))


class Tree:
    """A mechanism.

    Parameters
    ----------
    links : sequence of Link
        Parents come before children.
    closures : sequence of Closure
        What closes loops.
    gravity : Array
        [m/s^2].
    """

    def __init__(self, links: Sequence[Link], closures: Sequence[Closure], gravity: Array) -> None:
        self.links, self.closures, self.gravity = tuple(links), tuple(closures), gravity

    @property
    def n(self) -> int:
        """Number of coordinates."""
        return len(self.links)

    def at(self, t: float, u: Array, v: Array) -> State:
        """Return positions and rates."""
        return State(self, t, u, v)

    def dynamics(self, state: State) -> tuple[Array, Array]:
        """Return M and the forces of M v' = f, without those of closures and of what has bounds."""
        n = self.n
        mass, force = np.zeros((n, n)), np.zeros(n)
        for k, link in enumerate(self.links):
            if link.mass:
                along = state.slopes[k]
                mass += link.mass * (along.T @ along)
                push = link.mass * (self.gravity - state.bias[k])
                if link.frequency:
                    swing = np.sin(link.frequency * state.t + link.phase)
                    push = push + link.force * swing
                    force += state.spin_slopes[k].T @ (link.torque * swing)
                force += along.T @ push
            force[k] -= link.stiffness * state.u[k]
            mass[k, k] += link.rotor
            if link.inertia.any():
                about, frame, spin = state.spin_slopes[k], state.turns[k], state.spins[k]
                inertia = frame @ link.inertia @ frame.T
                mass += about.T @ inertia @ about
                force -= about.T @ (inertia @ state.spin_bias[k] + cross(spin, inertia @ spin))
        return mass, force

    def closed(self, state: State) -> tuple[Array, Array, Array]:
        """Return gaps of the closures, their derivatives, and what their second rates have besides these."""
        values, slopes, bias = [np.zeros(0)], [np.zeros((0, self.n))], [np.zeros(0)]
        for closure in self.closures:
            if closure.length is None:
                d, axes = state.between(closure.first, closure.second), list(closure.axes)
                values, slopes, bias = [*values, d.value[axes]], [*slopes, d.slopes[axes]], [*bias, d.bias[axes]]
            else:
                d = state.distance(closure.first, closure.second)
                values.append(np.array([d.value - closure.length]))
                slopes.append(d.slopes[None, :])
                bias.append(np.array([d.bias]))
        return np.concatenate(values), np.vstack(slopes), np.concatenate(bias)
