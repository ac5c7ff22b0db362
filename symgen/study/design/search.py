"""The search: sequential quadratic programmes over sampled motions, sampled anew where quantities are largest between.

A candidate counts when limits hold at many more times than those of the search. The best one is kept, the start among
them, as programmes may end at worse values than they began with.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.study.design.motions import Motions, NoMotion
from symgen.study.design.problem import Varied
from symgen.study.design.residuals import DataAim
from symgen.study.design.rows import Aim, Limit, Sampled, local_minima

Array = NDArray[np.float64]

#: Even times of a search, and how many times as many a candidate is checked at.
SAMPLES, FINER = 73, 20
#: Steps of one programme, and programmes with more times each.
STEPS, ROUNDS = 80, 8
#: Limits may be exceeded by this part of their size.
ALLOWED = 5e-7
#: Programmes end where the aim, in parts of that at the start, changes by less: over all times, and of one number.
STILL, STILLER = 1e-9, 1e-14
#: Rounds end where the aim changes by less than this part of it from one to the next.
SETTLED = 1e-6
#: Times are added where a quantity comes as near as this to its largest value, in parts of that.
NEAR = 0.02
#: Rooms of candidates without a motion, from which programmes turn back, and their aim in parts of that at the start.
CLOSED, FAR = -1e3, 1e3


class Candidate(NamedTuple):
    """Values that were checked at many times.

    Attributes
    ----------
    u : Array, shape (n,)
        Values in parts of their ranges.
    score : float
        The aim, such that less is better.
    excess : float
        The largest part of its size by which a limit is exceeded; 0 within all.
    fine : Sampled
        The motion.
    """

    u: Array
    score: float
    excess: float
    fine: Sampled

    @property
    def is_within(self) -> bool:
        """Whether all limits hold."""
        return self.excess <= ALLOWED

    def is_better_than(self, other: Candidate | None) -> bool:
        """Whether it is within limits and has a smaller aim, or exceeds them by less than one that is not within."""
        if other is None or self.is_within != other.is_within:
            return other is None or self.is_within
        return self.score < other.score if self.is_within else self.excess < other.excess


@dataclass
class Search:
    """Motions of a machine as functions of the numbers that vary, in parts of their ranges.

    Parameters
    ----------
    varied : Varied
        The numbers.
    motions : Motions
        Their motions.
    aim : Aim or DataAim
        The aim.
    limits : sequence of Limit
        The limits.
    until : float
        Last time [s].

    Attributes
    ----------
    runs : int
        Motions that were made.
    failed : Counter
        Reasons of candidates without a motion.
    best : Candidate or None
        The best one of those that were checked.
    """

    varied: Varied
    motions: Motions
    aim: Aim | DataAim
    limits: list[Limit]
    until: float
    runs: int = 0
    failed: Counter[str] = field(default_factory=Counter)
    best: Candidate | None = None

    def __post_init__(self) -> None:
        self.even = np.linspace(0.0, self.until, SAMPLES)
        self.fine = np.linspace(0.0, self.until, FINER * (SAMPLES - 1) + 1)
        if isinstance(self.aim, DataAim):
            self.even, self.fine = self.aim.with_times(self.even, bool(self.limits)), self.aim.with_times(self.fine)
        self._last: tuple[bytes, Sampled | None] = b"", None

    # -- motions -------------------------------------------------------------------------------------------------------

    def sampled(self, u: Array, times: Array, even: Array) -> Sampled | None:
        """Return the motion at times, None where there is none; `even` are those that means are taken over."""
        key = u.tobytes() + times.tobytes()
        if self._last[0] != key:
            found: Sampled | None = None
            self.runs += 1
            try:
                values, slopes = self.motions.at(self.varied.values(u), times)
                slopes = slopes * (self.varied.high - self.varied.low)
                found = Sampled(times, values, slopes, np.searchsorted(times, even))
            except NoMotion as error:
                self.failed[str(error)] += 1
            self._last = key, found
        return self._last[1]

    def check(self, u: Array) -> Candidate | None:
        """Return values with their motion at many times, None without a motion."""
        fine = self.sampled(u, self.fine, self.fine)
        if fine is None:
            return None
        found = Candidate(u.copy(), self.score(fine), self.excess(fine), fine)
        self.best = found if found.is_better_than(self.best) else self.best
        return found

    def score(self, sampled: Sampled) -> float:
        """Return the aim of a motion, such that less is better."""
        return self.aim.score(self.aim.reached(sampled).value)

    def excess(self, sampled: Sampled) -> float:
        """Return the largest part of its size by which a limit is exceeded."""
        return max((limit.excess(limit.reached(sampled).value) for limit in self.limits), default=0.0)

    # -- a search from one start ---------------------------------------------------------------------------------------

    def improve(self, first: Candidate) -> Candidate:
        """Search from a candidate; return the best one."""
        if isinstance(self.aim, DataAim) and not self.limits:
            found = self.check(self.aim.fit(self, first.u))
            return found if found is not None and found.is_better_than(first) else first
        times, best = self._with_peaks(self.even, first.fine), first
        for _ in range(ROUNDS):
            before, ends = best, list[Candidate]()
            for u in Programme(self, times, best).solve():
                if (found := self.check(u)) is not None:
                    ends.append(found)
                    best = found if found.is_better_than(best) else best
            # another programme from where this one ended begins with no curvature, and often goes on
            near = SETTLED * abs(best.score)
            settled = best.is_within and abs(before.score - best.score) <= near
            # one that ended at worse values than it began with missed a peak between its times, which are added below
            if settled and (not ends or (ends[0].is_within and ends[0].score <= best.score + near)):
                break
            for each in (*ends[:1], best):
                times = self._with_peaks(times, each.fine)
        return best

    def _with_peaks(self, times: Array, fine: Sampled) -> Array:
        """Return times with those at which quantities of the aim and the limits are nearly largest in a fine motion."""
        more = [times]
        rows = [limit.rooms(fine)[0] for limit in self.limits if limit.taken.word != "rms" and limit.at_every_time]
        if self.aim.signs:
            y = self.aim.signed(fine)[0]
            rows.append((y.max() - y) / max(abs(y.max()), 1e-300))
        k = len(fine.times)
        for row in rows:
            lowest = local_minima(row, k)
            more.append(fine.times[lowest[row[lowest] < NEAR] % k])
        for limit in self.limits:
            if not limit.at_every_time and limit.taken.word != "rms" and (t := limit.reached(fine).t) is not None:
                more.append(np.array([t]))
        return np.unique(np.concatenate(more))


def tightest(limits: Sequence[Limit]) -> list[Limit]:
    """Return limits without those that others of the same quantity imply."""
    found = dict[tuple[object, ...], Limit]()
    for limit in limits:
        key = limit.taken, limit.quantity, limit.side
        sign = 1.0 if limit.side == "largest" else -1.0
        if key not in found or sign * limit.bound < sign * found[key].bound:
            found[key] = limit
    return [*found.values()]


class Programme:
    """One programme: the aim as small as possible, with limits at some times.

    An aim over all times is a variable of its own, which none of its values exceeds.

    Parameters
    ----------
    search : Search
        The motions.
    times : Array
        Times that count [s].
    first : Candidate
        Where it begins.
    elastic : bool
        Whether limits give way: their largest excess is made as small as possible in place of the aim.
    """

    def __init__(self, search: Search, times: Array, first: Candidate, elastic: bool = False) -> None:
        self.search, self.times, self.first, self.elastic = search, times, first, elastic
        start = self.at(first.u)
        assert start is not None, "it moves at many times"
        self.size = abs(search.aim.reached(start).value) or 1.0
        self.bounded, self.limits = bool(search.aim.signs) or elastic, tightest(search.limits)
        self.best: tuple[float, Array] | None = None
        self.count = len(self._rooms(start)[0])
        self.below = self.count if elastic else len(search.aim.signs) * len(times)  # rows below the bound

    def at(self, u: Array) -> Sampled | None:
        """Return the motion of a candidate at the times."""
        return self.search.sampled(np.clip(u, 0.0, 1.0), self.times, self.search.even)

    def solve(self) -> list[Array]:
        """Return candidates: the best one within limits at the times, and the one at which the programme ended."""
        from scipy.optimize import minimize

        start = self.at(self.first.u)
        assert start is not None, "it was made before"
        w: Array = self.first.u
        bounds: Any = [(0.0, 1.0)] * len(w)
        if self.bounded:
            w = np.append(w, -self._rooms(start)[0][-self.below :].min())
            bounds.append((None, None))
        constraints: Any = [{"type": "ineq", "fun": self.rooms, "jac": self.slopes}] if self.count else []
        options: Any = {"maxiter": STEPS, "ftol": STILL if self.bounded else STILLER}
        found = minimize(
            self.value, w, jac=True, method="SLSQP", bounds=bounds, constraints=constraints, options=options
        )
        end = np.clip(found.x[: len(self.first.u)], 0.0, 1.0)
        return [end] if self.best is None or np.array_equal(self.best[1], end) else [end, self.best[1]]

    def value(self, w: Array) -> tuple[float, Array]:
        """Return the aim in parts of that at the start, and its derivatives."""
        n = len(self.first.u)
        if self.bounded:
            return float(w[-1]), np.append(np.zeros(n), 1.0)
        sampled = self.at(w)
        if sampled is None:
            return FAR, np.zeros(n)
        self._remember(w, sampled)
        value, slopes = self.search.aim.number(sampled)
        return value / self.size, slopes / self.size

    def rooms(self, w: Array) -> Array:
        """Return the rooms to all limits, and of the aim below its bound."""
        sampled = self.at(w[: len(self.first.u)])
        if sampled is None:
            return np.full(self.count, CLOSED)
        self._remember(w[: len(self.first.u)], sampled)
        rooms, _ = self._rooms(sampled)
        if self.bounded:
            rooms[-self.below :] += w[-1]
        return rooms

    def slopes(self, w: Array) -> Array:
        """Return the derivatives of the rooms."""
        n = len(self.first.u)
        sampled = self.at(w[:n])
        if sampled is None:
            return np.zeros((self.count, len(w)))
        slopes = self._rooms(sampled)[1]
        if not self.bounded:
            return slopes
        own = np.zeros(self.count)
        own[-self.below :] = 1.0
        return np.column_stack([slopes, own])

    def _rooms(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return the rooms to limits, then the aim below a bound of 0, with derivatives by the numbers."""
        n = len(self.first.u)
        parts = [limit.rooms(sampled) for limit in self.limits]
        if self.search.aim.signs and not self.elastic:
            y, dy = self.search.aim.signed(sampled)
            parts.append((-y / self.size, -dy / self.size))
        if not parts:
            return np.zeros(0), np.zeros((0, n))
        return np.concatenate([rooms for rooms, _ in parts]), np.concatenate([slopes for _, slopes in parts])

    def _remember(self, u: Array, sampled: Sampled) -> None:
        """Keep a candidate within limits whose aim is the smallest so far."""
        score = self.search.score(sampled)
        if (self.best is None or score < self.best[0]) and self.search.excess(sampled) <= ALLOWED:
            self.best = score, np.clip(u, 0.0, 1.0).copy()
