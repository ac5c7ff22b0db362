"""What a start decides by: the thresholds and scales of closing positions, completing velocities and judging rank.

Lengths and speeds are compared with those of the mechanism (`symgen.runtime.scales`), angles with 1. Nothing else in
the start holds a number that decides.
"""

from __future__ import annotations

import math

from symgen.ir.numerics import SKIP, WARN
from symgen.runtime.exact import exact

#: From this many entries of a dense D on, models with sparse algebra of their own are closed by it.
LARGEST_DENSE = 250_000
#: Up to this many multiplications for a dense least-norm solution, a single start is interpreted: running compiled code
#: would save less than loading it takes.
LARGEST_INTERPRETED = 10_000

#: Rows of D whose independent part is below this, times the largest row, depend on others; the root of `SKIP`.
RANK_CUTOFF = math.sqrt(SKIP)
#: CGLS ends where the square of the gradient has fallen by this factor, or after so many iterations a row and in all.
GRADIENT_FALL, ITERATIONS_A_ROW, ITERATIONS_AT_LEAST = 1e-30, 20, 100

#: Newton's iteration on positions ends after so many steps, or when so many of them gained nothing.
POSITION_STEPS, POSITION_STALLS = 60, 15
#: Positions are closed when |Phi| is below this, times the scale of lengths and the number of rows ...
ROUNDING = 1e-15
#: ... or below this, times the scale of lengths, when three steps gained nothing.
CLOSED, CLOSED_STALLS = 1e-9, 3
#: A step of Newton's iteration changes no coordinate by more than this [rad, or the scale of lengths].
LONGEST_STEP = 1.0
#: Closing has moved a coordinate when it changed by more than this, times the scale of lengths.
MOVED = 1e-9
#: A body was moved far where it was moved by more than this part of the scale of lengths, or turned by more [rad].
FAR, FAR_TURNED = 0.1, 0.3
#: Held coordinates go to their values in steps of at most this [rad, or the scale of lengths], but in no more than so
#: many steps.
STRIDE, MOST_STRIDES = 0.1, 2000

#: Given velocities fit the constraints where |D v - nu| is below this, times the scale of speeds ...
VELOCITIES_FIT = 1e-9
#: ... and nothing fits them where it is above this after a projection.
VELOCITIES_CONTRADICT = 1e-8
#: A projection of velocities takes masses for at least this fraction of the largest.
LEAST_MASS = 1e-12

#: Rows count as dependent for ever if they are so at this many positions near the start as well, which is left by this
#: [rad, or the scale of lengths]; nothing moves where the largest component of the direction is below the third.
PROBES, PROBE_DISTANCE, STANDSTILL = 3, 0.03, 1e-9
#: Rows that are kept as they come stand badly for those left out where their smallest pivot of D D^T is below this, a
#: sine of 0.1: rows that hold a light body between heavy ones amount, in the metric of masses, to nearly the same.
STAND_BADLY = 1e-2
#: A direction of massless bodies is held by no row where more than this is left of it beside the row space of D.
UNHELD = 1e-6
#: A whole turn of an angle that changes a row by less than this has nothing to do with it.
LEAST_EFFECT = 1e-9


@exact()
def is_dependent(pivot: float) -> bool:
    """Whether a pivot of D D^T (rows scaled) says that its row depends on the others."""
    return not pivot >= SKIP


@exact()
def is_poor(pivot: float) -> bool:
    """Whether rounding may decide which rows depend on others, where this is the smallest pivot: near a singularity."""
    return pivot < WARN
