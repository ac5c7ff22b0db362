"""One run that is kept between calls, with its modes, impacts and events, for programs without Python.

The loop is the frame of all runs (`symgen.run.loops.frame`), so that steps, events and modes are those of single runs.
An output between two steps shortens neither: the run shows the state at the requested time, and may itself already be
at the end of the step that contains it. If a caller changes the state shown, the run goes on from there.

Outputs inside an adaptive step are read from that step, which the run keeps (`symgen.run.loops.schemes.readable`).
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.loop_instances import viewing
from symgen.compile.native.annotations import Array, Integers, Record, record_type
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import RowChunk, Sizes, Span, State, System
from symgen.run.layout.scheme_records import TableauRecord
from symgen.run.loops.event_loop import EventState
from symgen.run.loops.frame_parts import ADAPTIVE
from symgen.run.loops.schemes.readable import forget_step
from symgen.run.loops.seams import due_time
from symgen.run.loops.unbound import (
    assume_step,
    begin_choice,
    forget_run,
    integrate,
    let_go,
    read_step,
    return_before_seams,
    system_of_steps,
    take_change,
    take_notes,
)
from symgen.run.modes.row_records import first_step
from symgen.run.modes.turn import open_rows_of
from symgen.run.rows.row_results import follow_rows
from symgen.run.rows.rows import begin_run

#: Results of `advance_run`: the time is reached; an event ends the run; no step, or no modes, lead on.
REACHED, ENDED, FAILED = range(3)
#: Places of the time that is shown, and of the time at which a run with adaptive steps is to end [s]; then those of the
#: code of the end of the run, of the number of the event that ends it, -1 for none, of 1 where the run has stopped at
#: events that it has not met yet, and of 1 where the caller has changed something.
SHOWN_TIME, END_TIME = range(2)
END_CODE, ENDING, UNMET, CHANGED = range(4)


class KeptOutput(Record):
    """The output of a call: its time, the state, and the status followed by modes."""

    times: Array
    states: Array
    status: Array


KEPT_OUTPUT = record_type(KeptOutput)


class Visible(Record):
    """What a caller sees and may change, and what ends runs.

    Attributes
    ----------
    y, clock : Array, shapes (ny,), (1,) or (2,)
        State, and times [s] at the places of `SHOWN_TIME` and following.
    numbers : Array of int64, shape (4,)
        At the places of `END_CODE` and following.
    ends : Array of int64, shape (events,)
        1 for events that end the run.
    """

    y: Array
    clock: Array
    numbers: Integers
    ends: Integers


VISIBLE = record_type(Visible)


# -- outputs -----------------------------------------------------------------------------------------------------------


def show_state(sizes: Sizes, w: Array, outputs: KeptOutput, k: int, y: Array) -> None:
    """Write the only output: the state, the measures of ``accept``, angles with counted turns and modes of rows."""
    for i in range(sizes.ny):
        outputs.states[i] = y[i]
    for i in range(abi.N_STATUS):
        outputs.status[i] = w[i]
    for i in range(abi.N_STATUS, outputs.status.shape[0]):
        outputs.status[i] = w[abi.WINDING - abi.N_STATUS + i]


def return_to_shown(
    until: float, scheme: TableauRecord, visible: Visible, state: EventState, outputs: KeptOutput
) -> int:
    """Have the run go on from the state shown, if the caller has changed it or the run is past a time [s].

    Returns 1 where the caller has changed the state, else 0.
    """
    control, clock, ny, unchanged = state.control, state.clock, visible.y.shape[0], True
    for i in range(ny):
        unchanged = unchanged and visible.y[i] == outputs.states[i]
    same = unchanged and visible.clock[SHOWN_TIME] == outputs.times[0]
    same = same and until >= (outputs.times[0] if ADAPTIVE else clock[abi.TIME])
    if control[abi.BEGUN] != 0 and same and visible.numbers[CHANGED] == 0:
        return 0
    if ADAPTIVE:
        forget_step(state.y.shape[0], scheme, state.memory)
    for i in range(ny):
        state.y[i] = visible.y[i]
    if control[abi.BEGUN] == 0 or clock[abi.TIME] != visible.clock[SHOWN_TIME]:
        for i in range(abi.N_STATUS, outputs.status.shape[0] if control[abi.BEGUN] != 0 else 0):
            state.w[abi.WINDING - abi.N_STATUS + i] = outputs.status[i]
        clock[abi.TIME] = clock[abi.ORIGIN] = state.gauges[abi.LAST_TIME] = visible.clock[SHOWN_TIME]
        control[abi.INDEX] = 0
    visible.numbers[UNMET], visible.numbers[CHANGED] = 0, 1
    control[abi.BEGUN] = abi.AFRESH if control[abi.BEGUN] != 0 else 0
    return 0 if unchanged or control[abi.BEGUN] == 0 else 1


# -- seams -------------------------------------------------------------------------------------------------------------


def begin_at_seams(model: System, span: Span, state: EventState) -> int:
    """Choose modes where a run without seams begins; return `DONE` or the code of an end."""
    return int(begin_choice(model, span, state))


@viewing
def system_between_seams(system: System) -> Any:
    """Return the first argument of the loop over steps between two seams."""
    return system[0]


def forget_later_seams(system: System, state: State) -> None:
    """Forget that seams after the present time have been passed."""
    _, seams, _, _, _ = system
    while state.control[abi.PASSED] > 0 and due_time(seams, state.control[abi.PASSED] - 1) > state.clock[abi.TIME]:
        state.control[abi.PASSED] -= 1


# -- the run -----------------------------------------------------------------------------------------------------------


def assume_first_step(model: System, span: Span) -> None:
    """Set the step that laws assume before the first one."""
    model[2].choice.step[0] = first_step(span)


def let_rows_go(model: System, state: EventState) -> None:
    """Take all rows out of force, and keep which gaps are closed."""
    open_rows_of(model[2], state)


def start_run(model: System, limits: Array, chunk: RowChunk, state: EventState, visible: Visible) -> int:
    """Forget the previous run: the state shown is the start of another one.

    Parameters
    ----------
    model, chunk, state, visible
        As for `advance_run`.
    limits : Array
        As in a `RowChunk`.
    """
    begin_run(state, limits)
    forget_run(model, state)
    for i in range(chunk.events.shape[0]):
        counts = i >= e.HEAD_OF_EVENTS and (i - e.HEAD_OF_EVENTS) % e.OF_EVENT == 0
        chunk.events[i] = 0.0 if counts else math.nan
    visible.clock[SHOWN_TIME] = 0.0
    visible.numbers[END_CODE], visible.numbers[ENDING], visible.numbers[UNMET] = abi.DONE, -1, 0
    visible.numbers[CHANGED] = 1
    return 0


def steps_until(span: Span, until: float, pause: float, duration: float) -> Span:
    """Return a span to a time [s], or to a number of steps, of a run that takes a time [s]."""
    return Span(
        *(span.step, span.largest, until, span.end, duration, span.rtol, span.atol, span.relative),
        *(span.safety, span.most, pause, span.turn),
    )


def ending_event(chunk: RowChunk, visible: Visible, t: float) -> int:
    """Return the number of the event that ends the run at a time, -1 for none."""
    for k in range(visible.ends.shape[0]):
        at = e.HEAD_OF_EVENTS + e.OF_EVENT * k
        if visible.ends[k] != 0 and chunk.events[at] > 0.0 and chunk.events[at + 2] == t:
            return int(k)
    return -1


def meet_event(model: System, chunk: RowChunk, state: EventState, visible: Visible) -> int:
    """Take the events at which a step has ended; return `MET` to go on, `DONE` where one ends the run."""
    code = int(take_notes(abi.MET, 0, model, chunk, state))
    visible.numbers[UNMET] = 0
    if code == abi.DONE:
        visible.numbers[ENDING] = ending_event(chunk, visible, state.clock[abi.TIME])
    return code


def advance_to_output(
    model: System,
    scheme: TableauRecord,
    span: Span,
    chunk: RowChunk,
    state: EventState,
    outputs: KeptOutput,
    visible: Visible,
) -> int:
    """Make steps up to an output or to the end of a span; return the code of the loop's end, `DONE` at the output."""
    system, observers = model[0], model[1]
    control, clock, until = state.control, state.clock, outputs.times[0]
    code, near = abi.MET, abi.RESOLVED_TIME * abs(until) if ADAPTIVE else abi.SAME_TIME * span.step
    if visible.numbers[UNMET] != 0:
        code = meet_event(model, chunk, state, visible)
    if code == abi.MET and visible.numbers[CHANGED] != 0:
        return_before_seams(system, state)
        code = begin_at_seams(model, span, state) if control[abi.BEGUN] == 0 else begin_choice(model, span, state)
        code = abi.MET if code == abi.DONE else code
    visible.numbers[CHANGED] = 0
    while code < abi.DONE:
        ahead = 1.0 if until - clock[abi.TIME] > near else 0.0
        part = steps_until(span, span.until, control[abi.STEPS] + ahead, span.duration)
        if ADAPTIVE:  # outputs are read from steps that are over
            control[abi.OUTPUTS] = 1
        code = integrate(system, scheme, part, state, outputs)
        if ADAPTIVE:
            control[abi.OUTPUTS] = read_step(system_of_steps(system), scheme, state, outputs) if code <= abi.DONE else 0
        if code == abi.CHOOSE:
            follow_rows(chunk, state, state.w)
        elif code == abi.CHANGED:
            code = take_change(model, part, state)
        elif code == abi.NOTED:
            take_notes(code, 0, model, chunk, state)
        elif code == abi.MET and control[abi.OUTPUTS] > 0 and until < clock[abi.TIME] - near:
            visible.numbers[UNMET] = 1
        elif code == abi.MET:
            control[abi.OUTPUTS] = 0  # the state shown is that after events
            code = meet_event(model, chunk, state, visible)
        if code < abi.DONE and clock[abi.TIME] >= until - near:
            code = abi.DONE
    if code == abi.DONE and control[abi.OUTPUTS] == 0:
        show_state(observers[0], state.w, outputs, 0, state.y)
    return int(code)


