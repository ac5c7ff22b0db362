"""References in parts, from one time at which formulas jump or have a kink to the next.

A push that is shorter than a step lies between two evaluations, where no estimate of a solver sees it. The times come
from formulas of the file alone, as those of runs do; what a solver does between them stays its own.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.kinks import longest_step
from symgen.runtime.stops import foreseen

if TYPE_CHECKING:
    from symgen.study.references.independent import IndependentEquations

Array = NDArray[np.float64]

#: Parts that are shorter than this part of the end lead from one side of a jump to the other.
JUMP = 3e-12

#: Called with the time at which a part begins, the state there, the times at which states are wanted, the last of them
#: the part's end; returns the states.
Integrate = Callable[[float, Array, Array], Array]


def longest_of(equations: IndependentEquations, times: Array) -> float:
    """Return the longest step of a reference at some times that sees what formulas of the time do [s]."""
    return longest_step(equations.mechanism, float(times[-1]))[0] if len(times) and times[-1] > 0.0 else np.inf


def in_parts(
    equations: IndependentEquations,
    y: Array,
    times: Array,
    integrate: Integrate,
) -> Array:
    """Return the states at some times, integrated part by part.

    Parameters
    ----------
    equations : IndependentEquations
        What is integrated: whose formulas count.
    y : Array
        The state at the time 0.
    times : Array
        Increasing from 0 or later [s].
    integrate : callable
        See `Integrate`.
    """
    motion, done = np.empty((len(times), len(y))), 0
    end = float(times[-1]) if len(times) else 0.0
    stops = foreseen(equations.mechanism).stops(equations.parameters, end) if end else ()
    for first, last in pairwise([*([stop.t for stop in stops] or [0.0]), end]):
        upto = int(np.searchsorted(times, last, side="right"))
        own = times[done:upto]
        if stops and last - first < JUMP * end:  # what acts before it up to its middle, and then what acts behind it
            y = y + 0.5 * (last - first) * (equations.rate(first, y) + equations.rate(last, y))
            states = np.tile(y, (len(own), 1))
        else:
            wanted = own if len(own) and own[-1] == last else np.append(own, last)
            states = integrate(first, y, wanted)
            y = states[-1]
        motion[done:upto], done = states[: len(own)], upto
    return motion
