"""Whole turns of angles in space at starts, in compiled code: what `symgen.runtime.turns` does for a single run."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.store.jit import jit

_WINDING, _WINDINGS, _M, _RESIDUAL = abi.WINDING, e.WINDINGS, e.M, e.RESIDUAL


@jit()
def choose_turns(geometry: Any, measure: Any, y: Any, p: Any, w: Any, sizes: Any) -> None:
    """Shift the section ``winding`` by the whole turns with which the rows on angles are nearest to closed.

    Parameters
    ----------
    geometry, measure : emitted functions
        See `symgen.runtime.abi`.
    y : Array
        Described coordinates, not yet closed.
    p, w : Array
        Prepared parameters; scratch, whose section ``winding`` is set.
    sizes : Array of int
        See `symgen.runtime.ensemble_abi`.
    """
    count, m, first = sizes[_WINDINGS], sizes[_M], sizes[_RESIDUAL]
    if count == 0:
        return
    for i in range(count):
        w[_WINDING + i] = 0.0
    measure(0.0, y, p, w)
    angles, rest, effects = np.zeros(count), np.zeros(m), np.zeros((m, count))
    for i in range(count):
        angles[i] = w[_WINDING + i]
    geometry(0.0, y, p, w)
    finite = True
    for r in range(m):
        rest[r] = w[first + r]
        finite = finite and math.isfinite(rest[r])
    for i in range(count):
        w[_WINDING + i] = angles[i] + math.tau
        geometry(0.0, y, p, w)
        w[_WINDING + i] = angles[i]
        for r in range(m):
            effect = w[first + r] - rest[r]
            finite = finite and math.isfinite(effect)
            effects[r, i] = effect if abs(effect) >= 1e-9 else 0.0
    if finite:
        turns = _whole_turns(effects, rest)
        for i in range(count):
            w[_WINDING + i] = angles[i] + math.tau * turns[i]


@jit()
def _whole_turns(effects: Any, rest: Any) -> Any:
    """Return how many turns to add to each angle; rows that leave a single one free come first."""
    m, count = effects.shape
    turns = np.zeros(count)
    free, waiting = np.zeros(count, dtype=np.bool_), np.zeros(m, dtype=np.bool_)
    for r in range(m):
        for i in range(count):
            if effects[r, i] != 0.0:
                free[i] = waiting[r] = True
    while True:
        row, least, largest = -1, count + 1, 0.0
        for r in range(m):
            if waiting[r]:
                choices, size = 0, 0.0
                for i in range(count):
                    choices += 1 if effects[r, i] != 0.0 and free[i] else 0
                    size = max(size, abs(effects[r, i]))
                if choices < least or (choices == least and size > largest):
                    row, least, largest = r, choices, size
        if row < 0:
            return turns
        waiting[row] = False
        column, best, wanted = -1, math.inf, 0.0
        for i in range(count):
            if effects[row, i] != 0.0 and free[i]:
                number = np.rint(-rest[row] / effects[row, i])
                left = abs(rest[row] + number * effects[row, i])
                if left < best:
                    column, best, wanted = i, left, number
        if column >= 0:
            turns[column] = wanted
            for r in range(m):
                rest[r] += wanted * effects[r, column]
            free[column] = False
