"""Bodies in space on a tree of joints: positions, velocities, M and f from joint coordinates.

The origin of a body's frame is its joint's point. Vectors of a body are in its own axes, where its inertia is constant:
velocities are propagated outwards, forces and composite inertias inwards (the recursive Newton-Euler and the
composite-rigid-body algorithm; Featherstone, Rigid Body Dynamics Algorithms, 2008, chapters 5 and 6). Gravity is an
acceleration of the ground. Bodies on ball joints and free bodies have Euler parameters and angular velocities relative
to the ground: the parent of such a body moves its joint's point but does not rotate it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from symgen.base.vocabulary.measures import GROUND, Direction
from symgen.derive.formulate.equations import DriverPower, MassBlock
from symgen.derive.formulate.euler_parameters import (
    compose_rotations,
    elementary_rotation,
    inverse_rotation,
    parameters_of_matrix,
    rate_of_parameters,
    rotation_matrix_rows,
)
from symgen.derive.formulate.joint_tree import Tree
from symgen.derive.formulate.of_time import power_of_drivers
from symgen.derive.formulate.tree_inertia import BodyVelocity, Composite, PlacedBody
from symgen.derive.formulate.vector_algebra import Matrix, Triple, Vectors
from symgen.describe.mechanism import SpatialBody, Vec
from symgen.describe.parts.topology import labels_of_link
from symgen.describe.spanning_tree import Articulation, Link

if TYPE_CHECKING:
    from symgen.derive.formulate.measure_nodes import ModelNodes


class SpatialTree(Tree):
    """Bodies in space on a tree."""

    def __init__(self, model: ModelNodes) -> None:
        self.v = Vectors(model.graph)
        self.gravity = self.v.triple([model.expression(e) for e in model.mechanism.gravity])
        super().__init__(model)

    def place_ground(self) -> None:
        """Place the ground."""
        g, v = self.graph, self.v
        still = v.zero
        self.placed = {
            GROUND: PlacedBody(
                *(Link(GROUND), v.units, still, True, v.units, still, still, still, still, v.neg(self.gravity)),
                *((still, still, still), {}, {}, still, (g.one, g.zero, g.zero, g.zero)),
            )
        }

    def velocities_of_bodies(self) -> tuple[list[int], list[int]]:
        """Return u and c of all bodies."""
        g, v, velocities, biases = self.graph, self.v, list[int](), list[int]()
        for body in self.model.mechanism.bodies:
            p = self.placed[body.name]
            velocities += v.matrix_times(p.axes, p.velocity)
            biases += v.add(v.matrix_times(p.axes, p.bias), self.gravity)
            moved = {i: v.matrix_times(p.axes, along) for i, (_, along) in p.columns.items()}
            self.columns += [{i: c[k] for i, c in moved.items() if c[k] != g.zero} for k in range(3)]
            if not body.is_point:
                velocities += p.omega
                biases += p.alpha
                self.columns += [
                    {i: about[k] for i, (about, _) in p.columns.items() if about[k] != g.zero} for k in range(3)
                ]
            self._name_coordinates(body.name, body.is_point, p)
        return velocities, biases

    # -- positions and velocities --------------------------------------------------------------------------------------

    def _ball_coordinates(self) -> tuple[list[int], list[int]]:
        """Return Euler parameters and the indices of their angular velocity."""
        g = self.graph
        e = [g.input("q", self.count + k) for k in range(4)]
        indices = list(range(self.size, self.size + 3))
        self.spins.append((self.count, self.size))
        self.size, self.count = self.size + 3, self.count + 4
        self.q_rates += rate_of_parameters(g, e, [g.input("v", i) for i in indices])
        return e, indices

    def place_body(self, link: Link) -> None:
        """Place the body of a link."""
        g, v, model = self.graph, self.v, self.model
        body, parent = model.mechanism.body(link.body), self.placed[link.parent]
        assert isinstance(body, SpatialBody), "bodies in space"
        parent.children.append(link.body)
        joint = link.articulation
        motions: dict[int, BodyVelocity] = {}
        reference, arm, rate, gained, directions = self._joint_point_and_arm(link, body)
        model.references[link.body] = reference
        own_turn = joint is None or joint.turn == "ball"
        relative = extra = v.zero
        euler: Sequence[int]
        if body.is_point:
            turn, euler, own_turn = v.transpose(parent.axes), (g.one, g.zero, g.zero, g.zero), True
            axes = v.units
        elif own_turn:
            euler, indices = self._ball_coordinates()
            axes = _three_rows(v, rotation_matrix_rows(g, euler))
            turn = axes if link.parent == GROUND else v.product(v.transpose(parent.axes), axes)
            motions |= {i: BodyVelocity(unit, v.zero) for i, unit in zip(indices, v.units, strict=True)}
        else:
            assert joint is not None, "it is no free body"
            turn, quaternion, abouts, twisted = self._rotation_to_parent(joint, link)
            extra = twisted
            for i, about in abouts.items():
                along, c = v.zero, self.coordinates[i]
                if joint.screw:
                    slope, offset = (model.expression(e) for e in joint.screw)
                    sign = g.one if link.forward else g.constant(-1.0)
                    axis = v.scale(sign, v.triple(model.direction(joint.of_a[2] if link.forward else joint.of_b[2])))
                    place = g.add(g.mul(slope, c.value), offset)
                    arm = v.add(arm, v.scale(place, axis))
                    rate = v.add(rate, v.scale(g.mul(slope, c.rate), axis))
                    gained = v.add(gained, v.scale(g.mul(slope, c.acceleration), axis))
                    along = v.times_transposed(turn, v.scale(slope, axis))
                motions[i] = BodyVelocity(about, along)
                relative = v.add(relative, v.scale(c.rate, about))
                extra = v.add(extra, v.scale(c.acceleration, about))
            axes = v.product(parent.axes, turn)
            euler = compose_rotations(g, parent.euler, quaternion)
        motions |= {i: BodyVelocity(v.zero, v.times_transposed(turn, e), e) for i, e in directions.items()}
        if body.is_point:
            omega = alpha = v.zero
        elif own_turn:
            start = next(i for i, m in motions.items() if m.about != v.zero)
            omega, alpha = v.triple([g.input("v", start + k) for k in range(3)]), v.zero
        else:
            carried = v.times_transposed(turn, parent.omega)
            omega = v.add(carried, relative)
            alpha = v.add(v.times_transposed(turn, parent.alpha), v.cross(carried, relative), extra)
        w = parent.omega
        moved = v.add(parent.velocity, v.cross(w, arm), rate)
        swing = v.cross(w, v.scale(g.constant(2.0), rate))
        bias = v.add(parent.bias, v.matrix_times(parent.whirl, arm), swing, gained)
        columns: dict[int, tuple[Triple, Triple]] = {}
        for i, (about, along) in parent.columns.items():
            turned = v.zero if own_turn else v.times_transposed(turn, about)
            columns[i] = turned, v.times_transposed(turn, v.add(along, v.cross(about, arm)))
        columns |= {i: (m.about, m.along) for i, m in motions.items()}
        com, at = (v.triple([model.expression(e) for e in point]) for point in (body.centre_of_mass, reference))
        self.placed[link.body] = PlacedBody(
            link,
            turn,
            arm,
            own_turn,
            axes,
            v.add(parent.at, v.matrix_times(parent.axes, arm)),
            omega,
            v.times_transposed(turn, moved),
            alpha,
            v.times_transposed(turn, bias),
            v.acceleration_matrix(omega, alpha),
            motions,
            columns,
            v.sub(com, at),
            euler,
            self._hinge_axis(link, body),
        )

    def _joint_point_and_arm(
        self, link: Link, body: SpatialBody
    ) -> tuple[Vec, Triple, Triple, Triple, dict[int, Triple]]:
        """Return the point at which a link holds its body, and the arm to it in the parent's axes.

        Its rate, the prescribed part of its acceleration, and directions of slides by velocity follow.
        """
        g, v, model, joint = self.graph, self.v, self.model, link.articulation
        rate = gained = v.zero
        if joint is None:
            first = self.count
            slides = [self.add_velocity() for _ in range(3)]
            arm = v.triple([g.input("q", first + k) for k in range(3)])
            rate = v.triple([g.input("v", i) for i in slides])
            return body.centre_of_mass, arm, rate, gained, dict(zip(slides, v.units, strict=True))
        carrier, own = (joint.a, joint.b) if link.forward else (joint.b, joint.a)
        arm = v.triple(model.local(carrier))
        sign = g.one if link.forward else g.constant(-1.0)
        directions = dict[int, Triple]()
        for label, direction in zip(labels_of_link(model.mechanism, link)[0], joint.slides, strict=True):
            c = self.add_coordinate(link.body, label)
            e = v.scale(sign, self._direction_in_parent(joint, link, direction))
            arm = v.add(arm, v.scale(c.value, e))
            rate = v.add(rate, v.scale(c.rate, e))
            gained = v.add(gained, v.scale(c.acceleration, e))
            directions[c.number] = e
        return own.point, arm, rate, gained, directions

    def _hinge_axis(self, link: Link, body: SpatialBody) -> tuple[Triple, Triple] | None:
        """Return the axis of a body that only rotates about it, zeros for a ball joint, else None."""
        joint, v = link.articulation, self.v
        if joint is None or joint.slides or joint.screw or body.is_point or joint.turn not in ("axis", "ball"):
            return None
        if joint.turn == "ball":
            return v.zero, v.zero
        mine, other = (joint.of_b[2], joint.of_a[2]) if link.forward else (joint.of_a[2], joint.of_b[2])
        return v.triple(self.model.direction(mine)), v.triple(self.model.direction(other))

    def _direction_in_parent(self, joint: Articulation, link: Link, direction: Direction) -> Triple:
        """Return a direction of displacement in the parent's axes."""
        vector = self.v.triple(self.model.direction(direction))
        if direction.body == link.parent:
            return vector
        # the axis itself, or no rotation: the same in both frames
        of, to = (joint.of_a, joint.of_b) if link.forward is False else (joint.of_b, joint.of_a)
        parts = [self.v.dot(vector, self.v.triple(self.model.direction(d))) for d in of]
        axes = [self.v.triple(self.model.direction(d)) for d in to]
        return self.v.add(*(self.v.scale(x, axis) for x, axis in zip(parts, axes, strict=True)))

    def _rotation_to_parent(
        self, joint: Articulation, link: Link
    ) -> tuple[Matrix, Sequence[int], dict[int, Triple], Triple]:
        """Return the rotation from the body's axes to the parent's.

        The matrix, its Euler parameters, the axes of the joint's angles in the body's axes, and the angular
        acceleration of two angles with constant rates.
        """
        g, v, model = self.graph, self.v, self.model
        mine, other = (joint.of_b, joint.of_a) if link.forward else (joint.of_a, joint.of_b)
        to_parent = v.transpose(
            _three_rows(v, [n for d in other for n in model.direction(d)])
        )  # columns are directions
        to_body = v.transpose(_three_rows(v, [n for d in mine for n in model.direction(d)]))
        sign = g.one if link.forward else g.constant(-1.0)
        if joint.turn == "fixed":
            turn = v.product(to_parent, v.transpose(to_body))
            return turn, parameters_of_matrix(g, turn), {}, v.zero
        if joint.turn == "axis":
            (label,) = labels_of_link(model.mechanism, link)[1]
            own_angle = self.add_coordinate(link.body, label)
            q, i = own_angle.value, own_angle.number
            c, s = g.call("cos", q), g.mul(sign, g.call("sin", q))
            z = g.zero
            about_axis: Matrix = ((c, g.neg(s), z), (s, c, z), (z, z, g.one))
            turn = v.product(v.product(to_parent, about_axis), v.transpose(to_body))
            half = elementary_rotation(g, g.mul(sign, q), 3)
            euler = compose_rotations(
                g,
                compose_rotations(g, parameters_of_matrix(g, to_parent), half),
                inverse_rotation(g, parameters_of_matrix(g, to_body)),
            )
            axis = v.scale(sign, v.triple(model.direction(mine[2])))
            return turn, euler, {i: axis}, v.zero
        (one, qa, rate_a, _), (two, qb, rate_b, _) = (
            self.add_coordinate(link.body, label) for label in labels_of_link(model.mechanism, link)[1]
        )
        fa, sa, za = (v.triple(model.direction(d)) for d in joint.of_a)
        fb, sb, zb = (v.triple(model.direction(d)) for d in joint.of_b)
        c1, s1, c2, s2 = g.call("cos", qa), g.call("sin", qa), g.call("cos", qb), g.call("sin", qb)
        # the cross: its second axis, the product of both, its first axis; in the axes of the first and the second body
        in_a = v.add(v.scale(c1, fa), v.scale(s1, sa)), v.sub(v.scale(c1, sa), v.scale(s1, fa)), za
        in_b = zb, v.neg(v.add(v.scale(s2, fb), v.scale(c2, sb))), v.sub(v.scale(c2, fb), v.scale(s2, sb))
        into_a, into_b = v.transpose(in_a), v.transpose(in_b)
        flip = parameters_of_matrix(
            g,
            v.product(
                ((g.zero, g.zero, g.one), (g.zero, g.constant(-1.0), g.zero), (g.one, g.zero, g.zero)),
                _three_rows(v, [n for d in (fb, sb, zb) for n in d]),
            ),
        )
        of_a = parameters_of_matrix(g, v.transpose((fa, sa, za)))
        forwards = compose_rotations(
            g,
            compose_rotations(g, of_a, elementary_rotation(g, qa, 3)),
            compose_rotations(g, elementary_rotation(g, qb, 1), flip),
        )
        product = g.mul(rate_a, rate_b)
        if link.forward:
            turn = v.product(into_a, v.transpose(into_b))
            return turn, forwards, {one: in_b[2], two: zb}, v.scale(product, in_b[1])
        turn = v.product(into_b, v.transpose(into_a))
        return (
            turn,
            inverse_rotation(g, forwards),
            {one: v.neg(za), two: v.neg(in_a[0])},
            v.neg(v.scale(product, in_a[1])),
        )

    def _name_coordinates(self, name: str, is_point: bool, p: PlacedBody) -> None:
        """Store the coordinates and velocities of a body by their names."""
        v = self.v
        place = v.add(p.at, v.matrix_times(p.axes, p.centre))
        speed = v.matrix_times(p.axes, v.add(p.velocity, v.cross(p.omega, p.centre)))
        labels = ("x", "y", "z", "vx", "vy", "vz")
        self.names |= {f"{name}.{n}": x for n, x in zip(labels, (*place, *speed), strict=True)}
        if not is_point:
            self.names |= {f"{name}.e{k}": e for k, e in enumerate(p.euler)}
            self.names |= {f"{name}.w{axis}": w for axis, w in zip("xyz", p.omega, strict=True)}

    def frame(self, body: str) -> list[int]:
        """Return the nodes of a frame's slots."""
        p, v = self.placed[body], self.v
        return [*p.at, *(n for row in p.axes for n in row), *v.matrix_times(p.axes, p.velocity), *p.omega]

    def accelerations(self, rates: tuple[int, ...]) -> dict[str, int]:
        """Return the centre-of-mass and angular accelerations by the names of their velocities."""
        v, accelerations = self.v, dict[str, int]()
        for body in self.model.mechanism.bodies:
            p = self.placed[body.name]
            moving = [(rates[i], motion) for i, motion in sorted(p.columns.items()) if i >= 0]
            alpha = v.add(p.alpha, *(v.scale(rate, about) for rate, (about, _) in moving))
            at = v.add(p.bias, *(v.scale(rate, along) for rate, (_, along) in moving))
            at = v.add(at, v.matrix_times(v.acceleration_matrix(p.omega, alpha), p.centre))
            at = v.add(v.matrix_times(p.axes, at), self.gravity)
            accelerations |= {f"{body.name}.v{axis}": x for axis, x in zip("xyz", at, strict=True)}
            if not body.is_point:
                accelerations |= {f"{body.name}.w{axis}": x for axis, x in zip("xyz", alpha, strict=True)}
        return accelerations

    def speed(self, body: str) -> list[int]:
        """Return the velocity of a centre of mass in body axes."""
        p = self.placed[body]
        return list(self.v.add(p.velocity, self.v.cross(p.omega, p.centre)))

    def force_over_velocities(self, body: str, force: list[int]) -> dict[int, int]:
        """Return nothing: gravity is an acceleration of the ground."""
        return {}

    def dynamics(self, forces: list[int]) -> tuple[tuple[MassBlock, ...], list[int], DriverPower | None]:
        """Return M and f of the state and the power of drivers; `forces` are over the velocities of bodies."""
        bodies = Composite(self.model, self.placed, forces)
        mass, f = bodies.mass_entries(), bodies.generalized_forces()
        blocks, own = self.mass_without_prescribed(mass), [f[i] for i in range(self.size)]
        return blocks, own, power_of_drivers(self.graph, self.coordinates, mass, f)

    def metric_of_bodies(self) -> tuple[MassBlock, ...]:
        """Return the metric of the velocities of bodies, pulled back."""
        nothing = [self.graph.zero] * len(self.velocities)
        return self.mass_without_prescribed(Composite(self.model, self.placed, nothing, alike=True).mass_entries())


def _three_rows(v: Vectors, nodes: Sequence[int]) -> Matrix:
    return v.triple(nodes[:3]), v.triple(nodes[3:6]), v.triple(nodes[6:])
