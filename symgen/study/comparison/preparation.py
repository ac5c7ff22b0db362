"""Deriving, compiling and references ahead of timing, on several processes: their only trace is the cache.

Timed runs happen one at a time in the calling process, when nothing else is at work. What comes before them dominates
a first study, shares nothing but the cache, and so goes to as many processes as there are cores.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from symgen.describe.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism
from symgen.errors import SymgenError
from symgen.running.plan import Purpose
from symgen.running.prepare import prepare
from symgen.settings import Settings
from symgen.study.journal import Journal
from symgen.study.references.reference import Array, Reference, reference
from symgen.study.references.solvers import AUTO
from symgen.study.runner import Cell, run_cells

#: Work that the first task shows to be shorter [s] is not worth starting processes for.
PATIENCE = 1.0


@dataclass(frozen=True)
class Task:
    """What is made ready: the code of one method with some integrators, or the reference of a mechanism.

    Attributes
    ----------
    what : str
        In words.
    mechanism : Mechanism
        The model.
    settings : tuple of Settings
        One for each integrator; of a reference, one that gives the start.
    times : Array or None
        Output times of a reference [s]; None for code.
    reference_by : str
        Where a reference comes from, as `symgen.study.references.reference.reference` takes it.
    """

    what: str
    mechanism: Mechanism
    settings: tuple[Settings, ...]
    times: Array | None = None
    reference_by: str = AUTO

    def do(self) -> dict[str, Any]:
        """Fill the cache, or return the reference as what JSON can express; what fails is met again by the study."""
        try:
            found = self._do()
        except SymgenError:
            return {}
        return {} if found is None else as_entry(found)

    def _do(self) -> Reference | None:
        if self.times is None:
            for settings in self.settings:
                warm(self.mechanism, settings)
            return None
        settings = self.settings[0]
        compiled, start = prepare(self.mechanism, settings, Purpose.STATE).assembled.of_bodies
        values, (q, v) = parameter_values(self.mechanism, settings.parameters), compiled.info.parts(start.y)
        by = self.reference_by
        return reference(self.mechanism, values, q, v, self.times, solver=by, own_start=not settings.start)


def as_entry(known: Reference) -> dict[str, Any]:
    """Return a reference as what JSON can express, to the last digit, without its times."""
    return {"how": known.how, "estimated_error": known.estimated_error, "note": known.note, "q": known.q.tolist()}


def from_entry(entry: Mapping[str, Any], times: Array) -> Reference:
    """Return the reference of an entry."""
    return Reference(entry["how"], entry["estimated_error"], times, np.array(entry["q"]), entry["note"])


def warm(mechanism: Mechanism, settings: Settings) -> None:
    """Compile everything that a run with these settings calls, by one that is over at once."""
    run = prepare(mechanism, settings).with_spec(until=1e-9, times=np.zeros(1))
    outcome = run.integrate()
    if len(outcome.times):
        _ = run.of_bodies(outcome).acceleration_violations


def work_through(tasks: Sequence[Task], jobs: int, done: Callable[[int], None]) -> tuple[list[Reference | None], bool]:
    """Do all tasks; a task that fails is left for the study to meet again, where it is reported.

    Parameters
    ----------
    tasks : sequence of Task
        In any order.
    jobs : int
        Processes at most. None is started while tasks turn out to be short.
    done : callable
        Called with the number of tasks that are done.

    Returns
    -------
    found : list of (Reference or None)
        One a task; None for code, and where a task failed or was not done.
    interrupted : bool
        Whether a KeyboardInterrupt ended it before all were done.
    """
    found: list[dict[str, Any]] = []
    for i, task in enumerate(tasks):
        began = time.perf_counter()
        try:
            found.append(task.do())
        except KeyboardInterrupt:
            return _references(tasks, found), True
        done(i + 1)
        if time.perf_counter() - began > PATIENCE and jobs > 1 and len(tasks) - i > 2:
            break
    first = len(found)
    cells = [Cell(str(k), task.mechanism.name, task) for k, task in enumerate(tasks[first:], first)]
    outcomes, interrupted = run_cells(cells, Task.do, Journal(), jobs, lambda status: done(first + status.done))
    found += [outcomes.get(cell.key, {}) for cell in cells]
    return _references(tasks, found), interrupted


def _references(tasks: Sequence[Task], found: Sequence[Mapping[str, Any]]) -> list[Reference | None]:
    """Return the references among what was found; a task whose process died has none."""
    entries = [*found, *({} for _ in tasks[len(found) :])]
    return [
        from_entry(entry, task.times) if task.times is not None and "q" in entry else None
        for task, entry in zip(tasks, entries, strict=True)
    ]
