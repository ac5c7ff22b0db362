"""Explicit Runge-Kutta schemes, driven by the tableau: one compilation serves all schemes and all models.

The state is projected after each accepted step only; the error estimate belongs to the unprojected pair; output times
within an adaptive step are interpolated between unprojected ends, and each output is then projected. Stage derivatives
live in one flat buffer: views of rows cost more than a stage.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import combine, copied, follow, total, weigh
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Outputs, Run, Span
from symgen.run.layout.scales import error_with_work, weights_of
from symgen.run.layout.scheme_records import TABLEAU, PartitionedStages, TableauRecord
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import correct, evaluate, store_output
from symgen.run.loops.search_records import N_INSIDE
from symgen.run.loops.watch import keep_maxima

#: Largest growth of the allowed step from one step to the next: with more growth the estimate passes through zero. It
#: is not applied where the last step was shorter than this fraction of the allowed one, at the start or where its error
#: is rounding, and near singular positions.
_GROWTH, _SETTLED = 1.25, 0.25
#: Least trial step for the guess of a first step, over a run: below, more than `MAX_ATTEMPTS` steps would follow.
_SHORTEST = 1e-10


def attempt_constant(
    system: ModelSystem,
    scheme: TableauRecord,
    span: Span,
    run: Run,
    t: float,
    following: float,
    h: float,
    between: bool,
) -> float:
    """Try a step without an error estimate."""
    width, start, column, value = system.sizes.width, scheme.start, scheme.column, scheme.value
    for s in range(scheme.stages + 1):
        follow(width, h, start[s], start[s + 1], column, value, run.room, run.y, run.trial)
        if s < scheme.stages:
            evaluate(system, run, t + scheme.nodes[s] * h, run.trial, part(run.room, s * width, width))
    run.control[abi.EVALUATIONS] += scheme.stages
    return 0.0


# -- steps from the error estimate: the first stage is kept ------------------------------------------------------------


@called
def prepare(system: ModelSystem, scheme: PartitionedStages | TableauRecord, span: Span, run: Run) -> None:
    """Evaluate the first stage; choose a first step as Hairer, Norsett, Wanner, Solving ODEs I, section II.4, do."""
    t, y, width = run.clock[abi.TIME], run.y, system.sizes.width
    first, rate = part(run.memory, 0, width), part(run.memory, width, width)
    run.control[abi.ORDER] = scheme.order + 1
    evaluate(system, run, t, y, first)
    run.control[abi.EVALUATIONS] += 1
    if span.step > 0.0:
        return
    count, share, least = system.sizes.controlled, weights_of(span, run), 1e-6 * span.duration
    d0 = math.sqrt(weigh(width, y, share, y, y, span.rtol, span.atol) / count)
    d1 = math.sqrt(weigh(width, first, share, y, y, span.rtol, span.atol) / count)
    h0 = least if d0 < 1e-5 or d1 * span.duration < 1e-5 else 0.01 * d0 / d1
    # a state that is rounding compared with its tolerance, as coordinates of 1e-16 at rest, has no scale of time
    h0 = min(max(h0, _SHORTEST * span.duration), span.until - t)
    for i in range(width):
        run.trial[i] = y[i] + h0 * first[i]
    evaluate(system, run, t + h0, run.trial, rate)
    run.control[abi.EVALUATIONS] += 1
    for i in range(width):
        rate[i] -= first[i]
    d2 = math.sqrt(weigh(width, rate, share, y, y, span.rtol, span.atol) / count) / h0
    # their guess takes seconds for the unit of time; here it is the time in which the state changes by its own size
    unit = 100.0 * h0
    largest = max(d1 * unit, d2 * unit * unit)
    h1 = max(least, 1e-3 * h0) if largest <= 1e-15 else unit * (0.01 / largest) ** (1.0 / (scheme.order + 1.0))
    run.clock[abi.NEXT] = min(100.0 * h0, h1)


def attempt(
    system: ModelSystem,
    scheme: TableauRecord,
    span: Span,
    run: Run,
    t: float,
    following: float,
    h: float,
    between: bool,
) -> float:
    """Try a step; return its error over the tolerance. The unprojected end is kept in working memory."""
    width, start, column, value = system.sizes.width, scheme.start, scheme.column, scheme.value
    stages, last = run.memory, scheme.stages
    new, error = part(run.room, 0, width), part(run.room, width, width)
    for s in range(1, last + 1):
        follow(width, h, start[s], start[s + 1], column, value, stages, run.y, run.trial)
        if s < last + scheme.ends:
            evaluate(system, run, t + scheme.nodes[s] * h, run.trial, part(stages, s * width, width))
    run.control[abi.EVALUATIONS] += last - 1 + scheme.ends
    run.control[abi.KNOWN] = scheme.ends
    copied(width, run.trial, new)
    # error weights follow all stages in the table
    row, count, share = scheme.nodes.shape[0], system.sizes.controlled, weights_of(span, run)
    work, first, second, before, done = system.sizes.nq + system.sizes.nv, 0.0, 0.0, 0.0, 0.0
    for e in range(scheme.estimates):
        total(width, h, start[row + e], start[row + e + 1], column, value, stages, error)
        first, second = second, weigh(width, error, share, run.y, new, span.rtol, span.atol)
        before, done = done, abs(error[work])
    if scheme.estimates == 1:
        return error_with_work(system.sizes, span, run, done, math.sqrt(second / count))
    size = 0.0
    if first != 0.0:
        size = float(first) / math.sqrt((first + 0.01 * second) * count)  # two estimates are combined as Hairer does
    if before != 0.0:
        done = before * before / math.sqrt(before * before + 0.01 * done * done)
        size = error_with_work(system.sizes, span, run, done, size)
    allowed = run.clock[abi.ALLOWED]
    if allowed > 0.0 and _SETTLED * allowed < 1.0 and run.control[abi.IN_ZONE] == 0:
        least = h / (_GROWTH * allowed * run.clock[abi.STEP])
        least *= least  # and twice more: the combination goes with the eighth power of the step
        least *= least
        least *= least
        size = least if least > size else size  # nan stays nan
    return size


def renew(
    system: ModelSystem, scheme: PartitionedStages | TableauRecord, span: Span, run: Run, t: float, changed: bool
) -> None:
    """Set the first stage of the next step: the last of this one, unless a correction has changed the state."""
    width, first = system.sizes.width, part(run.memory, 0, system.sizes.width)
    if changed or run.control[abi.KNOWN] == 0:
        evaluate(system, run, t, run.y, first)
        run.control[abi.EVALUATIONS] += 1
    else:
        copied(width, part(run.memory, scheme.stages * width, width), first)


@called
def interpolate_explicit_step(
    system: ModelSystem,
    scheme: TableauRecord,
    span: Span,
    run: Run,
    outputs: Outputs,
    t: float,
    following: float,
    h: float,
) -> None:
    """Write the outputs inside a step, each projected; the status at the end of the step is restored."""
    scheme, run, outputs = bare(scheme), bare(run), bare(outputs)
    width, stages, lanes = system.sizes.width, run.memory, scheme.dense.shape[0] // scheme.degree
    new, measured = part(run.room, 0, width), part(run.room, width, width)
    tables = part(run.room, 3 * width, 2 * lanes)
    windings = outputs.status.shape[1] - abi.N_STATUS
    angles = part(run.room, 3 * width + 2 * lanes, windings)
    for i in range(abi.N_STATUS):
        measured[i] = run.w[i]
    for i in range(windings):
        angles[i] = run.w[abi.WINDING + i]
    complete_stages(system, scheme, run, stages, new, t, following, h)
    out = run.control[abi.OUTPUTS]
    while out < outputs.times.shape[0] and outputs.times[out] < following:
        x = (outputs.times[out] - t) / h
        read_stages(width, scheme, x, h, run.y, stages, tables, new)
        correct(system, run, outputs.times[out], new, True)
        keep_maxima(system.sizes, run, new)
        store_output(system.sizes, run.w, outputs, out, new)
        out += 1
    run.control[abi.OUTPUTS] = out
    for i in range(abi.N_STATUS):
        run.w[i] = measured[i]
    for i in range(windings):
        run.w[abi.WINDING + i] = angles[i]


@called
def inside_explicit_step(
    system: ModelSystem, scheme: TableauRecord, run: Run, t: float, following: float, h: float, i: int, y: Array
) -> float:
    """Set `y` to the state at inner point i of a good attempt by its dense output; return its part of the step."""
    width, lanes = system.sizes.width, scheme.dense.shape[0] // scheme.degree
    if i == 0:
        copied(width, part(run.room, 0, width), y)
        known = run.control[abi.KNOWN]
        complete_stages(system, scheme, run, run.memory, y, t, following, h)
        run.control[abi.KNOWN] = known
    x = (i + 1.0) / (N_INSIDE + 1.0)
    read_stages(width, scheme, x, h, run.y, run.memory, part(run.room, 3 * width, 2 * lanes), y)
    return x


@called
def complete_stages(
    system: ModelSystem,
    scheme: TableauRecord,
    run: Run,
    stages: Array,
    new: Array,
    t: float,
    following: float,
    h: float,
) -> None:
    """Evaluate the further stages that outputs need; `new` has the unprojected end, and changes."""
    width, start, last = system.sizes.width, scheme.start, scheme.stages
    for s in range(last + run.control[abi.KNOWN], scheme.nodes.shape[0]):
        if s > last:
            follow(width, h, start[s], start[s + 1], scheme.column, scheme.value, stages, run.y, new)
        evaluate(system, run, t + scheme.nodes[s] * h if s > last else following, new, part(stages, s * width, width))
        run.control[abi.EVALUATIONS] += 1
    run.control[abi.KNOWN] = 1


def read_stages(
    width: int, scheme: TableauRecord, x: float, h: float, y: Array, stages: Array, tables: Array, new: Array
) -> None:
    """Set `new` to the state at the part `x` of a step, from all its stages; `tables` has room for their weights."""
    lanes = scheme.dense.shape[0] // scheme.degree
    powers, weights, power = part(tables, 0, lanes), part(tables, lanes, lanes), 1.0
    for j in range(scheme.degree):
        power *= x
        powers[j] = power
    total(lanes, 1.0, 0, scheme.degree, scheme.count, powers, scheme.dense, weights)
    combine(width, h, 0, scheme.nodes.shape[0], scheme.count, weights, stages, y, new)


def explicit_room(width: int, scheme: TableauRecord, windings: int) -> int:
    """Return the working memory of a step after the trial state; `windings` angles count turns."""
    if not scheme.degree:
        return int(scheme.stages) * width
    return 3 * width + 2 * len(scheme.dense) // int(scheme.degree) + windings


#: Parts of the frame.
CONSTANT_PARTS = {"attempt": attempt_constant}
ADAPTIVE_PARTS = {
    **{"ADAPTIVE": True, "DENSE": True, "prepare": prepare, "attempt": attempt},
    **{"renew": renew, "interpolate": interpolate_explicit_step, "inside": inside_explicit_step},
}

constant = loop(__name__, "constant", TABLEAU, **CONSTANT_PARTS)
adaptive = loop(__name__, "adaptive", TABLEAU, **ADAPTIVE_PARTS)
