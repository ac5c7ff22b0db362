"""The comparison of one model: the cells of its rows and of its reference, their code, and its runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, NotRequired, TypedDict

import msgspec
import numpy as np

from symgen.api import Model
from symgen.base.errors import SimulationError, SymgenError
from symgen.base.settings import Settings
from symgen.describe.bounds.bounded_modes import two_sided_rows
from symgen.describe.facts.digest import digest, mechanism_digest
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism
from symgen.run.planning.plan import Plan, Purpose
from symgen.run.planning.prepare import Assembled, Preparation, Prepared, prepare
from symgen.study.comparison.combinations import words_of_variant
from symgen.study.comparison.comparison_rows import check_entry, from_entry, to_entry
from symgen.study.comparison.comparison_study import Study
from symgen.study.comparison.distances import Distances, reference_rates, reference_reactions
from symgen.study.comparison.equal_error import ROUNDS, times_at
from symgen.study.comparison.gradients import FACTORS, Gradients, difference_slopes, difference_width
from symgen.study.comparison.measured_runs import measure_run
from symgen.study.comparison.turns import time_in_turns
from symgen.study.journal import Journal, Outcome, cell_key, code_identity
from symgen.study.machine_class import library_versions, machine_class
from symgen.study.references.reference import Array, Reference, reference_motion
from symgen.study.references.routes import fastest_decay, motion_by_two_routes, parts_without_derivation
from symgen.study.references.solvers import AUTO
from symgen.study.runner import Cell, run_cells
from symgen.study.unlimited_runs import WATCHES, without_limits
from symgen.study.yardstick import YARDSTICK

#: Default number of rounds a row, their least total time, the total up to which noisy ones are repeated, and that from
#: which on none is [s]: noise is a small part of a long run.
REPEAT, AT_LEAST, NOISY, AT_MOST = 5, 0.05, 0.4, 10.0
#: What making the code of a method ready counts for in the progress, in rows; no process is started for what takes less
#: than so many seconds.
PREPARATION, PATIENCE = 10.0, 1.0


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
            if self.reference_by == AUTO and parts_without_derivation(mechanism):
                decay = fastest_decay(mechanism, compiled, start)
                motion = motion_by_two_routes(mechanism, values, self.times, decay, settings.start)
            else:
                own = start.y[compiled.info.own_states]
                motion = reference_motion(
                    mechanism, values, *state, self.times, self.reference_by, not settings.start, own
                )
        except SimulationError as error:
            return {"unusable": str(error)}
        rates = reference_rates(mechanism, motion, compiled, start).tolist() if two_sided_rows(mechanism) else None
        return {
            "how": motion.how,
            "estimated_error": motion.estimated_error,
            "note": motion.note,
            "q": motion.q.tolist(),
            "v": motion.v.tolist(),
            "reactions": {
                joint: loads.tolist()
                for joint, loads in (
                    {} if mechanism.bounded else reference_reactions(mechanism, values, motion, compiled, start)
                ).items()
            },
            "rates": rates,
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


def compute_cell_ahead(task: ReferenceTask | CodeTask) -> Outcome | None:
    """Compute a cell ahead of the runs; the runs meet a failure again and report it."""
    try:
        return task.outcome()
    except SymgenError:
        return None


@dataclass
class ModelComparison:
    """One model with all of its runs."""

    model: Model
    common: Settings
    end: float
    times: Array
    settings: list[Settings]
    preparations: list[Preparation]
    reference_by: str
    journal: Journal
    error_at: tuple[float, ...]
    laws: tuple[str, ...]
    gradient: tuple[str, ...] = ()

    @property
    def plans(self) -> list[Plan]:
        """The runs before their code exists."""
        return [preparation.plan for preparation in self.preparations]

    @cached_property
    def pairs(self) -> set[Any]:
        """Code and integrator of the rows that the journal lacks: each pair is compiled once."""
        lacking = zip(self.rows, self.plans, self.laws, strict=True)
        return {(law, plan.key, plan.integrator.name) for cell, plan, law in lacking if cell.key not in self.journal}

    def progress_length(self, ahead: bool) -> float:
        """Return the length of the progress: rows, the reference, and compilation unless it was done ahead."""
        rounds = ROUNDS if self.error_at else 0
        return len(self.plans) + 1 + rounds + (0.0 if ahead else PREPARATION * len(self.pairs))

    @cached_property
    def _parts(self) -> dict[str, Any]:
        """Common parts of the cells' keys; run times depend on the machine and the libraries."""
        base, mechanism = self.settings[0], mechanism_digest(self.model.mechanism)
        parts: dict[str, Any] = {"mechanism": mechanism, "code": code_identity(), "reference": self.reference_by}
        parts |= {
            "machine": machine_class(),
            "versions": library_versions(),
            "until": base.until,
            "times": self.times.tolist(),
        }
        return parts | {"parameters": dict(base.parameters), "start": dict(base.start)}

    @cached_property
    def reference(self) -> Cell:
        """Cell of the reference."""
        task = ReferenceTask(self.model.mechanism, self.settings[0], self.times, self.reference_by)
        return Cell(cell_key(what="reference", **self._parts), self.model.name, task, check=_check_motion)

    @cached_property
    def shifted(self) -> dict[str, tuple[float, dict[int, Cell]]]:
        """Cells of references with other values of the parameters of `gradient`, and by what these differ."""
        base, found = self.settings[0], dict[str, tuple[float, dict[int, Cell]]]()
        values = parameter_values(self.model.mechanism, base.parameters)
        for name in self.gradient:
            width, cells = difference_width(values[name]), dict[int, Cell]()
            for k in FACTORS:
                own = replace(base, parameters={**base.parameters, name: values[name] + k * width})
                parts = {**self._parts, "parameters": dict(own.parameters)}
                task = ReferenceTask(self.model.mechanism, own, self.times, self.reference_by)
                cells[k] = Cell(cell_key(what="reference", **parts), self.model.name, task, check=_check_motion)
            found[name] = width, cells
        return found

    def _gradients(self, motions: Mapping[str, Outcome], distances: Distances | None) -> Gradients | None:
        """Return the derivatives of the reference; None without `gradient`, or where a reference is missing."""
        keys = [cell.key for _, cells in self.shifted.values() for cell in cells.values()]
        if not keys or distances is None or any("q" not in motions[key] for key in keys):
            return None
        slopes = dict[str, Array]()
        for name, (width, cells) in self.shifted.items():
            slopes[name] = difference_slopes({k: np.array(motions[cell.key]["q"]) for k, cell in cells.items()}, width)
        return Gradients(slopes, distances)

    @cached_property
    def rows(self) -> list[Cell]:
        """Cells of the rows; their tasks are indices of the settings."""
        cells = []
        for i, settings in enumerate(self.settings):
            own = {f.name: getattr(settings, f.name) for f in fields(settings) if f.name not in self._parts}
            own |= {"law": self.laws[i]} if self.laws[i] else {}
            own |= {"gradient": self.gradient} if self.gradient else {}
            base = self.yardsticks[i]
            own |= {} if base is None else {"beside": [self.laws[base], self.settings[base].coordinates]}
            cells.append(Cell(cell_key(what="comparison", **self._parts, **own), "", i, check=check_entry))
        return cells

    @cached_property
    def yardsticks(self) -> list[int | None]:
        """By rows, the row that they are timed beside: of `YARDSTICK` with the same integrator and step or tolerance.

        With both coordinates it is that of the ones requested first, so that ratios distinguish them.
        """
        keys = [(str(x.integrator), x.step, x.rtol) for x in self.settings]
        firsts = dict[Any, int]()
        for i, (key, settings) in enumerate(zip(keys, self.settings, strict=True)):
            if settings.method == YARDSTICK:
                firsts.setdefault(key, i)
        return [firsts.get(key) for key in keys]

    def cells_ahead(self) -> list[Cell]:
        """Return the cells that can be computed before the runs and in parallel."""
        groups, mechanisms = dict[Any, dict[str, Settings]](), dict[Any, Mechanism]()
        for cell, settings, plan, law in zip(self.rows, self.settings, self.plans, self.laws, strict=True):
            if cell.key not in self.journal:
                groups.setdefault((law, plan.key), {}).setdefault(plan.integrator.name, settings)
                mechanisms[law, plan.key] = plan.mechanism
        tasks = [CodeTask(mechanisms[key], tuple(group.values())) for key, group in groups.items()]
        codes = [Cell(f"{self.model.name} {i}", self.model.name, task) for i, task in enumerate(tasks)]
        # the reference comes last: it always takes time; cached code takes none, so that no process is started
        shifted = (cell for _, cells in self.shifted.values() for cell in cells.values())
        return [*codes, self.reference, *shifted] if groups else []

    def run_rows(self, show: Callable[[str, float], None], ahead: bool) -> Study:
        """Run the rows that the journal lacks, one at a time; `ahead` says whether their code was compiled before."""

        def reference_motion(task: ReferenceTask) -> Outcome:
            show("reference", 0.0)
            return task.outcome()

        shifted = [cell for _, cells in self.shifted.values() for cell in cells.values()]
        motions, interrupted = run_cells([self.reference, *shifted], reference_motion, self.journal)
        if interrupted:
            return self.make_study(True)
        distances, shared = self._distances(motions[self.reference.key]), dict[str, dict[Any, Assembled]]()
        gradients = self._gradients(motions, distances)
        compiled = set[Any]()

        def begin_run(i: int) -> Prepared:
            return self.preparations[i].run(shared.setdefault(self.laws[i], {}))

        def compute_row(i: int) -> Outcome:
            settings, plan = self.settings[i], self.preparations[i].plan
            words, pair = f"{settings.method}, {settings.integrator}", (self.laws[i], plan.key, plan.integrator.name)
            first = not ahead and pair not in compiled
            if first:
                show(f"compiling {words}", 1.0 + i + PREPARATION * len(compiled))
            run = begin_run(i)
            if first:
                compile_all(run)
                compiled.add(pair)
            show(words, 1.0 + i + PREPARATION * len(compiled))
            first_outcome = run.integrate()
            if first_outcome.interrupted:
                raise KeyboardInterrupt
            stopped = first_outcome if first_outcome.code in WATCHES else None
            timed = run if stopped is None else without_limits(run)  # a study measures what becomes of it
            base = self.yardsticks[i]
            beside = None if base is None or base == i else without_limits(begin_run(base)).integrate
            warm = first_outcome if stopped is None else None
            runs = time_in_turns(timed.integrate, beside, settings.repeat, AT_LEAST, AT_MOST, warm, NOISY)
            variant = words_of_variant(settings, self.common)
            entry, trace = measure_run(run, runs, distances, variant, stopped, self.laws[i])
            if base == i and entry.ended:
                entry = replace(entry, cost_ratio=1.0)
            if gradients is not None:
                entry = replace(entry, **gradients.measure_all(self.model.mechanism, settings))
            return to_entry(entry, trace)

        def time_in_turn(indices: list[int]) -> Outcome:
            runs, seconds = [without_limits(begin_run(i)) for i in indices], list[list[float]]()
            for k in range(ROUNDS):
                show(f"round {k + 1} of {ROUNDS}", 1.0 + len(self.plans) + PREPARATION * len(compiled) + k)
                outcomes = [run.integrate() for run in runs]
                if any(outcome.interrupted for outcome in outcomes):
                    raise KeyboardInterrupt
                seconds.append([outcome.cpu_seconds for outcome in outcomes])
            return {"seconds": seconds}

        done, interrupted = run_cells(self.rows, compute_row, self.journal)
        if self.error_at and not interrupted:
            ended = [i for i, cell in enumerate(self.rows) if from_entry(done[cell.key])[0].ended]
            interrupted = run_cells([self.cell_of_rounds(ended)], time_in_turn, self.journal)[1]
        return self.make_study(interrupted)

    def cell_of_rounds(self, ended: list[int]) -> Cell:
        """Return the cell of the run times of some rows, round by round."""
        keys = [self.rows[i].key for i in ended]
        return Cell(cell_key(what="rounds", rows=keys, rounds=ROUNDS), "", ended, check=_check_rounds)

    def _distances(self, entry: Outcome) -> Distances | None:
        """Return the measures of errors by a journal's entry, None where it holds the reason of their absence."""
        if "unusable" in entry:
            return None
        q, v = np.array(entry["q"]), np.array(entry["v"])
        motion = Reference(entry["how"], entry["estimated_error"], self.times, q, v, entry["note"])
        reactions = {joint: np.array(loads) for joint, loads in entry["reactions"].items()}
        rates = None if entry.get("rates") is None else np.array(entry["rates"])
        return Distances(self.model.mechanism, self.settings[0].parameters, motion, reactions, rates)

    def make_study(self, interrupted: bool) -> Study:
        """Return the study of the finished rows."""
        motion = self.journal.get(self.reference.key) or {"unusable": ""}
        done = [from_entry(entry) for cell in self.rows if (entry := self.journal.get(cell.key)) is not None]
        base, why = self.settings[0], motion.get("unusable")
        distances = self._distances(motion) if "q" in motion else None
        without = "there is no reference, so errors are unknown"
        rows = tuple(row for row, _ in done)
        rounds = list[list[float | None]]()
        if len(rows) == len(self.rows) and self.error_at:
            ended = [i for i, row in enumerate(rows) if row.ended]
            measured_times = self.journal.get(self.cell_of_rounds(ended).key) or {"seconds": []}
            for seconds in measured_times["seconds"]:
                by_row = dict(zip(ended, seconds, strict=True))
                rounds.append([by_row.get(i) for i in range(len(rows))])
        return Study(
            mechanism=self.model.name,
            how=motion.get("how", "none"),
            estimated_error=motion.get("estimated_error", float("nan")),
            until=self.end,
            rows=rows,
            at=times_at(rows, rounds, self.error_at),
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
            length=None if distances is None else distances.size,
            speed=None if distances is None else distances.speed,
            reaction=None if distances is None else distances.load,
        )


class _Motion(TypedDict):
    how: str
    estimated_error: float
    q: list[list[float]]
    v: list[list[float]]
    reactions: dict[str, list[list[float]]]
    note: str
    rates: NotRequired[list[list[float]] | None]


class _Rounds(TypedDict):
    seconds: list[list[float]]


class _Unusable(TypedDict):
    unusable: str


def _check_rounds(entry: Outcome) -> None:
    """Raise `ValueError` unless an entry of a journal is one of run times."""
    msgspec.convert(entry, _Rounds)


def _check_motion(entry: Outcome) -> None:
    """Raise `ValueError` unless an entry of a journal belongs to a reference."""
    msgspec.convert(entry, _Unusable if "unusable" in entry else _Motion)
