"""What happens at each accepted state of runs in lanes: measures and limits, as `symgen.runtime.watch` has them."""

from __future__ import annotations

import math
from typing import Any

from symgen.ir.program import LANE_COUNTERS, LANES
from symgen.runtime import abi
from symgen.store.jit import jit

_L = LANES
_PHI, _DRIFT, _KINETIC, _POTENTIAL = abi.PHI * _L, abi.DRIFT * _L, abi.KINETIC * _L, abi.POTENTIAL * _L
_PIVOT, _RANK, _LENGTH, _SPEED = abi.PIVOT * _L, abi.RANK * _L, abi.LENGTH * _L, abi.SPEED * _L
_WINDING, _N_STATUS = abi.WINDING, abi.RANK + 1
_MAX_PHI, _MAX_DRIFT, _MAX_ENERGY = abi.MAX_PHI * _L, abi.MAX_DRIFT * _L, abi.MAX_ENERGY * _L
_START, _SCALE, _POTENTIAL_START = abi.ENERGY_START * _L, abi.ENERGY_SCALE * _L, abi.POTENTIAL_START * _L
_SMALLEST, _LAST_SINE, _FALL = abi.SMALLEST_PIVOT * _L, abi.LAST_SINE * _L, abi.FALL * _L
_LAST_TIME = abi.LAST_TIME * _L
_SUSPECTS, _FAILURES = LANE_COUNTERS.index("suspects") * _L, LANE_COUNTERS.index("failures") * _L
#: Behind the gauges of all lanes: the largest coordinate, the rank at the start, and 1 for lanes left to single runs.
LARGEST, FIRST_RANK, ODD = abi.N_GAUGES * _L, (abi.N_GAUGES + 1) * _L, (abi.N_GAUGES + 2) * _L
N_LANE_GAUGES = abi.N_GAUGES + 3
#: Angles beyond this lose digits in the reduction of emitted sines.
_LARGEST_ANGLE = 1e5


@jit()
def padded(n: int) -> int:
    """Return the elements of a state with those that fill up unrolled vectors; as in `symgen.ir.program.lane_bases`."""
    return (n + 3) // 4 * 4


@jit()
def keep_lanes(y: Any, w: Any, gauges: Any, work: int, lanes: int) -> None:
    """Update the largest violations and energy errors of all lanes."""
    for lane in range(lanes):
        error = abs(w[_KINETIC + lane] + w[_POTENTIAL + lane] - gauges[_START + lane] - y[work * _L + lane])
        phi, drift = w[_PHI + lane], w[_DRIFT + lane]
        gauges[_MAX_PHI + lane] = phi if phi > gauges[_MAX_PHI + lane] else gauges[_MAX_PHI + lane]
        gauges[_MAX_DRIFT + lane] = drift if drift > gauges[_MAX_DRIFT + lane] else gauges[_MAX_DRIFT + lane]
        gauges[_MAX_ENERGY + lane] = error if error > gauges[_MAX_ENERGY + lane] else gauges[_MAX_ENERGY + lane]


@jit()
def watch_lanes(
    t: float, y: Any, nq: int, n: int, w: Any, counters: Any, gauges: Any, limits: Any, lanes: int
) -> float:
    """Judge accepted states as `symgen.runtime.watch.watch` does; mark lanes that cannot go on; return how many can.

    Parameters
    ----------
    t : float
        Time [s].
    y, nq, n : Array, int, int
        States, coordinates, and length of a state.
    w, counters, gauges, limits : Array
        Scratch, what emitted code counts, what runs keep, and what they are judged by.
    lanes : int
        How many there are.
    """
    keep_lanes(y, w, gauges, n - 1, lanes)
    for lane in range(lanes):
        gauges[LARGEST + lane] = 0.0
    for i in range(nq):
        for lane in range(lanes):
            size = abs(y[i * _L + lane])
            gauges[LARGEST + lane] = size if size > gauges[LARGEST + lane] else gauges[LARGEST + lane]
    for i in range(nq, n - 1):
        for lane in range(lanes):
            size = abs(y[i * _L + lane])
            w[_SPEED + lane] = size if size > w[_SPEED + lane] else w[_SPEED + lane]
    root = math.sqrt(limits[3])
    warn, most_phi, most_drift, most_energy = limits[3], limits[0], limits[1], limits[2]
    work = (n - 1) * _L
    going = 0.0
    for lane in range(lanes):
        largest = gauges[LARGEST + lane]
        length = largest if largest > w[_LENGTH + lane] else w[_LENGTH + lane]
        kinetic, done = w[_KINETIC + lane], abs(y[work + lane])
        error = kinetic + w[_POTENTIAL + lane] - gauges[_START + lane] - y[work + lane]
        change = abs(w[_POTENTIAL + lane] - gauges[_POTENTIAL_START + lane])
        scale = kinetic if kinetic > gauges[_SCALE + lane] else gauges[_SCALE + lane]
        scale = change if change > scale else scale
        scale = done if done > scale else scale
        gauges[_SCALE + lane] = scale
        pivot, smallest = w[_PIVOT + lane], gauges[_SMALLEST + lane]
        gauges[_SMALLEST + lane] = pivot if pivot < smallest else smallest
        sine = math.sqrt(pivot if pivot > 0.0 else 0.0)
        elapsed, fall, before = t - gauges[_LAST_TIME + lane], gauges[_FALL + lane], gauges[_LAST_SINE + lane]
        met = (fall > 0.0) & (before - fall * elapsed < root)
        gauges[_FALL + lane] = (before - sine) / elapsed if elapsed > 0.0 else 0.0
        gauges[_LAST_TIME + lane] = t
        gauges[_LAST_SINE + lane] = sine
        phi, drift = w[_PHI + lane], w[_DRIFT + lane]
        bad = met | (pivot < warn) | (w[_RANK + lane] != gauges[FIRST_RANK + lane])
        bad |= (not phi <= most_phi * length) | (not drift <= most_drift * w[_SPEED + lane])
        bad |= (not abs(error) <= most_energy * scale + 1e-9) | (not largest <= _LARGEST_ANGLE)
        bad |= (counters[_SUSPECTS + lane] > 0.0) | (counters[_FAILURES + lane] > 0.0)
        odd = 1.0 if bad else gauges[ODD + lane]
        gauges[ODD + lane] = odd
        going += 1.0 - odd
    return float(going)


@jit()
def store_lanes(k: int, y: Any, w: Any, n: int, windings: int, outputs: Any) -> None:
    """Keep output `k` of all lanes: states, then what ``accept`` measured."""
    at = k * (n + _N_STATUS + windings) * _L
    for i in range(n * _L):
        outputs[at + i] = y[i]
    at += n * _L
    for i in range(_N_STATUS * _L):
        outputs[at + i] = w[i]
    at += _N_STATUS * _L
    for i in range(windings * _L):
        outputs[at + i] = w[_WINDING * _L + i]
