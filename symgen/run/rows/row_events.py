"""Events in rows of a sweep: their notes become numbers of the row, and their effects are applied, without Python."""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.native import types
from symgen.run.effects.accumulation import PAST, accumulation, add_resets, latest_events
from symgen.run.effects.applying import APPLIED, EFFECT_MODEL, EFFECT_WORK, apply_effects
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.start_records import Instant, record_type
from symgen.run.loops import search_records as records
from symgen.run.loops.event_loop import notes_at
from symgen.run.loops.frame_parts import store_behind

_K = types.int64[::1]

#: What events change in runs, and their past.
#: - model, happens: First argument of `apply_effects`; switching functions.
#: - resets, chosen (shape (events,)): 1 for events that change a run; working memory.
#: - work, past: Working memory of effects; past resets of the present run.
OF_EFFECTS = record_type(
    "OfEffects",
    __name__,
    ("model", EFFECT_MODEL),
    ("happens", abi.OBSERVE),
    ("resets chosen", _K),
    ("work", EFFECT_WORK),
    ("past", PAST),
)
OfEffects: Any = OF_EFFECTS.constructor


def forget_functions(model: Any, state: Any) -> None:
    """Clear the sides of switching functions and the notes of the run before."""
    hunt = bare(state).hunt
    n = int(hunt[records.COUNT])
    for i in range(records.N_HEAD + records.SIDE * n, records.N_HEAD + records.N_COLUMNS * n):
        hunt[i] = 0.0
    hunt[records.NOTED] = hunt[records.ACCEPTED] = hunt[records.PASSED] = hunt[records.SINCE] = 0.0
    hunt[records.LONGEST] = hunt[records.DIVIDED] = hunt[records.COARSEST] = 0.0
    if hunt[records.REACH] < math.inf:  # of adaptive steps
        hunt[records.REACH] = 0.0


