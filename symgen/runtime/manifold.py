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


@jit()
def unfold(nq: int, nv: int, n: int, slopes: Any) -> None:
    """Make room for derivatives by q where `fold_map` wrote: ``tangent`` does not touch structural zeros."""
    if nq == nv:
        return
    width = nq + nv
    for r in range(nq, n):
        for j in range(nv):
            slopes[n * n + r * width + j] = 0.0


@jit()
def fold_map(nq: int, nv: int, n: int, slopes: Any, row: Any, spins: Any, delta: Any) -> None:
    """Turn derivatives by q into derivatives by the change of position: dF/dq N T, in the first nv columns of dF/dq.

    The kinematic map is read from the Jacobian itself, whose first rows belong to ``q' - N v``. Where a rotation vector
    d grows by e, the body turns by T e more, ``T = 1 - d x / 2 + d x d x / 6`` up to terms of third order.

    Parameters
    ----------
    slopes : Array
        What ``tangent`` wrote: dF/dk, then dF/dy.
    row : Array
        Working memory for nv numbers.
    spins : Array of int
        Where the angular velocities of bodies begin in v.
    delta : Array, shape (nv,)
        The change of position at which the Jacobian is wanted.
    """
    if nq == nv:
        return
    width = nq + nv
    for r in range(nq, n):
        base = n * n + r * width
        for j in range(nv):
            total = 0.0
            for i in range(nq):
                total -= slopes[base + i] * slopes[n * n + i * width + nq + j]
            row[j] = total
        for j in range(nv):
            slopes[base + j] = row[j]
        for s in range(spins.shape[0]):
            j = spins[s]
            x, y, z = delta[j], delta[j + 1], delta[j + 2]
            a, b, c = row[j], row[j + 1], row[j + 2]
            # a row times d x is the cross product of both
            u, v, w = b * z - c * y, c * x - a * z, a * y - b * x
            slopes[base + j] += -0.5 * u + (v * z - w * y) / 6.0
            slopes[base + j + 1] += -0.5 * v + (w * x - u * z) / 6.0
            slopes[base + j + 2] += -0.5 * w + (u * y - v * x) / 6.0
