"""The turn: what happens where a run begins, at its events and where inputs change, in one source for all targets.

Resets change the state with no row with bounds in force. Rows are read, gaps strike, modes are chosen, and gaps whose
impacts accumulate come to rest. What has changed is logged, and why a run cannot go on is kept. Single runs, rows of
sweeps, C, FMUs and pages call these functions; single runs make sentences of the log.
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.native.annotations import Array, Integers, record_type
from symgen.run.effects.pushing import REACTIONS
from symgen.run.effects.resets import OfEffects, apply_resets, change_nothing, choose_resets, first_note, forget_resets
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.loops import search_records as records
from symgen.run.loops.event_loop import EventState
from symgen.run.loops.unbound import gather_impacts, lay_gaps, meet_impacts
from symgen.run.loops.watch import remember_rank
from symgen.run.modes.bounded_rows import (
    CONTRARY,
    DEEP,
    GAINED,
    IMMOVABLE,
    JAMMED,
    NEGATIVE_GAP,
    NO_BOUNDS,
    NO_CONTACT_MODES,
    NO_RESTITUTION,
    NOT_APPLIED,
    NOTHING_FOUND,
    OTHERS,
    OUT_OF_RANGE,
    SAME,
    SEVERAL_BY_REACTION,
    SEVERAL_MODES,
    SIGN,
    switch_off,
)
from symgen.run.modes.choice import follow_modes, look_anew, measure_margins
from symgen.run.modes.choosing import choose_modes
from symgen.run.modes.ends import find_undefined
from symgen.run.modes.found_rows import (
    allow_depth,
    find_rows,
    forget_breaking,
    forget_found,
    keep_breaking,
)
from symgen.run.modes.reading import find_fault, find_starting, read_rows
from symgen.run.modes.row_records import TOUCHING, Choice
from symgen.run.modes.transition_log import (
    log_changes,
    remember_modes,
)
from symgen.run.modes.turn_records import CONTACTS, SEEKS, OfModes

#: Most digits to the base of 4 that a number has.
MOST_DIGITS = 26


# -- why there are no modes --------------------------------------------------------------------------------------------


def modes_in_digits(c: Choice, of: Integers) -> float:
    """Return the modes of the rows of contacts as the digits of a number to the base of 4, nan for too many."""
    total, power = 0.0 if c.rows.count <= MOST_DIGITS else math.nan, 1.0
    for i in range(c.rows.count):
        total += power * float(of[i])
        power *= 4.0
    return total


def refuse_fault(code: int, which: float, first: float, second: float, modes: OfModes) -> int:
    """Keep why there are no modes, with rows and numbers of the sentence; return `NO_MODES`."""
    ends = modes.strikes.effects.ends
    ends[e.FAILURE], ends[e.WHICH], ends[e.FIRST_NUMBER], ends[e.SECOND_NUMBER] = float(code), which, first, second
    return int(e.NO_MODES)


@called
def refuse_modes(code: int, modes: OfModes, state: EventState) -> int:
    """Keep why there are no modes, and at which rows; return `NO_MODES`."""
    c, first, second = modes.choice, math.nan, math.nan
    code = find_fault(c, state.w) if code == OUT_OF_RANGE else code
    row = int(c.named[0])
    which = float(row)
    if code == JAMMED:
        first = c.jam[0]
    elif code == SEVERAL_BY_REACTION or code == CONTRARY:
        which = c.jam[0]
    elif code == NOT_APPLIED:
        which, power = 0.0, 1.0
        for i in range(c.rows.count):
            which += power if modes.strikes.active[i] != 0 else 0.0
            power *= 2.0
    elif code == NO_RESTITUTION:
        first = c.read.restitution[row]
    elif code == NO_BOUNDS:
        first, second = c.read.static[row], c.read.sliding[row]
    elif code == NEGATIVE_GAP:
        first = c.read.value[row]
    elif code == IMMOVABLE:
        first = c.read.speed[row]
    elif (CONTACTS and (code == NO_CONTACT_MODES or code == NOTHING_FOUND)) or (
        (CONTACTS or REACTIONS) and code == GAINED
    ):
        first = c.jam[0]
    elif CONTACTS and code == SEVERAL_MODES:
        first, second = modes_in_digits(c, c.best), modes_in_digits(c, c.other)
    return refuse_fault(code, which, first, second, modes)


def look_ahead(code: int, modes: OfModes, state: EventState) -> int:
    """Return the code of a run whose step has failed, `NO_MODES` where a formula of a row is no number after it."""
    c, t, step = modes.choice, state.clock[abi.TIME], state.clock[abi.STEP] if code == abi.NOT_FINITE else 0.0
    if find_undefined(t, step, c, state.y, state.p, state.w, state.iw) == SAME:
        return code
    return refuse_modes(OUT_OF_RANGE, modes, state)


# -- modes -------------------------------------------------------------------------------------------------------------


def take_chosen(modes: OfModes, state: EventState) -> int:
    """Choose modes at a state whose rows have been read, and have the run go on in them; return `SAME` or a code."""
    c, t = modes.choice, state.clock[abi.TIME]
    code = choose_modes(t, c, state.y, state.p, state.w, state.iw, state.control)
    if SEEKS and c.unsought[0] > 0:
        modes.strikes.effects.ends[e.UNSOUGHT] = float(c.unsought[0])
    if code > OTHERS:
        return int(code)
    for i in range(c.rows.count):
        sign = c.after[MODE_NUMBERS * i + SIGN]
        if sign != 0.0 and sign != c.before[MODE_NUMBERS * i + SIGN]:
            keep_breaking(c, i, t)
    measure_margins(c, state.w, state.hunt)
    if code == OTHERS:
        if follow_modes(t, c, state.y, state.p, state.w) != 0:
            modes.renewed[0] = 1
        remember_rank(modes.sizes, state)
        look_anew(state)
    elif state.control[abi.BEGUN] == 1:  # margins sleep anew
        state.control[abi.BEGUN] = abi.ONWARD
    return SAME


@called
def choose_here(modes: OfModes, state: EventState) -> int:
    """Choose modes at the present state, with its impacts, and log what changes; return `DONE` or `NO_MODES`."""
    c, t = modes.choice, state.clock[abi.TIME]
    if modes.transitions.kept[0] == 0:
        remember_modes(c, state.w, modes.transitions)
    modes.transitions.kept[0] = 0
    starts = state.control[abi.BEGUN] == 0 and state.control[abi.STEPS] == 0
    code = read_rows(t, c, state.y, state.p, state.w)
    if code == SAME:
        find_starting(t, c, state.w)
        code = meet_impacts(t, modes, state)
    if code == SAME:
        code = take_chosen(modes, state)
    if code == SAME:
        code = gather_impacts(t, modes, state)
        if code == OTHERS:
            forget_found(c, False)
            find_starting(t, c, state.w)
            code = take_chosen(modes, state)
    if code != SAME:
        return int(refuse_modes(code, modes, state))
    if starts:
        lay_gaps(t, modes, state)
    else:  # a start has modes, and no change of them
        log_changes(t, c, state.w, modes.transitions)
    return int(abi.DONE)


def begin_modes(modes: OfModes, state: EventState) -> int:
    """Choose modes where a run begins, or something has changed; return `DONE` or `NO_MODES`."""
    c = modes.choice
    forget_found(c, True)
    for i in range(c.rows.count):
        c.shut[i] = 0 if state.control[abi.BEGUN] == 0 else c.shut[i]
    allow_depth(c, TOUCHING if state.control[abi.BEGUN] == 0 else DEEP)
    return int(choose_here(modes, state))


def open_rows_of(modes: OfModes, state: EventState) -> None:
    """Take all rows out of force, where closed gaps may strike, and keep which gaps are closed, and what slides."""
    remember_modes(modes.choice, state.w, modes.transitions)
    modes.transitions.kept[0] = 1
    switch_off(modes.choice, state.w)


def forget_modes(modes: OfModes) -> None:
    """Forget impacts, transitions and resets of the run before."""
    forget_resets(modes.strikes.effects)
    if SEEKS:
        modes.choice.unsought[0] = 0
    for i in range(modes.strikes.series.shape[0]):
        modes.strikes.series[i] = 0.0
    modes.transitions.count[0] = modes.transitions.kept[0] = 0
    forget_breaking(modes.choice)


# -- the turn ----------------------------------------------------------------------------------------------------------


def is_sliding(c: Choice, w: Array, i: int) -> bool:
    """Return whether a coordinate slides."""
    return bool(w[c.rows.first + MODE_NUMBERS * i + SIGN] != 0.0)


@called
def take_turn(code: int, modes: OfModes, state: EventState) -> int:
    """Do what happens at the events noted by a loop: resets, then impacts and modes.

    Parameters
    ----------
    code : int
        End code of the loop; nothing happens but where it is `MET`, and where a step has failed.
    modes : OfModes
        Rows with bounds.
    state : State
        State of the run.

    Returns
    -------
    int
        `MET` to go on, or the code of the end of the run: `DONE` where an event ends it, `GATHERED` where resets
        accumulate, `IMPOSSIBLE` where one cannot be, `NO_MODES` where modes are not determined.
    """
    if code == abi.TINY_STEP or code == abi.NOT_FINITE:
        return look_ahead(code, modes, state)
    if code != abi.MET:
        return code
    c, effects, hunt, t = modes.choice, modes.strikes.effects, state.hunt, state.clock[abi.TIME]
    first, size, chooses, jammed = first_note(state), 2 + state.y.shape[0], False, -1
    forget_found(c, False)
    allow_depth(c, math.inf)  # positions inside a run are what its steps have made of them
    for i in range(int(hunt[records.NOTED])):
        at, k = hunt[first + i * size], int(hunt[first + i * size + 1])
        if at == t and k < modes.breaks.shape[0]:
            chooses = chooses or modes.choosing[k] != 0
            stops = modes.reverses[k]
            if stops >= 0 and not is_sliding(c, state.w, stops):  # others begin to move; a drive moves what rests
                stops = stops if CONTACTS and c.rows.partner[stops] >= 0 else -1
            find_rows(c, modes.breaks[k], stops, modes.leaves[k])
            jammed = modes.jams[k] if modes.jams[k] >= 0 and jammed < 0 else jammed
    last = choose_resets(effects, state)
    if last >= 0:  # rows with two bounds have no impulse, and gaps strike after the reset
        open_rows_of(modes, state)
    ended = change_state(last, effects, state)
    if ended == e.IMPOSSIBLE:
        return int(ended)
    if CONTACTS and jammed >= 0 and c.rows.pressed[jammed] == 0:
        return int(refuse_fault(NO_CONTACT_MODES, float(jammed), 0.0, math.nan, modes))
    if jammed >= 0:
        return int(refuse_fault(JAMMED, float(jammed), 1.0, math.nan, modes))
    if chooses and choose_here(modes, state) != abi.DONE:
        return int(e.NO_MODES)
    return int(ended)


@called
def take_resets(code: int, effects: OfEffects, state: EventState) -> int:
    """Do what happens at the events of a run without rows with bounds; parameters and result as of `take_turn`."""
    if code != abi.MET:
        return code
    return int(apply_resets(choose_resets(effects, state), effects, state))


def change_state(last: int, effects: OfEffects, state: EventState) -> int:
    """Return whether events end a run that no event changes, see `change_nothing`."""
    return int(change_nothing(last, effects, state))


#: Type of what follows the functions of a model, where events change a run, and where rows have bounds.
FURTHER = {"effects": record_type(OfEffects), "modes": record_type(OfModes)}
