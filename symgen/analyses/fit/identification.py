"""Parameters from measured data: least squares over whole runs, with exact derivatives of the runs that are made.

Before a fit, and after it, the singular values of the derivatives say which numbers the data cannot tell apart.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.fit.free_numbers import Bounds, FreeNumbers, arrays_of_bounds, names_with_bounds
from symgen.analyses.fit.measured_data import MeasuredData, measured_columns
from symgen.analyses.fit.neighbours import notes_on_neighbours
from symgen.analyses.fit.null_directions import null_directions
from symgen.base.errors import AnalysisError, AssemblyError, InputError, plural, quote, suggest
from symgen.describe.facts.lifted import lift_numbers, literal_points_in_words
from symgen.result.sensitivities import place_of_column
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.base.units import Unit
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result

Array = NDArray[np.float64]
#: Share of intervals that cover the value.
_COVERED = 0.95


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

        facts: dict[str, Any] = json_value(
            {
                "parameters": dict(self.parameters),
                "units": dict(self.units),
                "errors": dict(self.errors),
                "intervals": {name: list(pair) for name, pair in self.intervals.items()},
                "correlations": self.correlations.tolist(),
                "null": list(self.null),
                "notes": list(self.notes),
                "deviations": dict(self.deviations),
                "runs": self.runs,
            }
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
        self.data, self.bias, self.names = data, bias, tuple(free)
        own = lift_numbers("identify: free", mechanism, self.names)
        self.free = FreeNumbers("identify: free", own.mechanism, settings, own.keys)
        self._last: tuple[bytes, Array, Array] | None = None
        first, result = self.free.run(data[0].t.tolist())
        self.start = np.array([*self.free.values(first.directions, first.run, result), *(0.0 for _ in bias)])
        self.units = {d.name: d.unit for d in first.directions}
        self.quantities = self._choose_quantities(result, quantities)
        self.left_out = self._headings_left_out(result, quantities)
        units = {name: self._unit_of_quantity(result, name) for name in self.quantities}
        self.data = data = [each.in_units(units) for each in data]
        self.scales = {name: weights.get(name) or 1.0 / self.standard_deviation(name) for name in self.quantities}
        for name in (*bias, *weights):
            if name not in self.quantities:
                raise InputError("identify", "a measured quantity", quote(name), suggest(name, self.quantities))
            self.units[f"bias of {name}"] = self._unit_of_quantity(result, name)
        self.labels = (*self.names, *(f"bias of {name}" for name in bias))
        every = [*free.values(), *((None, None) for _ in bias)]
        self.bounds = arrays_of_bounds("identify: free", self.labels, every, self.start)
        count = sum(int(d.measured(name).sum()) for d in data for name in d.columns)
        if count < len(self.labels):
            got = f"{count} for {len(self.labels)} unknowns"
            raise InputError("identify: data", "at least as many numbers as unknowns", got)

    @property
    def sizes(self) -> Array:
        """What a change of each number is measured by: its value at the start, or what there is of its kind."""
        spread = [1.0] * len(self.names) + [self.standard_deviation(name) for name in self.bias]
        return np.where(self.start != 0.0, np.abs(self.start), spread)

    def _choose_quantities(self, result: Result, quantities: Sequence[str]) -> tuple[str, ...]:
        """Return the measured quantities that the model has."""
        measured = dict.fromkeys(name for data in self.data for name in data.columns)
        for name in quantities:
            if name not in measured:
                raise InputError("identify: quantities", "measured columns", quote(name), suggest(name, measured))
        chosen = tuple(quantities or (name for name in measured if name in result._places))
        if not chosen:
            expected = f"a column of {self.free.mechanism.name}, such as {result.q.names[0]}"
            hint = suggest(next(iter(measured)), result._places) if measured else ""
            got = ", ".join(map(quote, measured)) or "none"
            raise InputError(self.data[0].whence, expected, got, hint if hint.startswith("did") else "")
        for name in chosen:
            place_of_column(result, name)
        return chosen

    def _headings_left_out(self, result: Result, quantities: Sequence[str]) -> tuple[str, ...]:
        """Return a sentence on each measured column that the model does not have, with the nearest name that it has."""
        if quantities:
            return ()
        unknown = dict.fromkeys(name for data in self.data for name in data.columns if name not in result._places)
        hints = {name: suggest(name, result._places) for name in unknown}
        ends = {name: f"; {hint}" if hint.startswith("did you mean") else "" for name, hint in hints.items()}
        return tuple(
            f"column {quote(name)} of the data is left out: the model has none{ends[name]}" for name in unknown
        )

    def standard_deviation(self, name: str) -> float:
        """Return the standard deviation of measured numbers, or their size where they do not change."""
        values = np.concatenate([d.columns[name][d.measured(name)] for d in self.data if name in d.columns])
        if not len(values):
            raise InputError(self.data[0].whence, f"numbers of {quote(name)}", "none")
        return float(np.std(values)) or float(np.abs(values).max(initial=0.0)) or 1.0

    @staticmethod
    def _unit_of_quantity(result: Result, name: str) -> str:
        return place_of_column(result, name)[2]

    def residuals_and_slopes(self, x: Array) -> tuple[Array, Array]:
        """Return residuals and their derivatives; infinite ones where the model has no motion."""
        if self._last is None or self._last[0] != x.tobytes():
            self._last = x.tobytes(), *self._compute_residuals_and_slopes(x)
        return self._last[1], self._last[2]

    def residuals(self, x: Array) -> Array:
        """Return residuals."""
        return self.residuals_and_slopes(x)[0]

    def slopes(self, x: Array) -> Array:
        """Return the derivatives of residuals."""
        return self.residuals_and_slopes(x)[1]

    def result_at(self, x: Array, data: MeasuredData) -> Result:
        """Return the run with values of the free numbers."""
        return self.free.run(data.t.tolist(), x)[1]

    def _compute_residuals_and_slopes(self, x: Array) -> tuple[Array, Array]:
        residuals, slopes = list[Array](), list[Array]()
        for data in self.data:
            try:
                result = self.result_at(x, data)
            except (InputError, AssemblyError):
                result = None
            whole = result is not None and len(result.t) == len(data.t) and result.outcome.code == abi.DONE
            for name in self.quantities:
                if name not in data.columns:
                    continue
                by, known = np.zeros((len(data.t), len(self.labels))), data.measured(name)
                if not whole or result is None:
                    residuals.append(np.full(int(known.sum()), np.inf))
                else:
                    table, place, _ = place_of_column(result, name)
                    values = getattr(result, table).values[:, place]
                    by[:, : len(self.names)] = result.gradient(name).values
                    if name in self.bias:
                        k = len(self.names) + list(self.bias).index(name)
                        by[:, k], values = 1.0, values + x[k]
                    residuals.append(self.scales[name] * (values - data.columns[name])[known])
                slopes.append(self.scales[name] * by[known])
        return np.concatenate(residuals), np.concatenate(slopes)


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
    from scipy.optimize import least_squares

    sources: list[object] = list(data) if isinstance(data, list | tuple) else [data]
    if not sources:
        raise InputError("identify: data", "measured columns", "none")
    bounds = names_with_bounds("identify: free", free)
    columns = [measured_columns(source, k) for k, source in enumerate(sources)]
    task = Identification(mechanism, settings, columns, bounds, quantities, bias, dict(weights or {}))
    residuals, slopes = task.residuals_and_slopes(task.start)
    if not np.all(np.isfinite(residuals)):
        raise AnalysisError(
            "identify: the model has no motion over the times of the data with the values it begins with"
        )
    before = null_directions(slopes, task.sizes, task.labels)
    if before:
        expected = "numbers that the data determine"
        raise InputError("identify: free", expected, "; ".join(before), "leave one of them at a value that is known")
    solution = least_squares(
        task.residuals,
        task.start,
        jac=task.slopes,
        bounds=task.bounds,
        method="trf",
        x_scale=task.sizes,
        xtol=1e-12,
        ftol=1e-12,
        gtol=1e-12,
        max_nfev=100,
    )
    return _fit_with_statistics(task, solution)


def _fit_with_statistics(task: Identification, solution: Any) -> Fit:
    """Return a fit with its statistics."""
    from scipy.stats import t as student

    x, (residuals, slopes), labels = solution.x, task.residuals_and_slopes(solution.x), task.labels
    sizes = np.where(x != 0.0, np.abs(x), task.sizes)
    null, notes = null_directions(slopes, sizes, labels), [*task.free.mechanism.remarks]
    if solution.status == 0:
        notes.append(f"the search ended after {plural(solution.nfev, 'step')} before it was still")
    active = solution.active_mask != 0
    free, count = np.flatnonzero(~active), len(residuals) - len(labels)
    errors, correlations = np.full(len(x), np.nan), np.full((len(x), len(x)), np.nan)
    variance = float(residuals @ residuals) / count if count > 0 else math.nan
    if len(free) and not null:
        scaled = slopes[:, free] * sizes[free]
        covariance = np.linalg.pinv(scaled.T @ scaled) * variance * np.outer(sizes[free], sizes[free])
        errors[free] = np.sqrt(np.diag(covariance))
        spread = np.outer(errors[free], errors[free])
        correlations[np.ix_(free, free)] = covariance / np.where(spread > 0.0, spread, np.nan)
    factor = float(student.ppf(0.5 + 0.5 * _COVERED, count)) if count > 0 else math.nan
    intervals = dict[str, tuple[float, float]]()
    for i, name in enumerate(labels):
        half = factor * errors[i]
        intervals[name] = (float(x[i] - half), float(x[i] + half))
        if active[i]:
            low = solution.active_mask[i] < 0
            intervals[name] = (float(x[i]), math.nan) if low else (math.nan, float(x[i]))
            notes.append(f"{name} meets its bound {x[i]:.6g}: its interval is one-sided")
        elif half > abs(x[i]) > 0.0 and not name.startswith("bias of "):
            notes.append(f"the data do not determine {name}: its interval is wider than its value")
    deviations, first = dict[str, list[Array]](), 0
    for data in task.data:
        for name in task.quantities:
            if name in data.columns:
                count = int(data.measured(name).sum())
                deviations.setdefault(name, []).append(residuals[first : first + count] / task.scales[name])
                first += count
    gaps = {
        name: sum(int((~data.measured(name)).sum()) for data in task.data if name in data.columns)
        for name in deviations
    }
    notes += [f"{plural(n, 'cell')} of {quote(name)} without a number left out" for name, n in gaps.items() if n]
    notes += task.left_out
    notes += notes_on_neighbours(deviations, {name: task.standard_deviation(name) for name in deviations})
    notes += literal_points_in_words(task.names)
    result = task.result_at(x, task.data[0])
    if result.status == "unverified":
        notes.append(f"derivatives are in doubt: {result.reason}")
    return Fit(
        parameters={name: float(value) for name, value in zip(labels, x, strict=True)},
        units={name: task.units[name] for name in labels},
        errors={name: float(value) for name, value in zip(labels, errors, strict=True)},
        intervals=intervals,
        correlations=correlations,
        null=null,
        notes=tuple(notes),
        deviations={name: float(np.sqrt(np.mean(np.concatenate(p) ** 2))) for name, p in deviations.items()},
        runs=task.free.runs,
        result=result,
        residuals=residuals,
        written={p.name: p.own_unit for p in task.free.mechanism.parameters if p.shown},
    )