def numbers_of_row(chunk: Any, state: Any) -> int:
    """Return the count of numbers that a row leaves of events."""
    return int(chunk.events.shape[0] // (chunk.ps.shape[0] // state.p.shape[0]))


def count_of_events(numbers: int) -> int:
    """Return the count of events, from the numbers that a row leaves of them."""
    return int(max(0, numbers - e.HEAD_OF_EVENTS) // e.OF_EVENT)


@called
def take_notes_of_events(code: int, r: int, model: Any, chunk: Any, state: Any) -> int:
    """Write the events noted by a run to its row; return the end code of the run, `DONE` where an event stops it.

    Parameters
    ----------
    code, r : int
        End code of its loop, and the row.
    model, chunk, state
        As for `symgen.run.rows.rows.run_rows`.
    """
    _, observers = model
    width = observers[0].width
    hunt, clock = state.hunt, state.clock
    n, numbers = int(hunt[records.COUNT]), numbers_of_row(chunk, state)
    events = count_of_events(numbers)
    first, row = notes_at(n, width, state.w.shape[0]), part(chunk.events, r * numbers, numbers)
    ended = code
    for i in range(int(hunt[records.NOTED])):
        t, k = hunt[first + i * (2 + width)], int(hunt[first + i * (2 + width) + 1])
        at = e.HEAD_OF_EVENTS + e.OF_EVENT * k
        if k >= events:  # a change of a constraint
            continue
        if row[at] == 0.0:
            row[at + 1] = t
        row[at] += 1.0
        row[at + 2] = t
        if t == clock[abi.TIME] and hunt[records.N_HEAD + records.ACTION * n + k] == float(records.LEAVE):
            ended = abi.DONE
    hunt[records.NOTED] = hunt[records.ACCEPTED] = 0.0
    if code == abi.UNDEFINED:
        for k in range(events):
            g = hunt[records.N_HEAD + records.N_COLUMNS * n + k]
            if not g == g and not row[e.IMPOSSIBLE_EVENT] == row[e.IMPOSSIBLE_EVENT]:
                row[e.IMPOSSIBLE_EVENT] = float(k)
    return ended


def forget_past(model: Any, state: Any) -> None:
    """Clear the data of switching functions, and the past resets of the run before."""
    forget_functions(model, state)
    _, _, effects = model
    past = effects.past
    for k in range(past.counts.shape[0]):
        past.counts[k] = 0


@called
def take_effects(code: int, r: int, model: Any, chunk: Any, state: Any) -> int:
    """Write the events noted by a run to its row, and apply their effects; return the end code of the run.

    Parameters and end code are those of `take_notes_of_events`; `GATHERED` where events accumulate, `IMPOSSIBLE` where
    the joints or other effects do not allow an effect.
    """
    _, observers, effects = model
    hunt, clock, control = state.hunt, state.clock, state.control
    chosen, t, which = effects.chosen, state.clock[abi.TIME], -1
    n, width = int(hunt[records.COUNT]), observers[0].width
    first = notes_at(n, width, state.w.shape[0])
    for k in range(chosen.shape[0]):
        chosen[k] = 0
    for i in range(int(hunt[records.NOTED])):
        at, k = hunt[first + i * (2 + width)], int(hunt[first + i * (2 + width) + 1])
        if code == abi.MET and at == t and k < chosen.shape[0] and effects.resets[k] != 0:
            chosen[k], which = 1, k
    numbers = numbers_of_row(chunk, state)
    row, stops = part(chunk.events, r * numbers, numbers), False
    for i in range(int(hunt[records.NOTED])):
        at, k = hunt[first + i * (2 + width)], int(hunt[first + i * (2 + width) + 1])
        if at == t and k < chosen.shape[0] and effects.resets[k] == 0:
            stops = stops or hunt[records.N_HEAD + records.ACTION * n + k] == float(records.LEAVE)
    ended = take_notes_of_events(code, r, (model[0], observers), chunk, state)
    if which < 0:
        return int(ended)
    now = Instant(state.y, state.p, state.w)
    if apply_effects(effects.model, t, now, chosen, effects.work) != APPLIED:
        row[e.IMPOSSIBLE_EVENT] = float(which)
        return int(e.IMPOSSIBLE)
    control[abi.BEGUN], control[abi.KNOWN], control[abi.POINTS], control[abi.REFUSED] = abi.AFRESH, 0, 0, 0
    clock[abi.ALLOWED] = 0.0
    if stops:
        return int(abi.DONE)
    add_resets(effects.past, chosen, t)
    functions = observers[1], observers[2], effects.happens
    end = accumulation(functions, t, observers[0].nq, now, state.iw, hunt, chosen, effects.past)
    if end == end:
        row[e.ACCUMULATION], row[e.GATHERING] = end, latest_events(effects.past)
        return int(abi.GATHERED)
    return code


def store_after_effects(code: int, span: Any, state: Any, outputs: Any) -> None:
    """Have outputs at the present time hold the state behind the effects of events."""
    if code == abi.MET:
        now = state.clock[abi.TIME]
        adaptive = state.hunt[records.REACH] < math.inf
        near = abi.RESOLVED_TIME * abs(now) if adaptive else abi.SAME_TIME * span.step
        store_behind(outputs, state.control[abi.OUTPUTS], now, near, state.y, state.w)


# -- constraints that may jump -----------------------------------------------------------------------------------------


def resumed_after_examination(state: Any) -> int:
    """Return the end code with which an examined run goes on, `DONE` for a new run."""
    if state.control[e.EXAMINATION] == e.HOLDS:
        return int(abi.MET)
    if state.control[e.EXAMINATION] == e.JUMPS:
        state.control[e.EXAMINATION] = e.NOT_EXAMINED
        return int(abi.JUMPED)
    return int(abi.DONE)


@called
def waits_for_examination(code: int, model: Any, chunk: Any, state: Any) -> bool:
    """Return whether a run has passed a place at which a constraint may jump, which was not yet examined."""
    control, hunt = state.control, state.hunt
    if code != abi.MET:
        return False
    if control[e.EXAMINATION] == e.HOLDS:
        control[e.EXAMINATION] = e.NOT_EXAMINED
        return False
    n, width = int(hunt[records.COUNT]), state.y.shape[0]
    first = notes_at(n, width, state.w.shape[0])
    for i in range(int(hunt[records.NOTED])):
        k = int(hunt[first + i * (2 + width) + 1])
        if hunt[records.N_HEAD + records.ACTION * n + k] == float(records.EXAMINE):
            control[e.EXAMINATION] = e.WAITS
            return True
    return False
