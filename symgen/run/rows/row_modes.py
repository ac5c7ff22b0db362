"""Bounded rows in runs of a sweep: modes are chosen at starts and at their events, without Python.

These are the choice (`symgen.run.modes.choice`) and the impacts of single runs, so that rows have their bits.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.bare import bare
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.native import types
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.start_records import record_type
from symgen.run.loops import search_records as records
from symgen.run.loops.event_loop import notes_at
from symgen.run.loops.seams import change, due, go_over, has_gap, has_struck, is_defined, same
from symgen.run.loops.watch import remember_rank
from symgen.run.modes.bounded_rows import CHOICE, DEEP, OTHERS, OUT_OF_RANGE, SAME, TOUCHING, put_off
from symgen.run.modes.choice import begin_afresh, choose_modes, follow_modes, measure_margins, read_rows
from symgen.run.modes.strikes import STRIKES, find_struck, forget_passed, gather, strike
from symgen.run.rows.row_events import OF_EFFECTS, forget_past, take_effects, take_notes_of_events

#: Rows with bounds of all runs, and working memory.
#: - choice: See `symgen.run.modes.bounded_rows`.
#: - strikes, effects: Impacts at gaps, and what other events change; they share working memory and past.
#: - choosing (shape (functions,)): 1 for functions at which modes are chosen.
#: - breaks, reverses, jams, leaves (shapes (functions,)): Row that breaks loose, whose rate becomes zero, whose effort
#:   jams, or whose force becomes zero, at each function; else -1.
OF_MODES = record_type(
    "OfModes",
    __name__,
    ("choice", CHOICE),
    ("strikes", STRIKES),
    ("effects", OF_EFFECTS),
    ("choosing breaks reverses jams leaves", types.int64[::1]),
)
OfModes: Any = OF_MODES.constructor


def meet_impacts(t: float, modes: Any, state: Any) -> int:
    """Return `DONE`: a run without gaps has no impacts."""
    return int(abi.DONE)


def strike_gaps(t: float, modes: Any, state: Any) -> int:
    """Apply the impact of gaps that strike at the present state; return `DONE`, or `NO_MODES`."""
    c, control = modes.choice, state.control
    code = find_struck(t, c, state.y, state.p, state.w, state.iw, control)
    if code == SAME:
        return int(abi.DONE)
    if code != OTHERS:
        return int(e.NO_MODES)
    if strike(t, c, modes.strikes, state.y, state.p, state.w) != SAME:
        return int(e.NO_MODES)
    if control[abi.BEGUN] == 0:  # the balance of energies begins behind an impact at the start
        state.y[c.layout.nq + c.layout.nv] = 0.0
    else:
        control[abi.BEGUN], control[abi.KNOWN], control[abi.POINTS], control[abi.REFUSED] = abi.AFRESH, 0, 0, 0
        state.clock[abi.ALLOWED] = 0.0
    if read_rows(t, c, state.y, state.p, state.w) != SAME:
        return int(e.NO_MODES)
    forget_passed(c, state.w)
    return int(abi.DONE)


def forget_modes(model: Any, state: Any) -> None:
    """Clear the data of switching functions, past resets and impacts of the run before."""
    system, observers, modes = model
    forget_past((system, observers, modes.effects), state)
    for i in range(modes.strikes.series.shape[0]):
        modes.strikes.series[i] = 0.0


def gather_impacts(t: float, modes: Any, state: Any) -> int:
    """Return `SAME`: a run without gaps has no impacts that accumulate."""
    return SAME


def rest_gaps(t: float, modes: Any, state: Any) -> int:
    """Bring gaps to rest whose impacts accumulate; return `OTHERS` where any are, else `SAME`, or another code."""
    c = modes.choice
    code = gather(t, c, modes.strikes, state.y, state.p, state.w, state.iw, state.hunt)
    if code == OTHERS and read_rows(t, c, state.y, state.p, state.w) != SAME:
        code = OUT_OF_RANGE
    return int(code)


@called
def choose_here(model: Any, state: Any) -> int:
    """Choose modes at the present state; return `DONE`, or `NO_MODES`."""
    _, _, modes = model
    c, t = modes.choice, state.clock[abi.TIME]
    if read_rows(t, c, state.y, state.p, state.w) != SAME or meet_impacts(t, modes, state) != abi.DONE:
        return int(e.NO_MODES)
    if taken_modes(model, state) != abi.DONE:
        return int(e.NO_MODES)
    code = gather_impacts(t, modes, state)
    if code == OTHERS:
        for i in range(c.count):
            c.broken[i] = c.stopped[i] = c.left[i] = 0
        return int(taken_modes(model, state))
    return int(abi.DONE) if code == SAME else int(e.NO_MODES)


def taken_modes(model: Any, state: Any) -> int:
    """Choose modes at a state whose rows have been read, and have the run go on in them."""
    _, observers, modes = model
    c, t = modes.choice, state.clock[abi.TIME]
    code = choose_modes(t, c, state.y, state.p, state.w, state.iw, state.control)
    if code > OTHERS:
        return int(e.NO_MODES)
    measure_margins(c, state.w, state.hunt)
    if code == OTHERS:
        follow_modes(t, c, state.y, state.p, state.w)
        remember_rank(observers[0], state)
        begin_afresh(state)
    elif state.control[abi.BEGUN] == 1:  # margins sleep anew
        state.control[abi.BEGUN] = abi.ONWARD
    return int(abi.DONE)


def begin_modes(model: Any, span: Any, state: Any) -> int:
    """Choose modes where a run begins; return `DONE`, or `NO_MODES`."""
    c = model[2].choice
    for i in range(c.count):
        c.broken[i] = c.stopped[i] = c.left[i] = 0
        c.shut[i] = 0 if state.control[abi.BEGUN] == 0 else c.shut[i]
    c.depth[0] = TOUCHING if state.control[abi.BEGUN] == 0 else DEEP
    return int(choose_here(model, state))


def begin_modes_between_seams(model: Any, span: Any, state: Any) -> int:
    """Choose modes where a run begins, with the values of inputs there; return `DONE` or the code of an end."""
    system, _, _ = model
    _, seams, _, prepare, prepare_law = system
    seams = bare(seams)
    control, p, changed = state.control, state.p, False
    while due(seams, control[abi.PASSED]) - state.clock[abi.TIME] <= same(seams, span, state.clock[abi.TIME]):
        changed = change(seams, control[abi.PASSED], p) or changed
        if has_gap(seams, control[abi.PASSED]):
            go_over(seams, control[abi.PASSED], state.clock)
        control[abi.PASSED] += 1
    if changed:
        prepare(p)
        prepare_law(p)
        if not is_defined(p):
            return int(e.IMPOSSIBLE)
    return begin_modes(model, span, state)


def choose_after_change(model: Any, span: Any, state: Any) -> int:
    """Choose modes where inputs have changed; return `CHANGED` to go on, or the code of an end."""
    system, _, modes = model
    now, seams = state.clock[abi.TIME], bare(system[1])
    if has_struck(seams, state.control[abi.PASSED] - 1):
        put_off(modes.choice, state.w)
    code = begin_modes(model, span, state)
    if code == abi.DONE and span.until - now > same(seams, span, now):
        code = int(abi.CHANGED)
    return code


def take_others(code: int, r: int, model: Any, chunk: Any, state: Any) -> int:
    """Write the events noted by a run to its row; none of them changes it."""
    system, observers, _ = model
    return int(take_notes_of_events(code, r, (system, observers), chunk, state))


def take_resets(code: int, r: int, model: Any, chunk: Any, state: Any) -> int:
    """Write the events noted by a run to its row, and apply resets with no row in force: gaps strike behind."""
    system, observers, modes = model
    effects, c, hunt, t = modes.effects, modes.choice, state.hunt, state.clock[abi.TIME]
    width = observers[0].width
    first, resets = notes_at(int(hunt[records.COUNT]), width, state.w.shape[0]), False
    for i in range(int(hunt[records.NOTED])):
        at, k = hunt[first + i * (2 + width)], int(hunt[first + i * (2 + width) + 1])
        resets = resets or (code == abi.MET and at == t and k < effects.resets.shape[0] and effects.resets[k] != 0)
    if resets:
        put_off(c, state.w)
    return int(take_effects(code, r, (system, observers, effects), chunk, state))


@called
def take_modes(code: int, r: int, model: Any, chunk: Any, state: Any) -> int:
    """Write the events noted by a run to its row, and choose modes where a bounded row has one.

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
    c.depth[0] = math.inf
    for i in range(int(hunt[records.NOTED])):
        at, k = hunt[first + i * (2 + width)], int(hunt[first + i * (2 + width) + 1])
        if code == abi.MET and at == t and k < modes.breaks.shape[0]:
            any_of_modes = any_of_modes or modes.choosing[k] != 0
            if modes.breaks[k] >= 0:
                c.broken[modes.breaks[k]] = 1
            if modes.reverses[k] >= 0:
                c.stopped[modes.reverses[k]] = 1
            if modes.leaves[k] >= 0:
                c.left[modes.leaves[k]] = 1
            jams = jams or modes.jams[k] >= 0
    ended = take_others(code, r, model, chunk, state)
    if ended == e.IMPOSSIBLE:
        return int(ended)
    if jams or (any_of_modes and choose_here(model, state) != abi.DONE):
        return int(e.NO_MODES)
    return int(ended)
