"""Error against run time: models, several methods, integrators, steps and tolerances, one reference a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import structs

from symgen import arguments
from symgen.api import Model, load
from symgen.describe.digest import digest
from symgen.describe.mechanism import Mechanism, bounded
from symgen.errors import SimulationError
from symgen.result.points import Points
from symgen.running.outputs import multiples, output_size
from symgen.running.plan import Plan, refuse_events
from symgen.running.prepare import Assembled, assemble, begin, make_plan
from symgen.runtime import abi
from symgen.runtime.timing import timed
from symgen.settings import Settings, default
from symgen.study.comparison.combinations import Combinations
from symgen.study.comparison.kept import Kept
from symgen.study.comparison.measured import measured
from symgen.study.comparison.preparation import Task, work_through
from symgen.study.comparison.rows import Row, Study, Trace, save_csv, with_ratios
from symgen.study.journal import Journal
from symgen.study.references.reference import Array, Reference, reference
from symgen.study.references.solvers import AUTO, check_solver

if TYPE_CHECKING:
    from symgen.runtime.assembly import Start
    from symgen.runtime.compiled import CompiledModel

__all__ = ["Progress", "Row", "Study", "Trace", "compare", "compare_all", "save_csv"]

#: Output times of a study where the mechanism does not say more coarsely.
OUTPUTS = 200
#: Timed runs a row, unless told; and the seconds that they take together at least.
REPEAT, AT_LEAST = 3, 0.05
#: What making the code of a method ready counts for in the progress, in rows.
PREPARATION = 10.0

#: Called with what is being done, how far it is, and how much there is in all.
Progress = Callable[[str, float, float], None]

#: Largest number of coordinates for which a study compiles straight code unless told.
LARGEST_STRAIGHT = 120
#: Processes at most.
MOST_JOBS = 4096
#: A run, the reference with the runs that it is made of, distances, and the times of every row take so much of a run.
COPIES = 8.0


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
        Names, or ``all``. Unless given, the six methods of the source with rk4, dopri5 and dop853. Pairs that do not
        suit each other are left out.
    steps : sequence of float
        Constant steps [s] of integrators without error estimate; multiples of the mechanism's own by default.
    rtols : sequence of float
        Tolerances of adaptive ones.
    until : float, optional
        End time [s]; the mechanism's own by default, and no longer than it is predictable.
    repeat : int
        Timed runs a row, after a warm-up; the shortest counts. Short runs are repeated more often; 1 runs once.
    output_step : float, optional
        Time between the outputs that are compared [s].
    parameters, options, start : mapping
        As for `symgen.Settings`; `start` holds values by name alone.
    progress : callable, optional
        Called with what is being done, how far it is, and how much there is in all.
    jobs : int
        Processes for what is not timed: deriving, compiling, references. With more than 1 a script needs the guard
        ``if __name__ == "__main__":``.
    journal : Journal, optional
        Keeps every row as soon as it is done, and gives those of an earlier, interrupted study.
    reference_by : str
        Where the reference motion comes from: ``auto``, or one of SciPy's solvers on independently derived equations
        (``scipy-dop853``, ``scipy-radau``, ``scipy-bdf``, ``scipy-lsoda``).
    shape : str
        Shape of the code. ``auto`` is ``straight`` for all methods up to `LARGEST_STRAIGHT` coordinates, so that run
        times compare methods and not shapes.
    max_violation, max_energy_error, max_attempts : float
        As for `symgen.Settings`.
    coordinates : sequence of str
        ``absolute``, ``joint`` or both, side by side; absolute ones by default.
    max_step : float
        Largest step of adaptive integrators and of the reference [s].

    Returns
    -------
    Study
        Also after an interruption (KeyboardInterrupt), with the rows that are done.

    Raises
    ------
    InputError
        If a name or number is wrong; nothing has been run then.
    """
    asked = Settings(
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
    return compare_all([model], asked, runs, reference_by, progress, jobs, journal)[0]


@dataclass
class _Work:
    """One model with everything that will be run."""

    model: Model
    end: float
    times: Array
    settings: list[Settings]
    plans: list[Plan]
    kept: Kept
    reference_by: str
    known: Reference | None = None
    note: str = ""  # why there is no reference

    @property
    def total(self) -> float:
        return float(len(self.plans) + 1)

    def recall(self) -> None:
        """Take the reference that an earlier study has left, or why there is none."""
        self.known = self.known or self.kept.reference(self.settings[0], self.times)
        self.note = "" if self.known is not None else self.kept.why_none(self.settings[0])

    def study(self, done: Sequence[tuple[Row, Trace]], interrupted: bool) -> Study:
        base, known = self.settings[0], self.known
        return Study(
            mechanism=self.model.name,
            how="none" if known is None else known.how,
            estimated_error=float("nan") if known is None else known.estimated_error,
            until=self.end,
            rows=with_ratios([row for row, _ in done]),
            interrupted=interrupted,
            traces=tuple(trace for _, trace in done),
            note=self.note or ("there is no reference, so errors are unknown" if known is None else known.note),
            title=self.model.mechanism.title,
            digest=digest(self.model.mechanism),
            step=self.model.mechanism.defaults.step,
            parameters=dict(base.parameters),
            options=dict(base.options),
            repeat=base.repeat,
            start=dict(base.start),
        )


def compare_all(
    models: Sequence[str | Path | Mechanism | Model],
    asked: Settings,
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
        What to run; all of it is checked before anything is run.
    asked : Settings
        What all runs have in common.
    runs : Combinations
        What differs.
    reference_by, progress, jobs, journal
        As for `compare`.

    Returns
    -------
    list of Study
        One a model, in order; after an interruption those up to the interrupted one, which comes last.

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
    works = []
    for model in models:
        chosen = _chosen(load(model), asked)
        end = _end(chosen, asked.until)
        times = _times(chosen, end, asked.output_step)
        small = chosen.mechanism.body_coordinates <= LARGEST_STRAIGHT
        shape = "straight" if asked.shape == "auto" and small else asked.shape
        base = replace(asked, output_step=None, shape=shape, until=end, times=times.tolist())
        settings = list(runs.settings(base, chosen.mechanism.defaults.step))
        plans = [make_plan(chosen.mechanism, s) for s in settings]  # refuses what is wrong before anything is run
        works.append(
            _Work(chosen, end, times, settings, plans, Kept(chosen.mechanism, journal, reference_by), reference_by)
        )
    reached, total = 0.0, sum(w.total for w in works)
    report: Progress = progress or (lambda what, reached, of: None)
    if jobs > 1:
        reached, interrupted = _prepare(works, jobs, report, total)
        total += reached
        if interrupted:
            return [_kept(works[0])]
    studies = []
    for work in works:
        prefix = f"{work.model.name}: " if len(works) > 1 else ""

        def say(what: str, done: float, prefix: str = prefix, reached: float = reached) -> None:
            report(prefix + what, reached + done, total)

        studies.append(_run(work, say))
        reached += work.total
        if studies[-1].interrupted:
            break
    return studies


def _prepare(works: Sequence[_Work], jobs: int, report: Progress, later: float) -> tuple[float, bool]:
    """Fill the cache and compute references on several processes.

    Returns what that counts for in the progress, and whether it was interrupted.
    """
    from symgen.store.paths import cache_location

    if not cache_location().persistent:
        return 0.0, False  # what another process compiles would be lost
    tasks, owners = list[Task](), list[_Work]()
    for work in works:
        groups: dict[Any, dict[str, Settings]] = {}
        for settings, plan in zip(work.settings, work.plans, strict=True):
            if work.kept.row(settings) is None:
                groups.setdefault(plan.key, {}).setdefault(plan.integrator.name, settings)
        first = work.settings[0]
        if groups and work.kept.reference(first, work.times) is None:
            tasks.append(Task("reference", work.model.mechanism, (first,), work.times, work.reference_by))
        tasks += [Task(next(iter(g.values())).method, work.model.mechanism, tuple(g.values())) for g in groups.values()]
        owners += [work] * (len(tasks) - len(owners))
    weight = PREPARATION * len(tasks)

    def done(count: int) -> None:
        what = f": {owners[count].model.name}, {tasks[count].what}" if count < len(tasks) else ""
        report(f"preparing{what}", PREPARATION * count, weight + later)

    done(0)
    found, interrupted = work_through(tasks, jobs, done)
    for work, known in zip(owners, found, strict=True):
        if known is not None:
            work.known = known
            work.kept.add_reference(work.settings[0], known)
    return weight, interrupted


def _run(work: _Work, say: Callable[[str, float], None]) -> Study:
    """Run all rows of a model, one at a time."""
    done = list[tuple[Row, Trace]]()  # pairs: an interruption leaves no row without its curves
    assembled: dict[Any, Assembled] = {}
    points = Points.of(work.model.mechanism, work.model.parameters(work.settings[0].parameters))
    interrupted = False
    try:
        work.recall()
        for i, (s, plan) in enumerate(zip(work.settings, work.plans, strict=True)):
            found = work.kept.row(s)
            if found is None:
                if plan.key not in assembled:
                    assembled[plan.key] = assemble(plan)
                run = begin(plan, assembled[plan.key])
                if work.known is None and not work.note:
                    say("reference", 0.0)
                    _find_reference(work, *run.assembled.of_bodies, lambda f: say("reference", f))
                say(f"{s.method}, {s.integrator}", 1.0 + i)
                runs = timed(run.integrate, s.repeat, AT_LEAST)
                interrupted = runs.outcome.interrupted
                if runs.outcome.code != abi.STOPPED:
                    found = measured(run, runs, work.known, points)
                    work.kept.add_row(s, *found)
            if found is not None:
                done.append(found)
            if interrupted:
                break
    except KeyboardInterrupt:
        interrupted = True
    return work.study(done, interrupted)


def _kept(work: _Work) -> Study:
    """Return the rows that an earlier, interrupted study has left, as an interrupted study."""
    work.recall()
    found = [pair for pair in map(work.kept.row, work.settings) if pair is not None]
    return work.study(found, True)


def _find_reference(work: _Work, compiled: CompiledModel, start: Start, progress: Callable[[float], None]) -> None:
    """Compute the reference; where there is none, note why."""
    settings, mechanism = work.settings[0], work.model.mechanism
    values = work.model.parameters(settings.parameters)
    try:
        state = compiled.info.parts(start.y)
        known = reference(mechanism, values, *state, work.times, progress, work.reference_by, not settings.start)
    except SimulationError as error:
        work.note = f"there is no reference, so errors are unknown: {error}"
        work.kept.add_why_none(settings, work.note)
        return
    work.known = known
    work.kept.add_reference(settings, known)


def _chosen(model: Model, asked: Settings) -> Model:
    """Return a model without events that are only recorded, others being refused, with the largest step for all."""
    mechanism = model.mechanism
    refuse_events("compare", mechanism, asked)
    plain = structs.replace(mechanism, events=()) if mechanism.events else mechanism
    plain = bounded(plain, asked.max_step)
    return model if plain is mechanism else Model(plain)


def _end(model: Model, until: float | None) -> float:
    defaults = model.mechanism.defaults
    if until is not None:
        return until
    return min(defaults.until, defaults.predictable_until or np.inf)


def _times(model: Model, end: float, output_step: float | None) -> Array:
    """Return the common output times: multiples of the asked or the mechanism's step, at most about `OUTPUTS`."""
    own = model.mechanism.defaults.output_step
    size = COPIES * output_size(model.mechanism)
    if output_step is not None:
        return multiples(output_step, end, size)
    if own is None:
        return np.asarray(np.linspace(0.0, end, OUTPUTS + 1), dtype=np.float64)
    return multiples(own * max(1, round(end / own / OUTPUTS)), end, size)
