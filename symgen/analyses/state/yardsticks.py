"""Yardsticks of a state: what its lengths, angles and forces are compared with."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

Array = NDArray[np.float64]


class Yardsticks:
    """The measures of what has a compiled model and the scratch of a start."""

    compiled: CompiledModel
    w: Array

    @property
    def length(self) -> float:
        """Length of the mechanism [m]."""
        return float(self.w[abi.LENGTH]) or 1.0

    @property
    def lengths(self) -> Array:
        """Scales of changes of coordinates: the mechanism's length [m], or 1; shape (nq,)."""
        return self._scales_of_units(tuple(q.unit for q in self.compiled.info.coordinates), "m")

    @property
    def spans(self) -> Array:
        """A way along each velocity that counts as large: the mechanism's length [m], or 1 rad; shape (nv,)."""
        return self._scales_of_units(tuple(v.unit for v in self.compiled.info.velocities), "m/s")

    @property
    def gaps(self) -> Array:
        """Scales of violations of rows: the mechanism's length [m], or 1 rad; shape (m,)."""
        return self._scales_of_units(tuple(row.unit for row in self.compiled.info.rows), "m")

    @property
    def loads(self) -> Array:
        """Divisors of multipliers for comparisons: a moment counts as the force that has it at the mechanism's length.

        As in runs, whose multipliers are the smallest ones by the same measure; shape (m,).
        """
        return self._scales_of_units(tuple(row.unit for row in self.compiled.info.rows), "rad")

    def move_state(self, y: Array, change: Array) -> Array:
        """Return a state whose coordinates are moved by a change, Euler parameters kept at length 1."""
        state = y.copy()
        state[: self.compiled.info.nq] += change
        for first, _ in self.compiled.info.spins:
            state[first : first + 4] /= np.linalg.norm(state[first : first + 4])
        return state

    def _scales_of_units(self, units: tuple[str, ...], long: str) -> Array:
        return np.array([self.length if unit == long else 1.0 for unit in units])
