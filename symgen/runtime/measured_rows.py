"""Loops over what runs of an ensemble left: functions of the motion at their outputs, one run after the other."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from symgen.native import types
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.store.jit import jit

_A, _K, _I8 = types.float64[::1], types.int64[::1], types.int64
_M, _C = types.float64[:, ::1], types.float64[:, :, ::1]


class Left(NamedTuple):
    """What runs of an ensemble left, and working memory.

    Attributes
    ----------
    times : Array
        Output times [s].
    selected : Array of int64
        Runs.
    seen : Array, shape (runs, columns, times)
        What they left; nan where they did not get there.
    first : int
        The first column that is brought.
    places : Array of int64
        Where each column from there on goes: (array, index), flat.
    ps, ws : Array, shapes (runs, np), (runs, nw)
        Parameters and scratch, which is overwritten.
    y, rates : Array, shape (ny,)
        Working memory.
    """

    times: Any
    selected: Any
    seen: Any
    first: int
    places: Any
    ps: Any
    ws: Any
    y: Any
    rates: Any


LEFT = types.RecordType((_A, _K, _C, _I8, _K, _M, _M, _A, _A), Left)


@jit()
def bring(seen: Any, r: int, k: int, first: int, places: Any, y: Any, rates: Any, w: Any) -> bool:
    """Put what a run left at an output where functions of the motion read it; return whether it got there."""
    for c in range(places.shape[0] // 2):
        value, at = seen[r, first + c, k], places[2 * c + 1]
        if places[2 * c] == e.OF_Y:
            y[at] = value
        elif places[2 * c] == e.OF_RATES:
            rates[at] = value
        else:
            w[at] = value
    reached = True
    for i in range(y.shape[0]):
        reached = reached and not math.isnan(y[i])
    return reached


@jit(_I8(types.RecordType((LEFT, abi.OBSERVE, abi.MEASURE)), _C, _I8, _C))
def measure_rows(model: Any, found: Any, at: int, entries: Any) -> int:
    """Evaluate formulas of a run, and the entries of D that vary, at all outputs of runs.

    Parameters
    ----------
    model : tuple
        A `Left`, then a function of the formulas and ``geometry`` (`symgen.runtime.abi`).
    found : Array, shape (runs, times, numbers)
        Written; nan where a run did not get there.
    at : int
        Where the entries begin in ``w``.
    entries : Array, shape (runs, times, entries)
        Written likewise; where it has no runs, nobody asks for them.
    """
    (times, selected, seen, first, places, ps, ws, y, rates), observe, geometry = model
    for s in range(selected.shape[0]):
        r = selected[s]
        for k in range(times.shape[0]):
            reached = bring(seen, r, k, first, places, y, rates, ws[r])
            if reached and found.shape[2] > 0:
                observe(times[k], y, ps[r], ws[r], rates, found[r, k])
            for i in range(0 if reached else found.shape[2]):
                found[r, k, i] = math.nan
            if entries.shape[0] > 0:
                if reached:
                    geometry(times[k], y, ps[r], ws[r])
                for i in range(entries.shape[2]):
                    entries[r, k, i] = ws[r, at + i] if reached else math.nan
    return 0
