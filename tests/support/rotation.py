"""Long lists of cases that prove the same of many mechanisms: a share of them each day, and all of them in turn."""

import os
from collections.abc import Iterable
from typing import TypeVar

Case = TypeVar("Case")

#: Names the day for all workers of a session: a number, which `tests/conftest.py` takes from the calendar, or `all`.
DAY = "SYMGEN_TEST_DAY"


def of_today(cases: Iterable[Case], days: int) -> list[Case]:
    """Return the cases whose turn it is.

    Parameters
    ----------
    cases : iterable
        All cases, in an order that does not change.
    days : int
        In so many days each case has its turn.
    """
    listed, day = list(cases), os.environ[DAY]
    return listed if day == "all" else listed[int(day) % days :: days]
