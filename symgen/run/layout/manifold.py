"""Changes of positions in the coordinates of v: added if q has as many entries as v, by emitted code in space."""

from __future__ import annotations

from typing import Any

from symgen.compile.native import types
from symgen.compile.store.jit import jit

_A = types.float64[::1]


@jit(types.int64(_A, _A))
def stay(y: Any, w: Any) -> int:
    """Stand for the emitted ``turn`` of models whose coordinates have velocities as rates; it is never called."""
    return 0


def advance(system: Any, run: Any, delta: Any, trial: Any) -> None:
    """Set the positions of `trial`: the accepted state moved by `delta`, bodies in space by its exponential.

    Parameters
    ----------
    system : System
        Its ``turn`` is used only if nq differs from nv.
    run : Run
        The run.
    delta : Array, shape (nv,)
        Change of position in the coordinates of v.
    trial : Array
        A state.
    """
    nq, nv, change = system.sizes.nq, system.sizes.nv, system.sizes.change
    if nq == nv:
        for i in range(nq):
            trial[i] = run.y[i] + delta[i]
        return
    for i in range(nq):
        trial[i] = run.y[i]
    for j in range(nv):
        run.w[change + j] = delta[j]
    system.turn(trial, run.w)
