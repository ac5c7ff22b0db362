"""The frame of all loops around the step of a scheme: outputs, accepted states, error control and termination.

Loops are instances of this plain Python (`symgen.compile.loopcode.loop_instances`). A scheme gives a meaning to the
names of `symgen.run.loops.frame_parts`, and so does the target: a processor, vector lanes, a CUDA device.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from symgen.compile.loopcode.bare import bare
from symgen.compile.loopcode.loop_instances import compiled_loop
from symgen.compile.loopcode.vectors import copied, received
from symgen.compile.native import types
from symgen.compile.native.annotations import Record
from symgen.run.layout import abi
from symgen.run.layout.records import OUTPUTS, SIZES, SPAN, STATE, EventRun, ModelSystem, Outputs, Span, State, System
from symgen.run.layout.redundancy import rows_fell
from symgen.run.layout.scales import settle_scales
from symgen.run.loops.frame_parts import (
    ADAPTIVE,
    CROWD,
    DENSE,
    EVENTS,
    FAIL,
    LOOK,
    MEET,
    NOTHING,
    RECALL,
    REMEMBER,
    RESTART,
    ROUGH,
    SEEK,
    TRY,
    correct,
    note_step,
    open_run,
    refuse_step,
    store_between,
    store_output,
    take_back_outputs,
)
from symgen.run.loops.judgement import AGAIN, REFUSE, judge_attempt, judge_state
from symgen.run.loops.step_control import grown_step, part_of_step
from symgen.run.loops.unbound import attempt, interpolate, is_astray, prepare, prepare_search, renew, step_to_point
from symgen.run.loops.watch import allowed_step, begin_watch, is_stuck, remember_rank, watch

#: Constant steps at the beginning of a run in which its energy is not judged: from rest, the error of n steps of a
#: first-order scheme is an n-th of an energy that is only building up.
SETTING_OUT = 100
#: Step across a zone over the distance to its middle: not 2, so that no stage at half the step meets the middle.
_ACROSS = 2.3
#: Assumed step until an adaptive run has chosen one, as a part of the run.
_BEFORE = 1e-3


# -- the frame ---------------------------------------------------------------------------------------------------------


def begin_loop(system: ModelSystem, scheme: Record, span: Span, run: EventRun, outputs: Outputs) -> int:
    """Measure and store the first state of a run, if it is new; begin the scheme, or discard its past steps.

    Returns the code of an end, `DONE` to continue.
    """
    sizes, clock, control, times = system.sizes, run.clock, run.control, outputs.times
    if control[abi.BEGUN] == 0:
        remember_rank(sizes, run)
        settle_scales(sizes, span, run)
        copied(sizes.width, run.y, run.trial)
        correct(system, run, clock[abi.TIME], run.trial, False)
        copied(sizes.width, run.trial, run.y)
        begin_watch(run)
        code = watch(sizes, run, run.y, clock[abi.TIME])
        if code != abi.DONE:
            return code
        out, latest = control[abi.OUTPUTS], clock[abi.TIME] + time_resolution(span)
        while out < times.shape[0] and times[out] <= latest:
            store_output(sizes, run.w, outputs, out, run.y)
            out += 1
        control[abi.OUTPUTS] = out
    # a scheme that began at the end of a run, after its last event, had no time to choose a step for
    if control[abi.BEGUN] != 1 or (ADAPTIVE and not clock[abi.NEXT] > shortest_step(clock[abi.TIME])):
        clock[abi.ALLOWED] = 0.0
        control[abi.REFUSED] = control[abi.BARRED] = control[abi.KNOWN] = 0
        if ADAPTIVE:
            clock[abi.NEXT] = max(clock[abi.NEXT], span.step) if control[abi.BEGUN] == abi.ONWARD else span.step
        # laws whose gains follow the step are evaluated before the first step
        note_step(run, span.step if span.step > 0.0 else _BEFORE * span.duration)
        prepare(system, scheme, part_of_step(span, span.until, clock[abi.NEXT] if ADAPTIVE else span.step), run)
        if prepare_search(system, run, LOOK) == FAIL:
            return abi.UNDEFINED
        control[abi.BEGUN] = 1
    return abi.DONE


def time_resolution(span: Span) -> float:
    """Return the difference below which times of a grid of constant steps are equal [s]."""
    return 0.0 if ADAPTIVE else abi.SAME_TIME * span.step


def shortest_step(t: float) -> float:
    """Return the length that steps from a time have to exceed [s]."""
    return max(abi.RESOLVED_TIME * abs(t), abi.SHORTEST_STEP)


def last_resolution(span: Span) -> float:
    """Return the rest of a run that is no step [s]: an event may be by some roundings before its end."""
    return abi.END_TIME * abs(span.until) if ADAPTIVE else time_resolution(span)


def move_to_end(system: ModelSystem, span: Span, run: EventRun, outputs: Outputs) -> None:
    """Have a run that has ended by some roundings before its end be there, with the outputs up to it."""
    out = run.control[abi.OUTPUTS]
    while out < outputs.times.shape[0] and outputs.times[out] <= span.until:
        store_output(system.sizes, run.w, outputs, out, run.y)
        out += 1
    run.control[abi.OUTPUTS] = out
    run.clock[abi.TIME] = max(run.clock[abi.TIME], span.until)


def choose_step(
    system: ModelSystem, span: Span, run: EventRun, outputs: Outputs, t: float
) -> tuple[int, float, float, bool, bool, float]:
    """Choose the step from the time `t` [s].

    Returns
    -------
    tuple
        Code of an end, `DONE` to continue; the step and its end [s]; whether it ends at an output between steps;
        whether it crosses a singular position; the step that the error estimate proposes [s].
    """
    clock, control, times, until = run.clock, run.control, outputs.times, span.until
    code, h, following, crossing, proposal = abi.DONE, 0.0, 0.0, False, 0.0
    stop = control[abi.STOP]
    if stop == abi.AT_ONCE or 0 < stop < control[abi.EVALUATIONS]:
        code = abi.STOPPED
    elif control[abi.STEPS] >= span.pause:
        code = abi.PAUSED
    elif not ADAPTIVE:
        h, following = span.step, clock[abi.ORIGIN] + (control[abi.INDEX] + 1) * span.step
        if following > until + time_resolution(span):
            h, following = until - t, until
    elif is_stuck(span, run, t):
        code = abi.NO_PROGRESS
    else:
        crossing = control[abi.BARRED] == 0 and control[abi.IN_ZONE] == 1 and run.gauges[abi.FALL] > 0.0
        h = allowed_step(min(clock[abi.NEXT], span.largest), run.gauges)
        if crossing:
            h = min(span.largest, _ACROSS * run.gauges[abi.LAST_SINE] / run.gauges[abi.FALL])
        proposal = h
        if EVENTS and not crossing:
            h = step_to_point(system, run, h)
        following = t + h
        if t + 1.01 * h >= until:
            h, following = until - t, until
        if not h > shortest_step(t):
            code = abi.TINY_STEP
    between, out = False, control[abi.OUTPUTS]
    if not DENSE and out < times.shape[0] and times[out] < following - time_resolution(span):
        between, h, following = True, times[out] - t, times[out]
    return code, h, following, between, crossing, proposal


def accept_step(
    system: ModelSystem,
    scheme: Record,
    span: Span,
    run: EventRun,
    outputs: Outputs,
    t: float,
    step: tuple[float, float, bool, float, float],
    trial: tuple[float, bool],
    search: int,
) -> int:
    """Accept the trial state at the end of a step from the time `t` [s], with the outputs inside.

    Parameters
    ----------
    step : tuple
        The step and its end [s]; whether it crosses a singular position; the step that the error estimate proposed and
        the one without events [s].
    trial : tuple
        Error of the trial state over the tolerance; whether its correction changed it.
    search : int
        Last result of `located`.

    Returns
    -------
    int
        Code of an end, `DONE` to continue.
    """
    h, following, crossing, proposal, whole = step
    error, changed = trial
    control, times, width = run.control, outputs.times, system.sizes.width
    met, restart = EVENTS and search == MEET, EVENTS and search == RESTART
    control[abi.STEPS] += 1
    code = watch(system.sizes, run, run.trial, following)
    setting_out = (not ADAPTIVE or ROUGH) and control[abi.STEPS] <= SETTING_OUT
    if code != abi.DONE and not (setting_out and code == abi.ENERGY and following < span.end - time_resolution(span)):
        return code
    if EVENTS and is_astray(span, run, ADAPTIVE):
        return abi.JUMPED
    if met or restart:
        take_back_outputs(run, times, following)
    if DENSE and control[abi.OUTPUTS] < times.shape[0] and times[control[abi.OUTPUTS]] < following:
        interpolate(system, scheme, span, run, outputs, t, following, h)
    received(width, run.trial, run.y)
    propose_step(span, run, h, following, crossing, proposal, error, met)
    out = control[abi.OUTPUTS]
    if out < times.shape[0] and times[out] <= following + time_resolution(span):
        store_output(system.sizes, run.w, outputs, out, run.y)
        control[abi.OUTPUTS] = out + 1
    if restart:  # rates jump at a switch, so that data of past steps are useless
        run.clock[abi.NEXT], run.clock[abi.ALLOWED] = max(run.clock[abi.NEXT], whole), 0.0
        prepare(system, scheme, part_of_step(span, span.until, run.clock[abi.NEXT]), run)
    else:
        renew(system, scheme, span, run, following, changed)
    if met:
        return abi.MET
    if EVENTS and search == CROWD:
        return abi.NOTED
    return abi.CHOOSE if rows_fell(run) else abi.DONE


def propose_step(
    span: Span, run: EventRun, h: float, following: float, crossing: bool, proposal: float, error: float, met: bool
) -> None:
    """Propose the step after an accepted one, with the names of `accept_step`; `met`: the run ends in an event."""
    clock, control = run.clock, run.control
    if not ADAPTIVE:
        control[abi.INDEX] += 1
        grid = clock[abi.ORIGIN] + control[abi.INDEX] * span.step
        if met or (following == span.until and following < grid - time_resolution(span)):
            clock[abi.ORIGIN], control[abi.INDEX] = following, 0  # a continued run has its grid from here
    elif crossing:
        clock[abi.ALLOWED] = 0.0
    else:
        grow = grown_step(span, run, h, error)
        clock[abi.NEXT] = h * (min(1.0, grow) if control[abi.REFUSED] == 1 else grow)
        if EVENTS and h < proposal and control[abi.REFUSED] == 0:  # it was not shortened by its error
            clock[abi.NEXT] = max(clock[abi.NEXT], proposal)
    control[abi.REFUSED] = control[abi.BARRED] = 0
    clock[abi.STEP] = h


def integrate(model: System, scheme: Record, span: Span, state: State, outputs: Outputs) -> int:
    """Integrate from the present state of a run to the end of `span`.

    Parameters
    ----------
    model : tuple
        Parts of a `ModelSystem`: the sizes of the model, then its functions (`symgen.run.layout.abi`), 0 for
        those that the scheme does not call.
    scheme : record
        The scheme.
    span : Span
        End of the integration, and its steps.
    state : State
        State of the run, a `EventState` if events are sought; changed.
    outputs : Outputs
        Outputs, written from ``control[OUTPUTS]`` on.

    Returns
    -------
    int
        Code of its end, see `symgen.run.layout.abi`.
    """
    system = ModelSystem(*model)
    scheme, outputs, run = bare(scheme), bare(outputs), open_run(system.sizes, state)
    code = begin_loop(system, scheme, span, run, outputs)
    if code != abi.DONE:
        return code
    t, search, crossing, doubtful = run.clock[abi.TIME], NOTHING, False, False
    whole, whole_following, proposal = 0.0, 0.0, 0.0
    phi, drift, energy = run.gauges[abi.MAX_PHI], run.gauges[abi.MAX_DRIFT], run.gauges[abi.MAX_ENERGY]
    while t < span.until - last_resolution(span):
        if EVENTS and search != NOTHING:
            prepare_search(system, run, RECALL)
            h, between = run.hunt[TRY], False
            following = whole_following if h == whole else t + h
        else:
            code, h, following, between, crossing, proposal = choose_step(system, span, run, outputs, t)
            if code != abi.DONE:
                return code
            doubtful = False
            if not between:
                whole, whole_following = h, following
                prepare_search(system, run, REMEMBER)
        probing, bits = between or search == SEEK, 0
        note_step(run, h)
        kinetic, potential = run.w[abi.KINETIC], run.w[abi.POTENTIAL]
        error = attempt(system, scheme, span, run, t, following, h, probing)
        step = h, following, between, crossing
        code, search, doubtful = judge_attempt(system, scheme, span, run, step, error, search, doubtful)
        if code == abi.DONE:
            bits = correct(system, run, following, run.trial, probing)
            if between:
                store_between(system.sizes, run, outputs)
                # the work's error is judged by the energies at the beginning of the step, whatever outputs it has
                run.w[abi.KINETIC], run.w[abi.POTENTIAL] = kinetic, potential
                continue
            code, search = judge_state(system, scheme, run, h, following, bits, search)
        if code == AGAIN:
            continue
        if code == REFUSE:
            search = NOTHING
            refuse_step(run, outputs.times, t, phi, drift, energy)
            continue
        if code == abi.DONE:
            lengths, trial = (h, following, crossing, proposal, whole), (error, bits & 2 != 0)
            code = accept_step(system, scheme, span, run, outputs, t, lengths, trial, search)
        if code != abi.DONE:
            return code
        t, search = following, NOTHING
        phi, drift, energy = run.gauges[abi.MAX_PHI], run.gauges[abi.MAX_DRIFT], run.gauges[abi.MAX_ENERGY]
    if ADAPTIVE and t < span.until:
        move_to_end(system, span, run, outputs)
    return abi.DONE


#: The functions of a `ModelSystem` with their types.
FUNCTIONS = {
    **{"rhs": abi.RHS, "confirm": abi.RHS, "accept": abi.ACCEPT},
    **{"turn": abi.MOVE, "residual": abi.STAGE, "tangent": abi.STAGE},
}
#: Arguments with which each loop was made, for its variant with events.
RECIPES: dict[Any, tuple[tuple[Any, ...], dict[str, Any]]] = {}


def kinds_of(functions: Iterable[str]) -> tuple[types.Kind, ...]:
    """Return the types of the parts of a `ModelSystem`; functions besides ``rhs``, ``confirm``, ``accept`` by name."""
    called = {"rhs", "confirm", "accept", *functions}
    return SIZES, *(kind if name in called else types.int64 for name, kind in FUNCTIONS.items())


def loop(module: str, name: str, scheme: types.RecordType, *functions: str, **meanings: Any) -> Any:
    """Return the compiled loop around the step of a scheme.

    Parameters
    ----------
    module, name : str
        Module variable of the loop.
    scheme : Record
        Type of the scheme's record.
    *functions : str
        Functions that it calls besides ``rhs``, ``confirm`` and ``accept``.
    **meanings
        Meanings of the names of the frame.
    """
    signature = types.int64(types.RecordType(kinds_of(functions)), scheme, SPAN, STATE, OUTPUTS)
    made = compiled_loop(module, name, integrate, signature, **meanings)
    RECIPES[made] = (module, name, scheme, *functions), meanings
    return made
