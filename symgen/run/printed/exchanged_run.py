"""One run with modes whose steps an importer makes, as model exchange of FMUs has it.

The importer integrates in the modes of the run and looks at switching functions for itself. At its steps and events the
run takes the state from it: the search for events, the choice of modes, impacts, accumulation and resets are those of
runs that make their own steps (`symgen.run.printed.kept_run`).
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import Meanings, called, compiled_loop
from symgen.compile.loopcode.vectors import copied
from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Record, record_type
from symgen.compile.store.jit import RuntimeFunction
from symgen.run.layout import abi
from symgen.run.layout.records import CHUNK, SPAN, EventRun, RowChunk, Span, System
from symgen.run.loops import search_records as records
from symgen.run.loops.event_loop import (
    EVENT_STATE,
    EventState,
    EventSystem,
    decide_event,
    evaluate_events,
    open_event_run,
)
from symgen.run.loops.frame_parts import DOUBT, FAIL, LOOK, TAKE, correct
from symgen.run.loops.seams import due_time, has_gap, has_struck, is_defined, skip_to_seam, time_tolerance, write_seam
from symgen.run.loops.switching import is_sought, taken_for
from symgen.run.loops.unbound import (
    forget_rests,
    next_rest,
    next_time,
    note_rests,
    pass_seams,
    prepare_search,
    rest_lost_gaps,
    system_of_steps,
)
from symgen.run.modes.bounded_rows import OTHERS, OUT_OF_RANGE, SAME, switch_off
from symgen.run.modes.found_rows import allow_depth
from symgen.run.modes.reading import read_rows
from symgen.run.modes.turn_impacts import rest_gaps
from symgen.run.modes.turn_records import OfModes
from symgen.run.printed.kept_loops import Traits, recipe_of
from symgen.run.printed.kept_run import CHANGED, ENDING, VISIBLE, Visible, meet_event
from symgen.run.printed.lost_flights import (
    end_flights,
    end_flights_by_reactions,
    end_flights_in_pairs,
    end_flights_that_rub,
    end_lost_flights,
    end_lost_flights_by_reactions,
    end_lost_flights_in_pairs,
    end_lost_flights_that_rub,
)
from symgen.run.rows.row_events import ModelWithModes, begin_row_in_modes

_F, _A, _K = types.float64, types.float64[::1], types.int64

#: What an importer asks for: its state is the end of a step; an event is to be handled; the motion goes on from a state
#: that the rows in force have been imposed on; nothing, but the times.
COMPLETE, HANDLE, GO_ON, ASK = range(4)
#: Answers: nothing has happened; something has; an event ends the run; the motion cannot go on.
QUIET, HAPPENED, OVER, STUCK = range(4)
#: Places of times: that of the next jump or kink of formulas, or of a rest; the one after a jump, from which formulas
#: are evaluated; then, for each row, the time at which the flights of its gap end, which has come to rest before.
NEXT, AFTER, RESTS = range(3)

#: Values of functions below this part of their size are 0 for an importer that has located that; a margin that sleeps
#: has fallen to 0 at this part of what lifts it; and the least value.
_NEAR, _FALLEN, _TINY = 2.0**-36, 0.25, 1e-300


class Exchange(Record):
    """Times for an importer [s]."""

    times: Array


EXCHANGE = record_type(Exchange)


# -- seams -------------------------------------------------------------------------------------------------------------


def next_seam(model: System, state: EventState) -> float:
    """Return the time of the next seam [s]."""
    _, seams, _, _, _ = model
    return float(due_time(seams, state.control[abi.PASSED]))


@called
def pass_due_seams(model: ModelWithModes, span: Span, state: EventState) -> int:
    """Pass the seams that are due; return `HAPPENED` where modes have to be chosen after them, or `STUCK`."""
    system, _, modes = model
    _, seams, _, prepare, prepare_law = system
    control, clock, p, changed, skipped = state.control, state.clock, state.p, False, False
    while due_time(seams, control[abi.PASSED]) - clock[abi.TIME] <= time_tolerance(seams, span, clock[abi.TIME]):
        changed = write_seam(seams, control[abi.PASSED], p) or changed
        if has_gap(seams, control[abi.PASSED]):
            skip_to_seam(seams, control[abi.PASSED], clock)
            skipped = True
            if has_struck(seams, control[abi.PASSED] + 1):
                switch_off(modes.choice, state.w)
        control[abi.PASSED] += 1
    if changed:
        prepare(p)
        prepare_law(p)
        if not is_defined(p):
            return STUCK
    return HAPPENED if changed or skipped else QUIET


# -- rests -------------------------------------------------------------------------------------------------------------


def forget_rests_of_gaps(modes: OfModes, times: Array, is_begun: bool) -> None:
    """Forget which gaps have just come to rest; and where a run begins, all of them."""
    left = modes.strikes.left
    for i in range(left.shape[0]):
        left[i] = math.nan
        times[RESTS + i] = times[RESTS + i] if is_begun else 0.0


def rest_gaps_in_flight(t: float, modes: OfModes, state: EventState) -> int:
    """Bring gaps to rest that an importer finds at 0 on the way up; return `OTHERS` where any are, or another code."""
    c = modes.choice
    allow_depth(c, math.inf)
    code = read_rows(t, c, state.y, state.p, state.w)
    if code == SAME:
        code = end_lost_flights(t, c, modes.strikes, state.y, state.p, state.w, state.iw)
    return int(code)


def note_rests_of_gaps(t: float, modes: OfModes, times: Array) -> None:
    """Note when the flights end of gaps that have just come to rest."""
    left = modes.strikes.left
    for i in range(left.shape[0]):
        times[RESTS + i] = t + left[i] if left[i] > 0.0 else times[RESTS + i]


def next_rest_of_gaps(t: float, modes: OfModes, times: Array) -> float:
    """Return the first time after `t` at which flights end that have been left out; else infinity."""
    first = math.inf
    for i in range(modes.strikes.left.shape[0]):
        if t < times[RESTS + i] < first:
            first = times[RESTS + i]
    return first


# -- the run -----------------------------------------------------------------------------------------------------------


@called
def indicate_run(t: float, y: Array, model: ModelWithModes, state: EventState, values: Array) -> int:
    """Write the switching functions at a state, counted as the search for events counts them; return their number.

    They pass 0 at events alone: a margin that its mode makes positive, whatever rounding makes of it, is positive.
    """
    system = EventSystem(*system_of_steps(model[0]))
    run = open_event_run(system.sizes, state)
    hunt, n, h = run.hunt, int(run.hunt[records.COUNT]), max(t - run.clock[abi.TIME], 0.0)
    evaluate_events(system, run, t, y)
    for k in range(n):
        value = taken_for(hunt, n, k, h)
        values[k] = 1.0 if value == math.inf else value  # rest has no rate that could pass 0
    return n


def pass_rounding(hunt: Array, n: int) -> None:
    """Have functions that are about to pass 0, and are 0 up to rounding, pass it here.

    An importer that has located an event is on either side of it, up to rounding. A margin that sleeps passes 0 where
    it has lost what lifts it.
    """
    at, out = records.N_HEAD, records.N_HEAD + records.N_COLUMNS * n
    for k in range(n):
        margin, side = hunt[at + records.MARGIN * n + k] != 0.0, hunt[at + records.LOCAL * n + k]
        size = hunt[at + records.MEASURE * n + k] if margin else hunt[at + records.SIZE * n + k]
        asleep, g = hunt[at + records.ASLEEP * n + k], hunt[out + k]
        if asleep > 0.0:
            near = asleep < math.inf and g + asleep < _FALLEN * asleep
        elif hunt[at + records.OF_FORCES * n + k] != 0.0:  # whose slope is not that of forces
            near = abs(g) <= _NEAR * size and side * (g - hunt[at + records.G_START * n + k]) <= 0.0
        else:
            near = abs(g) <= _NEAR * size and side * hunt[out + n + k] < 0.0
        near = near and size < math.inf and hunt[at + records.ACTION * n + k] < float(records.ANEW)
        if near and is_sought(hunt[at + records.DIRECTION * n + k], side, -side) == 1:
            hunt[at + records.ASLEEP * n + k] = 0.0
            hunt[out + k] = -side * _TINY


@called
def look_at_events(system: EventSystem, run: EventRun, t: float) -> int:
    """Note the events between the last state and this one; return `QUIET`, `HAPPENED` or `STUCK`."""
    hunt, n, h = run.hunt, int(run.hunt[records.COUNT]), max(t - run.clock[abi.TIME], 0.0)
    m = records.N_VALUES * n
    out = part(hunt, records.N_HEAD + records.N_COLUMNS * n, m)
    kept = part(hunt, records.N_HEAD + records.AT_END * n, m)
    copied(system.sizes.width, run.y, run.trial)
    correct(system, run, t, run.trial, False)  # measures; the importer's state stays as it is
    evaluate_events(system, run, t, run.y)
    for j in range(m):
        kept[j] = out[j]
    hunt[records.NOTED] = hunt[records.ACCEPTED] = hunt[records.INSIDE] = 0.0
    code = decide_event(system, run, t, h, DOUBT, run.y)
    for j in range(m):
        out[j] = kept[j]
    pass_rounding(hunt, n)
    hunt[records.NOTED], hunt[records.DOING] = 0.0, float(records.TO_EVENT)
    code = decide_event(system, run, t, h, TAKE, run.y)
    run.clock[abi.TIME] = t
    if code == FAIL:
        return STUCK
    return HAPPENED if hunt[records.NOTED] > 0.0 else QUIET


@called
def handle_event(
    t: float,
    system: EventSystem,
    run: EventRun,
    model: ModelWithModes,
    span: Span,
    chunk: RowChunk,
    state: EventState,
    visible: Visible,
) -> int:
    """Handle the event at which an importer has stopped: modes, impacts, resets, seams; return as `exchange_run`."""
    _, _, modes = model
    control, numbers, code = state.control, visible.numbers, QUIET
    known = run.clock[abi.TIME] == t and run.hunt[records.NOTED] > 0.0
    if not known and numbers[CHANGED] == 0:
        code = look_at_events(system, run, t)
    elif not known:  # a jump of inputs leads to a choice, to no passage
        copied(system.sizes.width, run.y, run.trial)
        correct(system, run, t, run.trial, False)
        run.clock[abi.TIME], run.hunt[records.NOTED] = t, 0.0
    if code == STUCK:
        return STUCK
    if run.hunt[records.NOTED] > 0.0:
        ended = meet_event(model, chunk, state, visible)
        if ended == abi.DONE:
            return OVER
        if ended != abi.MET:
            return STUCK
        code = HAPPENED
    passed, lost = pass_seams(model, span, state), SAME
    if code == QUIET:
        lost = rest_lost_gaps(t, modes, state)
    if passed == STUCK or not (lost == SAME or lost == OTHERS):
        return STUCK
    if passed == HAPPENED or numbers[CHANGED] != 0 or lost == OTHERS:
        control[abi.BEGUN] = abi.AFRESH
        if begin_row_in_modes(model, span, state) != abi.DONE:
            return STUCK
        code = HAPPENED
    return int(code)


def exchange_run(
    doing: int,
    t: float,
    model: ModelWithModes,
    span: Span,
    chunk: RowChunk,
    state: EventState,
    visible: Visible,
    exchange: Exchange,
) -> int:
    """Take the state of an importer, and do what it asks for.

    Parameters
    ----------
    doing : int
        `COMPLETE`, `HANDLE`, `GO_ON` or `ASK`.
    t : float
        Time of the importer [s].
    model, span, chunk, state, visible
        As for `symgen.run.printed.kept_run.advance_run`; the visible state is the importer's, which events change.
    exchange : Exchange
        Times, written.

    Returns
    -------
    int
        `QUIET`, `HAPPENED`, `OVER` or `STUCK`.
    """
    system = EventSystem(*system_of_steps(model[0]))
    run, code = open_event_run(system.sizes, state), QUIET
    _, _, modes = model
    if doing != ASK:
        for i in range(visible.y.shape[0]):
            state.y[i] = visible.y[i]
    now = min(t, next_time(model[0], state))  # an importer at a jump comes from before it
    if doing == COMPLETE:
        code = look_at_events(system, run, now)
    elif doing == HANDLE:
        visible.numbers[ENDING] = -1
        forget_rests(modes, exchange.times, True)
        code = handle_event(now, system, run, model, span, chunk, state, visible)
        note_rests(now, modes, exchange.times)
        visible.numbers[CHANGED] = 0
        for i in range(visible.y.shape[0]):
            visible.y[i] = state.y[i]
    elif doing == GO_ON and run.control[abi.BEGUN] != 1:
        code = STUCK if prepare_search(system, run, LOOK) == FAIL else QUIET
        run.control[abi.BEGUN] = 1
    elif doing == ASK:
        forget_rests(modes, exchange.times, False)
    following, rest = next_time(model[0], state), next_rest(t, modes, exchange.times)
    exchange.times[NEXT] = following if following < rest else rest
    exchange.times[AFTER] = run.clock[abi.TIME] if run.clock[abi.TIME] > t else 0.0
    return int(code)


def rest_low_gaps(t: float, modes: OfModes, state: EventState) -> int:
    """Bring gaps to rest as `rest_gaps` does, and where an importer's tolerance loses their flights."""
    c, count = modes.choice, modes.strikes.pushing[0]
    code = rest_gaps(t, modes, state)
    if code == SAME:
        if count > 0:
            code = end_flights(t, c, modes.strikes, state.y, state.p, state.w, state.iw)
        else:
            code = end_lost_flights(t, c, modes.strikes, state.y, state.p, state.w, state.iw)
        if code == OTHERS and read_rows(t, c, state.y, state.p, state.w) != SAME:
            code = OUT_OF_RANGE
    return int(code)


