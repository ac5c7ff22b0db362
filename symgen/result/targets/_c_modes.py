"""Rows with bounds of a mechanism in C: numbers of their runs, and the words of their transitions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.compile.native.c99 import broken_line, c_number
from symgen.run.compiling.printed_run import WORDS
from symgen.run.rows import kept_run

if TYPE_CHECKING:
    from collections.abc import Collection

    from symgen.describe.mechanism import Mechanism
    from symgen.run.compiling.printed_run import PrintedRun


def values_of_modes(
    mechanism: Mechanism, run: PrintedRun, used: Collection[str], own: Collection[str]
) -> dict[str, Any]:
    """Return what templates print of rows with bounds.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    run : PrintedRun
        Its run.
    used, own : collection of str
        Names of the arrays that the printed functions use, and of those that others set.
    """
    return {
        "bounded": [row.name for row in mechanism.bounded],
        "words": WORDS,
        "of_log": kept_run.OF_LOG,
        "functions_of_events": len(run.watched.names) + len(run.watched.switches),
        "ending": kept_run.ENDING,
        "changed": kept_run.CHANGED,
        "initial": [
            {"name": name, "numbers": _cells(name, array)}
            for name, array in run.memory.items()
            if name in used and name not in own and np.any(array)
        ],
    }


def _cells(name: str, array: Any) -> str:
    """Return places and numbers of an array that are not 0."""
    return broken_line(", ".join(f"{{{i}, {c_number(float(array[i]))}}}" for i in np.flatnonzero(array)))
