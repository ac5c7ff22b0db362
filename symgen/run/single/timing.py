"""Reliable run times: a warm-up, then the best of several runs by processor time, with the spread."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symgen.run.single.outcome import Outcome


@dataclass(frozen=True)
class Timed:
    """Repeated runs, which differ in their times only.

    Attributes
    ----------
    outcome : Outcome
        Of the last whole run. `cpu_seconds` is the shortest of all; `interrupted` if the repetitions were cut short.
    seconds : tuple of float
        Processor time of every timed run [s]; empty if only the first one ran.
    """

    outcome: Outcome
    seconds: tuple[float, ...]

    @property
    def spread(self) -> float | None:
        """Longest minus shortest run time [s]; None for a single run."""
        return max(self.seconds) - min(self.seconds) if len(self.seconds) > 1 else None


def time_runs(run: Callable[[], Outcome], repeat: int) -> Timed:
    """Run once to warm up and `repeat` times for the clock.

    Parameters
    ----------
    run : callable
        Integrates, and returns the outcome.
    repeat : int
        Number of timed runs; 1 runs once and has no warm-up.
    """
    first = run()
    if repeat <= 1 or first.interrupted:
        return Timed(first, ())
    outcome, seconds = first, list[float]()
    while len(seconds) < repeat:
        last = run()
        if last.interrupted:  # an earlier run is whole: only repetitions are lost
            shortest = min([*seconds, first.cpu_seconds])
            return Timed(replace(outcome, cpu_seconds=shortest, interrupted=True), tuple(seconds))
        outcome = last
        seconds.append(last.cpu_seconds)
    best = replace(outcome, cpu_seconds=min(seconds))
    return Timed(best, tuple(seconds))
