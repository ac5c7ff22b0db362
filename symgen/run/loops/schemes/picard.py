"""Collocation at Lobatto's points by Picard's iteration, the right-hand side evaluated at all nodes at once.

A step is a polynomial of degree 8 through the rates at its start and at eight nodes; its integrals are the states at
the nodes, which determine new rates. The iteration begins with the extrapolated polynomial of the step before, and
ends where its error, the last change times the factor by which changes fall, is below the tolerance. Coordinates whose
rate is a velocity follow from accelerations by second integrals, so that each iteration adds two orders to them.

The error of the polynomial is that of its last two Legendre coefficients, extrapolated by the fourth power of their
ratio to the two before: rounding of the iteration, which they contain, is subtracted. Steps are chosen for five
iterations; a step that will not converge in seven is given up as soon as that is foreseen.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.nodes import PLACES, distance, expand, extrapolate, place
from symgen.compile.loopcode.vectors import copied
from symgen.compile.native.annotations import Array
from symgen.compile.native.types import NODES
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Run, Sizes, Span
from symgen.run.layout.scales import is_carried, tolerance_at_rest, weights_of
from symgen.run.layout.scheme_records import NODES as SCHEME
from symgen.run.layout.scheme_records import Nodes
from symgen.run.loops.frame import loop, shortest_step
from symgen.run.loops.frame_parts import DIVERGED, evaluate
from symgen.run.loops.schemes.explicit import attempt as one_step
from symgen.run.loops.schemes.picard_memory import (
    ACROSS,
    ADRIFT,
    ALONE,
    BUFFER,
    BUFFERS,
    COARSE,
    COEFFICIENTS,
    RATIO,
    SINGLE,
    SLOW,
    SQUARES,
    STALE,
    STATES,
    STEP,
    TIMES,
    WEIGHED,
    WIDE,
)
from symgen.run.loops.schemes.picard_outputs import (
    evaluate_one_by_one,
    inside_wide_step,
    interpolate_wide_step,
    run_of_one_step,
)

#: As in the frame: whether steps follow the error estimate.
ADAPTIVE = False
#: Intended and largest number of iterations of a step, and the number for one without a polynomial before it.
AIM, MOST, FIRST = 5, 7, 24
#: Iterations of a constant step, which continues down to rounding, and the square of changes that are rounding.
CONSTANT, ROUNDING = 60, 1e8
#: The next step over this one: at least, at most, and after a refused one; the square of a change that diverges, and
#: the least square of the factor by which changes fall.
_SHORTEST, _LONGEST, _AGAIN, _ENDLESS, _FASTEST = 0.3, 2.0, 0.8, 1e60, 1e-4
#: The same after the first step, at most.
_FIRST_GROWTH = 3.0
#: A step is slow whose changes fall by more than the root of the first, and whose rates have coefficients of degree 5
#: and 6 below the root of the second, over the tolerance: stiffness bounds it, not the motion.
_SLOW, _SMOOTH = 0.008, 1.0
#: Factor of the estimate, chosen so that errors over the tolerance agree with `dop853`.
STRICT = 10.0
#: Outputs use more rates where the last coefficients of rates, over the tolerance, are more than this.
_LEFT_OUT = 12.0


def weigh_rates(
    system: ModelSystem, scheme: Nodes, span: Span, run: Run, h: float, ends: Array, weights: Array
) -> None:
    """Set `weights` to factors that turn squares of rates into squares of errors over tolerances in a step of `h` [s].

    `ends` are states at the nodes, of which the last is the end of the step. Errors of accelerations count as errors of
    velocities, and half a step later of coordinates.
    """
    sizes, y, share = system.sizes, run.y, weights_of(span, run)
    work = sizes.nq + sizes.nv
    mean = 1.0 / sizes.controlled
    for i in range(sizes.ny):
        place, end = share[sizes.width + i], ends[i * NODES + NODES - 1]
        allowed = span.atol + span.rtol * share[i] * max(abs(y[i] - place), abs(end - place))
        error = h * share[i] / allowed if allowed > 0.0 else 0.0
        if not ADAPTIVE:
            scale = 1e-16 * max(1.0, run.scales[i] * max(abs(y[i]), abs(end)))
            error = h * run.scales[i] / scale
        weights[i] = mean * error * error
    if ADAPTIVE:
        least = span.atol
        if span.relative != 0.0:
            least *= run.w[abi.KINETIC] + abs(run.w[abi.POTENTIAL])
        allowed = least + span.rtol * max(run.gauges[abi.ENERGY_SCALE], abs(y[work]))
        weights[work] = (h / allowed) * (h / allowed) if allowed > 0.0 else 0.0
    rows, count = scheme.rows, scheme.rows[0]
    for c in range(1, count + 1):
        if rows[c + count] >= 0:
            weights[rows[c]] += 0.25 * h * h * weights[rows[c + count]]


def step_rests(sizes: Sizes, span: Span, run: Run, ends: Array) -> bool:
    """Return whether no velocity is more than its tolerance at the beginning and at the end of a step."""
    share, largest = weights_of(span, run), 0.0
    for i in range(sizes.nq, sizes.nq + sizes.nv):
        largest = max(largest, share[i] * max(abs(run.y[i]), abs(ends[i * NODES + NODES - 1])))
    return bool(largest <= tolerance_at_rest(span)) and not is_carried(span, run)


def begin_nodes(
    system: ModelSystem, scheme: Nodes, run: Run, t: float, following: float, h: float, times: Array, rates: Array
) -> None:
    """Set the times of nodes, and their first rates: by the polynomial of the step before, or those at the start."""
    rows, table, width = scheme.rows, scheme.table, system.sizes.width
    last, first = run.memory[STEP], part(run.memory, NODES, width)
    if last > 0.0:
        coefficients = part(run.memory, NODES + width, 2 * NODES * width)
        extrapolate(rows, scheme.degree, h / last, part(table, PLACES, NODES), coefficients, rates)
    else:
        for c in range(1, rows[0] + 1):
            i = rows[c]
            for k in range(NODES):
                rates[i * NODES + k] = first[i]
    for k in range(NODES):
        times[k] = t + table[PLACES + k] * h
    times[NODES - 1] = following


def ratio_at_aim(change: float, fall: float, iterations: int) -> float:
    """Return the step over this one that converges in `AIM` iterations, by the last change and how changes fall."""
    ratio = _LONGEST
    if not change < _ENDLESS:
        ratio = _SHORTEST
    else:
        at_aim = change
        for _ in range(iterations, AIM + 1):
            at_aim *= min(fall, 1.0)
        for _ in range(AIM + 1, iterations):
            at_aim /= min(fall, 1.0)
        if at_aim > 1e-7:
            ratio = 0.93 * at_aim ** (-0.5 / (NODES + AIM))
    return ratio


def set_end(sizes: Sizes, run: Run, states: Array) -> None:
    """Set the trial state to the one at the last node."""
    copied(sizes.width, run.y, run.trial)
    for i in range(sizes.ny):
        run.trial[i] = states[i * NODES + NODES - 1]


def attempt(
    system: ModelSystem, scheme: Nodes, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Try a step; rates, their Legendre coefficients and the next step over this one are kept in working memory."""
    sizes, rows, table = system.sizes, scheme.rows, scheme.table
    width, size = sizes.width, NODES * sizes.width
    head, first = part(run.memory, 0, NODES), part(run.memory, NODES, width)
    single, times = part(run.room, 0, NODES), part(run.room, TIMES, NODES)
    squares, weights = part(run.room, SQUARES, 2 * NODES), part(run.room, WIDE + WEIGHED * width, width)
    states, buffers = part(run.room, WIDE + STATES * width, size), WIDE + BUFFERS * width
    old = part(run.room, buffers, size)
    if head[STALE] != 0.0:
        begin_polynomial(system, run, t)
    last = head[STEP]
    begin_nodes(system, scheme, run, t, following, h, times, old)
    alone = scheme.vector == 0 or head[SINGLE] != 0.0
    patient = last == 0.0
    most = CONSTANT if not ADAPTIVE else (FIRST if patient else MOST)
    early = 6 if patient else 2
    which, iterations, converged = 0, 0, False
    change, fall, error = 0.0, 0.25, 0.0  # squares of norms
    while True:
        before, after = part(run.room, buffers + which * size, size), part(run.room, buffers + (1 - which) * size, size)
        place(h, rows, run.y, first, before, table, states)
        if iterations == 0:
            weigh_rates(system, scheme, span, run, h, states, weights)
        elif iterations == 1 and ADAPTIVE and step_rests(sizes, span, run, states):
            weights[sizes.nq + sizes.nv] = 0.0  # the work of what rests is rounding
        odd = 0
        if alone:
            evaluate_one_by_one(system, run, times, states, after)
        else:
            odd = scheme.derive(times, states, run.p, run.w, after)
        iterations += 1
        which = 1 - which
        past = change
        change = STRICT * STRICT * distance(rows, weights, scheme.share, after, before)
        if not change < _ENDLESS:
            if odd == 0:
                break
            alone, which, iterations, change = True, 1 - which, iterations - 1, past
            continue
        if iterations > 1:
            fall = max(change / past, _FASTEST) if past > 0.0 else _FASTEST
            error = change * fall
        if (iterations > 1 and (error < 1.0 or (not ADAPTIVE and fall > 0.25 and change < ROUNDING))) or change == 0.0:
            if odd == 0:
                converged = True
                break
            alone, most = True, most + 3
        elif iterations > 1 and ((ADAPTIVE and iterations >= early and not fall < 1.0) or iterations >= most):
            break
        elif ADAPTIVE and iterations >= early:
            for _ in range(iterations, most):
                error *= fall
            if error > 4.0:
                break
    run.control[abi.EVALUATIONS] += NODES * iterations
    rates = part(run.room, buffers + which * size, size)
    single[BUFFER] = float(which)
    ratio = ratio_at_aim(change, fall, iterations)
    single[RATIO] = min(_AGAIN, max(_SHORTEST, ratio))
    if not converged and (between or not ADAPTIVE):  # a search for events would take the end of an attempt before
        return DIVERGED
    single[ADRIFT] = 0.0
    if not converged:
        crosses = run.control[abi.IN_ZONE] == 1 and run.control[abi.BARRED] == 0 and run.gauges[abi.FALL] > 0.0
        return step_across(system, scheme, span, run, t, following, h) if crosses else math.inf
    single[ALONE] = 1.0 if alone else 0.0
    coefficients = part(run.room, WIDE + COEFFICIENTS * width, 2 * size)
    expand(rows, weights, first, rates, scheme.legendre, coefficients, squares)
    ends, middle = max(squares[NODES], squares[NODES - 1]), max(squares[NODES - 2], squares[NODES - 3])
    decay = min(1.0, math.sqrt(ends / middle)) if middle > 0.0 else 1.0
    single[SLOW] = 1.0 if fall > _SLOW and STRICT * STRICT * middle < _SMOOTH else 0.0
    left = STRICT * math.sqrt(ends) - 15.0 * math.sqrt(error)
    truncation = left * decay**4 if left > 0.0 else 0.0
    single[COARSE] = 1.0 if left * math.sqrt(decay) > _LEFT_OUT else 0.0
    if truncation > 1e-4:
        ratio = min(ratio, 0.9 * truncation ** (-1.0 / 16.0))
    if last == 0.0 and truncation <= 1.0:
        ratio = min(_FIRST_GROWTH, 0.9 * max(truncation, 1e-12) ** (-1.0 / 16.0))
    single[RATIO] = min(_FIRST_GROWTH if last == 0.0 else _LONGEST, max(_SHORTEST, ratio))
    place(h, rows, run.y, first, rates, table, states)
    set_end(sizes, run, states)
    if not ADAPTIVE:
        return 0.0
    if truncation > 1.0:
        single[RATIO], single[ADRIFT] = min(_AGAIN, single[RATIO]), 1.0
        return truncation
    return math.sqrt(error)


