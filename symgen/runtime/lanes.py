"""Many runs of one compiled model with a constant step, several at once in the lanes of vector instructions.

Lanes take the same steps side by side. What a run in a lane cannot do alone is not done here: where one comes near a
singular position, meets a suspicious pivot, exceeds a limit or fails, it is left to the loop over single runs, from its
start. So every run that ends here has gone well, and every other one has exactly the result of a single run.

Element i of lane l of every array of the lanes stands at ``LANES*i + l``; those of emitted code are parts of one array
(`symgen.ir.program.lane_bases`).
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.ir.program import LANE_COUNTERS, LANES
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.bare import bare, part
from symgen.runtime.batch_rows import begin_run, end_run
from symgen.runtime.steps import combine
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]
#: rhs(t, z) and accept(t, z).
_LANES = types.FunctionType(types.int64(_F8, _A))

_L, _SPARE = LANES, len(LANE_COUNTERS)
_NQ, _NV, _NP, _NW, _WINDINGS = e.NQ, e.NV, e.NP, e.NW, e.WINDINGS
_STOP, _STEPS, _EVALUATIONS, _OUTPUTS, _DONE = abi.STOP, abi.STEPS, abi.EVALUATIONS, abi.OUTPUTS, abi.DONE
_PHI, _DRIFT, _KINETIC, _POTENTIAL = abi.PHI * _L, abi.DRIFT * _L, abi.KINETIC * _L, abi.POTENTIAL * _L
_PIVOT, _RANK, _LENGTH, _SPEED = abi.PIVOT * _L, abi.RANK * _L, abi.LENGTH * _L, abi.SPEED * _L
_STEP_STATUS, _WINDING, _N_STATUS = abi.STEP_STATUS * _L, abi.WINDING, abi.RANK + 1
_MAX_PHI, _MAX_DRIFT, _MAX_ENERGY = abi.MAX_PHI * _L, abi.MAX_DRIFT * _L, abi.MAX_ENERGY * _L
_START, _SCALE, _POTENTIAL_START = abi.ENERGY_START * _L, abi.ENERGY_SCALE * _L, abi.POTENTIAL_START * _L
_SMALLEST, _LAST_SINE, _FALL = abi.SMALLEST_PIVOT * _L, abi.LAST_SINE * _L, abi.FALL * _L
_TIME, _LAST_TIME, _N_GAUGES, _LAST_RANK = abi.TIME, abi.LAST_TIME * _L, abi.N_GAUGES, abi.LAST_RANK
_SUSPECTS, _FAILURES, _ITERATIONS = (LANE_COUNTERS.index(name) * _L for name in ("suspects", "failures", "iterations"))
_RUN_ITERATIONS = abi.ITERATIONS
#: Behind the gauges of all lanes: the largest coordinate, the rank at the start, and 1 for lanes left to single runs.
_LARGEST, _FIRST_RANK, _ODD = ((abi.N_GAUGES + i) * LANES for i in range(3))
_N_LANE_GAUGES = abi.N_GAUGES + 3
#: Angles beyond this lose digits in the reduction of emitted sines.
_LARGEST_ANGLE = 1e5


@jit()
def padded(n: int) -> int:
    """Return the elements of a state with those that fill up unrolled vectors; as in `symgen.ir.program.lane_bases`."""
    return (n + 3) // 4 * 4


@jit()
def keep_lanes(y: Any, w: Any, gauges: Any, work: int, lanes: int) -> None:
    """Update the largest violations and energy errors of all lanes."""
    for l in range(lanes):
        error = abs(w[_KINETIC + l] + w[_POTENTIAL + l] - gauges[_START + l] - y[work * _L + l])
        phi, drift = w[_PHI + l], w[_DRIFT + l]
        gauges[_MAX_PHI + l] = phi if phi > gauges[_MAX_PHI + l] else gauges[_MAX_PHI + l]
        gauges[_MAX_DRIFT + l] = drift if drift > gauges[_MAX_DRIFT + l] else gauges[_MAX_DRIFT + l]
        gauges[_MAX_ENERGY + l] = error if error > gauges[_MAX_ENERGY + l] else gauges[_MAX_ENERGY + l]


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
    for l in range(lanes):
        gauges[_LARGEST + l] = 0.0
    for i in range(nq):
        for l in range(lanes):
            size = abs(y[i * _L + l])
            gauges[_LARGEST + l] = size if size > gauges[_LARGEST + l] else gauges[_LARGEST + l]
    for i in range(nq, n - 1):
        for l in range(lanes):
            size = abs(y[i * _L + l])
            w[_SPEED + l] = size if size > w[_SPEED + l] else w[_SPEED + l]
    root = math.sqrt(limits[3])
    warn, most_phi, most_drift, most_energy = limits[3], limits[0], limits[1], limits[2]
    work = (n - 1) * _L
    going = 0.0
    for l in range(lanes):
        largest = gauges[_LARGEST + l]
        length = largest if largest > w[_LENGTH + l] else w[_LENGTH + l]
        kinetic, done = w[_KINETIC + l], abs(y[work + l])
        error = kinetic + w[_POTENTIAL + l] - gauges[_START + l] - y[work + l]
        change = abs(w[_POTENTIAL + l] - gauges[_POTENTIAL_START + l])
        scale = kinetic if kinetic > gauges[_SCALE + l] else gauges[_SCALE + l]
        scale = change if change > scale else scale
        scale = done if done > scale else scale
        gauges[_SCALE + l] = scale
        pivot, smallest = w[_PIVOT + l], gauges[_SMALLEST + l]
        gauges[_SMALLEST + l] = pivot if pivot < smallest else smallest
        sine = math.sqrt(pivot if pivot > 0.0 else 0.0)
        elapsed, fall, before = t - gauges[_LAST_TIME + l], gauges[_FALL + l], gauges[_LAST_SINE + l]
        met = (fall > 0.0) & (before - fall * elapsed < root)
        gauges[_FALL + l] = (before - sine) / elapsed if elapsed > 0.0 else 0.0
        gauges[_LAST_TIME + l] = t
        gauges[_LAST_SINE + l] = sine
        phi, drift = w[_PHI + l], w[_DRIFT + l]
        bad = met | (pivot < warn) | (w[_RANK + l] != gauges[_FIRST_RANK + l])
        bad |= (not phi <= most_phi * length) | (not drift <= most_drift * w[_SPEED + l])
        bad |= (not abs(error) <= most_energy * scale + 1e-9) | (not largest <= _LARGEST_ANGLE)
        bad |= (counters[_SUSPECTS + l] > 0.0) | (counters[_FAILURES + l] > 0.0)
        odd = 1.0 if bad else gauges[_ODD + l]
        gauges[_ODD + l] = odd
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


@jit()
def run_lanes(
    rhs: Any,
    accept: Any,
    start: Any,
    column: Any,
    value: Any,
    nodes: Any,
    n_stages: int,
    nq: int,
    n: int,
    n_p: int,
    nw: int,
    windings: int,
    h: float,
    until: float,
    z: Any,
    before: Any,
    stages: Any,
    times: Any,
    outputs: Any,
    gauges: Any,
    limits: Any,
    control: Any,
    lanes: int,
) -> int:
    """Integrate all lanes as `symgen.runtime.explicit.fixed_steps` does one run; return the steps, -1 if stopped."""
    width = padded(n) * _L
    y, rate, at = part(z, 0, width), part(z, width, width), 2 * width + n_p * _L
    w, counters = part(z, at, nw * _L), part(z, at + nw * _L, _SPARE * _L)
    tiny = 1e-9 * h
    t, index, out = 0.0, 0, 0
    accept(t, z)
    for l in range(lanes):
        gauges[_START + l] = w[_KINETIC + l] + w[_POTENTIAL + l]
        gauges[_POTENTIAL_START + l] = w[_POTENTIAL + l]
    going = watch_lanes(t, y, nq, n, w, counters, gauges, limits, lanes)
    while out < times.shape[0] and times[out] <= t + tiny:
        store_lanes(out, y, w, n, windings, outputs)
        out += 1
    for i in range(width):
        before[i] = y[i]
    while t < until - tiny and going > 0.0:
        if control[_STOP] != 0:
            return -1
        following = (index + 1) * h
        step = h
        if following > until - tiny:
            following = until
            step = until - t
        partial = out < times.shape[0] and times[out] < following - tiny
        if partial:
            following = times[out]
            step = following - t
        for l in range(lanes):
            w[_STEP_STATUS + l] = step
        for s in range(n_stages):
            combine(width, step, start[s], start[s + 1], column, value, before, stages, y)
            rhs(t + nodes[s] * step, z)
            for i in range(width):
                stages[s * width + i] = rate[i]
        combine(width, step, start[n_stages], start[n_stages + 1], column, value, before, stages, y)
        control[_EVALUATIONS] += n_stages
        accept(following, z)
        if partial:
            keep_lanes(y, w, gauges, n - 1, lanes)
            store_lanes(out, y, w, n, windings, outputs)
            out += 1
            continue
        for i in range(width):
            before[i] = y[i]
        t = following
        index += 1
        going = watch_lanes(t, y, nq, n, w, counters, gauges, limits, lanes)
        if out < times.shape[0] and times[out] <= t + tiny:
            store_lanes(out, y, w, n, windings, outputs)
            out += 1
    return index


@jit(
    _I8(
        *(_LANES, _LANES, abi.RHS, abi.RHS, abi.ACCEPT, abi.OBSERVE, _I, _I, _A, _A, _I8, _F8, _F8, _I, _I, _A, _A, _A),
        *(_A, _M, _M, _M, _M, _M, _M, _I, _A, _A, _A, _A, _I, _A, _I, _A, _I),
    )
)
def lane_runs(
    lanes_rhs: Any,
    lanes_accept: Any,
    rates: Any,
    rates_confirm: Any,
    accept: Any,
    observe: Any,
    start: Any,
    column: Any,
    value: Any,
    nodes: Any,
    n_stages: int,
    h: float,
    until: float,
    sizes: Any,
    selected: Any,
    ys: Any,
    ps: Any,
    ws: Any,
    times: Any,
    states: Any,
    status: Any,
    accelerations: Any,
    multipliers: Any,
    observed: Any,
    angles: Any,
    picks: Any,
    values: Any,
    summary: Any,
    limits: Any,
    gauges: Any,
    control: Any,
    events: Any,
    iw: Any,
    room: Any,
    left: Any,
) -> int:
    """Run the selected rows, `LANES` at a time; the other arguments are as for `symgen.runtime.batch.fixed_runs`.

    Parameters
    ----------
    lanes_rhs, lanes_accept : emitted functions
        For lanes; the other ones are those of single runs.
    room : Array
        Working memory: `room_of_lanes` numbers.
    left : Array of int, shape (k,)
        1 for rows that are left to the loop over single runs; written.

    Returns
    -------
    int
        How many of the selected rows were worked on: all of them, unless the run was stopped.
    """
    nq, n, n_p, nw = sizes[_NQ], sizes[_NQ] + sizes[_NV] + 1, sizes[_NP], sizes[_NW]
    windings, k_times = sizes[_WINDINGS], times.shape[0]
    ys, ps, ws, room = bare(ys), bare(ps), bare(ws), bare(room)
    width, full = n + _N_STATUS + windings, padded(n)
    numbers = 2 * full + n_p + nw + _SPARE
    z, before = part(room, 0, numbers * _L), part(room, numbers * _L, full * _L)
    at = (numbers + full) * _L
    stages, lane_gauges = part(room, at, n_stages * full * _L), part(room, at + n_stages * full * _L, _N_LANE_GAUGES * _L)
    at += (n_stages * full + _N_LANE_GAUGES) * _L
    one, outputs = part(room, at, nw), part(room, at + nw, k_times * width * _L)
    p_at, w_at = 2 * full * _L, (2 * full + n_p) * _L
    total = selected.shape[0]
    lanes = _L + 0 * control[_STOP]  # a number that the compiler does not know
    for g in range(0, total, _L):
        if control[_STOP] != 0:
            return int(g)
        for l in range(_L):
            r = selected[min(g + l, total - 1)]  # the last group repeats its last row
            for i in range(n):
                z[i * _L + l] = ys[r * n + i]
            for i in range(n_p):
                z[p_at + i * _L + l] = ps[r * n_p + i]
            for i in range(nw):
                z[w_at + i * _L + l] = ws[r * nw + i]
            for i in range(_SPARE):
                z[w_at + (nw + i) * _L + l] = 0.0
            begin_run(part(ys, r * n, n), part(ws, r * nw, nw), iw, sizes, limits, gauges, control)
            for i in range(_N_GAUGES):
                lane_gauges[i * _L + l] = gauges[i]
            lane_gauges[_FIRST_RANK + l] = control[_LAST_RANK]
            lane_gauges[_ODD + l] = 0.0
        steps = run_lanes(
            lanes_rhs,
            lanes_accept,
            start,
            column,
            value,
            nodes,
            n_stages,
            nq,
            n,
            n_p,
            nw,
            windings,
            h,
            until,
            z,
            before,
            stages,
            times,
            outputs,
            lane_gauges,
            limits,
            control,
            lanes,
        )
        if steps < 0:
            return int(g)
        evaluations = control[_EVALUATIONS]
        for l in range(min(_L, total - g)):
            r = selected[g + l]
            left[r] = 1 if lane_gauges[_ODD + l] != 0.0 else 0
            if left[r] == 1:
                continue
            for i in range(nw):
                one[i] = z[w_at + i * _L + l]
            for k in range(k_times):
                for i in range(n):
                    states[k, i] = outputs[(k * width + i) * _L + l]
                for i in range(_N_STATUS + windings):
                    status[k, i] = outputs[(k * width + n + i) * _L + l]
            for i in range(_N_GAUGES):
                gauges[i] = lane_gauges[i * _L + l]
            gauges[_TIME] = until
            for i in range(iw.shape[0]):
                iw[i] = 0
            iw[_RUN_ITERATIONS] = int(z[w_at + nw * _L + _ITERATIONS + l])
            control[_STEPS], control[_OUTPUTS], control[_EVALUATIONS] = steps, k_times, evaluations
            end_run(
                _DONE,
                r,
                rates,
                rates_confirm,
                accept,
                observe,
                sizes,
                part(ps, r * n_p, n_p),
                one,
                part(ws, r * nw, nw),
                iw,
                times,
                states,
                status,
                accelerations,
                multipliers,
                observed,
                angles,
                picks,
                values,
                summary,
                gauges,
                control,
                events,
            )
    return int(total)


def room_of_lanes(n: int, n_stages: int, n_p: int, nw: int, windings: int, n_times: int) -> int:
    """Return the length of the working memory of `lane_runs`."""
    full = (n + 3) // 4 * 4
    numbers = (3 + n_stages) * full + n_p + nw + _SPARE + _N_LANE_GAUGES
    return LANES * (numbers + n_times * (n + _N_STATUS + windings)) + nw
