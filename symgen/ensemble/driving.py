"""What inputs are in the runs of an ensemble: pieces of all of them, or of each where jumps depend on what varies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.describe.derived import derived
from symgen.runtime.pieces import Piece, pieces_of
from symgen.vocabulary.expressions import names

if TYPE_CHECKING:
    from symgen.ensemble.starts import Rows
    from symgen.run_setup import Given


@dataclass(frozen=True)
class Driving:
    """What inputs are.

    Attributes
    ----------
    given : Given
        What the settings give, put into the mechanism.
    varied : tuple of str
        What varies.
    until : float
        End of the runs [s].
    """

    given: Given
    varied: tuple[str, ...]
    until: float

    @cached_property
    def own(self) -> bool:
        """Whether jumps are elsewhere in each run."""
        driven = self.given.driven
        if driven is None:
            return False
        depends = {*self.varied, *(name for name, _ in derived(driven.mechanism.parameters))}
        return any(depends & {*names(jump.argument), *names(jump.value)} for jump in driven.jumps)

    @property
    def jumps(self) -> bool:
        """Whether runs have pieces."""
        return self.own or bool(self.given.pieces)

    @property
    def described(self) -> list[Any]:
        """What inputs are beside what the mechanism holds, as JSON can express it."""
        driven = self.given.driven
        if driven is None:
            return []
        samples = [(name, data.t, data.u) for name, data in sorted(driven.samples.items())]
        return [repr(samples), repr(driven.jumps)]

    def put(self, rows: Rows, parameters: Sequence[str]) -> Rows:
        """Return rows with the pieces of their runs.

        Parameters
        ----------
        rows : Rows
            Of the runs; parameters are changed.
        parameters : sequence of str
            Their names.
        """
        if not self.own:
            return replace(rows, pieces=(self.given.pieces,)) if self.given.pieces else rows
        driven = self.given.driven
        assert driven is not None, "something jumps"
        found = list[tuple[Piece, ...]]()
        for row in rows.parameters:
            values = dict(zip(parameters, row.tolist(), strict=True))
            # a row that is not defined fails at its start
            found.append(pieces_of(driven, values, self.until) if np.all(np.isfinite(row)) else ())
            _set(row, parameters, found[-1][0].values if found[-1] else {})
        return replace(rows, pieces=tuple(found))


def _set(row: Any, parameters: Sequence[str], values: Mapping[str, float]) -> None:
    for name, value in values.items():
        row[parameters.index(name)] = value
