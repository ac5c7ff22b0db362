"""What forces and integrands compare over the state: steps that pass two such switches are taken again, shorter.

Where a step passes one switch, its end is on the other side, and the error estimate sees what jumps or bends there. A
part of the motion that begins and ends inside a step, between two switches or behind one that is passed forth and back,
may lie between all evaluations and leaves no trace. So values and rates of the switches at both ends of an accepted
step say what was passed, and the step is taken again to between the first two passages.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from symgen.runtime.instances import called
from symgen.runtime.switching import beyond, first_root, hidden, side_of

#: How often a step is taken again at most: passages are known to the fourth power of a step.
MOST_AGAIN = 20
#: Below this part of the size of what is compared, which side it is on is rounding.
ROUNDING = 1e-13


@dataclass(frozen=True)
class Switches:
    """What is compared with zero.

    Attributes
    ----------
    function : emitted function
        ``(t, y, p, w, ydot, out)``: values of all switches, then their rates, then sizes of what they compare.
    count : int
        How many there are.
    needs_rates : bool
        Whether the function reads accelerations.
    jump : bool
        Whether something may jump there, and not only have a kink.
    """

    function: Any
    count: int
    needs_rates: bool
    jump: bool


@called
def passed(before: Any, after: Any, h: float, least: float) -> float:
    """Return the part of a step to take in its place, 1 for all of it.

    Parameters
    ----------
    before, after : Array
        What the function has written at its beginning and at its end.
    h : float
        Its length [s].
    least : float
        What lasts for a smaller part of the step than this is not looked at.
    """
    n, first, second, probe, twice = before.shape[0] // 3, 2.0, 2.0, False, False
    for i in range(n):
        g0, g1, d0, d1 = before[i], after[i], h * before[n + i], h * after[n + i]
        # most switches are far away: both tangents stay on their side
        if (g0 > 0.0 and g1 > 0.0 and g0 + d0 > 0.0 and g1 - d1 > 0.0) or (
            g0 < 0.0 and g1 < 0.0 and g0 + d0 < 0.0 and g1 - d1 < 0.0
        ):
            continue
        if not math.isfinite(g0 + g1 + d0 + d1):
            continue
        # what has not left zero yet is where it goes, or comes to
        nothing = ROUNDING * max(before[2 * n + i], after[2 * n + i])
        side = beyond(g0, nothing, beyond(d0, nothing, side_of(g1, 1.0)))
        x = hidden(g0, d0, g1, d1, side, 0.0, nothing)
        inside = x < 1.0
        if not inside:
            if beyond(g1, nothing, side) == side:
                continue
            x = first_root(g0, d0, g1, d1, side)
        if x < first:
            first, second, probe, twice = x, first, inside, probe
        elif x < second:
            second, twice = x, inside
    if probe:
        return first if first > least else 1.0
    # what returns is passed twice there, wherever another switch is passed
    if second >= 1.0 or (second - first <= least and not twice):
        return 1.0
    return 0.5 * (first + second)
