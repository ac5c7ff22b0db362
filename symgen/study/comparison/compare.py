"""Error against run time: models, several methods, integrators, steps and tolerances, one reference a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any, TypedDict

import msgspec
import numpy as np
from msgspec import structs

from symgen.api import Model, load
from symgen.base import arguments
from symgen.base.errors import SimulationError, SymgenError
from symgen.base.plugins import in_sentences
from symgen.base.settings import Settings, default
from symgen.describe.digest import digest, identity
from symgen.describe.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism, bounded
from symgen.result.points import Points
from symgen.running.outputs import multiples, output_size
from symgen.running.plan import Plan, Purpose, refuse_events
from symgen.running.prepare import Assembled, Prepared, assemble, begin, make_plan, prepare
from symgen.runs.timing import timed
from symgen.store.paths import cache_location
from symgen.study.comparison.combinations import Combinations, words_of_variant
from symgen.study.comparison.comparison_rows import (
    Row,
    Study,
    Trace,
    check_entry,
    from_entry,
    save_csv,
    to_entry,
    with_ratios,
)
from symgen.study.comparison.measured_runs import measured
from symgen.study.journal import Journal, Outcome, cell_key, code_identity
from symgen.study.limits import WATCHES, unlimited
from symgen.study.machine_class import machine_class, versions
from symgen.study.references.reference import Array, Reference, reference
from symgen.study.references.routes import fastest_decay, two_routes
from symgen.study.references.solvers import AUTO, check_solver
from symgen.study.runner import Cell, Status, run_cells

__all__ = ["Progress", "Row", "Study", "Trace", "compare", "compare_all", "save_csv"]

#: Output times of a study, unless the mechanism's output step is coarser.
OUTPUTS = 200
#: Default number of timed runs a row, and their least total time in seconds.
REPEAT, AT_LEAST = 3, 0.05
#: What making the code of a method ready counts for in the progress, in rows; no process is started for what takes less
#: than so many seconds.
PREPARATION, PATIENCE = 10.0, 1.0

#: Called with the current activity, the progress and the total.
Progress = Callable[[str, float, float], None]

#: Largest number of coordinates for which a study compiles straight code by default.
LARGEST_STRAIGHT = 120
#: Largest number of processes.
MOST_JOBS = 4096
#: A run, the reference with the runs that it is made of, distances, and the times of every row take so much of a run.
COPIES = 8.0


@in_sentences
def compare(
    model: str | Path | Mechanism | Model,
    methods: Sequence[str] = (),
    integrators: Sequence[str] = (),
    steps: Sequence[float] = (),
    rtols: Sequence[float] = (),
    until: float | None = None,
    repeat: int = REPEAT,
    output_step: float | None = None,
    parameters: Mapping[str, float] | None = None,
    options: Mapping[str, str | float] | None = None,
    progress: Progress | None = None,
    jobs: int = 1,
    journal: Journal | None = None,
    reference_by: str = AUTO,
    shape: str = "auto",
    max_violation: float = default("max_violation"),
    max_energy_error: float = default("max_energy_error"),
    max_attempts: float | None = None,
    start: Mapping[str, float] | None = None,
    coordinates: Sequence[str] = (),
    max_step: float | None = None,
) -> Study:
    """Run a model with every combination and measure error and run time.

    Parameters
    ----------
    model : str, path, Mechanism or Model
        What to run.
    methods, integrators : sequence of str
        Names, or ``all``. By default the six methods of the source with rk4, dopri5 and dop853. Incompatible pairs
        are left out. A method may have options of its own, ``"baumgarte:alpha=5:beta=5"``: each is a line of the
        study.
    steps : sequence of float
        Constant steps [s] of integrators without error estimate; multiples of the mechanism's own by default.
    rtols : sequence of float
        Relative tolerances of adaptive integrators.
    until : float, optional
        End time [s]; by default the mechanism's own, limited to the time in which its motion is predictable.
    repeat : int
        Timed runs a row, after a warm-up; the shortest counts. Short runs are repeated more often; 1 runs once.
    output_step : float, optional
        Time between the outputs that are compared [s].
    parameters, options, start : mapping
        As for `symgen.Settings`; `start` holds values by name alone.
    progress : callable, optional
        Called with the current activity, the progress and the total.
    jobs : int
        Processes for untimed work: derivation, compilation, references. With more than 1 a script needs the guard
        ``if __name__ == "__main__":``.
    journal : Journal, optional
        Stores every finished row, and supplies the rows of an earlier, interrupted study.
    reference_by : str
        Source of the reference motion: ``auto``, or one of SciPy's solvers on independently derived equations
        (``scipy-dop853``, ``scipy-radau``, ``scipy-bdf``, ``scipy-lsoda``).
    shape : str
        Shape of the code. ``auto`` is ``straight`` for all methods up to `LARGEST_STRAIGHT` coordinates, so that run
        times compare methods and not shapes.
    max_violation, max_energy_error : float
        As for `symgen.Settings`. A run that exceeds one is `failed` and measured to its end without it.
    max_attempts : float
        As for `symgen.Settings`.
    coordinates : sequence of str
        ``absolute``, ``joint`` or both, side by side; absolute ones by default.
    max_step : float
        Largest step of adaptive integrators and of the reference [s].

    Returns
    -------
    Study
        Also after an interruption (KeyboardInterrupt), with the finished rows.

    Raises
    ------
    InputError
        If a name or number is wrong; raised before any run.
    """
    common = Settings(
        until=until,
        output_step=output_step,
        parameters=parameters or {},
        start=arguments.mapping("start", start, "values by the names of coordinates and velocities"),
        options=options or {},
        max_violation=max_violation,
        max_energy_error=max_energy_error,
        max_step=max_step,
        max_attempts=max_attempts,
        repeat=repeat,
        shape=shape,
    )
    runs = Combinations(methods, integrators, steps, rtols, coordinates)
    return compare_all([model], common, runs, reference_by, progress, jobs, journal)[0]


@dataclass(frozen=True)
class ReferenceTask:
    """Reference motion of the rows; `settings` define its start."""

    mechanism: Mechanism
    settings: Settings
    times: Array
    reference_by: str = AUTO

    def outcome(self) -> Outcome:
        """Return the motion as JSON values, or the reason why there is none."""
        mechanism, settings = self.mechanism, self.settings
        compiled, start = prepare(mechanism, settings, Purpose.STATE).assembled.of_bodies
        values, state = parameter_values(mechanism, settings.parameters), compiled.info.parts(start.y)
        try:
            if self.reference_by == AUTO and any(force.flexures for force in mechanism.forces):
                # no second derivation has beam elements
                decay = fastest_decay(mechanism, compiled, start)
                motion = two_routes(mechanism, values, self.times, decay, settings.start)
            else:
                motion = reference(mechanism, values, *state, self.times, self.reference_by, not settings.start)
        except SimulationError as error:
            return {"unusable": str(error)}
        return {
            "how": motion.how,
            "estimated_error": motion.estimated_error,
            "note": motion.note,
            "q": motion.q.tolist(),
        }


@dataclass(frozen=True)
class CodeTask:
    """Code of one method with some integrators; the cache holds the result."""

    mechanism: Mechanism
    settings: tuple[Settings, ...]

    def outcome(self) -> None:
        """Compile everything that runs with these settings call, by runs that end at once."""
        for settings in self.settings:
            compile_all(prepare(self.mechanism, settings))


def compile_all(run: Prepared) -> None:
    """Compile everything that a run and its row call, by a run that ends at once."""
    run = run.with_spec(until=1e-9, times=np.zeros(1))
    outcome = run.integrate()
    if outcome.interrupted:
        raise KeyboardInterrupt
    if len(outcome.times):
        _ = run.of_bodies(outcome).acceleration_violations


def compute(task: ReferenceTask | CodeTask) -> Outcome | None:
    """Compute a cell ahead of the runs; the runs meet a failure again and report it."""
    try:
        return task.outcome()
    except SymgenError:
        return None


@dataclass
class _Work:
    """One model with all of its runs."""

    model: Model
    common: Settings
    end: float
    times: Array
    settings: list[Settings]
    plans: list[Plan]
    reference_by: str
    journal: Journal

    @cached_property
    def pairs(self) -> set[Any]:
        """Code and integrator of the rows that the journal lacks: each pair is compiled once."""
        lacking = zip(self.rows, self.plans, strict=True)
        return {(plan.key, plan.integrator.name) for cell, plan in lacking if cell.key not in self.journal}

    def total(self, ahead: bool) -> float:
        """Return what the progress counts: rows, the reference, and compilation unless it was done ahead."""
        return len(self.plans) + 1 + (0.0 if ahead else PREPARATION * len(self.pairs))

    @cached_property
    def _parts(self) -> dict[str, Any]:
        """Common parts of the cells' keys; run times depend on the machine and the libraries."""
        base, mechanism = self.settings[0], identity(self.model.mechanism)
        parts: dict[str, Any] = {"mechanism": mechanism, "code": code_identity(), "reference": self.reference_by}
        parts |= {"machine": machine_class(), "versions": versions(), "until": base.until, "times": self.times.tolist()}
        return parts | {"parameters": dict(base.parameters), "start": dict(base.start)}

    @cached_property
    def reference(self) -> Cell:
        """Cell of the reference."""
        task = ReferenceTask(self.model.mechanism, self.settings[0], self.times, self.reference_by)
        return Cell(cell_key(what="reference", **self._parts), self.model.name, task, check=_check_motion)

    @cached_property
    def rows(self) -> list[Cell]:
        """Cells of the rows; their tasks are indices of the settings."""
        cells = []
        for i, settings in enumerate(self.settings):
            own = {f.name: getattr(settings, f.name) for f in fields(settings) if f.name not in self._parts}
            cells.append(Cell(cell_key(what="comparison", **self._parts, **own), "", i, check=check_entry))
        return cells

    def ahead(self) -> list[Cell]:
        """Return the cells that can be computed before the runs and in parallel."""
        groups: dict[Any, dict[str, Settings]] = {}
        for cell, settings, plan in zip(self.rows, self.settings, self.plans, strict=True):
            if cell.key not in self.journal:
                groups.setdefault(plan.key, {}).setdefault(plan.integrator.name, settings)
        tasks = [CodeTask(self.model.mechanism, tuple(group.values())) for group in groups.values()]
        codes = [Cell(f"{self.model.name} {i}", self.model.name, task) for i, task in enumerate(tasks)]
        # the reference comes last: it always takes time; cached code takes none, so that no process is started
        return [*codes, self.reference] if groups else []

    def run(self, show: Callable[[str, float], None], ahead: bool) -> Study:
        """Run the rows that the journal lacks, one at a time; `ahead` says whether their code was compiled before."""

        def motion(task: ReferenceTask) -> Outcome:
            show("reference", 0.0)
            return task.outcome()

        motions, interrupted = run_cells([self.reference], motion, self.journal)
        if interrupted:
            return self.study(True)
        reference_motion, assembled = _reference(motions[self.reference.key], self.times), dict[Any, Assembled]()
        points = Points.of(self.model.mechanism, self.model.parameters(self.settings[0].parameters))
        compiled = set[Any]()

        def row(i: int) -> Outcome:
            settings, plan = self.settings[i], self.plans[i]
            words, pair = f"{settings.method}, {settings.integrator}", (plan.key, plan.integrator.name)
            first = not ahead and pair not in compiled
            if first:
                show(f"compiling {words}", 1.0 + i + PREPARATION * len(compiled))
            if plan.key not in assembled:
                assembled[plan.key] = assemble(plan)
            run = begin(plan, assembled[plan.key])
            if first:
                compile_all(run)
                compiled.add(pair)
            show(words, 1.0 + i + PREPARATION * len(compiled))
            runs = timed(run.integrate, settings.repeat, AT_LEAST)
            stopped = runs.outcome if runs.outcome.code in WATCHES else None
            if stopped is not None:  # a study measures what becomes of it
                runs = timed(unlimited(run).integrate, settings.repeat, AT_LEAST)
            if runs.outcome.interrupted:
                raise KeyboardInterrupt
            variant = words_of_variant(settings, self.common)
            return to_entry(*measured(run, runs, reference_motion, points, variant, stopped))

        return self.study(run_cells(self.rows, row, self.journal)[1])

    def study(self, interrupted: bool) -> Study:
        """Return the study of the finished rows."""
        motion = self.journal.get(self.reference.key) or {"unusable": ""}
        done = [from_entry(entry) for cell in self.rows if (entry := self.journal.get(cell.key)) is not None]
        base, why = self.settings[0], motion.get("unusable")
        without = "there is no reference, so errors are unknown"
        return Study(
            mechanism=self.model.name,
            how=motion.get("how", "none"),
            estimated_error=motion.get("estimated_error", float("nan")),
            until=self.end,
            rows=with_ratios([row for row, _ in done]),
            interrupted=interrupted,
            traces=tuple(trace for _, trace in done),
            note=motion.get("note", f"{without}: {why}" if why else without),
            title=self.model.mechanism.title,
            digest=digest(self.model.mechanism),
            step=self.model.mechanism.defaults.step,
            parameters=dict(base.parameters),
            options=dict(self.common.options),
            repeat=base.repeat,
            start=dict(base.start),
        )


