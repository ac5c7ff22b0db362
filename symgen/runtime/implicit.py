"""The loop of implicit Runge-Kutta schemes on the descriptor form F(t, y, k) = 0.

Stages are solved one after the other where the scheme allows (diagonally implicit), else together. Newton's iteration
uses the exact Jacobian that was emitted with the residual, evaluated at the stage's own iterate and kept while it
converges fast. An output between two steps is reached by a shortened step of its own that is not propagated.
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.runtime.bare import bare, part
from symgen.runtime.sparse import ROOM, assemble, factorise, leave_out_rest, longer, solve
from symgen.runtime.steps import store
from symgen.runtime.watch import approach, begin, keep_maxima, watch
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]

_STOP, _STEPS, _REJECTED, _EVALUATIONS, _OUTPUTS = abi.STOP, abi.STEPS, abi.REJECTED, abi.EVALUATIONS, abi.OUTPUTS
_JACOBIANS, _ITERATIONS = abi.JACOBIANS, abi.NEWTON_ITERATIONS
_DONE, _STOPPED, _NOT_FINITE = abi.DONE, abi.STOPPED, abi.NOT_FINITE
_CORRECTION, _TINY, _NEWTON = abi.CORRECTION, abi.TINY_STEP, abi.NEWTON
_SCALE = abi.ENERGY_SCALE
_STEP, _PHI, _STEP_STATUS, _PROBING, _POWER = abi.STEP, abi.PHI, abi.STEP_STATUS, abi.PROBING, abi.POWER
_MOST_ITERATIONS = 15


@jit()
def stage_state(y: Any, width: int, n: int, h: float, a: Any, row: int, stages: int, k: Any, out: Any) -> None:
    """Set out = y + h sum_j a[row, j] y'_j for q and v."""
    for i in range(width):
        out[i] = y[i]
    out[width] = y[width]
    for j in range(stages):
        factor = h * a[row * stages + j]
        if factor != 0.0:
            for i in range(width):
                out[i] += factor * k[j * n + i]


@jit()
def work_error(
    step: float, errors: Any, begun: Any, powers: Any, y: Any, trial: Any, gauges: Any, rtol: float, atol: float
) -> float:
    """Return the weighted error estimate of the work, which enters no rate and so needs no filter.

    Where every coordinate is driven nothing else is integrated: constraints in every stage make the other estimates 0.
    """
    last = y.shape[0] - 1
    total = errors[0] * begun[last]
    for s in range(powers.shape[0]):
        total += errors[s + 1] * powers[s]
    scale = max(gauges[_SCALE], abs(y[last]), abs(trial[last]))
    return float(abs(step * total) / (atol + rtol * scale))


