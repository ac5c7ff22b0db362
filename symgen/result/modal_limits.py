"""Modal bodies at some states: whether linear modes still hold there.

Modes are linear: they leave out how forces along a body change its stiffness, and that a turn moves a point along an
arc. Under a force N on an interface the stiffness that is left out is about N / (c k_t L) of what there is, where k_t
is the least translational stiffness of an interface with another held, L the distance of the two, and c near 5 for a
cantilever, whose floating frame turns with it, but 3.3 between two pins. Motions differ by up to twice that share after
some periods. The third measure is for what flies: turning at a speed Omega adds some Omega^2 to the squares of a body's
frequencies.

Two measures see what passes through no interface, as shares of the stiffness: the thrust of a part that is held at both
ends and bends, so that it stretches; and the weight of what stands on a part. Couples in space bend a part about the
axis that nothing else bends it about, with an error of a tenth of the square of the measure. Of a body without
interfaces, the slopes of its outline are judged. Turns and slopes are the limits of a body that loads stiffen.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import AnyBody, Mechanism
from symgen.describe.modal_body import CarriedInterface, HeldStretch, Modal, ModalOutline
from symgen.result.part_limits import MotionOfBodies, PartLimit
from symgen.result.points import rotation_matrices

Array = NDArray[np.float64]

#: Largest slope of the outline of a body without interfaces [rad].
MOST_SLOPED = 0.1
#: Euler's load of a strut between pins over k_t L; the share of the stiffness which that load leaves that turns of ends
#: may change, by an eighth of their square as in an elastica; and the least that is left.
EULER, MOST_CHANGED, LEAST_LEFT = np.pi**2 / 3.0, 0.02, 0.01
#: Largest couple between two interfaces over the root of the angular stiffnesses that it couples.
MOST_COUPLED = 0.47


class _Most(NamedTuple):
    """Limits of modes that loads stiffen, or do not.

    Attributes
    ----------
    pushed, pushed_on_pins : float
        Largest force on an interface over k_t L, where a joint holds the turn of an interface and where none does.
    turned : float
        Largest turn of an interface [rad].
    spun : float
        Largest angular velocity over the lowest frequency of the free body.
    stretched, weighed : float
        Largest share of the stiffness that a stretch between held interfaces, or weight, adds or takes away.
    advice : str
        What to do.
    """

    pushed: float
    pushed_on_pins: float
    turned: float
    spun: float
    stretched: float
    weighed: float
    advice: str


#: At these, motions are off by 2 to 3 % of the deflection; stiffened ones, as few modes do not take the shape.
LINEAR = _Most(
    *(0.085, 0.04, 0.1, 0.1, 0.02, 0.02),
    "linear modes leave out what that does to the stiffness: more bodies in a row, or [beams], have it",
)
STIFFENED = _Most(
    *(10.0, 10.0, 0.3, 1.0, 1.0, 0.5), "few modes do not follow that: more bodies in a row, or [beams], do"
)


def limits_of_modes(mechanism: Mechanism) -> Iterator[PartLimit]:
    """Yield the limits of modal bodies: forces on interfaces, their turns, and how fast the body turns.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    """
    for body in mechanism.bodies:
        if body.modal is not None:
            yield from _limits_of_body(mechanism, body, body.modal)


def _limits_of_body(mechanism: Mechanism, body: AnyBody, modal: Modal) -> Iterator[PartLimit]:
    most = STIFFENED if modal.stiffened else LINEAR
    pushed_most = most.pushed if _holds_turn(mechanism, body.name) else most.pushed_on_pins

    def moving(motion: MotionOfBodies) -> _Moving:
        return _Moving.of_body(mechanism, motion, body, modal)

    for other in mechanism.bodies:
        if (carried := other.carried) is None or carried.host != body.name:
            continue
        own, limit = carried, carried.load.stiffness * carried.load.length

        def pushed(
            parameters: Mapping[str, float],
            motion: MotionOfBodies,
            own: CarriedInterface = own,
            limit: float = limit,
        ) -> Array:
            gravity = np.array([evaluate_formula(e, parameters, "mechanism.gravity") for e in mechanism.gravity])
            forces = np.linalg.norm(moving(motion).forces_on(own, gravity), axis=1)
            return forces / (limit * pushed_most) if limit > 0.0 else np.zeros_like(forces)

        def say_pushed(factor: float, name: str = other.name, limit: float = limit) -> str:
            share = factor * pushed_most
            words = f"interface {name} carries {share * limit:.3g} N, {share:.2g} times k_t L = {limit:.3g} N"
            return f"{words}, where {pushed_most:g} is the most: {most.advice}"

        def turned(_: Mapping[str, float], motion: MotionOfBodies, own: CarriedInterface = own) -> Array:
            turns = moving(motion).m @ np.array(own.turn)
            return np.asarray(np.linalg.norm(turns, axis=1) / most.turned)

        def say_turned(factor: float, name: str = other.name) -> str:
            words = f"interface {name} is turned by {factor * most.turned:.2g} rad against its body"
            return f"{words}, where {most.turned:g} rad is the most: {most.advice}"

        yield PartLimit(pushed, say_pushed)
        yield PartLimit(turned, say_turned)
        if modal.stiffened and limit > 0.0 and not _holds_turn(mechanism, body.name):
            yield _limit_of_buckling(mechanism, other.name, own, moving)
    yield from _limit_of_slopes(mechanism, body, modal, moving)
    yield from _limits_inside(mechanism, body, modal, most, moving)
    lowest = float(np.sqrt(min(modal.stiffness) / modal.mass))

    def spun(_: Mapping[str, float], motion: MotionOfBodies) -> Array:
        return np.linalg.norm(moving(motion).omega, axis=1) / (lowest * most.spun)

    def say_spun(factor: float) -> str:
        spin = factor * most.spun
        words = f"{body.name} turns at {spin * lowest:.3g} rad/s, {spin:.2g} times its lowest frequency"
        return f"{words}, where {most.spun:g} is the most: {most.advice}"

    yield PartLimit(spun, say_spun)


def _limit_of_buckling(
    mechanism: Mechanism, name: str, own: CarriedInterface, moving: Callable[[MotionOfBodies], _Moving]
) -> PartLimit:
    """Return the limit of a stiffened strut between pins: how far it turns, the less, the nearer Euler's load is."""
    euler = EULER * own.load.stiffness * own.load.length

    def bent(parameters: Mapping[str, float], motion: MotionOfBodies) -> Array:
        gravity = np.array([evaluate_formula(e, parameters, "mechanism.gravity") for e in mechanism.gravity])
        now, place = moving(motion), np.array(own.place)
        away = place / max(float(np.linalg.norm(place)), np.finfo(float).tiny)
        left = np.abs(1.0 + now.forces_on(own, gravity) @ away / euler)
        turns = np.linalg.norm(now.m @ np.array(own.turn), axis=1)
        return np.asarray(turns**2 / 8.0 / np.maximum(left, LEAST_LEFT) / MOST_CHANGED)

    def say_bent(factor: float) -> str:
        words = f"interface {name} turns, and its part is so near to buckling, that the turn changes"
        words = f"{words} {factor * MOST_CHANGED:.2g} of the stiffness that is left"
        return f"{words}, where {MOST_CHANGED:g} is the most: {STIFFENED.advice}"

    return PartLimit(bent, say_bent)


