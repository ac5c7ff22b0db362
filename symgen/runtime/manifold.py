"""Positions that are moved by a change of v: added where q has as many entries as v, through emitted code in space."""

from __future__ import annotations

from typing import Any

from numba import types

from symgen.store.jit import jit

_A = types.float64[::1]


@jit(types.int64(_A, _A))
def stay(y: Any, w: Any) -> int:
    """Stand in for the emitted ``turn`` of models whose coordinates change as velocities do; it is never called."""
    return 0


@jit()
def advance(nq: int, nv: int, y: Any, delta: Any, trial: Any, w: Any, change: int, turn: Any) -> None:
    """Set the positions of `trial` to those of `y` moved by `delta`, bodies in space by its exponential.

    Parameters
    ----------
    delta : Array, shape (nv,)
        Change of position in the coordinates of v.
    change : int
        Where the section ``change`` begins in `w`.
    turn : emitted function
        See `symgen.runtime.abi`; used only where nq differs from nv.
    """
    if nq == nv:
        for i in range(nq):
            trial[i] = y[i] + delta[i]
        return
    for i in range(nq):
        trial[i] = y[i]
    for j in range(nv):
        w[change + j] = delta[j]
    turn(trial, w)
