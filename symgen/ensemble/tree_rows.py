"""Rows of an ensemble in joint coordinates: starts of bodies carried to the tree, and its motion back, in loops.

What single runs do in `symgen.running.tree`. Rows whose start has dependent rows of loops, and
quantities beside coordinates, velocities and energies, are left to `symgen.ensemble.singly`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.compiling.carrying import carrying_of
from symgen.runtime import ensemble_abi as e
from symgen.runtime.exact import compiled_form
from symgen.runtime.start_records import Instant
from symgen.runtime.starting import prepare_rows
from symgen.runtime.tree_start import TURNED_OVER, Carrying, settle_rows

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.ensemble.quantities import Quantity
    from symgen.runtime.compiled import CompiledModel

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: What loops leave of a motion in joint coordinates.
_PLAIN = {e.STATE, e.STATUS, e.ENERGY, e.ENERGY_ERROR}


def are_plain(quantities: Sequence[Quantity]) -> bool:
    """Return whether loops leave all of some quantities."""
    return {q.source for q in quantities} <= _PLAIN


@dataclass(frozen=True)
class TreeRows:
    """Rows as those of a tree.

    Attributes
    ----------
    bodies, compiled : CompiledModel
        In the bodies' own coordinates, and in those of joints.
    p : Array
        Parameters of the second, those of a row left out.
    carrying : Carrying
        Where what stands.
    """

    bodies: CompiledModel
    compiled: CompiledModel
    p: Array
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
        return cls(bodies, compiled, p, carrying_of(whole, carried, bodies, compiled))

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

    def settle(
        self, starts: Instant, selected: Integers, control: Integers
    ) -> tuple[Instant, NDArray[np.bool_], Array]:
        """Return states, parameters and scratch of the tree, and which of the selected rows have no dependent rows.

        Last come the products of Euler parameters of bodies with those that the tree carries, shape (runs, spins).

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
        alike = np.zeros((runs, len(info.spins)))
        dependent = np.zeros(runs, dtype=np.int64)
        places = self.carrying._replace(runs=runs, dependent=dependent, alike=alike.reshape(-1))
        room = np.zeros(info.ny + places.outs + starts[2].shape[1])
        functions = self.bodies.model.observe, model.geometry, model.bodies
        compiled_form(settle_rows)(*functions, self.compiled.layout, of_bodies, flat, places, room, selected, control)
        return Instant(ys, ps, ws), dependent[selected] == 0, alike

    @staticmethod
    def upright(selected: Integers, alike: Array, summary: Array) -> Integers:
        """Return those of selected rows in which the tree turns no body over; the others are told why they end.

        Parameters
        ----------
        selected : Array of int
            Rows to look at.
        alike : Array
            From `TreeRows.settle`.
        summary : Array
            See `symgen.runtime.ensemble_abi`; written.
        """
        over = np.abs(alike[selected]) < TURNED_OVER
        for k in reversed(range(over.shape[1])):  # the first one is told
            summary[selected[over[:, k]], [[e.START], [e.START_WHERE]]] = [[e.TURNED_OVER], [k]]
        return np.asarray(selected[~over.any(axis=1)])

    def turn(self, quantities: Sequence[Quantity], selected: Integers, alike: Array, values: Array) -> None:
        """Have Euler parameters, of two signs, go on from those of the start.

        Parameters
        ----------
        quantities : sequence of Quantity
            What is kept.
        selected : Array of int
            Rows that were run.
        alike : Array
            From `settle`.
        values : Array, shape (runs, quantities, times)
            Changed.
        """
        at = {q.column: i for i, q in enumerate(quantities) if q.source == e.STATE}
        for (first, _), products in zip(self.bodies.info.spins, alike.T, strict=True):
            columns = [at[k] for k in range(first, first + 4) if k in at]
            values[np.ix_(selected[products[selected] < 0.0], columns)] *= -1.0
