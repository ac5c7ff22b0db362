"""M and f of bodies in space on a tree: composite inertias and the recursive Newton-Euler algorithm, leaves first.

The constant inertia of a body welded to its parent is added to the parent's own; only the forces on it are propagated
inwards. A thin rod along the axis of a hinge, or a mass at the centre of a ball joint, does not act on that joint: this
part of a body's inertia is transferred to the parent, which leaves the body without mass and changes no entry of M or
f (base parameters; Khalil and Dombre, Modeling, Identification and Control of Robots, 2002, section 9.4).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from symgen.base.vocabulary.measures import GROUND
from symgen.derive.formulate.vector_algebra import Matrix, Triple, Vectors
from symgen.describe.mechanism import SpatialBody
from symgen.describe.spanning_tree import Link

if TYPE_CHECKING:
    from collections.abc import Mapping

    from symgen.derive.formulate.measure_nodes import ModelNodes


@dataclass(frozen=True)
class BodyVelocity:
    """Rotation and translation of a link's body by a velocity of the state, in body axes: `about` and `along`.

    A translation alone has the same direction in the parent's axes, `outside`, where its length does not depend on the
    orientation of the body.
    """

    about: Triple
    along: Triple
    outside: Triple | None = None


@dataclass
class PlacedBody:
    """The place and motion of a body as nodes; vectors in body axes unless stated otherwise.

    Attributes
    ----------
    turn : Matrix
        From the body's axes to its parent's.
    arm : Triple
        From the parent's point to its own, in the parent's axes.
    own : bool
        Whether its orientation is independent of the parent's.
    axes : Matrix
        From its axes to the ground's.
    at : Triple
        Its point, in ground axes.
    omega, velocity : Triple
        Angular velocity, and velocity of its point.
    alpha, bias : Triple
        Angular acceleration, and acceleration of its point less gravity, where v' is 0.
    whirl : Matrix
        Maps a position in the body to its acceleration relative to the body's point, where v' is 0.
    motions : mapping of int to BodyVelocity
        Velocities of the state that belong to its link.
    columns : mapping of int to (Triple, Triple)
        Velocity of the state -> derivative of `omega` and `velocity` by it.
    centre : Triple
        Its centre of mass, from its point.
    euler : sequence of int
        Euler parameters.
    hinge : (Triple, Triple) or None
        The axis of a body on a hinge, in its own and in the parent's axes; zeros for a body on a ball joint.
    """

    link: Link
    turn: Matrix
    arm: Triple
    own: bool
    axes: Matrix
    at: Triple
    omega: Triple
    velocity: Triple
    alpha: Triple
    bias: Triple
    whirl: Matrix
    motions: dict[int, BodyVelocity]
    columns: dict[int, tuple[Triple, Triple]]
    centre: Triple
    euler: Sequence[int]
    hinge: tuple[Triple, Triple] | None = None
    children: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Inertia:
    """Mass, first and second moment about the point of a body, in body axes."""

    mass: int
    first: Triple
    second: Matrix


def is_welded(p: PlacedBody) -> bool:
    """Whether a body is rigidly attached to its parent."""
    return not p.motions and not p.own and p.link.parent != GROUND


class Composite:
    """The composite bodies of a tree: each body with its subtree.

    Parameters
    ----------
    model : ModelNodes
        The mechanism.
    placed : mapping of str to PlacedBody
        Its bodies and the ground, each after its parent.
    forces : list of int
        Over the velocities of bodies, then over those of the state; without gravity and inertia.
    alike : bool
        Whether all bodies have mass 1 and inertia 1 in all directions: M is then the metric of their velocities.
    """

    def __init__(
        self, model: ModelNodes, placed: Mapping[str, PlacedBody], forces: list[int], alike: bool = False
    ) -> None:
        self.model, self.placed, self.forces, self.alike = model, placed, forces, alike
        self.v = Vectors(model.graph)
        self.order = [name for name in placed if name != GROUND]
        self.rigid: dict[str, Inertia] = {}
        self.transferred: dict[str, Inertia] = {}  # part of a body's inertia for its parent, about the parent's point
        self.hanging: dict[str, Inertia] = {}
        self.push: dict[str, Triple] = {}
        self.torque: dict[str, Triple] = {}
        for name in reversed(self.order):
            self.rigid[name] = self._without_rod(name, self._inertia_with_welded(name))
        for name in reversed(self.order):
            self.hanging[name] = self._inertia_of_subtree(name)
            self.push[name], self.torque[name] = self._load_of_joint(name)

    # -- inertia -------------------------------------------------------------------------------------------------------

    def _inertia_with_welded(self, name: str) -> Inertia:
        """Return the inertia of a body with the bodies welded to it."""
        v, body, p = self.v, self.model.mechanism.body(name), self.placed[name]
        assert isinstance(body, SpatialBody), "bodies in space"
        m = self.model.graph.one if self.alike else self.model.expression(body.mass)
        second = v.second_moment(m, p.centre)
        if self.alike and not body.is_point:
            second = v.matrix_sum(v.units, second)
        elif body.inertia is not None:
            xx, yy, zz, xy, xz, yz = (self.model.expression(e) for e in body.inertia)
            second = v.matrix_sum(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)), second)
        inertia = Inertia(m, v.scale(m, p.centre), second)
        for child in p.children:
            if is_welded(self.placed[child]):
                inertia = self._sum_of_inertias(inertia, self._inertia_at_parent(self.placed[child], self.rigid[child]))
            elif child in self.transferred:
                inertia = self._sum_of_inertias(inertia, self.transferred[child])
        return inertia

    def _without_rod(self, name: str, inertia: Inertia) -> Inertia:
        """Return an inertia without the part that does not act on its joint, and record that part for the parent."""
        g, v, p = self.model.graph, self.v, self.placed[name]
        if p.hinge is None:
            return inertia
        axis, beside = p.hinge
        shift = v.scale(inertia.mass, p.arm)
        ((i, sign),) = [(k, g.value(x)) for k, x in enumerate(axis) if g.value(x) not in (0.0, None)][:1] or [(0, None)]
        if axis == v.zero or sign not in (1.0, -1.0) or sum(x != g.zero for x in axis) != 1:
            self.transferred[name] = Inertia(inertia.mass, shift, v.shift_moment(shift, p.arm))
            return Inertia(g.zero, inertia.first, inertia.second)
        first, second = list(inertia.first), [list(row) for row in inertia.second]
        j, k = (i + 1) % 3, (i + 2) % 3
        turned = v.scale(g.mul(g.constant(sign), first[i]), beside)
        # the second moment by coordinates along the axis
        along = g.mul(g.constant(0.5), g.sub(g.add(second[j][j], second[k][k]), second[i][i]))
        rod = v.shift_moment(v.scale(along, beside), beside)
        first[i] = g.zero
        second[j][j], second[k][k] = g.sub(second[j][j], along), g.sub(second[k][k], along)
        double = v.add(shift, turned, turned)
        self.transferred[name] = Inertia(
            inertia.mass, v.add(shift, turned), v.matrix_sum(rod, v.shift_moment(double, p.arm))
        )
        return Inertia(g.zero, v.triple(first), (v.triple(second[0]), v.triple(second[1]), v.triple(second[2])))

    def _inertia_of_subtree(self, name: str) -> Inertia:
        """Return the inertia of a body with its subtree."""
        inertia, v = self.rigid[name], self.v
        for child in self.placed[name].children:
            c, own = self.placed[child], self.hanging[child]
            if is_welded(c):  # the rigid part is already included
                less = self.rigid[child]
                second = tuple(v.sub(a, b) for a, b in zip(own.second, less.second, strict=True))
                rest = v.sub(own.first, less.first), (second[0], second[1], second[2])
                own = Inertia(self.model.graph.sub(own.mass, less.mass), *rest)
            inertia = self._sum_of_inertias(inertia, self._inertia_at_parent(c, own))
        return inertia

    def _sum_of_inertias(self, a: Inertia, b: Inertia) -> Inertia:
        v = self.v
        return Inertia(self.model.graph.add(a.mass, b.mass), v.add(a.first, b.first), v.matrix_sum(a.second, b.second))

    def _inertia_at_parent(self, c: PlacedBody, own: Inertia) -> Inertia:
        """Return an inertia about the parent's point, in the parent's axes."""
        v = self.v
        shift = v.scale(own.mass, c.arm)
        if c.own:  # a body with its own orientation acts as a point mass in its joint
            return Inertia(own.mass, shift, v.shift_moment(shift, c.arm))
        turned = v.matrix_times(c.turn, own.first)
        double = v.add(shift, turned, turned)
        return Inertia(
            own.mass,
            v.add(shift, turned),
            v.matrix_sum(v.rotate_symmetric(c.turn, own.second), v.shift_moment(double, c.arm)),
        )

    # -- forces --------------------------------------------------------------------------------------------------------

    def _load_of_joint(self, name: str) -> tuple[Triple, Triple]:
        """Return force and torque of the joint on its body, about the body's point, where v' is 0."""
        v, p, first = self.v, self.placed[name], self.model.first[name]
        is_point = self.model.mechanism.body(name).is_point
        push = v.neg(v.times_transposed(p.axes, v.triple(self.forces[first : first + 3])))
        torque = v.zero if is_point else v.neg(v.triple(self.forces[first + 3 : first + 6]))
        if not is_welded(p):  # else its inertia is part of the parent's
            m, h, j = self.rigid[name].mass, self.rigid[name].first, self.rigid[name].second
            push = v.add(push, v.scale(m, p.bias), v.matrix_times(p.whirl, h))
            torque = v.add(torque, v.moment_of_inertia_forces(p.whirl, j), v.cross(h, p.bias))
        for child in p.children:
            c = self.placed[child]
            passed = v.matrix_times(c.turn, self.push[child])
            push = v.add(push, passed)
            torque = v.add(torque, v.cross(c.arm, passed))
            if not c.own:
                torque = v.add(torque, v.matrix_times(c.turn, self.torque[child]))
        return push, torque

    def generalized_forces(self) -> dict[int, int]:
        """Return f by velocity, including those that drivers prescribe."""
        g, v = self.model.graph, self.v
        f = dict(enumerate(self.forces[self.model.size :]))
        for name in self.order:
            for i, motion in self.placed[name].motions.items():
                held = g.add(v.dot(motion.about, self.torque[name]), v.dot(motion.along, self.push[name]))
                f[i] = g.sub(f.get(i, g.zero), held)
        return f

    def mass_entries(self) -> dict[tuple[int, int], int]:
        """Return the entries of M: the momentum of each velocity, propagated inwards to the velocities before it."""
        g, v = self.model.graph, self.v
        entries: dict[tuple[int, int], int] = {}
        for name in self.order:
            p, own = self.placed[name], self.hanging[name]
            for i, motion in p.motions.items():
                momentum = v.add(v.cross(motion.about, own.first), v.scale(own.mass, motion.along))
                angular = v.add(v.matrix_times(own.second, motion.about), v.cross(own.first, motion.along))
                at = p
                while True:
                    for k, other in at.motions.items():
                        if at is not p or k >= i or k < 0:
                            if at is p and motion.outside and other.outside:
                                node = g.mul(own.mass, v.dot(other.outside, motion.outside))
                            else:
                                node = g.add(v.dot(other.about, angular), v.dot(other.along, momentum))
                            entries[i, k] = entries[k, i] = node
                    if at.link.parent == GROUND:
                        break
                    momentum = v.matrix_times(at.turn, momentum)
                    lever = v.cross(at.arm, momentum)
                    angular = lever if at.own else v.add(v.matrix_times(at.turn, angular), lever)
                    at = self.placed[at.link.parent]
        return entries
