"""What counts as large: changes of coordinates, velocities and multipliers are compared with these in any units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.runtime import abi

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel

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
        """What changes of coordinates are compared with: the mechanism's length [m], or 1; shape (nq,)."""
        return self._of(tuple(q.unit for q in self.compiled.info.coordinates), "m")

    @property
    def spans(self) -> Array:
        """A way along each velocity that counts as large: the mechanism's length [m], or 1 rad; shape (nv,)."""
        return self._of(tuple(v.unit for v in self.compiled.info.velocities), "m/s")

    @property
    def gaps(self) -> Array:
        """What violations of rows are compared with: the mechanism's length [m], or 1 rad; shape (m,)."""
        return self._of(tuple(row.unit for row in self.compiled.info.rows), "m")

    @property
    def loads(self) -> Array:
        """What multipliers are divided by to be compared: a moment is the force that has it at the mechanism's length.

        As in runs, whose multipliers are the smallest ones by the same measure; shape (m,).
        """
        return self._of(tuple(row.unit for row in self.compiled.info.rows), "rad")

    def moved(self, y: Array, change: Array) -> Array:
        """Return a state whose coordinates are moved by a change, Euler parameters kept at length 1."""
        found = y.copy()
        found[: self.compiled.info.nq] += change
        for first, _ in self.compiled.info.spins:
            found[first : first + 4] /= np.linalg.norm(found[first : first + 4])
        return found

    def _of(self, units: tuple[str, ...], long: str) -> Array:
        return np.array([self.length if unit == long else 1.0 for unit in units])
