"""Impacts in the turn of events: gaps that strike, at corners as well, and those that come to rest."""

from __future__ import annotations

from symgen.run.effects.resets import first_note
from symgen.run.layout import abi
from symgen.run.layout.start_records import Instant
from symgen.run.loops import search_records as records
from symgen.run.loops.afresh import begin_afresh
from symgen.run.loops.event_loop import EventState
from symgen.run.loops.unbound import keep_after, keep_before
from symgen.run.modes.bounded_rows import OTHERS, OUT_OF_RANGE, SAME, TWO_PIECES
from symgen.run.modes.corners import begin_at_corners, find_both_pieces, has_corners, pass_corners, spare_touching
from symgen.run.modes.flights import mark_flights
from symgen.run.modes.found_rows import forget_passed
from symgen.run.modes.placing import put_gaps
from symgen.run.modes.reading import read_rows
from symgen.run.modes.strikes import find_struck, gather, strike
from symgen.run.modes.transition_log import HIT, is_struck_before, log_transition
from symgen.run.modes.turn_records import PIECES, OfModes


def find_flying(t: float, modes: OfModes, state: EventState) -> None:
    """Find the gaps that fly at the events noted, of which theirs is none."""
    mark_flights(t, modes.choice, modes.strikes, state.w)
    first, size = first_note(state), 2 + state.y.shape[0]
    for note in range(int(state.hunt[records.NOTED])):
        at, k = state.hunt[first + note * size], int(state.hunt[first + note * size + 1])
        for i in range(modes.choice.rows.count):
            if at == t and modes.strikes.events[i] == k:
                modes.choice.flying[i] = 0


def strike_gaps(t: float, modes: OfModes, state: EventState) -> int:
    """Apply the impact of gaps that strike at the present state, and log them; return `SAME`, or why there is none."""
    c, s, control = modes.choice, modes.strikes, state.control
    find_flying(t, modes, state)
    code = find_struck(t, c, state.y, state.p, state.w, state.iw, control)
    if code != OTHERS:
        return int(code)
    keep_before(s.struck, state.y)
    code = strike(t, c, s, state.y, state.p, state.w)
    if code != SAME:
        return int(code)
    keep_after(s.struck, Instant(state.y, state.p, state.w), c.rows.layout.nq, s.effects.work)
    if control[abi.BEGUN] == 0:  # the balance of energies begins after an impact at the start
        state.y[c.rows.layout.nq + c.rows.layout.nv] = 0.0
    else:
        begin_afresh(state)
    for i in range(c.rows.count):
        if s.active[i] != 0 and not (PIECES and is_struck_before(c, s.active, i)):
            log_transition(t, modes.transitions, i, HIT)
    if read_rows(t, c, state.y, state.p, state.w) != SAME:
        return OUT_OF_RANGE
    forget_passed(c, state.w)
    return SAME


def strike_past_corners(t: float, modes: OfModes, state: EventState) -> int:
    """Take the state past the corners of gaps before which a step has ended, and do what `strike_gaps` does."""
    c, passed = modes.choice, 0
    if not has_corners(state.hunt):
        return int(strike_gaps(t, modes, state))
    if state.control[abi.BEGUN] == 0:
        passed = begin_at_corners(t, c, modes.strikes, state.y, state.p, state.w, state.iw, state.hunt)
    elif state.hunt[records.NOTED] > 0.0:  # other choices are at no event
        passed = pass_corners(t, c, modes.strikes, state.y, state.p, state.w, state.iw, state.hunt)
    if passed > 0 and read_rows(t, c, state.y, state.p, state.w) != SAME:
        return OUT_OF_RANGE
    if passed == 0 and state.control[abi.BEGUN] != 0:
        spare_touching(t, c, state.y, state.p, state.w, state.iw)
    code = int(strike_gaps(t, modes, state))
    if code == SAME and passed > 0 and find_both_pieces(t, c, modes.strikes, state.y, state.p, state.w, state.hunt) > 0:
        code = TWO_PIECES
    return code


def rest_gaps(t: float, modes: OfModes, state: EventState) -> int:
    """Bring gaps to rest whose impacts accumulate; return `OTHERS` where any are, else `SAME`, or another code."""
    c, s = modes.choice, modes.strikes
    keep_before(s.rested, state.y)
    code = gather(t, c, s, state.y, state.p, state.w, state.iw, state.hunt)
    if code == OTHERS:
        keep_after(s.rested, Instant(state.y, state.p, state.w), c.rows.layout.nq, s.effects.work)
        if read_rows(t, c, state.y, state.p, state.w) != SAME:
            code = OUT_OF_RANGE
    return int(code)


def put_gaps_to_zero(t: float, modes: OfModes, state: EventState) -> int:
    """Put the gaps that are closed at a start to 0; return their number."""
    return int(put_gaps(t, modes.choice, state.y, state.p, state.w, state.iw))