@called
def step_across(
    system: ModelSystem, scheme: Nodes, span: Span, run: Run, t: float, following: float, h: float
) -> float:
    """Try a step across a singular position, where iterations diverge, by `dop853`; return its error."""
    width, tableau = system.sizes.width, scheme.tableau
    begin_polynomial(system, run, t)
    one = run_of_one_step(system, tableau, run)
    copied(width, part(run.memory, NODES, width), one.memory)
    error = one_step(system, tableau, span, one, t, following, h, False)
    run.control[abi.ORDER] = NODES
    run.room[ADRIFT] = ACROSS
    return max(2.0, error)


def refuse(run: Run) -> None:
    """Restart where two attempts in a row were refused: the polynomial of the step before is misleading."""
    if run.control[abi.REFUSED] == 1:
        run.memory[STALE] = 1.0


def shrunk_picard_step(span: Span, run: Run, error: float) -> float:
    """Return the next step over a refused one."""
    return float(run.room[RATIO])


def grown_picard_step(span: Span, run: Run, h: float, error: float) -> float:
    """Return the next step over an accepted one."""
    return float(run.room[RATIO])


@called
def begin_polynomial(system: ModelSystem, run: Run, t: float) -> None:
    """Clear the polynomial; evaluate the rates at the start of a step."""
    evaluate(system, run, t, run.y, part(run.memory, NODES, system.sizes.width))
    run.control[abi.EVALUATIONS] += 1
    run.memory[STEP] = run.memory[STALE] = 0.0


