"""Results of a comparison: rows, curves over time, and their study, as JSON, CSV and data frame."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any, TypedDict, cast, overload

import msgspec

from symgen.base.arguments import one_of, words
from symgen.base.errors import InputError
from symgen.base.files import check_writable, headed, write_csv
from symgen.result.contract import json_value
from symgen.result.labelled import notebook_table
from symgen.result.plot import Plot, plotted
from symgen.result.result import FAILED, OK, UNVERIFIED
from symgen.study.comparison.equal_error import TimeAtError, front
from symgen.study.saving import save_study

if TYPE_CHECKING:
    import pandas as pd

#: Ratios of run time are to this method, with the same integrator and the same step or tolerance.
YARDSTICK = "lagrange"


#: Units of columns.
UNITS = {
    **dict.fromkeys(("step", "gradient_seconds", "run_seconds", "run_seconds_spread", "run_seconds_median"), "s"),
    **{"error": "m", "velocity_error": "m/s", "reaction_error": "N", "energy_drift_max": "J"},
    **{"dissipated": "J", "creep": "m/s"},
    **{
        f"{level}_violation_{kind}": unit
        for level, unit in (("position", "m"), ("velocity", "m/s"), ("acceleration", "m/s^2"))
        for kind in ("max", "rms", "final")
    },
}


@dataclass(frozen=True)
class Row:
    """One method with one integrator at one step or tolerance.

    Violations are Euclidean norms of Phi, ``D v - nu`` and ``D v' - gamma``, in metres and radians as they are. The
    largest ones of position and velocity are over all accepted steps and outputs; those of acceleration, the roots of
    the mean squares and the final ones are over the outputs.

    Attributes
    ----------
    method, integrator : str
        What was run.
    step, rtol : float or None
        Constant step [s], or relative tolerance.
    status, reason
        As of a result; a failed run stays a row.
    beyond_limits : bool
        Whether the run is `failed` because it exceeded one of its limits, and the row measures it to its end without
        them.
    error : float or None
        Largest distance to the reference [m] over bodies, output times and points (`symgen.result.points`); None for a
        run that did not reach its end, and where there is no reference.
    relative_error : float or None
        The same as a share of the mechanism's length, `Study.length`.
    velocity_error : float or None
        Largest difference of the velocities of the same points [m/s].
    reaction_error : float or None
        Largest difference of a joint's reaction [N] that the motion determines; a moment counts as the force
        that has it at the mechanism's length. None also where no reaction is determined, with dry friction and stops.
    below_reference : bool
        Whether the error is below the estimated error of the reference, which is then its only bound.
    run_seconds, run_seconds_median : float
        Shortest of several runs after a warm-up, and median [s].
    run_seconds_spread : float or None
        Longest minus shortest of them [s]; None for one run.
    cost_ratio, cost_ratio_spread : float or None
        Run time over `lagrange`'s with the same integrator and step or tolerance, and its spread: the ratio
        times the sum of both runs' median less shortest time over shortest time (the longest time shows only the
        other load of the machine). None where one of them failed or `lagrange` was not run; of one run no spread.
    evaluations, iterations : int
        Right-hand sides, and iterations of laws, corrections and implicit stages.
    position_violation_max, velocity_violation_max, acceleration_violation_max : float
        Largest violations [m, m/s, m/s^2].
    position_violation_rms, velocity_violation_rms, acceleration_violation_rms : float or None
        Roots of their mean squares; None where a run gave no output.
    position_violation_final, velocity_violation_final, acceleration_violation_final : float or None
        At the last output.
    energy_drift_max : float
        Largest energy error [J].
    warnings : tuple of str
        Warnings as sentences.
    coordinates : {"absolute", "joint"}
        Coordinates of the state. Violations of joint coordinates are violations of the loops.
    variant : str
        Options that distinguish the method from others of the study, such as ``alpha=5, beta=5``.
    law : str
        Law of dry friction, such as ``tanh:speed=0.001``; empty without dry friction and stops.
    transitions, impacts : int or None
        Changes of modes of dry friction and stops, and impacts; None without these, as the next ones.
    dissipated : float or None
        Energy that they have taken at the end [J].
    creep : float or None
        Largest rate along a coordinate with dry friction at outputs at which it rests in the reference [m/s]; of an
        angle times the mechanism's length. None where none rests.
    gradient_error : float or None
        Largest error of the derivatives of coordinates by a parameter, over the largest derivative; angles count by the
        mechanism's length. None without `gradient`, and for schemes without derivatives.
    gradient_seconds : float or None
        Run time with these derivatives [s].
    """

    method: str
    integrator: str
    step: float | None
    rtol: float | None
    status: str
    reason: str | None
    error: float | None
    below_reference: bool
    run_seconds: float
    run_seconds_spread: float | None
    evaluations: int
    position_violation_max: float
    velocity_violation_max: float
    energy_drift_max: float
    warnings: tuple[str, ...] = ()
    iterations: int = 0
    run_seconds_median: float = 0.0
    cost_ratio: float | None = None
    cost_ratio_spread: float | None = None
    acceleration_violation_max: float | None = None
    position_violation_rms: float | None = None
    velocity_violation_rms: float | None = None
    acceleration_violation_rms: float | None = None
    position_violation_final: float | None = None
    velocity_violation_final: float | None = None
    acceleration_violation_final: float | None = None
    coordinates: str = "absolute"
    variant: str = ""
    beyond_limits: bool = False
    relative_error: float | None = None
    velocity_error: float | None = None
    reaction_error: float | None = None
    law: str = ""
    transitions: int | None = None
    impacts: int | None = None
    dissipated: float | None = None
    creep: float | None = None
    gradient_error: float | None = None
    gradient_seconds: float | None = None

    @property
    def label(self) -> str:
        """Method with its variant, and the coordinates unless absolute: ``lagrange, joint``."""
        law = "" if self.law == "exact" else self.law
        parts = self.method, self.variant, law, "" if self.coordinates == "absolute" else self.coordinates
        return ", ".join(filter(None, parts))

    @property
    def setting(self) -> tuple[str, float | None, float | None]:
        """Integrator, step and tolerance; run times are comparable between methods that share them."""
        return self.integrator, self.step, self.rtol

    @property
    def ended(self) -> bool:
        """Whether the run reached its end."""
        return self.status != FAILED or self.beyond_limits

    @property
    def status_text(self) -> str:
        """Status with its mark, which `BEYOND` explains."""
        return f"{self.status} +" if self.beyond_limits else self.status

    def texts(self) -> list[str]:
        """Return the fields as the cells of a table; None is empty."""
        return ["" if x is None else "; ".join(x) if isinstance(x, tuple) else str(x) for x in asdict(self).values()]


@dataclass(frozen=True)
class Trace:
    """Quantities of one run at its outputs, for drawing: five digits.

    Attributes
    ----------
    t : tuple of float
        Times [s].
    error : tuple of float
        Distance to the reference [m]; empty where there is none.
    position, velocity, acceleration : tuple of float
        Violations [m, m/s, m/s^2].
    kinetic, potential, energy_error : tuple of float
        Energies [J]; the last is T + V - E0 - W.
    """

    t: tuple[float, ...] = ()
    error: tuple[float, ...] = ()
    position: tuple[float, ...] = ()
    velocity: tuple[float, ...] = ()
    acceleration: tuple[float, ...] = ()
    kinetic: tuple[float, ...] = ()
    potential: tuple[float, ...] = ()
    energy_error: tuple[float, ...] = ()


#: Values that are not JSON numbers.
_NOT_FINITE = ("nan", "inf", "-inf")


def to_entry(row: Row, trace: Trace) -> dict[str, Any]:
    """Return a row with its curves as JSON values; numbers that are not finite are texts."""

    def expressed(value: Any) -> Any:
        if isinstance(value, tuple):
            return [expressed(x) for x in value]
        return str(value) if isinstance(value, float) and not math.isfinite(value) else value

    return {
        what: {name: expressed(value) for name, value in asdict(part).items()}
        for what, part in (("row", row), ("trace", trace))
    }


def from_entry(entry: Mapping[str, Any]) -> tuple[Row, Trace]:
    """Return the row and the curves of an entry."""

    def plain(value: Any) -> Any:
        if isinstance(value, list):
            return tuple(plain(x) for x in value)
        return float(value) if value in _NOT_FINITE else value

    values, curves = ({name: plain(value) for name, value in entry[what].items()} for what in ("row", "trace"))
    return Row(**values), Trace(**curves)


class _Entry(TypedDict):
    row: Row
    trace: Trace


def check_entry(entry: Mapping[str, Any]) -> None:
    """Raise `ValueError` unless `from_entry` can read an entry of a journal."""
    row = msgspec.convert(entry, _Entry, strict=False)["row"]
    unknown = {*entry["row"], *entry["trace"]} - {f.name for part in (Row, Trace) for f in fields(part)}
    if unknown or row.status not in (OK, UNVERIFIED, FAILED):
        raise ValueError(row.status)


def with_ratios(rows: Sequence[Row]) -> tuple[Row, ...]:
    """Return the rows with cost ratios, which need the rows of `YARDSTICK`."""
    # with both coordinates the first requested ones are the yardstick, so that ratios distinguish them
    usable = [row for row in rows if row.method == YARDSTICK and row.ended and row.run_seconds > 0.0]
    base = {row.setting: row for row in reversed(usable)}
    rated = []
    for row in rows:
        other = base.get(row.setting)
        if other is None or not row.ended or row.run_seconds <= 0.0:
            rated.append(replace(row, cost_ratio=None, cost_ratio_spread=None))
            continue
        ratio = row.run_seconds / other.run_seconds
        parts = [max(r.run_seconds_median - r.run_seconds, 0.0) / r.run_seconds for r in (row, other)]
        # the yardstick's ratio to itself is 1 however its run time varies
        spread = 0.0 if row is other else ratio * sum(parts)
        single = row.run_seconds_spread is None or other.run_seconds_spread is None
        rated.append(replace(row, cost_ratio=ratio, cost_ratio_spread=None if single else spread))
    return tuple(rated)


#: Meaning of the mark of a row that is `Row.beyond_limits`.
BEYOND = "+ exceeded a limit of a run; measured to its end without limits"
#: Meaning of the mark of a row on the front.
FRONT = "^ on the front: no other row is both faster and more accurate"
#: In place of the spread of run times, where each was measured once.
ONE_RUN = "one run: no spread"


@dataclass(frozen=True, repr=False)
class Study:
    """Rows of one mechanism against one reference.

    Attributes
    ----------
    mechanism : str
        Name of the mechanism.
    how : str
        Source of the reference.
    estimated_error : float
        Estimated error of the reference [m]; nan without a reference.
    until : float
        End time [s].
    rows : tuple of Row
        In the order of methods, integrators, steps or tolerances.
    interrupted : bool
        Whether rows are missing because the study was stopped.
    traces : tuple of Trace
        Curves over time, one a row.
    note : str
        Note on the reference: that its two runs part at a singular position, or why there is none; empty otherwise.
    title, digest : str
        Title and digest of the mechanism.
    step : float
        The mechanism's own step [s].
    parameters, options, start : mapping
        Changed values.
    repeat : int
        Least number of timed runs a row.
    length, speed, reaction : float or None
        Scales of errors, of the reference: the mechanism's length [m], the largest speed of a point [m/s] and the
        largest reaction [N]; None where there is none.
    at : tuple of TimeAtError
        Run times of the lines at the errors asked for.
    """

    mechanism: str
    how: str
    estimated_error: float
    until: float
    rows: tuple[Row, ...]
    interrupted: bool = False
    traces: tuple[Trace, ...] = ()
    note: str = ""
    title: str = ""
    digest: str = ""
    step: float = 1e-3
    parameters: Mapping[str, float] = field(default_factory=dict)
    options: Mapping[str, str | float] = field(default_factory=dict)
    repeat: int = 1
    start: Mapping[str, float] = field(default_factory=dict)
    length: float | None = None
    speed: float | None = None
    reaction: float | None = None
    at: tuple[TimeAtError, ...] = ()

    def __repr__(self) -> str:
        methods = len({row.label for row in self.rows})
        return f"<Study of {self.mechanism}, {self.until:g} s: {len(self.rows)} rows of {methods} methods; {self.how}>"

    def _repr_html_(self) -> str:
        headings = (
            "method",
            "integrator",
            "step or rtol",
            "status",
            "error [m]",
            "run [ms]",
            "time / lagrange",
            "|Phi|",
        )
        rows = [
            (
                *(row.label, row.integrator),
                f"rtol {row.rtol:g}" if row.rtol is not None else f"{row.step:g} s",
                row.status_text,
                "" if row.error is None else f"{row.error:.2e}",
                f"{1e3 * row.run_seconds:.3f}",
                "" if row.cost_ratio is None else f"{row.cost_ratio:.2f}",
                f"{row.position_violation_max:.1e}",
            )
            for row in self.rows
        ]
        return notebook_table(headings, rows, most=60)

    @cached_property
    def front(self) -> frozenset[int]:
        """Indices of the rows that no other row surpasses in both error and run time."""
        return front(self.rows, self.estimated_error)

    @property
    def failed(self) -> bool:
        """Whether no run reached its end."""
        return not any(row.ended for row in self.rows)

    @property
    def common_warnings(self) -> tuple[str, ...]:
        """Warnings that every row has, such as warnings of the start, to be shown once."""
        first = self.rows[0].warnings if self.rows else ()
        return tuple(text for text in first if all(text in row.warnings for row in self.rows))

    @property
    def is_repeated(self) -> bool:
        """Whether run times have a spread."""
        return any(row.run_seconds_spread is not None for row in self.rows)

    @property
    def ratio_spreads(self) -> tuple[float, float] | None:
        """Median and largest spread of cost ratios, as fractions of the ratios; None without ratios."""
        shares = [r.cost_ratio_spread / r.cost_ratio for r in self.rows if r.cost_ratio_spread and r.cost_ratio]
        return (median(shares), max(shares)) if shares else None

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen compare --json``; numbers that are not finite become None."""
        contract = {
            "mechanism": self.mechanism,
            "digest": self.digest,
            "until": self.until,
            "reference": {
                **{"how": self.how, "estimated_error": self.estimated_error, "note": self.note or None},
                **{"length": self.length, "speed": self.speed, "reaction": self.reaction},
            },
            "interrupted": self.interrupted,
            "rows": [asdict(row) | {"on_front": i in self.front} for i, row in enumerate(self.rows)],
            "at": [asdict(time) for time in self.at],
        }
        return cast(dict[str, Any], json_value(contract))

    def to_dataframe(self) -> pd.DataFrame:
        """Return the rows as a pandas data frame."""
        from symgen.base.files import need

        need("to_dataframe", "pandas")
        import pandas as pd

        return pd.DataFrame([asdict(row) for row in self.rows], columns=[f.name for f in fields(Row)])

    @overload
    def plot(self, path: None = None, what: Sequence[str] = ("error",), over: str = "run_seconds") -> Plot: ...

    @overload
    def plot(self, path: str | PathLike[str], what: Sequence[str] = ("error",), over: str = "run_seconds") -> Path: ...

    def plot(
        self, path: str | PathLike[str] | None = None, what: Sequence[str] = ("error",), over: str = "run_seconds"
    ) -> Plot | Path:
        """Draw columns of the rows over another one: a figure, or a PNG, SVG or PDF file.

        Each method with each integrator has a line.

        Parameters
        ----------
        path : path, optional
            The file; its ending says the kind. Without one the figure comes back, which notebooks show.
        what : sequence of str
            Columns of numbers: ``error``, ``energy_drift_max``, ``evaluations``, ...
        over : str
            Column of numbers on the other axis.

        Raises
        ------
        InputError
            If a column does not exist, the suffix is not supported, matplotlib is missing, or writing fails.
        """
        return plot_rows([self], path, what, over)

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the rows to a ``.csv`` file, or the report to ``.html``, ``.pdf`` or ``.md``; whole or not at all.

        Raises
        ------
        InputError
            If the ending is another, matplotlib is missing for a report, or the file cannot be written.
        """
        return save_study(self, path, lambda file: save_csv([self], file))


def check_columns_of_rows(what: Sequence[str], over: str) -> tuple[str, ...]:
    """Return the columns of numbers to draw.

    Raises
    ------
    InputError
        If a column does not exist; names the nearest one.
    """
    numbers = [f.name for f in fields(Row) if str(f.type).startswith(("float", "int"))]
    for name in (*words("plot", what), over):
        one_of("plot", name, numbers)
    return words("plot", what)


def plot_rows(
    studies: Sequence[Study], path: str | PathLike[str] | None, what: Sequence[str], over: str
) -> Plot | Path:
    """Draw columns of the rows of studies over another one, a panel for each study and column; see `Study.plot`."""
    names = check_columns_of_rows(what, over)
    return plotted(path, lambda: _figure_of_rows(studies, names, over))


def _figure_of_rows(studies: Sequence[Study], names: Sequence[str], over: str) -> Any:
    from symgen.result.plots import empty, label, legend, style

    parts = [(study, name) for study in studies for name in names]
    figure, axes = empty(", ".join(f"{study.mechanism}, {study.until:g} s" for study in studies), len(parts))
    for ax, (study, name) in zip(axes, parts, strict=True):
        lines: dict[str, list[tuple[float, float]]] = {}
        for row in study.rows:
            x, y = getattr(row, over), getattr(row, name)
            if row.ended and x and y:  # a logarithm has no zero
                lines.setdefault(f"{row.label}, {row.integrator}", []).append((x, y))
        for i, (text, points) in enumerate(lines.items()):
            ax.plot(*zip(*points, strict=True), label=text, marker="o", markersize=3.5, **style(i))
        ax.set(xscale="log", yscale="log", ylabel=label(name.replace("_", " "), UNITS.get(name, "")))
        ax.set_title(study.mechanism if len(studies) > 1 else "", fontsize=8, loc="left")
        if lines:
            legend(ax)
    axes[-1].set_xlabel(label(over.replace("_", " "), UNITS.get(over, "")))
    return figure


def save_csv(studies: Sequence[Study], path: Path, units: bool = False) -> Path:
    """Write the rows of studies to one CSV file, with the mechanism in the first column, and units if requested."""
    if path.suffix.lower() != ".csv":
        raise InputError("save", "a file ending in .csv", f"'{path}'")
    check_writable("save", path)
    heading = ["mechanism", *(headed(f.name, UNITS.get(f.name, "")) if units else f.name for f in fields(Row))]
    return write_csv(path, heading, [[study.mechanism, *row.texts()] for study in studies for row in study.rows])
