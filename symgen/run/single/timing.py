"""Reliable run times: a warm-up, then the best of several runs, with the spread."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from statistics import median
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symgen.run.single.outcome import Outcome

#: Largest number of timed runs, unless more are requested.
MOST = 30


@dataclass(frozen=True)
class Timed:
    """Repeated runs, which differ in their times only.

    Attributes
    ----------
    outcome : Outcome
        Of the last whole run. `run_seconds` is the shortest of all; `interrupted` if the repetitions were cut short.
    seconds : tuple of float
        Of every timed run [s]; empty if only the first one ran.
    """

    outcome: Outcome
    seconds: tuple[float, ...]

    @property
    def spread(self) -> float | None:
        """Longest minus shortest run time [s]; None for a single run."""
        return max(self.seconds) - min(self.seconds) if len(self.seconds) > 1 else None

    @property
    def median(self) -> float:
        """Median run time [s]."""
        return median(self.seconds) if self.seconds else self.outcome.run_seconds


def time_runs(run: Callable[[], Outcome], repeat: int, at_least: float = 0.0, at_most: float = math.inf) -> Timed:
    """Run once to warm up and `repeat` times for the clock.

    Parameters
    ----------
    run : callable
        Integrates, and returns the outcome.
    repeat : int
        Number of timed runs; 1 runs once and has no warm-up.
    at_least : float, optional
        Least total of the timed runs [s], so that short ones are repeated more often, up to `MOST` times.
    at_most : float, optional
        Total of the timed runs from which on none is repeated [s]; a first run so long is the only one.
    """
    first = run()
    if repeat <= 1 or first.interrupted or first.run_seconds >= at_most:
        return Timed(first, ())
    outcome, seconds = first, list[float]()
    while sum(seconds) < at_most and (len(seconds) < repeat or (sum(seconds) < at_least and len(seconds) < MOST)):
        last = run()
        if last.interrupted:  # an earlier run is whole: only repetitions are lost
            shortest = min([*seconds, first.run_seconds])
            return Timed(replace(outcome, run_seconds=shortest, interrupted=True), tuple(seconds))
        outcome = last
        seconds.append(last.run_seconds)
    best = replace(outcome, run_seconds=min(seconds))
    return Timed(best, tuple(seconds))
