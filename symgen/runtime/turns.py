"""Whole turns of the angles in space at a start: those with which drivers, gears and threads are nearest to closed.

An angle between directions is known up to whole turns only, and positions do not say how many there were. The section
``winding`` remembers the angle; ``measure`` follows it from state to state. At a start it begins on the branch of
(-pi, pi] and is shifted here by whole turns.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.runtime.probe import call_measure

if TYPE_CHECKING:
    from symgen.model import CompiledModel

Array = NDArray[np.float64]


def follow_angles(compiled: CompiledModel, t: float, y: Array, p: Array, w: Array) -> None:
    """Bring the section ``winding`` along to the state `y`, which is less than half a turn from the one before."""
    if not compiled.info.windings:
        return
    try:
        with np.errstate(all="ignore"):
            compiled.measure(t, y, p, w)
    except (ArithmeticError, ValueError):
        return  # a formula that is not defined here; whoever closes positions finds out


def choose_turns(compiled: CompiledModel, t: float, y: Array, p: Array, w: Array) -> None:
    """Shift the section ``winding`` by the whole turns with which the rows on angles are nearest to closed.

    Parameters
    ----------
    compiled : CompiledModel
        The model; without angles in space nothing is done.
    t : float
        Time of the start [s].
    y : Array
        Described coordinates, not yet closed.
    p, w : Array
        Prepared parameters; scratch, whose section ``winding`` is set.

    Notes
    -----
    Rows are taken in turn, those first that leave a single angle to be shifted (drivers, then what gears tie to
    them), among these the ones on which a turn has the largest effect. A row that leaves several is closed by the angle
    that closes it best, and the others stay free for further rows.
    """
    if not compiled.info.windings:
        return
    winding, phi = compiled.section(w, "winding"), compiled.section(w, "residual")
    winding[:] = 0.0
    follow_angles(compiled, t, y, p, w)
    angles = winding.copy()

    def residual() -> Array:
        call_measure(compiled.model.geometry, t, y, p, w)
        return phi.copy()

    at_start = residual()
    effects = np.zeros((len(at_start), len(angles)))
    for i in range(len(angles)):
        winding[:] = angles
        winding[i] += math.tau
        effects[:, i] = residual() - at_start
    winding[:] = angles
    if np.isfinite(at_start).all() and np.isfinite(effects).all():
        effects[np.abs(effects) < 1e-9] = 0.0
        winding += math.tau * whole_turns(effects, at_start)


def whole_turns(effects: Array, residual: Array) -> Array:
    """Return how many turns to add to each angle.

    Parameters
    ----------
    effects : Array, shape (m, k)
        What one turn of each angle adds to the residual of each row.
    residual : Array, shape (m,)
        The residual without any.
    """
    turns, rest = np.zeros(effects.shape[1]), residual.copy()
    free: NDArray[np.bool_] = np.array([column.any() for column in effects.T], dtype=bool)
    rows = set(np.flatnonzero(effects.any(axis=1)).tolist())
    while rows:
        row = min(rows, key=lambda r: (np.count_nonzero(effects[r, free]), -np.abs(effects[r]).max(), r))
        rows.remove(row)
        choices = np.flatnonzero((effects[row] != 0.0) & free)
        if not len(choices):
            continue
        wanted = np.round(-rest[row] / effects[row, choices])
        best = int(np.argmin(np.abs(rest[row] + wanted * effects[row, choices])))
        column = choices[best]
        turns[column] = wanted[best]
        rest += wanted[best] * effects[:, column]
        free[column] = False
    return turns
