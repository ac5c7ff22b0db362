"""Extreme values that methods reach: up to which value of a family's quantity every run is accurate.

Between the largest value of the study with which a run is accurate and the next one, with which it is not, values are
halved in the logarithm. Methods that differ nowhere try the same values, so that they share their references.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from symgen.run.planning.automatic import AUTO, constant_integrator
from symgen.study.journal import Outcome
from symgen.study.stress.bench import Level
from symgen.study.stress.cell_outcome import GOOD, REFUSED, UNJUDGED
from symgen.study.stress.cell_references import cells_without_reference
from symgen.study.stress.cells import CellReference, RunTask
from symgen.study.stress.stress_rows import ExtremeReached

#: Families of one quantity that goes to an extreme, each with the least value that counts: masses go two ways.
EXTREMES: Mapping[str, float] = {
    **{"damping": 0.0, "gravity": 0.0, "inconsistent-start": 0.0, "mass-ratio": 1.0, "spin-rate": 0.0},
    "stiffness": 0.0,
}
#: Halvings between two values of the study: a decade to a third, and a hundredfold to a threefold in a quick study.
HALVINGS, QUICK_HALVINGS = 3, 2
#: Below a value that is too large, where no smaller one is accurate but 0, this part of it is tried, and how often.
BELOW, DESCENTS = 1e-2, 2

Finished = Sequence[tuple[Any, Outcome]]
#: What computes tasks: their activity in words -> finished tasks with their outcomes, and whether it was interrupted.
Compute = Callable[[str, Sequence[Any]], tuple[Finished, bool]]


class ExtremeSearch:
    """The search of a method on a family of a model: the largest accurate value and the least that is not.

    Parameters
    ----------
    task : RunTask
        A run of it, with any value.
    judged : sequence of (float, str)
        Values and outcomes, increasing.
    halvings : int
        Of the ratio of two values.
    """

    def __init__(self, task: RunTask, judged: Sequence[tuple[float, str]], halvings: int) -> None:
        self.task, self.open, self.halvings, self.descents = task, True, halvings, DESCENTS
        self.reached: float | None = None
        self.beyond: float | None = None
        for value, outcome in judged:
            if self.beyond is None:
                self.take(value, outcome)

    def take(self, value: float, outcome: str) -> None:
        """Take the outcome at a value between both, or beyond one of them."""
        if outcome == GOOD:
            self.reached = value
        elif outcome in (REFUSED, UNJUDGED):
            self.open = False
        else:
            self.beyond = value

    def follow(self) -> float | None:
        """Return the next value to try; None where the search is at its end."""
        if not self.open or self.beyond is None:
            return None
        if not self.reached:  # None or 0
            self.descents -= 1
            value = BELOW * self.beyond
            return value if self.descents >= 0 and value >= EXTREMES[self.task.level.family] else None
        self.halvings -= 1
        return math.sqrt(self.reached * self.beyond) if self.halvings >= 0 else None

    @property
    def found(self) -> ExtremeReached:
        """What the search has found so far."""
        level = self.task.level
        return ExtremeReached(
            level.model, level.family, self.task.method, self.task.integrator, self.reached, self.beyond
        )


def begin_searches(runs: Finished, halvings: int) -> list[ExtremeSearch]:
    """Return a search for every method, with the integrator of its constant steps, on each model and family."""
    cases: dict[tuple[str, str, str], list[tuple[float, str, RunTask]]] = {}
    for task, outcome in runs:
        level = task.level
        if level.family not in EXTREMES or task.method == AUTO or level.values[0] < EXTREMES[level.family]:
            continue
        if task.integrator == constant_integrator(task.method):
            key = level.model, level.family, task.method
            cases.setdefault(key, []).append((level.values[0], outcome["outcome"], task))
    ordered = (sorted(case, key=lambda each: each[0]) for case in cases.values())
    return [ExtremeSearch(case[0][2], [each[:2] for each in case], halvings) for case in ordered]


def search_extremes(
    runs: Finished, level_at: Callable[[str, str, float], Level | None], compute: Compute, halvings: int
) -> tuple[tuple[ExtremeReached, ...], bool]:
    """Return the extreme values of all methods, and whether the search was interrupted.

    Parameters
    ----------
    runs : sequence of (RunTask, Outcome)
        Finished cells of the study.
    level_at : callable
        (model, family, value) -> case.
    compute : callable
        Computes references and runs.
    halvings : int
        Of the ratio of two values of the study.
    """
    searches, interrupted = begin_searches(runs, halvings), False
    while not interrupted:
        wanted: dict[tuple[str, str, float], list[ExtremeSearch]] = {}
        for search in searches:
            if (value := search.follow()) is not None:
                level = search.task.level
                wanted.setdefault((level.model, level.family, value), []).append(search)
        cases = {key: level_at(*key) for key in wanted}
        levels = {key: case for key, case in cases.items() if case is not None}
        if not levels:
            break
        references = {key: CellReference(level, searches[0].task.quick) for key, level in levels.items()}
        motions, interrupted = compute("references of extreme values", list(references.values()))
        by_level = {id(task): motion for task, motion in motions}
        tasks: dict[int, tuple[ExtremeSearch, float]] = {}
        asked: list[RunTask] = []
        for key, reference in references.items():
            motion = by_level.get(id(reference))
            for search in wanted[key]:
                if motion is None or cells_without_reference(motion) is not None:
                    search.open = False
                    continue
                asked.append(replace(search.task, level=levels[key], reference=motion))
                tasks[id(asked[-1])] = search, key[2]
        if interrupted:
            break
        done, interrupted = compute("extreme values", asked)
        for task, outcome in done:
            search, value = tasks[id(task)]
            search.take(value, outcome["outcome"])
    return tuple(search.found for search in searches), interrupted
