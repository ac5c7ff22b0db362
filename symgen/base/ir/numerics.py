"""Thresholds and limits of emitted code, each in one place."""

from __future__ import annotations

#: A pivot of S below this fraction of its diagonal entry is suspicious: rank is then decided on D D^T.
SUSPICIOUS = 1e-6
#: Two columns of a loop with a squared sine below this are suspicious where other velocities could be solved for.
PARALLEL = 1e-4
#: A pivot of D D^T (rows scaled) below this belongs to a row that depends on the others: the row is skipped.
SKIP = 1e-12
#: A pivot of D D^T (rows scaled) below this is near a singular position and is reported.
WARN = 1e-4
#: Divisor of 0 where a row is skipped, in place of a pivot of 0; pivots that count are larger in all units.
TINY = 1e-300

#: Thresholds of templates, by their names there.
NUMBERS: dict[str, float] = {
    "skip": SKIP,
    "warn": WARN,
    # corrections
    "stalled": 0.5,  # an iteration that leaves more than this part of a violation has stalled,
    "slack": 1e4,  # if the violation is within so many tolerances: then it is rounding
    "tighter": 1e-2,  # part of the tolerance of violations near a singular position
    "falling": 0.9,  # the same part for mass-orthogonal projections, which converge linearly
    "most_projections": 20,
    # bounds of the free part of the kinetic energy, over its former value, for scaling velocities to the balance
    "least_energy": 0.25,
    "most_energy": 4.0,
    # iterated laws
    "most_iterations": 30,
    "floor": 1e-6,  # a change of v', relative to v', below which an iteration may end because it stalls
    "tolerance": 1e-13,  # default where a method has no such parameter
    # efforts that depend on reactions
    "tiny": TINY,
    "drag_rounds": 30,
    "drag_rest": 1e-30,  # square of a last change over that of the forces
    # partitions of coordinates
    "poor": 0.3,  # part of the best determinant since the choice, below which another partition is chosen
    "exchange": 1.01,  # least growth of the determinant by an exchange of columns
    "lightest": 1e-6,  # part of the largest mass that a massless body counts for
    # orthogonal factorisation
    "massless": 1e-15,  # part of the largest pivot of the reduced mass below which a direction has no mass
}
