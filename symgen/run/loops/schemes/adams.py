"""Adams-Bashforth-Moulton predictor-corrector schemes with derivatives at unequal distances.

Coefficients are integrals of the Lagrange polynomials through the past derivatives, by exact Gauss quadrature, so one
source serves constant and varying steps. Stored derivatives are evaluated at the corrected state: a correction enters
the history instead of spoiling it.

Runs with constant steps start with one-step schemes: the classical Runge-Kutta scheme up to order 4, extrapolated
midpoint rules beyond, so that the start keeps the order. Those with varying steps start at order 1 with a short step
and raise the order by one with every accepted step.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import combine, copied, weigh
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scales import error_with_work, weights_of
from symgen.run.layout.scheme_records import MULTISTEP, Multistep
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import evaluate

#: Derivatives kept; the highest order of the corrector.
DEPTH = 9
#: As in the frame: whether steps and order vary.
ADAPTIVE = False


@called
def lagrange_integrals(
    count: int, times: Array, low: float, high: float, nodes: Array, factors: Array, out: Array
) -> None:
    """Set `out` to integrals from `low` to `high` of the Lagrange polynomials on the first `count` of `times`."""
    for i in range(count):
        out[i] = 0.0
    half, middle = 0.5 * (high - low), 0.5 * (high + low)
    for g in range(nodes.shape[0]):
        x = middle + half * nodes[g]
        for i in range(count):
            product = 1.0
            for j in range(count):
                if j != i:
                    product *= (x - times[j]) / (times[i] - times[j])
            out[i] += half * factors[g] * product


@called
def classical_step(system: ModelSystem, run: Run, t: float, h: float, stage: Array, rate: Array) -> int:
    """Set ``run.trial`` by one step of the classical Runge-Kutta scheme; return its evaluations."""
    width, y, out = system.sizes.width, run.y, run.trial
    for i in range(width):  # the newest derivative is the first
        out[i] = y[i] + h / 6.0 * run.memory[i]
        rate[i] = run.memory[i]
    for s in range(3):
        ahead = 0.5 * h if s < 2 else h
        for i in range(width):
            stage[i] = y[i] + ahead * rate[i]
        evaluate(system, run, t + ahead, stage, rate)
        weight = h / 3.0 if s < 2 else h / 6.0
        for i in range(width):
            out[i] += weight * rate[i]
    return 3


@called
def extrapolated_step(
    system: ModelSystem, run: Run, t: float, h: float, stage: Array, rate: Array, before: Array
) -> int:
    """Set ``run.trial`` by one step of order 8; return its evaluations.

    Modified midpoint rules with 2, 4, 6 and 8 parts are extrapolated (Gragg, Bulirsch, Stoer).
    """
    width, y, out, evaluations = system.sizes.width, run.y, run.trial, 0
    for i in range(width):
        out[i] = 0.0
    for parts in range(2, 9, 2):
        factor = 1.0  # of this result in the extrapolated one
        for other in range(2, 9, 2):
            if other != parts:
                factor *= parts**2 / (parts**2 - other**2)
        ahead = h / parts
        for i in range(width):
            before[i] = y[i]
            stage[i] = y[i] + ahead * run.memory[i]
        for k in range(1, parts + 1):
            evaluate(system, run, t + k * ahead, stage, rate)
            evaluations += 1
            if k < parts:
                for i in range(width):
                    following = before[i] + 2.0 * ahead * rate[i]
                    before[i] = stage[i]
                    stage[i] = following
        for i in range(width):
            out[i] += 0.5 * factor * (stage[i] + before[i] + ahead * rate[i])
    return evaluations


@called
def prepare(system: ModelSystem, scheme: Multistep, span: Span, run: Run) -> None:
    """Initialise the history: derivatives, newest first, then their times."""
    evaluate(system, run, run.clock[abi.TIME], run.y, part(run.memory, 0, system.sizes.width))
    run.control[abi.EVALUATIONS] += 1
    run.memory[DEPTH * system.sizes.width] = run.clock[abi.TIME]
    run.control[abi.POINTS] = 1


@called
def attempt(
    system: ModelSystem, scheme: Multistep, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Try a step by predictor, evaluation and corrector; the error is their difference."""
    width, count = system.sizes.width, run.control[abi.POINTS]
    past = part(run.memory, DEPTH * width, DEPTH)
    predicted, rate = part(run.room, 0, width), part(run.room, width, width)
    used = min(count, scheme.order)
    run.control[abi.ORDER] = used + 1
    if not ADAPTIVE and count < scheme.order:  # no history yet
        if scheme.order > 4:
            spare = part(run.room, 2 * width, width)
            run.control[abi.EVALUATIONS] += extrapolated_step(system, run, t, h, predicted, rate, spare)
        else:
            run.control[abi.EVALUATIONS] += classical_step(system, run, t, h, predicted, rate)
        return 0.0
    coefficients = part(run.room, 3 * width, 2 * DEPTH)
    times = part(run.room, 3 * width + 2 * DEPTH, DEPTH + 1)
    lagrange_integrals(used, past, t, following, scheme.nodes, scheme.factors, coefficients)
    combine(width, 1.0, 0, used, scheme.count, coefficients, run.memory, run.y, predicted)
    evaluate(system, run, following, predicted, rate)
    run.control[abi.EVALUATIONS] += 1
    # the corrector has the new derivative in front; with varying steps it is of one order more than the predictor
    corrected = used if ADAPTIVE else used - 1
    times[0] = following
    for j in range(corrected):
        times[j + 1] = past[j]
    lagrange_integrals(corrected + 1, times, t, following, scheme.nodes, scheme.factors, coefficients)
    for i in range(width):
        run.trial[i] = run.y[i] + coefficients[0] * rate[i]
    older = part(coefficients, 1, DEPTH)
    combine(width, 1.0, 0, corrected, scheme.count, older, run.memory, run.trial, run.trial)
    if not ADAPTIVE or between:
        return 0.0
    for i in range(width):
        predicted[i] -= run.trial[i]
    total = weigh(width, predicted, weights_of(span, run), run.y, run.trial, span.rtol, span.atol)
    work = system.sizes.nq + system.sizes.nv
    return 0.1 * error_with_work(system.sizes, span, run, predicted[work], math.sqrt(total / system.sizes.controlled))


