"""Parts that bend, judged in the rows of a sweep: the same limits as in single runs, at the outputs of each row."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.result.part_limits import MotionOfBodies, PartLimit, largest_excess, limits_of_parts
from symgen.result.result import OK, UNVERIFIED
from symgen.result.signals import Signal
from symgen.run.layout import ensemble_abi as e

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import ModelInfo

Array = NDArray[np.float64]

#: Last numbers that each row leaves: the limit that it exceeds most, and by which factor.
WIDTH = 2


@dataclass(frozen=True)
class JudgedParts:
    """Limits of parts, and the columns of loops that they are judged by.

    Attributes
    ----------
    mechanism : Mechanism
        With parts that bend.
    parameters : tuple of str
        Names of the parameters of a row, in their order.
    sizes : (int, int)
        Numbers of coordinates and velocities.
    """

    mechanism: Mechanism
    parameters: tuple[str, ...]
    sizes: tuple[int, int]

    @classmethod
    def of_mechanism(cls, mechanism: Mechanism, info: ModelInfo) -> JudgedParts | None:
        """Return the judged parts of a mechanism with a compiled model; None where no part bends."""
        if not limits_of_parts(mechanism):
            return None
        return cls(mechanism, tuple(q.name for q in info.parameters), (info.nq, info.nv))

    @cached_property
    def limits(self) -> tuple[PartLimit, ...]:
        """The limits."""
        return limits_of_parts(self.mechanism)

    @property
    def columns(self) -> tuple[Signal, ...]:
        """Columns of loops: coordinates, velocities, and accelerations where a law of parts reads them."""
        nq, nv = self.sizes
        states = [Signal("", f"y{i}", "", e.STATE, i) for i in range(nq + nv)]
        rates = [
            Signal("", f"v'{i}", "", e.ACCELERATION, i) for i in range(nv if self.mechanism.has_modal_bodies else 0)
        ]
        return (*states, *rates)

    def judge_rows(self, parameters: Array, columns: Array) -> Array:
        """Return `WIDTH` numbers of each row, shape (k, WIDTH).

        Parameters
        ----------
        parameters : Array, shape (k, number of parameters)
            Of the rows.
        columns : Array, shape (k, number of columns, times)
            `columns` at the outputs; nan after the end of a run.
        """
        nq, nv = self.sizes
        numbers = np.zeros((len(parameters), WIDTH))
        for r, (values, row) in enumerate(zip(parameters, columns, strict=True)):
            reached = row[:, ~np.isnan(row[0])].T
            if not len(reached):
                continue
            q, v, a = np.split(reached, [nq, nq + nv], axis=1)
            motion = MotionOfBodies(q, v, a if a.shape[1] else np.zeros_like(v))
            numbers[r] = largest_excess(self.limits, dict(zip(self.parameters, values.tolist(), strict=False)), motion)
        return numbers

    def doubt(self, status: NDArray[np.str_], reason: NDArray[np.object_], summary: Array) -> None:
        """Write status and reason of rows that exceed a limit, unless they have failed."""
        for r in np.flatnonzero((summary[:, -1] > 1.0) & np.isin(status, (OK, UNVERIFIED))):
            status[r], reason[r] = UNVERIFIED, self.limits[int(summary[r, -WIDTH])].sentence(float(summary[r, -1]))
