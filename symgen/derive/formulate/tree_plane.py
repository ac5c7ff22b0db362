"""Bodies of the plane on a tree of joints: positions, velocities, M and f from the angles of bodies and displacements.

The origin of a body's frame is its joint's point, so that the angle of the body itself does not move it. Angles are
relative to the ground: the entry of M between two angles is then one product of two vectors, without sums of angles.
Bodies that do not rotate relative to their parent share its angle.

Composite bodies: with m, mu and J the mass, first and second moment of a body's subtree about the joint's point
(bodies with an angle of their own count as points in their joints), the velocity of an angle gives the momentum
perp(mu), and that of a displacement along e the momentum m e; Featherstone, Rigid Body Dynamics Algorithms (2008),
chapter 6, with angles relative to the ground. The accelerations at v' = 0 are propagated outwards and their forces
inwards, as in the recursive Newton-Euler algorithm (chapter 5).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from symgen.base.vocabulary.measures import GROUND
from symgen.derive.formulate.equations import DriverPower, MassBlock
from symgen.derive.formulate.joint_tree import Tree
from symgen.derive.formulate.of_time import power_of_drivers
from symgen.derive.formulate.vector_algebra import Pair, PlaneVectors
from symgen.describe.mechanism import Body, Vec
from symgen.describe.parts.topology import labels_of_link
from symgen.describe.spanning_tree import Link

if TYPE_CHECKING:
    pass


@dataclass
class _PlanarPlace:
    """The place and motion of a body as nodes.

    Attributes
    ----------
    at, velocity, bias : pair of int
        Of the joint's point: position, velocity, and acceleration where v' is 0.
    axes : pair of int
        Cosine and sine of the angle.
    turners : tuple of int
        Indices of the velocities that rotate the body: one of the state, and those of drivers.
    angle, spin, gain : int
        Its angle, its angular velocity, and the prescribed part of its angular acceleration.
    follows : bool
        Whether it rotates with its parent.
    arm : pair of int
        From the parent's point to its own.
    local : pair of int, optional
        The arm in the parent's frame, if constant there.
    columns : mapping of int to pair
        Velocity of the state, or of a driver -> derivative of `velocity` by it.
    slides : mapping of int to pair
        Velocities of the body's own displacements -> their directions.
    sliding, pulled : pair of int
        The velocity of the arm by these, and the prescribed part of its rate.
    centre : pair of int
        The centre of mass from the joint's point, in the body's frame.
    """

    link: Link
    at: Pair
    velocity: Pair
    bias: Pair
    axes: Pair
    turners: tuple[int, ...]
    angle: int
    spin: int
    gain: int
    follows: bool
    arm: Pair
    local: Pair | None
    columns: dict[int, Pair]
    slides: dict[int, Pair] = field(default_factory=dict)
    sliding: Pair = (0, 0)
    pulled: Pair = (0, 0)
    centre: Pair = (0, 0)

    @property
    def rotating_velocity(self) -> int:
        """The velocity of the state that rotates the body, or -1."""
        return max((i for i in self.turners if i >= 0), default=-1)


class PlanarTree(Tree):
    """Planar bodies on a tree."""

    def place_ground(self) -> None:
        """Place the ground."""
        g, self.v = self.graph, PlaneVectors(self.graph)
        nothing, still = (g.zero, g.zero), (g.one, g.zero)
        ground = Link(GROUND)
        self.placed = {
            GROUND: _PlanarPlace(
                *(ground, nothing, nothing, nothing, still, (), g.zero, g.zero, g.zero, False, nothing, nothing),
                *({}, {}, nothing, nothing, nothing),
            )
        }
        self.children: dict[str, list[str]] = {GROUND: []}

    def velocities_of_bodies(self) -> tuple[list[int], list[int]]:
        """Return u and c of all bodies."""
        g, velocities, biases = self.graph, list[int](), list[int]()
        for body in self.model.mechanism.bodies:
            assert isinstance(body, Body), "bodies of the plane"
            p = self.placed[body.name]
            velocities += p.velocity
            biases += p.bias
            self.columns += [{i: c[k] for i, c in p.columns.items() if c[k] != g.zero} for k in range(2)]
            if not body.is_point:
                velocities.append(p.spin)
                biases.append(p.gain)
                self.columns.append(dict.fromkeys(p.turners, g.one))
            self._name_coordinates(body, p)
        return velocities, biases

    def place_body(self, link: Link) -> None:
        """Place the body of a link."""
        g, model = self.graph, self.model
        body = model.mechanism.body(link.body)
        assert isinstance(body, Body), "bodies of the plane"
        self.children[link.body] = []
        self.children[link.parent].append(link.body)
        joint, parent = link.articulation, self.placed[link.parent]
        if joint is None:
            self._place_free_body(link, body)
            return
        carrier, own = (joint.a, joint.b) if link.forward else (joint.b, joint.a)
        model.references[link.body] = own.point
        lengths, _ = labels_of_link(model.mechanism, link)
        slid = [self.add_coordinate(link.body, label) for label in lengths]
        sign = g.one if link.forward else g.constant(-1.0)
        driven = self.prescribed.get((link.body, "angle"))
        gain, follows = g.zero, joint.turn == "fixed" or driven is not None
        turners: tuple[int, ...] = ()
        if follows:
            angle = model.expression(joint.angle) if driven is None else driven.value
            change = angle if link.forward else g.neg(angle)
            turners, turned, spin, gain = parent.turners, g.add(parent.angle, change), parent.spin, parent.gain
            if driven is not None:
                driven = driven._replace(rate=g.mul(sign, driven.rate))
                self.coordinates[driven.number] = driven
                turners = (*turners, driven.number)
                spin = g.add(spin, driven.rate)
                gain = g.add(gain, g.mul(sign, driven.acceleration))
            c, s = g.call("cos", change), g.call("sin", change)
            (a, b) = parent.axes
            axes = (g.sub(g.mul(a, c), g.mul(b, s)), g.add(g.mul(b, c), g.mul(a, s)))
        elif body.is_point:
            turned, spin, axes = g.zero, g.zero, (g.one, g.zero)
        else:
            own_angle = self.add_coordinate(link.body, "theta")
            turners, turned, spin, gain = (own_angle.number,), *own_angle[1:]
            axes = (g.call("cos", turned), g.call("sin", turned))
        local = self.v.pair(model.local(carrier))
        arm = self.v.rotate(parent.axes, local)
        sliding = pulled = (g.zero, g.zero)
        slides = dict[int, Pair]()
        for x, direction in zip(slid, joint.slides, strict=True):
            holder = parent.axes if direction.body == link.parent else axes
            along = self.v.pair(model.direction(direction))
            e = self.v.scale(sign, self.v.rotate(holder, along))
            slides[x.number] = e
            arm = self.v.add(arm, self.v.scale(x.value, e))
            sliding = self.v.add(sliding, self.v.scale(x.rate, e))
            pulled = self.v.add(pulled, self.v.scale(x.acceleration, e))
        w = parent.spin
        at = self.v.add(parent.at, arm)
        velocity = self.v.add(self.v.add(parent.velocity, self.v.scale(w, self.v.perp(arm))), sliding)
        bias = self.v.sub(parent.bias, self.v.scale(g.mul(w, w), arm))
        bias = self.v.add(bias, self.v.scale(g.mul(g.constant(2.0), w), self.v.perp(sliding)))
        bias = self.v.add(self.v.add(bias, pulled), self.v.scale(parent.gain, self.v.perp(arm)))
        columns = dict(parent.columns)
        for turner in parent.turners:
            before = columns.get(turner, (g.zero, g.zero))
            columns[turner] = self.v.add(before, self.v.perp(arm))
        columns |= slides
        self.placed[link.body] = _PlanarPlace(
            link,
            at,
            velocity,
            bias,
            axes,
            turners,
            turned,
            spin,
            gain,
            follows,
            arm,
            None if slides else local,
            columns,
            slides,
            sliding,
            pulled,
            self._centre_from_joint(body, own.point),
        )

    def _place_free_body(self, link: Link, body: Body) -> None:
        """Place a body without a joint: its centre of mass moves freely."""
        g = self.graph
        at = g.input("q", self.count), g.input("q", self.count + 1)
        x, y = self.add_velocity(), self.add_velocity()
        velocity = g.input("v", x), g.input("v", y)
        slides = {x: (g.one, g.zero), y: (g.zero, g.one)}
        nothing = (g.zero, g.zero)
        if body.is_point:
            turners: tuple[int, ...] = ()
            axes, turned, spin = (g.one, g.zero), g.zero, g.zero
        else:
            turned, group = g.input("q", self.count), self.add_velocity()
            turners, spin = (group,), g.input("v", group)
            axes = (g.call("cos", turned), g.call("sin", turned))
        self.placed[link.body] = _PlanarPlace(
            *(link, at, velocity, nothing, axes, turners, turned, spin, g.zero, False, at, None, dict(slides), slides),
            *(nothing, nothing, nothing),
        )

    def _centre_from_joint(self, body: Body, reference: Vec) -> Pair:
        """Return the centre of mass relative to the joint's point, in the body's frame."""
        g = self.graph
        com = [self.model.expression(e) for e in body.centre_of_mass]
        at = [self.model.expression(e) for e in reference]
        return g.sub(com[0], at[0]), g.sub(com[1], at[1])

    def _name_coordinates(self, body: Body, p: _PlanarPlace) -> None:
        """Store the coordinates and velocities of a body by their names."""
        rho = self.v.rotate(p.axes, p.centre)
        place = self.v.add(p.at, rho)
        speed = self.v.add(p.velocity, self.v.scale(p.spin, self.v.perp(rho)))
        self.names |= {f"{body.name}.{n}": x for n, x in zip(("x", "y", "vx", "vy"), (*place, *speed), strict=True)}
        if not body.is_point:
            self.names |= {f"{body.name}.theta": p.angle, f"{body.name}.omega": p.spin}

    def frame(self, body: str) -> list[int]:
        """Return the nodes of a frame's slots."""
        p = self.placed[body]
        return [*p.at, *p.axes, *p.velocity, p.spin]

    def accelerations(self, rates: tuple[int, ...]) -> dict[str, int]:
        """Return the accelerations of centres of mass and angles, by the names of their velocities."""
        g, accelerations = self.graph, dict[str, int]()
        for body in self.model.mechanism.bodies:
            p = self.placed[body.name]
            rho, w = self.v.rotate(p.axes, p.centre), p.spin
            turning = g.add(rates[p.rotating_velocity], p.gain) if p.rotating_velocity >= 0 else p.gain
            total = self.v.sub(p.bias, self.v.scale(g.mul(w, w), rho))
            total = self.v.add(total, self.v.scale(turning, self.v.perp(rho)))
            for i, c in sorted(p.columns.items()):
                if i >= 0:
                    total = self.v.add(total, self.v.scale(rates[i], c))
            accelerations |= {f"{body.name}.vx": total[0], f"{body.name}.vy": total[1]}
            if not body.is_point:
                accelerations[f"{body.name}.omega"] = turning
        return accelerations

    def speed(self, body: str) -> list[int]:
        """Return the velocity of a centre of mass in ground axes."""
        return [self.names[f"{body}.{name}"] for name in ("vx", "vy")]

    def force_over_velocities(self, body: str, force: list[int]) -> dict[int, int]:
        """Return a force at the centre of mass, in ground axes, over the velocities of bodies."""
        p, first = self.placed[body], self.model.first[body]
        forces = {first: force[0], first + 1: force[1]}
        if not self.model.mechanism.body(body).is_point:
            forces[first + 2] = self.v.cross(self.v.rotate(p.axes, p.centre), self.v.pair(force))
        return forces

    # -- M and f -------------------------------------------------------------------------------------------------------

    def metric_of_bodies(self) -> tuple[MassBlock, ...]:
        """Return the metric of the velocities of bodies, pulled back: M for masses and inertias of 1."""
        return self.dynamics([self.graph.zero] * len(self.velocities), alike=True)[0]

    def dynamics(
        self, forces: list[int], alike: bool = False
    ) -> tuple[tuple[MassBlock, ...], list[int], DriverPower | None]:
        """Return M and f of the state and the power of drivers; `forces` are over the velocities of bodies."""
        g, model = self.graph, self.model
        masses, moments, seconds = dict[str, int](), dict[str, Pair](), dict[str, int]()
        pushes, turns = dict[str, Pair](), dict[str, int]()
        for name in reversed(list(self.placed)):
            if name == GROUND:
                continue
            body, p = model.mechanism.body(name), self.placed[name]
            assert isinstance(body, Body), "bodies of the plane"
            m = g.one if alike else model.expression(body.mass)
            fixed = self.v.scale(m, p.centre)  # the part of the first moment that is constant in the body's frame
            second = g.mul(m, g.dot(p.centre, p.centre))
            if not body.is_point:
                second = g.add(g.one if alike or body.inertia is None else model.expression(body.inertia), second)
            first, w = model.first[name], p.spin
            push: Pair = (forces[first], forces[first + 1])
            turn = g.zero if body.is_point else forces[first + 2]
            total, moving, shared, following = m, (g.zero, g.zero), (g.zero, g.zero), g.zero
            for child in self.children[name]:
                c, heavy = self.placed[child], masses[child]
                total = g.add(total, heavy)
                if c.local is not None:
                    fixed = self.v.add(fixed, self.v.scale(heavy, c.local))
                    second = g.add(second, g.mul(heavy, g.dot(c.local, c.local)))
                else:
                    moving = self.v.add(moving, self.v.scale(heavy, c.arm))
                    second = g.add(second, g.mul(heavy, g.dot(c.arm, c.arm)))
                push = self.v.add(push, pushes[child])
                turn = g.add(turn, self.v.cross(c.arm, pushes[child]))
                turning = g.mul(g.constant(2.0), g.mul(w, heavy))
                lag = self.v.add(self.v.scale(turning, self.v.perp(c.sliding)), self.v.scale(heavy, c.pulled))
                push = self.v.sub(push, lag)
                turn = g.sub(turn, self.v.cross(c.arm, lag))
                if c.follows:
                    shared = self.v.add(shared, moments[child])
                    both = g.mul(g.constant(2.0), g.dot(c.arm, moments[child]))
                    following = g.add(following, g.add(seconds[child], both))
                    swing = self.v.sub(self.v.scale(g.mul(w, w), c.arm), self.v.scale(p.gain, self.v.perp(c.arm)))
                    swing = self.v.sub(swing, self.v.scale(g.mul(g.constant(2.0), w), self.v.perp(c.sliding)))
                    swing = self.v.sub(swing, c.pulled)
                    turn = g.add(turn, g.add(turns[child], self.v.cross(moments[child], swing)))
            turned = self.v.add(self.v.rotate(p.axes, fixed), moving)
            masses[name], seconds[name] = total, g.add(second, following)
            moments[name] = self.v.add(turned, shared)
            push = self.v.sub(push, self.v.scale(p.gain, self.v.perp(turned)))
            pushes[name] = self.v.add(push, self.v.scale(g.mul(w, w), turned))
            turns[name] = g.sub(turn, g.mul(p.gain, second))
        for name in pushes:  # the accelerations of the points themselves
            p = self.placed[name]
            turns[name] = g.sub(turns[name], self.v.cross(moments[name], p.bias))
            pushes[name] = self.v.sub(pushes[name], self.v.scale(masses[name], p.bias))
        entries: dict[tuple[int, int], int] = {}
        own = forces[model.size :]
        f = dict.fromkeys(range(self.size), g.zero)
        for name, p in self.placed.items():
            mu = moments.get(name, (g.zero, g.zero))
            for i, e in p.slides.items():
                momentum = self.v.scale(masses[name], e)
                for j, column in p.columns.items():
                    entry = g.dot(momentum, column)
                    if j in p.turners:
                        entry = g.add(entry, self.v.cross(mu, e))
                    entries[i, j] = entries[j, i] = entry
                entries[i, i] = masses[name]  # directions have length 1
                f[i] = g.dot(e, pushes[name])
            for k in p.turners[len(self.placed[p.link.parent].turners) if p.follows else 0 :]:
                for j, column in p.columns.items():
                    entry = g.dot(self.v.perp(mu), column)
                    if j in p.turners:  # the body rotates with it, about its point
                        entry = g.add(entry, seconds[name])
                    entries[k, j] = entries[j, k] = entry
                entries[k, k] = seconds[name]
                f[k] = turns[name]
        blocks = self.mass_without_prescribed(entries)
        driving = power_of_drivers(g, self.coordinates, entries, f)
        return blocks, [g.add(f[i], own[i]) for i in range(self.size)], driving
