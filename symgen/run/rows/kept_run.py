"""One run that is kept between calls, with its modes, impacts and events, for programs without Python.

The loop is the frame of all runs (`symgen.run.loops.frame`), so that steps, events and modes are those of single runs.
An output between two steps shortens none of them: what is shown is the state at the time asked for, and the run itself
may stand at the end of the step behind it. Where a caller changes what is shown, the run goes on from there.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.loop_instances import called, compiled_loop
from symgen.compile.native import types
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import CHUNK, SPAN, Span
from symgen.run.layout.start_records import record_type
from symgen.run.loops import frame
from symgen.run.loops.event_loop import EVENT_STATE, MEANINGS
from symgen.run.loops.seams import SEAMS, between_seams, due
from symgen.run.rows.row_modes import (
    OF_MODES,
    OfModes,
    begin_modes,
    begin_modes_between_seams,
    choose_after_change,
    forget_modes,
    strike_gaps,
    take_modes,
)
from symgen.run.rows.row_modes import choose_here as choose_at_state
from symgen.run.rows.rows import MODES, OBSERVERS, PRESSED, STRIKING, begin_run, follow_rows
from symgen.run.single.bounded_rows import SIGN, is_held, stays_shut

_F, _A, _K = types.float64, types.float64[::1], types.int64[::1]

#: Results of `advance_run`: the time is reached; an event ends the run; no step, or no modes, lead on.
REACHED, ENDED, FAILED = range(3)
#: What a row with bounds does at a transition: rest ends, rest begins, its rate changes sign, an impact, the row comes
#: into force, it is off again.
SLIP, STICK, REVERSE, HIT, REST, LEAVE = range(6)
#: Transitions that are kept, the latest ones.
OF_LOG = 64
#: Place of the time that is shown [s]; then those of the code of the end of the run, of the number of the event that
#: ends it, -1 for none, of 1 where the events at which the run stands have not been met yet, and of 1 where the caller
#: has changed something.
SHOWN_TIME = 0
END_CODE, ENDING, STANDS, CHANGED = range(4)

#: The latest transitions.
#: - times, rows, words (shapes (OF_LOG,)): When [s], of which row, and what it does; number k is at k % OF_LOG.
#: - count (shape (1,)): Number of transitions of the run so far.
#: - signs, shut (shapes (rows,)): Signs of rows, and 1 for closed gaps, before the choice.
TRANSITIONS = record_type("Transitions", __name__, ("times", _A), ("rows words count", _K), ("signs", _A), ("shut", _K))
Transitions: Any = TRANSITIONS.constructor
#: `OF_MODES`, with the latest transitions.
KEPT_MODES = record_type(
    "KeptModes", __name__, *zip(OfModes._fields, OF_MODES.parts, strict=True), ("transitions", TRANSITIONS)
)
KeptModes: Any = KEPT_MODES.constructor
#: The output of a call: its time, the state, and the status with modes behind it.
KEPT_OUTPUT = record_type("KeptOutput", __name__, ("times states status", _A))
KeptOutput: Any = KEPT_OUTPUT.constructor
#: What a caller sees and may change, and what ends runs.
#: - y, clock (shapes (ny,), (1,)): State and time [s].
#: - numbers (shape (4,)): See above.
#: - ends (shape (events,)): 1 for events that end the run.
VISIBLE = record_type("Visible", __name__, ("y clock", _A), ("numbers ends", _K))
Visible: Any = VISIBLE.constructor


# -- transitions -------------------------------------------------------------------------------------------------------


def log_transition(t: float, log: Any, row: int, word: int) -> None:
    """Add a transition to the latest ones."""
    at = log.count[0] % OF_LOG
    log.times[at], log.rows[at], log.words[at] = t, row, word
    log.count[0] += 1


def strike_and_log(t: float, modes: Any, state: Any) -> int:
    """Apply the impact of gaps as `strike_gaps` does, and log the rows that push."""
    code = strike_gaps(t, modes, state)
    if modes.strikes.pushing[0] > 0:  # until their accumulation has been asked for
        for i in range(modes.choice.count):
            if modes.strikes.active[i] != 0:
                log_transition(t, modes.transitions, i, HIT)
    return int(code)


@called
def choose_and_log(model: Any, state: Any) -> int:
    """Choose modes as `choose_here` does, and log the rows that change; a start has modes, and no change of them."""
    _, _, modes = model
    c, w, log = modes.choice, state.w, modes.transitions
    for i in range(c.count):
        log.signs[i] = w[c.first + MODE_NUMBERS * i + SIGN]
        log.shut[i] = 1 if stays_shut(c, w, i) else 0
    starts = state.control[abi.BEGUN] == 0 and state.control[abi.STEPS] == 0
    code = choose_at_state(model, state)
    for i in range(0 if starts or code != abi.DONE else c.count):
        sign, before, now = w[c.first + MODE_NUMBERS * i + SIGN], log.signs[i], state.clock[abi.TIME]
        if c.pushes[i] == 0 and sign != before:
            log_transition(now, log, i, SLIP if before == 0.0 else STICK if sign == 0.0 else REVERSE)
        if c.pushes[i] != 0 and (1 if is_held(c, w, i) else 0) != log.shut[i]:
            log_transition(now, log, i, LEAVE if log.shut[i] != 0 else REST)
    return int(code)


# -- outputs -----------------------------------------------------------------------------------------------------------


def show(sizes: Any, w: Any, outputs: Any, k: int, y: Any) -> None:
    """Write the only output: the state, the measures of ``accept``, angles with counted turns and modes of rows."""
    for i in range(sizes.ny):
        outputs.states[i] = y[i]
    for i in range(abi.N_STATUS):
        outputs.status[i] = w[i]
    for i in range(abi.N_STATUS, outputs.status.shape[0]):
        outputs.status[i] = w[abi.WINDING - abi.N_STATUS + i]


def return_to_shown(until: float, visible: Any, state: Any, outputs: Any) -> None:
    """Have the run go on from what is shown, where the caller has changed it, or the run stands behind a time [s]."""
    control, clock, ny, same = state.control, state.clock, visible.y.shape[0], True
    for i in range(ny):
        same = same and visible.y[i] == outputs.states[i]
    same = same and visible.clock[SHOWN_TIME] == outputs.times[0] and until >= clock[abi.TIME]
    if control[abi.BEGUN] != 0 and same and visible.numbers[CHANGED] == 0:
        return
    for i in range(ny):
        state.y[i] = visible.y[i]
    if control[abi.BEGUN] == 0 or clock[abi.TIME] != visible.clock[SHOWN_TIME]:
        for i in range(abi.N_STATUS, outputs.status.shape[0] if control[abi.BEGUN] != 0 else 0):
            state.w[abi.WINDING - abi.N_STATUS + i] = outputs.status[i]
        clock[abi.TIME] = clock[abi.ORIGIN] = state.gauges[abi.LAST_TIME] = visible.clock[SHOWN_TIME]
        control[abi.INDEX] = 0
    visible.numbers[STANDS], visible.numbers[CHANGED] = 0, 1
    control[abi.BEGUN] = abi.AFRESH if control[abi.BEGUN] != 0 else 0


# -- seams -------------------------------------------------------------------------------------------------------------


def begin_at_seams(model: Any, span: Any, state: Any) -> int:
    """Choose modes where a run without seams begins; return `DONE` or the code of an end."""
    return int(begin_modes(model, span, state))


def return_before_seams(system: Any, state: Any) -> None:
    """Do nothing: a run without seams has passed none."""


def take_change(model: Any, span: Any, state: Any) -> int:
    """Return the end code of a run without seams, whose inputs no seam changes."""
    return int(abi.UNPREPARED)


def forget_later_seams(system: Any, state: Any) -> None:
    """Forget that seams behind the present time have been passed."""
    _, seams, _, _, _ = system
    while state.control[abi.PASSED] > 0 and due(seams, state.control[abi.PASSED] - 1) > state.clock[abi.TIME]:
        state.control[abi.PASSED] -= 1


# -- the run -----------------------------------------------------------------------------------------------------------


def start_run(model: Any, limits: Any, chunk: Any, state: Any, visible: Any) -> int:
    """Forget the run before: what is shown is the start of another one.

    Parameters
    ----------
    model, chunk, state, visible
        As for `advance_run`.
    limits : Array
        As in a `RowChunk`.
    """
    _, _, modes = model
    begin_run(state, limits)
    forget_modes(model, state)
    modes.transitions.count[0] = 0
    for i in range(chunk.events.shape[0]):
        counts = i >= e.HEAD_OF_EVENTS and (i - e.HEAD_OF_EVENTS) % e.OF_EVENT == 0
        chunk.events[i] = 0.0 if counts else math.nan
    visible.clock[SHOWN_TIME] = 0.0
    visible.numbers[END_CODE], visible.numbers[ENDING], visible.numbers[STANDS] = abi.DONE, -1, 0
    visible.numbers[CHANGED] = 1
    return 0


def steps_until(span: Any, until: float, pause: float) -> Any:
    """Return a span to a time [s], or to a number of steps."""
    return Span(
        *(span.step, span.largest, until, span.end, span.duration, span.rtol, span.atol, span.relative),
        *(span.safety, span.most, pause, span.turn),
    )


def ending_event(chunk: Any, visible: Any, t: float) -> int:
    """Return the number of the event that ends the run at a time, -1 for none."""
    for k in range(visible.ends.shape[0]):
        at = e.HEAD_OF_EVENTS + e.OF_EVENT * k
        if visible.ends[k] != 0 and chunk.events[at] > 0.0 and chunk.events[at + 2] == t:
            return int(k)
    return -1


def meet(model: Any, chunk: Any, state: Any, visible: Any) -> int:
    """Take the events at which a step has ended; return `MET` to go on, `DONE` where one ends the run."""
    code = int(take_modes(abi.MET, 0, model, chunk, state))
    visible.numbers[STANDS] = 0
    if code == abi.DONE:
        visible.numbers[ENDING] = ending_event(chunk, visible, state.clock[abi.TIME])
    return code


def go_on(model: Any, scheme: Any, span: Any, chunk: Any, state: Any, outputs: Any, visible: Any) -> int:
    """Make steps up to an output or to the end of a span; return the code of the loop's end, `DONE` at the output."""
    system, observers, _ = model
    control, clock, until = state.control, state.clock, outputs.times[0]
    code, near = abi.MET, abi.SAME_TIME * span.step
    if visible.numbers[STANDS] != 0:
        code = meet(model, chunk, state, visible)
    if code == abi.MET and visible.numbers[CHANGED] != 0:
        return_before_seams(system, state)
        code = begin_at_seams(model, span, state) if control[abi.BEGUN] == 0 else begin_modes(model, span, state)
        code = abi.MET if code == abi.DONE else code
    visible.numbers[CHANGED] = 0
    while code < abi.DONE:
        ahead = 1.0 if until - clock[abi.TIME] > near else 0.0
        part = steps_until(span, span.until, control[abi.STEPS] + ahead)
        code = integrate(system, scheme, part, state, outputs)
        if code == abi.CHOOSE:
            follow_rows(chunk, state, state.w)
        elif code == abi.CHANGED:
            code = take_change(model, part, state)
        elif code == abi.NOTED:
            take_modes(code, 0, model, chunk, state)
        elif code == abi.MET and control[abi.OUTPUTS] > 0 and until < clock[abi.TIME] - near:
            visible.numbers[STANDS] = 1
        elif code == abi.MET:
            control[abi.OUTPUTS] = 0  # what is shown is the state behind events
            code = meet(model, chunk, state, visible)
        if code < abi.DONE and clock[abi.TIME] >= until - near:
            code = abi.DONE
    if code == abi.DONE and control[abi.OUTPUTS] == 0:
        show(observers[0], state.w, outputs, 0, state.y)
    return int(code)


