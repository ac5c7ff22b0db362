"""Parameters from measured data: least squares over whole runs, with exact derivatives of the runs that are made.

Before a fit, and after it, the singular values of the derivatives say which numbers the data cannot tell apart.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.fit.neighbours import notes_on_neighbours
from symgen.analyses.search.free_numbers import FreeNumbers
from symgen.analyses.search.measured_data import MeasuredData, Residuals, measured_columns
from symgen.analyses.search.ranges import Bounds, make_ranges, read_bounds
from symgen.analyses.search.sampled_motions import NoMotion, Remembering
from symgen.analyses.search.squares import LeastSquares, determine, least_squares_within, null_directions
from symgen.base.errors import AnalysisError, InputError, plural, quote, suggest
from symgen.describe.facts.lifted import lift_numbers, literal_points_in_words
from symgen.result.sensitivities import place_of_column

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.base.units import Unit
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Fit:
    """Parameters fitted to data.

    Attributes
    ----------
    parameters : mapping of str to float
        Fitted values by name; biases are called ``bias of QUANTITY``.
    units : mapping of str to str
        Their units.
    errors : mapping of str to float
        Standard errors; nan for a number that meets its bound.
    intervals : mapping of str to (float, float)
        95 % intervals; one-sided where a bound is met.
    correlations : Array, shape (n, n)
        Of the errors, in the order of `parameters`; nan where there are none.
    null : tuple of str
        Sentences on numbers that the data do not determine.
    notes : tuple of str
        Other remarks.
    deviations : mapping of str to float
        Root mean square of the residuals by quantity.
    runs : int
        Runs that were made, each with all derivatives.
    result : Result
        The run with the fitted values.
    residuals : Array
        Model less data over the scale of each quantity, all quantities one after the other.
    written : mapping of str to Unit
        Units of the file of those parameters to which it gives another than the SI unit.
    """

    parameters: Mapping[str, float]
    units: Mapping[str, str]
    errors: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    correlations: Array
    null: tuple[str, ...]
    notes: tuple[str, ...]
    deviations: Mapping[str, float]
    runs: int
    result: Result
    residuals: Array
    written: Mapping[str, Unit] = field(default_factory=dict)

    def __repr__(self) -> str:
        return "<Fit: " + ", ".join(f"{name} = {x:.6g}" for name, x in self.parameters.items()) + ">"

    def to_json(self) -> dict[str, Any]:
        """Return the fit as JSON data; numbers that are not finite become None."""
        from symgen.result.contract import json_value

        own = ("parameters", "units", "errors", "intervals", "null", "notes", "deviations", "runs")
        facts: dict[str, Any] = json_value(
            {name: getattr(self, name) for name in own} | {"correlations": self.correlations.tolist()}
        )
        return facts


class Identification:
    """Runs of a mechanism beside measured data, as functions of the numbers to be found.

    Parameters
    ----------
    mechanism, settings : Mechanism, Settings
        The model and how it runs.
    data : sequence of MeasuredData
        Measurements, each from a run of its own.
    free : mapping of str to (float or None, float or None)
        Numbers to be found, with their bounds.
    quantities : sequence of str
        Measured columns that count; all that the model has by default.
    bias : sequence of str
        Quantities measured with a constant error, which is found too.
    weights : mapping of str to float
        Factor of the residuals of a quantity; one over its deviation by default.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        settings: Settings,
        data: Sequence[MeasuredData],
        free: Mapping[str, Bounds],
        quantities: Sequence[str],
        bias: Sequence[str],
        weights: Mapping[str, float],
    ) -> None:
        self.bias, self.names = tuple(bias), tuple(free)
        own = lift_numbers("identify: free", mechanism, self.names)
        self.free = FreeNumbers("identify: free", own.mechanism, settings, own.keys)
        first, result = self.free.run(data[0].t.tolist())
        units = self._units_of_quantities(result, data, quantities)
        for name in (*bias, *weights):
            if name not in units:
                raise InputError("identify", "a measured quantity", quote(name), suggest(name, units))
        self.columns = Residuals(data, units, weights)
        self.left_out = () if quantities else _columns_left_out(result, data)
        biases = {f"bias of {name}": name for name in bias}
        self.units = {d.name: d.unit for d in first.directions}
        self.units |= {label: units[name] for label, name in biases.items()}
        start = [*self.free.values(first.directions, first.run, result), *(0.0 for _ in bias)]
        bounds = {**free, **dict.fromkeys(biases, (None, None))}
        self.ranges = make_ranges("identify: free", bounds, start, "the start")
        spread = [*(1.0 for _ in free), *(self.columns.deviation(name) for name in bias)]
        #: What a change of each number is measured by: its value at the start, or what there is of its kind.
        self.sizes = np.where(self.ranges.start != 0.0, np.abs(self.ranges.start), spread)
        if self.columns.count < len(bounds):
            got = f"{self.columns.count} for {len(bounds)} unknowns"
            raise InputError("identify: data", "at least as many numbers as unknowns", got)

    def _units_of_quantities(
        self, result: Result, data: Sequence[MeasuredData], quantities: Sequence[str]
    ) -> dict[str, str]:
        """Return the measured quantities that the model has, with its units."""
        measured = dict.fromkeys(name for each in data for name in each.columns)
        for name in quantities:
            if name not in measured:
                raise InputError("identify: quantities", "measured columns", quote(name), suggest(name, measured))
        chosen = tuple(quantities or (name for name in measured if name in result._places))
        if not chosen:
            expected = f"a column of {self.free.mechanism.name}, such as {result.q.names[0]}"
            hint = suggest(next(iter(measured)), result._places) if measured else ""
            got = ", ".join(map(quote, measured)) or "none"
            raise InputError(data[0].whence, expected, got, hint if hint.startswith("did") else "")
        return {name: place_of_column(result, name)[2] for name in chosen}

    def rows(self, x: Array) -> tuple[Array, Array]:
        """Return residuals and their derivatives; infinite ones where the model has no motion."""
        n, parts = len(self.names), list[tuple[Array, Array]]()
        for data in self.columns.data:
            if not (names := self.columns.names_in(data)):
                continue
            values, slopes = np.full((len(data.t), len(names)), np.inf), np.zeros((len(data.t), len(names), len(x)))
            with suppress(NoMotion):
                values, slopes[:, :, :n] = self.free.motion(x, data.t, names)
            for k, name in enumerate(self.bias, n):
                if name in names:
                    values[:, names.index(name)] += x[k]
                    slopes[:, names.index(name), k] = 1.0
            parts.append(self.columns.of_motion(data, values, slopes))
        residuals, derivatives = zip(*parts, strict=True)
        return np.concatenate(residuals), np.concatenate(derivatives)


