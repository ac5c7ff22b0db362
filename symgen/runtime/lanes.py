"""Many runs of one compiled model with a constant step, several at once in the lanes of vector instructions.

Lanes take the same steps side by side. What a run in a lane cannot do alone is not done here: where one comes near a
singular position, meets a suspicious pivot, exceeds a limit or fails, it is left to the loop over single runs, from its
start. So every run that ends here has gone well, and every other one has exactly the result of a single run.

Element i of every array of the lanes stands at ``LANES*i + lane``; those of emitted code are parts of one array
(`symgen.ir.program.lane_bases`).
"""

from __future__ import annotations

from typing import Any

from numba import types

from symgen.ir.program import LANE_COUNTERS, LANES, lane_bases
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.bare import bare, part
from symgen.runtime.batch_rows import begin_run, end_run
from symgen.runtime.lane_watch import FIRST_RANK, N_LANE_GAUGES, ODD, keep_lanes, padded, store_lanes, watch_lanes
from symgen.runtime.steps import combine
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]
#: rhs(t, z) and accept(t, z).
LANE_FUNCTION = types.FunctionType(types.int64(_F8, _A))

_L, _SPARE = LANES, len(LANE_COUNTERS)
_NQ, _NV, _NP, _NW, _WINDINGS = e.NQ, e.NV, e.NP, e.NW, e.WINDINGS
_STOP, _STEPS, _EVALUATIONS, _OUTPUTS, _DONE = abi.STOP, abi.STEPS, abi.EVALUATIONS, abi.OUTPUTS, abi.DONE
_KINETIC, _POTENTIAL, _N_STATUS = abi.KINETIC * _L, abi.POTENTIAL * _L, abi.RANK + 1
_STEP_STATUS, _START, _POTENTIAL_START = abi.STEP_STATUS * _L, abi.ENERGY_START * _L, abi.POTENTIAL_START * _L
_TIME, _N_GAUGES, _LAST_RANK, _RUN_ITERATIONS = abi.TIME, abi.N_GAUGES, abi.LAST_RANK, abi.ITERATIONS
_ITERATIONS = LANE_COUNTERS.index("iterations") * _L


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
    for lane in range(lanes):
        gauges[_START + lane] = w[_KINETIC + lane] + w[_POTENTIAL + lane]
        gauges[_POTENTIAL_START + lane] = w[_POTENTIAL + lane]
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
        for lane in range(lanes):
            w[_STEP_STATUS + lane] = step
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
        *(
            LANE_FUNCTION,
            LANE_FUNCTION,
            abi.RHS,
            abi.RHS,
            abi.ACCEPT,
            abi.OBSERVE,
            _I,
            _I,
            _A,
            _A,
            _I8,
            _F8,
            _F8,
            _I,
            _I,
            _A,
            _A,
            _A,
        ),
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
    stages, lane_gauges = (
        part(room, at, n_stages * full * _L),
        part(room, at + n_stages * full * _L, N_LANE_GAUGES * _L),
    )
    at += (n_stages * full + N_LANE_GAUGES) * _L
    one, outputs = part(room, at, nw), part(room, at + nw, k_times * width * _L)
    p_at, w_at = 2 * full * _L, (2 * full + n_p) * _L
    total = selected.shape[0]
    for g in range(0, total, _L):
        if control[_STOP] != 0:
            return int(g)
        for lane in range(_L):
            r = selected[min(g + lane, total - 1)]  # the last group repeats its last row
            for i in range(n):
                z[i * _L + lane] = ys[r * n + i]
            for i in range(n_p):
                z[p_at + i * _L + lane] = ps[r * n_p + i]
            for i in range(nw):
                z[w_at + i * _L + lane] = ws[r * nw + i]
            for i in range(_SPARE):
                z[w_at + (nw + i) * _L + lane] = 0.0
            begin_run(part(ys, r * n, n), part(ws, r * nw, nw), iw, sizes, limits, gauges, control)
            for i in range(_N_GAUGES):
                lane_gauges[i * _L + lane] = gauges[i]
            lane_gauges[FIRST_RANK + lane] = control[_LAST_RANK]
            lane_gauges[ODD + lane] = 0.0
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
            _L,
        )
        if steps < 0:
            return int(g)
        evaluations = control[_EVALUATIONS]
        for lane in range(min(_L, total - g)):
            r = selected[g + lane]
            left[r] = 1 if lane_gauges[ODD + lane] != 0.0 else 0
            if left[r] == 1:
                continue
            for i in range(nw):
                one[i] = z[w_at + i * _L + lane]
            for k in range(k_times):
                for i in range(n):
                    states[k, i] = outputs[(k * width + i) * _L + lane]
                for i in range(_N_STATUS + windings):
                    status[k, i] = outputs[(k * width + n + i) * _L + lane]
            for i in range(_N_GAUGES):
                gauges[i] = lane_gauges[i * _L + lane]
            gauges[_TIME] = until
            for i in range(iw.shape[0]):
                iw[i] = 0
            iw[_RUN_ITERATIONS] = int(z[w_at + nw * _L + _ITERATIONS + lane])
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
    bases = lane_bases(n, n_p, nw)
    numbers = bases["numbers"] + (1 + n_stages) * bases["ydot"] + N_LANE_GAUGES
    return LANES * (numbers + n_times * (n + _N_STATUS + windings)) + nw
