"""The loop of the generalised-alpha family on the descriptor form: Newmark's scheme with or without numerical damping.

With the algorithmic acceleration a,

- ``q1 = q0 + d`` with ``d = h v0 + h^2 (1/2 - beta) a0 + h^2 beta a1``; in space bodies turn by the exponential of
  their part of d (Bruls, Cardona 2010); ``v1 = v0 + h (1 - gamma) a0 + h gamma a1``,
- ``(1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) v1' + alpha_f v0'``,

the equations of motion and the constraints, at position or acceleration level, hold at the end of the step (Arnold,
Bruls 2007). Unknowns of the Newton iteration are v1' and lambda.
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.runtime.bare import bare, part
from symgen.runtime.manifold import advance
from symgen.runtime.sparse import ROOM, assemble, factorise, leave_out_rest, longer, multiply, solve, turn_rows
from symgen.runtime.steps import store
from symgen.runtime.watch import begin, keep_maxima, watch
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]

_STOP, _STEPS, _EVALUATIONS, _OUTPUTS = abi.STOP, abi.STEPS, abi.EVALUATIONS, abi.OUTPUTS
_JACOBIANS, _ITERATIONS = abi.JACOBIANS, abi.NEWTON_ITERATIONS
_DONE, _STOPPED, _NOT_FINITE = abi.DONE, abi.STOPPED, abi.NOT_FINITE
_CORRECTION, _NEWTON = abi.CORRECTION, abi.NEWTON
_PHI, _STEP_STATUS, _PROBING, _POWER = abi.PHI, abi.STEP_STATUS, abi.PROBING, abi.POWER
_MOST_ITERATIONS = 20


@jit(
    _I8(
        *(abi.STAGE, abi.STAGE, abi.RHS, abi.RHS, abi.ACCEPT, abi.MOVE),
        *(_F8, _F8, _F8, _F8, _I8, _I8, _I8, _I8, _I8, _I8, _I8),
        *(_A, _A, _A, _I, _F8, _F8, _F8, _A, _M, _M, _A, _I, _A, _A, _A, _A, _I),
    ),
)
def alpha_steps(
    residual: Any,
    tangent: Any,
    rhs: Any,
    confirm: Any,
    accept: Any,
    turn: Any,
    alpha_m: float,
    alpha_f: float,
    gamma: float,
    beta: float,
    nq: int,
    nv: int,
    m: int,
    n: int,
    multipliers: int,
    mask: int,
    changes: int,
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
    slopes: Any,
    numbers: Any,
    plan: Any,
) -> int:
    """Integrate with constant steps; an output between two steps is reached by a shortened step of its own.

    Parameters
    ----------
    alpha_m, alpha_f, gamma, beta : float
        The scheme.
    turn : emitted function
        Moves positions in space; see `symgen.runtime.manifold`.
    n, multipliers, mask, changes : int
        Unknowns of a stage, and where the multipliers, the mask of redundant rows and the section ``change`` begin in
        `w`.
    room : Array
        Working memory.
    slopes : Array
        Sources of the Newton matrix: what ``tangent`` writes, products, and 1.
    numbers, plan : Array
        Of the Newton matrix, see `symgen.runtime.newton.alpha_plan`.

    Notes
    -----
    The algorithmic acceleration starts with ``a0 = v0' + (alpha_m - alpha_f) h v0''``: with a0 = v0' the
    multipliers would start with an error of order one.
    """
    width, ny, size = nq + nv, nq + nv + 1, n - nq
    y, p, w, iw = bare(y), bare(p), bare(w), bare(iw)
    gauges, control, events, status, states = bare(gauges), bare(control), bare(events), bare(status), bare(states)
    at = 0
    trial = part(room, at, ny)
    at += ny
    begun = part(room, at, ny)
    at += ny
    ahead = part(room, at, ny)
    at += ny
    k = part(room, at, n)
    at += n
    right = part(room, at, n)
    at += n
    change = part(room, at, n)
    at += n
    a0 = part(room, at, nv)
    at += nv
    a1 = part(room, at, nv)
    at += nv
    factors = part(room, at, 4)
    factors[0] = 1.0

    t, out, tiny, index = t0, 0, 1e-9 * h, 0
    accept(t, y, p, w, iw)
    begin(w, gauges)
    code = watch(t, y, nq, w, gauges, control, events)
    if code != _DONE:
        return code
    while out < times.shape[0] and times[out] <= t + tiny:
        store(out, y, w, states, status)
        out += 1
    control[_OUTPUTS] = out
    # v'' at the start from two evaluations; its error enters multiplied by h (alpha_m - alpha_f)
    if rhs(t, y, p, w, iw, begun) != 0:
        confirm(t, y, p, w, iw, begun)
    probe = 1e-4 * h
    for i in range(ny):
        trial[i] = y[i] + probe * begun[i]
    if rhs(t + probe, trial, p, w, iw, ahead) != 0:
        confirm(t + probe, trial, p, w, iw, ahead)
    for i in range(nv):
        a0[i] = begun[nq + i] + (alpha_m - alpha_f) * h * (ahead[nq + i] - begun[nq + i]) / probe
    if rhs(t, y, p, w, iw, begun) != 0:
        confirm(t, y, p, w, iw, begun)
    control[_EVALUATIONS] += 3
    for i in range(nv):
        k[nq + i] = begun[nq + i]
    for i in range(n - width):
        k[width + i] = w[multipliers + i]
    power = begun[width]
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
        ratio = (1.0 - alpha_f) / (1.0 - alpha_m)
        by_velocity, by_position = step * gamma * ratio, step * step * beta * ratio
        last, fresh, converged = math.inf, True, False
        for _ in range(_MOST_ITERATIONS):
            for i in range(nv):
                a1[i] = ((1.0 - alpha_f) * k[nq + i] + alpha_f * begun[nq + i] - alpha_m * a0[i]) / (1.0 - alpha_m)
                change[i] = step * y[nq + i] + step * step * ((0.5 - beta) * a0[i] + beta * a1[i])
                trial[nq + i] = y[nq + i] + step * ((1.0 - gamma) * a0[i] + gamma * a1[i])
                k[i] = trial[nq + i]
            advance(nq, nv, y, change, trial, w, changes, turn)
            if fresh:
                tangent(following, trial, k, p, w, slopes)
                multiply(plan, slopes)
                turn_rows(plan, slopes, change)
                factors[1], factors[2], factors[3] = by_velocity, by_position, -by_position
                assemble(plan, slopes, factors, numbers)
                while factorise(plan, numbers) < 0:
                    more = plan[ROOM]
                    plan, numbers = longer(plan, more), longer(numbers, more)
                    plan[ROOM] = 2 * more
                    assemble(plan, slopes, factors, numbers)
                control[_JACOBIANS] += 1
                fresh = False
            residual(following, trial, k, p, w, right)
            leave_out_rest(right, nq, size, nv, m, w, mask, k, nq)
            control[_EVALUATIONS] += 1
            solve(plan, numbers, part(right, nq, size), change)
            control[_ITERATIONS] += 1
            moved, total, length = 0.0, 0.0, 1.0
            for i in range(size):
                k[nq + i] -= change[i]
                if i < nv:
                    moved += change[i] ** 2
                    total += k[nq + i] ** 2
            for i in range(nq):
                length = max(length, abs(trial[i]))
            # rounding of positions is divided by the square of the step in accelerations: it decides where those stall
            at_floor = math.sqrt(moved) * by_position < 1e-12 * length
            moved = math.sqrt(moved) / (1.0 + math.sqrt(total))
            if not math.isfinite(moved):
                break
            if moved < 1e-12 or (moved > 0.3 * last and (moved < 1e-7 or at_floor)):
                converged = True
                break
            fresh = moved > 0.05 * last
            last = moved
        if not converged:
            return _NEWTON
        for i in range(nv):
            a1[i] = ((1.0 - alpha_f) * k[nq + i] + alpha_f * begun[nq + i] - alpha_m * a0[i]) / (1.0 - alpha_m)
            change[i] = step * y[nq + i] + step * step * ((0.5 - beta) * a0[i] + beta * a1[i])
            trial[nq + i] = y[nq + i] + step * ((1.0 - gamma) * a0[i] + gamma * a1[i])
        advance(nq, nv, y, change, trial, w, changes, turn)
        trial[width] = y[width] + 0.5 * step * (power + w[_POWER])
        iw[_PROBING] = 1 if partial else 0
        reached = w[_POWER]
        bits = accept(following, trial, p, w, iw)
        iw[_PROBING] = 0
        if partial:
            keep_maxima(w, trial[width], gauges)
            store(out, trial, w, states, status)
            out += 1
            control[_OUTPUTS] = out
            continue
        if bits & 1:
            return _CORRECTION if math.isfinite(w[_PHI]) else _NOT_FINITE
        for i in range(nv):
            a0[i] = a1[i]
            begun[nq + i] = k[nq + i]
        power = reached
        y, trial = trial, y
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