def _columns_left_out(result: Result, data: Sequence[MeasuredData]) -> tuple[str, ...]:
    """Return a sentence on each measured column that the model does not have, with the nearest name that it has."""
    unknown = dict.fromkeys(name for each in data for name in each.columns if name not in result._places)
    hints = {name: suggest(name, result._places) for name in unknown}
    ends = {name: f"; {hint}" if hint.startswith("did you mean") else "" for name, hint in hints.items()}
    return tuple(f"column {quote(name)} of the data is left out: the model has none{ends[name]}" for name in unknown)


def fit_to_data(
    mechanism: Mechanism,
    settings: Settings,
    data: object,
    free: Mapping[str, Bounds] | Sequence[str],
    quantities: Sequence[str] = (),
    bias: Sequence[str] = (),
    weights: Mapping[str, float] | None = None,
) -> Fit:
    """Fit numbers of a model to measured data; arguments as for `symgen.analyses.kinds.identify.identify`.

    Raises
    ------
    InputError
        If an argument is wrong, or the data leave some of the numbers undetermined.
    AnalysisError
        If the search finds no run.
    """
    sources: list[object] = list(data) if isinstance(data, list | tuple) else [data]
    if not sources:
        raise InputError("identify: data", "measured columns", "none")
    bounds = read_bounds("identify: free", free)
    columns = [measured_columns(source, k) for k, source in enumerate(sources)]
    task = Identification(mechanism, settings, columns, bounds, quantities, bias, dict(weights or {}))
    rows = Remembering(task.rows)
    residuals, slopes = rows(task.ranges.start)
    if not np.all(np.isfinite(residuals)):
        raise AnalysisError(
            "identify: the model has no motion over the times of the data with the values it begins with"
        )
    before = null_directions(slopes, task.sizes, task.ranges.names)
    if before:
        expected = "numbers that the data determine"
        raise InputError("identify: free", expected, "; ".join(before), "leave one of them at a value that is known")
    return _fit_with_statistics(task, least_squares_within(rows, task.ranges.start, task.ranges.low, task.ranges.high))


def _fit_with_statistics(task: Identification, found: LeastSquares) -> Fit:
    """Return a fit with its statistics."""
    x, labels, notes = found.x, task.ranges.names, [*task.free.mechanism.remarks]
    known = determine(found, np.where(x != 0.0, np.abs(x), task.sizes), labels)
    if not found.is_still:
        notes.append(f"the search ended after {plural(found.steps, 'step')} before it was still")
    for name, value, (low, high), met in zip(labels, x, known.intervals, found.at_bound, strict=True):
        if met:
            notes.append(f"{name} meets its bound {value:.6g}: its interval is one-sided")
        elif 0.5 * (high - low) > abs(value) > 0.0 and name in task.names:
            notes.append(f"the data do not determine {name}: its interval is wider than its value")
    deviations = task.columns.by_column(found.residuals)
    notes += [*task.columns.gaps_in_words(), *task.left_out]
    notes += notes_on_neighbours(deviations, {name: task.columns.deviation(name) for name in deviations})
    notes += literal_points_in_words(task.names)
    _, result = task.free.run(task.columns.data[0].t.tolist(), x)
    if result.status == "unverified":
        notes.append(f"derivatives are in doubt: {result.reason}")
    return Fit(
        parameters=dict(zip(labels, x.tolist(), strict=True)),
        units={name: task.units[name] for name in labels},
        errors=dict(zip(labels, known.errors.tolist(), strict=True)),
        intervals=dict(zip(labels, known.intervals, strict=True)),
        correlations=known.correlations,
        null=known.null,
        notes=tuple(notes),
        deviations={name: float(np.sqrt(np.mean(np.concatenate(p) ** 2))) for name, p in deviations.items()},
        runs=task.free.runs,
        result=result,
        residuals=found.residuals,
        written={p.name: p.own_unit for p in task.free.mechanism.parameters if p.shown},
    )
