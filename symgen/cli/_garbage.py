"""Garbage collection for a process of the command line, which is over before most of its objects are."""

from __future__ import annotations

import atexit
import gc
from typing import Any

#: Objects that may come into being before they are looked through for the first time; imports make about as many.
FIRST = 100_000


def sparing() -> None:
    """Leave what a process imports out of garbage collection, and everything when it ends.

    Modules, classes and functions live as long as the process. Python looks through them some hundred and eighty times
    while they are imported, and twice more before it ends, which took a third of a short run.
    """
    usual = gc.get_threshold()

    def at_first(phase: str, info: dict[str, Any]) -> None:
        gc.callbacks.remove(at_first)
        gc.freeze()
        gc.set_threshold(*usual)

    gc.callbacks.append(at_first)
    gc.set_threshold(FIRST, *usual[1:])
    atexit.register(gc.freeze)