def advance_run(
    through: int, model: Any, scheme: Any, span: Any, chunk: Any, state: Any, outputs: Any, visible: Any
) -> int:
    """Take a run on to the end of `span`, and show its state there.

    Parameters
    ----------
    through : int
        1 where the run may go on to the end of a step behind that time, as runs with outputs do; 0 where a step ends.
    model : tuple
        First argument of the loop, sizes and functions of the model, and `KEPT_MODES`.
    scheme : record
        The scheme.
    span : Span
        Steps; its end is the time to reach.
    chunk : RowChunk
        The run as a row: the places of its events, and what rows are chosen with.
    state : EventState
        State of the run.
    outputs, visible : KeptOutput, Visible
        What is shown, and what the caller sees and may have changed.

    Returns
    -------
    int
        `REACHED`, `ENDED` or `FAILED`; where a run ends, what is shown is the last state from which it goes on.
    """
    _, observers, modes = model
    control, clock, numbers, until = state.control, state.clock, visible.numbers, span.until
    if control[abi.BEGUN] == 0 and span.step > 0.0:
        modes.choice.step[0] = span.step
    return_to_shown(until, visible, state, outputs)
    outputs.times[0], control[abi.OUTPUTS], numbers[ENDING] = until, 0, -1
    endless = steps_until(span, math.inf if through != 0 else until, math.inf)
    code = go_on(model, scheme, endless, chunk, state, outputs, visible)
    if code > abi.DONE and control[abi.OUTPUTS] > 0 and through != 0:
        # the step behind the output fails: the run goes on up to the output
        control[abi.OUTPUTS] = 0
        code = go_on(model, scheme, steps_until(span, until, math.inf), chunk, state, outputs, visible)
    numbers[END_CODE] = code
    ended = code != abi.DONE or numbers[ENDING] >= 0
    if ended:
        show(observers[0], state.w, outputs, 0, state.y)
        outputs.times[0] = clock[abi.TIME]
    for i in range(visible.y.shape[0]):
        visible.y[i] = outputs.states[i]
    visible.clock[SHOWN_TIME] = outputs.times[0]
    return FAILED if code != abi.DONE else ENDED if ended else REACHED


