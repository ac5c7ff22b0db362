"""Dead centres: what holds a mechanism there, what would have to jump, and the sentence of every motion that ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from symgen.compile.loopcode.exact import plain_form
from symgen.run.effects.locking import MOST_NAMED, name_jumps
from symgen.run.layout import abi
from symgen.run.layout.model_arrays import velocity_of_coordinate
from symgen.run.layout.probe import Ready

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.single.outcome import Outcome

    Array = NDArray[np.float64]

#: How the sentence on one begins.
DEAD_CENTRE = "dead centre"
#: Rows below this share of the largest one do not hold.
_HOLDS = 1e-9**0.5
#: Kind of the joints that drive.
DRIVER = "driver"
#: How a run ends that a dead centre may end.
ENDS = (abi.NO_PROGRESS, abi.TINY_STEP, abi.CORRECTION)


def jacobian_at(compiled: CompiledModel, t: float, y: Array, p: Array, w: Array) -> Array:
    """Return D at a state, of numbers: angles count as the distance that they move a body's end; shape (m, nv)."""
    w = w.copy()
    Ready(compiled.model.geometry, abi.MEASURE)(t, y.copy(), p, w)
    weights = np.array([w[abi.LENGTH] if row.unit == "rad" else 1.0 for row in compiled.info.rows])
    return np.asarray(weights[:, np.newaxis] * compiled.jacobian(w) * np.sqrt(compiled.section(w, "gauge")))


def moving_names(info: ModelInfo) -> list[str]:
    """Return the coordinate that each velocity changes, by name; of an angular velocity in space its own name."""
    spun = {first + k for first, _ in info.spins for k in range(4)}
    positions = {velocity_of_coordinate(i, info): c.name for i, c in enumerate(info.coordinates) if i not in spun}
    return [positions.get(j, velocity.name) for j, velocity in enumerate(info.velocities)]


def free_and_held(
    mechanism: Mechanism, compiled: CompiledModel, t: float, y: Array, p: Array, w: Array
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the coordinates that are free at a singular position, and the drivers that hold nothing there.

    Parameters
    ----------
    mechanism, compiled : Mechanism, CompiledModel
        In the coordinates of bodies.
    t, y, p, w
        Time, state, parameters and scratch.
    """
    info = compiled.info
    active = np.flatnonzero(compiled.section(w, "mask") == 0.0)
    left, _, right = np.linalg.svd(jacobian_at(compiled, t, y, p, w)[active])
    moving, holding = np.abs(right[-1]), np.abs(left[:, -1])
    farthest = np.zeros(MOST_NAMED, dtype=np.int64)
    plain_form(name_jumps)(moving, len(moving), farthest)
    joints = dict.fromkeys(info.rows[i].joint for i in active[holding > _HOLDS * holding.max()])
    kinds = {joint.name: joint.kind for joint in mechanism.joints}
    names = moving_names(info)
    return tuple(names[j] for j in farthest if j >= 0), tuple(name for name in joints if kinds[name] == DRIVER)


def dead_centre(t: float, drivers: Sequence[str], free: Sequence[str]) -> str:
    """Return the sentence on a motion that ends at a dead centre, at a time [s]."""
    who = " and ".join(f"'{name}'" for name in drivers)
    names = ", ".join(free)
    return f"{DEAD_CENTRE} at t = {t:.9g} s: {who or 'the drivers'} can go no further; {names} would have to jump"


def dead_centre_at_end(mechanism: Mechanism, outcome: Outcome) -> str:
    """Return the sentence on the dead centre that ends a run whose drivers lock; empty where none does.

    Parameters
    ----------
    mechanism : Mechanism
        With the inputs of the run in their places.
    outcome : Outcome
        In the coordinates of bodies.
    """
    state = outcome.simulation.state
    sine, fall = float(state.gauges[abi.LAST_SINE]), float(state.gauges[abi.FALL])
    rest = 0.5 * sine / fall if fall > 0.0 else 0.0  # its square falls to 0 in a straight line
    near = state.control[abi.IN_ZONE] == 1 or 0.0 < rest < 2.0 * state.clock[abi.STEP]
    if outcome.code not in ENDS or not near or not len(outcome.states):
        return ""
    compiled = outcome.compiled
    own = compiled is outcome.simulation.compiled
    y = state.y[: compiled.info.ny] if own else outcome.states[-1]
    free, drivers = free_and_held(mechanism, compiled, outcome.end, y, outcome.p, outcome.w)
    t = round(outcome.end + rest, int(-np.log10(rest))) if 0.0 < rest < 1.0 else outcome.end
    return dead_centre(float(f"{t:.6g}"), drivers, free) if drivers else ""