@jit(
    _I8(
        *(abi.STAGE, abi.STAGE, abi.RHS, abi.RHS, abi.ACCEPT, _A, _A, _A, _I8, _I8, _A, _F8),
        *(_I8, _I8, _I8, _I8, _I8, _I8, _I8),
        *(_A, _A, _A, _I, _I8, _F8, _F8, _F8, _F8, _F8, _F8, _A, _M, _M, _A, _I, _A),
        *(_A, _A, _A, _I, _A, _I, _I),
    ),
)
def implicit_steps(
    residual: Any,
    tangent: Any,
    rhs: Any,
    confirm: Any,
    accept: Any,
    a: Any,
    b: Any,
    c: Any,
    n_stages: int,
    together: int,
    errors: Any,
    filter_factor: float,
    error_order: int,
    nq: int,
    nv: int,
    m: int,
    n: int,
    multipliers: int,
    mask: int,
    y: Any,
    p: Any,
    w: Any,
    iw: Any,
    adaptive: int,
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
    slopes: Any,
    numbers: Any,
    plan: Any,
    filter_numbers: Any,
    filter_plan: Any,
    entries: Any,
) -> int:
    """Integrate with constant steps, or with steps chosen from the error estimate.

    Parameters
    ----------
    a, b, c : Array
        The tableau, `a` row by row.
    together : int
        1 if the stages are solved together.
    errors : Array, shape (s + 1,)
        Weights of the error estimate on the derivative at the beginning of the step and on those of the stages.
    filter_factor : float
        The estimate is filtered by ``(dF/dk + h filter_factor dF/dy)^-1 dF/dk``; 0: it is not.
    n, multipliers, mask : int
        Unknowns of a stage, and where the multipliers and the mask of redundant rows begin in `w`.
    room : Array
        Working memory.
    slopes : Array
        For what ``tangent`` writes in each stage; the last element is 1.
    numbers, plan : Array
        Of the Newton matrix, see `symgen.runtime.newton.stage_plan`.
    filter_numbers, filter_plan : Array
        The same for one stage.
    entries : Array of int64
        Equation of each number that ``tangent`` writes, then its unknown.
    """
    width, ny = nq + nv, nq + nv + 1
    count = entries.shape[0] // 2
    unknowns = n_stages * n if together == 1 else n
    y, p, w, iw = bare(y), bare(p), bare(w), bare(iw)
    gauges, control, events, status, states = bare(gauges), bare(control), bare(events), bare(status), bare(states)
    at = 0
    trial = part(room, at, ny)
    at += ny
    begun = part(room, at, ny)
    at += ny
    start = part(room, at, n)  # k at the beginning of the step
    at += n
    k = part(room, at, n_stages * n)
    at += n_stages * n
    right = part(room, at, unknowns)
    at += unknowns
    change = part(room, at, unknowns)
    at += unknowns
    powers = part(room, at, n_stages)
    at += n_stages
    factors = part(room, at, n_stages * n_stages + 1)
    factors[0] = 1.0

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
    index, known, rejected = 0, False, False
    while t < until - tiny:
        if control[_STOP] != 0:
            return _STOPPED
        if not known:
            if rhs(t, y, p, w, iw, begun) != 0:
                confirm(t, y, p, w, iw, begun)
            control[_EVALUATIONS] += 1
            for i in range(n):
                if i < width:
                    start[i] = begun[i]
                else:
                    start[i] = w[multipliers + i - width] if i < width + m else 0.0
            known = True
        step = h if adaptive == 0 else approach(min(h, h_max), gauges)
        following = t0 + (index + 1) * h if adaptive == 0 else t + step
        if following > until - tiny or (adaptive == 1 and t + 1.01 * step >= until):
            following = until
            step = until - t
        if not step > 4e-16 * max(abs(t), abs(until)):
            return _TINY
        full = step
        partial = out < times.shape[0] and times[out] < following - tiny
        if partial:
            following = times[out]
            step = following - t
        w[_STEP_STATUS] = step
        for s in range(n_stages):
            for i in range(n):
                k[s * n + i] = start[i]
        converged = True
        groups = 1 if together == 1 else n_stages
        for group in range(groups):
            if together == 0 and a[group * n_stages + group] == 0.0:
                powers[group] = begun[width]
                continue  # an explicit first stage is the derivative that is known
            low, high = (0, n_stages) if together == 1 else (group, group + 1)
            last, fresh, converged = math.inf, True, False
            for _ in range(_MOST_ITERATIONS):
                if fresh:
                    for s in range(low, high):
                        stage_state(y, width, n, step, a, s, n_stages, k, trial)
                        stage = part(slopes, (s - low) * count, count)
                        tangent(t + c[s] * step, trial, part(k, s * n, n), p, w, stage)
                        for j in range(low, high):
                            factors[1 + (s - low) * (high - low) + j - low] = step * a[s * n_stages + j]
                    assemble(plan, slopes, factors, numbers)
                    while factorise(plan, numbers) < 0:
                        more = plan[ROOM]
                        plan, numbers = longer(plan, more), longer(numbers, more)
                        plan[ROOM] = 2 * more
                        assemble(plan, slopes, factors, numbers)
                    control[_JACOBIANS] += 1
                    fresh = False
                for s in range(low, high):
                    stage_state(y, width, n, step, a, s, n_stages, k, trial)
                    residual(t + c[s] * step, trial, part(k, s * n, n), p, w, part(right, (s - low) * n, n))
                    leave_out_rest(right, (s - low) * n, n, width, m, w, mask, k, s * n)
                    powers[s] = w[_POWER]
                    control[_EVALUATIONS] += 1
                solve(plan, numbers, right, change)
                control[_ITERATIONS] += 1
                moved, size = 0.0, 0.0
                for s in range(low, high):
                    for i in range(n):
                        k[s * n + i] -= change[(s - low) * n + i]
                        if i < width:
                            moved += change[(s - low) * n + i] ** 2
                            size += k[s * n + i] ** 2
                # stiff forces turn rounding of positions into noise of derivatives: how far the state moves counts
                length = 1.0
                for i in range(width):
                    length = max(length, abs(trial[i]))
                at_floor = math.sqrt(moved) * step < 1e-12 * length
                moved = math.sqrt(moved) / (1.0 + math.sqrt(size))
                if not math.isfinite(moved):
                    break
                if moved < 1e-13 or (moved > 0.3 * last and (moved < 1e-9 or at_floor)):
                    converged = True
                    break
                fresh = moved > 0.05 * last
                last = moved
            if not converged:
                break
        if not converged:
            if adaptive == 0:
                return _NEWTON
            control[_REJECTED] += 1
            h = 0.25 * step
            rejected = True
            continue
        if n > width + m:
            # multipliers of index 2 are of lower order than the state: the power comes from the law's own
            for s in range(n_stages):
                stage_state(y, width, n, step, a, s, n_stages, k, trial)
                if rhs(t + c[s] * step, trial, p, w, iw, part(right, 0, ny)) != 0:
                    confirm(t + c[s] * step, trial, p, w, iw, part(right, 0, ny))
                powers[s] = right[width]
            control[_EVALUATIONS] += n_stages
        for i in range(ny):
            trial[i] = y[i]
        for s in range(n_stages):
            for i in range(width):
                trial[i] += step * b[s] * k[s * n + i]
            trial[width] += step * b[s] * powers[s]
        error = 0.0
        if adaptive == 1 and not partial:
            for i in range(unknowns):
                right[i] = 0.0
            for i in range(width):
                total = errors[0] * start[i]
                for s in range(n_stages):
                    total += errors[s + 1] * k[s * n + i]
                change[i] = step * total
            if filter_factor > 0.0:
                tangent(t, y, start, p, w, part(slopes, 0, count))
                for e in range(count):
                    if entries[count + e] < width:
                        right[entries[e]] += slopes[e] * change[entries[count + e]]
                factors[1] = step * filter_factor
                assemble(filter_plan, slopes, factors, filter_numbers)
                while factorise(filter_plan, filter_numbers) < 0:
                    more = filter_plan[ROOM]
                    filter_plan, filter_numbers = longer(filter_plan, more), longer(filter_numbers, more)
                    filter_plan[ROOM] = 2 * more
                    assemble(filter_plan, slopes, factors, filter_numbers)
                solve(filter_plan, filter_numbers, right, change)
            for i in range(width):
                scale = atol + rtol * max(abs(y[i]), abs(trial[i]))
                error += (change[i] / scale) ** 2
            error = max(math.sqrt(error / width), work_error(step, errors, begun, powers, y, trial, gauges, rtol, atol))
            if not error <= 1.0:
                control[_REJECTED] += 1
                h = step * (max(0.2, 0.9 * error ** (-1.0 / (error_order + 1.0))) if math.isfinite(error) else 0.1)
                rejected = True
                continue
        iw[_PROBING] = 1 if partial else 0
        bits = accept(following, trial, p, w, iw)
        iw[_PROBING] = 0
        if partial:
            keep_maxima(w, trial[width], gauges)
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
        known = False
        control[_STEPS] += 1
        gauges[_STEP] = step
        code = watch(t, y, nq, w, gauges, control, events)
        if code != _DONE:
            return code
        if out < times.shape[0] and times[out] <= t + tiny:
            store(out, y, w, states, status)
            out += 1
            control[_OUTPUTS] = out
        if adaptive == 1:
            grow = min(8.0, max(0.2, 0.9 * max(error, 1e-12) ** (-1.0 / (error_order + 1.0))))
            h = full * (min(1.0, grow) if rejected else grow)
            rejected = False
    return _DONE
