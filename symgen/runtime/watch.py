"""What happens at each accepted state: measures, limits and passages near singular positions."""

from __future__ import annotations

import math
from typing import Any

from symgen.runtime import abi
from symgen.store.jit import jit

_PHI, _DRIFT, _KINETIC, _POTENTIAL, _PIVOT, _RANK = abi.PHI, abi.DRIFT, abi.KINETIC, abi.POTENTIAL, abi.PIVOT, abi.RANK
_LENGTH, _SPEED = abi.LENGTH, abi.SPEED
_TIME, _MAX_PHI, _MAX_DRIFT, _MAX_ENERGY = abi.TIME, abi.MAX_PHI, abi.MAX_DRIFT, abi.MAX_ENERGY
_START, _SCALE, _POTENTIAL_START = abi.ENERGY_START, abi.ENERGY_SCALE, abi.POTENTIAL_START
_LIMIT_PHI, _LIMIT_DRIFT, _LIMIT_ENERGY = abi.LIMIT_PHI, abi.LIMIT_DRIFT, abi.LIMIT_ENERGY
_WARN, _SMALLEST, _ENTRY, _JUMP = abi.WARN_PIVOT, abi.SMALLEST_PIVOT, abi.ENERGY_ENTRY, abi.MAX_ENERGY_JUMP
_EVENTS, _IN_ZONE, _LAST_RANK = abi.EVENTS, abi.IN_ZONE, abi.LAST_RANK
_N_EVENT, _MAX_EVENTS = abi.N_EVENT, abi.MAX_EVENTS
_IN, _OUT, _EVENT_RANK, _EVENT_PIVOT = abi.EVENT_IN, abi.EVENT_OUT, abi.EVENT_RANK, abi.EVENT_PIVOT
_LAST_TIME, _LAST_SINE, _FALL = abi.LAST_TIME, abi.LAST_SINE, abi.FALL
_DONE, _NOT_FINITE, _POSITION, _VELOCITY, _ENERGY = abi.DONE, abi.NOT_FINITE, abi.POSITION, abi.VELOCITY, abi.ENERGY


@jit()
def begin(w: Any, gauges: Any) -> None:
    """Take the energies of the first accepted state as those the balance starts from."""
    gauges[_START] = w[_KINETIC] + w[_POTENTIAL]
    gauges[_POTENTIAL_START] = w[_POTENTIAL]


@jit()
def keep_maxima(w: Any, work: float, gauges: Any) -> float:
    """Update the largest violations and energy error from the status in `w`; return the energy error."""
    if w[_PHI] > gauges[_MAX_PHI]:
        gauges[_MAX_PHI] = w[_PHI]
    if w[_DRIFT] > gauges[_MAX_DRIFT]:
        gauges[_MAX_DRIFT] = w[_DRIFT]
    error = w[_KINETIC] + w[_POTENTIAL] - gauges[_START] - work
    if abs(error) > gauges[_MAX_ENERGY]:
        gauges[_MAX_ENERGY] = abs(error)
    return float(error)


@jit()
def approach(h: float, gauges: Any) -> float:
    """Return the step that may be taken: near a singular position not more than half the way to it.

    Inside the zone that counts as near the step is free again, so a passage costs about as many further steps as there
    are halvings from the last regular step to the zone.
    """
    sine, fall = gauges[_LAST_SINE], gauges[_FALL]
    if fall > 0.0 and sine * sine >= gauges[_WARN] and h * fall > 0.5 * sine:
        return float(0.5 * sine / fall)
    return h


@jit()
def watch(t: float, y: Any, nq: int, w: Any, gauges: Any, control: Any, events: Any) -> int:
    """Judge an accepted state; return how the loop has to end, or `DONE` to go on.

    Parameters
    ----------
    t : float
        Time of the state [s].
    y, nq : Array, int
        The state (q, v, work) and the number of coordinates in it.
    w : Array
        Scratch with the status that ``accept`` left; its speed scale follows the largest speed so far.
    gauges, control, events : Array
        See `symgen.runtime.abi`; updated.
    """
    gauges[_TIME] = t
    length, speed, work = w[_LENGTH], w[_SPEED], y[y.shape[0] - 1]
    for i in range(nq):
        length = max(length, abs(y[i]))
    for i in range(nq, y.shape[0] - 1):
        speed = max(speed, abs(y[i]))
    w[_SPEED] = speed  # the length scale stays that of the start: turns that are counted do not make rods longer
    error = keep_maxima(w, work, gauges)
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
    gauges[_LAST_TIME], gauges[_LAST_SINE] = t, sine
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

    total = w[_PHI] + w[_DRIFT] + error
    if not math.isfinite(total):
        return _NOT_FINITE
    if w[_PHI] > gauges[_LIMIT_PHI] * length:
        return _POSITION
    if w[_DRIFT] > gauges[_LIMIT_DRIFT] * speed:
        return _VELOCITY
    if abs(error) > gauges[_LIMIT_ENERGY] * gauges[_SCALE] + 1e-9:
        return _ENERGY
    return _DONE
