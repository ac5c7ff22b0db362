"""The record of rows with bounds for the turn of events, and what rows of a run have."""

from __future__ import annotations

from symgen.compile.native.annotations import Integers, Record
from symgen.run.layout.records import Sizes
from symgen.run.modes.row_records import Choice
from symgen.run.modes.strikes import Strikes
from symgen.run.modes.transition_log import Transitions

#: Whether gaps have several pieces, which are one in the log; there are contacts; other motions are sought.
PIECES = CONTACTS = SEEKS = False


class OfModes(Record):
    """Rows with bounds of a run, what its events change, and working memory.

    Attributes
    ----------
    sizes : Sizes
        See `symgen.run.layout.records`.
    choice, strikes : Choice, Strikes
        Modes, and impacts with the effects of all events.
    transitions : Transitions
        The latest ones.
    choosing : Array of int64, shape (events,)
        1 for events at which modes are chosen.
    breaks, reverses, jams, leaves : Array of int64, shapes (events,)
        Row that breaks loose, whose rate becomes zero, whose effort jams, or whose force becomes zero, at each
        event; else -1.
    renewed : Array of int64, shape (1,)
        1 where other redundant rows have been left out since somebody looked.
    """

    sizes: Sizes
    choice: Choice
    strikes: Strikes
    transitions: Transitions
    choosing: Integers
    breaks: Integers
    reverses: Integers
    jams: Integers
    leaves: Integers
    renewed: Integers
