"""The generalised-alpha family on the descriptor form: Newmark's scheme with or without numerical damping.

With the algorithmic acceleration a,

- ``q1 = q0 + d`` with ``d = h v0 + h^2 (1/2 - beta) a0 + h^2 beta a1``; in space bodies turn by the exponential of
  their part of d (Bruls, Cardona 2010); ``v1 = v0 + h (1 - gamma) a0 + h gamma a1``,
- ``(1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) v1' + alpha_f v0'``,

the equations of motion and the constraints, at position or acceleration level, hold at the end of the step (Arnold,
Bruls 2007). Unknowns of the Newton iteration are v1', lambda and z1', z being the states of the file: these move as
velocities do, which is the scheme for equations of first order (Jansen, Whiting, Hulbert 2000) with the same numbers.
Other auxiliary states follow by the trapezoidal rule.

The memory of a run holds the initial k = (v, v', lambda, z') of the next iteration, a0, and the rates of the state;
with adaptive steps also the change of a in the step before, that step, and the step for which a0 is valid. Arrays of a
have v' first, then z'.

With theta = alpha_m - alpha_f, a0 is v' at the time t + theta h, so that a0 - v0' changes as steps do. A step of
positions is off by (1/6 - theta/2 - beta) h^2 (a1 - a0) (Zienkiewicz, Xie 1991), one of velocities by
(theta^2/2 - 1/12) h^3 times the second derivative of a, from two steps. The estimate takes J^-1 M (a1 - a0) in place of
a1 - a0 with Newton's matrix J, for velocities twice: vibrations too fast for the steps count by their displacement.
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
from symgen.run.layout.records import ModelSystem, Run, Sizes, Span
from symgen.run.layout.redundancy import leave_out_rest
from symgen.run.layout.scales import weights_of
from symgen.run.layout.scheme_records import ALPHA, Alpha
from symgen.run.loops import sparse
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import DIVERGED, TOO_LARGE, evaluate
from symgen.run.loops.schemes.implicit import is_settled, newton_verdict
from symgen.run.loops.sparse import multiply_sources, solve, turn_rows

_MOST_ITERATIONS = 20
#: As in the frame: whether steps follow the error estimate.
ADAPTIVE = False


def index_in_state(sizes: Sizes, i: int) -> int:
    """Return the index in the state of the element with rate i: velocities, then the states after the work."""
    return sizes.nq + i if i < sizes.nv else sizes.nq + i + 1


def index_of_unknown(sizes: Sizes, i: int) -> int:
    """Return the index in k of rate i of v and z."""
    return sizes.nq + i if i < sizes.nv else sizes.unknowns - sizes.states - sizes.nv + i


@called
def prepare(system: ModelSystem, scheme: Alpha, span: Span, run: Run) -> None:
    """Set ``a0 = v0' + (alpha_m - alpha_f) h v0''``.

    With a0 = v0' multipliers would start with an error of order 1. v'' comes from two evaluations; its error enters
    multiplied by h (alpha_m - alpha_f).
    """
    sizes, t, h, probe = system.sizes, run.clock[abi.TIME], span.step, 1e-4 * span.step
    n, count, first = sizes.unknowns, sizes.nv + sizes.states, sizes.nq + sizes.nv
    k, a0, beginning = part(run.memory, 0, n), part(run.memory, n, count), part(run.memory, n + count, sizes.width)
    ahead = part(run.room, 0, sizes.width)
    evaluate(system, run, t, run.y, beginning)
    for i in range(sizes.width):
        run.trial[i] = run.y[i] + probe * beginning[i]
    evaluate(system, run, t + probe, run.trial, ahead)
    for i in range(count):
        at = index_in_state(sizes, i)
        a0[i] = beginning[at] + (scheme.alpha_m - scheme.alpha_f) * h * (ahead[at] - beginning[at]) / probe
    evaluate(system, run, t, run.y, beginning)
    run.control[abi.EVALUATIONS] += 3
    for i in range(count):
        k[index_of_unknown(sizes, i)] = beginning[index_in_state(sizes, i)]
    for c in range(sizes.m):
        k[first + c] = run.w[sizes.multipliers + c]
    if ADAPTIVE:
        steps = part(run.memory, n + 2 * count + sizes.width, 2)
        steps[0], steps[1] = h, 0.0


@called
def move_state(system: ModelSystem, scheme: Alpha, run: Run, h: float, k: Array, a1: Array, change: Array) -> None:
    """Set ``run.trial`` and a1 from v1' and z1' in `k`, and `change` to the displacements.

    With adaptive steps a0 for this step follows a1.
    """
    sizes, count, n = system.sizes, system.sizes.nv + system.sizes.states, system.sizes.unknowns
    alpha_m, alpha_f, gamma, beta = scheme.alpha_m, scheme.alpha_f, scheme.gamma, scheme.beta
    a0, beginning = part(run.memory, n, count), part(run.memory, n + count, sizes.width)
    if ADAPTIVE:
        ratio, kept = h / run.memory[n + 2 * count + sizes.width], a0
        a0 = part(a1, count, count)
        for i in range(count):
            at = index_in_state(sizes, i)
            a0[i] = beginning[at] + ratio * (kept[i] - beginning[at])
    for i in range(count):
        at = index_in_state(sizes, i)
        rate = (1.0 - alpha_f) * k[index_of_unknown(sizes, i)] + alpha_f * beginning[at]
        a1[i] = (rate - alpha_m * a0[i]) / (1.0 - alpha_m)
        if i < sizes.nv:
            change[i] = h * run.y[at] + h * h * ((0.5 - beta) * a0[i] + beta * a1[i])
        run.trial[at] = run.y[at] + h * ((1.0 - gamma) * a0[i] + gamma * a1[i])
    advance_coordinates(system, run, change, run.trial)


@called
def attempt(
    system: ModelSystem, scheme: Alpha, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Solve for v1', the multipliers and z1' at the end of the step."""
    sizes = system.sizes
    nq, nv, n, count = sizes.nq, sizes.nv, sizes.unknowns, sizes.nv + sizes.states
    size, first, beginning = n - nq, nq + nv, part(run.memory, n + count, sizes.width)
    k, right, change = part(run.room, 0, n), part(run.room, n, n), part(run.room, 2 * n, n)
    a1, factors = part(run.room, 3 * n, 2 * count), part(run.room, 3 * n + 2 * count, 4)
    rest = part(run.room, 3 * n + 2 * count + 4, sizes.ny - first)
    for i in range(nq, n):
        k[i] = run.memory[i]
    ratio = (1.0 - scheme.alpha_f) / (1.0 - scheme.alpha_m)
    by_velocity, by_position = h * scheme.gamma * ratio, h * h * scheme.beta * ratio
    last, fresh, end = math.inf, True, 0
    for _ in range(_MOST_ITERATIONS):
        move_state(system, scheme, run, h, k, a1, change)
        for i in range(nv):
            k[i] = run.trial[nq + i]
        if fresh:
            system.tangent(following, run.trial, k, run.p, run.w, scheme.slopes)
            multiply_sources(scheme.plan, scheme.slopes)
            turn_rows(scheme.plan, scheme.slopes, change)
            factors[0], factors[1], factors[2], factors[3] = 1.0, by_velocity, by_position, -by_position
            if sparse.prepare_pattern(scheme.plan, scheme.slopes, factors, scheme.numbers) < 0:
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
            elif i >= size - sizes.states:  # of any unit, as in implicit stages
                moved += (change[i] / (1.0 + abs(k[nq + i]))) ** 2
        for i in range(nq):
            length = max(length, run.scales[i] * abs(run.trial[i]))
        # rounding of positions enters accelerations over the square of the step: it decides where those stall
        rate = run.w[abi.SPEED] / run.w[abi.LENGTH]
        at_floor = math.sqrt(moved) * rate * by_position < 1e-12 * length
        moved = math.sqrt(moved) / (rate + math.sqrt(total))
        end = newton_verdict(moved, last, 1e-12, 1e-7, at_floor)
        if end != 0:
            break
        fresh, last = moved > 0.05 * last, moved
    if end <= 0:
        return DIVERGED
    settled = is_settled(part(k, first, sizes.m), part(change, nv, sizes.m))
    move_state(system, scheme, run, h, k, a1, change)
    if not settled:  # the last multipliers give the work
        system.residual(following, run.trial, k, run.p, run.w, right)
        run.control[abi.EVALUATIONS] += 1
    for i in range(sizes.ny - first):
        if 0 < i <= sizes.states:
            rest[i] = k[n - sizes.states + i - 1]
        else:
            rest[i] = run.w[sizes.auxiliary + (i - sizes.states if i > 0 else 0)]
            run.trial[first + i] = run.y[first + i] + 0.5 * h * (beginning[first + i] + rest[i])
    if ADAPTIVE and not between:
        return alpha_step_error(system, scheme, span, run, following, h)
    return 0.0


