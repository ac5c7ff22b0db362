"""Where things stand in the arrays of ensembles: sizes of the model, and the row of numbers that each run leaves."""

from __future__ import annotations

from numba import types

from symgen.runtime import abi

_A, _I = types.float64[::1], types.int64[::1]
#: prepare(p).
PREPARE = types.FunctionType(types.int64(_A))
#: solve(right, sizes, scale, table, constants, w, x, room, order): see `symgen.runtime.closing.correct`.
SOLVE = types.FunctionType(types.int64(_A, _I, _A, _I, _A, _A, _A, _A, _I))

# -- sizes: integers that describe the model to the compiled loops
# -----------------------------------------------------
(
    NQ,
    NV,
    M,
    NP,  # length of p
    NW,  # length of w
    N_PARAMETERS,  # of the model, at the beginning of p
    SPATIAL,  # 1 where q has Euler parameters and `move` applies changes of v
    LIGHT_CHECK,  # 1 where bodies may turn out too light for the law's solver
    STRICT,  # 1 where a start that had to be changed is refused
    MASS,  # where sections begin in w
    RESIDUAL,
    NU,
    JACOBIAN,
    PIVOTS,
    MASK,
    CHANGE,
    MULTIPLIERS,
    WANTS_RATES,  # 1 where accelerations or multipliers are asked for
    WANTS_JOINTS,  # 1 where joint coordinates are asked for
    WINDINGS,  # angles whose turns are counted
) = range(20)
N_SIZES = 20

# -- what a column of the outputs is taken from
# ------------------------------------------------------------------------
STATE, STATUS, ENERGY, ENERGY_ERROR, ACCELERATION, MULTIPLIER, JOINT = range(7)

# -- the row of numbers that each run leaves
# ---------------------------------------------------------------------------
SUMMARY = (
    "start",  # how the assembly ended: below
    "start_moved",  # by how much closing moved a coordinate
    "start_velocities",  # 1 where given velocities contradicted the constraints and were projected
    "start_where",  # index of the joint that stays open or of the velocity without mass
    "start_size",  # by how much it stays open
    "redundant_rows",  # rows that depend on others, at the start and near it
    "light",  # 1 where the law's solver had to be replaced
    "code",  # how the loop ended, as in `symgen.runtime.abi`
    "end",  # time reached
    "outputs",  # outputs written
    "steps",
    "rejected",
    "evaluations",
    "iterations",
    "light_evaluations",
    "position_violation_max",
    "velocity_violation_max",
    "energy_drift_max",
    "energy_start",
    "energy_scale",
    "energy_jump",
    "smallest_pivot",
    "rank_event_count",
    "narrowest_time",  # where the passage with the smallest pivot began
    "narrowest_pivot",
    "position_violation",  # at the end, with the scales it is judged by
    "velocity_violation",
    "length_scale",
    "speed_scale",
)
N_SUMMARY = len(SUMMARY)

#: How an assembly ended.
ASSEMBLED, UNDEFINED, NO_MASS, OPEN, CONTRADICTION, MOVED, PROJECTED = range(7)

#: In the integers shared with the thread that watches, behind those of single runs: runs that are done.
RUNS_DONE = abi.N_CONTROL
N_CONTROL = abi.N_CONTROL + 1
