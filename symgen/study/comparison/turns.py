"""Processor times of a run and of a yardstick, in turns.

Other work of the machine takes the processor away, which a wall clock counts, and shares memory and caches, which
lengthens every run. The clock therefore belongs to the run's own thread, and a ratio is taken within a round: the run
and the yardstick, one after the other, share what the machine does meanwhile.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import TYPE_CHECKING

import numpy as np

from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.run.single.outcome import Outcome

#: Largest number of rounds, unless more are requested; and where noise asks for more.
MOST, MOST_NOISY = 30, 400
#: Half an interval over its ratio that a noisy row is repeated for.
NEAR = 0.025
#: A wall clock that is longer than the processor time by this factor: other work had the processor meanwhile.
DISTURBED = 1.5
#: Probability with which the interval of a median over rounds holds it.
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Turns:
    """Rounds of one run, which differ in their times only.

    Attributes
    ----------
    outcome : Outcome
        Of the last round.
    seconds, wall : tuple of float
        Processor time of the thread of the run, and time on the wall [s], by round; of one round for a single run.
    ratios : tuple of float
        Processor time over that of the yardstick in the same round; empty without a yardstick that reaches its end.
    """

    outcome: Outcome
    seconds: tuple[float, ...]
    wall: tuple[float, ...]
    ratios: tuple[float, ...] = ()

    @property
    def single(self) -> bool:
        """Whether there was one round only."""
        return len(self.seconds) < 2

    @property
    def load(self) -> float:
        """Time on the wall over processor time."""
        spent = sum(self.seconds)
        return sum(self.wall) / spent if spent > 0.0 else 1.0

    @property
    def disturbed(self) -> bool:
        """Whether other work had the processor for long."""
        return self.load > DISTURBED

    @property
    def quartiles(self) -> tuple[float, float] | None:
        """Quartiles of the processor time [s]; None for a single run."""
        if self.single:
            return None
        low, high = np.percentile(self.seconds, [25.0, 75.0]).tolist()
        return low, high

    @property
    def ratio(self) -> float | None:
        """Median of the ratios."""
        return median(self.ratios) if self.ratios else None

    @property
    def near(self) -> bool:
        """Whether the interval of the ratio is no wider than noise may leave it."""
        low, high = self.ratio_interval or (0.0, 0.0)
        middle = self.ratio or 0.0
        return max(high - middle, middle - low) <= NEAR * middle

    @property
    def ratio_interval(self) -> tuple[float, float] | None:
        """Interval that holds the median of the ratios with 95 %; None for a single run."""
        return interval_of_median(self.ratios) if len(self.ratios) > 1 else None


def interval_of_median(values: Sequence[float]) -> tuple[float, float]:
    """Return the narrowest pair of values, equally many from both ends, that holds the median with `CONFIDENCE`.

    Nothing is assumed of how values are distributed: each of them lies below the median with one half. Of five and
    fewer values the least and the largest are returned, which hold it with less.
    """
    ordered, n, below = sorted(values), len(values), 0.0
    for k in range(n // 2):
        below += math.comb(n, k) / 2.0**n
        if 1.0 - 2.0 * below < CONFIDENCE:
            k = max(k - 1, 0)
            break
    else:
        k = max(n // 2 - 1, 0)
    return ordered[k], ordered[n - 1 - k]


def time_in_turns(
    run: Callable[[], Outcome],
    yardstick: Callable[[], Outcome] | None,
    repeat: int,
    at_least: float = 0.0,
    at_most: float = math.inf,
    first: Outcome | None = None,
    noisy: float = 0.0,
) -> Turns:
    """Run once to warm up, and in rounds beside a yardstick for the clock; once more where other work disturbs.

    Parameters
    ----------
    run, yardstick : callable
        Integrate, and return their outcomes.
    repeat : int
        Number of rounds; 1 runs once and has no warm-up.
    at_least : float, optional
        Least total of the run's rounds [s], so that short ones are repeated more often, up to `MOST` times.
    at_most : float, optional
        Total of a round and its yardstick's from which on none is repeated [s]; a first run so long is the only one.
    first : Outcome, optional
        Of a run that has warmed up already.
    noisy : float, optional
        Total of rounds and their yardsticks' [s] up to which they are repeated, at most `MOST_NOISY` times, until half
        the interval of the ratio is within `NEAR`.

    Raises
    ------
    KeyboardInterrupt
        If a run was interrupted.
    """
    outcome = _whole(run()) if first is None else first
    beside = yardstick if outcome.code == abi.DONE else None
    if repeat <= 1 or outcome.cpu_seconds >= at_most:
        other = _whole(beside()) if beside is not None else None
        return _turns_of_rounds([(outcome, other)])
    if beside is not None:
        _whole(beside())
    limits = repeat, at_least, at_most, noisy
    turns = _measure_rounds(run, beside, *limits)
    if turns.disturbed:
        turns = min(turns, _measure_rounds(run, beside, *limits), key=lambda x: x.load)
    return turns


def _measure_rounds(
    run: Callable[[], Outcome],
    beside: Callable[[], Outcome] | None,
    repeat: int,
    at_least: float,
    at_most: float,
    noisy: float,
) -> Turns:
    rounds = list[tuple["Outcome", "Outcome | None"]]()
    own = whole = 0.0

    def is_uncertain() -> bool:
        return whole < noisy and len(rounds) < MOST_NOISY and beside is not None and not _turns_of_rounds(rounds).near

    while whole < at_most and (
        len(rounds) < repeat or (own < at_least and len(rounds) < MOST) or (len(rounds) > 1 and is_uncertain())
    ):
        outcome, other = _whole(run()), _whole(beside()) if beside is not None else None
        own += outcome.cpu_seconds
        whole += outcome.cpu_seconds + (0.0 if other is None else other.cpu_seconds)
        rounds.append((outcome, other))
    return _turns_of_rounds(rounds)


def _turns_of_rounds(rounds: Sequence[tuple[Outcome, Outcome | None]]) -> Turns:
    pairs = [(x.cpu_seconds, other.cpu_seconds) for x, other in rounds if other is not None and other.code == abi.DONE]
    return Turns(
        outcome=rounds[-1][0],
        seconds=tuple(x.cpu_seconds for x, _ in rounds),
        wall=tuple(x.run_seconds for x, _ in rounds),
        ratios=tuple(a / b for a, b in pairs if b > 0.0),
    )


def _whole(outcome: Outcome) -> Outcome:
    """Return the outcome of a run that nobody interrupted."""
    if outcome.interrupted:
        raise KeyboardInterrupt
    return outcome
