"""The cells of a stress study: references, single runs, and bisections for the largest step.

Each is one task for a process (`symgen.study.runner`), and its outcome is plain JSON.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import AssemblyError, InputError
from symgen.base.settings import Settings
from symgen.derive.lower.looped.looped_law import is_loopable
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism
from symgen.result.contract import json_value
from symgen.result.judge import is_long, judge, reason_without_check
from symgen.result.points import Points
from symgen.result.reruns.verification import verify_first_part, verify_run
from symgen.result.result import INTERRUPTED
from symgen.run.compiling.choices import choose_coordinates
from symgen.run.compiling.method_choice import choice_for_coordinates
from symgen.run.compiling.pipeline import straight_alone
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout import abi
from symgen.run.loops.integrator import chooses_steps
from symgen.run.planning.automatic import AUTO
from symgen.run.planning.options import split_options
from symgen.run.planning.prepare import find_preparation
from symgen.run.single.outcome import Outcome
from symgen.run.starts.assembler import close_many_starts
from symgen.study.references.effort import evaluation_budget, further_budget, least_evaluations, smallest_step
from symgen.study.stress import cell_outcome as judged
from symgen.study.stress import shared_by_cells as kept
from symgen.study.stress.bench import Level
from symgen.study.stress.cell_outcome import CellRun, classify_outcome, largest_error
from symgen.study.stress.cell_references import (
    cells_without_reference,
    emitted_geometry,
    reference_of_cell,
    times_of_cell,
)
from symgen.study.stress.searches import HALVINGS, QUICK_HALVINGS, largest_steps
from symgen.study.unlimited_runs import UNWATCHED, WATCHES, without_limits

#: Evaluations of a run that verifies another one, over the budget of that, at most.
VERIFIED = 20

Array = NDArray[np.float64]
Fields = dict[str, Any]


@dataclass(frozen=True)
class CellReference:
    """Compute the reference motion of a case, with fewer evaluations in a quick study."""

    level: Level
    quick: bool = False

    @property
    def mechanism(self) -> Mechanism:
        """What moves."""
        return self.level.of_reference


@dataclass(frozen=True)
class RunTask:
    """Run a case with a method and an integrator; `reference` is the outcome of its `CellReference`.

    `common` holds the common settings of all runs: coordinates of the state, and limits of a run that watches itself.
    In a quick study a run has fewer evaluations.
    """

    level: Level
    method: str
    integrator: str
    reference: Fields
    common: Settings = field(default_factory=Settings)
    quick: bool = False

    @property
    def mechanism(self) -> Mechanism:
        """What moves."""
        return self.level.mechanism


@dataclass(frozen=True)
class LimitTask(RunTask):
    """Find the largest constant step of a method and an integrator for a case."""

    @property
    def halvings(self) -> int:
        """Halvings of the search."""
        return QUICK_HALVINGS if self.quick else HALVINGS


def compute_cell(task: CellReference | RunTask) -> Fields:
    """Compute a cell; see the classes of tasks."""
    level = replace(task.level, mechanism=kept.shared_mechanism(task.mechanism))
    with close_many_starts():
        if isinstance(task, CellReference):
            return reference_of_cell(replace(level, plain=None), task.quick)
        task = replace(task, level=level)
        fields: Fields = json_value(_find_limit(task) if isinstance(task, LimitTask) else _run_cell(task))
        return fields


# -- runs --------------------------------------------------------------------------------------------------------------


def _outcome_not_run(outcome: str, reason: str, evaluations: int = 0, chosen: str = "") -> Fields:
    names = ("error", "relative_error", "position_violation_max", "velocity_violation_max", "energy_drift_max")
    numbers = dict.fromkeys(names)
    words = {"outcome": outcome, "status": "not run", "reason": reason, "chosen": chosen, "note": "", "verified": ""}
    return {**words, **numbers, "evaluations": evaluations}


def _settings_of_cell(task: RunTask) -> Settings:
    """Return the settings of a run."""
    level = task.level
    return replace(
        task.common,
        method=task.method,
        integrator=task.integrator,
        step=None if _is_adaptive(task.integrator, level.options) else level.step,
        until=level.until,
        times=times_of_cell(level),
        parameters={**level.parameters, **task.reference.get("parameters", {})},
        options=level.options,
        **({} if level.watched else UNWATCHED),
    )


def _run_cell(task: RunTask, searched: bool = False) -> Fields:
    """Return the fields of a row that depend on the run; without a reference nothing is run."""
    level, method, motion = task.level, task.method, task.reference
    mechanism, settings = level.mechanism, _settings_of_cell(task)
    try:
        ready = find_preparation(mechanism, _choose_shape(mechanism, settings))
        plan = ready.plan
        why = cells_without_reference(motion)
        if why is not None:
            return _outcome_not_run(judged.UNJUDGED, why)
        budget = evaluation_budget(plan, mechanism, searched, task.quick)
        chosen = f"{plan.choice.method.name}, {plan.integrator.name}" if method == AUTO else ""
        least = least_evaluations(plan, motion["decay"])
        if least > budget:
            what = "at least " if plan.spec.adaptive else ""
            return _outcome_not_run(
                judged.TOO_SLOW, f"{what}{least:.3g} evaluations, more than {budget:.3g}", 0, chosen
            )
        shared = kept.starts_of_cell(mechanism, settings.parameters, level.options)
        run = ready.run(None if method == AUTO else shared, kept.code_of_cell).with_spec(max_evaluations=budget)
    except (InputError, AssemblyError) as error:
        return _outcome_not_run(judged.REFUSED, str(error))
    outcome, verification = run.integrate(), None
    if method == AUTO:
        run, outcome, verification = verify_run(run, outcome, free=True)
    if outcome.interrupted:
        raise KeyboardInterrupt
    if outcome.evaluations > budget or outcome.code == abi.STOPPED:
        return _outcome_not_run(judged.TOO_SLOW, f"more than {budget:.3g} evaluations", budget, chosen)
    first, verdict, verified = run, judge(run, run.of_bodies(outcome), verification), ""
    assert verdict.reason != INTERRUPTED, "an interrupted run has raised"
    compared, note = _compare_with_reference(level, plan.parameters, run.of_bodies(outcome), motion), ""
    kind = classify_outcome(compared)
    if outcome.code != abi.DONE:
        note = f"ended at t = {outcome.end:.4g} s"
    if outcome.code in WATCHES and kind == judged.DIVERGED:
        # it stopped itself before its error could be seen: what would have become of it says what it was
        most = further_budget(budget, outcome.evaluations, task.quick, outcome.end / level.until)
        run = without_limits(run).with_spec(max_evaluations=most)
        further = run.integrate()
        if further.interrupted:
            raise KeyboardInterrupt
        compared = _compare_with_reference(level, plan.parameters, run.of_bodies(further), motion)
        if further.evaluations > most:  # however late it was stopped: no clock decides
            compared = replace(compared, finished=False)
        kind = classify_outcome(compared)
        if kind == judged.GOOD:
            kind, note = judged.INACCURATE, f"{note}; off its constraints, not off the motion"
    if level.watched and method != AUTO and judged.false_success(verdict.status, kind):
        # as a user has it: by default where a run is verified by default, and where that is asked for
        again = first.with_spec(max_evaluations=VERIFIED * budget)
        checked = judge(first, first.of_bodies(outcome), verify_run(again, outcome)[2])
        verified = checked.status
        if reason_without_check(first, outcome) is None:
            verdict = checked
        elif is_long(first, outcome):
            verdict = judge(first, first.of_bodies(outcome), verify_first_part(again, outcome))
    largest = largest_error(compared.errors)
    return {
        "outcome": kind,
        "error": largest,
        "relative_error": None if largest is None or not compared.length else largest / compared.length,
        "status": verdict.status,
        "reason": verdict.reason,
        "evaluations": outcome.evaluations,
        "position_violation_max": outcome.position_violation_max,
        "velocity_violation_max": outcome.velocity_violation_max,
        "energy_drift_max": outcome.energy_drift_max,
        "chosen": chosen,
        "note": note,
        "verified": verified,
    }


def _is_adaptive(integrator: str, options: Mapping[str, str | float]) -> bool:
    """Whether a run chooses its own first step."""
    if integrator == AUTO:
        return True
    return chooses_steps(INTEGRATORS.get(integrator, "integrator"), options)


def _choose_shape(mechanism: Mechanism, settings: Settings) -> Settings:
    """Return settings with looped code where the method has it: it compiles once for all mechanisms.

    The runs of a study are short. Joint coordinates have straight code only.
    """
    coordinates = choose_coordinates(mechanism, settings.coordinates, "straight").name
    looped = coordinates == "absolute" and not straight_alone(mechanism)
    if looped and settings.method != AUTO:
        choice = choice_for_coordinates(
            mechanism, split_options(settings, INTEGRATORS.get(str(settings.integrator)))[0]
        )
        looped = is_loopable(choice.method, choice.options, choice.implicit)
    return replace(settings, coordinates=coordinates, shape="looped" if looped else "straight")


def _compare_with_reference(level: Level, parameters: Mapping[str, float], outcome: Outcome, motion: Fields) -> CellRun:
    """Return the facts that classification uses."""
    values = parameter_values(level.mechanism, parameters)
    points = Points.of_mechanism(level.mechanism, values)
    nq, count = outcome.compiled.info.nq, len(outcome.times)
    states = outcome.states[:, :nq]
    with np.errstate(all="ignore"):
        errors = points.distances_over_time(states, np.array(motion["q"])[:count])
    violation = 0.0
    if not np.all(errors <= judged.ACCURATE * motion["length"]):  # the equations are compiled only where it matters
        violation = math.inf
        if count and np.all(np.isfinite(outcome.states[-1])):
            equations = emitted_geometry(level, values, outcome.compiled, outcome.start)
            v = outcome.states[-1, nq : nq + outcome.compiled.info.nv]
            phi = equations.evaluate(float(outcome.times[-1]), states[-1].copy(), v.copy())[0]
            violation = float(np.linalg.norm(phi))
    return CellRun(
        finished=outcome.code == abi.DONE,
        errors=errors,
        sines=np.array(motion["sines"]),
        violation=violation,
        length=motion["length"],
    )


# -- the largest step --------------------------------------------------------------------------------------------------


def _find_limit(task: LimitTask) -> Fields:
    """Find the largest step that follows the motion at all, and the largest one that is accurate."""
    if cells_without_reference(task.reference) is not None:
        return {"stable_step": None, "accurate_step": None}
    options = {**task.level.options, **_constant_step(task)}

    def settings_with_step(step: float) -> RunTask:
        level = replace(task.level, step=step, watched=False, options=options)
        return RunTask(level, task.method, task.integrator, task.reference, task.common, task.quick)

    slow, length = 0.0, task.reference["length"]

    def error_at_step(step: float) -> float:
        """Return the error of a run over the length; infinite where the run does not come to its end."""
        nonlocal slow
        if step <= slow:  # smaller steps take more evaluations than one that takes too many
            return math.inf
        fields = _run_cell(settings_with_step(step), searched=True)
        slow = step if fields["outcome"] == judged.TOO_SLOW else slow
        return math.inf if fields["error"] is None or fields["note"] else float(fields["error"] / length)

    first = task.level.step
    limits, smallest = (judged.LOST, judged.ACCURATE), _smallest_singular_value(settings_with_step(first))
    found = largest_steps(
        error_at_step, first, task.level.until, _stability_boundary(task), limits, task.halvings, smallest
    )
    return dict(zip(("stable_step", "accurate_step"), found, strict=True))


def _smallest_singular_value(task: RunTask) -> float:
    """Return the smallest step within the budget of a search [s]; 0 where the pair is refused."""
    try:
        plan = find_preparation(task.level.mechanism, _choose_shape(task.level.mechanism, _settings_of_cell(task))).plan
    except (InputError, AssemblyError):
        return 0.0
    return smallest_step(plan, evaluation_budget(plan, task.level.mechanism, True, task.quick))


def _constant_step(task: LimitTask) -> dict[str, str]:
    return {"integrator.adaptive": "false"} if INTEGRATORS.get(task.integrator).adaptive else {}


def _stability_boundary(task: LimitTask) -> float:
    """Return the step at which a scheme is at the end of its region of stability where the motion starts [s]."""
    integrator, decay = INTEGRATORS.get(task.integrator), float(task.reference["decay"])
    return integrator.real_boundary / decay if decay > 0.0 else math.inf
