"""Derivatives of a motion that drivers prescribe, by chosen numbers: exact, without integrating."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.describe.facts.motion_quantities import QuantityNames
from symgen.result.labelled import Labelled
from symgen.result.sensitivities import ENERGIES, derivative_unit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.analyses.prescribed.kept_motion import KeptMotion
    from symgen.analyses.prescribed.tracing import Traced
    from symgen.run.directions.driven_directions import DrivenDirections

Array = NDArray[np.float64]


@dataclass(frozen=True)
class DrivenSensitivities:
    """Derivatives of a prescribed motion.

    Attributes
    ----------
    names, units : tuple of str
        What the motion is differentiated by, and the units of that.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    _kept: KeptMotion
    _directions: DrivenDirections

    @classmethod
    def of_motion(cls, names: Sequence[str], kept: KeptMotion, traced: Traced) -> DrivenSensitivities:
        """Return the derivatives of a motion with the values of the settings.

        Raises
        ------
        InputError
            If the motion passes a singular position, where derivatives jump.
        """
        if traced.passages or traced.ended:
            where = traced.ended or traced.passages[0].words
            raise InputError("kinematics: sensitivities", "a motion without singular positions", where)
        return cls(tuple(names), kept.units, kept, kept.here(traced))

    def of_quantity(self, name: str) -> Labelled:
        """Return the derivatives of a column, an energy or a formula over time.

        Raises
        ------
        InputError
            If it is none of these, or the motion does not determine it.
        """
        if name in ENERGIES:
            return self._labelled(np.array(ENERGIES[name]) @ self._directions.energies(), "J")
        quantity = QuantityNames(self._kept.mechanism).read("gradient", name)
        side = self._kept.side("gradient", [(name, quantity.formula)])
        if "multipliers" in side.reads and (rows := self._kept.run.start.redundant_rows):
            got = f"those of dependent rows ({rows[0]}) in {name}"
            raise InputError("sensitivities", "multipliers that the motion determines", got)
        return self._labelled(self._directions.observe(side.function, 1)[1][:, 0], quantity.unit)

    def to_json(self, columns: Sequence[str]) -> dict[str, Any]:
        """Return names, units, and the derivatives of columns at the last time by column and name."""
        by = dict(zip(self.names, self.units, strict=True))
        return {"by": by, "final": {name: self.of_quantity(name).row() for name in columns}}

    def _labelled(self, values: Array, unit: str) -> Labelled:
        return Labelled(values, self.names, tuple(derivative_unit(unit, own) for own in self.units))