def _limit_of_slopes(
    mechanism: Mechanism, body: AnyBody, modal: Modal, moving: Callable[[MotionOfBodies], _Moving]
) -> Iterator[PartLimit]:
    """Yield the limit of a body without interfaces: slopes of its outline."""
    if not any(x.carried is not None and x.carried.host == body.name for x in mechanism.bodies):
        slopes = _slopes_of(modal.outline)

        def sloped(_: Mapping[str, float], motion: MotionOfBodies) -> Array:
            turned = np.linalg.norm(np.einsum("sia,ki->ksa", slopes, moving(motion).m), axis=2)
            return np.asarray(turned.max(axis=1, initial=0.0) / MOST_SLOPED)

        def say_sloped(factor: float) -> str:
            words = f"{body.name} bends by slopes of {factor * MOST_SLOPED:.2g} rad"
            return f"{words}, where {MOST_SLOPED:g} rad is the most: {LINEAR.advice}"

        yield PartLimit(sloped, say_sloped)


def _limits_inside(
    mechanism: Mechanism, body: AnyBody, modal: Modal, most: _Most, moving: Callable[[MotionOfBodies], _Moving]
) -> Iterator[PartLimit]:
    """Yield the limits of what passes through no interface: stretches between held interfaces, and weight."""
    holders = _holders(mechanism)
    for stretch in modal.stretches:
        first, second = (f"{body.name}.{end}" for end in stretch.ends)
        if not holders.get(first, set()) & holders.get(second, set()):
            continue

        def stretched(_: Mapping[str, float], motion: MotionOfBodies, own: HeldStretch = stretch) -> Array:
            m = moving(motion).m
            energy = np.maximum(m * m @ np.array(modal.stiffness), np.finfo(float).tiny)
            grown = np.einsum("ki,ij,kj->k", m, np.array(own.growth), m)
            return np.asarray(2.0 * own.stiffness * grown**2 / energy / most.stretched)

        def say_stretched(factor: float, first: str = first, second: str = second) -> str:
            words = f"{body.name} is held at {first} and {second}, and bends so far that the stretch between them adds"
            words = f"{words} {factor * most.stretched:.2g} of its stiffness"
            return f"{words}, where {most.stretched:g} is the most: {most.advice}"

        yield PartLimit(stretched, say_stretched)

    for couple in modal.couples:
        share = np.array(couple.share)

        def coupled(_: Mapping[str, float], motion: MotionOfBodies, share: Array = share) -> Array:
            return np.asarray(np.linalg.norm(moving(motion).m @ share.T, axis=1) / MOST_COUPLED)

        def say_coupled(factor: float, ends: tuple[str, str] = couple.ends) -> str:
            words = (
                f"the couple from {body.name}.{ends[0]} to {body.name}.{ends[1]} is {factor * MOST_COUPLED:.2g} times"
            )
            return f"{words} the angular stiffness across it, where {MOST_COUPLED:g} is the most: {most.advice}"

        yield PartLimit(coupled, say_coupled)

    def weighed(parameters: Mapping[str, float], motion: MotionOfBodies) -> Array:
        gravity = np.array([evaluate_formula(e, parameters, "mechanism.gravity") for e in mechanism.gravity])
        return np.asarray(np.abs(moving(motion).falling(gravity)) @ np.array(modal.softening) / most.weighed)

    def say_weighed(factor: float) -> str:
        words = f"the weight of {body.name} changes its stiffness by {factor * most.weighed:.2g} where it is softest"
        return f"{words}, where {most.weighed:g} is the most: {most.advice}"

    if any(modal.softening):
        yield PartLimit(weighed, say_weighed)


