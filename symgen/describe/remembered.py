"""Values computed once for each mechanism and kept as long as it exists."""

from __future__ import annotations

import functools
import weakref
from collections.abc import Callable
from typing import TypeVar

from symgen.describe.mechanism import Mechanism

Result = TypeVar("Result")


def compute_once(function: Callable[[Mechanism], Result]) -> Callable[[Mechanism], Result]:
    """Return a function that computes the value of another once for each mechanism, which is immutable.

    Parameters
    ----------
    function : callable
        Takes a mechanism. Its value must not refer to the mechanism, which would then live forever.
    """
    values: dict[int, Result] = {}

    @functools.wraps(function)
    def remembered_value(mechanism: Mechanism) -> Result:
        which = id(mechanism)  # a mechanism's hash and comparison go through all of it as well
        if which not in values:
            values[which] = function(mechanism)
            weakref.finalize(mechanism, values.pop, which, None).atexit = False  # two threads may have come here
        return values[which]

    return remembered_value
