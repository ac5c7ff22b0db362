"""Loops over many runs of one compiled model: no Python between runs, no lock held, memory of one run beside results.

Each run is the same call of the same loop as a single run's, so it takes the same steps. Several threads call these
functions at once, each with rows and working memory of its own.
"""

from __future__ import annotations

from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.bare import bare, part
from symgen.runtime.batch_rows import begin_run, end_run
from symgen.runtime.explicit import adaptive_steps, fixed_steps
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]

_NQ, _NV, _NP, _NW = e.NQ, e.NV, e.NP, e.NW
_STOP, _STOPPED = abi.STOP, abi.STOPPED

#: What both loops take before their own arguments: right-hand side, its confirmation, corrections, rates of v with
#: their confirmation, observations; then the tableau.
_FUNCTIONS = (abi.RHS, abi.RHS, abi.ACCEPT, abi.RHS, abi.RHS, abi.OBSERVE)
_TABLEAU = (_I, _I, _A, _A, _I8)
#: What both take behind them; see `fixed_runs`.
_ROWS = (_I, _I, _A, _A, _A, _A, _M, _M, _M, _M, _M, _M, _I, _A, _A, _A, _A, _I, _A, _I, _A)


@jit(_I8(*_FUNCTIONS, *_TABLEAU, _F8, _F8, *_ROWS))
def fixed_runs(
    rhs: Any,
    confirm: Any,
    accept: Any,
    rates: Any,
    rates_confirm: Any,
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
) -> int:
    """Run the selected rows with a constant step, from starts that `close_runs` left.

    Parameters
    ----------
    rhs, confirm, accept, rates, rates_confirm, observe : emitted functions
        See `symgen.runtime.abi`; the last three for what is observed at outputs.
    start, column, value, nodes, n_stages
        The tableau, as for a single run.
    h, until : float
        Step and end [s].
    sizes : Array of int
        See `symgen.runtime.ensemble_abi`.
    selected : Array of int
        Rows to run.
    ys, ps, ws : Array, shapes (k, ny), (k, np), (k, nw), flat
        Starts; overwritten.
    times : Array
        Output times of every run.
    states, status, accelerations, multipliers, observed, angles : Array
        Outputs of the run being worked on.
    picks : Array of int
        (source, column) of each quantity asked for.
    values : Array, shape (k, quantities, times), flat
        Result.
    summary : Array, shape (k, N_SUMMARY), flat
        Result.
    limits : Array
        Largest violations of position and velocity, largest energy error, and the pivot below which a position is near
        a singular one.
    gauges, control, events, iw, room : Array
        As for a single run; `control` has one element more, which counts finished runs. `room` begins with nw numbers.

    Returns
    -------
    int
        How many of the selected rows are done: all of them, unless the run was stopped.
    """
    ny, np_, nw = sizes[_NQ] + sizes[_NV] + 1, sizes[_NP], sizes[_NW]
    ys, ps, ws, room, iw = bare(ys), bare(ps), bare(ws), bare(room), bare(iw)
    kept, rest = part(room, 0, nw), part(room, nw, room.shape[0] - nw)
    for s in range(selected.shape[0]):
        if control[_STOP] != 0:
            return int(s)
        r = selected[s]
        y, p, w = part(ys, r * ny, ny), part(ps, r * np_, np_), part(ws, r * nw, nw)
        begin_run(y, w, iw, sizes, limits, gauges, control)
        for i in range(nw):
            kept[i] = w[i]
        code = fixed_steps(
            rhs,
            confirm,
            accept,
            start,
            column,
            value,
            nodes,
            n_stages,
            sizes[_NQ],
            y,
            p,
            w,
            iw,
            0.0,
            h,
            until,
            times,
            states,
            status,
            gauges,
            control,
            events,
            rest,
        )
        if code == _STOPPED:
            return int(s)
        end_run(
            code,
            r,
            rates,
            rates_confirm,
            accept,
            observe,
            sizes,
            p,
            w,
            kept,
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
    return int(selected.shape[0])


@jit(_I8(*_FUNCTIONS, *_TABLEAU, _A, _I8, _I8, _A, _F8, _F8, _F8, _F8, _F8, *_ROWS))
def adaptive_runs(
    rhs: Any,
    confirm: Any,
    accept: Any,
    rates: Any,
    rates_confirm: Any,
    observe: Any,
    start: Any,
    column: Any,
    value: Any,
    nodes: Any,
    n_stages: int,
    weights: Any,
    n_errors: int,
    error_order: int,
    dense: Any,
    h: float,
    h_max: float,
    until: float,
    rtol: float,
    atol: float,
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
) -> int:
    """Run the selected rows with steps chosen from the error estimate; the other arguments as for `fixed_runs`."""
    ny, np_, nw = sizes[_NQ] + sizes[_NV] + 1, sizes[_NP], sizes[_NW]
    ys, ps, ws, room, iw = bare(ys), bare(ps), bare(ws), bare(room), bare(iw)
    kept, rest = part(room, 0, nw), part(room, nw, room.shape[0] - nw)
    for s in range(selected.shape[0]):
        if control[_STOP] != 0:
            return int(s)
        r = selected[s]
        y, p, w = part(ys, r * ny, ny), part(ps, r * np_, np_), part(ws, r * nw, nw)
        begin_run(y, w, iw, sizes, limits, gauges, control)
        for i in range(nw):
            kept[i] = w[i]
        code = adaptive_steps(
            rhs,
            confirm,
            accept,
            start,
            column,
            value,
            nodes,
            n_stages,
            sizes[_NQ],
            weights,
            n_errors,
            error_order,
            dense,
            y,
            p,
            w,
            iw,
            0.0,
            h,
            h_max,
            until,
            rtol,
            atol,
            times,
            states,
            status,
            gauges,
            control,
            events,
            rest,
        )
        if code == _STOPPED:
            return int(s)
        end_run(
            code,
            r,
            rates,
            rates_confirm,
            accept,
            observe,
            sizes,
            p,
            w,
            kept,
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
    return int(selected.shape[0])


@jit(types.int64(_F8, _A, _A, _A, _A, _A))
def observe_nothing(t: float, y: Any, p: Any, w: Any, ydot: Any, out: Any) -> int:
    """Stand in for the emitted ``observe`` where no joint coordinate is asked for, so that it is not compiled."""
    return 0
