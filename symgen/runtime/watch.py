"""What happens at each accepted state: measures, limits and passages near singular positions."""

from __future__ import annotations

import math
from typing import Any

from symgen.ir.numerics import SKIP
from symgen.runtime import abi
from symgen.runtime.vectors import finite, largest

_PHI_MEASURE, _DRIFT_MEASURE = abi.PHI_MEASURE, abi.DRIFT_MEASURE
_PHI, _DRIFT, _KINETIC, _POTENTIAL, _PIVOT, _RANK = abi.PHI, abi.DRIFT, abi.KINETIC, abi.POTENTIAL, abi.PIVOT, abi.RANK
_LENGTH, _SPEED, _TIME = abi.LENGTH, abi.SPEED, abi.TIME
_MAX_PHI, _MAX_DRIFT, _MAX_ENERGY = abi.MAX_PHI, abi.MAX_DRIFT, abi.MAX_ENERGY
_START, _SCALE, _POTENTIAL_START = abi.ENERGY_START, abi.ENERGY_SCALE, abi.POTENTIAL_START
_LIMIT_PHI, _LIMIT_DRIFT, _LIMIT_ENERGY = abi.LIMIT_PHI, abi.LIMIT_DRIFT, abi.LIMIT_ENERGY
_WARN, _SMALLEST, _ENTRY, _JUMP = abi.WARN_PIVOT, abi.SMALLEST_PIVOT, abi.ENERGY_ENTRY, abi.MAX_ENERGY_JUMP
_EVENTS, _IN_ZONE, _LAST_RANK = abi.EVENTS, abi.IN_ZONE, abi.LAST_RANK
_N_EVENT, _MAX_EVENTS = abi.N_EVENT, abi.MAX_EVENTS
_IN, _OUT, _EVENT_RANK, _EVENT_PIVOT = abi.EVENT_IN, abi.EVENT_OUT, abi.EVENT_RANK, abi.EVENT_PIVOT
_MASKED, _SHORTEST, _VANISHED = abi.MASKED, abi.SHORTEST_ROW, abi.VANISHED
_LAST_SHORT, _SHORT_FALL = abi.LAST_SHORT, abi.SHORT_FALL
_LAST_TIME, _LAST_SINE, _FALL = abi.LAST_TIME, abi.LAST_SINE, abi.FALL
_STEPS, _REJECTED, _MARK, _MARKED = abi.STEPS, abi.REJECTED, abi.MARK, abi.MARKED
_DONE, _NOT_FINITE, _POSITION, _VELOCITY, _ENERGY = abi.DONE, abi.NOT_FINITE, abi.POSITION, abi.VELOCITY, abi.ENERGY

#: Attempts over which progress is judged, at least: as many as all before them.
_WINDOW = 10_000
#: A row that is an angle has lost its gradient where this part of it is left.
VANISHING = 1e-2
#: An error of the energy below this part of kinetic and potential energy is no failure.
NEGLIGIBLE = 1e-9


def remember_rank(sizes: Any, run: Any) -> None:
    """Take the rank of D D^T that the start was found to have as that before the first state."""
    rank = masked = 0
    for i in range(sizes.m):
        if run.w[sizes.mask + i] > 0.0:
            masked += 1
        elif run.w[sizes.pivots + i] >= SKIP:
            rank += 1
    run.control[_LAST_RANK], run.control[_MASKED] = rank, masked


def begin(run: Any) -> None:
    """Take the energies of the first accepted state as those the balance starts from."""
    run.gauges[_START] = run.w[_KINETIC] + run.w[_POTENTIAL]
    run.gauges[_POTENTIAL_START] = run.w[_POTENTIAL]


def keep_maxima(sizes: Any, run: Any, y: Any) -> float:
    """Update the largest violations and energy error from the status of the state `y`; return the energy error."""
    w, gauges = run.w, run.gauges
    if w[_PHI] > gauges[_MAX_PHI]:
        gauges[_MAX_PHI] = w[_PHI]
    if w[_DRIFT] > gauges[_MAX_DRIFT]:
        gauges[_MAX_DRIFT] = w[_DRIFT]
    error = w[_KINETIC] + w[_POTENTIAL] - gauges[_START] - y[sizes.nq + sizes.nv]
    if abs(error) > gauges[_MAX_ENERGY]:
        gauges[_MAX_ENERGY] = abs(error)
    return float(error)


def approach(h: float, gauges: Any) -> float:
    """Return the step that may be taken: near a singular position not more than half the way to it.

    Inside the zone that counts as near the step is free again, so a passage costs about as many further steps as there
    are halvings from the last regular step to the zone.
    """
    sine, fall = gauges[_LAST_SINE], gauges[_FALL]
    if fall > 0.0 and sine * sine >= gauges[_WARN] and h * fall > 0.5 * sine:
        h = 0.5 * sine / fall
    short, fall = gauges[_LAST_SHORT], gauges[_SHORT_FALL]
    if fall > 0.0 and h * fall > 0.5 * short:
        h = 0.5 * short / fall
    return h