@called
def prepare(system: ModelSystem, scheme: Nodes, span: Span, run: Run) -> None:
    """Initialise the memory, and choose a first step."""
    sizes, first, t = system.sizes, part(run.memory, NODES, system.sizes.width), run.clock[abi.TIME]
    begin_polynomial(system, run, t)
    run.control[abi.ORDER] = NODES
    if not ADAPTIVE or span.step > shortest_step(t):  # one that ends at an event may be as short as time resolves
        return
    speed = acceleration = 0.0
    for j in range(sizes.nq, sizes.nq + sizes.nv):
        speed = max(speed, abs(run.y[j]) * run.scales[j])
        acceleration = max(acceleration, abs(first[j]) * run.scales[j])
    step = 0.01 * span.duration
    if acceleration > 0.0:
        motion = max(speed / acceleration, math.sqrt(0.1 * run.w[abi.LENGTH] / (acceleration * run.w[abi.SPEED])))
        step = min(step, 0.5 * span.rtol ** (1.0 / 12.0) * motion)
    run.clock[abi.NEXT] = min(step, span.until - t)


def renew(system: ModelSystem, scheme: Nodes, span: Span, run: Run, t: float, changed: bool) -> None:
    """Store the rates at the end of the step, and its polynomial, where the iteration has converged."""
    if run.room[ADRIFT] != 0.0:
        begin_polynomial(system, run, t)
        return
    run.control[abi.POINTS] += int(run.room[SLOW])
    width, size, rows = system.sizes.width, NODES * system.sizes.width, scheme.rows
    rates = part(run.room, WIDE + BUFFERS * width + int(run.room[BUFFER]) * size, size)
    for c in range(1, rows[0] + 1):
        i = rows[c]
        run.memory[NODES + i] = rates[i * NODES + NODES - 1]
    copied(2 * size, part(run.room, WIDE + COEFFICIENTS * width, 2 * size), part(run.memory, NODES + width, 2 * size))
    run.memory[STEP], run.memory[SINGLE] = run.clock[abi.STEP], run.room[ALONE]


_PARTS: dict[str, Any] = {"prepare": prepare, "attempt": attempt, "renew": renew, "inside": inside_wide_step}

constant = loop(__name__, "constant", SCHEME, **_PARTS)
adaptive = loop(
    *(__name__, "adaptive", SCHEME),
    **{
        **_PARTS,
        "interpolate": interpolate_wide_step,
        "refuse": refuse,
        "shrunk_step": shrunk_picard_step,
        "grown_step": grown_picard_step,
    },
    ADAPTIVE=True,
    DENSE=True,
)
