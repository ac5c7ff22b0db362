"""Linearly implicit Runge-Kutta schemes (Rosenbrock) on the descriptor form F(t, y, k) = 0, y' = k.

All stages of a step have the matrix dF/dk + h gamma dF/dy at its beginning, which is factorised once, and each is one
solution. With changes U of k and V of y, stage i solves

    F(t_i, y + sum a_ij V_j, K) + dF/dk U_i + dF/dy V_i + gamma_i h dF/dt = 0,   K = k + sum a_ij U_j,
    V_i = h gamma (U_i + K + sum c_ij V_j / h)

(E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section VI.4, for y' = k with F as a constraint).
dF/dt is a difference of second order, forward in time: what happened before a step is no part of it. Multipliers have
no change of state. The work, which no force reads, and integrals follow by Simpson's rule on both halves of a step, at
states of Hermite's polynomial that one more solution brings to the balance of forces.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import copied, weigh
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Run, Sizes, Span
from symgen.run.layout.redundancy import leave_out_rest
from symgen.run.layout.scales import error_with_work, weights_of
from symgen.run.layout.scheme_records import LINEAR, Linear
from symgen.run.loops import sparse
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import DIVERGED, TOO_LARGE, evaluate
from symgen.run.loops.schemes.implicit import begin_step, renew
from symgen.run.loops.sparse import solve

#: Step of the difference in t, over that of the scheme.
_APART = 1e-3
#: As in the frame: whether steps follow the error estimate.
ADAPTIVE = False


@called
def add_changes(sizes: Sizes, weight: float, change: Array, state: Array) -> None:
    """Add a multiple of changes of q, v and the file's own states to a state, in which the work stands between them."""
    first, tail = sizes.nq + sizes.nv, sizes.unknowns - sizes.states
    for i in range(first):
        state[i] += weight * change[i]
    for i in range(sizes.states):
        state[first + 1 + i] += weight * change[tail + i]