def integrate(*arguments: Any) -> int:
    """Mark the place of the loop, which `kept_run` inserts: it is never called."""
    raise NotImplementedError


_loops: dict[Any, KeptLoops] = {}
_SEAMED = {
    **{"begin_at_seams": begin_modes_between_seams, "return_before_seams": forget_later_seams},
    **{"take_change": choose_after_change, "integrate": between_seams},
}


class KeptLoops(NamedTuple):
    """Compiled functions of runs with modes that are kept between calls.

    Attributes
    ----------
    start, advance : compiled functions
        `start_run` and `advance_run`.
    steps : compiled loop or None
        The loop between two seams, where a run has any: `advance` calls it by its address.
    """

    start: Any
    advance: Any
    steps: Any


def kept_run(loop: Any, impacts: bool, pressed: bool, seams: bool) -> KeptLoops:
    """Return the functions around the loop of a scheme, made at the first use.

    Parameters
    ----------
    loop : compiled loop
        From `symgen.run.loops.frame.loop`.
    impacts, pressed, seams : bool
        Whether events change velocities or gaps strike; whether bounds depend on reactions; whether formulas jump or
        have kinks over time.
    """
    key = loop, impacts, pressed, seams
    if key not in _loops:
        name, meanings, steps, model = recipe_of(*key)
        scheme, kinds = frame.RECIPES[loop][0][2], (CHUNK, EVENT_STATE, KEPT_OUTPUT, VISIBLE)
        start = types.int64(model, _A, CHUNK, EVENT_STATE, VISIBLE)
        advance = types.int64(types.int64, model, scheme, SPAN, *kinds)
        _loops[key] = KeptLoops(
            compiled_loop(__name__, f"{name}_start", start_run, start, **meanings),
            compiled_loop(__name__, f"{name}_advance", advance_run, advance, **meanings),
            steps,
        )
    return _loops[key]


