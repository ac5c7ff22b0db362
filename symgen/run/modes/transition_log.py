"""The latest transitions of rows with bounds: what each has done, and when, for whoever asks."""

from __future__ import annotations

import numpy as np

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.effects.pushing import PAIRED
from symgen.run.modes.bounded_rows import SIGN, is_held, is_kept_shut
from symgen.run.modes.paired_rows import is_second
from symgen.run.modes.row_records import FURTHER_PIECE, Choice

#: What a row with bounds does at a transition: rest ends, rest begins, its rate changes sign, an impact, the row comes
#: into force, it is off again.
SLIP, STICK, REVERSE, HIT, REST, LEAVE = range(6)
#: What a gap of a contact does where the row is off again.
LIFT = 6
#: Transitions that are kept, the latest ones.
OF_LOG = 64


class Transitions(Record):
    """The latest transitions.

    Attributes
    ----------
    times, rows, words : Array, Array of int64, shapes (length,)
        When [s], of which row, and what it does; number k is at k % length.
    count : Array of int64, shape (1,)
        Number of transitions of the run so far.
    signs, shut : Array, Array of int64, shapes (rows,)
        Signs of rows, and 1 for closed gaps, before the choice.
    kept : Array of int64, shape (1,)
        1 where these are those from before a change that takes all rows out of force.
    """

    times: Array
    rows: Integers
    words: Integers
    count: Integers
    signs: Array
    shut: Integers
    kept: Integers


def new_transitions(rows: int, length: int = OF_LOG) -> Transitions:
    """Return memory for the latest transitions of some rows with bounds."""
    return Transitions(
        times=np.zeros(length),
        rows=np.zeros(length, dtype=np.int64),
        words=np.zeros(length, dtype=np.int64),
        count=np.zeros(1, dtype=np.int64),
        signs=np.zeros(rows),
        shut=np.zeros(rows, dtype=np.int64),
        kept=np.zeros(1, dtype=np.int64),
    )


@exact(entry=True)
def log_transition(t: float, log: Transitions, row: int, word: int) -> int:
    """Add a transition to the latest ones; return the number of transitions."""
    at = log.count[0] % log.times.shape[0]
    log.times[at], log.rows[at], log.words[at] = t, row, word
    log.count[0] += 1
    return int(log.count[0])


@exact(entry=True)
def remember_modes(c: Choice, w: Array, log: Transitions) -> int:
    """Keep what rows do before a choice; return their number."""
    for i in range(c.rows.count):
        log.signs[i] = w[c.rows.first + MODE_NUMBERS * i + SIGN]
        log.shut[i] = 1 if is_kept_shut(c, w, i) else 0
    return int(c.rows.count)


@exact()
def is_further_piece(c: Choice, i: int) -> bool:
    """Return whether a row is another piece of the gap of the row before it."""
    return bool(c.rows.pushes[i] == FURTHER_PIECE)


@exact()
def is_joined(c: Choice, i: int) -> bool:
    """Return whether a row is one with the row before it in the log: pieces of contacts are not."""
    return bool(is_further_piece(c, i) and c.rows.gaps[i] == 0)


@exact(entry=True)
def is_struck_before(c: Choice, active: Integers, i: int) -> bool:
    """Return whether a piece of the gap of a row that comes before it pushes at an impact."""
    j, found = i, False
    while j > 0 and is_further_piece(c, j):
        j -= 1
        found = found or active[j] != 0
    return found


@exact(entry=True)
def log_changes(t: float, c: Choice, w: Array, log: Transitions) -> int:
    """Log the rows that a choice has changed; return the number of transitions.

    Pieces of a stop are one: closed where any of them is. The row along a gap has transitions as long as it is closed.
    """
    for i in range(c.rows.count):
        sign, past, along = w[c.rows.first + MODE_NUMBERS * i + SIGN], log.signs[i], c.rows.partner[i]
        if PAIRED and along >= 0 and c.rows.pushes[i] == 0:  # a direction that has been renewed is no transition
            first = not is_second(c, i)
            sign, past = 1.0 if sign != 0.0 and first else 0.0, 1.0 if past != 0.0 and first else 0.0
        if c.rows.pushes[i] == 0 and sign != past and (along < 0 or (log.shut[along] != 0 and is_held(c, w, along))):
            log_transition(t, log, i, SLIP if past == 0.0 else STICK if sign == 0.0 else REVERSE)
        closed, before, j = is_held(c, w, i), log.shut[i] != 0, i + 1
        while j < c.rows.count and is_joined(c, j):
            closed, before, j = closed or is_held(c, w, j), before or log.shut[j] != 0, j + 1
        if c.rows.pushes[i] != 0 and not is_joined(c, i) and closed != before:
            opens = LIFT if c.rows.gaps[i] != 0 else LEAVE
            log_transition(t, log, i, opens if before else REST)
    return int(log.count[0])
