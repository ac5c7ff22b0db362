"""References in parts, from one time at which formulas jump or have a kink to the next.

A push that is shorter than a step lies between two evaluations, where no estimate of a solver sees it. The times come
from formulas of the file alone, as those of runs do; what a solver does between them stays its own.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.runtime.foreseen import foreseen, times_between

if TYPE_CHECKING:
    from symgen.study.references.independent import IndependentEquations

Array = NDArray[np.float64]

#: So far beside such a time, in last digits of the end, one part ends and the next begins: what lies between is no
#: more than rounding.
BESIDE = 4.0

#: Called with the time at which a part begins, the state there, the times at which states are wanted, the last of them
#: the part's end, and what is told how far it is; returns the states.
Integrate = Callable[[float, Array, Array, Callable[[float], None]], Array]


def in_parts(
    equations: IndependentEquations,
    y: Array,
    times: Array,
    progress: Callable[[float], None],
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
    progress : callable
        Called with the fraction that is done.
    integrate : callable
        See `Integrate`.
    """
    motion, done = np.empty((len(times), len(y))), 0
    end = float(times[-1]) if len(times) else 0.0
    known, mechanism = foreseen(equations.mechanism), equations.mechanism
    passed = times_between((*known.kinks, *known.sides), mechanism, equations.parameters, end) if known and end else ()
    beside = BESIDE * float(np.spacing(end))
    for first, last in zip([0.0, *(t + beside for t in passed)], [*(t - beside for t in passed), end], strict=True):
        upto = int(np.searchsorted(times, last + beside, side="right"))
        own = np.clip(times[done:upto], first, last)
        wanted = own if len(own) and own[-1] == last else np.append(own, last)
        share = last / end if end else 1.0
        states = integrate(first, y, wanted, lambda part, share=share: progress(share * part))  # type: ignore[misc]
        motion[done:upto], y, done = states[: len(own)], states[-1], upto
    return motion
