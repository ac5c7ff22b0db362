"""Implicit Runge-Kutta schemes on the descriptor form F(t, y, k) = 0.

Stages are solved one after the other where the scheme allows (diagonally implicit), else together. Newton's iteration
uses the exact Jacobian that was emitted with the residual, evaluated at the stage's own iterate and kept while it
converges fast. It ends where the correction is small, or the residual is rounding of its terms. Rates of auxiliary
states come with the residual, so each iteration has those of the iterate before: where the last correction changed the
multipliers, whose work is among them, they are evaluated once more.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import copied, weigh
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.redundancy import leave_out_rest
from symgen.run.layout.scales import error_with_work, weights_of
from symgen.run.layout.scheme_records import STAGES, Stages
from symgen.run.loops import sparse
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import DIVERGED, TOO_LARGE, evaluate
from symgen.run.loops.sparse import solve

_MOST_ITERATIONS = 15
#: Corrections of rates below this part of them end an iteration.
_LEAST = 1e-13
#: Corrections of multipliers below this part of the largest one are rounding.
_SETTLED = 1e-9
#: Residuals below this part of their terms are rounding.
_GRAIN = 1e-14
#: As in the frame: whether steps follow the error estimate.
ADAPTIVE = False


@called
def begin_step(system: ModelSystem, run: Run, t: float) -> None:
    """Write the unknowns k and the rates of auxiliary states at the beginning of the step to the memory of the run."""
    sizes = system.sizes
    first, n, m = sizes.nq + sizes.nv, sizes.unknowns, sizes.m
    tail = n - sizes.states
    rate = part(run.room, 0, sizes.width)
    evaluate(system, run, t, run.y, rate)
    run.control[abi.EVALUATIONS] += 1
    for i in range(n):
        if i < first:
            run.memory[i] = rate[i]
        elif i >= tail:
            run.memory[i] = rate[first + 1 + i - tail]
        else:
            run.memory[i] = run.w[sizes.multipliers + i - first] if i < first + m else 0.0
    for i in range(first, sizes.ny):
        run.memory[n + i - first] = rate[i]
    run.control[abi.KNOWN] = 1


@called
def stage_state(system: ModelSystem, scheme: Stages, run: Run, h: float, stage: int, k: Array, rates: Array) -> None:
    """Set ``run.trial`` to y + h sum_j a[stage, j] y'_j; `rates` holds auxiliary states' rates, stage by stage."""
    first, n, ny = system.sizes.nq + system.sizes.nv, system.sizes.unknowns, system.sizes.ny
    copied(system.sizes.width, run.y, run.trial)
    for j in range(scheme.stages):
        factor = h * scheme.a[stage * scheme.stages + j]
        if factor != 0.0:
            for i in range(first):
                run.trial[i] += factor * k[j * n + i]
            for i in range(first, ny):
                run.trial[i] += factor * rates[j * (ny - first) + i - first]


def newton_verdict(moved: float, last: float, least: float, poor: float, at_floor: bool) -> int:
    """Return 1 where a Newton iteration has converged, -1 where it fails, 0 where it continues.

    It has converged where its correction is small, or where only rounding keeps it larger.

    Parameters
    ----------
    moved, last : float
        Length of this correction and of the one before.
    least, poor : float
        Limit of a correction; and that where corrections no longer shrink.
    at_floor : bool
        Whether the correction is rounding of positions.
    """
    if not math.isfinite(moved):
        return -1
    return 1 if moved < least or (moved > 0.3 * last and (moved < poor or at_floor)) else 0


@called
def is_rounding(
    system: ModelSystem,
    scheme: Stages,
    run: Run,
    h: float,
    low: int,
    high: int,
    k: Array,
    rates: Array,
    right: Array,
    terms: Array,
) -> bool:
    """Return whether the residuals `right` of some stages are rounding of their terms, as with stiff forces."""
    n, count = system.sizes.unknowns, scheme.entries.shape[0] // 2
    # columns after those of q and v are the file's own states, which follow the work in a state
    first, tail = system.sizes.nq + system.sizes.nv, n - system.sizes.states
    for s in range(low, high):
        stage_state(system, scheme, run, h, s, k, rates)
        for i in range(n):
            terms[i] = 0.0
        for e in range(count):
            j = scheme.entries[count + e]
            at = j - n if j < n + tail else j - n - tail + first + 1
            number = k[s * n + j] if j < n else run.trial[at]
            terms[scheme.entries[e]] += abs(scheme.slopes[(s - low) * count + e] * number)
        for i in range(n):
            if abs(right[(s - low) * n + i]) > _GRAIN * terms[i]:
                return False
    return True


def is_settled(multipliers: Array, change: Array) -> bool:
    """Return whether the last correction of the multipliers, `change`, is rounding."""
    largest = moved = 0.0
    for c in range(multipliers.shape[0]):
        largest, moved = max(largest, abs(multipliers[c])), max(moved, abs(change[c]))
    return moved <= _SETTLED * largest


def factorise_stages(
    system: ModelSystem,
    scheme: Stages,
    run: Run,
    t: float,
    h: float,
    low: int,
    high: int,
    k: Array,
    rates: Array,
    factors: Array,
) -> bool:
    """Factorise the Newton matrix of the stages from `low` to `high` (exclusive); return whether it has room."""
    n, s_count, count = system.sizes.unknowns, scheme.stages, scheme.entries.shape[0] // 2
    for s in range(low, high):
        stage_state(system, scheme, run, h, s, k, rates)
        slopes = part(scheme.slopes, (s - low) * count, count)
        system.tangent(t + scheme.c[s] * h, run.trial, part(k, s * n, n), run.p, run.w, slopes)
        for j in range(low, high):
            factors[1 + (s - low) * (high - low) + j - low] = h * scheme.a[s * s_count + j]
    if sparse.prepare_pattern(scheme.plan, scheme.slopes, factors, scheme.numbers) < 0:
        return False
    run.control[abi.JACOBIANS] += 1
    return True


def renew_rates(
    system: ModelSystem, scheme: Stages, run: Run, t: float, h: float, s: int, k: Array, rates: Array, rest: Array
) -> None:
    """Set the rates of auxiliary states at a stage from its present unknowns."""
    sizes = system.sizes
    n, more, states = sizes.unknowns, sizes.ny - sizes.nq - sizes.nv, sizes.states
    stage_state(system, scheme, run, h, s, k, rates)
    system.residual(t + scheme.c[s] * h, run.trial, part(k, s * n, n), run.p, run.w, rest)
    run.control[abi.EVALUATIONS] += 1
    for i in range(more):
        if i == 0 or i > states:
            rates[s * more + i] = run.w[sizes.auxiliary + (i - states if i > 0 else 0)]


def take_rates_of_law(
    system: ModelSystem, scheme: Stages, run: Run, t: float, h: float, k: Array, rates: Array
) -> None:
    """Have auxiliary states follow the law: multipliers of index 2 are of lower order than the state."""
    sizes = system.sizes
    first, of_law = sizes.nq + sizes.nv, part(run.room, 0, sizes.width)
    more = sizes.ny - first
    for s in range(scheme.stages):
        stage_state(system, scheme, run, h, s, k, rates)
        evaluate(system, run, t + scheme.c[s] * h, run.trial, of_law)
        for i in range(more):
            rates[s * more + i] = of_law[first + i]
    run.control[abi.EVALUATIONS] += scheme.stages


@called
def attempt(
    system: ModelSystem, scheme: Stages, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Solve the stages of a step."""
    sizes, s_count = system.sizes, scheme.stages
    n, more = sizes.unknowns, sizes.ny - sizes.nq - sizes.nv
    if run.control[abi.KNOWN] == 0:
        begin_step(system, run, t)
    k = part(run.room, sizes.width, s_count * n)
    rates = part(run.room, sizes.width + s_count * n, s_count * more)
    for s in range(s_count):
        for i in range(n):
            k[s * n + i] = run.memory[i]
        for i in range(more):
            rates[s * more + i] = run.memory[n + i]
    end = solve_stages(system, scheme, run, t, h, _LEAST)
    if end != 0.0:
        return end
    return step_error(system, scheme, span, run, t, h, k, rates) if ADAPTIVE and not between else 0.0


