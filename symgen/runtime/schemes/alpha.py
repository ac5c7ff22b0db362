"""The generalised-alpha family on the descriptor form: Newmark's scheme with or without numerical damping.

With the algorithmic acceleration a,

- ``q1 = q0 + d`` with ``d = h v0 + h^2 (1/2 - beta) a0 + h^2 beta a1``; in space bodies turn by the exponential of
  their part of d (Bruls, Cardona 2010); ``v1 = v0 + h (1 - gamma) a0 + h gamma a1``,
- ``(1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) v1' + alpha_f v0'``,

the equations of motion and the constraints, at position or acceleration level, hold at the end of the step (Arnold,
Bruls 2007). Unknowns of the Newton iteration are v1' and lambda. Auxiliary states follow by the trapezoidal rule.

The memory of a run holds k = (v, v', lambda) as the next iteration begins with it, a0, and the rates of the state.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.runtime import abi, sparse
from symgen.runtime.bare import part
from symgen.runtime.frame import DIVERGED, TOO_LARGE, evaluate, loop
from symgen.runtime.loop_instances import called
from symgen.runtime.manifold import advance
from symgen.runtime.records import ALPHA
from symgen.runtime.redundancy import leave_out_rest
from symgen.runtime.schemes.implicit import ended
from symgen.runtime.sparse import multiply, solve, turn_rows

_MOST_ITERATIONS = 20


@called
def prepare(system: Any, scheme: Any, span: Any, run: Any) -> None:
    """Begin with ``a0 = v0' + (alpha_m - alpha_f) h v0''``.

    With a0 = v0' multipliers would start with an error of order 1. v'' comes from two evaluations; its error enters
    multiplied by h (alpha_m - alpha_f).
    """
    sizes, t, h, probe = system.sizes, run.clock[abi.TIME], span.step, 1e-4 * span.step
    nq, nv, n = sizes.nq, sizes.nv, sizes.unknowns
    k, a0, begun = part(run.memory, 0, n), part(run.memory, n, nv), part(run.memory, n + nv, sizes.width)
    ahead = part(run.room, 0, sizes.width)
    evaluate(system, run, t, run.y, begun)
    for i in range(sizes.width):
        run.trial[i] = run.y[i] + probe * begun[i]
    evaluate(system, run, t + probe, run.trial, ahead)
    for i in range(nv):
        a0[i] = begun[nq + i] + (scheme.alpha_m - scheme.alpha_f) * h * (ahead[nq + i] - begun[nq + i]) / probe
    evaluate(system, run, t, run.y, begun)
    run.control[abi.EVALUATIONS] += 3
    for i in range(nv):
        k[nq + i] = begun[nq + i]
    for i in range(n - nq - nv):
        k[nq + nv + i] = run.w[sizes.multipliers + i]


@called
def move(system: Any, scheme: Any, run: Any, h: float, k: Any, a1: Any, change: Any) -> None:
    """Set ``run.trial`` and a1 from v1', which stands in `k`; `change` receives how far positions move."""
    nq, nv, n = system.sizes.nq, system.sizes.nv, system.sizes.unknowns
    alpha_m, alpha_f, gamma, beta = scheme.alpha_m, scheme.alpha_f, scheme.gamma, scheme.beta
    a0, begun = part(run.memory, n, nv), part(run.memory, n + nv, system.sizes.width)
    for i in range(nv):
        a1[i] = ((1.0 - alpha_f) * k[nq + i] + alpha_f * begun[nq + i] - alpha_m * a0[i]) / (1.0 - alpha_m)
        change[i] = h * run.y[nq + i] + h * h * ((0.5 - beta) * a0[i] + beta * a1[i])
        run.trial[nq + i] = run.y[nq + i] + h * ((1.0 - gamma) * a0[i] + gamma * a1[i])
    advance(system, run, change, run.trial)


