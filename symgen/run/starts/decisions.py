"""Thresholds and scales of a start: closing positions, completing velocities and judging rank.

Lengths and speeds are compared with those of the mechanism (`symgen.run.layout.scales`), angles with 1. All thresholds
of the start are in this module.
"""

from __future__ import annotations

import math

from symgen.base.ir.numerics import SKIP, WARN
from symgen.compile.loopcode.exact import exact

#: From this many entries of a dense D on, models with sparse algebra are closed by that algebra.
LARGEST_DENSE = 250_000
#: The same for starts that are only drawn, where dense algebra is slower: of some twenty bodies in the plane.
LARGEST_DRAWN = 4_000
#: Up to this many multiplications for a dense least-norm solution, a single start is interpreted: compiled code
#: would save less time than loading it takes.
LARGEST_INTERPRETED = 10_000

#: Rows of D whose independent part is below this, times the largest row, depend on others; the root of `SKIP`.
RANK_CUTOFF = math.sqrt(SKIP)
#: CGLS ends when the square of the gradient has fallen by this factor, or after 20 iterations a row plus 100.
GRADIENT_FALL, ITERATIONS_A_ROW, ITERATIONS_AT_LEAST = 1e-30, 20, 100

#: Newton's iteration on positions ends after this many steps, or when this many of them gained nothing.
POSITION_STEPS, POSITION_STALLS = 60, 15
#: Positions are closed when |Phi| is below this, times the scale of lengths and the number of rows (or times the
#: largest coordinate, which cannot resolve less) ...
ROUNDING = 1e-15
#: ... or below this, times the scale of lengths, when three steps gained nothing.
CLOSED, CLOSED_STALLS = 1e-9, 3
#: A step of Newton's iteration changes no coordinate by more than this [rad, or the scale of lengths].
LONGEST_STEP = 1.0
#: Closing has moved a coordinate that changed by more than this, times the scale of lengths.
MOVED = 1e-9
#: A body was moved far if it was moved by more than this part of the scale of lengths, or turned by more [rad].
FAR, FAR_TURNED = 0.1, 0.3
#: Held coordinates go to their values in steps of at most this [rad, or the scale of lengths], and in at most this
#: many steps.
STRIDE, MOST_STRIDES = 0.1, 2000

#: Specified velocities fit the constraints if |D v - nu| is below this, times the scale of speeds ...
VELOCITIES_FIT = 1e-9
#: ... and contradict them if it is above this after a projection.
VELOCITIES_CONTRADICT = 1e-8
#: A projection of velocities raises masses to at least this fraction of the largest.
LEAST_MASS = 1e-12

#: Rows are permanently dependent if they are so at this many positions near the start as well, at this distance from it
#: [rad, or the scale of lengths]; nothing moves if the largest component of the direction is below the third.
PROBES, PROBE_DISTANCE, STANDSTILL = 3, 0.03, 1e-9
#: Rows kept in order of elimination represent those left out badly if their smallest pivot of D D^T is below this, a
#: sine of 0.1: rows that hold a light body between heavy ones are nearly equal in the metric of masses.
STAND_BADLY = 1e-2
#: A velocity with less than this part of the largest mass is light where a row with bounds and another one act on it:
#: M^-1 makes their forces accelerations that cancel, and leaves rounding over the mass.
LIGHT = 1e-5
#: No row holds a direction of massless bodies of which more than this lies outside the row space of D.
UNHELD = 1e-6
#: A row that a whole turn of an angle changes by less than this does not depend on the angle.
LEAST_EFFECT = 1e-9


@exact()
def is_dependent(pivot: float) -> bool:
    """Whether a pivot of D D^T (rows scaled) belongs to a row that depends on the others."""
    return not pivot >= SKIP


@exact()
def is_poor(pivot: float) -> bool:
    """Whether the smallest pivot is so near a singularity that rounding may decide which rows depend on others."""
    return pivot < WARN