def recipe_of(loop: Any, impacts: bool, pressed: bool, seams: bool) -> tuple[str, dict[str, Any], Any, types.Kind]:
    """Return a name of functions around the loop of a scheme, meanings of names, the loop between seams and the model.

    Parameters are those of `kept_run`.
    """
    (module, own, scheme, *functions), meanings = frame.RECIPES[loop]
    meanings = {**meanings, **MEANINGS, "store": show, "_MAX_PASSAGES": 1}
    system = types.RecordType((*frame.kinds_of(functions), abi.OBSERVE, abi.DECIDE, abi.RHS))
    steps, name = None, f"{module.rpartition('.')[2]}_{own}"
    if seams:
        signature = types.int64(system, scheme, SPAN, EVENT_STATE, KEPT_OUTPUT)
        steps = compiled_loop(__name__, f"{name}_steps", frame.integrate, signature, **meanings)
        system = types.RecordType((system, SEAMS, types.FunctionType(signature), e.PREPARE, e.PREPARE))
    name += "_striking" * impacts + "_pressed" * pressed + "_seamed" * seams
    meanings |= {**MODES, **(STRIKING if impacts else {}), **(PRESSED if pressed else {})}
    meanings |= {"choose_here": choose_and_log, **(_SEAMED if seams else {"integrate": frame.integrate})}
    meanings |= {"meet_impacts": strike_and_log} if impacts else {}
    return name, meanings, steps, types.RecordType((system, OBSERVERS, KEPT_MODES))
