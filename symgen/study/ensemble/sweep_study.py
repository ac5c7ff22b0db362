"""Results of an ensemble: counts, reasons, and a labelled data set over its axes and time."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from symgen.base.arguments import kind_of_value, text, whole_number, words
from symgen.base.arguments import path_argument as argument_path
from symgen.base.errors import InputError, plural, suggest
from symgen.base.files import check_path, need_library, write_csv, write_whole
from symgen.base.version import __version__
from symgen.describe.bounds.bounded_modes import mode_events
from symgen.result.contract import json_value
from symgen.result.export import netcdf_writer
from symgen.result.labelled import notebook_table
from symgen.result.plot import Plot, draw_or_save
from symgen.result.result import FAILED, OK, UNVERIFIED
from symgen.run.compiling.events import bounded_names
from symgen.run.layout.ensemble_abi import ASSEMBLED
from symgen.study.ensemble.axes import Grid
from symgen.study.ensemble.lines import table_lines
from symgen.study.ensemble.locked_rows import dead_centres_of_rows
from symgen.study.ensemble.row_quantities import NUMBERS, event_columns
from symgen.study.ensemble.samples import contributions
from symgen.study.ensemble.unmoved_axes import unmoved_axes
from symgen.study.ensemble.varied_names import Names
from symgen.study.ensemble.verdicts import NOT_RUN, EventNames, judge_runs, summary_column, warnings_of_runs

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from symgen.study.ensemble.ensemble import Ensemble
    from symgen.study.ensemble.row_sensitivities import RowSensitivities

Array = NDArray[np.float64]

#: Endings of files -> the libraries needed.
SAVED: Mapping[str, tuple[str, ...]] = {".nc": ("xarray", "h5netcdf", "h5py"), ".csv": ()}


@dataclass(frozen=True, repr=False)
class Sweep:
    """Results of an ensemble; arrays have one row a run, in the order of the grid, whose last axis changes fastest.

    Attributes
    ----------
    ensemble : Ensemble
        The ensemble.
    values : Array, shape (runs, quantities, times)
        Quantities at the output times; nan where a run did not get there.
    summary : Array, shape (runs, N_SUMMARY + width)
        Numbers of every run; see `symgen.run.layout.ensemble_abi`.
    done : Array of bool, shape (runs,)
        Which runs have been done: all, unless it was interrupted.
    seconds : float
        Run time of all runs, without compilation [s].
    interrupted : bool
        Whether it was stopped from outside.
    """

    ensemble: Ensemble
    values: Array
    summary: Array
    done: NDArray[np.bool_]
    seconds: float
    interrupted: bool

    def __len__(self) -> int:
        return len(self.ensemble)

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {status}" for status, count in self.counts.items() if count)
        return f"<Sweep of {self.ensemble.model.name}: {plural(len(self), 'run')}, {counts}>"

    def _repr_html_(self) -> str:
        facts = [("mechanism", self.ensemble.model.name), ("runs", str(len(self)))]
        for axis in self.ensemble.grid.axes:
            facts += [
                (name, f"{plural(len(x), 'value')} from {x.min():g} to {x.max():g}") for name, x in axis.values.items()
            ]
        names = [q.name for q in self.ensemble.recipe.kept]
        facts.append(("quantities", ", ".join(names[:8]) + ", ..." * (len(names) > 8)))
        facts += [(status, str(count)) for status, count in self.counts.items() if count]
        return notebook_table((), [*facts, ("seconds", f"{self.seconds:.3g}")])

    @cached_property
    def _verdicts(self) -> tuple[NDArray[np.str_], NDArray[np.object_]]:
        compiled = self.ensemble.compiled
        recipe, events = self.ensemble.recipe, self.ensemble.events
        rows = None if recipe.watch is None else bounded_names(recipe.tree or recipe.watch.mechanism)
        modes = () if recipe.watch is None else mode_events(recipe.tree or recipe.watch.mechanism)
        named = EventNames(events, rows, recipe.tree is not None, tuple(event.name for event in modes))
        status, reason = judge_runs(self.summary, self.done, compiled.info, compiled.law, recipe.spec, named)
        if recipe.judged is not None:
            recipe.judged.doubt(status, reason, self.summary)
        failed = self.done & (summary_column(self.summary, "start") != ASSEMBLED)
        for row, why in self.ensemble.driving.rows_refused(self.ensemble, failed):
            reason[row] = why
        return status, reason

    @cached_property
    def events(self) -> dict[str, tuple[int, str]]:
        """Numbers of every run about events, by name: their columns in `summary` and units."""
        return event_columns(self.ensemble.events)

    @property
    def status(self) -> NDArray[np.str_]:
        """Status of every run: ``ok``, ``unverified``, ``failed``, or ``not run`` where it was interrupted."""
        return self._verdicts[0]

    @cached_property
    def reason(self) -> NDArray[np.object_]:
        """Why a run is not ok, empty where it is."""
        reasons = self._verdicts[1]
        for row, why in dead_centres_of_rows(self.ensemble, self.summary):
            reasons[row] = why
        return reasons

    @cached_property
    def warnings(self) -> NDArray[np.object_]:
        """Warnings of every run, ok or not: a tuple of sentences."""
        ensemble, sentences_of_runs = self.ensemble, np.empty(len(self), dtype=object)
        starts = self.done & (summary_column(self.summary, "start") == ASSEMBLED)
        sentences_of_runs[:] = [ensemble.warnings if there else () for there in starts]
        law, spec = ensemble.compiled.law, ensemble.recipe.spec
        for i, sentences in warnings_of_runs(self.summary, starts, law, spec).items():
            sentences_of_runs[i] += sentences
        return sentences_of_runs

    @property
    def counts(self) -> dict[str, int]:
        """Number of runs by status."""
        return {name: int(np.sum(self.status == name)) for name in (OK, UNVERIFIED, FAILED, NOT_RUN)}

    def reasons(self, most: int = 10) -> list[tuple[str, int]]:
        """Return the commonest reasons without their figures, each with the number of runs it is said of."""
        kinds = Counter(reason_without_figures(reason) for reason in self.reason if reason)
        most = whole_number("most", most, 0, 10**9)
        return kinds.most_common(most)

    def common_warnings(self) -> list[tuple[str, int]]:
        """Return the first warning of each kind and the number of runs that have it.

        What varies and changes nothing that was kept is named as well, as a warning of all runs.
        """
        first, count = dict[str, str](), Counter[str]()
        for sentences, runs in Counter(self.warnings).items():  # most have none, or the same
            for kind, sentence in {_FIGURES.sub("", sentence): sentence for sentence in sentences}.items():
                first.setdefault(kind, sentence)
                count[kind] += runs
        common = [(first[kind], runs) for kind, runs in count.most_common()]
        return common + [(sentence, len(self)) for sentence in unmoved_axes(self)]

    def __getitem__(self, name: str) -> Array:
        """Return a quantity over the grid and time, shape (*grid, times), or a number of every run, shape grid.

        Raises
        ------
        InputError
            If it was not kept; says the nearest name.
        """
        shape = self.ensemble.grid.shape
        for i, q in enumerate(self.ensemble.recipe.kept):
            if q.name == name:
                return self.values[:, i, :].reshape(*shape, -1)
        if name in NUMBERS:
            return summary_column(self.summary, name).reshape(shape)
        if name in self.events:
            return np.asarray(self.summary[:, self.events[name][0]]).reshape(shape)
        names = [*(q.name for q in self.ensemble.recipe.kept), *NUMBERS, *self.events]
        raise InputError(
            "sweep",
            "a quantity that was kept, or a number of every run",
            kind_of_value(name),
            suggest(str(name), names),
        )

    @property
    def attributes(self) -> dict[str, Any]:
        """Settings of the ensemble by name, as JSON can express them."""
        ensemble, spec = self.ensemble, self.ensemble.recipe.spec
        chosen, elsewhere = ensemble.plan.settings, ("times", "parameters", "options")
        settings = {f.name: getattr(chosen, f.name) for f in fields(chosen) if f.name not in elsewhere}
        return {
            "mechanism": ensemble.model.name,
            "model_digest": ensemble.compiled.info.digest,
            "method": ensemble.compiled.law.method,
            "integrator": ensemble.plan.integrator.name,
            "target": ensemble.target,
            "coordinates": ensemble.plan.coordinates,
            "step": None if spec.adaptive else spec.step,
            "rtol": spec.rtol if spec.adaptive else None,
            "atol": spec.atol if spec.adaptive else None,
            "until": spec.until,
            "parameters": json.dumps({k: x for k, x in ensemble.parameters.items() if "~" not in k}),
            "inputs": json.dumps(dict(ensemble.driving.inputs.words)),
            "options": json.dumps(dict(chosen.options)),
            "settings": json.dumps(json_value(settings)),
            "versions": json.dumps(_library_versions()),
            "ensemble_digest": ensemble.recipe.digest,
            "interrupted": int(self.interrupted),
        }

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen sweep --json``."""
        facts = {
            key: self.attributes[key]
            for key in ("mechanism", "method", "integrator", "target", "coordinates", "step", "rtol", "until")
        }
        counts = self.counts
        contract: dict[str, Any] = json_value(
            {
                **facts,
                "runs": len(self),
                "axes": {axis.dimension: len(axis) for axis in self.ensemble.grid.axes},
                "quantities": [q.name for q in self.ensemble.recipe.kept],
                "times": len(self.ensemble.recipe.kept_times),
                "events": {
                    name: {
                        "runs": int(np.sum(counts > 0.0)),
                        "count": int(np.nansum(counts)),
                    }
                    for name in self.ensemble.events
                    for counts in [self[f"event.{name}.count"]]
                },
                "status": {name.replace(" ", "_"): count for name, count in counts.items()},
                "reasons": [{"reason": reason, "runs": count} for reason, count in self.reasons()],
                "warnings": [{"warning": sentence, "runs": count} for sentence, count in self.common_warnings()],
                "seconds": self.seconds,
                "interrupted": self.interrupted,
            }
        )
        return contract

    def to_xarray(self) -> xr.Dataset:
        """Return everything as a data set with a dimension for each axis and ``time``.

        Variables are the quantities, ``status``, ``reason``, ``warnings`` and the numbers of every run; coordinates are
        what varied. A parameter or output of such a name is called ``parameter.NAME`` or ``output.NAME``.

        Raises
        ------
        InputError
            If xarray is not installed; says how to install it.
        """
        from symgen.study.ensemble.sweep_dataset import sweep_dataset

        return sweep_dataset(self)

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the data set to a NetCDF file (``.nc``), or a CSV file with a line for every run and time.

        Headings of a CSV file carry units: ``crank_mass [kg]``, ``t [s]``, ``crank.theta [rad]``; parameters that vary
        have the unit of the mechanism's file there. The file appears whole or not at all.

        Raises
        ------
        InputError
            If the ending is another, a library is missing, or the file cannot be written.
        """
        file = argument_path("save", path)
        check_path("save", file, SAVED, "data")
        if file.suffix.lower() == ".csv":
            return write_csv(file, *table_lines(self, as_written=True))
        return write_whole(file, netcdf_writer(self.to_xarray()))

    def sensitivities(self, by: Sequence[str]) -> RowSensitivities:
        """Return the derivatives of the quantities of all rows by chosen numbers; see `Model.simulate`.

        Each row is made again, as a single run with directions; ``dop853`` takes the place of ``picard``.
        """
        from symgen.study.ensemble.row_sensitivities import row_sensitivities

        return row_sensitivities(self, by)

    def contributions(self, name: str) -> dict[str, float]:
        """Return the share of a quantity's variance at the last output that each varied number contributes.

        The shares are those of straight lines through all runs (`symgen.study.ensemble.samples.contributions`); what
        is missing to 1 is curvature and interplay. In a tolerance study, the largest share names the dimension to hold.

        Raises
        ------
        InputError
            If the quantity was not kept, or too few runs have it.
        """
        values = self[name].reshape(len(self), -1)[:, -1]
        return contributions(self.ensemble.grid.values(0, len(self)), np.asarray(values, dtype=np.float64))

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for every run and output time, with what varied, quantities, events and status.

        Columns carry no units; ``attrs["units"]`` holds them.

        Raises
        ------
        InputError
            If pandas is not installed.
        """
        need_library("to_dataframe", "pandas")
        import pandas as pd

        headings, lines = table_lines(self)
        parts = [heading.partition(" [") for heading in headings]
        frame = pd.DataFrame(list(lines), columns=[name for name, _, _ in parts])
        frame.attrs["units"] = {name: unit.removesuffix("]") for name, _, unit in parts if unit}
        return frame

    @overload
    def plot(self, path: None = None, what: Sequence[str] = (), over: str = "") -> Plot: ...

    @overload
    def plot(self, path: str | PathLike[str], what: Sequence[str] = (), over: str = "") -> Path: ...

    def plot(self, path: str | PathLike[str] | None = None, what: Sequence[str] = (), over: str = "") -> Plot | Path:
        """Draw quantities that were kept: a figure, or a PNG, SVG or PDF file, a panel for each.

        Parameters
        ----------
        path : path, optional
            The file; its ending says the kind. Without one the figure comes back, which notebooks show.
        what : sequence of str, optional
            Quantities, or all of a body, a joint or a table; all by default.
        over : str
            ``t`` or a quantity, every run being a line; or something that varies, which the last outputs are drawn
            over. By default ``t``, and what varies first where only the ends were kept.

        Raises
        ------
        InputError
            If a name is none, the ending is not known, matplotlib is missing, or the file cannot be written.
        """
        from symgen.study.ensemble.sweep_plot import sweep_figure

        return draw_or_save(path, lambda: sweep_figure(self, words("plot", what), text("over", over)))

    def units(self) -> dict[str, str]:
        """Return the units of what varies, by name; empty where there is none."""
        info = self.ensemble.compiled.info
        units = {q.name: q.unit for q in (*info.parameters, *info.coordinates, *info.velocities)}
        units |= {q.name: q.unit for q in info.joint_coordinates}
        units |= {f"{q.name}.rate": f"{q.unit}/s" for q in info.joint_coordinates}
        names = Names.of_mechanism(self.ensemble.model.mechanism)
        return {name: units.get(names.canonical_name(name), "") for name in self.ensemble.grid.names}

    def as_written(self) -> tuple[Grid, dict[str, str]]:
        """Return what varies, and its units by name, with parameters in the unit of the file."""
        own = {p.name: p.own_unit for p in self.ensemble.model.mechanism.parameters if p.shown}
        units = {name: own[name].text if name in own else unit for name, unit in self.units().items()}

        def read(name: str, values: Array) -> Array:
            return np.array([own[name].from_si(float(x)) for x in values]) if name in own else values

        axes = (
            replace(axis, values={n: read(n, x) for n, x in axis.values.items()}) for axis in self.ensemble.grid.axes
        )
        return Grid(tuple(axes)), units


#: Figures in sentences, which differ from run to run.
_FIGURES = re.compile(r"\d[\d.e+-]*")


def reason_without_figures(reason: str) -> str:
    """Return a reason without its figures: what runs that fail for the same cause have in common."""
    head = reason.partition(" (")[0].partition(" at t = ")[0]
    return head.partition("; check its points")[0].partition(" stays open by ")[0].partition(" at t =")[0]


def _library_versions() -> dict[str, str]:
    import platform
    from importlib.metadata import version

    return {
        "symgen": __version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "numba": version("numba"),
        "llvmlite": version("llvmlite"),
    }
