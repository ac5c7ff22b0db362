"""Rows of an ensemble in joint coordinates: starts of bodies carried to the tree, and its motion back, in loops.

What single runs do in `symgen.running.tree`. Quantities beside coordinates, velocities and energies are left to
`symgen.ensemble.singly`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.runtime import ensemble_abi as e
from symgen.runtime.start_records import Instant
from symgen.runtime.tree_start import TURNED_OVER, Carried

if TYPE_CHECKING:
    from symgen.ensemble.chunks import Results
    from symgen.ensemble.loop_runs import LoopRuns
    from symgen.ensemble.row_quantities import RowQuantity
    from symgen.ensemble.row_starts import Rows
    from symgen.runtime.compiled import ModelInfo

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: What loops leave of a motion in joint coordinates.
_PLAIN = {e.STATE, e.STATUS, e.ENERGY, e.ENERGY_ERROR}


def are_plain(quantities: Sequence[RowQuantity]) -> bool:
    """Return whether loops leave all of some quantities."""
    return {q.source for q in quantities} <= _PLAIN


def picks_on_tree(quantities: Sequence[RowQuantity], info: ModelInfo, own: ModelInfo) -> Integers:
    """Return (source, column) of each quantity in what the loop of the tree leaves, flat.

    Parameters
    ----------
    quantities : sequence of RowQuantity
        What is kept.
    info, own : ModelInfo
        Of bodies, and of the tree.
    """
    found = list[tuple[int, int]]()
    for q in quantities:
        if q.source != e.STATE:
            found.append((q.source, q.column))
        elif q.column < info.work:  # behind multipliers, where loops look for joint coordinates
            found.append((e.JOINT, q.column - own.m))
        else:
            found.append((e.STATE, q.column - info.work + own.work))
    return np.array(found, dtype=np.int64).ravel()


@dataclass(frozen=True)
class TreeRuns:
    """Runs rows in joint coordinates from starts of bodies.

    Attributes
    ----------
    carried : Carried
        Starts of bodies as those of the tree.
    p : Array
        Parameters of the tree, those of a row left out.
    loop : LoopRuns
        Of the tree.
    """

    carried: Carried
    p: Array
    loop: LoopRuns

    def run(self, rows: Rows, starts: Instant, selected: Integers, out: Results, control: Integers) -> bool:
        """Run selected rows from consistent starts; parameters as for `symgen.ensemble.loop_runs.LoopRuns.run`."""
        info, own, runs = self.carried.bodies.info, self.loop.compiled.info, len(starts.y)
        scratch = np.zeros((runs, len(self.loop.compiled.scratch())))
        now, count = Instant(np.zeros((runs, own.ny)), np.tile(self.p, (runs, 1)), scratch), len(info.parameters)
        now.p[:, :count] = starts.p[:, :count]
        alike = self.carried.settle(starts, now, selected, control)
        over = np.abs(alike[selected]) < TURNED_OVER
        for k in reversed(range(over.shape[1])):  # the first one is told
            out.summary[selected[over[:, k]], [[e.START], [e.START_WHERE]]] = [[e.TURNED_OVER], [k]]
        selected = selected[~over.any(axis=1)]
        if not self.loop.run(rows, now, selected, out, control):
            return False
        self._turn(selected, alike, out.values)
        return True

    def _turn(self, selected: Integers, alike: Array, values: Array) -> None:
        """Have Euler parameters, of two signs, go on from those of the start."""
        at = {q.column: i for i, q in enumerate(self.loop.recipe.quantities) if q.source == e.STATE}
        for (first, _), products in zip(self.carried.bodies.info.spins, alike.T, strict=True):
            columns = [at[k] for k in range(first, first + 4) if k in at]
            values[np.ix_(selected[products[selected] < 0.0], columns)] *= -1.0
