"""What is worked out of a mechanism once, for as long as the mechanism is there."""

from __future__ import annotations

import functools
import weakref
from collections.abc import Callable
from typing import TypeVar

from symgen.describe.mechanism import Mechanism

Result = TypeVar("Result")


def remembered(function: Callable[[Mechanism], Result]) -> Callable[[Mechanism], Result]:
    """Return a function that works out what another gives of a mechanism, which cannot change, once.

    Parameters
    ----------
    function : callable
        Takes a mechanism. What it gives does not hold the mechanism, which would be there forever.
    """
    values: dict[int, Result] = {}

    @functools.wraps(function)
    def value_of(mechanism: Mechanism) -> Result:
        which = id(mechanism)  # a mechanism's hash and comparison go through all of it as well
        if which not in values:
            values[which] = function(mechanism)
            weakref.finalize(mechanism, values.pop, which, None).atexit = False  # two threads may have come here
        return values[which]

    return value_of
