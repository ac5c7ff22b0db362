"""Run times that mean something: a warm-up, then the best of several, with the spread."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from symgen.runtime.run import integrate

if TYPE_CHECKING:
    from symgen.integrators._base import Integrator
    from symgen.model import CompiledModel
    from symgen.runtime.assembly import Start
    from symgen.runtime.run import Outcome, RunSpec


def repeated(
    compiled: CompiledModel,
    tableau: Integrator,
    start: Start,
    spec: RunSpec,
    repeat: int,
    progress: Callable[[float], None] | None = None,
) -> tuple[Outcome, float]:
    """Run once to warm up and `repeat` times for the clock.

    Parameters
    ----------
    compiled, tableau, start, spec, progress
        As for `symgen.runtime.run.integrate`.
    repeat : int
        How many runs are timed; 1 runs once and has no warm-up.

    Returns
    -------
    outcome : Outcome
        Of the last whole run; all are the same but for the clock. `run_seconds` is the shortest; `interrupted` if the
        repetitions were cut short.
    spread : float
        Longest minus shortest run time [s]; 0 for a single run.
    """
    first = integrate(compiled, tableau, start, spec, progress)
    if repeat <= 1 or first.interrupted:
        return first, 0.0
    outcome, seconds = first, list[float]()
    for _ in range(repeat):
        last = integrate(compiled, tableau, start, spec, progress)
        if last.interrupted:  # an earlier run is whole, so nothing is lost but repetitions
            return replace(outcome, run_seconds=min([*seconds, first.run_seconds]), interrupted=True), 0.0
        outcome = last
        seconds.append(last.run_seconds)
    best = replace(outcome, run_seconds=min(seconds), compile_seconds=first.compile_seconds)
    return best, max(seconds) - min(seconds)
