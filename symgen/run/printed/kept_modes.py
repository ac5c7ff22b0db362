"""Transitions of rows with bounds in runs that are kept between calls: the latest ones, for whoever asks.

They are written where modes are chosen and gaps strike, as in runs of a sweep (`symgen.run.rows.row_modes`).
"""

from __future__ import annotations

from typing import Any

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.native import types
from symgen.run.layout import abi
from symgen.run.layout.start_records import record_type
from symgen.run.modes.bounded_rows import SIGN, first_step, is_held, put_off, stays_shut
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

_A, _K = types.float64[::1], types.int64[::1]

#: What a row with bounds does at a transition: rest ends, rest begins, its rate changes sign, an impact, the row comes
#: into force, it is off again.
SLIP, STICK, REVERSE, HIT, REST, LEAVE = range(6)
#: Transitions that are kept, the latest ones.
OF_LOG = 64

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


def forget_rows(model: Any, state: Any) -> None:
    """Forget modes, impacts and transitions of the run before."""
    forget_modes(model, state)
    _, _, modes = model
    modes.transitions.count[0] = 0


def let_rows_go(model: Any, state: Any) -> None:
    """Take all rows out of force, and keep which gaps are closed."""
    _, _, modes = model
    put_off(modes.choice, state.w)


def assume_first_step(model: Any, span: Any) -> None:
    """Set the step that laws assume before the first one."""
    _, _, modes = model
    modes.choice.step[0] = first_step(span)


#: Meanings of names in `symgen.run.printed.kept_run` where rows have bounds, where gaps strike, and between seams.
OF_ROWS: dict[str, Any] = {
    **{"forget": forget_rows, "begin_choice": begin_modes, "take_notes": take_modes},
    **{"assume_step": assume_first_step, "choose_here": choose_and_log, "let_go": let_rows_go},
}
OF_GAPS: dict[str, Any] = {"meet_impacts": strike_and_log}
OF_ROWS_BETWEEN_SEAMS: dict[str, Any] = {
    **{"begin_at_seams": begin_modes_between_seams, "take_change": choose_after_change}
}
