"""Modal bodies at the outputs of a run: whether linear modes still hold there.

Modes are linear: they leave out how forces along a body change its stiffness, and that a turn moves a point along an
arc. Under a force N on an interface the stiffness that is left out is about N / (c k_t L) of what there is, where k_t
is the least translational stiffness of an interface with another held, L the distance of the two, and c near 5 for a
cantilever, whose floating frame turns with it, but 3.3 between two pins. Motions differ by up to twice that share after
some periods. The third measure is for what flies: turning at a speed Omega adds some Omega^2 to the squares of a body's
frequencies.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.describe.formulas.evaluate import evaluate
from symgen.describe.mechanism import AnyBody, Mechanism
from symgen.describe.modal_body import CarriedInterface, Modal
from symgen.result.points import rotation_matrices

if TYPE_CHECKING:
    from symgen.run.single.outcome import Motion

Array = NDArray[np.float64]

#: Largest force on an interface over k_t L, where a joint holds the turn of an interface of the body and where none
#: does: motions are then off by some 3 % of the deflection.
MOST_PUSHED, MOST_PUSHED_ON_PINS = 0.085, 0.04
#: Largest turn of an interface [rad], and largest angular velocity over the lowest frequency of the free body.
MOST_TURNED, MOST_SPUN = 0.1, 0.1
ADVICE = "linear modes leave out what that does to the stiffness: more bodies in a row, or [beams], have it"


class _Doubt(NamedTuple):
    """How far a limit is exceeded, as a factor, and the sentence."""

    factor: float
    sentence: str


def warning_on_modes(mechanism: Mechanism, parameters: Mapping[str, float], motion: Motion) -> str | None:
    """Return a sentence about the modal body that is farthest beyond what linear modes can do, None where none is.

    Parameters
    ----------
    mechanism, parameters
        The mechanism, and values of its parameters.
    motion : Motion
        Its outputs, in coordinates of bodies.
    """
    bent = (body for body in mechanism.bodies if body.modal is not None)
    doubts = [doubt for body in bent for doubt in _doubts(mechanism, parameters, motion, body)]
    worst = max(doubts, default=None)
    return None if worst is None or worst.factor <= 1.0 else f"{worst.sentence}: {ADVICE}"


def _doubts(mechanism: Mechanism, parameters: Mapping[str, float], motion: Motion, body: AnyBody) -> Iterator[_Doubt]:
    assert body.modal is not None
    gravity = np.array([evaluate(e, parameters, "mechanism.gravity") for e in mechanism.gravity])
    moving = _Moving.of_body(mechanism, motion, body, body.modal)
    most = MOST_PUSHED if _holds_turn(mechanism, body.name) else MOST_PUSHED_ON_PINS
    for other in mechanism.bodies:
        if (carried := other.carried) is None or carried.host != body.name:
            continue
        limit = carried.load.stiffness * carried.load.length
        pushed = float(np.linalg.norm(moving.forces_on(carried, gravity), axis=1).max(initial=0.0))
        share = pushed / limit if limit > 0.0 else 0.0
        words = f"interface {other.name} carries {pushed:.3g} N, {share:.2g} times k_t L = {limit:.3g} N"
        yield _Doubt(share / most, f"{words}, where {most:g} is the most")
        turned = float(np.linalg.norm(moving.m @ np.array(carried.turn), axis=1).max(initial=0.0))
        words = f"interface {other.name} is turned by {turned:.2g} rad against its body"
        yield _Doubt(turned / MOST_TURNED, f"{words}, where {MOST_TURNED:g} rad is the most")
    spin = float(np.linalg.norm(moving.omega, axis=1).max(initial=0.0))
    lowest = float(np.sqrt(min(body.modal.stiffness) / body.modal.mass))
    words = f"{body.name} turns at {spin:.3g} rad/s, {spin / lowest:.2g} times its lowest frequency"
    yield _Doubt(spin / lowest / MOST_SPUN, f"{words}, where {MOST_SPUN:g} is the most")


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
    def of_body(cls, mechanism: Mechanism, motion: Motion, body: AnyBody, modal: Modal) -> _Moving:
        q, v = motion.compiled.info.parts(motion.states)
        before = mechanism.bodies[: [b.name for b in mechanism.bodies].index(body.name)]
        first_q, first_v = sum(len(b.coordinates) for b in before), sum(len(b.speeds) for b in before)
        d, count = len(mechanism.gravity), len(modal.stiffness)
        turn, r = (1, 1) if d == 2 else (4, 3)
        own_q, own_v = q[:, first_q : first_q + d + turn + count], v[:, first_v : first_v + d + r + count]
        own_a = motion.accelerations[:, first_v : first_v + d + r + count]
        return cls(
            rotation_matrices(own_q[:, d : d + turn]),
            own_a[:, :d],
            own_v[:, d : d + r],
            own_a[:, d : d + r],
            own_q[:, d + turn :],
            own_a[:, d + r :],
        )

    def forces_on(self, carried: CarriedInterface, gravity: Array) -> Array:
        """Return the force on an interface in body axes, whatever exerts it, shape (k, d)."""
        load = carried.load
        falling = (np.swapaxes(self.axes, 1, 2) @ (self.acceleration - gravity)[:, :, np.newaxis])[:, :, 0]
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
