"""Partitioned half-explicit Runge-Kutta pairs: each stage is explicit, and its multipliers close a state of its own.

State i is ``V_i = v + h sum_(j<i) a_ij V'_j``; its multipliers, in ``M V'_i = f_i - D_i^T lambda_i``, close the state
``v + h sum_(j<=i) e_ij V'_j``, which for the last stage is the end of the step. Accelerations at the beginning are
those of the law. Bodies in space turn by exponentials (`symgen.run.loops.schemes.lie`).
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import weigh
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.manifold import advance_coordinates
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scales import error_with_work, weights_of
from symgen.run.layout.scheme_records import PARTITIONED, PartitionedStages
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import TOO_LARGE, evaluate
from symgen.run.loops.schemes.constrained import (
    auxiliary_rates,
    carry_slopes,
    factorise_stage,
    slopes_at,
    solve_stage,
    step_parts,
)
from symgen.run.loops.schemes.explicit import prepare, renew
from symgen.run.loops.schemes.lie import FOURTH, exponential_rate


def combine_stages(
    system: ModelSystem, run: Run, h: float, weights: Array, count: int, turning: Array, moved: Array, y: Array
) -> None:
    """Set `y` to the state at the beginning moved by `count` stages with these weights; `moved` gets its turn."""
    sizes = system.sizes
    nq, nv, width = sizes.nq, sizes.nv, sizes.width
    for i in range(nv):
        moved[i] = 0.0
    for i in range(nq, sizes.ny):
        y[i] = run.y[i]
    for j in range(count):
        factor = h * weights[j]
        for i in range(nv):
            moved[i] += factor * turning[j * nv + i]
        for i in range(nq, sizes.ny):
            y[i] += factor * run.memory[j * width + i]
    advance_coordinates(system, run, moved, y)


@called
def follow_stages(
    system: ModelSystem, scheme: PartitionedStages, run: Run, t: float, following: float, h: float
) -> bool:
    """Set the trial state to the end of a step; return whether its factors had room."""
    sizes, s_count = system.sizes, scheme.stages
    nq, nv, m, n, first, width = sizes.nq, sizes.nv, sizes.m, sizes.unknowns, sizes.nq + sizes.nv, sizes.width
    right, x, factors, k, rest, held, moved, further = step_parts(sizes, run.room)
    turning = part(further, 0, (s_count + 1) * nv)
    run.control[abi.KNOWN] = 0
    for i in range(n):
        k[i] = 0.0
    for i in range(nv):
        moved[i] = 0.0
    exponential_rate(run.y, nq, moved, scheme.spins, nv, FOURTH, turning)
    for s in range(1, s_count):
        row, closing = part(scheme.a, s * s_count, s_count), part(scheme.closing, s * s_count, s_count)
        now = t + scheme.c[s] * h
        after = following if scheme.closed[s] == 1.0 else t + scheme.closed[s] * h
        reach = h * closing[s]
        combine_stages(system, run, h, row, s, turning, moved, held)
        exponential_rate(held, nq, moved, scheme.spins, nv, FOURTH, part(turning, s * nv, nv))
        slopes_at(system, scheme, run, now, held, k, 0)
        system.residual(now, held, k, run.p, run.w, rest)
        for i in range(nv):
            right[i] = -rest[nq + i]
        # rates of this stage are not there yet: positions need its velocities only
        for i in range(nq, sizes.ny):
            run.memory[s * width + i] = 0.0
        combine_stages(system, run, h, closing, s + 1, turning, moved, run.trial)
        slopes_at(system, scheme, run, after, run.trial, k, 1)
        system.residual(after, run.trial, k, run.p, run.w, rest)
        for c in range(m):
            right[nv + c] = -rest[n + c] / reach
        if not factorise_stage(scheme, factors):
            return False
        solve_stage(system, scheme, run, right, x)
        for i in range(nv):
            k[nq + i] = run.memory[s * width + nq + i] = x[i]
        for c in range(m):
            k[first + c] = x[nv + c]
        system.residual(now, held, k, run.p, run.w, rest)
        auxiliary_rates(system, run, rest, part(run.memory, s * width + first, sizes.ny - first))
        for i in range(n):
            k[i] = 0.0
    last = part(run.memory, (s_count - 1) * width, width)
    for i in range(nq, sizes.ny):
        run.trial[i] += h * scheme.closing[s_count * s_count - 1] * last[i]
    run.control[abi.EVALUATIONS] += 3 * (s_count - 1)
    run.control[abi.JACOBIANS] += s_count - 1
    return True


@called
def attempt_partitioned(
    system: ModelSystem,
    scheme: PartitionedStages,
    span: Span,
    run: Run,
    t: float,
    following: float,
    h: float,
    between: bool,
) -> float:
    """Try a step without an error estimate."""
    return 0.0 if follow_stages(system, scheme, run, t, following, h) else TOO_LARGE


@called
def attempt(
    system: ModelSystem,
    scheme: PartitionedStages,
    span: Span,
    run: Run,
    t: float,
    following: float,
    h: float,
    between: bool,
) -> float:
    """Try a step; return its error over the tolerance, by the embedded scheme, whose velocities are projected."""
    if not follow_stages(system, scheme, run, t, following, h):
        return TOO_LARGE
    sizes, s_count = system.sizes, scheme.stages
    nq, nv, m, n, first, width = sizes.nq, sizes.nv, sizes.m, sizes.unknowns, sizes.nq + sizes.nv, sizes.width
    factors, right, x = part(run.room, 0, 2), part(run.room, 2, nv + m), part(run.room, 2 + nv + m, nv + m)
    at = 2 + 2 * (nv + m)
    k, rest, other = part(run.room, at, n), part(run.room, at + n, n + m), part(run.room, at + 2 * n + m, width)
    at += 2 * n + m + width
    moved, turning = part(run.room, at, nv), part(run.room, at + nv, (s_count + 1) * nv)
    evaluate(system, run, following, run.trial, part(run.memory, s_count * width, width))
    run.control[abi.EVALUATIONS] += 2
    run.control[abi.KNOWN] = 1
    exponential_rate(run.trial, nq, moved, scheme.spins, nv, FOURTH, part(turning, s_count * nv, nv))
    combine_stages(system, run, h, scheme.embedded, s_count + 1, turning, moved, other)
    # multipliers of stages are of lower order: without the projection the estimate would be of theirs
    slopes_at(system, scheme, run, following, run.trial, k, 1)
    carry_slopes(scheme)
    system.residual(following, other, k, run.p, run.w, rest)
    for i in range(nv):
        right[i] = 0.0
    for c in range(m):
        right[nv + c] = -rest[n + c]
    if not factorise_stage(scheme, factors):
        return TOO_LARGE
    solve_stage(system, scheme, run, right, x)
    run.control[abi.JACOBIANS] += 1
    for i in range(sizes.ny):
        other[i] = run.trial[i] - other[i]
    for i in range(nv):
        other[nq + i] -= x[i]
    for i in range(sizes.ny, width):
        other[i] = 0.0
    share = weights_of(span, run)
    error = math.sqrt(weigh(width, other, share, run.y, run.trial, span.rtol, span.atol) / sizes.controlled)
    return error_with_work(system.sizes, span, run, abs(other[first]), error)


def memory(width: int, nv: int, m: int, unknowns: int, stages: int) -> tuple[int, int]:
    """Return the lengths of the memory of a run, and of the working memory of a step after the trial state."""
    return (stages + 1) * width, 2 + 2 * (nv + m) + 2 * unknowns + m + width + (stages + 2) * nv


_PARTS: dict[str, Any] = {"prepare": prepare, "renew": renew}
_FUNCTIONS = "turn", "residual", "tangent"
constant = loop(__name__, "constant", PARTITIONED, *_FUNCTIONS, attempt=attempt_partitioned, **_PARTS)
adaptive = loop(__name__, "adaptive", PARTITIONED, *_FUNCTIONS, ADAPTIVE=True, attempt=attempt, **_PARTS)
