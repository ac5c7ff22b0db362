"""The loop of Adams-Bashforth-Moulton predictor-corrector schemes with derivatives at unequal distances.

Coefficients are integrals of the Lagrange polynomials through the past derivatives, by Gauss' quadrature that is
exact for them, so one loop serves constant and varying steps. The derivative kept for a time is evaluated at the
corrected state: a correction enters the history instead of spoiling it.
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.runtime.bare import bare, part
from symgen.runtime.steps import store
from symgen.runtime.watch import approach, begin, keep_maxima, watch
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]

_STOP, _STEPS, _REJECTED, _EVALUATIONS, _OUTPUTS = abi.STOP, abi.STEPS, abi.REJECTED, abi.EVALUATIONS, abi.OUTPUTS
_DONE, _STOPPED, _NOT_FINITE = abi.DONE, abi.STOPPED, abi.NOT_FINITE
_CORRECTION, _TINY = abi.CORRECTION, abi.TINY_STEP
_STEP, _PHI, _STEP_STATUS, _PROBING = abi.STEP, abi.PHI, abi.STEP_STATUS, abi.PROBING
#: Derivatives kept; the highest order of the corrector.
DEPTH = 9
_DEPTH = DEPTH


@jit()
def weights(count: int, times: Any, low: float, high: float, nodes: Any, factors: Any, out: Any) -> None:
    """Integrals from `low` to `high` of the Lagrange polynomials on the first `count` entries of `times`."""
    for i in range(count):
        out[i] = 0.0
    half, middle = 0.5 * (high - low), 0.5 * (high + low)
    for g in range(nodes.shape[0]):
        x = middle + half * nodes[g]
        for i in range(count):
            product = 1.0
            for j in range(count):
                if j != i:
                    product *= (x - times[j]) / (times[i] - times[j])
            out[i] += half * factors[g] * product


@jit()
def advance(ny: int, count: int, coefficients: Any, history: Any, y: Any, out: Any) -> None:
    """Set out = y + sum of coefficient times past derivative."""
    for i in range(ny):
        out[i] = y[i]
    for j in range(count):
        for i in range(ny):
            out[i] += coefficients[j] * history[j * ny + i]


@jit()
def classical(
    rhs: Any,
    confirm: Any,
    t: float,
    h: float,
    y: Any,
    p: Any,
    w: Any,
    iw: Any,
    begun: Any,
    out: Any,
    stage: Any,
    rate: Any,
) -> int:
    """One step of the classical Runge-Kutta scheme from y, where the derivative is `begun`; return its evaluations."""
    ny = y.shape[0]
    for i in range(ny):
        out[i] = y[i] + h / 6.0 * begun[i]
        rate[i] = begun[i]
    for s in range(3):
        ahead = 0.5 * h if s < 2 else h
        for i in range(ny):
            stage[i] = y[i] + ahead * rate[i]
        if rhs(t + ahead, stage, p, w, iw, rate) != 0:
            confirm(t + ahead, stage, p, w, iw, rate)
        weight = h / 3.0 if s < 2 else h / 6.0
        for i in range(ny):
            out[i] += weight * rate[i]
    return 3


@jit()
def extrapolated(
    rhs: Any,
    confirm: Any,
    t: float,
    h: float,
    y: Any,
    p: Any,
    w: Any,
    iw: Any,
    begun: Any,
    out: Any,
    stage: Any,
    before: Any,
    rate: Any,
) -> int:
    """One step of order 8: modified midpoint rules with 2, 4, 6 and 8 parts, extrapolated (Gragg, Bulirsch, Stoer)."""
    ny, evaluations = y.shape[0], 0
    for i in range(ny):
        out[i] = 0.0
    for parts in range(2, 9, 2):
        factor = 1.0  # of this result in the extrapolated one
        for other in range(2, 9, 2):
            if other != parts:
                factor *= parts**2 / (parts**2 - other**2)
        ahead = h / parts
        for i in range(ny):
            before[i] = y[i]
            stage[i] = y[i] + ahead * begun[i]
        for k in range(1, parts + 1):
            if rhs(t + k * ahead, stage, p, w, iw, rate) != 0:
                confirm(t + k * ahead, stage, p, w, iw, rate)
            evaluations += 1
            if k < parts:
                for i in range(ny):
                    following = before[i] + 2.0 * ahead * rate[i]
                    before[i] = stage[i]
                    stage[i] = following
        for i in range(ny):
            out[i] += 0.5 * factor * (stage[i] + before[i] + ahead * rate[i])
    return evaluations


@jit(
    _I8(
        *(abi.RHS, abi.RHS, abi.ACCEPT, _I8, _I8, _I8, _A, _A, _A, _A, _A, _I),
        *(_F8, _F8, _F8, _F8, _F8, _F8, _A, _M, _M, _A, _I, _A, _A),
    ),
)
def adams_steps(
    rhs: Any,
    confirm: Any,
    accept: Any,
    order: int,
    adaptive: int,
    nq: int,
    nodes: Any,
    factors: Any,
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
    """Integrate with predictor, evaluation, corrector, evaluation.

    Parameters
    ----------
    order : int
        Highest order; past derivatives used by the predictor at most.
    nodes, factors : Array
        Gauss' quadrature on (-1, 1).
    room : Array
        Working memory.

    Notes
    -----
    A run with constant steps starts with one-step schemes: the classical Runge-Kutta scheme up to order 4, extrapolated
    midpoint rules beyond, so that the start keeps the order. One with varying steps starts at order 1 with a short step
    and raises the order by one with every accepted step.
    """
    ny = y.shape[0]
    n_error = ny - 1
    y, p, w, iw = bare(y), bare(p), bare(w), bare(iw)
    gauges, control, events, status, states = bare(gauges), bare(control), bare(events), bare(status), bare(states)
    trial, predicted = part(room, 0, ny), part(room, ny, ny)
    rate = part(room, 2 * ny, ny)
    history = part(room, 3 * ny, _DEPTH * ny)  # newest first
    past = part(room, (3 + _DEPTH) * ny, _DEPTH + 1)
    at = (3 + _DEPTH) * ny + _DEPTH + 1
    coefficients = part(room, at, _DEPTH + 1)
    t, out, tiny = t0, 0, 1e-9 * h
    accept(t, y, p, w, iw)
    begin(w, gauges)
    code = watch(t, y, nq, w, gauges, control, events)
    if code != _DONE:
        return code
    while out < times.shape[0] and times[out] <= t + tiny:
        store(out, y, w, states, status)
        out += 1
    control[_OUTPUTS] = out
    if rhs(t, y, p, w, iw, part(history, 0, ny)) != 0:
        confirm(t, y, p, w, iw, part(history, 0, ny))
    control[_EVALUATIONS] += 1
    past[0] = t
    count, index = 1, 0
    rejected = False
    while t < until - tiny:
        if control[_STOP] != 0:
            return _STOPPED
        step = approach(min(h, h_max), gauges) if adaptive == 1 else h
        following = t + step if adaptive == 1 else t0 + (index + 1) * h
        if following > until - tiny or (adaptive == 1 and t + 1.01 * step >= until):
            following = until
            step = until - t
        if not step > 4e-16 * max(abs(t), abs(until)):
            return _TINY
        partial = out < times.shape[0] and times[out] < following - tiny
        if partial:
            following = times[out]
            step = following - t
        w[_STEP_STATUS] = step
        used = min(count, order)
        if adaptive == 0 and count < order:
            # no history yet
            if order > 4:
                spare = part(history, (_DEPTH - 1) * ny, ny)  # free as long as the history is short
                evaluations = extrapolated(
                    rhs, confirm, t, step, y, p, w, iw, part(history, 0, ny), trial, predicted, spare, rate
                )
            else:
                evaluations = classical(
                    rhs, confirm, t, step, y, p, w, iw, part(history, 0, ny), trial, predicted, rate
                )
            control[_EVALUATIONS] += evaluations
        else:
            weights(used, past, t, following, nodes, factors, coefficients)
            advance(ny, used, coefficients, history, y, predicted)
            if rhs(following, predicted, p, w, iw, rate) != 0:
                confirm(following, predicted, p, w, iw, rate)
            control[_EVALUATIONS] += 1
            # the corrector has the new derivative in front; with varying steps it is of one order more than the
            # predictor
            corrected = used if adaptive == 1 else used - 1
            last = past[corrected]
            for j in range(corrected, 0, -1):
                past[j] = past[j - 1]
            past[0] = following
            weights(corrected + 1, past, t, following, nodes, factors, coefficients)
            for j in range(corrected):
                past[j] = past[j + 1]
            past[corrected] = last
            for i in range(ny):
                trial[i] = y[i] + coefficients[0] * rate[i]
            for j in range(corrected):
                for i in range(ny):
                    trial[i] += coefficients[j + 1] * history[j * ny + i]
        error = 0.0
        if adaptive == 1 and not partial:
            for i in range(n_error):
                scale = atol + rtol * max(abs(y[i]), abs(trial[i]))
                error += ((trial[i] - predicted[i]) / scale) ** 2
            error = 0.1 * math.sqrt(error / n_error)
            if not error <= 1.0:
                control[_REJECTED] += 1
                h = step * (max(0.2, 0.8 * error ** (-1.0 / (used + 1.0))) if math.isfinite(error) else 0.1)
                if rejected:
                    count = 1  # twice in a row: the history misleads
                rejected = True
                continue
        iw[_PROBING] = 1 if partial else 0
        bits = accept(following, trial, p, w, iw)
        iw[_PROBING] = 0
        if partial:
            keep_maxima(w, trial[ny - 1], gauges)
            store(out, trial, w, states, status)
            out += 1
            control[_OUTPUTS] = out
            continue
        if bits & 1:
            if adaptive == 0:
                return _CORRECTION if math.isfinite(w[_PHI]) else _NOT_FINITE
            control[_REJECTED] += 1
            h = 0.5 * step
            rejected = True
            continue
        y, trial = trial, y
        t = following
        index += 1
        control[_STEPS] += 1
        gauges[_STEP] = step
        for j in range(min(count, _DEPTH - 1), 0, -1):
            past[j] = past[j - 1]
            for i in range(ny):
                history[j * ny + i] = history[(j - 1) * ny + i]
        past[0] = t
        if rhs(t, y, p, w, iw, part(history, 0, ny)) != 0:
            confirm(t, y, p, w, iw, part(history, 0, ny))
        control[_EVALUATIONS] += 1
        count = min(count + 1, _DEPTH)
        code = watch(t, y, nq, w, gauges, control, events)
        if code != _DONE:
            return code
        if out < times.shape[0] and times[out] <= t + tiny:
            store(out, y, w, states, status)
            out += 1
            control[_OUTPUTS] = out
        if adaptive == 1:
            grow = min(2.0, max(0.3, 0.8 * max(error, 1e-12) ** (-1.0 / (used + 1.0))))
            h = step * (min(1.0, grow) if rejected else grow)
            rejected = False
    return _DONE
