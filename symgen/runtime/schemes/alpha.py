"""The generalised-alpha family on the descriptor form: Newmark's scheme with or without numerical damping.

With the algorithmic acceleration a,

- ``q1 = q0 + d`` with ``d = h v0 + h^2 (1/2 - beta) a0 + h^2 beta a1``; in space bodies turn by the exponential of
  their part of d (Bruls, Cardona 2010); ``v1 = v0 + h (1 - gamma) a0 + h gamma a1``,
- ``(1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) v1' + alpha_f v0'``,

the equations of motion and the constraints, at position or acceleration level, hold at the end of the step (Arnold,
Bruls 2007). Unknowns of the Newton iteration are v1' and lambda. Auxiliary states follow by the trapezoidal rule.

The memory of a run holds k = (v, v', lambda) as the next iteration begins with it, a0, and the rates of the state; with
adaptive steps also how a changed in the step before, that step, and the one that a0 is meant for.

With theta = alpha_m - alpha_f, a0 is v' at the time t + theta h, so that a0 - v0' changes as steps do. A step of
positions is off by (1/6 - theta/2 - beta) h^2 (a1 - a0) (Zienkiewicz, Xie 1991), one of velocities by
(theta^2/2 - 1/12) h^3 times the second derivative of a, from two steps. The estimate takes J^-1 M (a1 - a0) in place of
a1 - a0 with Newton's matrix J, for velocities twice: what vibrates faster than steps can follow counts by how far it
moves.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.runtime import abi, sparse
from symgen.runtime.bare import part
from symgen.runtime.frame import DIVERGED, TOO_LARGE, evaluate, loop
from symgen.runtime.loop_instances import called
from symgen.runtime.manifold import advance
from symgen.runtime.redundancy import leave_out_rest
from symgen.runtime.scales import weights_of
from symgen.runtime.scheme_records import ALPHA
from symgen.runtime.schemes.implicit import ended
from symgen.runtime.sparse import multiply, solve, turn_rows
from symgen.runtime.vectors import weigh

_MOST_ITERATIONS = 20
#: As in the frame: whether steps follow the error estimate.
ADAPTIVE = False


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
    if ADAPTIVE:
        steps = part(run.memory, n + 2 * nv + sizes.width, 2)
        steps[0], steps[1] = h, 0.0


@called
def move(system: Any, scheme: Any, run: Any, h: float, k: Any, a1: Any, change: Any) -> None:
    """Set ``run.trial`` and a1 from v1', which stands in `k`; `change` receives how far positions move.

    With adaptive steps a0 for this step follows a1.
    """
    nq, nv, n = system.sizes.nq, system.sizes.nv, system.sizes.unknowns
    alpha_m, alpha_f, gamma, beta = scheme.alpha_m, scheme.alpha_f, scheme.gamma, scheme.beta
    a0, begun = part(run.memory, n, nv), part(run.memory, n + nv, system.sizes.width)
    if ADAPTIVE:
        ratio, kept = h / run.memory[n + 2 * nv + system.sizes.width], a0
        a0 = part(a1, nv, nv)
        for i in range(nv):
            a0[i] = begun[nq + i] + ratio * (kept[i] - begun[nq + i])
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
    a1, factors = part(run.room, 3 * n, 2 * nv), part(run.room, 3 * n + 2 * nv, 4)
    rest = part(run.room, 3 * n + 2 * nv + 4, sizes.ny - first)
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
    if ADAPTIVE and not between:
        return step_error(system, scheme, span, run, following, h)
    return 0.0


@called
def step_error(system: Any, scheme: Any, span: Any, run: Any, following: float, h: float) -> float:
    """Return the error estimate of a step that was just solved over the tolerance."""
    sizes = system.sizes
    nq, nv, n, width = sizes.nq, sizes.nv, sizes.unknowns, sizes.width
    right, change = part(run.room, n, n), part(run.room, 2 * n, n)
    a1, a0 = part(run.room, 3 * n, nv), part(run.room, 3 * n + nv, nv)
    at = 3 * n + 2 * nv + 4 + sizes.ny - nq - nv
    moved, turn = part(run.room, at, width), part(run.room, at + width, nv)
    before, steps = part(run.memory, n + nv + width, nv), part(run.memory, n + 2 * nv + width, 2)
    theta = scheme.alpha_m - scheme.alpha_f
    by_position, by_velocity = 1.0 / 6.0 - 0.5 * theta - scheme.beta, 0.5 * theta * theta - 1.0 / 12.0
    run.control[abi.ORDER] = 3
    for i in range(nv):
        change[i] = a1[i] - a0[i]
    filtered(system, scheme, run, following)
    for i in range(nv):
        turn[i] = change[i]
        moved[nq + i] = 0.0
        change[i] = change[i] - h / steps[1] * before[i] if steps[1] > 0.0 else 0.0
    if steps[1] > 0.0:
        filtered(system, scheme, run, following)
        for i in range(nv):
            moved[nq + i] = h * h * by_velocity * change[i] * 2.0 / (h + steps[1])
    for i in range(nv):
        right[i] = h * h * by_position * turn[i]
    shifted(system, scheme, run, h, right, moved)
    for i in range(nq):
        moved[i] -= run.trial[i]
    for i in range(nq + nv, width):
        moved[i] = 0.0
    share = weights_of(span, run)
    return math.sqrt(weigh(width, moved, share, run.y, run.trial, span.rtol, span.atol) / sizes.controlled)


@called
def filtered(system: Any, scheme: Any, run: Any, following: float) -> None:
    """Replace a change of v' by J^-1 M times it: residuals, which are 0 at the end of a step, are linear in v'."""
    nq, nv, n = system.sizes.nq, system.sizes.nv, system.sizes.unknowns
    k, right, change = part(run.room, 0, n), part(run.room, n, n), part(run.room, 2 * n, n)
    for i in range(nv):
        k[nq + i] += change[i]
    system.residual(following, run.trial, k, run.p, run.w, right)
    run.control[abi.EVALUATIONS] += 1
    for i in range(nv):
        k[nq + i] -= change[i]
    for i in range(nq + nv, n):
        right[i] = 0.0
    solve(scheme.plan, scheme.numbers, part(right, nq, n - nq), change)


@called
def shifted(system: Any, scheme: Any, run: Any, h: float, off: Any, moved: Any) -> None:
    """Set the positions of `moved` to those of a step just solved whose displacement is `off` longer."""
    nv, n = system.sizes.nv, system.sizes.unknowns
    a1, a0 = part(run.room, 3 * n, nv), part(run.room, 3 * n + nv, nv)
    for i in range(nv):
        off[i] += h * run.y[system.sizes.nq + i] + h * h * ((0.5 - scheme.beta) * a0[i] + scheme.beta * a1[i])
    advance(system, run, off, moved)


def renew(system: Any, scheme: Any, span: Any, run: Any, t: float, changed: bool) -> None:
    """Keep the accelerations, the multipliers and the rates at the end of the step."""
    sizes = system.sizes
    nq, nv, n, first = sizes.nq, sizes.nv, sizes.unknowns, sizes.nq + sizes.nv
    k, a1 = part(run.room, 0, n), part(run.room, 3 * n, nv)
    rest = part(run.room, 3 * n + 2 * nv + 4, sizes.ny - first)
    a0, begun = part(run.memory, n, nv), part(run.memory, n + nv, sizes.width)
    for i in range(nq, n):
        run.memory[i] = k[i]
    if ADAPTIVE:
        turn = part(run.room, 3 * n + 2 * nv + 4 + sizes.ny - first + sizes.width, nv)
        before, steps = part(run.memory, n + nv + sizes.width, nv), part(run.memory, n + 2 * nv + sizes.width, 2)
        for i in range(nv):
            before[i] = turn[i]
        steps[0] = steps[1] = run.clock[abi.STEP]
    for i in range(nv):
        a0[i], begun[nq + i] = a1[i], k[nq + i]
    for i in range(sizes.ny - first):
        begun[first + i] = rest[i]


def memory(width: int, nv: int, unknowns: int) -> tuple[int, int]:
    """Return the numbers that a run keeps, and the working memory of a step behind the state that is tried."""
    return unknowns + 2 * nv + width + 2, 3 * unknowns + 3 * nv + 4 + 2 * width


_FUNCTIONS = "turn", "residual", "tangent"
_PARTS: dict[str, Any] = {"prepare": prepare, "attempt": attempt, "renew": renew}
constant = loop(__name__, "constant", ALPHA, *_FUNCTIONS, **_PARTS)
adaptive = loop(__name__, "adaptive", ALPHA, *_FUNCTIONS, **_PARTS, ADAPTIVE=True, ROUGH=True)
