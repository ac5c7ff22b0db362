"""One quadratic programme after another: an aim as small as possible, with limits of a motion at some times."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.sampled_motions import Aim, Limit, Sampled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.analyses.search.search import Candidate, Search

Array = NDArray[np.float64]

#: Steps of one programme.
STEPS = 80
#: Limits may be exceeded by this part of their size.
ALLOWED = 5e-7
#: Programmes end where the aim, in parts of that at the start, changes by less: over all times, and of one number.
STILL, STILLER = 1e-9, 1e-14
#: Rooms of candidates without a motion, from which programmes turn back, and their aim in parts of that at the start.
CLOSED, FAR = -1e3, 1e3


class Programme:
    """One programme: the aim as small as possible, with limits at some times.

    An aim over all times is a variable of its own, which none of its values exceeds.

    Parameters
    ----------
    search : Search
        The motions.
    times, even : Array
        Times that count, and those that means are taken over [s].
    first : Candidate
        Where it begins.
    elastic : bool
        Whether limits give way: their largest excess is made as small as possible in place of the aim.
    """

    def __init__(self, search: Search, times: Array, even: Array, first: Candidate, elastic: bool = False) -> None:
        self.search, self.times, self.even, self.elastic = search, times, even, elastic
        self.first, self.limits, self.n = first.u, _tightest(search.limits), len(first.u)
        self.bounded = search.aim.is_bounded or elastic
        self.best: tuple[float, Array] | None = None
        start = self._at(first.u)
        assert start is not None, "it moves at many times"
        self.size = abs(search.aim.reached(start).value) or 1.0
        rooms, _ = self._rooms(start)
        self.count = len(rooms)
        #: rows below the bound of the aim
        self.below = slice(0 if elastic else sum(len(limit.rooms(start)[0]) for limit in self.limits), None)
        self.least = float(np.min(rooms[self.below], initial=np.inf))

    def solve(self) -> list[Array]:
        """Return candidates: the one at which the programme ended, and the best one within limits at the times."""
        from scipy.optimize import minimize

        w, bounds = self.first, list[Any]([(0.0, 1.0)] * self.n)
        if self.bounded:
            w, bounds = np.append(w, -self.least), [*bounds, (None, None)]
        rooms: Any = {"type": "ineq", "fun": lambda w: self.rooms(w)[0], "jac": lambda w: self.rooms(w)[1]}
        options: Any = {"maxiter": STEPS, "ftol": STILL if self.bounded else STILLER}
        constraints: Any = [rooms] if self.count else []
        found = minimize(
            self.value, w, jac=True, method="SLSQP", bounds=bounds, constraints=constraints, options=options
        )
        end = np.clip(found.x[: self.n], 0.0, 1.0)
        return [end] if self.best is None or np.array_equal(self.best[1], end) else [end, self.best[1]]

    def value(self, w: Array) -> tuple[float, Array]:
        """Return the aim in parts of that at the start, and its derivatives."""
        if self.bounded:
            return float(w[-1]), np.append(np.zeros(self.n), 1.0)
        sampled = self._at(w)
        if sampled is None:
            return FAR, np.zeros(self.n)
        value, slopes = self.search.aim.number(sampled)
        return value / self.size, slopes / self.size

    def rooms(self, w: Array) -> tuple[Array, Array]:
        """Return the rooms to all limits, and of the aim below its bound, with their derivatives."""
        sampled = self._at(w[: self.n])
        if sampled is None:
            return np.full(self.count, CLOSED), np.zeros((self.count, len(w)))
        rooms, slopes = self._rooms(sampled)
        if not self.bounded:
            return rooms, slopes
        own = np.zeros((self.count, 1))
        own[self.below] = 1.0
        return rooms + own[:, 0] * w[-1], np.hstack([slopes, own])

    def _at(self, u: Array) -> Sampled | None:
        """Return the motion of a candidate, and keep one within limits whose aim is the smallest so far."""
        u = np.clip(u, 0.0, 1.0)
        sampled = self.search.sampled(u, self.times, self.even)
        if sampled is not None:
            score = self.search.aim.score(sampled)
            if (self.best is None or score < self.best[0]) and self.search.excess(sampled) <= ALLOWED:
                self.best = score, u
        return sampled

    def _rooms(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return the rooms to limits, then the aim below a bound of 0, with derivatives by the numbers."""
        parts = [limit.rooms(sampled) for limit in self.limits]
        aim = self.search.aim
        if isinstance(aim, Aim) and aim.is_bounded and not self.elastic:
            y, dy = aim.signed(sampled)
            parts.append((-y / self.size, -dy / self.size))
        if not parts:
            return np.zeros(0), np.zeros((0, self.n))
        rooms, slopes = zip(*parts, strict=True)
        return np.concatenate(rooms), np.concatenate(slopes)


def _tightest(limits: Sequence[Limit]) -> list[Limit]:
    """Return limits without those that others of the same quantity imply."""
    found = dict[tuple[object, ...], Limit]()
    for limit in limits:
        key = limit.taken, limit.quantity, limit.side
        if key not in found or limit.sign * limit.bound < limit.sign * found[key].bound:
            found[key] = limit
    return [*found.values()]
