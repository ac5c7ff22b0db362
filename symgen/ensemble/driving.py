"""What inputs are in the runs of an ensemble: pieces of all of them, or of each where jumps depend on what varies."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.describe.derived import derived
from symgen.describe.evaluate import parameter_values
from symgen.errors import InputError
from symgen.runtime.motions import names_of_motions
from symgen.runtime.pieces import Piece, merged, pieces_of
from symgen.vocabulary.expressions import names

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.ensemble.starts import Rows
    from symgen.running.inputs import Inputs
    from symgen.runtime.foreseen import Foreseen


@dataclass(frozen=True)
class Driving:
    """What inputs are.

    Attributes
    ----------
    given : Inputs
        What the settings give, put into the mechanism.
    varied : tuple of str
        What varies.
    until : float
        End of the runs [s].
    foreseen : Foreseen, optional
        What formulas pass at times that are known beforehand, where runs stop at them.
    """

    given: Inputs
    varied: tuple[str, ...]
    until: float
    foreseen: Foreseen | None = None

    @cached_property
    def own(self) -> bool:
        """Whether jumps and kinks are elsewhere in each run."""
        driven = self.given.driven
        depends = {*self.varied, *(name for name, _ in derived(self.given.mechanism.parameters))}
        reads = [{*names(jump.argument), *names(jump.value)} for jump in (() if driven is None else driven.jumps)]
        return any(depends & read for read in (*reads, self.foreseen.reads if self.foreseen else frozenset[str]()))

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The pieces of all runs, where they are the same."""
        if not self.foreseen:
            return self.given.pieces
        values = parameter_values(self.given.mechanism, self.given.settings.parameters)
        return merged(self.given.pieces, self.foreseen.pieces(values, self.until))

    @property
    def jumps(self) -> bool:
        """Whether runs have pieces."""
        return self.own or bool(self.pieces)

    @property
    def changes(self) -> bool:
        """Whether numbers change at the pieces of runs; at kinks none does."""
        own = self.own and self.given.driven is not None and bool(self.given.driven.jumps)
        return own or any(piece.values for piece in self.pieces[1:])

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
            return replace(rows, pieces=(self.pieces,)) if self.pieces else rows
        found = list[tuple[Piece, ...]]()
        for row in rows.parameters:
            pieces: tuple[Piece, ...] = ()
            if np.all(np.isfinite(row)):
                try:
                    pieces = self._pieces_of(dict(zip(parameters, row.tolist(), strict=True)))
                except InputError:
                    row[:] = np.nan  # what is not defined fails at its start
            found.append(pieces)
            for name, value in (pieces[0].values if pieces else {}).items():
                row[parameters.index(name)] = value
        return replace(rows, pieces=tuple(found))

    def refusal(self, values: dict[str, float]) -> str:
        """Return why inputs cannot be in a run what they are asked to be, empty where they can.

        Parameters
        ----------
        values : dict of str to float
            Of its parameters.
        """
        try:
            self._pieces_of(values)
        except InputError as error:
            return str(error)
        return ""

    def _pieces_of(self, values: dict[str, float]) -> tuple[Piece, ...]:
        driven = self.given.driven
        pieces = () if driven is None else pieces_of(driven, values, self.until)
        return merged(pieces, self.foreseen.pieces(values, self.until)) if self.foreseen else pieces


def read_by_motions(mechanism: Mechanism, varied: Container[str]) -> tuple[str, ...]:
    """Return the parameters that motions which may jump read, if some of them differ from row to row; else none."""
    read, formulas = names_of_motions(mechanism), {name for name, _ in derived(mechanism.parameters)}
    known = tuple(p.name for p in mechanism.parameters if p.name in read)
    return known if any(name in varied or name in formulas for name in known) else ()