@called
def solve_stages(system: ModelSystem, scheme: Stages, run: Run, t: float, h: float, least: float) -> float:
    """Solve the stages of a step from guesses in the working memory, and set the trial state; return 0 or a failure.

    After the first `width` numbers of ``run.room`` are the unknowns of all stages, then rates of auxiliary states.

    Parameters
    ----------
    least : float
        The iteration has converged where a correction of rates is below this part of them.
    """
    sizes, s_count = system.sizes, scheme.stages
    first, n, ny = sizes.nq + sizes.nv, sizes.unknowns, sizes.ny
    more, tail, states = ny - first, n - sizes.states, sizes.states
    k = part(run.room, sizes.width, s_count * n)
    rates = part(run.room, sizes.width + s_count * n, s_count * more)
    at = sizes.width + s_count * (n + more)
    unknowns = s_count * n if scheme.together == 1 else n
    right, change = part(run.room, at, unknowns), part(run.room, at + unknowns, unknowns)
    factors = part(run.room, at + 2 * unknowns, s_count * s_count + 1)
    factors[0], terms = 1.0, part(run.room, at + 2 * unknowns + s_count * s_count + 1, n)
    groups = 1 if scheme.together == 1 else s_count
    for group in range(groups):
        if scheme.together == 0 and scheme.a[group * s_count + group] == 0.0:
            continue  # an explicit first stage is the known derivative
        low, high = (0, s_count) if scheme.together == 1 else (group, group + 1)
        last, fresh, end = math.inf, True, 0
        for _ in range(_MOST_ITERATIONS):
            if fresh:
                if not factorise_stages(system, scheme, run, t, h, low, high, k, rates, factors):
                    return TOO_LARGE
                fresh = False
            moved, size = 0.0, 0.0
            for s in range(low, high):
                stage_state(system, scheme, run, h, s, k, rates)
                own, rest = part(k, s * n, n), part(right, (s - low) * n, n)
                system.residual(t + scheme.c[s] * h, run.trial, own, run.p, run.w, rest)
                leave_out_rest(sizes, run.w, own, rest)
                for i in range(more):
                    if 0 < i <= states:
                        continue  # rates of states are unknowns
                    rate = run.w[sizes.auxiliary + (i - states if i > 0 else 0)]
                    share = run.share[first + i]  # 1 where it takes part in error control, else 0
                    moved += share * (rate - rates[s * more + i]) ** 2
                    size += share * rate**2
                    rates[s * more + i] = rate
                run.control[abi.EVALUATIONS] += 1
            solve(scheme.plan, scheme.numbers, right, change)
            run.control[abi.NEWTON_ITERATIONS] += 1
            for s in range(low, high):
                for i in range(n):
                    k[s * n + i] -= change[(s - low) * n + i]
                    if i < first:
                        moved += (run.scales[i] * change[(s - low) * n + i]) ** 2
                        size += (run.scales[i] * k[s * n + i]) ** 2
                    elif i >= tail:
                        rates[s * more + 1 + i - tail] = k[s * n + i]
                        scale = 1.0 / (1.0 + abs(k[s * n + i]))  # relative, so that pressures hide no lengths
                        moved += (scale * change[(s - low) * n + i]) ** 2
                        size += (scale * k[s * n + i]) ** 2
            # stiff forces turn rounding of positions into noise of derivatives: the change of the state counts
            length = 1.0
            for i in range(first):
                length = max(length, run.scales[i] * abs(run.trial[i]))
            at_floor = math.sqrt(moved) * h < 1e-12 * length
            moved = math.sqrt(moved) / (run.w[abi.SPEED] / run.w[abi.LENGTH] + math.sqrt(size))
            end = newton_verdict(moved, last, least, 1e-9, at_floor)
            if end == 0 and moved > 0.3 * last:
                end = 1 if is_rounding(system, scheme, run, h, low, high, k, rates, right, terms) else 0
            if end != 0:
                break
            fresh, last = moved > 0.05 * last, moved
        if end <= 0:
            return DIVERGED
        if sizes.m == 0 or tail > first + sizes.m:
            continue
        for s in range(low, high):
            at_stage, at_change = s * n + first, (s - low) * n + first
            if not is_settled(part(k, at_stage, sizes.m), part(change, at_change, sizes.m)):
                renew_rates(system, scheme, run, t, h, s, k, rates, part(right, 0, n))
    if tail > first + sizes.m:
        take_rates_of_law(system, scheme, run, t, h, k, rates)
    copied(sizes.width, run.y, run.trial)
    for s in range(s_count):
        for i in range(first):
            run.trial[i] += h * scheme.b[s] * k[s * n + i]
        for i in range(more):
            run.trial[first + i] += h * scheme.b[s] * rates[s * more + i]
    return 0.0