@called
def alpha_step_error(system: ModelSystem, scheme: Alpha, span: Span, run: Run, following: float, h: float) -> float:
    """Return the error estimate over the tolerance of a step just solved."""
    sizes = system.sizes
    nq, nv, n, width, count = sizes.nq, sizes.nv, sizes.unknowns, sizes.width, sizes.nv + sizes.states
    right, change = part(run.room, n, n), part(run.room, 2 * n, n)
    a1, a0 = part(run.room, 3 * n, count), part(run.room, 3 * n + count, count)
    at = 3 * n + 2 * count + 4 + sizes.ny - nq - nv
    moved, turn = part(run.room, at, width), part(run.room, at + width, count)
    before, steps = part(run.memory, n + count + width, count), part(run.memory, n + 2 * count + width, 2)
    theta = scheme.alpha_m - scheme.alpha_f
    by_position, by_velocity = 1.0 / 6.0 - 0.5 * theta - scheme.beta, 0.5 * theta * theta - 1.0 / 12.0
    run.control[abi.ORDER] = 3
    for i in range(count):
        change[index_of_unknown(sizes, i) - nq] = a1[i] - a0[i]
    filter_change(system, scheme, run, following)
    for i in range(nq, width):
        moved[i] = 0.0
    for i in range(count):
        j = index_of_unknown(sizes, i) - nq
        turn[i] = change[j]
        change[j] = change[j] - h / steps[1] * before[i] if steps[1] > 0.0 else 0.0
    if steps[1] > 0.0:
        filter_change(system, scheme, run, following)
        for i in range(count):
            turned = change[index_of_unknown(sizes, i) - nq]
            moved[index_in_state(sizes, i)] = h * h * by_velocity * turned * 2.0 / (h + steps[1])
    for i in range(nv):
        right[i] = h * h * by_position * turn[i]
    shift_positions(system, scheme, run, h, right, moved)
    for i in range(nq):
        moved[i] -= run.trial[i]
    share = weights_of(span, run)
    return math.sqrt(weigh(width, moved, share, run.y, run.trial, span.rtol, span.atol) / sizes.controlled)