def advance_run(
    through: int,
    model: System,
    scheme: TableauRecord,
    span: Span,
    chunk: RowChunk,
    state: EventState,
    outputs: KeptOutput,
    visible: Visible,
) -> int:
    """Take a run on to the end of `span`, and show its state there.

    Parameters
    ----------
    through : int
        1 where the run may go on to the end of a step after that time, as runs with outputs do; 0 where a step ends.
    model : tuple
        First argument of the loop, sizes and functions of the model, and after these `OfModes` where rows have
        bounds, else `OfEffects` where events change a run.
    scheme : record
        The scheme.
    span : Span
        Steps; its end is the time to reach.
    chunk : RowChunk
        The run as a row: the places of its events, and what rows are chosen with.
    state : State
        State of the run, with the data of events where it has any.
    outputs, visible : KeptOutput, Visible
        What is shown, and what the caller sees and may have changed.

    Returns
    -------
    int
        `REACHED`, `ENDED` or `FAILED`; where a run ends, it shows the last state from which it can go on.
    """
    observers = model[1]
    control, clock, numbers, until = state.control, state.clock, visible.numbers, span.until
    duration = visible.clock[END_TIME] if ADAPTIVE else span.duration
    last = max(until, visible.clock[END_TIME]) if ADAPTIVE else math.inf
    endless = steps_until(span, last if through != 0 else until, math.inf, duration)
    if control[abi.BEGUN] == 0:
        assume_step(model, endless)
    if return_to_shown(until, scheme, visible, state, outputs) == 1:
        let_go(model, state)  # what rests need not rest in another state
    outputs.times[0], control[abi.OUTPUTS], numbers[ENDING] = until, 0, -1
    code = abi.DONE
    if not ADAPTIVE or read_step(system_of_steps(model[0]), scheme, state, outputs) == 0:
        code = advance_to_output(model, scheme, endless, chunk, state, outputs, visible)
    if not ADAPTIVE and code > abi.DONE and control[abi.OUTPUTS] > 0 and through != 0:
        # the step past the output fails: the run goes on up to the output
        control[abi.OUTPUTS] = 0
        code = advance_to_output(
            model, scheme, steps_until(span, until, math.inf, duration), chunk, state, outputs, visible
        )
    if code > abi.DONE:
        code = int(take_notes(code, 0, model, chunk, state))
    numbers[END_CODE] = code
    ended = code != abi.DONE or numbers[ENDING] >= 0
    if ended:
        show_state(observers[0], state.w, outputs, 0, state.y)
        outputs.times[0] = clock[abi.TIME]
    for i in range(visible.y.shape[0]):
        visible.y[i] = outputs.states[i]
    visible.clock[SHOWN_TIME] = outputs.times[0]
    return FAILED if code != abi.DONE else ENDED if ended else REACHED
