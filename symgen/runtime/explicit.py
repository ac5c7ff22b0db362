"""Loops of explicit Runge-Kutta schemes, driven by the tableau: one compilation serves all schemes and all models.

The state is projected after each accepted step only; the error estimate belongs to the unprojected pair; output times
within a step are interpolated between unprojected ends (adaptive) or reached by a shortened step that is not
propagated (fixed), and each output is then projected. Stage derivatives live in one flat buffer: views of rows cost
more than a stage. All working memory comes from outside in `room` and is handed to emitted functions without
ownership (`symgen.runtime.bare`).
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.runtime.bare import bare, part
from symgen.runtime.steps import combine, error_norm, store
from symgen.runtime.watch import approach, begin, keep_maxima, watch
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I = types.float64[::1], types.int64[::1]
_M = types.float64[:, ::1]

_STOP, _STEPS, _REJECTED, _EVALUATIONS, _OUTPUTS = abi.STOP, abi.STEPS, abi.REJECTED, abi.EVALUATIONS, abi.OUTPUTS
_DONE, _STOPPED, _NOT_FINITE = abi.DONE, abi.STOPPED, abi.NOT_FINITE
_CORRECTION, _TINY = abi.CORRECTION, abi.TINY_STEP
#: Above this multiple of the tolerance even a step across a singular position is refused: it leads nowhere.
_HOPELESS = 1e6
_IN_ZONE, _FALL, _LAST_SINE = abi.IN_ZONE, abi.FALL, abi.LAST_SINE
_STEP, _PHI, _STEP_STATUS, _PROBING = abi.STEP, abi.PHI, abi.STEP_STATUS, abi.PROBING
_N_STATUS = abi.RANK + 1


@jit(
    _I8(
        abi.RHS,
        abi.RHS,
        abi.ACCEPT,
        _I,
        _I,
        _A,
        _A,
        _I8,
        _I8,
        _A,
        _A,
        _A,
        _I,
        _F8,
        _F8,
        _F8,
        _A,
        _M,
        _M,
        _A,
        _I,
        _A,
        _A,
    ),
)
def fixed_steps(
    rhs: Any,
    confirm: Any,
    accept: Any,
    start: Any,
    column: Any,
    value: Any,
    nodes: Any,
    n_stages: int,
    nq: int,
    y: Any,
    p: Any,
    w: Any,
    iw: Any,
    t0: float,
    h: float,
    until: float,
    times: Any,
    states: Any,
    status: Any,
    gauges: Any,
    control: Any,
    events: Any,
    room: Any,
) -> int:
    """Integrate with a constant step; an output between two steps is reached by a shortened step of its own."""
    n = y.shape[0]
    y, p, w, iw = bare(y), bare(p), bare(w), bare(iw)
    gauges, control, events, status, states = bare(gauges), bare(control), bare(events), bare(status), bare(states)
    column, value = bare(column), bare(value)
    trial, stages = part(room, 0, n), part(room, n, n_stages * n)
    tiny = 1e-9 * h
    t = t0
    index = 0
    out = 0
    accept(t, y, p, w, iw)
    begin(w, gauges)
    code = watch(t, y, nq, w, gauges, control, events)
    if code != _DONE:
        return code
    while out < times.shape[0] and times[out] <= t + tiny:
        store(out, y, w, states, status)
        out += 1
    control[_OUTPUTS] = out
    while t < until - tiny:
        if control[_STOP] != 0:
            return _STOPPED
        following = t0 + (index + 1) * h
        step = h
        if following > until - tiny:
            following = until
            step = until - t
        partial = out < times.shape[0] and times[out] < following - tiny
        if partial:
            following = times[out]
            step = following - t
        w[_STEP_STATUS] = step
        for s in range(n_stages):
            combine(n, step, start[s], start[s + 1], column, value, y, stages, trial)
            rate = part(stages, s * n, n)
            if rhs(t + nodes[s] * step, trial, p, w, iw, rate) != 0:
                confirm(t + nodes[s] * step, trial, p, w, iw, rate)
        combine(n, step, start[n_stages], start[n_stages + 1], column, value, y, stages, trial)
        control[_EVALUATIONS] += n_stages
        iw[_PROBING] = 1 if partial else 0
        bits = accept(following, trial, p, w, iw)
        iw[_PROBING] = 0
        if partial:
            keep_maxima(w, trial[n - 1], gauges)
            store(out, trial, w, states, status)
            out += 1
            control[_OUTPUTS] = out
            continue
        if bits & 1:
            return _CORRECTION if math.isfinite(w[_PHI]) else _NOT_FINITE
        for i in range(n):  # copied, not exchanged: compilers lose track of arrays that change their names
            y[i] = trial[i]
        t = following
        index += 1
        control[_STEPS] = index
        code = watch(t, y, nq, w, gauges, control, events)
        if code != _DONE:
            return code
        if out < times.shape[0] and times[out] <= t + tiny:
            store(out, y, w, states, status)
            out += 1
            control[_OUTPUTS] = out
    return _DONE


@jit(
    _I8(
        *(abi.RHS, abi.RHS, abi.ACCEPT, _I, _I, _A, _A, _I8, _I8, _A, _I8, _I8, _A, _A, _A, _A, _I),
        *(_F8, _F8, _F8, _F8, _F8, _F8, _A, _M, _M, _A, _I, _A, _A),
    ),
)
def adaptive_steps(
    rhs: Any,
    confirm: Any,
    accept: Any,
    start: Any,
    column: Any,
    value: Any,
    nodes: Any,
    n_stages: int,
    nq: int,
    weights: Any,
    n_errors: int,
    error_order: int,
    dense: Any,
    y: Any,
    p: Any,
    w: Any,
    iw: Any,
    t0: float,
    h: float,
    h_max: float,
    until: float,
    rtol: float,
    atol: float,
    times: Any,
    states: Any,
    status: Any,
    gauges: Any,
    control: Any,
    events: Any,
    room: Any,
) -> int:
    """Integrate with steps chosen from the error estimate; outputs are interpolated.

    ``h`` 0 asks for Hairer's choice of a first step. ``dense`` holds the weights of the powers of the interpolant,
    stage by stage (see `symgen.integrators._tableau.Tableau.dense`).
    """
    n = y.shape[0]
    n_error = n - 1  # the work is not controlled
    n_all = nodes.shape[0]
    degree = dense.shape[0] // n_all
    y, p, w, iw = bare(y), bare(p), bare(w), bare(iw)
    gauges, control, events, status, states = bare(gauges), bare(control), bare(events), bare(status), bare(states)
    column, value = bare(column), bare(value)
    trial, new, stages = part(room, 0, n), part(room, n, n), part(room, 2 * n, n_all * n)
    sums = part(room, (2 + n_all) * n, 2 * n)
    first, last = part(stages, 0, n), part(stages, n_stages * n, n)
    kept = part(room, (4 + n_all) * n, _N_STATUS)
    exponent = -1.0 / (error_order + 1.0)
    end_counts = False  # whether an error estimate needs the stage at the end of the step
    for e in range(n_errors):
        end_counts = end_counts or weights[e * (n_stages + 1) + n_stages] != 0.0
    t = t0
    out = 0
    accept(t, y, p, w, iw)
    begin(w, gauges)
    code = watch(t, y, nq, w, gauges, control, events)
    if code != _DONE:
        return code
    while out < times.shape[0] and times[out] <= t:
        store(out, y, w, states, status)
        out += 1
    control[_OUTPUTS] = out
    if rhs(t, y, p, w, iw, first) != 0:
        confirm(t, y, p, w, iw, first)
    control[_EVALUATIONS] += 1
    if h <= 0.0:
        # Hairer, Norsett, Wanner, Solving ODEs I, section II.4
        d0 = d1 = d2 = 0.0
        for i in range(n_error):
            scale = atol + rtol * abs(y[i])
            d0 += (y[i] / scale) ** 2
            d1 += (stages[i] / scale) ** 2
        d0, d1 = math.sqrt(d0 / n_error), math.sqrt(d1 / n_error)
        h0 = 1e-6 if d0 < 1e-5 or d1 < 1e-5 else 0.01 * d0 / d1
        h0 = min(h0, until - t0)
        for i in range(n):
            trial[i] = y[i] + h0 * stages[i]
        rate = part(stages, n, n)
        if rhs(t + h0, trial, p, w, iw, rate) != 0:
            confirm(t + h0, trial, p, w, iw, rate)
        control[_EVALUATIONS] += 1
        for i in range(n_error):
            d2 += ((rate[i] - stages[i]) / (atol + rtol * abs(y[i]))) ** 2
        d2 = math.sqrt(d2 / n_error) / h0
        largest = max(d1, d2)
        h1 = max(1e-6, 1e-3 * h0) if largest <= 1e-15 else (0.01 / largest) ** -exponent
        h = min(100.0 * h0, h1)
    rejected = False
    may_cross = True  # not again after an attempt that failed: some positions cannot be passed
    while t < until:
        if control[_STOP] != 0:
            return _STOPPED
        # inside the zone around a singular position the estimate sees noise: the zone is crossed in one step, and not
        # so that a stage at half the step meets its middle
        crossing = may_cross and control[_IN_ZONE] == 1 and gauges[_FALL] > 0.0
        before = h
        h = approach(min(h, h_max), gauges)
        if crossing:
            h = min(h_max, 2.3 * gauges[_LAST_SINE] / gauges[_FALL])
        if t + 1.01 * h >= until:
            h = until - t
        if not h > 4e-16 * max(abs(t), abs(until)):
            return _TINY
        w[_STEP_STATUS] = h
        for s in range(1, n_stages):
            combine(n, h, start[s], start[s + 1], column, value, y, stages, trial)
            rate = part(stages, s * n, n)
            if rhs(t + nodes[s] * h, trial, p, w, iw, rate) != 0:
                confirm(t + nodes[s] * h, trial, p, w, iw, rate)
        combine(n, h, start[n_stages], start[n_stages + 1], column, value, y, stages, new)
        control[_EVALUATIONS] += n_stages - 1
        end_known = end_counts
        if end_counts:
            if rhs(t + h, new, p, w, iw, last) != 0:
                confirm(t + h, new, p, w, iw, last)
            control[_EVALUATIONS] += 1
        error = error_norm(n_error, n, h, weights, n_errors, n_stages + 1, stages, y, new, rtol, atol, sums)
        if not (error <= 1.0 or (crossing and error <= _HOPELESS)):
            may_cross = may_cross and not crossing
            control[_REJECTED] += 1
            h *= max(0.2, 0.9 * error**exponent) if math.isfinite(error) else 0.1
            rejected = True
            continue
        for i in range(n):
            trial[i] = new[i]
        following = until if h == until - t else t + h
        bits = accept(following, trial, p, w, iw)
        if bits & 1:
            control[_REJECTED] += 1
            h *= 0.5
            rejected = True
            may_cross = False
            continue
        code = watch(following, trial, nq, w, gauges, control, events)
        if code != _DONE:
            return code
        if out < times.shape[0] and times[out] < following:
            for i in range(_N_STATUS):
                kept[i] = w[i]
            if not end_known:
                if rhs(following, new, p, w, iw, last) != 0:
                    confirm(following, new, p, w, iw, last)
                control[_EVALUATIONS] += 1
                end_known = True
            for s in range(n_stages + 1, n_all):
                combine(n, h, start[s], start[s + 1], column, value, y, stages, new)
                rate = part(stages, s * n, n)
                if rhs(t + nodes[s] * h, new, p, w, iw, rate) != 0:
                    confirm(t + nodes[s] * h, new, p, w, iw, rate)
                control[_EVALUATIONS] += 1
            while out < times.shape[0] and times[out] < following:
                x = (times[out] - t) / h
                for i in range(n):
                    new[i] = y[i]
                for s in range(n_all):
                    factor = 0.0
                    for j in range(degree - 1, -1, -1):
                        factor = (factor + dense[s * degree + j]) * x
                    factor *= h
                    for i in range(n):
                        new[i] += factor * stages[s * n + i]
                iw[_PROBING] = 1
                accept(times[out], new, p, w, iw)
                iw[_PROBING] = 0
                keep_maxima(w, new[n - 1], gauges)
                store(out, new, w, states, status)
                out += 1
            for i in range(_N_STATUS):
                w[i] = kept[i]
        for i in range(n):  # not exchanged, as above
            y[i] = trial[i]
        t = following
        control[_STEPS] += 1
        gauges[_STEP] = h
        if out < times.shape[0] and times[out] <= t:
            store(out, y, w, states, status)
            out += 1
        control[_OUTPUTS] = out
        # a correction changes the state: the stage at the end of the step is no longer that of the next step's
        # beginning
        if bits & 2 or not end_known:
            if rhs(t, y, p, w, iw, first) != 0:
                confirm(t, y, p, w, iw, first)
            control[_EVALUATIONS] += 1
        else:
            for i in range(n):
                first[i] = last[i]
        grow = min(10.0, max(0.2, 0.9 * max(error, 1e-10) ** exponent))
        may_cross = True
        h = before if crossing else h * (min(1.0, grow) if rejected else grow)
        rejected = False
    return _DONE
