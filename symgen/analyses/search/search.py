"""The search: sequential quadratic programmes over sampled motions, sampled anew where quantities are largest between.

A candidate counts when limits hold at many more times than those of the search. The best one is kept, the start among
them, as programmes may end at worse values than they began with.
"""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.measured_data import ColumnAim
from symgen.analyses.search.programme import ALLOWED, Programme
from symgen.analyses.search.ranges import Ranges
from symgen.analyses.search.sampled_motions import Aim, Limit, Motions, NoMotion, Remembering, Sampled, local_minima
from symgen.analyses.search.squares import least_squares_within

Array = NDArray[np.float64]

#: Even times of a search, and how many times as many a candidate is checked at.
SAMPLES, FINER = 73, 20
#: Programmes with more times each.
ROUNDS = 8
#: Rounds end where the aim changes by less than this part of it from one to the next.
SETTLED = 1e-6
#: Times are added where a quantity comes as near as this to its largest value, in parts of that.
NEAR = 0.02
#: Means over the times of a search count where those over the times of checks, and their slopes, are as near as this.
SAME_MEAN = 1e-9
#: Candidates for each start beside that of the file.
CANDIDATES = 128
#: Starts are at least so far apart, in parts of the ranges' diagonal.
APART = 0.05


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


class Search:
    """Motions of a machine as functions of the numbers that vary, in parts of their ranges.

    Parameters
    ----------
    ranges : Ranges
        The numbers, with two bounds each.
    motions : Motions
        Their motions.
    aim : Aim or ColumnAim
        The aim.
    limits : list of Limit
        The limits.
    until : float
        Last time [s].

    Attributes
    ----------
    even, fine, times : Array
        Even times of the search, even times of checks, and times of the search with those of measured columns [s].
    runs : int
        Motions that were made.
    failed : Counter
        Reasons of candidates without a motion.
    best : Candidate or None
        The best one of those that were checked.
    """

    def __init__(
        self, ranges: Ranges, motions: Motions, aim: Aim | ColumnAim, limits: list[Limit], until: float
    ) -> None:
        self.ranges, self.motions, self.aim, self.limits = ranges, motions, aim, limits
        self.runs, self.failed = 0, Counter[str]()
        self.best: Candidate | None = None
        self.even = np.linspace(0.0, until, SAMPLES)
        self.fine = np.linspace(0.0, until, FINER * (SAMPLES - 1) + 1)
        own = aim.times if isinstance(aim, ColumnAim) else self.even[:0]
        self.times, self._checks = np.union1d(self.even, own), np.union1d(self.fine, own)
        self.sampled = Remembering(self._sampled)

    # -- motions -------------------------------------------------------------------------------------------------------

    def _sampled(self, u: Array, times: Array, even: Array) -> Sampled | None:
        """Return the motion at times, None where there is none; `even` are those that means are taken over."""
        self.runs += 1
        try:
            values, slopes = self.motions.at(self.ranges.values(u), times)
        except NoMotion as error:
            self.failed[str(error)] += 1
            return None
        slopes = slopes * (self.ranges.high - self.ranges.low)
        return Sampled(times, values, slopes, np.searchsorted(times, even))

    def check(self, u: Array) -> Candidate | None:
        """Return values with their motion at many times, None without a motion."""
        fine = self.sampled(u, self._checks, self.fine)
        if fine is None:
            return None
        found = Candidate(u.copy(), self.aim.score(fine), self.excess(fine), fine)
        self.best = found if found.is_better_than(self.best) else self.best
        return found

    def excess(self, sampled: Sampled) -> float:
        """Return the largest part of its size by which a limit is exceeded."""
        return max((limit.excess(limit.reached(sampled).value) for limit in self.limits), default=0.0)

    # -- a search from one start ---------------------------------------------------------------------------------------

    def improve(self, first: Candidate) -> Candidate:
        """Search from a candidate; return the best one."""
        if isinstance(self.aim, ColumnAim) and not self.limits:
            found = self.check(self._fit(self.aim, first.u))
            return found if found is not None and found.is_better_than(first) else first
        times, even, best = self._with_peaks(self.times, first.fine), self.even, first
        for _ in range(ROUNDS):
            before, ends = best, list[Candidate]()
            for u in Programme(self, times, even, best).solve():
                if (found := self.check(u)) is not None:
                    ends.append(found)
                    best = found if found.is_better_than(best) else best
            # another programme from where this one ended begins with no curvature, and often goes on
            near = SETTLED * abs(best.score)
            settled = best.is_within and abs(before.score - best.score) <= near
            # one that ended at worse values than it began with missed a peak between its times, which are added below
            if settled and (not ends or (ends[0].is_within and ends[0].score <= best.score + near)):
                if even is self.fine or self._has_its_means(best.fine):
                    break
                times, even = np.union1d(times, self.fine), self.fine
            for each in (*ends[:1], best):
                times = self._with_peaks(times, each.fine)
        return best

    def relax(self, first: Candidate) -> None:
        """Check candidates whose limits are missed least, from one that does not keep them."""
        for u in Programme(self, self.times, self.even, first, elastic=True).solve():
            self.check(u)

    def _fit(self, aim: ColumnAim, u: Array) -> Array:
        """Return the values of least squares."""

        def rows(u: Array) -> tuple[Array, Array]:
            sampled = self.sampled(u, aim.times, aim.times)
            if sampled is None:
                return np.full(aim.columns.count, np.inf), np.zeros((aim.columns.count, len(u)))
            return aim.residuals(sampled)

        return least_squares_within(rows, u, np.zeros(len(u)), np.ones(len(u))).x

    def _has_its_means(self, fine: Sampled) -> bool:
        """Whether means over the times of a search are those over the times of checks, with their slopes."""
        for each in (self.aim, *self.limits):
            if isinstance(each, Aim | Limit) and each.taken.word == "rms":
                value, slope = fine.mean_square(each.quantity)
                coarse, other = fine.mean_square(each.quantity, FINER)
                size = float(np.max(np.abs(fine.slopes[:, each.quantity]), initial=0.0))
                if abs(coarse - value) > SAME_MEAN * value or np.max(np.abs(other - slope)) > SAME_MEAN * size:
                    return False
        return True

    def _with_peaks(self, times: Array, fine: Sampled) -> Array:
        """Return times with those at which quantities of the aim and the limits are nearly largest in a fine motion."""
        more = [times]
        limits = [limit for limit in self.limits if limit.taken.word != "rms"]
        rows = [limit.rooms(fine)[0] for limit in limits if limit.at_every_time]
        if isinstance(self.aim, Aim) and self.aim.is_bounded:
            y = self.aim.signed(fine)[0]
            rows.append((y.max() - y) / max(abs(y.max()), 1e-300))
        k = len(fine.times)
        for row in rows:
            lowest = local_minima(row, k)
            more.append(fine.times[lowest[row[lowest] < NEAR] % k])
        more += [np.array([limit.reached(fine).t]) for limit in limits if not limit.at_every_time]
        return np.unique(np.concatenate(more))