@called
def attempt(
    system: ModelSystem, scheme: Linear, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Solve the stages of a step."""
    sizes, s_count, gamma = system.sizes, scheme.stages, h * scheme.filtered
    first, n, width = sizes.nq + sizes.nv, sizes.unknowns, sizes.width
    tail, count = n - sizes.states, scheme.entries.shape[0] // 2
    if run.control[abi.KNOWN] == 0:
        begin_step(system, run, t)
    known = part(run.memory, 0, n)
    u, v = part(run.room, width, s_count * n), part(run.room, width + s_count * n, s_count * n)
    at = width + 2 * s_count * n
    right, change, k = part(run.room, at, n), part(run.room, at + n, n), part(run.room, at + 2 * n, n)
    drift, moved = part(run.room, at + 3 * n, n), part(run.room, at + 4 * n, n)
    factors = part(run.room, at + 5 * n, 2)
    system.tangent(t, run.y, known, run.p, run.w, part(scheme.slopes, 0, count))
    factors[0], factors[1] = 1.0, gamma
    if sparse.prepare_pattern(scheme.filter_plan, scheme.slopes, factors, scheme.filter_numbers) < 0:
        return TOO_LARGE
    run.control[abi.JACOBIANS] += 1
    for i in range(n):
        drift[i] = 0.0
    for place in range(3):
        weight = (-1.5 if place == 0 else (2.0 if place == 1 else -0.5)) / _APART
        for i in range(n):
            k[i] = known[i]
        system.residual(t + place * _APART * h, run.y, k, run.p, run.w, right)
        leave_out_rest(sizes, run.w, k, right)
        for i in range(n):
            drift[i] += weight * right[i]
    for s in range(s_count):
        copied(width, run.y, run.trial)
        for i in range(n):
            k[i], moved[i] = known[i], 0.0
        for j in range(s):
            a, c = scheme.a[s * s_count + j], scheme.carried[s * s_count + j] / h
            for i in range(n):
                k[i] += a * u[j * n + i]
                moved[i] += c * v[j * n + i]
            add_changes(sizes, a, part(v, j * n, n), run.trial)
        system.residual(t + scheme.c[s] * h, run.trial, k, run.p, run.w, right)
        leave_out_rest(sizes, run.w, k, right)
        for i in range(n):
            moved[i] = gamma * (k[i] + moved[i]) if i < first or i >= tail else 0.0
            right[i] += scheme.drifts[s] * drift[i]
        for e in range(count):
            j = scheme.entries[count + e]
            if j >= n:
                right[scheme.entries[e]] += scheme.slopes[e] * moved[j - n]
        solve(scheme.filter_plan, scheme.filter_numbers, right, change)
        for i in range(n):
            u[s * n + i] = -change[i]
            v[s * n + i] = moved[i] - gamma * change[i] if i < first or i >= tail else 0.0
    run.control[abi.EVALUATIONS] += s_count + 3
    copied(width, run.y, run.trial)
    for s in range(s_count):
        add_changes(sizes, scheme.b[s], part(v, s * n, n), run.trial)
    for i in range(first):
        if not math.isfinite(run.trial[i]):
            return DIVERGED
    simpson = follow_integrals(system, scheme, run, t, h, part(run.room, at, 5 * n + 2 + 4 * width))
    if not ADAPTIVE or between:
        return 0.0
    off = part(run.room, at + 5 * n + 2, width)
    for i in range(width):
        off[i] = 0.0
    for s in range(s_count):
        add_changes(sizes, scheme.errors[s], part(v, s * n, n), off)
    run.control[abi.ORDER] = scheme.order + 1
    share = weights_of(span, run)
    error = math.sqrt(weigh(width, off, share, run.y, run.trial, span.rtol, span.atol) / sizes.controlled)
    return error_with_work(sizes, span, run, simpson, error)


@called
def follow_integrals(system: ModelSystem, scheme: Linear, run: Run, t: float, h: float, room: Array) -> float:
    """Move the work and other integrals by Simpson's rule on halves of the step; return the error of the work.

    Between the ends a polynomial is off by parts of the tolerance, which a stiff force turns into work that nobody
    does. One solution with the matrix of the step brings its states to the balance of forces.
    """
    sizes, width, gamma = system.sizes, system.sizes.width, h * scheme.filtered
    first, n = sizes.nq + sizes.nv, sizes.unknowns
    right, change, k = part(room, 0, n), part(room, n, n), part(room, 2 * n, n)
    inner, rate, end = part(room, 5 * n + 2, width), part(room, 5 * n + 2 + width, width), part(run.room, 0, width)
    total, coarse = part(room, 5 * n + 2 + 2 * width, width), part(room, 5 * n + 2 + 3 * width, width)
    last = part(room, 3 * n, n)
    evaluate(system, run, t + h, run.trial, end)
    run.control[abi.EVALUATIONS] += 7
    for i in range(first, sizes.ny):
        total[i] = coarse[i] = run.memory[n + i - first] + end[i]
    for c in range(n - first):
        last[first + c] = run.w[sizes.multipliers + c] if c < sizes.m else 0.0
    for quarter in range(1, 4):
        x = 0.25 * quarter
        for i in range(n):
            k[i] = (1.0 - x) * run.memory[i] + x * last[i]
        for i in range(sizes.ny):
            begin = run.memory[i] if i < first else run.memory[n + i - first]
            at_begin, at_end = (1.0 + 2.0 * x) * run.y[i] + x * h * begin, (3.0 - 2.0 * x) * run.trial[i]
            inner[i] = (1.0 - x) ** 2 * at_begin + x**2 * (at_end - (1.0 - x) * h * end[i])
            slope = 6.0 * x * (1.0 - x) * (run.trial[i] - run.y[i]) / h
            slope += (1.0 - x) * (1.0 - 3.0 * x) * begin + x * (3.0 * x - 2.0) * end[i]
            if i < first:
                k[i] = slope
            elif first < i <= first + sizes.states:
                k[n - sizes.states + i - first - 1] = slope
        system.residual(t + x * h, inner, k, run.p, run.w, right)
        leave_out_rest(sizes, run.w, k, right)
        solve(scheme.filter_plan, scheme.filter_numbers, right, change)
        add_changes(sizes, -gamma, change, inner)
        evaluate(system, run, t + x * h, inner, rate)
        for i in range(first, sizes.ny):
            total[i] += (2.0 if quarter == 2 else 4.0) * rate[i]
            coarse[i] += 4.0 * rate[i] if quarter == 2 else 0.0
    for i in range(first, sizes.ny):
        if i == first or i - first > sizes.states:
            run.trial[i] = run.y[i] + h / 12.0 * total[i]
    error: float = h / 12.0 * total[first] - h / 6.0 * coarse[first]
    return error


def memory(width: int, unknowns: int, more: int, stages: int) -> tuple[int, int]:
    """Return the lengths of the memory of a run, and of the working memory of a step after the trial state."""
    return unknowns + more, 5 * width + (2 * stages + 5) * unknowns + 2


_PARTS: dict[str, Any] = {"attempt": attempt, "renew": renew}
constant = loop(__name__, "constant", LINEAR, "residual", "tangent", **_PARTS)
adaptive = loop(__name__, "adaptive", LINEAR, "residual", "tangent", **_PARTS, ADAPTIVE=True)
