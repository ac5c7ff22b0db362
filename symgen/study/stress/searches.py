"""The search for the largest step: by the errors of steps tried, from the mechanism's own or where theory expects it.

All steps tried are those of one grid, ``first * SCAN**(i / 2**halvings)``, so that every way to a limit ends at the
same step. A run takes the longer the smaller its step, and one beyond the limit of a stiff motion ends at once. Where
the motion is followed, errors go with a power of the step: two of them tell where a limit is, so that few steps near it
are tried and none far below.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

#: Factor of the scan, and how far it goes down from the first step.
SCAN, SMALLEST = 4.0, 4096.0
#: Scans above the mechanism's own step, where a search begins: such runs are short.
ABOVE = 2
#: Halvings of the scan's factor: to 1.1 percent, and to 9 percent in a quick study.
HALVINGS, QUICK_HALVINGS = 7, 4
#: Errors beyond this multiple of the largest limit follow no power of the step.
SATURATED = 10.0
#: Power of the step that errors follow, where one of them is known.
ORDER = 2.0
#: Of so many steps tried between two one is in the middle, however errors grow.
MIDDLE = 3

#: Error of a step; infinite where the run fails.
Error = Callable[[float], float]


def largest_steps(
    error: Error,
    first: float,
    top: float,
    expected: float,
    limits: Sequence[float],
    halvings: int = HALVINGS,
    smallest: float = 0.0,
) -> list[float | None]:
    """Return the largest steps whose errors are within limits.

    Parameters
    ----------
    error : callable
        Step -> error; no step is tried twice.
    first, top : float
        The mechanism's own step, of which the grid has multiples, and the largest one [s].
    expected : float
        Where the largest step that follows the motion is expected [s]; it counts where it is below `first`.
    limits : sequence of float
        Largest errors, decreasing.
    halvings : int
        Of the logarithm of `SCAN`.
    smallest : float
        No smaller step is tried [s].

    Returns
    -------
    list of (float or None)
        In the order of `limits`: a step of the grid whose successor is beyond the limit; `top` where all tried are
        within; None where not even ``first / SMALLEST``, or the smallest, is.
    """
    grid = StepGrid(error, first, top, halvings, SATURATED * max(limits), smallest)
    start = grid.start_step(expected)
    found = [grid.largest_step(limit, start) for limit in limits]
    # what is within a smaller limit is within a larger one, also beyond a step that is not
    return [max((step for step in found[i:] if step is not None), default=None) for i in range(len(found))]


class StepGrid:
    """Errors of the steps of a grid.

    Parameters
    ----------
    error, first, top, halvings, smallest
        As for `largest_steps`.
    saturated : float
        Error from which on nothing follows for other steps.
    """

    def __init__(
        self, error: Error, first: float, top: float, halvings: int, saturated: float, smallest: float = 0.0
    ) -> None:
        self._error, self._first, self._top, self._saturated = error, first, top, saturated
        self._scan = 1 << halvings
        #: Place of the largest step, which need not be a power.
        self._last = math.ceil(math.log(top / first, SCAN) * self._scan - 1e-9)
        # a step of the smallest size itself rounds to either side
        least = max(smallest * (1.0 + 1e-9), first / SMALLEST)
        self._lowest = min(math.ceil(math.log(least / first, SCAN) * self._scan - 1e-9), self._last)
        self._tried = dict[int, float]()

    def start_step(self, expected: float) -> int:
        """Return the place next to a step below the first; some scans above the first where there is none."""
        if 0.0 < expected < self._first:
            at = round(math.log(expected / self._first, SCAN) * self._scan)
            if at >= self._lowest:
                return at
        return max(self._lowest, min(ABOVE * self._scan, self._last))

    def step(self, at: int) -> float:
        """Return a step of the grid, by the roots that a bisection takes: the same to the last digit."""
        if at == self._last:
            return self._top
        scans, within = divmod(at, self._scan)
        low: float = self._first * SCAN**scans
        high, size = low * SCAN, self._scan
        while within:
            middle, size = math.sqrt(low * high), size // 2
            if within >= size:
                low, within = middle, within - size
            else:
                high = middle
        return low

    def error(self, at: int) -> float:
        """Return the error of a step."""
        if at not in self._tried:
            self._tried[at] = self._error(self.step(at))
        return self._tried[at]

    def largest_step(self, limit: float, start: int) -> float | None:
        """Return the largest step within a limit; what was tried for another limit is not tried again."""
        within = self.error(start) <= limit
        low, high = self._search_upwards(limit, start) if within else self._search_downwards(limit, start)
        if low == high:
            return self._top if within else None
        tries = 0
        while high - low > 1:
            tries += 1
            middle = (low + high) // 2 if tries % MIDDLE == 0 else self._search_between(low, high, limit)
            low, high = (middle, high) if self.error(middle) <= limit else (low, middle)
        return self.step(low)

    def _search_upwards(self, limit: float, low: int) -> tuple[int, int]:
        """Return a place within the limit and one beyond it; the last one twice where that is within."""
        jump = 1 if low < 0 else self._scan  # near the expected step it is small, and doubled each time
        while low != self._last:
            high = min((i for i in self._tried if i > low), default=min(low + jump, self._last))
            if self.error(high) > limit:
                return low, high
            low, jump = high, min(2 * jump, self._scan)
        return low, low

    def _search_downwards(self, limit: float, high: int) -> tuple[int, int]:
        """Return the last place within the limit and the first beyond it; twice the lowest one if that is beyond."""
        near, least = high < 0, 1
        while high != self._lowest:
            by_errors = self._halve_step(high, limit)
            fall = max(by_errors, least) if by_errors is not None else least if near else self._scan
            low = max((i for i in self._tried if i < high), default=max(high - fall, self._lowest))
            if self.error(low) <= limit:
                return low, high
            least = min(2 * least, self._scan) if near or by_errors is not None else 1
            high = low
        return high, high

    def _halve_step(self, at: int, limit: float) -> int | None:
        """Return how far below a place the limit is kept by its error; None where the error tells nothing."""
        error = self.error(at)
        if not error < self._saturated:
            return None
        power = ORDER * math.log(SCAN) / self._scan
        above = min((i for i in self._tried if i > at), default=None)
        if above is not None and error < self.error(above) < self._saturated:
            power = math.log(self.error(above) / error) / (above - at)
        return min(self._scan, math.ceil(math.log(error / limit) / power))

    def _search_between(self, low: int, high: int, limit: float) -> int:
        """Return where the limit is by the errors on either side, the middle where they tell nothing."""
        below, beyond = self.error(low), self.error(high)
        if not 0.0 < below <= beyond < self._saturated:
            return (low + high) // 2
        share = math.log(limit / below) / math.log(beyond / below)
        return min(max(low + math.floor(share * (high - low)), low + 1), high - 1)