def refuse(run: Run) -> None:
    """Clear the history where two attempts in a row were refused: it is misleading."""
    if run.control[abi.REFUSED] == 1:
        run.control[abi.POINTS] = 1


def renew(system: ModelSystem, scheme: Multistep, span: Span, run: Run, t: float, changed: bool) -> None:
    """Put the derivative at the accepted state in front of the history."""
    width, count, history = system.sizes.width, run.control[abi.POINTS], run.memory
    past = part(history, DEPTH * width, DEPTH)
    for j in range(min(count, DEPTH - 1), 0, -1):
        past[j] = past[j - 1]
        copied(width, part(history, (j - 1) * width, width), part(history, j * width, width))
    past[0] = t
    evaluate(system, run, t, run.y, part(history, 0, width))
    run.control[abi.EVALUATIONS] += 1
    run.control[abi.POINTS] = min(count + 1, DEPTH)


def memory(width: int) -> tuple[int, int]:
    """Return the lengths of a history, and of the working memory of a step after the trial state."""
    return DEPTH * (width + 1), 3 * width + 3 * DEPTH + 1


_PARTS: dict[str, Any] = {"prepare": prepare, "attempt": attempt, "renew": renew}

#: Parts of the frame.
ADAPTIVE_PARTS: dict[str, Any] = {
    **_PARTS,
    **{"refuse": refuse, "ADAPTIVE": True, "SHRINK_ACCEPTED": 0.3, "GROW": 2.0, "FLOOR": 1e-12},
}

constant = loop(__name__, "constant", MULTISTEP, **_PARTS)
adaptive = loop(__name__, "adaptive", MULTISTEP, **ADAPTIVE_PARTS)
