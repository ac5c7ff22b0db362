"""Dry friction in rows of a sweep: modes are chosen at starts and at their events, without Python.

It is the choice of single runs (`symgen.runs.choice`), so that rows have their bits.
"""

from __future__ import annotations

from typing import Any

from symgen.layout import abi
from symgen.layout import ensemble_abi as e
from symgen.layout.start_records import record_type
from symgen.loopcode.bare import bare
from symgen.loopcode.loop_instances import called
from symgen.loops import search_records as records
from symgen.loops.event_loop import notes_at
from symgen.loops.stopping import change, due, is_defined, same
from symgen.loops.watch import remember_rank
from symgen.native import types
from symgen.rows.row_events import take_notes_of_events
from symgen.runs.bounded_rows import CHOICE, OTHERS, SAME
from symgen.runs.choice import begin_afresh, choose_modes, follow_modes, read_rows

#: Rows with bounds of all runs, and working memory.
#: - choice: See `symgen.runs.bounded_rows`.
#: - breaks, stops, jams (shapes (functions,)): Row that breaks loose, whose rate becomes zero, or whose friction jams,
#:   at each function; else -1.
OF_MODES = record_type("OfModes", __name__, ("choice", CHOICE), ("breaks stops jams", types.int64[::1]))
OfModes: Any = OF_MODES.constructor


@called
def chosen(model: Any, state: Any) -> int:
    """Choose modes at the present state; return `DONE`, or `NO_MODES`."""
    _, observers, modes = model
    c, t = modes.choice, state.clock[abi.TIME]
    if read_rows(t, c, state.y, state.p, state.w) != SAME:
        return int(e.NO_MODES)
    code = choose_modes(t, c, state.y, state.p, state.w, state.iw, state.control)
    if code > OTHERS:
        return int(e.NO_MODES)
    if code == OTHERS:
        follow_modes(t, c, state.y, state.p, state.w)
        remember_rank(observers[0], state)
        begin_afresh(state)
    return int(abi.DONE)


def begin_modes(model: Any, span: Any, state: Any) -> int:
    """Choose modes where a run begins; return `DONE`, or `NO_MODES`."""
    c = model[2].choice
    for i in range(c.count):
        c.broken[i] = c.stopped[i] = c.left[i] = 0
    return int(chosen(model, state))


def begin_modes_between_stops(model: Any, span: Any, state: Any) -> int:
    """Choose modes where a run begins, with the values of inputs there; return `DONE` or the code of an end."""
    system, _, _ = model
    _, stops, _, prepare, prepare_law = system
    stops = bare(stops)
    control, p, changed = state.control, state.p, False
    while due(stops, control[abi.PASSED]) - state.clock[abi.TIME] <= same(stops, span, state.clock[abi.TIME]):
        changed = change(stops, control[abi.PASSED], p) or changed
        control[abi.PASSED] += 1
    if changed:
        prepare(p)
        prepare_law(p)
        if not is_defined(p):
            return int(e.IMPOSSIBLE)
    return begin_modes(model, span, state)


def choose_after_change(model: Any, span: Any, state: Any) -> int:
    """Choose modes where inputs have changed; return `CHANGED` to go on, or the code of an end."""
    system, _, _ = model
    code, now, stops = begin_modes(model, span, state), state.clock[abi.TIME], bare(system[1])
    if code == abi.DONE and span.until - now > same(stops, span, now):
        code = int(abi.CHANGED)
    return code


@called
def take_modes(code: int, r: int, model: Any, chunk: Any, state: Any) -> int:
    """Write the events noted by a run to its row, and choose modes where friction or a stop has one.

    Parameters
    ----------
    code, r, model, chunk, state
        As for `take_notes_of_events`; the model has modes besides.

    Returns
    -------
    int
        Its end code, or `NO_MODES` where no modes are consistent.
    """
    _, observers, modes = model
    hunt, c, t, any_of_modes, jams = state.hunt, modes.choice, state.clock[abi.TIME], False, False
    width = observers[0].width
    first = notes_at(int(hunt[records.COUNT]), width, state.w.shape[0])
    for i in range(c.count):
        c.broken[i] = c.stopped[i] = c.left[i] = 0
    for i in range(int(hunt[records.NOTED])):
        at, k = hunt[first + i * (2 + width)], int(hunt[first + i * (2 + width) + 1])
        if code == abi.MET and at == t and k < modes.breaks.shape[0]:
            if modes.breaks[k] >= 0:
                c.broken[modes.breaks[k]], any_of_modes = 1, True
            if modes.stops[k] >= 0:
                c.stopped[modes.stops[k]], any_of_modes = 1, True
            jams = jams or modes.jams[k] >= 0
    ended = take_notes_of_events(code, r, (model[0], observers), chunk, state)
    if jams or (any_of_modes and chosen(model, state) != abi.DONE):
        return int(e.NO_MODES)
    return int(ended)
