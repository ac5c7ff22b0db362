"""Long lists of cases that prove the same of many mechanisms: a share of them in a turn, and all of them on request."""

import os
import zlib
from collections.abc import Iterable
from typing import TypeVar

Case = TypeVar("Case")

#: Names the turn for all workers of a session: a number, 0 unless given, or `all`.
TURN = "SYMGEN_TEST_TURN"


def of_turn(cases: Iterable[Case], turns: int, name: str = "") -> list[Case]:
    """Return the cases of the turn.

    Parameters
    ----------
    cases : iterable
        All cases, in an order that does not change.
    turns : int
        In so many turns each case has its own; of fewer cases than turns, some turns have none.
    name : str
        Whose cases these are: turns of others begin elsewhere, so that all turns take about as long.
    """
    listed, turn = list(cases), os.environ[TURN]
    return listed if turn == "all" else listed[(number_of_turn() - _phase(name)) % turns :: turns]


def has_turn(name: str, turns: int) -> bool:
    """Whether a test without further cases runs in this turn: its name decides, so that turns take about as long."""
    return os.environ[TURN] == "all" or (_phase(name) - number_of_turn()) % turns == 0


def _phase(name: str) -> int:
    return zlib.crc32(name.encode())


def number_of_turn() -> int:
    """Return the number of the turn, 0 where all cases are asked for."""
    turn = os.environ[TURN]
    return 0 if turn == "all" else int(turn)
