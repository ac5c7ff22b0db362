"""Stability on stiff and extreme cases: every method on every family of cases, each run judged by another route."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from symgen import arguments
from symgen.describe.mechanism import bounded
from symgen.errors import InputError
from symgen.integrators import INTEGRATORS
from symgen.methods import METHODS
from symgen.running.automatic import AUTO
from symgen.running.plan import refuse_events, refuse_weightless
from symgen.settings import Settings
from symgen.study.journal import Journal, Outcome, cell_key, code_identity, mechanism_identity
from symgen.study.runner import Cell, Status, run_cells
from symgen.study.stress.bench import Base, Level, NotApplicable
from symgen.study.stress.cases import CASES, Family
from symgen.study.stress.cells import CRASHED, WATCHED, Limits, LimitTask, ReferenceTask, RunTask, compute
from symgen.study.stress.effort import BUDGET, LeftOut, left_out
from symgen.study.stress.reference import without_reference
from symgen.study.stress.rows import Limit, Row, Stress

#: Integrators that a method is run with, beside its own default: an explicit adaptive one and an implicit one.
FURTHER = ("dop853", "radau5")
#: What is stressed unless a model is named.
DEFAULT_MODEL = "four-bar"
#: Families in which the largest step of each method is looked for, by the case that comes nearest to a value.
LIMITED = ("duration", "stiffness", "damping")

#: Called with what is being done and how far it is.
Progress = Callable[[str, Status], None]


# -- the cells of a study ----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Case:
    """A case of a family for a model."""

    model: str
    level: Level


def pairs(method: str, constant_steps: bool = False) -> tuple[tuple[str, str], ...]:
    """Return a method with the integrators that it is stressed with.

    Parameters
    ----------
    method : str
        A name, or ``auto``.
    constant_steps : bool
        Only integrators with constant steps.
    """
    if method == AUTO:
        return () if constant_steps else ((AUTO, AUTO),)
    chosen = METHODS.get(method, "--methods")
    names = dict.fromkeys([chosen.default_integrator, *FURTHER])
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
    compilation: float = math.inf,
    max_violation: float = WATCHED.max_violation,
    max_energy_error: float = WATCHED.max_energy_error,
    max_attempts: float | None = None,
    coordinates: str = "absolute",
    max_step: float | None = None,
) -> Stress:
    """Run methods on families of stiff and extreme cases.

    Parameters
    ----------
    models : sequence of str or path
        Base models: catalogue entries or files; `DEFAULT_MODEL` by default.
    cases : sequence of str
        Families (`symgen.study.stress.cases.CASES`); all by default.
    methods : sequence of str
        Methods, ``auto`` among them; all and ``auto`` by default.
    quick : bool
        Fewer cases, and each method with its own integrator only.
    journal : Journal, optional
        Keeps what is done; what it holds already is not computed again.
    jobs : int
        Processes to compute on. With more than one, a script needs the usual ``if __name__ == "__main__":``.
    progress : callable, optional
        Called with what is being done and how far it is.
    compilation : float
        Expected seconds of compilation that a model's pairs without a looped shape may take together [s]; pairs beyond
        are left out and listed.
    max_violation, max_energy_error, max_attempts : float
        As for `symgen.Settings`; the first two are of the cases whose runs watch themselves.
    coordinates : {"absolute", "joint", "auto"}
        Those of the state of all runs; references and errors are of bodies in any.
    max_step : float
        Largest step of adaptive integrators and of references [s].

    Returns
    -------
    Stress
        Also after an interruption (KeyboardInterrupt), with the cells that are done.

    Raises
    ------
    InputError
        If a name is wrong; nothing has been run then.
    """
    asked = Settings(
        max_violation=max_violation,
        max_energy_error=max_energy_error,
        max_step=max_step,
        max_attempts=max_attempts,
        coordinates=coordinates,
    )
    limits = Limits(asked.max_violation, asked.max_energy_error, asked.max_attempts)
    cases, methods = arguments.words("cases", cases), arguments.words("methods", methods)
    quick, jobs = arguments.switch("quick", quick), arguments.whole("jobs", jobs, 1, 4096)
    if compilation != math.inf:
        arguments.number("compilation", compilation, positive=True)
    arguments.function("progress", progress)
    if journal is not None:
        arguments.of_kind("journal", journal, Journal, "a symgen.study.journal.Journal")
    models = arguments.listed("models", [models] if isinstance(models, str) else models, "a list of models")
    bases = [Base.of(model) for model in models or (DEFAULT_MODEL,)]
    for base in bases:
        refuse_events("stress", base.mechanism, asked)
        refuse_weightless(base.mechanism)
    bases = [base.without_events() for base in bases]
    chosen = tuple(dict.fromkeys(CASES.canonical(name, "--cases") for name in cases or CASES.names))
    wanted = tuple(dict.fromkeys(methods or (*METHODS.names, AUTO)))
    for name in wanted:
        if name != AUTO:
            METHODS.get(name, "--methods")
    skipped: list[tuple[str, str, str]] = []
    found = list(_cases(bases, chosen, quick, skipped, asked.max_step))
    say = progress or (lambda what, status: None)
    kept = Journal() if journal is None else journal
    how = kept, jobs, say, compilation, limits, asked.coordinates
    return _Study(bases, found, wanted, quick, tuple(skipped), *how).run()


def _cases(
    bases: Sequence[Base],
    families: Sequence[str],
    quick: bool,
    skipped: list[tuple[str, str, str]],
    max_step: float | None,
) -> Iterator[_Case]:
    for number, base in enumerate(bases):
        for name in families:
            family: Family = CASES.get(name)
            if family.own and number > 0:
                continue
            model = "-" if family.own else base.name
            try:
                for level in family.levels(base, quick):
                    yield _Case(model, replace(level, mechanism=bounded(level.mechanism, max_step)))
            except NotApplicable as why:
                skipped.append((base.name, name, str(why)))
            except InputError as error:  # e.g. a handle's name that the model uses already
                skipped.append((base.name, name, str(error)))


@dataclass
class _Study:
    bases: Sequence[Base]
    cases: Sequence[_Case]
    methods: Sequence[str]
    quick: bool
    skipped: tuple[tuple[str, str, str], ...]
    journal: Journal
    jobs: int
    say: Progress
    compilation: float
    limits: Limits
    coordinates: str = "absolute"

    @property
    def _coordinates(self) -> dict[str, str]:
        """What keys of cells say of coordinates: nothing of those that were there first."""
        return {} if self.coordinates == "absolute" else {"coordinates": self.coordinates}

    @cached_property
    def left_out(self) -> dict[str, tuple[LeftOut, ...]]:
        """Pairs that are not run, by model; mechanisms of families of their own are small."""
        asked = [pair for name in self.methods for pair in (pairs(name)[:1] if self.quick else pairs(name))]
        found = {}
        for base in self.bases:
            made = [base.stressed, *(case.level.mechanism for case in self.cases if case.model == base.name)]
            # cases that differ in their start alone share code, and have the name of the base
            distinct = list({mechanism.name: mechanism for mechanism in made}.values())
            found[base.name] = left_out(distinct, asked, self.compilation, self.coordinates == "joint")
        return found

    def _is_left_out(self, case: _Case, method: str, integrator: str) -> bool:
        name = case.level.mechanism.name
        return (name, method, integrator) in [
            (x.mechanism, x.method, x.integrator) for x in self.left_out.get(case.model, ())
        ]

    def run(self) -> Stress:
        """Compute references, then runs, then largest steps."""
        references = [self._reference(case) for case in self.cases]
        motions, interrupted = self._computed("references", references)
        rows: list[Row] = []
        limits: list[Limit] = []
        if not interrupted:
            runs = list(self._runs(references, motions))
            done, interrupted = self._computed("runs", [cell for cell, _, _ in runs])
            rows = [self._row(case, cell.task, done[cell.key]) for cell, case, _ in runs if cell.key in done]
        if not interrupted:
            searches = list(self._limits(references, motions))
            done, interrupted = self._computed("largest steps", [cell for cell, _ in searches])
            limits = [_limit(case, cell.task, done[cell.key]) for cell, case in searches if cell.key in done]
        return Stress(
            models=tuple(base.name for base in self.bases),
            rows=tuple(rows),
            limits=tuple(limits),
            skipped=self.skipped,
            unusable=tuple(_unusable(self.cases, references, motions)),
            left_out=tuple((x.mechanism, x.method, x.integrator, x.why) for out in self.left_out.values() for x in out),
            quick=self.quick,
            interrupted=interrupted,
            coordinates=self.coordinates,
        )

    def _computed(self, what: str, cells: Sequence[Cell]) -> tuple[dict[str, Outcome], bool]:
        return run_cells(cells, compute, self.journal, self.jobs, lambda status: self.say(what, status))

    def _reference(self, case: _Case) -> Cell:
        level = case.level
        parts = {"kind": "reference", "code": code_identity()} | _parts(level, with_run=False)
        return Cell(
            cell_key(**parts), level.mechanism.name, ReferenceTask(level), cost=1e3 + min(level.until / level.step, 1e5)
        )

    def _pairs(self, level: Level) -> tuple[tuple[str, str], ...]:
        if level.pairs is not None:
            return tuple(pair for pair in level.pairs if pair[0] in self.methods)
        names = [n for n in self.methods if level.methods is None or n in level.methods]
        found = [pairs(name, level.constant_steps) for name in names]
        return tuple(pair for fit in found for pair in (fit[:1] if self.quick else fit))

    def _runs(self, references: Sequence[Cell], motions: dict[str, Outcome]) -> Iterator[tuple[Cell, _Case, str]]:
        for case, reference in zip(self.cases, references, strict=True):
            if reference.key not in motions:
                continue
            for method, integrator in self._pairs(case.level):
                if self._is_left_out(case, method, integrator):
                    continue
                known = _crashed_or(motions[reference.key])
                task = RunTask(case.level, method, integrator, known, self.limits, self.coordinates)
                parts = {"kind": "run", "code": code_identity(), "method": method, "integrator": integrator}
                parts |= self._coordinates
                key = cell_key(**parts, limits=asdict(self.limits), reference=reference.key, **_parts(case.level))
                yield (
                    Cell(key, f"{case.level.mechanism.name} {method}", task, _cost(case.level, integrator)),
                    case,
                    method,
                )

    def _limits(self, references: Sequence[Cell], motions: dict[str, Outcome]) -> Iterator[tuple[Cell, _Case]]:
        for case, reference in zip(self.cases, references, strict=True):
            if reference.key not in motions or not self._is_limited(case):
                continue
            for method in self.methods:
                if method == AUTO:
                    continue
                integrator = METHODS.get(method).default_integrator
                if self._is_left_out(case, method, integrator):
                    continue
                known = _crashed_or(motions[reference.key])
                task = LimitTask(case.level, method, integrator, known, self.coordinates)
                parts = {"kind": "limit", "code": code_identity(), "method": method, "integrator": integrator}
                parts |= self._coordinates
                key = cell_key(**parts, reference=reference.key, **_parts(case.level))
                yield Cell(key, f"{case.level.mechanism.name} {method}", task), case

    def _is_limited(self, case: _Case) -> bool:
        """Whether a case is the first of its model and family for which a largest step is looked for."""
        if case.level.family not in LIMITED:
            return False
        same = [c for c in self.cases if c.model == case.model and c.level.family == case.level.family]
        return case is same[0 if case.level.family == "duration" else min(1, len(same) - 1)]

    def _row(self, case: _Case, task: RunTask, outcome: Outcome) -> Row:
        level = case.level
        constant = task.integrator != AUTO and not INTEGRATORS.get(task.integrator).adaptive
        return Row(
            model=case.model,
            family=level.family,
            case=level.label,
            values=level.values,
            method=task.method,
            integrator=task.integrator,
            step=level.step if constant else None,
            until=level.until,
            reference_error=task.reference.get("estimated_error"),
            watched=level.watched,
            **(CRASHED.to_json() if outcome.get("crashed") else outcome),
        )


def _crashed_or(reference: Outcome) -> Outcome:
    return {"unusable": "the process that computed the reference died"} if reference.get("crashed") else reference


def _parts(level: Level, with_run: bool = True) -> dict[str, Any]:
    """Return everything of a case that its outcome depends on, for keys."""
    parts: dict[str, Any] = {
        "mechanism": mechanism_identity(level.mechanism),
        "parameters": dict(level.parameters),
        "until": level.until,
        "outputs": level.outputs,
        "spring_end": level.spring_end,
        "closed": level.closed,
    }
    if with_run:
        parts |= {"step": level.step, "options": dict(level.options), "watched": level.watched}
    return parts


def _cost(level: Level, integrator: str) -> float:
    """Return roughly how long a run takes, for the estimate of what is left [steps]."""
    steps = level.until / level.step
    return 50.0 + min(steps, float(BUDGET)) * (10.0 if integrator == "radau5" else 1.0)


def _limit(case: _Case, task: LimitTask, outcome: Outcome) -> Limit:
    return Limit(
        *(case.model, case.level.family, case.level.label, task.method, task.integrator),
        outcome.get("stable_step"),
        outcome.get("accurate_step"),
        case.level.until,
    )


def _unusable(
    cases: Sequence[_Case], references: Sequence[Cell], motions: dict[str, Outcome]
) -> Iterator[tuple[str, str, str, str]]:
    for case, cell in zip(cases, references, strict=True):
        if cell.key not in motions:
            continue
        why = without_reference(_crashed_or(motions[cell.key]))
        if why is not None:
            yield case.model, case.level.family, case.level.label, why
