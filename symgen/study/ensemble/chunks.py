"""The rows of a chunk: what distinguishes its runs, evaluated as arrays, and what they give.

What is undefined for some values (a division by 0, the root of a negative number) is nan there, and only those runs
fail.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.vocabulary.expressions import Expr
from symgen.describe.formulas.evaluate import dependent_parameters
from symgen.describe.formulas.start import described_start
from symgen.describe.mechanism import Mechanism
from symgen.study.ensemble.array_formulas import Columns

if TYPE_CHECKING:
    from symgen.base.vocabulary.infos import LawInfo
    from symgen.run.loops.run_spec import Seam

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rows:
    """Data by which the runs of a chunk differ.

    Attributes
    ----------
    parameters : Array, shape (k, number of parameters)
        Values of the mechanism's parameters.
    q, v : Array, shapes (k, nq), (k, nv)
        Described coordinates, not closed; given velocities, nan where they are to be completed.
    targets : Array, shape (k, h)
        Values of what the runs hold: coordinates, then joint coordinates, then rates of these.
    states : Array, shape (k, number of states)
        Values of the states of the file's own.
    seams : tuple of tuple of Seam
        Of each run, or of all of them, where an input jumps; none where nothing does.
    method : mapping of str to Array, shape (k,)
        Values of the method's parameters that vary, by their own names.
    """

    parameters: Array
    q: Array
    v: Array
    targets: Array
    states: Array
    seams: tuple[tuple[Seam, ...], ...] = ()
    method: Mapping[str, Array] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.parameters)

    def put_method_parameters(self, law: LawInfo, p: Array) -> None:
        """Write the method's parameters into ``p`` of these runs, as the code of a law has them."""
        places = {name: law.parameter_offset + i for i, (name, _) in enumerate(law.parameters)}
        for name, values in self.method.items():
            p[: len(self), places[name]] = values

    def seams_of(self, r: int) -> tuple[Seam, ...]:
        """Return the seams of a run."""
        return self.seams[r if len(self.seams) > 1 else 0] if self.seams else ()


def make_rows(
    mechanism: Mechanism,
    base: Mapping[str, float],
    varied: Mapping[str, Array],
    held: Sequence[str],
    velocities: Mapping[str, int],
    settled: Iterable[str] = (),
    constant: Mapping[str, Expr] | None = None,
) -> Rows:
    """Return the rows of a chunk.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism of the runs.
    base : mapping
        Values of all parameters, before any varies.
    varied : mapping of str to Array, shape (k,)
        Values of all names that vary.
    held : sequence of str
        Coordinates, joint coordinates and rates of these that are held, in the order of `Rows.targets`.
    velocities : mapping of str to int
        Velocities that vary, each with its index.
    settled : iterable of str
        Parameters that have numbers in place of their formulas.
    constant : mapping of str to Expr, optional
        Values of those among them that do not vary, as formulas of parameters.
    """
    k = len(next(iter(varied.values())))
    values: dict[str, Any] = {**base, **{name: x for name, x in varied.items() if name in base}}
    for name, formula in dependent_parameters(mechanism.parameters, {*settled, *varied}):
        values[name] = Columns(values).value(formula)
    described, speeds = described_start(mechanism, Columns(values))
    parameters, q, v = (np.empty((k, len(columns))) for columns in (base, described, speeds))
    for array, columns in ((parameters, [values[name] for name in base]), (q, described), (v, speeds)):
        for i, column in enumerate(columns):
            array[:, i] = np.nan if column is None else column
    undefined = [i for i, speed in enumerate(speeds) if speed is not None]
    q[~np.isfinite(v[:, undefined]).all(axis=1)] = np.nan
    numbers = Columns(values)
    chosen = {**varied, **{name: np.full(k, numbers.value(e)) for name, e in (constant or {}).items()}}
    for name, index in velocities.items():
        v[:, index] = chosen[name]
    targets = np.zeros((k, len(held)))
    for i, name in enumerate(held):
        targets[:, i] = chosen[name]
    states = np.empty((k, len(mechanism.states)))
    for i, x in enumerate(mechanism.states):
        states[:, i] = chosen[x.name] if x.name in chosen else numbers.value(x.start)
    return Rows(parameters, q, v, targets, states)


@dataclass(frozen=True)
class Chunk:
    """Results of the rows of a chunk.

    Attributes
    ----------
    values : Array, shape (k, quantities, times)
        Quantities at the output times; nan where a run did not get there.
    summary : Array, shape (k, N_SUMMARY + width)
        See `symgen.run.layout.ensemble_abi`.
    complete : bool
        Whether all rows were run.
    """

    values: Array
    summary: Array
    complete: bool = True


@dataclass(frozen=True)
class Results:
    """Arrays for the results of the rows of a chunk.

    Attributes
    ----------
    values : Array, shape (k, columns, times)
        Columns that loops write at the output times.
    summary : Array, shape (k, N_SUMMARY)
        See `symgen.run.layout.ensemble_abi`.
    events : Array, shape (k, width)
        Events of the rows; see there.
    behind : Array, shape (k, quantities, times)
        Columns that are computed after the loops.
    """

    values: Array
    summary: Array
    events: Array
    behind: Array