@called
def filter_change(system: ModelSystem, scheme: Alpha, run: Run, following: float) -> None:
    """Replace a change of v' and z' by J^-1 M times it: residuals, 0 at the end of a step, are linear in both."""
    sizes, nq, n = system.sizes, system.sizes.nq, system.sizes.unknowns
    k, right, change = part(run.room, 0, n), part(run.room, n, n), part(run.room, 2 * n, n)
    for i in range(sizes.nv + sizes.states):
        j = index_of_unknown(sizes, i)
        k[j] += change[j - nq]
    system.residual(following, run.trial, k, run.p, run.w, right)
    run.control[abi.EVALUATIONS] += 1
    for i in range(sizes.nv + sizes.states):
        j = index_of_unknown(sizes, i)
        k[j] -= change[j - nq]
    for i in range(nq + sizes.nv, n - sizes.states):
        right[i] = 0.0
    solve(scheme.plan, scheme.numbers, part(right, nq, n - nq), change)


@called
def shift_positions(system: ModelSystem, scheme: Alpha, run: Run, h: float, off: Array, moved: Array) -> None:
    """Set the positions of `moved`: the step just solved, with a displacement `off` longer."""
    nv, n, count = system.sizes.nv, system.sizes.unknowns, system.sizes.nv + system.sizes.states
    a1, a0 = part(run.room, 3 * n, nv), part(run.room, 3 * n + count, nv)
    for i in range(nv):
        off[i] += h * run.y[system.sizes.nq + i] + h * h * ((0.5 - scheme.beta) * a0[i] + scheme.beta * a1[i])
    advance_coordinates(system, run, off, moved)


def renew(system: ModelSystem, scheme: Alpha, span: Span, run: Run, t: float, changed: bool) -> None:
    """Keep the accelerations, the multipliers and the rates at the end of the step."""
    sizes = system.sizes
    nq, n, first, count = sizes.nq, sizes.unknowns, sizes.nq + sizes.nv, sizes.nv + sizes.states
    k, a1 = part(run.room, 0, n), part(run.room, 3 * n, count)
    rest = part(run.room, 3 * n + 2 * count + 4, sizes.ny - first)
    a0, beginning = part(run.memory, n, count), part(run.memory, n + count, sizes.width)
    for i in range(nq, n):
        run.memory[i] = k[i]
    if ADAPTIVE:
        turn = part(run.room, 3 * n + 2 * count + 4 + sizes.ny - first + sizes.width, count)
        before, steps = (
            part(run.memory, n + count + sizes.width, count),
            part(run.memory, n + 2 * count + sizes.width, 2),
        )
        for i in range(count):
            before[i] = turn[i]
        steps[0] = steps[1] = run.clock[abi.STEP]
    for i in range(sizes.nv):
        beginning[nq + i] = k[nq + i]
    for i in range(count):
        a0[i] = a1[i]
    for i in range(sizes.ny - first):
        beginning[first + i] = rest[i]


def memory(width: int, count: int, unknowns: int) -> tuple[int, int]:
    """Return the lengths of the memory of a run, and of the working memory of a step after the trial state.

    `count` is the number of velocities and states of the file.
    """
    return unknowns + 2 * count + width + 2, 3 * unknowns + 3 * count + 4 + 2 * width


_FUNCTIONS = "turn", "residual", "tangent"
_PARTS: dict[str, Any] = {"prepare": prepare, "attempt": attempt, "renew": renew}
constant = loop(__name__, "constant", ALPHA, *_FUNCTIONS, **_PARTS)
adaptive = loop(__name__, "adaptive", ALPHA, *_FUNCTIONS, **_PARTS, ADAPTIVE=True, ROUGH=True)
