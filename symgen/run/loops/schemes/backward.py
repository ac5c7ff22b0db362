"""Backward differentiation formulas of orders 1 to 5 on the descriptor form F(t, y, k) = 0.

The polynomial through past states at unequal distances predicts the new state p and its rate p'. The formula has the
leading coefficient of equal steps, ``y' = p' + s (y - p) / h`` with s the sum of 1/i up to the order (Brenan, Campbell,
Petzold, section 5.2). So a step is one implicit stage from the base ``p - h/s p'``, solved like those of `implicit`.

Runs with varying steps start at order 1, and raise the order and double the step until an error says otherwise. Then
steps and orders follow the terms ``h^(j+1) y^(j+1)`` of neighbouring orders. Runs with constant steps start by the
implicit Runge-Kutta scheme of their record, which has the highest order.

The memory of a run has a head, the guess of the unknowns and of auxiliary rates, past states, newest first, and their
times.
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
from symgen.run.layout.scales import error_with_work, weights_of
from symgen.run.layout.scheme_records import BACKWARD, Backward, Stages
from symgen.run.loops.frame import loop
from symgen.run.loops.schemes.implicit import attempt as start_step
from symgen.run.loops.schemes.implicit import begin_step, solve_stages
from symgen.run.loops.schemes.implicit import memory as memory_of_stages

#: Past states kept: the estimate of an order above the highest one needs two more.
DEPTH = 7
#: Head of the memory: the order and the highest one, steps of equal length and order, 1 until an error was too large,
#: and refusals in a row.
ORDER, HIGHEST, EQUAL, YOUNG, FAILED = range(5)
#: Head of the working memory: whether the step was judged, and the terms of its order and of those beside it.
JUDGED, TWO_BELOW, BELOW, SAME, ABOVE = range(5)
HEAD = 8
#: Corrections of rates below this part of the relative tolerance end the iteration of a step with an error estimate.
_SETTLED = 1e-3
#: As in the frame: whether steps and order vary.
ADAPTIVE = False


# -- parts of the memories ---------------------------------------------------------------------------------------------


def history_at(system: ModelSystem) -> int:
    """Return the index of the newest past state in the memory."""
    sizes = system.sizes
    return int(HEAD + sizes.unknowns + sizes.ny - sizes.nq - sizes.nv)


def run_of_stages(system: ModelSystem, run: Run, base: Array) -> Run:
    """Return the run as implicit stages see it, from the state `base`."""
    own = HEAD + 4 * system.sizes.width + 2 * DEPTH
    memory = part(run.memory, HEAD, run.memory.shape[0] - HEAD)
    room = part(run.room, own, run.room.shape[0] - own)
    fields = base, run.trial, run.p, run.w, run.iw, run.clock, run.gauges, run.control, run.passages, memory
    return Run(*fields, run.share, run.metric, run.scales, room)


# -- the polynomial through past states --------------------------------------------------------------------------------


@called
def extrapolate_state(system: ModelSystem, run: Run, order: int, t: float, value: Array, slope: Array) -> None:
    """Set value and slope at `t` of the polynomial through the newest ``order + 1`` states."""
    width, at = system.sizes.width, history_at(system)
    times, weights = part(run.memory, at + DEPTH * width, DEPTH), part(run.room, HEAD + 4 * width, 2 * DEPTH)
    for i in range(order + 1):
        weight, total = 1.0, 0.0
        for j in range(order + 1):
            if j != i:
                weight *= (t - times[j]) / (times[i] - times[j])
                total += 1.0 / (t - times[j])
        weights[i], weights[DEPTH + i] = weight, weight * total
    newest = part(run.memory, at, width)
    for i in range(width):
        value[i], slope[i] = newest[i], 0.0
    for j in range(1, order + 1):
        past, weight, rate = part(run.memory, at + j * width, width), weights[j], weights[DEPTH + j]
        for i in range(width):
            value[i] += weight * (past[i] - newest[i])
            slope[i] += rate * (past[i] - newest[i])


def term_of_order(
    system: ModelSystem, span: Span, run: Run, order: int, t: float, h: float, value: Array, slope: Array
) -> float:
    """Return the size of ``h^(order+1) y^(order+1)`` over the tolerance; `value` and `slope` are overwritten."""
    sizes, times = system.sizes, history_at(system) + DEPTH * system.sizes.width
    extrapolate_state(system, run, order, t, value, slope)
    for i in range(sizes.width):
        value[i] = run.trial[i] - value[i]
    factor = 1.0
    for i in range(order + 1):
        factor *= (i + 1) * h / (t - run.memory[times + i])
    total = weigh(sizes.width, value, weights_of(span, run), run.y, run.trial, span.rtol, span.atol)
    size = math.sqrt(total / sizes.controlled)
    return factor * float(error_with_work(sizes, span, run, value[sizes.nq + sizes.nv], size))


# -- the step ----------------------------------------------------------------------------------------------------------


@called
def prepare(system: ModelSystem, scheme: Backward, span: Span, run: Run) -> None:
    """Begin with the present state; with varying steps, a state before it has the slope there."""
    width, at, t = system.sizes.width, history_at(system), run.clock[abi.TIME]
    inner = run_of_stages(system, run, run.y)
    begin_step(system, inner, t)
    copied(width, run.y, part(run.memory, at, width))
    rate, before = part(inner.room, 0, width), part(run.memory, at + width, width)
    for i in range(width):
        before[i] = run.y[i] - span.step * rate[i]
    times = part(run.memory, at + DEPTH * width, DEPTH)
    times[0], times[1] = t, t - span.step
    run.control[abi.POINTS] = 2 if ADAPTIVE else 1
    run.memory[HIGHEST] = scheme.highest
    run.memory[ORDER] = 1.0 if ADAPTIVE else scheme.highest
    run.memory[EQUAL] = run.memory[FAILED] = 0.0
    run.memory[YOUNG] = 1.0


@called
def attempt(
    system: ModelSystem, scheme: Backward, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Try a step from the base that past states give."""
    sizes, width, count = system.sizes, system.sizes.width, run.control[abi.POINTS]
    order, first, n = int(run.memory[ORDER]), sizes.nq + sizes.nv, sizes.unknowns
    run.room[JUDGED] = 0.0
    predicted, slope = part(run.room, HEAD, width), part(run.room, HEAD + width, width)
    base, spare = part(run.room, HEAD + 2 * width, width), part(run.room, HEAD + 3 * width, width)
    if count <= order:
        return start_step(system, scheme, span, run_of_stages(system, run, run.y), t, following, h, True)
    extrapolate_state(system, run, order, following, predicted, slope)
    leading = 0.0
    for i in range(order):
        leading += 1.0 / (i + 1)
    for i in range(width):
        base[i] = predicted[i] - h / leading * slope[i]
    inner = run_of_stages(system, run, base)
    one = part(run.room, HEAD - 2, 1)
    end = part(run.room, HEAD - 1, 1)
    one[0], end[0] = 1.0 / leading, 1.0
    k, rates = part(inner.room, width, n), part(inner.room, width + n, sizes.ny - first)
    tail = n - sizes.states
    for i in range(n):
        if i < first:
            k[i] = slope[i]
        elif i >= tail:
            k[i] = slope[first + 1 + i - tail]
        else:
            k[i] = inner.memory[i]
    for i in range(first, sizes.ny):
        rates[i - first] = slope[i]
    plan, numbers = scheme.filter_plan, scheme.filter_numbers
    single = Stages(
        one, one, end, scheme.errors, 0.0, 1, 0, 1, scheme.entries, scheme.slopes, numbers, plan, numbers, plan
    )
    least = max(1e-13, _SETTLED * span.rtol) if ADAPTIVE else 1e-13
    failure = solve_stages(system, single, inner, t, h, least)
    if failure != 0.0 or not ADAPTIVE or between:
        return failure
    times = part(run.memory, history_at(system) + DEPTH * width, DEPTH)
    for j in range(4):
        other = order - 2 + j
        if 1 <= other and other <= scheme.highest and other + 2 <= count + 1:
            run.room[TWO_BELOW + j] = term_of_order(system, span, run, other, following, h, base, spare)
        else:
            run.room[TWO_BELOW + j] = math.inf
    run.room[JUDGED] = 1.0
    # constants of the formula at unequal distances, and of the part that its leading coefficient leaves
    oldest, distance, factor = h / (following - times[order]), leading, 1.0
    for i in range(order):
        distance -= h / (following - times[i])
    for i in range(order + 1):
        factor *= (i + 1) * h / (following - times[i])
    constant = max(oldest, abs(oldest - distance))
    return float(constant * run.room[SAME] / factor)


