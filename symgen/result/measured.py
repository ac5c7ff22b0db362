"""Points, forces, drivers and formulas of ``[outputs]`` at the outputs of a run, worked out when they are asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from symgen.compiling.side import compile_side
from symgen.describe.readings import TABLES, Column
from symgen.result.labelled import Array, labelled

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.result.labelled import Labelled
    from symgen.runtime.outcome import Motion


@dataclass(frozen=True, repr=False)
class Measured:
    """What quantities beside the state are evaluated from.

    Attributes
    ----------
    mechanism : Mechanism
        What was run.
    outcome : Motion
        States and accelerations at the outputs.
    multipliers : callable
        Returns lambda at the outputs, shape (k, m), of minimum norm where the rows of D are dependent.
    """

    mechanism: Mechanism
    outcome: Motion
    multipliers: Callable[[], Array]

    def __repr__(self) -> str:
        return f"<Measured of {self.mechanism.name} at {len(self.outcome.times)} outputs>"

    def columns(self, table: str) -> tuple[Column, ...]:
        """Return the columns of a table of `symgen.describe.readings`: names, units and formulas."""
        return TABLES[table](self.mechanism)

    def table(self, table: str) -> Labelled:
        """Return the values of a table at the outputs."""
        columns = self.columns(table)
        if not columns or not len(self.outcome.times):
            return labelled(np.zeros((len(self.outcome.times), len(columns))), columns)
        formulas = [(column.name, column.formula) for column in columns]
        compiled = self.outcome.compiled
        side = compile_side(self.mechanism, compiled, table, f"the table {table} of results", formulas)
        return labelled(self.outcome.observed(side.function, len(columns), self.multipliers()), columns)