def _slopes_of(outline: ModalOutline) -> Array:
    """Return by how much modes turn the lines of an outline, shape (lines, modes, d) [1/m]."""
    points, shapes = np.array(outline.points), np.array(outline.shapes)
    start, end = np.array(outline.lines, dtype=np.int64).reshape(-1, 2).T
    steps, moved = points[end] - points[start], shapes[end] - shapes[start]
    lengths = np.linalg.norm(steps, axis=1)[:, np.newaxis, np.newaxis]
    along = steps[:, np.newaxis] / lengths
    return np.asarray((moved - np.sum(moved * along, axis=2, keepdims=True) * along) / lengths)


def _holders(mechanism: Mechanism) -> dict[str, set[str]]:
    """Return the bodies that hold each interface in its place; bodies that joints make one piece are one."""
    piece = {name: name for joint in mechanism.joints for name in joint.bodies}
    holders = dict[str, set[str]]()
    carried = {x.name for x in mechanism.bodies if x.carried is not None}
    held = list[tuple[str, str]]()
    for joint in mechanism.joints:
        if len(joint.bodies) != 2 or sum(row.unit == "m" for row in joint.rows) < len(mechanism.gravity):
            continue
        one, other = joint.bodies
        held += [(one, other), (other, one)]
        if not carried & {one, other} and sum(row.unit == "rad" for row in joint.rows) == (
            1 if len(mechanism.gravity) == 2 else 3
        ):
            kept, gone = piece[one], piece[other]
            piece = {name: kept if root == gone else root for name, root in piece.items()}
    for one, other in held:
        if one in carried:
            holders.setdefault(one, set()).add(piece[other])
    return holders