def renew(system: ModelSystem, scheme: Backward, span: Span, run: Run, t: float, changed: bool) -> None:
    """Put the accepted state in front of the history, and keep its multipliers as the next guess."""
    sizes, width, at, count = system.sizes, system.sizes.width, history_at(system), run.control[abi.POINTS]
    times, first = part(run.memory, at + DEPTH * width, DEPTH), sizes.nq + sizes.nv
    for j in range(min(count, DEPTH - 1), 0, -1):
        times[j] = times[j - 1]
        copied(width, part(run.memory, at + (j - 1) * width, width), part(run.memory, at + j * width, width))
    times[0] = t
    copied(width, run.y, part(run.memory, at, width))
    run.control[abi.POINTS] = min(count + 1, DEPTH)
    run.control[abi.KNOWN] = 0
    inner = run_of_stages(system, run, run.y)
    last = width if count > int(run.memory[ORDER]) else width + (scheme.stages - 1) * sizes.unknowns
    for i in range(first, sizes.unknowns - sizes.states):
        inner.memory[i] = inner.room[last + i]


# -- steps and orders --------------------------------------------------------------------------------------------------


def lower_order(run: Run) -> int:
    """Return the order, or the one below where its terms are no larger."""
    order, room = int(run.memory[ORDER]), run.room
    if order > 2 and max(room[BELOW], room[TWO_BELOW]) <= room[SAME]:
        return order - 1
    if order == 2 and room[BELOW] <= 0.5 * room[SAME]:
        return order - 1
    return order


