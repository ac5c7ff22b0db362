"""The search for the largest step: a scan and a bisection, or from where theory expects it.

All numbers tried are those of one grid, ``first * SCAN**(i / 2**halvings)``, as a scan by `SCAN` followed by bisections
of the logarithm visits it, so that both ways end at the same number. Steps beyond the limit of a stiff motion end at
once, steps below it take all their time: the fewer of these, the shorter the search.
"""

from __future__ import annotations

import math
from collections.abc import Callable

#: Factor of the scan, and how far it goes down from the first step.
SCAN, SMALLEST = 4.0, 4096.0
#: Halvings after the scan: to 1.1 percent, and to 9 percent in a quick study.
HALVINGS, QUICK_HALVINGS = 7, 4

#: Whether a condition holds for a number.
Condition = Callable[[float], bool]


def largest_steps(
    attempt: Callable[[float], tuple[bool, bool]], first: float, top: float, expected: float, halvings: int = HALVINGS
) -> tuple[float | None, float | None]:
    """Return the largest step that is stable, and the largest one that is accurate.

    Parameters
    ----------
    attempt : callable
        Step -> whether it is stable, and whether it is accurate.
    first, top : float
        First and largest step [s].
    expected : float
        Where the largest stable step is expected [s]; it counts where it is below `first`.
    halvings : int
        Of the logarithm of `SCAN`.
    """
    limits = list[float | None]()
    for which in range(2):

        def holds(step: float, which: int = which) -> bool:
            return attempt(step)[which]

        found = largest_near(holds, first, top, expected, halvings) if expected < first else None
        if found is None:
            expected, found = math.inf, largest_number(holds, first, top, halvings)
        else:
            expected = found  # what limits stability limits accuracy as well
        limits.append(found)
    stable, accurate = limits
    if stable is not None and accurate is not None:
        stable = max(stable, accurate)  # what is accurate follows the motion, also beyond a step that does not
    return stable, accurate


def largest_number(holds: Condition, first: float, top: float, halvings: int = HALVINGS) -> float | None:
    """Return the largest number below which a condition holds, by a scan upwards and bisection of its logarithm.

    Parameters
    ----------
    holds : callable
        The condition; it need not be monotone: the result is its first failure on the way up.
    first : float
        First number; smaller ones are tried where the condition does not hold.
    top : float
        Largest number tried.
    halvings : int
        Of the logarithm of `SCAN`.

    Returns
    -------
    float or None
        Exact within 1.1 percent by 7 halvings; `top` where it holds everywhere; None where it does not even hold at
        ``first / SMALLEST``.
    """
    low, floor = first, first / SMALLEST
    while not holds(low):
        low /= SCAN
        if low < floor * (1.0 - 1e-9):
            return None
    high = low
    while True:
        high = min(high * SCAN, top)
        if not holds(high):
            break
        if high >= top:
            return top
        low = high
    for _ in range(halvings):
        middle = math.sqrt(low * high)
        if holds(middle):
            low = middle
        else:
            high = middle
    return low


def largest_near(holds: Condition, first: float, top: float, expected: float, halvings: int = HALVINGS) -> float | None:
    """Return a number of the grid at which a condition holds, and at whose successor it does not.

    Parameters
    ----------
    holds, first, top, halvings
        As for `largest_number`, which returns the same where the condition is monotone.
    expected : float
        The search goes away from here, ever faster, until the condition changes.

    Returns
    -------
    float or None
        None where the condition does not change on the grid.
    """
    at, jump = round(math.log(expected / first, SCAN) * 2**halvings), 1
    ends = round(-math.log(SMALLEST, SCAN)) * 2**halvings, math.log(top / first, SCAN) * 2**halvings
    if not ends[0] <= at <= ends[1]:
        return None
    upwards = holds(grid(first, at, halvings))
    while True:
        other = at + jump if upwards else at - jump
        if not ends[0] <= other <= ends[1]:
            return None
        if holds(grid(first, other, halvings)) is not upwards:
            break
        at, jump = other, 2 * jump
    low, high = (at, other) if upwards else (other, at)
    while high - low > 1:
        middle = (low + high) // 2
        if holds(grid(first, middle, halvings)):
            low = middle
        else:
            high = middle
    return grid(first, low, halvings)


def grid(first: float, index: int, halvings: int) -> float:
    """Return a number of the grid, by the roots that a bisection takes: the same to the last digit."""
    scans, within = divmod(index, 2**halvings)
    low: float = first * SCAN**scans
    high, size = low * SCAN, 2**halvings
    while within:
        middle, size = math.sqrt(low * high), size // 2
        if within >= size:
            low, within = middle, within - size
        else:
            high = middle
    return low
