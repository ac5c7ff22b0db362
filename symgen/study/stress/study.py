"""Stability on stiff and extreme cases: every method on every family of cases, each run judged by another route."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.base.settings import Settings, default_of_setting
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.describe.mechanism import with_largest_step
from symgen.describe.parts.event_sections import RESET
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.automatic import AUTO, constant_integrator
from symgen.run.planning.plan import refuse_ends, refuse_weightless
from symgen.study.journal import Journal, Outcome, cell_key, code_identity
from symgen.study.references.effort import BUDGET, pairs_left_out
from symgen.study.references.routes import parts_without_derivation
from symgen.study.runner import Cell, run_cells
from symgen.study.stress.bench import Base, Level, NotApplicable
from symgen.study.stress.cell_references import cells_without_reference
from symgen.study.stress.cells import CellReference, LimitTask, RunTask, compute_cell
from symgen.study.stress.checked_entries import check_limit, check_motion, check_run
from symgen.study.stress.extreme_values import HALVINGS, QUICK_HALVINGS, search_extremes
from symgen.study.stress.families import FAMILIES, levels_of_family
from symgen.study.stress.shared_by_cells import identity_of
from symgen.study.stress.stress_rows import ExtremeReached, LargestSteps, Stress, StressRow
from symgen.study.stress.study_progress import (
    FIRST_REFERENCE,
    FIRST_RUN,
    FIRST_SCHEME,
    Progress,
    Whole,
    expected_work,
    with_first_cells,
)

#: Integrators of each method besides its own default: an explicit adaptive one and an implicit one.
FURTHER = ("dop853", "picard", "radau5")
#: Families that a quick study runs with an implicit integrator as well, as explicit ones say nothing of methods there;
#: and methods that it has these runs of: they share the equations that are compiled for it.
STIFF, SUITED = ("stiffness", "damping"), "radau5"
INDEX_ONE = ("lagrange", "velocity-projection", "post-stabilization", "direct-correction")
#: Default base model.
DEFAULT_MODEL = "four-bar"
#: Expected seconds of compilation in a quick study: all methods of small mechanisms, some of large ones.
QUICK_COMPILATION = 7.0
#: Families with a search for the largest step of each method, in the case nearest to a value: for stiffer springs
#: explicit steps are so small that a search takes most of a study.
LIMITED: Mapping[str, float] = {"duration": 0.0, "stiffness": 1e4, "damping": 1e4}

Motions = Sequence[tuple[CellReference, Outcome]]
Task = TypeVar("Task", bound=CellReference | RunTask)


def method_pairs(method: str, constant_steps: bool = False) -> tuple[tuple[str, str], ...]:
    """Return a method paired with its integrators in a study.

    Parameters
    ----------
    method : str
        A name, or ``auto``.
    constant_steps : bool
        Only integrators with constant steps.
    """
    if method == AUTO:
        return () if constant_steps else ((AUTO, AUTO),)
    chosen = METHODS.get(method, "methods")
    names = dict.fromkeys([constant_integrator(method), *FURTHER])
    fit = [n for n in names if set(INTEGRATORS.get(n).forms) & set(chosen.forms)]
    return tuple((method, n) for n in fit if not (constant_steps and INTEGRATORS.get(n).adaptive))


def stress(
    models: Sequence[str | Path] = (),
    cases: Sequence[str] = (),
    methods: Sequence[str] = (),
    quick: bool = False,
    journal: Journal | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
    compilation: float | None = None,
    max_violation: float = default_of_setting("max_violation"),
    max_energy_error: float = default_of_setting("max_energy_error"),
    max_attempts: float | None = None,
    coordinates: str = "absolute",
    max_step: float | None = None,
    searches: bool = True,
) -> Stress:
    """Run methods on families of stiff and extreme cases.

    Parameters
    ----------
    models : sequence of str or path
        Base models: catalogue entries or files; `DEFAULT_MODEL` by default.
    cases : sequence of str
        Families (`symgen.study.stress.families.FAMILIES`); by default all, in a quick study without families that have
        mechanisms of their own.
    methods : sequence of str
        Methods, ``auto`` among them; all and ``auto`` by default.
    quick : bool
        Fewer cases, each method with its own integrator only, and a tenth of the evaluations for explicit runs.
    journal : Journal, optional
        Stores finished cells; cells that it holds are not computed again.
    jobs : int
        Processes to compute on. With more than one, a script needs the usual ``if __name__ == "__main__":``.
    progress : callable, optional
        Called with the current activity and the progress.
    compilation : float, optional
        Expected seconds of compilation that a model's pairs without a looped shape may take together [s]; pairs beyond
        are left out and listed. By default without a limit, in a quick study `QUICK_COMPILATION`.
    max_violation, max_energy_error, max_attempts : float
        As for `symgen.Settings`; the first two are of the cases whose runs watch themselves.
    coordinates : {"absolute", "joint", "auto"}
        Those of the state of all runs; references and errors are of bodies in any.
    max_step : float
        Largest step of adaptive integrators and of references [s].
    searches : bool
        Whether largest steps and extreme values are looked for, which takes most of a study.

    Returns
    -------
    Stress
        Also after an interruption (KeyboardInterrupt), with the finished cells.

    Raises
    ------
    InputError
        If a name is wrong; raised before any run.
    """
    common = Settings(
        max_violation=max_violation,
        max_energy_error=max_energy_error,
        max_step=max_step,
        max_attempts=max_attempts,
        coordinates=coordinates,
    )
    cases, methods = arguments.words("cases", cases), arguments.words("methods", methods)
    searches = arguments.truth_value("searches", searches)
    quick, jobs = arguments.truth_value("quick", quick), arguments.whole_number("jobs", jobs, 1, 4096)
    if compilation is None:
        compilation = QUICK_COMPILATION if quick else math.inf
    elif compilation != math.inf:
        arguments.number("compilation", compilation, positive=True)
    arguments.callable_or_none("progress", progress)
    if journal is not None:
        arguments.instance("journal", journal, Journal, "a symgen.study.journal.Journal")
    models = arguments.list_entries("models", [models] if isinstance(models, str) else models, "a list of models")
    bases = [Base.of_mechanism(model) for model in models or (DEFAULT_MODEL,)]
    for base in bases:
        refuse_ends("stress", base.mechanism, common)
        refuse_weightless(base.mechanism)
    bases = [base.without_events(but=(RESET,)) for base in bases]
    # mechanisms of families are the same whatever the models: a quick look at a model has them where they are named
    offered = [name for name in FAMILIES if not (quick and FAMILIES[name].own)]
    chosen = tuple(dict.fromkeys(arguments.one_word_of("cases", name, FAMILIES) for name in cases or offered))
    names = tuple(dict.fromkeys(methods or (*METHODS.names, AUTO)))
    for name in names:
        if name != AUTO:
            METHODS.get(name, "methods")
    skipped: list[tuple[str, str, str]] = []
    levels = list(_levels_of_families(bases, chosen, quick, skipped, common.max_step))
    study = _Study(
        bases=bases,
        levels=levels,
        methods=names,
        quick=quick,
        journal=Journal() if journal is None else journal,
        jobs=jobs,
        progress=progress or (lambda what, status: None),
        compilation=compilation,
        common=replace(common, max_step=None),  # mechanisms have it
        max_step=common.max_step,
        searches=searches,
    )
    return study.run(tuple(skipped))


def _levels_of_families(
    bases: Sequence[Base],
    families: Sequence[str],
    quick: bool,
    skipped: list[tuple[str, str, str]],
    max_step: float | None,
) -> Iterator[Level]:
    for number, base in enumerate(bases):
        for name in families:
            if FAMILIES[name].own and number > 0:
                continue
            model = "-" if FAMILIES[name].own else base.name
            try:
                for level in levels_of_family(name, base, quick):
                    yield _level_of_study(level, model, max_step)
            except (NotApplicable, InputError) as why:  # the latter e.g. where the model uses the name of a handle
                skipped.append((base.name, name, str(why)))


def _level_of_study(level: Level, model: str, max_step: float | None) -> Level:
    """Return a case with the name of its model and the largest step of all runs."""
    plain = None if level.plain is None else with_largest_step(level.plain, max_step)
    return replace(level, mechanism=with_largest_step(level.mechanism, max_step), plain=plain, model=model)


@dataclass
class _Study:
    bases: Sequence[Base]
    levels: Sequence[Level]
    methods: Sequence[str]
    quick: bool
    journal: Journal
    jobs: int
    progress: Progress
    compilation: float
    common: Settings
    max_step: float | None = None
    searches: bool = True

    @cached_property
    def left_out(self) -> tuple[tuple[str, str, str, str], ...]:
        """Pairs that are not run, by mechanism; mechanisms with families of their own are small."""
        everything = [
            pair for name in self.methods for pair in (method_pairs(name)[:1] if self.quick else method_pairs(name))
        ]
        out = []
        for base in self.bases:
            mechanisms = [base.stressed, *(level.mechanism for level in self.levels if level.model == base.name)]
            # cases that differ in their start alone share code, and have the name of the base
            distinct = list({mechanism.name: mechanism for mechanism in mechanisms}.values())
            out += pairs_left_out(distinct, everything, self.compilation, self.common.coordinates == "joint")
        return tuple(out)

    def run(self, skipped: tuple[tuple[str, str, str], ...]) -> Stress:
        """Compute references, then runs, largest steps and extreme values."""
        references = [CellReference(level, self.quick) for level in self.levels]
        unknown = [(task, dict[str, Any]()) for task in references]
        tasks: tuple[CellReference | RunTask, ...] = (
            *references,
            *self._run_cells(unknown),
            *self._search_cells(unknown),
        )
        whole = Whole.of_study(_make_cells(tasks), self.progress)
        motions, interrupted = self._compute_cells("references", references, whole)
        runs, searches = list[tuple[RunTask, Outcome]](), list[tuple[RunTask, Outcome]]()
        if not interrupted:
            runs, interrupted = self._compute_cells("runs", list(self._run_cells(motions)), whole)
        if not interrupted:
            searches, interrupted = self._compute_cells("largest steps", list(self._search_cells(motions)), whole)
        extremes = tuple[ExtremeReached, ...]()
        if not interrupted and self.searches:
            # how far a scheme follows stiffness and damping, its largest step says as well
            tried = [(task, run) for task, run in runs if not (self.quick and task.level.family in STIFF)]
            halvings = QUICK_HALVINGS if self.quick else HALVINGS
            extremes, interrupted = search_extremes(tried, self._level_at, self._compute_more, halvings)
        unusable = [
            (task.level, why) for task, motion in motions if (why := cells_without_reference(motion)) is not None
        ]
        return Stress(
            models=tuple(base.name for base in self.bases),
            rows=tuple(_make_row(task, outcome) for task, outcome in runs),
            limits=tuple(_make_limit(task, outcome) for task, outcome in searches),
            extremes=extremes,
            skipped=skipped,
            unusable=tuple((level.model, level.family, level.label, why) for level, why in unusable),
            left_out=self.left_out,
            quick=self.quick,
            interrupted=interrupted,
            coordinates=self.common.coordinates,
            underived=tuple(
                (base.name, what) for base in self.bases if (what := parts_without_derivation(base.mechanism))
            ),
        )

    def _compute_cells(self, what: str, tasks: Sequence[Task], whole: Whole) -> tuple[list[tuple[Task, Outcome]], bool]:
        """Return the finished tasks with their outcomes, and whether the study was interrupted."""
        cells = _make_cells(tasks)
        done, interrupted = run_cells(cells, compute_cell, self.journal, self.jobs, whole.begin_part(what, cells))
        return [(cell.task, done[cell.key]) for cell in cells if cell.key in done], interrupted

    def _compute_more(self, what: str, tasks: Sequence[Any]) -> tuple[list[tuple[Any, Outcome]], bool]:
        """Compute cells that follow from others, whose number was not known before."""
        return self._compute_cells(what, tasks, Whole.of_study(_make_cells(tasks), self.progress))

    def _level_at(self, model: str, family: str, value: float) -> Level | None:
        """Return the case of a family at a value."""
        base = next(base for base in self.bases if base.name == model)
        level = FAMILIES[family].level(base, value)
        return None if level is None else _level_of_study(replace(level, family=family), model, self.max_step)

    def _run_cells(self, motions: Motions) -> Iterator[RunTask]:
        for task, motion in motions:
            for pair in self._pairs_of_models(task.level):
                if self._is_compiled(task.level, pair):
                    yield RunTask(task.level, *pair, motion, self.common, self.quick)

    def _pairs_of_models(self, level: Level) -> tuple[tuple[str, str], ...]:
        if level.pairs is not None:
            return tuple(pair for pair in level.pairs if pair[0] in self.methods)
        names = [n for n in self.methods if level.methods is None or n in level.methods]
        fitting = [method_pairs(name, level.constant_steps) for name in names]
        stiff = level.family in STIFF and not level.constant_steps
        suited = [(name, SUITED) for name in names if name in INDEX_ONE and (name, SUITED) in method_pairs(name)]
        quick = dict.fromkeys([*(fit[0] for fit in fitting if fit), *(suited if stiff else ())])
        return tuple(quick) if self.quick else tuple(pair for fit in fitting for pair in fit)

    def _search_cells(self, motions: Motions) -> Iterator[LimitTask]:
        """Yield one case of each model and family with a search for largest steps, with every method."""
        cases: dict[tuple[str, str], list[tuple[Level, Outcome]]] = {}
        for task, motion in motions if self.searches else ():
            if task.level.family in LIMITED:
                cases.setdefault((task.level.model, task.level.family), []).append((task.level, motion))
        for (_, family), own in cases.items():
            level, motion = min(own, key=lambda case: abs(case[0].values[0] - LIMITED[family]))
            for pair in ((name, constant_integrator(name)) for name in self.methods if name != AUTO):
                if self._is_compiled(level, pair):
                    yield LimitTask(level, *pair, motion, self.common, self.quick)

    def _is_compiled(self, level: Level, pair: tuple[str, str]) -> bool:
        return (level.mechanism.name, *pair) not in [out[:3] for out in self.left_out]


def _make_cells(tasks: Iterable[CellReference | RunTask]) -> list[Cell]:
    """Return the cells of tasks; the first ones of a group compile its code."""
    return with_first_cells((_make_cell(task), _compilation(task)) for task in tasks)


def _compilation(task: CellReference | RunTask) -> float:
    """Return what the first cell with some code takes longer than others; runs compile the code of searches."""
    if isinstance(task, CellReference):
        return FIRST_REFERENCE
    if isinstance(task, LimitTask):
        return 0.0
    over_rates = task.method == AUTO or bool(EXPLICIT_FORMS & {*METHODS.get(task.method, "methods").forms})
    return FIRST_RUN if over_rates else FIRST_SCHEME


def _make_cell(task: CellReference | RunTask) -> Cell:
    """Return the cell of a task, its key from everything that the outcome depends on."""
    level, name = task.level, task.mechanism.name
    parts: dict[str, Any] = {
        "kind": type(task).__name__,
        "code": code_identity(),
        "mechanism": identity_of(task.mechanism),
        "parameters": dict(level.parameters),
        "until": level.until,
        "outputs": level.outputs,
        "spring_end": level.spring_end,
        "closed": level.closed,
        "length": level.length,
        "quick": task.quick,
    }
    steps = min(level.until / level.step, float(BUDGET))
    if isinstance(task, CellReference):
        return Cell(cell_key(**parts), name, task, expected_work("reference", steps), check_motion)
    parts |= {"step": level.step, "options": dict(level.options), "watched": level.watched}
    parts |= {"method": task.method, "integrator": task.integrator, "coordinates": task.common.coordinates}
    limits = [task.common.max_violation, task.common.max_energy_error, task.common.max_attempts]
    searches = isinstance(task, LimitTask)
    cost = expected_work("search" if searches else "run", steps, task.integrator)
    check = check_limit if searches else check_run
    return Cell(cell_key(**parts, limits=limits), f"{name} {task.method}", task, cost, check)


def _make_row(task: RunTask, outcome: Outcome) -> StressRow:
    level = task.level
    constant = task.integrator != AUTO and not INTEGRATORS.get(task.integrator).adaptive
    return StressRow(
        model=level.model,
        family=level.family,
        case=level.label,
        values=level.values,
        method=task.method,
        integrator=task.integrator,
        step=level.step if constant else None,
        until=level.until,
        reference_error=task.reference.get("estimated_error"),
        watched=level.watched,
        **outcome,
    )


def _make_limit(task: RunTask, outcome: Outcome) -> LargestSteps:
    level = task.level
    steps = outcome["stable_step"], outcome["accurate_step"]
    return LargestSteps(level.model, level.family, level.label, task.method, task.integrator, *steps, level.until)