def step_of_term(run: Run, order: int, place: int) -> float:
    """Return the ratio of steps that the term of an order allows."""
    return float((2.0 * run.room[place] / (order + 1) + 1e-4) ** (-1.0 / (order + 1)))


def shrunk_backward_step(span: Span, run: Run, error: float) -> float:
    """Return the next step over a refused one; lower the order where that promises more."""
    memory = run.memory
    memory[FAILED] += 1.0
    memory[YOUNG] = memory[EQUAL] = 0.0
    if not math.isfinite(error):
        return 0.1
    lower, order = lower_order(run), int(memory[ORDER])
    memory[ORDER] = lower if memory[FAILED] < 3.0 else 1.0
    if memory[FAILED] > 1.0:
        return 0.25
    ratio = (
        step_of_term(run, lower, SAME - order + lower)
        if lower < order
        else (2.0 * error + 1e-4) ** (-1.0 / (order + 1))
    )
    return float(max(0.25, min(0.9, 0.9 * ratio)))


def grown_backward_step(span: Span, run: Run, h: float, error: float) -> float:
    """Return the next step over an accepted one of `h` seconds, and choose its order."""
    memory, room, order = run.memory, run.room, int(run.memory[ORDER])
    if room[JUDGED] == 0.0:
        return 1.0
    highest, lower, refused = int(memory[HIGHEST]), lower_order(run), memory[FAILED] > 0.0
    memory[FAILED] = 0.0
    memory[EQUAL] = memory[EQUAL] + 1.0 if h == run.clock[abi.STEP] else 1.0
    if lower < order or order == highest or refused:
        memory[YOUNG] = 0.0
    if memory[YOUNG] == 1.0:
        memory[ORDER], memory[EQUAL] = order + 1.0, 0.0
        return 2.0
    following = lower
    if lower == order and order < highest and memory[EQUAL] > order + 1.0:
        if order == 1 and room[ABOVE] < 0.5 * room[SAME]:
            following = order + 1
        elif order > 1 and room[BELOW] <= min(room[SAME], room[ABOVE]):
            following = order - 1
        elif order > 1 and room[ABOVE] < room[SAME]:
            following = order + 1
    ratio = step_of_term(run, following, SAME - order + following)
    if following != order:
        memory[ORDER], memory[EQUAL] = float(following), 0.0
    if ratio >= 2.0:
        return 2.0
    return 1.0 if ratio > 1.0 else float(max(0.5, min(0.9, ratio)))


def memory(width: int, unknowns: int, more: int, stages: int) -> tuple[int, int]:
    """Return the lengths of the memory of a run, and of the working memory of a step after the trial state."""
    kept, room = memory_of_stages(width, unknowns, more, stages, True)
    return HEAD + kept + DEPTH * (width + 1), HEAD + 4 * width + 2 * DEPTH + room


_PARTS: dict[str, Any] = {"prepare": prepare, "attempt": attempt, "renew": renew}
_ADAPTIVE: dict[str, Any] = {
    **_PARTS,
    **{"ADAPTIVE": True, "shrunk_step": shrunk_backward_step, "grown_step": grown_backward_step},
}

constant = loop(__name__, "constant", BACKWARD, "residual", "tangent", **_PARTS)
adaptive = loop(__name__, "adaptive", BACKWARD, "residual", "tangent", **_ADAPTIVE)
