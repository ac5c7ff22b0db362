"""Changes of positions in the coordinates of v: added if q has as many entries as v, by emitted code in space."""

from __future__ import annotations

from symgen.compile.native.annotations import Array
from symgen.compile.store.jit import jit
from symgen.run.layout.records import ModelSystem, Run


@jit(entry=True)
def turn_nothing(y: Array, w: Array) -> int:
    """Replace the emitted ``turn`` of models whose coordinates have velocities as rates; it is never called."""
    return 0


def advance_coordinates(system: ModelSystem, run: Run, delta: Array, trial: Array) -> None:
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