@called
def step_error(
    system: ModelSystem, scheme: Stages, span: Span, run: Run, t: float, h: float, k: Array, rates: Array
) -> float:
    """Return the error estimate over the tolerance, filtered; `k` and `rates` belong to the stages."""
    sizes, s_count, errors = system.sizes, scheme.stages, scheme.errors
    first, n, ny, count = sizes.nq + sizes.nv, sizes.unknowns, sizes.ny, scheme.entries.shape[0] // 2
    more, size = ny - first, max(n, sizes.width)
    at, tail = sizes.width + s_count * (n + more), n - sizes.states
    right, change = part(run.room, at, size), part(run.room, at + size, size)
    run.control[abi.ORDER] = scheme.order + 1
    for i in range(size):
        right[i] = change[i] = 0.0
    for i in range(n):
        if i < first or i >= tail:
            total = errors[0] * run.memory[i]
            for s in range(s_count):
                total += errors[s + 1] * k[s * n + i]
            change[i] = h * total
    if scheme.filtered > 0.0:
        factors = part(run.room, at + 2 * size, 2)
        system.tangent(t, run.y, run.memory, run.p, run.w, part(scheme.slopes, 0, count))
        for e in range(count):
            if scheme.entries[count + e] < first or (
                tail <= scheme.entries[count + e] and scheme.entries[count + e] < n
            ):
                right[scheme.entries[e]] += scheme.slopes[e] * change[scheme.entries[count + e]]
        factors[0], factors[1] = 1.0, h * scheme.filtered
        if sparse.prepare_pattern(scheme.filter_plan, scheme.slopes, factors, scheme.filter_numbers) < 0:
            return TOO_LARGE
        solve(scheme.filter_plan, scheme.filter_numbers, right, change)
    for i in range(tail, n):
        right[i] = change[i]
    for i in range(first, sizes.width):
        change[i] = 0.0
    for i in range(tail, n):
        change[first + 1 + i - tail] = right[i]
    for i in range(more):
        if 0 < i <= sizes.states:
            continue
        total = errors[0] * run.memory[n + i]
        for s in range(s_count):
            total += errors[s + 1] * rates[s * more + i]
        change[first + i] = h * total
    share = weights_of(span, run)
    error = math.sqrt(weigh(sizes.width, change, share, run.y, run.trial, span.rtol, span.atol) / sizes.controlled)
    # the work enters no rate, so it needs no filter; where every coordinate is driven nothing else is integrated, since
    # constraints in every stage make the other estimates 0
    return error_with_work(system.sizes, span, run, change[first], error)


def renew(system: ModelSystem, scheme: Stages, span: Span, run: Run, t: float, changed: bool) -> None:
    """Make the next step evaluate its beginning."""
    run.control[abi.KNOWN] = 0


def memory(width: int, unknowns: int, more: int, stages: int, together: bool) -> tuple[int, int]:
    """Return the lengths of the memory of a run, and of the working memory of a step after the trial state.

    The memory holds the unknowns at the beginning of a step, and rates of `more` auxiliary states.
    """
    solved = max(width, unknowns, stages * unknowns if together else 0)
    return unknowns + more, width + stages * (unknowns + more) + 2 * solved + stages * stages + 2 + unknowns


_PARTS: dict[str, Any] = {"attempt": attempt, "renew": renew}
_ADAPTIVE: dict[str, Any] = {**_PARTS, "ADAPTIVE": True, "GROW": 8.0, "FLOOR": 1e-12}

constant = loop(__name__, "constant", STAGES, "residual", "tangent", **_PARTS)
adaptive = loop(__name__, "adaptive", STAGES, "residual", "tangent", **_ADAPTIVE)