_loops: dict[Any, tuple[Any, Any]] = {}
_RESTING = Meanings(
    "FMUs for model exchange with gaps",
    gather_impacts=rest_low_gaps,
    forget_rests=forget_rests_of_gaps,
    note_rests=note_rests_of_gaps,
    next_rest=next_rest_of_gaps,
    rest_lost_gaps=rest_gaps_in_flight,
)
_SEAMED = Meanings("FMUs for model exchange with seams", next_time=next_seam, pass_seams=pass_due_seams)
_CORNERED = Meanings("FMUs for model exchange with corners of gaps", CORNERS=True)
_TOUCHED = Meanings(
    "FMUs for model exchange with contacts",
    end_flights=end_flights_that_rub,
    end_lost_flights=end_lost_flights_that_rub,
)
_REACTING = Meanings(
    "FMUs for model exchange with gaps beside bounds that depend on reactions",
    end_flights=end_flights_by_reactions,
    end_lost_flights=end_lost_flights_by_reactions,
)
_PAIRED = Meanings(
    "FMUs for model exchange with slip of contacts in space",
    end_flights=end_flights_in_pairs,
    end_lost_flights=end_lost_flights_in_pairs,
)
_TURNING = {"corners": _CORNERED, "contacts": _TOUCHED, "reactions": _REACTING, "paired": _PAIRED}


def exchanged_run(loop: RuntimeFunction, traits: Traits) -> tuple[Any, Any]:
    """Return `indicate_run` and `exchange_run` for a scheme, made at the first use; parameters as for `kept_loops`."""
    key = loop, traits
    if key not in _loops:
        name, meanings, _, model = recipe_of(loop, traits)
        meanings |= _RESTING if traits.effects else {}
        meanings |= _SEAMED if traits.seams else {}
        for kind in traits.turning:
            meanings |= _TURNING.get(kind, {})
        indicate = types.int64(_F, _A, model, EVENT_STATE, _A)
        exchange = types.int64(_K, _F, model, SPAN, CHUNK, EVENT_STATE, VISIBLE, EXCHANGE)
        _loops[key] = (
            compiled_loop(__name__, f"{name}_indicate", indicate_run, indicate, **meanings),
            compiled_loop(__name__, f"{name}_exchange", exchange_run, exchange, **meanings),
        )
    return _loops[key]