def _holds_turn(mechanism: Mechanism, body: str) -> bool:
    """Whether joints and drivers hold an interface of a modal body in its turn."""
    held = dict[str, int]()
    for joint in mechanism.joints:
        for name in joint.bodies:
            held[name] = held.get(name, 0) + sum(row.unit == "rad" for row in joint.rows)
    interfaces = (x.name for x in mechanism.bodies if x.carried is not None and x.carried.host == body)
    return any(held.get(name, 0) >= (1 if mechanism.space == "planar" else 3) for name in interfaces)


class _Moving(NamedTuple):
    """A modal body at k outputs.

    Attributes
    ----------
    axes : Array, shape (k, d, d)
        Rotation matrices.
    acceleration : Array, shape (k, d)
        Of the centre of mass, in ground axes.
    omega, alpha : Array, shape (k, r)
        Angular velocity and acceleration, in body axes.
    m, rates : Array, shape (k, modes)
        Coordinates of modes, and their second derivatives.
    """

    axes: Array
    acceleration: Array
    omega: Array
    alpha: Array
    m: Array
    rates: Array

    @classmethod
    def of_body(cls, mechanism: Mechanism, motion: MotionOfBodies, body: AnyBody, modal: Modal) -> _Moving:
        before = mechanism.bodies[: [b.name for b in mechanism.bodies].index(body.name)]
        first_q, first_v = sum(len(b.coordinates) for b in before), sum(len(b.speeds) for b in before)
        d, count = len(mechanism.gravity), len(modal.stiffness)
        turn, r = (1, 1) if d == 2 else (4, 3)
        own_q = motion.q[:, first_q : first_q + d + turn + count]
        own_v = motion.v[:, first_v : first_v + d + r + count]
        own_a = motion.a[:, first_v : first_v + d + r + count]
        return cls(
            rotation_matrices(own_q[:, d : d + turn]),
            own_a[:, :d],
            own_v[:, d : d + r],
            own_a[:, d : d + r],
            own_q[:, d + turn :],
            own_a[:, d + r :],
        )

    def falling(self, gravity: Array) -> Array:
        """Return the acceleration of the centre of mass less gravity, in body axes, shape (k, d)."""
        return np.asarray((np.swapaxes(self.axes, 1, 2) @ (self.acceleration - gravity)[:, :, np.newaxis])[:, :, 0])

    def forces_on(self, carried: CarriedInterface, gravity: Array) -> Array:
        """Return the force on an interface in body axes, whatever exerts it, shape (k, d)."""
        load, falling = carried.load, self.falling(gravity)
        spread = np.einsum("abc,kbc->ka", np.array(load.spread), self._accelerations_of_rotation())
        elastic = self.m @ np.array(load.elastic).T + self.rates @ np.array(load.modal).T
        return np.asarray(elastic + falling @ np.array(load.shifted).T + spread)

    def _accelerations_of_rotation(self) -> Array:
        """Return the matrices of alpha x a + omega x (omega x a), shape (k, d, d)."""
        skew, rising = (_skew(x) for x in (self.omega, self.alpha))
        return np.asarray(rising + skew @ skew)


def _skew(turns: Array) -> Array:
    """Return the matrices of the products with turns, shape (k, 1) in the plane or (k, 3)."""
    size = 2 if turns.shape[1] == 1 else 3
    matrices = np.zeros((len(turns), size, size))
    pairs: Sequence[tuple[int, int, int]] = ((0, 1, 0),) if size == 2 else ((1, 2, 0), (2, 0, 1), (0, 1, 2))
    for i, j, k in pairs:
        matrices[:, i, j], matrices[:, j, i] = -turns[:, k], turns[:, k]
    return matrices
