"""What is worked out of a mechanism once, for as long as the mechanism is there."""

from __future__ import annotations

import functools
import weakref
from collections.abc import Callable
from typing import TypeVar

from symgen.describe.mechanism import Mechanism

Found = TypeVar("Found")


def remembered(function: Callable[[Mechanism], Found]) -> Callable[[Mechanism], Found]:
    """Return a function that works out what another gives of a mechanism, which cannot change, once.

    Parameters
    ----------
    function : callable
        Takes a mechanism. What it gives does not hold the mechanism, which would be there forever.
    """
    known: dict[int, Found] = {}

    @functools.wraps(function)
    def found(mechanism: Mechanism) -> Found:
        which = id(mechanism)  # a mechanism's hash and comparison go through all of it as well
        if which not in known:
            known[which] = function(mechanism)
            weakref.finalize(mechanism, known.pop, which, None).atexit = False  # two threads may have come here
        return known[which]

    return found