class _Motion(TypedDict):
    how: str
    estimated_error: float
    q: list[list[float]]
    note: str


class _Unusable(TypedDict):
    unusable: str


def _check_motion(entry: Outcome) -> None:
    """Raise `ValueError` unless an entry of a journal is that of a reference."""
    msgspec.convert(entry, _Unusable if "unusable" in entry else _Motion)


def _reference(entry: Outcome, times: Array) -> Reference | None:
    """Return the reference of a journal's entry, None where the entry holds the reason of its absence."""
    if "unusable" in entry:
        return None
    return Reference(entry["how"], entry["estimated_error"], times, np.array(entry["q"]), entry["note"])


def compare_all(
    models: Sequence[str | Path | Mechanism | Model],
    common: Settings,
    runs: Combinations,
    reference_by: str = AUTO,
    progress: Progress | None = None,
    jobs: int = 1,
    journal: Journal | None = None,
) -> list[Study]:
    """Compare on several models.

    Parameters
    ----------
    models : sequence of str, path, Mechanism or Model
        Models to run; all are checked before the first run.
    common : Settings
        Common settings of all runs.
    runs : Combinations
        Differences between runs.
    reference_by, progress, jobs, journal
        As for `compare`.

    Returns
    -------
    list of Study
        One a model, in order; after an interruption up to and including the interrupted one.

    Raises
    ------
    InputError
        As for `compare`.
    """
    check_solver(reference_by)
    jobs = arguments.whole("jobs", jobs, 1, MOST_JOBS)
    arguments.function("progress", progress)
    if journal is not None:
        arguments.of_kind("journal", journal, Journal, "a symgen.study.journal.Journal")
    works, records = [], Journal() if journal is None else journal
    for model in models:
        chosen = _chosen(load(model), common)
        end = _end(chosen, common.until)
        times = _times(chosen, end, common.output_step)
        small = chosen.mechanism.body_coordinates <= LARGEST_STRAIGHT
        shape = "straight" if common.shape == "auto" and small else common.shape
        base = replace(common, output_step=None, shape=shape, until=end, times=times.tolist())
        settings = list(runs.settings(base, chosen.mechanism.defaults.step))
        plans = [make_plan(chosen.mechanism, s) for s in settings]  # raises errors before the first run
        works.append(_Work(chosen, common, end, times, settings, plans, reference_by, records))
    ahead = jobs > 1 and cache_location().persistent  # else the code that another process compiles would be lost
    reached, total = 0.0, sum(work.total(ahead) for work in works)
    report: Progress = progress or (lambda what, reached, of: None)
    if ahead:
        cells = [cell for work in works for cell in work.ahead()]
        reached = PREPARATION * len(cells)
        total += reached

        def prepared(status: Status) -> None:
            report(f"preparing: {status.done} of {status.total}", PREPARATION * status.done, total)

        if run_cells(cells, compute, records, jobs, prepared, PATIENCE)[1]:
            return [works[0].study(True)]
    studies = []
    for work in works:
        prefix = f"{work.model.name}: " if len(works) > 1 else ""

        def show(what: str, done: float, prefix: str = prefix, reached: float = reached) -> None:
            report(prefix + what, reached + done, total)

        studies.append(work.run(show, ahead))
        reached += work.total(ahead)
        if studies[-1].interrupted:
            break
    return studies


def _chosen(model: Model, common: Settings) -> Model:
    """Return a model without events that are only recorded, and with the largest step for all; refuse other events."""
    mechanism = model.mechanism
    refuse_events("compare", mechanism, common)
    plain = structs.replace(mechanism, events=()) if mechanism.events else mechanism
    plain = bounded(plain, common.max_step)
    return model if plain is mechanism else Model(plain)


def _end(model: Model, until: float | None) -> float:
    defaults = model.mechanism.defaults
    if until is not None:
        return until
    return min(defaults.until, defaults.predictable_until or np.inf)


def _times(model: Model, end: float, output_step: float | None) -> Array:
    """Return the common output times: multiples of `output_step` or the mechanism's, at most about `OUTPUTS`."""
    own = model.mechanism.defaults.output_step
    size = COPIES * output_size(model.mechanism)
    if output_step is not None:
        return multiples(output_step, end, size)
    if own is None:
        return np.asarray(np.linspace(0.0, end, OUTPUTS + 1), dtype=np.float64)
    return multiples(own * max(1, round(end / own / OUTPUTS)), end, size)