def stuck(span: Any, run: Any, t: float) -> bool:
    """Return whether an adaptive run has taken, or at its present rate would take, more attempts than it may.

    The rate is that of a window of attempts as long as all before it: a passage that takes many of them is none.
    """
    attempts, mark = run.control[_STEPS] + run.control[_REJECTED], run.control[_MARKED]
    if attempts - mark < max(_WINDOW, mark):
        return bool(attempts >= span.most)
    rate = (t - run.clock[_MARK]) / (attempts - mark)
    if mark > 0 and span.until - t > rate * (span.most - attempts):
        return True
    run.clock[_MARK], run.control[_MARKED] = t, attempts
    return False


def watch(sizes: Any, run: Any, y: Any, t: float) -> int:
    """Judge an accepted state; return how the loop has to end, or `DONE` to go on.

    Parameters
    ----------
    sizes : Sizes
        Of the model.
    run : Run
        Its scratch holds the status that ``accept`` left; the speed scale follows the largest speed so far.
    y : Array
        The state.
    t : float
        Its time [s].
    """
    w, gauges, control, events = run.w, run.gauges, run.control, run.events
    run.clock[_TIME] = t
    moving, behind = sizes.nq, sizes.nq + sizes.nv
    work = y[behind]
    # the scale that corrections go by stays that of the start
    length = max(w[_LENGTH], largest(sizes.width, y, run.metric, 0, moving))
    speed = w[_SPEED] = max(w[_SPEED], largest(sizes.width, y, run.metric, moving, behind))
    error = keep_maxima(sizes, run, y)
    scale = max(w[_KINETIC], abs(w[_POTENTIAL] - gauges[_POTENTIAL_START]), abs(work))
    if scale > gauges[_SCALE]:
        gauges[_SCALE] = scale

    pivot, rank = w[_PIVOT], int(w[_RANK])
    if pivot < gauges[_SMALLEST]:
        gauges[_SMALLEST] = pivot
    # the root of a pivot is the sine of an angle: it falls to 0 and rises again in a straight line, so a step that
    # would have met 0 has passed a singular position even if both its ends are far from it
    sine = math.sqrt(max(pivot, 0.0))
    elapsed = t - gauges[_LAST_TIME]
    met = gauges[_FALL] > 0.0 and gauges[_LAST_SINE] - gauges[_FALL] * elapsed < math.sqrt(gauges[_WARN])
    near = pivot < gauges[_WARN] or met
    entered = gauges[_LAST_TIME] if met and pivot >= gauges[_WARN] else t
    gauges[_FALL] = (gauges[_LAST_SINE] - sine) / elapsed if elapsed > 0.0 else 0.0
    # so does the length of a gradient that vanishes; what the row says behind that nobody knows
    short, fell = math.sqrt(max(w[_SHORTEST], 0.0)), gauges[_SHORT_FALL]
    vanished = short < VANISHING or (fell > 0.0 and gauges[_LAST_SHORT] - fell * elapsed < VANISHING)
    gauges[_SHORT_FALL] = (gauges[_LAST_SHORT] - short) / elapsed if elapsed > 0.0 else 0.0
    gauges[_LAST_TIME], gauges[_LAST_SINE], gauges[_LAST_SHORT] = t, sine, short
    if near or control[_IN_ZONE] == 1 or rank != control[_LAST_RANK]:
        if near and control[_IN_ZONE] == 0:
            gauges[_ENTRY] = error
        elif not near and control[_IN_ZONE] == 1:
            gauges[_JUMP] = max(gauges[_JUMP], abs(error - gauges[_ENTRY]))
        k = control[_EVENTS] - 1
        fresh = (near and control[_IN_ZONE] == 0) or (
            not near and control[_IN_ZONE] == 0 and rank != control[_LAST_RANK]
        )
        if fresh:
            k += 1
            control[_EVENTS] += 1
            if k < _MAX_EVENTS:
                events[k * _N_EVENT + _IN] = entered
                events[k * _N_EVENT + _EVENT_PIVOT] = pivot
                events[k * _N_EVENT + _EVENT_RANK] = rank
        if 0 <= k < _MAX_EVENTS:
            events[k * _N_EVENT + _OUT] = t
            events[k * _N_EVENT + _EVENT_PIVOT] = min(pivot, events[k * _N_EVENT + _EVENT_PIVOT])
            events[k * _N_EVENT + _EVENT_RANK] = min(rank, events[k * _N_EVENT + _EVENT_RANK])
        control[_IN_ZONE] = 1 if near else 0
        control[_LAST_RANK] = rank

    if not (math.isfinite(w[_PHI] + w[_DRIFT] + error) and finite(sizes.width, y)):
        return _NOT_FINITE
    if vanished:
        return _VANISHED
    if w[_PHI_MEASURE] > gauges[_LIMIT_PHI] * length:
        return _POSITION
    if w[_DRIFT_MEASURE] > gauges[_LIMIT_DRIFT] * speed:
        return _VELOCITY
    # energies are no more exact than the rounding of what they are sums of
    if abs(error) > gauges[_LIMIT_ENERGY] * gauges[_SCALE] + NEGLIGIBLE * (w[_KINETIC] + abs(w[_POTENTIAL])):
        return _ENERGY
    return _DONE
