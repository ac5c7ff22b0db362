"""The loop of the index-3 augmented Lagrangian method with projections: trapezoidal rule in positions.

With ``v1 = 2/h d - v0`` and ``a1 = 4/h^2 d - 4/h v0 - a0``, d = q1 - q0 or in space the displacements and rotation
vectors of the bodies over the step, the equations of motion at the end of the step are solved for q1 with the leading
matrix ``W = M + h/2 C + h^2/4 (a D^T D + K)``, the multipliers being raised by a Phi in every iteration. Then
velocities and accelerations are projected with the same matrix, ``W v = (W - h^2/4 a D^T D) v* + h^2/4 a D^T nu``,
iterated, since one pass leaves a residual.
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.runtime.bare import bare, part
from symgen.runtime.manifold import advance
from symgen.runtime.sparse import ROOM, assemble, factorise, longer, multiply, solve, turn_rows
from symgen.runtime.steps import store
from symgen.runtime.watch import begin, keep_maxima, watch
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]

_STOP, _STEPS, _EVALUATIONS, _OUTPUTS = abi.STOP, abi.STEPS, abi.EVALUATIONS, abi.OUTPUTS
_JACOBIANS, _ITERATIONS = abi.JACOBIANS, abi.NEWTON_ITERATIONS
_DONE, _STOPPED, _NEWTON = abi.DONE, abi.STOPPED, abi.NEWTON
_STEP_STATUS, _PROBING = abi.STEP_STATUS, abi.PROBING
_MOST_ITERATIONS = 100
#: h^2/4 a is at least this many times the largest mass: below, the iterations of short steps would not converge.
_LEAST_PENALTY = 1e3


@jit()
def lead(step: float, penalty: float, delta: Any, plan: Any, numbers: Any, slopes: Any, factors: Any) -> bool:
    """Factorise W from what ``tangent`` wrote; return whether there was room for it."""
    quarter = 0.25 * step * step
    factors[0], factors[1], factors[2], factors[3], factors[4] = 1.0, 0.5 * step, quarter, -quarter, quarter * penalty
    multiply(plan, slopes)
    turn_rows(plan, slopes, delta)
    assemble(plan, slopes, factors, numbers)
    return bool(factorise(plan, numbers) >= 0)


@jit()
def pull_back(factor: float, nv: int, forces: Any, slopes: Any, rest: Any, at: int, right: Any) -> None:
    """Set right = factor D^T times the residuals from index `at` of `rest`."""
    for i in range(nv):
        right[i] = 0.0
    for e in range(0, forces.shape[0], 3):
        right[forces[e + 1]] += factor * slopes[forces[e + 2]] * rest[at + forces[e]]


@jit(
    _I8(
        *(abi.STAGE, abi.STAGE, abi.RHS, abi.RHS, abi.ACCEPT, abi.MOVE, _F8, _I8, _I8, _I8, _I8, _I8),
        *(_A, _A, _A, _I, _F8, _F8, _F8, _A, _M, _M, _A, _I, _A),
        *(_A, _A, _A, _I, _I, _I),
    ),
)
def projected_steps(
    residual: Any,
    tangent: Any,
    rhs: Any,
    confirm: Any,
    accept: Any,
    turn: Any,
    penalty: float,
    nq: int,
    nv: int,
    m: int,
    multipliers: int,
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
    pulls: Any,
    masses: Any,
) -> int:
    """Integrate with constant steps; an output between two steps is reached by a shortened step of its own.

    Parameters
    ----------
    room : Array
        Working memory.
    slopes : Array
        Sources of W: what ``tangent`` writes, then products.
    numbers, plan : Array
        Of W, see `symgen.runtime.newton.projection_plan`.
    pulls : Array of int64
        Row, velocity and source of each entry of D^T.
    masses : Array of int64
        Sources of the diagonal of M.
    """
    width, ny, n = nq + nv, nq + nv + 1, nq + nv + m
    y, p, w, iw = bare(y), bare(p), bare(w), bare(iw)
    gauges, control, events, status, states = bare(gauges), bare(control), bare(events), bare(status), bare(states)
    at = 0
    trial = part(room, at, ny)
    at += ny
    begun = part(room, at, ny)
    at += ny
    k = part(room, at, n)
    at += n
    rest = part(room, at, n + 2 * m)
    at += n + 2 * m
    right = part(room, at, nv)
    at += nv
    change = part(room, at, nv)
    at += nv
    shift = part(room, at, nv)  # of positions over the step, in the coordinates of v
    at += nv
    forces = part(room, at, m)  # multipliers at the beginning of the step
    at += m
    held = part(room, at, m)  # the same in the iteration
    at += m
    rate = part(room, at, ny)
    at += ny
    factors = part(room, at, 5)

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
    if rhs(t, y, p, w, iw, begun) != 0:
        confirm(t, y, p, w, iw, begun)
    control[_EVALUATIONS] += 1
    for c in range(m):
        forces[c] = w[multipliers + c]
    power = begun[width]
    heaviest = 0.0
    for i in range(n):
        k[i] = 0.0
    tangent(t, y, k, p, w, slopes)
    for i in range(masses.shape[0]):
        heaviest = max(heaviest, slopes[masses[i]])
    asked = penalty
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
        quarter = 0.25 * step * step
        penalty = max(asked, _LEAST_PENALTY * heaviest / quarter)
        for i in range(nv):
            shift[i] = step * y[nq + i] + 0.5 * step * step * begun[nq + i]
        advance(nq, nv, y, shift, trial, w, changes, turn)
        for c in range(m):
            held[c] = forces[c]
            k[width + c] = forces[c]
        last, fresh, converged = math.inf, True, False
        for iteration in range(_MOST_ITERATIONS):
            for i in range(nv):
                trial[nq + i] = 2.0 / step * shift[i] - y[nq + i]
                k[i] = trial[nq + i]
                k[nq + i] = 4.0 / (step * step) * shift[i] - 4.0 / step * y[nq + i] - begun[nq + i]
            residual(following, trial, k, p, w, rest)
            for c in range(m):
                if iteration > 0:
                    held[c] += penalty * rest[width + c]
                k[width + c] = held[c] + penalty * rest[width + c]
            residual(following, trial, k, p, w, rest)
            control[_EVALUATIONS] += 2
            if fresh:
                tangent(following, trial, k, p, w, slopes)
                while not lead(step, penalty, shift, plan, numbers, slopes, factors):
                    more = plan[ROOM]
                    plan, numbers = longer(plan, more), longer(numbers, more)
                    plan[ROOM] = 2 * more
                control[_JACOBIANS] += 1
                fresh = False
            for i in range(nv):
                right[i] = quarter * rest[nq + i]
            solve(plan, numbers, right, change)
            control[_ITERATIONS] += 1
            moved, total, violation = 0.0, 0.0, 0.0
            for i in range(nv):
                shift[i] -= change[i]
                moved += change[i] ** 2
            advance(nq, nv, y, shift, trial, w, changes, turn)
            for i in range(nq):
                total += trial[i] ** 2
            for c in range(m):
                violation += rest[width + c] ** 2
            moved = max(math.sqrt(moved), math.sqrt(violation)) / (1.0 + math.sqrt(total))
            if not math.isfinite(moved):
                break
            if moved < 1e-14 or (moved > 0.5 * last and moved < 1e-11):
                converged = True
                break
            fresh = moved > 0.5 * last
            last = moved
        if not converged:
            return _NEWTON
        for i in range(nv):
            trial[nq + i] = 2.0 / step * shift[i] - y[nq + i]
            k[nq + i] = 4.0 / (step * step) * shift[i] - 4.0 / step * y[nq + i] - begun[nq + i]
        tangent(following, trial, k, p, w, slopes)
        while not lead(step, penalty, shift, plan, numbers, slopes, factors):
            more = plan[ROOM]
            plan, numbers = longer(plan, more), longer(numbers, more)
            plan[ROOM] = 2 * more
        for level in range(2):  # velocities, then accelerations
            last = math.inf
            for _ in range(_MOST_ITERATIONS):
                for i in range(nv):
                    k[i] = trial[nq + i]
                residual(following, trial, k, p, w, rest)
                control[_EVALUATIONS] += 1
                violation = 0.0
                for c in range(m):
                    violation += rest[n + level * m + c] ** 2
                violation = math.sqrt(violation)
                if violation > 0.95 * last or violation == 0.0:
                    break
                last = violation
                pull_back(quarter * penalty, nv, pulls, slopes, rest, n + level * m, right)
                solve(plan, numbers, right, change)
                for i in range(nv):
                    if level == 0:
                        trial[nq + i] -= change[i]
                    else:
                        k[nq + i] -= change[i]
        # multipliers of the iteration belong to accelerations before their projection, of order 1: the power comes from
        # those of the law
        if rhs(following, trial, p, w, iw, rate) != 0:
            confirm(following, trial, p, w, iw, rate)
        control[_EVALUATIONS] += 1
        reached = rate[width]
        trial[width] = y[width] + 0.5 * step * (power + reached)
        iw[_PROBING] = 1 if partial else 0
        accept(following, trial, p, w, iw)
        iw[_PROBING] = 0
        if partial:
            keep_maxima(w, trial[width], gauges)
            store(out, trial, w, states, status)
            out += 1
            control[_OUTPUTS] = out
            continue
        for i in range(nv):
            begun[nq + i] = k[nq + i]
        for c in range(m):
            forces[c] = held[c]
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
