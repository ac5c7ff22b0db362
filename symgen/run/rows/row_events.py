"""Events in rows of a sweep: what happens there is the turn of all runs, and its notes become numbers of the row."""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.native.annotations import Array
from symgen.run.effects.resets import OfEffects, first_note, forget_resets
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import Observers, Outputs, RowChunk, Span, System
from symgen.run.loops import search_records as records
from symgen.run.loops.event_loop import EventState
from symgen.run.loops.frame_parts import store_after_reset
from symgen.run.loops.seams import due_time, has_gap, has_struck, is_defined, skip_to_seam, time_tolerance, write_seam
from symgen.run.loops.unbound import keep_ends
from symgen.run.modes.turn import begin_modes, forget_modes, open_rows_of, take_resets, take_turn
from symgen.run.modes.turn_records import OfModes

#: What a loop over rows takes first where events change runs, or rows have bounds: the first argument of the loop over
#: one run, the observers, and the effects or the rows.
ModelWithEffects = tuple[System, Observers, OfEffects]
ModelWithModes = tuple[System, Observers, OfModes]


def forget_functions(model: System, state: EventState) -> None:
    """Clear the sides of switching functions and the notes of the run before."""
    hunt = bare(state).hunt
    n = int(hunt[records.COUNT])
    for i in range(records.N_HEAD + records.SIDE * n, records.N_HEAD + records.N_COLUMNS * n):
        hunt[i] = 0.0
    hunt[records.NOTED] = hunt[records.ACCEPTED] = hunt[records.PASSED] = hunt[records.SINCE] = 0.0
    hunt[records.LONGEST] = hunt[records.DIVIDED] = hunt[records.COARSEST] = 0.0
    if hunt[records.REACH] < math.inf:  # of adaptive steps
        hunt[records.REACH] = 0.0


def forget_past(model: ModelWithEffects, state: EventState) -> None:
    """Clear the data of switching functions, and the past resets of the run before."""
    forget_functions(model, state)
    forget_resets(model[2])


def forget_past_modes(model: ModelWithModes, state: EventState) -> None:
    """Clear the data of switching functions, past resets, impacts and transitions of the run before."""
    forget_functions(model, state)
    forget_modes(model[2])