@called
def attempt(
    system: Any, scheme: Any, span: Any, run: Any, t: float, following: float, h: float, between: bool
) -> float:
    """Solve for v1' and the multipliers at the end of the step."""
    sizes = system.sizes
    nq, nv, n = sizes.nq, sizes.nv, sizes.unknowns
    size, first, begun = n - nq, nq + nv, part(run.memory, n + nv, sizes.width)
    k, right, change = part(run.room, 0, n), part(run.room, n, n), part(run.room, 2 * n, n)
    a1, factors = part(run.room, 3 * n, nv), part(run.room, 3 * n + nv, 4)
    rest = part(run.room, 3 * n + nv + 4, sizes.ny - first)
    for i in range(nq, n):
        k[i] = run.memory[i]
    ratio = (1.0 - scheme.alpha_f) / (1.0 - scheme.alpha_m)
    by_velocity, by_position = h * scheme.gamma * ratio, h * h * scheme.beta * ratio
    last, fresh, end = math.inf, True, 0
    for _ in range(_MOST_ITERATIONS):
        move(system, scheme, run, h, k, a1, change)
        for i in range(nv):
            k[i] = run.trial[nq + i]
        if fresh:
            system.tangent(following, run.trial, k, run.p, run.w, scheme.slopes)
            multiply(scheme.plan, scheme.slopes)
            turn_rows(scheme.plan, scheme.slopes, change)
            factors[0], factors[1], factors[2], factors[3] = 1.0, by_velocity, by_position, -by_position
            if sparse.prepare(scheme.plan, scheme.slopes, factors, scheme.numbers) < 0:
                return TOO_LARGE
            run.control[abi.JACOBIANS] += 1
            fresh = False
        system.residual(following, run.trial, k, run.p, run.w, right)
        leave_out_rest(sizes, run.w, k, right)
        run.control[abi.EVALUATIONS] += 1
        solve(scheme.plan, scheme.numbers, part(right, nq, size), change)
        run.control[abi.NEWTON_ITERATIONS] += 1
        moved, total, length = 0.0, 0.0, 1.0
        for i in range(size):
            k[nq + i] -= change[i]
            if i < nv:
                moved += (run.scales[nq + i] * change[i]) ** 2
                total += (run.scales[nq + i] * k[nq + i]) ** 2
        for i in range(nq):
            length = max(length, run.scales[i] * abs(run.trial[i]))
        # rounding of positions is divided by the square of the step in accelerations: it decides where those stall
        rate = run.w[abi.SPEED] / run.w[abi.LENGTH]
        at_floor = math.sqrt(moved) * rate * by_position < 1e-12 * length
        moved = math.sqrt(moved) / (rate + math.sqrt(total))
        end = ended(moved, last, 1e-12, 1e-7, at_floor)
        if end != 0:
            break
        fresh, last = moved > 0.05 * last, moved
    if end <= 0:
        return DIVERGED
    move(system, scheme, run, h, k, a1, change)
    for i in range(sizes.ny - first):
        rest[i] = run.w[sizes.auxiliary + i]
        run.trial[first + i] = run.y[first + i] + 0.5 * h * (begun[first + i] + rest[i])
    return 0.0


def renew(system: Any, scheme: Any, span: Any, run: Any, t: float, changed: bool) -> None:
    """Keep the accelerations, the multipliers and the rates at the end of the step."""
    sizes = system.sizes
    nq, nv, n, first = sizes.nq, sizes.nv, sizes.unknowns, sizes.nq + sizes.nv
    k, a1 = part(run.room, 0, n), part(run.room, 3 * n, nv)
    rest = part(run.room, 3 * n + nv + 4, sizes.ny - first)
    a0, begun = part(run.memory, n, nv), part(run.memory, n + nv, sizes.width)
    for i in range(nq, n):
        run.memory[i] = k[i]
    for i in range(nv):
        a0[i], begun[nq + i] = a1[i], k[nq + i]
    for i in range(sizes.ny - first):
        begun[first + i] = rest[i]


def memory(width: int, nv: int, unknowns: int) -> tuple[int, int]:
    """Return the numbers that a run keeps, and the working memory of a step behind the state that is tried."""
    return unknowns + nv + width, 3 * unknowns + nv + 4 + width


_FUNCTIONS = "turn", "residual", "tangent"
constant = loop(__name__, "constant", ALPHA, *_FUNCTIONS, prepare=prepare, attempt=attempt, renew=renew)
