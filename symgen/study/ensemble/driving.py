"""Inputs of the runs of an ensemble: common seams, or seams of each run if jumps depend on what varies."""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import names_in_expression
from symgen.describe.formulas.evaluate import dependent_parameters, parameter_values
from symgen.run.breaks.foreseen_seams import merge_seams, seams_of_motion
from symgen.run.breaks.refused_motions import jump_of_motion, motion_names
from symgen.run.loops.run_spec import Seam

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.describe.mechanism import Mechanism
    from symgen.run.breaks.foreseen_seams import Foreseen
    from symgen.run.planning.inputs import Inputs
    from symgen.study.ensemble.chunks import Rows
    from symgen.study.ensemble.ensemble import Ensemble


@dataclass(frozen=True)
class Driving:
    """Inputs of the runs.

    Attributes
    ----------
    inputs : Inputs
        Inputs of the settings, put into the mechanism.
    varied : tuple of str
        Names of what varies.
    until : float
        End of the runs [s].
    foreseen : Foreseen, optional
        Times, known in advance, at which formulas jump, where runs have seams there.
    moving : tuple of str
        From `read_by_motions`.
    """

    inputs: Inputs
    varied: tuple[str, ...]
    until: float
    foreseen: Foreseen | None = None
    moving: tuple[str, ...] = ()
    _jumps: dict[tuple[float, ...], InputError | None] = field(default_factory=dict, repr=False, compare=False)

    @cached_property
    def own(self) -> bool:
        """Whether jumps and kinks are elsewhere in each run."""
        driven = self.inputs.driven
        depends = {*self.varied, *(name for name, _ in dependent_parameters(self.inputs.mechanism.parameters))}
        reads = [
            {*names_in_expression(jump.argument), *names_in_expression(jump.value)}
            for jump in (() if driven is None else driven.jumps)
        ]
        return any(depends & read for read in (*reads, self.foreseen.reads if self.foreseen else frozenset[str]()))

    @cached_property
    def seams(self) -> tuple[Seam, ...]:
        """The seams of all runs, where they are the same."""
        if not self.foreseen:
            return self.inputs.seams
        values = parameter_values(self.inputs.mechanism, self.inputs.settings.parameters)
        return merge_seams(self.inputs.seams, self.foreseen.seams(values, self.until))

    @property
    def jumps(self) -> bool:
        """Whether runs have seams."""
        return self.own or bool(self.seams)

    @property
    def changes(self) -> bool:
        """Whether numbers change at the seams of runs; at kinks none does."""
        own = self.own and self.inputs.driven is not None and bool(self.inputs.driven.jumps)
        return own or any(seam.values for seam in self.seams[1:])

    @property
    def described(self) -> list[Any]:
        """Description of inputs that are not in the mechanism, as JSON can express it."""
        driven = self.inputs.driven
        if driven is None:
            return []
        samples = [(name, data.t, data.u) for name, data in sorted(driven.samples.items())]
        return [repr(samples), repr(driven.jumps)]

    def put_seams(self, rows: Rows, parameters: Sequence[str]) -> Rows:
        """Return rows with the seams of their runs.

        Parameters
        ----------
        rows : Rows
            Of the runs; parameters are changed.
        parameters : sequence of str
            Their names.
        """
        if not (self.own or self.moving):
            return replace(rows, seams=(self.seams,)) if self.seams else rows
        seams_of_rows = list[tuple[Seam, ...]]()
        for row in rows.parameters:
            seams: tuple[Seam, ...] = ()
            if np.all(np.isfinite(row)):
                try:
                    seams = self._seams_of(dict(zip(parameters, row.tolist(), strict=True)))
                except InputError:
                    row[:] = np.nan  # what is not defined fails at its start
            seams_of_rows.append(seams)
            for name, value in (seams[0].values if seams else {}).items():
                row[parameters.index(name)] = value
        return replace(rows, seams=tuple(seams_of_rows))

    def rows_refused(self, ensemble: Ensemble, failed: NDArray[np.bool_]) -> Iterator[tuple[int, str]]:
        """Yield rows whose inputs jump too often, or in which the motion of a driver jumps, and why they cannot run.

        Parameters
        ----------
        ensemble : Ensemble
            The ensemble of the runs.
        failed : Array of bool, shape (n,)
            Rows without a start.
        """
        for r in np.flatnonzero(failed).tolist() if self.own or self.moving else ():
            row = ensemble.rows_without_seams(r, r + 1).parameters[0].tolist()
            if all(map(math.isfinite, row)):
                try:
                    self._seams_of(dict(zip(ensemble.parameters, row, strict=True)))
                except InputError as error:
                    yield r, str(error)

    def _seams_of(self, values: dict[str, float]) -> tuple[Seam, ...]:
        driven, read = self.inputs.driven, tuple(values[name] for name in self.moving)
        if self.moving and read not in self._jumps:
            self._jumps[read] = jump_of_motion(self.inputs.mechanism, values, self.until)
        if (jump := self._jumps.get(read)) is not None:
            raise jump
        seams = () if driven is None else seams_of_motion(driven, values, self.until)
        return merge_seams(seams, self.foreseen.seams(values, self.until)) if self.foreseen else seams


def read_by_motions(mechanism: Mechanism, varied: Container[str]) -> tuple[str, ...]:
    """Return the parameters that motions which may jump read, if some of them differ from row to row; else none."""
    read, formulas = motion_names(mechanism), {name for name, _ in dependent_parameters(mechanism.parameters)}
    parameters = tuple(p.name for p in mechanism.parameters if p.name in read)
    return parameters if any(name in varied or name in formulas for name in parameters) else ()