def numbers_of_row(chunk: RowChunk, state: EventState) -> int:
    """Return the count of numbers that a row leaves of events."""
    return int(chunk.events.shape[0] // (chunk.ps.shape[0] // state.p.shape[0]))


def count_of_events(numbers: int) -> int:
    """Return the count of events, from the numbers that a row leaves of them."""
    return int(max(0, numbers - e.HEAD_OF_EVENTS) // e.OF_EVENT)


# -- what happens ------------------------------------------------------------------------------------------------------


def happen(code: int, model: System, state: EventState) -> int:
    """Return `DONE` where an event ends a run that no event changes, else the code."""
    hunt, t, stops = state.hunt, state.clock[abi.TIME], False
    first, size, n = first_note(state), 2 + state.y.shape[0], int(hunt[records.COUNT])
    for i in range(int(hunt[records.NOTED])):
        at, k = hunt[first + i * size], int(hunt[first + i * size + 1])
        leaves = k < n and hunt[records.N_HEAD + records.ACTION * n + k] == float(records.LEAVE)
        stops = stops or (at == t and leaves)
    return int(abi.DONE) if stops and code == abi.MET else code


def happen_with_resets(code: int, model: ModelWithEffects, state: EventState) -> int:
    """Do what happens at events that change a run; see `take_resets`."""
    return int(take_resets(code, model[2], state))


def happen_with_modes(code: int, model: ModelWithModes, state: EventState) -> int:
    """Do what happens at events where rows have bounds; see `take_turn`."""
    return int(take_turn(code, model[2], state))


def keep_ends_of_resets(model: ModelWithEffects, count: int, row: Array) -> None:
    """Write why events have ended a run to the first numbers of its row."""
    for i in range(count):
        row[i] = model[2].ends[i]


def keep_ends_of_modes(model: ModelWithModes, count: int, row: Array) -> None:
    """Write why events, or modes, have ended a run to the first numbers of its row."""
    for i in range(count):
        row[i] = model[2].strikes.effects.ends[i]


@called
def take_notes_of_events(code: int, r: int, model: System, chunk: RowChunk, state: EventState) -> int:
    """Do what happens at the events noted by a run, and write them to its row.

    Parameters
    ----------
    code, r : int
        End code of its loop, and the row.
    model, chunk, state
        As for `symgen.run.rows.rows.run_rows`.

    Returns
    -------
    int
        End code of the run: `MET` to go on, `DONE` where an event ends it, or another one, see `take_turn`.
    """
    hunt, n, numbers = state.hunt, int(state.hunt[records.COUNT]), numbers_of_row(chunk, state)
    events, first, size = count_of_events(numbers), first_note(state), 2 + state.y.shape[0]
    row = part(chunk.events, r * numbers, numbers)
    ended = happen(code, model, state)
    keep_ends(model, e.HEAD_OF_EVENTS if numbers > 0 else 0, row)
    for i in range(int(hunt[records.NOTED])):
        t, k = hunt[first + i * size], int(hunt[first + i * size + 1])
        at = e.HEAD_OF_EVENTS + e.OF_EVENT * k
        if k >= events:  # a change of a constraint, or of a mode
            continue
        if row[at] == 0.0:
            row[at + 1] = t
        row[at] += 1.0
        row[at + 2] = t
    hunt[records.NOTED] = hunt[records.ACCEPTED] = 0.0
    if code == abi.UNDEFINED:
        for k in range(n if numbers > 0 else 0):
            g = hunt[records.N_HEAD + records.N_COLUMNS * n + k]
            if not g == g and not row[e.IMPOSSIBLE_EVENT] == row[e.IMPOSSIBLE_EVENT]:
                row[e.IMPOSSIBLE_EVENT] = float(k)
    return int(ended)


# -- modes -------------------------------------------------------------------------------------------------------------


def begin_row_in_modes(model: ModelWithModes, span: Span, state: EventState) -> int:
    """Choose modes where a run begins; return `DONE`, or `NO_MODES`."""
    return int(begin_modes(model[2], state))


def begin_row_between_seams(model: ModelWithModes, span: Span, state: EventState) -> int:
    """Choose modes where a run begins, with the values of inputs there; return `DONE` or the code of an end."""
    system, _, _ = model
    _, seams, _, prepare, prepare_law = system
    seams = bare(seams)
    control, p, changed = state.control, state.p, False
    while due_time(seams, control[abi.PASSED]) - state.clock[abi.TIME] <= time_tolerance(
        seams, span, state.clock[abi.TIME]
    ):
        changed = write_seam(seams, control[abi.PASSED], p) or changed
        if has_gap(seams, control[abi.PASSED]):
            skip_to_seam(seams, control[abi.PASSED], state.clock)
        control[abi.PASSED] += 1
    if changed:
        prepare(p)
        prepare_law(p)
        if not is_defined(p):
            return int(e.IMPOSSIBLE)
    return begin_row_in_modes(model, span, state)


def choose_after_change(model: ModelWithModes, span: Span, state: EventState) -> int:
    """Choose modes where inputs have changed; return `CHANGED` to go on, or the code of an end."""
    system, _, modes = model
    now, seams = state.clock[abi.TIME], bare(system[1])
    if has_struck(seams, state.control[abi.PASSED] - 1):
        open_rows_of(modes, state)
    code = begin_row_in_modes(model, span, state)
    if code == abi.DONE and span.until - now > time_tolerance(seams, span, now):
        code = int(abi.CHANGED)
    return code


def store_after_effects(code: int, span: Span, state: EventState, outputs: Outputs) -> None:
    """Have outputs at the present time hold the state after the effects of events."""
    if code == abi.MET:
        now = state.clock[abi.TIME]
        adaptive = state.hunt[records.REACH] < math.inf
        near = abi.RESOLVED_TIME * abs(now) if adaptive else abi.SAME_TIME * span.step
        store_after_reset(outputs, state.control[abi.OUTPUTS], now, near, state.y, state.w)


# -- constraints that may jump -----------------------------------------------------------------------------------------


def resume_code_after_examination(state: EventState) -> int:
    """Return the end code with which an examined run goes on, `DONE` for a new run."""
    if state.control[e.EXAMINATION] == e.HOLDS:
        return int(abi.MET)
    if state.control[e.EXAMINATION] == e.JUMPS:
        state.control[e.EXAMINATION] = e.NOT_EXAMINED
        return int(abi.JUMPED)
    return int(abi.DONE)


@called
def waits_for_examination(code: int, model: System, chunk: RowChunk, state: EventState) -> bool:
    """Return whether a run has passed a place at which a constraint may jump, which was not yet examined."""
    control, hunt = state.control, state.hunt
    if code != abi.MET:
        return False
    if control[e.EXAMINATION] == e.HOLDS:
        control[e.EXAMINATION] = e.NOT_EXAMINED
        return False
    n, first, size = int(hunt[records.COUNT]), first_note(state), 2 + state.y.shape[0]
    for i in range(int(hunt[records.NOTED])):
        k = int(hunt[first + i * size + 1])
        if hunt[records.N_HEAD + records.ACTION * n + k] == float(records.EXAMINE):
            control[e.EXAMINATION] = e.WAITS
            return True
    return False
