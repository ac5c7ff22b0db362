"""Rows of an ensemble in joint coordinates: starts of bodies carried to the tree, and its motion back, in loops.

What single runs do in `symgen.tree_run`, with the same bits. Rows whose start has dependent rows of loops, and
quantities beside coordinates, velocities and energies, are left to `symgen.ensemble.singly`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.compiling.carrying import carrying_of
from symgen.describe.sides import Side, sides_of
from symgen.describe.topology import edges_of
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.exact import compiled_form
from symgen.runtime.probe import Ready
from symgen.runtime.start_records import Instant
from symgen.runtime.starting import prepare_rows
from symgen.runtime.tree_start import Carrying, settle_rows, turned_by_tree

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.ensemble.quantities import Quantity
    from symgen.runtime.compiled import CompiledModel, ModelInfo

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: What loops leave of a motion in joint coordinates.
_PLAIN = {e.STATE, e.STATUS, e.ENERGY, e.ENERGY_ERROR}


def are_plain(quantities: Sequence[Quantity], info: ModelInfo) -> bool:
    """Return whether loops leave all of some quantities; of Euler parameters, which have two signs, all four.

    Parameters
    ----------
    quantities : sequence of Quantity
        What is kept.
    info : ModelInfo
        The model in the bodies' own coordinates.
    """
    kept = {q.column for q in quantities if q.source == e.STATE}
    groups = ({first, first + 1, first + 2, first + 3} for first, _ in info.spins)
    return {q.source for q in quantities} <= _PLAIN and all(not kept & g or g <= kept for g in groups)


@dataclass(frozen=True)
class TreeRows:
    """Rows as those of a tree.

    Attributes
    ----------
    bodies, compiled : CompiledModel
        In the bodies' own coordinates, and in those of joints.
    p : Array
        Parameters of the second, those of a row left out.
    sides : tuple of Side or None
        Joints that turn a body over where their directions point opposite ways; None where others may as well.
    carrying : Carrying
        Where what stands.
    """

    bodies: CompiledModel
    compiled: CompiledModel
    p: Array
    sides: tuple[Side, ...] | None
    carrying: Carrying

    @classmethod
    def of(
        cls, whole: Mechanism, carried: Mechanism, bodies: CompiledModel, compiled: CompiledModel, p: Array
    ) -> TreeRows:
        """Return the rows of a mechanism.

        Parameters
        ----------
        whole, carried : Mechanism
            As described, and with its tree.
        bodies, compiled, p
            See the class.
        """
        sides = None if any(edge.turn == "cross" for edge in edges_of(whole).values()) else sides_of(whole)
        return cls(bodies, compiled, p, sides, carrying_of(whole, carried, bodies, compiled))

    @property
    def width(self) -> int:
        """Numbers that tell the motion of bodies."""
        return self.bodies.info.nq + 2 * self.bodies.info.nv

    def picks(self, quantities: Sequence[Quantity]) -> Integers:
        """Return (source, column) of each quantity in what the loop of the tree leaves, flat."""
        info, own = self.bodies.info, self.compiled.info
        found = list[tuple[int, int]]()
        for q in quantities:
            if q.source != e.STATE:
                found.append((q.source, q.column))
            elif q.column < info.work:  # behind multipliers, where loops look for joint coordinates
                found.append((e.JOINT, q.column - own.m))
            else:
                found.append((e.STATE, q.column - info.work + own.work))
        return np.array(found, dtype=np.int64).ravel()

    def settle(self, starts: Instant, selected: Integers, control: Integers) -> tuple[Instant, NDArray[np.bool_]]:
        """Return states, parameters and scratch of the tree, and which of the selected rows have no dependent rows.

        Parameters
        ----------
        starts : Instant
            Consistent states of bodies, with parameters and scratch.
        selected, control : Array of int
            Rows to work on; what the watching thread shares.
        """
        info, own, model = self.bodies.info, self.compiled.info, self.compiled.model
        runs, law, scratch = len(starts[0]), self.compiled.law_module, self.compiled.scratch()
        ys, ps, ws = np.zeros((runs, own.ny)), np.tile(self.p, (runs, 1)), np.zeros((runs, len(scratch)))
        count = len(info.parameters)
        ps[:, :count] = starts[1][:, :count]
        flat = Instant(ys.reshape(-1), ps.reshape(-1), ws.reshape(-1))
        compiled_form(prepare_rows)(model.prepare, law.prepare, model.masses, scratch, *flat[1:], runs, selected)
        of_bodies = Instant(*(array.reshape(-1) for array in starts))
        places = self.carrying._replace(runs=runs, dependent=np.zeros(runs, dtype=np.int64))
        room = np.zeros(info.ny + info.observed + starts[2].shape[1])
        functions = self.bodies.model.observe, model.geometry
        compiled_form(settle_rows)(*functions, self.compiled.layout, of_bodies, flat, places, room, selected, control)
        return Instant(ys, ps, ws), places.dependent[selected] == 0

    def upright(self, starts: Instant, selected: Integers, closed: Array, summary: Array) -> Integers:
        """Return those of selected rows in which the tree turns no body over; the others are told why they end.

        Parameters
        ----------
        starts : Instant
            Of the tree, from `settle`.
        selected : Array of int
            Rows to look at.
        closed : Array, shape (runs, ny)
            States of bodies.
        summary : Array
            See `symgen.runtime.ensemble_abi`; written.
        """
        info, own = self.bodies.info, self.compiled.info
        if not info.spins:
            return selected
        q, doubtful = closed[selected, : info.nq].T, np.full(len(selected), self.sides is None)
        for side in self.sides or ():
            doubtful |= side.cosine(q) < 0.0
        observe, rate, out = Ready(self.compiled.model.bodies, abi.OBSERVE), np.zeros(own.ny), np.zeros(self.width)
        for r in selected[doubtful]:
            y, p, w = (array[r].copy() for array in starts)
            observe(self.compiled.layout.t, y, p, w, rate, out)
            if (over := turned_by_tree(info, closed[r], out)) >= 0:
                summary[r, [e.START, e.START_WHERE]] = e.TURNED_OVER, over
        return np.asarray(selected[summary[selected, e.START] == e.ASSEMBLED])

    def turn(self, quantities: Sequence[Quantity], selected: Integers, starts: Array, values: Array) -> None:
        """Give Euler parameters the signs that they have at the start.

        Parameters
        ----------
        quantities : sequence of Quantity
            What is kept.
        selected : Array of int
            Rows that were run.
        starts : Array, shape (runs, ny)
            Where bodies began.
        values : Array, shape (runs, quantities, times)
            Changed.
        """
        at = {q.column: i for i, q in enumerate(quantities) if q.source == e.STATE}
        for first, _ in self.bodies.info.spins:
            if first in at and values.shape[2]:
                columns = [at[first + k] for k in range(4)]
                turned = (
                    np.einsum("rk,rk->r", values[selected][:, columns, 0], starts[selected, first : first + 4]) < 0.0
                )
                rows = selected[turned]
                values[np.ix_(rows, columns)] *= -1.0
