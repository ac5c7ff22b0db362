"""Many runs of one compiled model with a constant step, several at once in the lanes of vector instructions.

Lanes take the same steps side by side. What a run in a lane cannot do alone is not done here: where one comes near a
singular position, meets a suspicious pivot, exceeds a limit or fails, it is left to the loop over single runs, from its
start. So every run that ends here has gone well, and every other one has exactly the result of a single run.

Element i of lane l of every array of the lanes stands at ``LANES*i + l``.
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.ir.program import LANES
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.bare import bare, part
from symgen.runtime.batch_rows import begin_run, end_run
from symgen.runtime.steps import combine
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]

_L = LANES
_NQ, _NV, _NP, _NW, _M_ROWS, _PIVOTS, _WINDINGS = e.NQ, e.NV, e.NP, e.NW, e.M, e.PIVOTS, e.WINDINGS
_STOP, _STEPS, _EVALUATIONS, _OUTPUTS, _DONE = abi.STOP, abi.STEPS, abi.EVALUATIONS, abi.OUTPUTS, abi.DONE
_PHI, _DRIFT, _KINETIC, _POTENTIAL = abi.PHI * _L, abi.DRIFT * _L, abi.KINETIC * _L, abi.POTENTIAL * _L
_PIVOT, _RANK, _LENGTH, _SPEED = abi.PIVOT * _L, abi.RANK * _L, abi.LENGTH * _L, abi.SPEED * _L
_STEP_STATUS, _WINDING, _N_STATUS = abi.STEP_STATUS * _L, abi.WINDING, abi.RANK + 1
_MAX_PHI, _MAX_DRIFT, _MAX_ENERGY = abi.MAX_PHI * _L, abi.MAX_DRIFT * _L, abi.MAX_ENERGY * _L
_START, _SCALE, _POTENTIAL_START = abi.ENERGY_START * _L, abi.ENERGY_SCALE * _L, abi.POTENTIAL_START * _L
_SMALLEST, _LAST_SINE, _FALL = abi.SMALLEST_PIVOT * _L, abi.LAST_SINE * _L, abi.FALL * _L
_TIME, _LAST_TIME, _N_GAUGES, _N_COUNTERS = abi.TIME, abi.LAST_TIME * _L, abi.N_GAUGES, abi.N_COUNTERS
_SUSPECTS, _FAILURES, _PROBING, _STEP = abi.SUSPECTS, abi.FAILURES, abi.PROBING, abi.STEP
#: Numbers behind the sections of ``w`` that emitted code for lanes keeps; as in `symgen.emit.lanes`.
_SPARE = 2
#: Angles beyond this lose digits in the reduction of emitted sines.
_LARGEST_ANGLE = 1e5


@jit()
def keep_lanes(y: Any, w: Any, gauges: Any, work: int, lanes: int) -> None:
    """Update the largest violations and energy errors of all lanes."""
    for l in range(lanes):
        gauges[_MAX_PHI + l] = max(gauges[_MAX_PHI + l], w[_PHI + l])
        gauges[_MAX_DRIFT + l] = max(gauges[_MAX_DRIFT + l], w[_DRIFT + l])
        error = w[_KINETIC + l] + w[_POTENTIAL + l] - gauges[_START + l] - y[work * _L + l]
        gauges[_MAX_ENERGY + l] = max(gauges[_MAX_ENERGY + l], abs(error))


@jit()
def watch_lanes(
    t: float, y: Any, nq: int, n: int, w: Any, iw: Any, gauges: Any, limits: Any, rank: Any, odd: Any, lanes: int
) -> int:
    """Judge accepted states as `symgen.runtime.watch.watch` does; mark lanes that cannot go on; return how many can.

    Parameters
    ----------
    t : float
        Time [s].
    y, nq, n : Array, int, int
        States, coordinates, and length of a state.
    w, iw, gauges, limits : Array
        Scratch, counters, what runs keep, and what they are judged by.
    rank : Array
        Rank at the start.
    odd : Array
        1 for lanes that are left to the loop over single runs; updated.
    lanes : int
        How many there are.
    """
    keep_lanes(y, w, gauges, n - 1, lanes)
    length, largest = part(gauges, _N_GAUGES * _L, _L), part(gauges, (_N_GAUGES + 1) * _L, _L)
    for l in range(lanes):
        length[l] = w[_LENGTH + l]
        largest[l] = 0.0
    for i in range(nq):
        for l in range(lanes):
            largest[l] = max(largest[l], abs(y[i * _L + l]))
    for i in range(nq, n - 1):
        for l in range(lanes):
            w[_SPEED + l] = max(w[_SPEED + l], abs(y[i * _L + l]))
    root = math.sqrt(limits[3])
    for l in range(lanes):
        length[l] = max(length[l], largest[l])
        work = y[(n - 1) * _L + l]
        error = w[_KINETIC + l] + w[_POTENTIAL + l] - gauges[_START + l] - work
        change = abs(w[_POTENTIAL + l] - gauges[_POTENTIAL_START + l])
        gauges[_SCALE + l] = max(gauges[_SCALE + l], max(w[_KINETIC + l], max(change, abs(work))))
        pivot = w[_PIVOT + l]
        gauges[_SMALLEST + l] = min(gauges[_SMALLEST + l], pivot)
        sine = math.sqrt(max(pivot, 0.0))
        elapsed = t - gauges[_LAST_TIME + l]
        fall = gauges[_FALL + l]
        met = (fall > 0.0) & (gauges[_LAST_SINE + l] - fall * elapsed < root)
        gauges[_FALL + l] = (gauges[_LAST_SINE + l] - sine) / elapsed if elapsed > 0.0 else 0.0
        gauges[_LAST_TIME + l] = t
        gauges[_LAST_SINE + l] = sine
        total = w[_PHI + l] + w[_DRIFT + l] + error
        bad = met | (pivot < limits[3]) | (w[_RANK + l] != rank[l]) | (not abs(total) < math.inf)
        bad |= (w[_PHI + l] > limits[0] * length[l]) | (w[_DRIFT + l] > limits[1] * w[_SPEED + l])
        bad |= (abs(error) > limits[2] * gauges[_SCALE + l] + 1e-9) | (largest[l] > _LARGEST_ANGLE)
        bad |= (iw[_SUSPECTS * _L + l] > 0) | (iw[_FAILURES * _L + l] > 0)
        odd[l] = 1.0 if bad else odd[l]
    going = 0
    for l in range(lanes):
        going += 1 if odd[l] == 0.0 else 0
    return going


@jit()
def store_lanes(k: int, y: Any, w: Any, n: int, windings: int, outputs: Any, lanes: int) -> None:
    """Keep output `k` of all lanes: states, then what ``accept`` measured."""
    width = n + _N_STATUS + windings
    at = k * width * _L
    for i in range(n):
        for l in range(lanes):
            outputs[at + i * _L + l] = y[i * _L + l]
    at += n * _L
    for i in range(_N_STATUS + windings):
        source = i if i < _N_STATUS else _WINDING - _N_STATUS + i
        for l in range(lanes):
            outputs[at + i * _L + l] = w[source * _L + l]


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
    windings: int,
    h: float,
    until: float,
    y: Any,
    p: Any,
    w: Any,
    iw: Any,
    trial: Any,
    stages: Any,
    times: Any,
    outputs: Any,
    gauges: Any,
    limits: Any,
    rank: Any,
    odd: Any,
    control: Any,
    lanes: int,
) -> int:
    """Integrate all lanes as `symgen.runtime.explicit.fixed_steps` does one run; return the steps, -1 if stopped."""
    tiny = 1e-9 * h
    t, index, out = 0.0, 0, 0
    accept(t, y, p, w, iw)
    for l in range(lanes):
        gauges[_START + l] = w[_KINETIC + l] + w[_POTENTIAL + l]
        gauges[_POTENTIAL_START + l] = w[_POTENTIAL + l]
    going = watch_lanes(t, y, nq, n, w, iw, gauges, limits, rank, odd, lanes)
    while out < times.shape[0] and times[out] <= t + tiny:
        store_lanes(out, y, w, n, windings, outputs, lanes)
        out += 1
    while t < until - tiny and going > 0:
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
            combine(n * _L, step, start[s], start[s + 1], column, value, y, stages, trial)
            rhs(t + nodes[s] * step, trial, p, w, iw, part(stages, s * n * _L, n * _L))
        combine(n * _L, step, start[n_stages], start[n_stages + 1], column, value, y, stages, trial)
        control[_EVALUATIONS] += n_stages
        accept(following, trial, p, w, iw)
        if partial:
            keep_lanes(trial, w, gauges, n - 1, lanes)
            store_lanes(out, trial, w, n, windings, outputs, lanes)
            out += 1
            continue
        y, trial = trial, y
        t = following
        index += 1
        going = watch_lanes(t, y, nq, n, w, iw, gauges, limits, rank, odd, lanes)
        if out < times.shape[0] and times[out] <= t + tiny:
            store_lanes(out, y, w, n, windings, outputs, lanes)
            out += 1
    return index


@jit(
    _I8(
        *(abi.RHS, abi.ACCEPT, abi.RHS, abi.RHS, abi.ACCEPT, abi.OBSERVE, _I, _I, _A, _A, _I8, _F8, _F8, _I, _I, _A, _A, _A),
        *(_A, _M, _M, _M, _M, _M, _M, _I, _A, _A, _A, _A, _I, _A, _I, _I, _A, _I),
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
    lane_iw: Any,
    room: Any,
    left: Any,
) -> int:
    """Run the selected rows, `LANES` at a time; the other arguments are as for `symgen.runtime.batch.fixed_runs`.

    Parameters
    ----------
    lanes_rhs, lanes_accept : emitted functions
        For lanes; the other ones are those of single runs.
    lane_iw, room : Array
        Working memory: counters of the lanes, and `room_of_lanes` numbers.
    left : Array of int, shape (k,)
        1 for rows that are left to the loop over single runs; written.

    Returns
    -------
    int
        How many of the selected rows were worked on: all of them, unless the run was stopped.
    """
    nq, n, np_, nw = sizes[_NQ], sizes[_NQ] + sizes[_NV] + 1, sizes[_NP], sizes[_NW]
    windings, k_times = sizes[_WINDINGS], times.shape[0]
    ys, ps, ws, room = bare(ys), bare(ps), bare(ws), bare(room)
    y, trial, stages = part(room, 0, n * _L), part(room, n * _L, n * _L), part(room, 2 * n * _L, n_stages * n * _L)
    at = (2 + n_stages) * n * _L
    p, w = part(room, at, np_ * _L), part(room, at + np_ * _L, (nw + _SPARE) * _L)
    at += (np_ + nw + _SPARE) * _L
    lane_gauges, rank = part(room, at, (_N_GAUGES + 2) * _L), part(room, at + (_N_GAUGES + 2) * _L, _L)
    at += (_N_GAUGES + 3) * _L
    odd, one = part(room, at, _L), part(room, at + _L, nw)
    at += _L + nw
    width = n + _N_STATUS + windings
    outputs = part(room, at, k_times * width * _L)
    total = selected.shape[0]
    lanes = lane_iw.shape[0] // _N_COUNTERS  # a length that the compiler does not know
    for g in range(0, total, _L):
        if control[_STOP] != 0:
            return int(g)
        for l in range(lanes):
            r = selected[min(g + l, total - 1)]  # the last group repeats its last row
            for i in range(n):
                y[i * _L + l] = ys[r * n + i]
            for i in range(np_):
                p[i * _L + l] = ps[r * np_ + i]
            for i in range(nw):
                w[i * _L + l] = ws[r * nw + i]
            begin_run(part(ys, r * n, n), part(ws, r * nw, nw), iw, sizes, limits, gauges, control)
            for i in range(_N_GAUGES):
                lane_gauges[i * _L + l] = gauges[i]
            for i in range(_N_COUNTERS):
                lane_iw[i * _L + l] = 0
            rank[l] = control[abi.LAST_RANK]
            odd[l] = 0.0
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
            windings,
            h,
            until,
            y,
            p,
            w,
            lane_iw,
            trial,
            stages,
            times,
            outputs,
            lane_gauges,
            limits,
            rank,
            odd,
            control,
            lanes,
        )
        if steps < 0:
            return int(g)
        evaluations = control[_EVALUATIONS]
        for l in range(min(lanes, total - g)):
            r = selected[g + l]
            left[r] = 1 if odd[l] != 0.0 else 0
            if odd[l] != 0.0:
                continue
            for i in range(nw):
                one[i] = w[i * _L + l]
            for k in range(k_times):
                for i in range(n):
                    states[k, i] = outputs[(k * width + i) * _L + l]
                for i in range(_N_STATUS + windings):
                    status[k, i] = outputs[(k * width + n + i) * _L + l]
            for i in range(_N_GAUGES):
                gauges[i] = lane_gauges[i * _L + l]
            gauges[_TIME] = until
            for i in range(_N_COUNTERS):
                iw[i] = lane_iw[i * _L + l]
            control[_STEPS], control[_OUTPUTS], control[_EVALUATIONS] = steps, k_times, evaluations
            end_run(
                _DONE,
                r,
                rates,
                rates_confirm,
                accept,
                observe,
                sizes,
                part(ps, r * np_, np_),
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
    width = n + _N_STATUS + windings
    return _L * ((2 + n_stages) * n + n_p + nw + _SPARE + _N_GAUGES + 4 + n_times * width) + nw