class Screened(NamedTuple):
    """Candidates that were looked at before searches.

    Attributes
    ----------
    tried, moving, within : int
        All of them, those that move through all times, and those within all limits.
    starts : list of Array
        The best ones, in parts of the ranges.
    failed : Counter
        Reasons of the others.
    """

    tried: int
    moving: int
    within: int
    starts: list[Array]
    failed: Counter[str]


def screen(search: Search, starts: int, seed: int) -> Screened:
    """Return the best of evenly spread candidates.

    Parameters
    ----------
    search : Search
        The motions.
    starts : int
        Number of starts that are wanted.
    seed : int
        Of the candidates.
    """
    from scipy.stats import qmc

    n, count = len(search.ranges.names), CANDIDATES * starts
    us = qmc.Sobol(n, seed=np.random.default_rng(seed)).random(1 << (count - 1).bit_length())[:count]
    found = search.motions.screen(search.ranges.values(us), search.times)
    failed, ranked, within = Counter[str](), list[tuple[bool, float, int]](), 0
    for k, values in enumerate(found):
        if isinstance(values, str):
            failed[values] += 1
            continue
        sampled = Sampled(
            search.times, values, np.zeros((*values.shape, 0)), np.searchsorted(search.times, search.even)
        )
        excess, score = search.excess(sampled), search.aim.score(sampled)
        within += excess <= ALLOWED
        ranked.append((excess > ALLOWED, score if excess <= ALLOWED else excess, k))
    ranked.sort()
    chosen = list[Array]()
    for _, _, k in ranked:
        if len(chosen) == starts:
            break
        if all(np.linalg.norm(us[k] - other) > APART * np.sqrt(n) for other in chosen):
            chosen.append(us[k])
    return Screened(count, len(ranked), within, chosen, failed)
