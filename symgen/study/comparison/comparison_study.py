"""The study of a comparison: its rows and curves with marks, as JSON, CSV, data frame and plots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from functools import cached_property
from os import PathLike
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any, ClassVar, cast, overload

from symgen.base.arguments import one_word_of, words
from symgen.base.errors import InputError, plural
from symgen.base.files import check_writable, heading_with_unit, write_csv
from symgen.result.contract import json_value
from symgen.result.labelled import notebook_table
from symgen.result.plot import Plot, draw_or_save
from symgen.study.comparison.comparison_rows import UNITS, Row, Trace
from symgen.study.comparison.equal_error import TimeAtError, pareto_front
from symgen.study.saving import save_study

if TYPE_CHECKING:
    import pandas as pd

#: Marks of integrators in a plot.
MARKS = "os^Dv<>P"
#: Meaning of the mark of a row that is `Row.beyond_limits`.
BEYOND = "+ exceeded a limit of a run; measured to its end without limits"
#: Meaning of the mark of a row on the front.
FRONT = "^ on the front: no other row is both faster and more accurate"
#: Meaning of the mark of a run time that is `Row.disturbed`.
LOADED = "! other work had the processor for long, twice: the time on the wall was above 1.5 times the processor time"
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

    report_kind: ClassVar[str] = "comparison-report"

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
        counts = f"{plural(len(self.rows), 'row')} of {plural(methods, 'method')}"
        return f"<Study of {self.mechanism}, {self.until:g} s: {counts}; {self.how}>"

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
        return pareto_front(self.rows, self.estimated_error)

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
        """Median and largest ± of cost ratios, as fractions of the ratios; None without ratios."""
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
        from symgen.base.files import need_library

        need_library("to_dataframe", "pandas")
        import pandas as pd

        return pd.DataFrame([asdict(row) for row in self.rows], columns=[f.name for f in fields(Row)])

    @overload
    def plot(self, path: None = None, what: Sequence[str] = ("error",), over: str = "run_seconds") -> Plot: ...

    @overload
    def plot(self, path: str | PathLike[str], what: Sequence[str] = ("error",), over: str = "run_seconds") -> Path: ...

    def plot(
        self, path: str | PathLike[str] | None = None, what: Sequence[str] = ("error",), over: str = "run_seconds"
    ) -> Plot | Path:
        """Draw columns of the rows over another one: a figure, or a PNG, SVG, PDF or PGF file.

        Each method has a colour, and each integrator a mark. Errors are drawn down to a tenth of the reference's.

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
        one_word_of("plot", name, numbers)
    return words("plot", what)


def plot_rows(
    studies: Sequence[Study],
    path: str | PathLike[str] | None,
    what: Sequence[str],
    over: str,
    width: float | None = None,
) -> Plot | Path:
    """Draw columns of the rows of studies over another one, a panel for each study and column; see `Study.plot`."""
    names = check_columns_of_rows(what, over)
    return draw_or_save(path, lambda: _figure_of_rows(studies, names, over), width)


def _figure_of_rows(studies: Sequence[Study], names: Sequence[str], over: str) -> Any:
    from symgen.result.plots import axis_label, empty_figure, line_style_of, place_legend

    parts = [(study, name) for study in studies for name in names]
    labels = list(dict.fromkeys(row.label for study in studies for row in study.rows))
    integrators = list(dict.fromkeys(row.integrator for study in studies for row in study.rows))
    figure, axes = empty_figure(", ".join(f"{study.mechanism}, {study.until:g} s" for study in studies), len(parts))
    for ax, (study, name) in zip(axes, parts, strict=True):
        lines: dict[tuple[str, str], list[tuple[float, float]]] = {}
        least = {"error": 0.1 * study.estimated_error}  # below its reference an error is not known
        for row in study.rows:
            x, y = (max(getattr(row, what) or 0.0, least.get(what, 0.0)) for what in (over, name))
            if row.ended and x and y:  # a logarithm has no zero
                lines.setdefault((row.label, row.integrator), []).append((x, y))
        for (label, integrator), points in lines.items():
            mark = {"marker": MARKS[integrators.index(integrator) % len(MARKS)], "markersize": 3.5}
            ax.plot(*zip(*points, strict=True), **line_style_of(labels.index(label)) | mark)
        own = dict.fromkeys(label for label, _ in lines)
        for label in own:
            ax.plot([], [], label=label, **line_style_of(labels.index(label)))
        for integrator in dict.fromkeys(x for _, x in lines) if len(integrators) > 1 else ():
            ax.plot([], [], MARKS[integrators.index(integrator) % len(MARKS)], color="#5b6470", label=integrator)
        ax.set(xscale="log", yscale="log", ylabel=axis_label(_words_of_column(name), UNITS.get(name, "")))
        ax.set_title(study.mechanism if len(studies) > 1 else "", fontsize=8, loc="left")
        if lines:
            place_legend(ax)
    axes[-1].set_xlabel(axis_label(_words_of_column(over), UNITS.get(over, "")))
    return figure


def _words_of_column(name: str) -> str:
    """Return a column in words: ``run time`` for its seconds."""
    return name.replace("seconds", "time").replace("_", " ")


def save_csv(studies: Sequence[Study], path: Path, units: bool = False) -> Path:
    """Write the rows of studies to one CSV file, with the mechanism in the first column, and units if requested."""
    if path.suffix.lower() != ".csv":
        raise InputError("save", "a file ending in .csv", f"'{path}'")
    check_writable("save", path)
    heading = [
        "mechanism",
        *(heading_with_unit(f.name, UNITS.get(f.name, "")) if units else f.name for f in fields(Row)),
    ]
    return write_csv(path, heading, [[study.mechanism, *row.texts()] for study in studies for row in study.rows])
