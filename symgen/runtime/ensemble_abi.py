"""Where things stand in the arrays of ensembles: the row of numbers that each run leaves."""

from __future__ import annotations

from symgen.native import types
from symgen.runtime import abi

#: prepare(p).
PREPARE = types.FunctionType(types.int64(types.float64[::1]))

# -- what a column of the outputs is taken from
# ------------------------------------------------------------------------
STATE, STATUS, ENERGY, ENERGY_ERROR, ACCELERATION, MULTIPLIER, JOINT = range(7)
# -- and what is worked out of such columns behind the loops: by formulas of a run, and from D and the multipliers
SIDE, REACTION, BODY_REACTION, MAGNITUDE = range(7, 11)

#: Arrays that such a formula reads: the state, v' behind places for q', and ``w``.
OF_Y, OF_RATES, OF_W = range(3)

# -- the row of numbers that each run leaves
# ---------------------------------------------------------------------------
SUMMARY = (
    "start",  # how the assembly ended: below
    "start_moved",  # by how much closing moved a coordinate
    "start_velocities",  # 1 where given velocities contradicted the constraints and were projected
    "start_where",  # index of the joint that stays open or is half a turn off, of the velocity without mass, ...
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
#: Where the first of them stand.
START, START_MOVED, START_VELOCITIES, START_WHERE, START_SIZE, REDUNDANT_ROWS, LIGHT, CODE = range(8)

#: How a run ended that asked for what cannot be, beside the ends of single runs (`symgen.runtime.abi`).
IMPOSSIBLE = 50

# -- behind that row, where events are looked for ----------------------------------------------------------------------
#: First where they accumulate, which of them do (a sum of powers of 2), and which one asked for what cannot be or is
#: undefined.
ACCUMULATION, GATHERING, IMPOSSIBLE_EVENT = range(3)
HEAD_OF_EVENTS = 3
#: Then for each of them: how often it happened, and when first and last.
EVENT_COLUMNS = (("count", "1"), ("first", "s"), ("last", "s"))
OF_EVENT = len(EVENT_COLUMNS)

#: How an assembly ended.
ASSEMBLED, UNDEFINED, NO_MASS, OPEN, CONTRADICTION, MOVED, PROJECTED, UNDETERMINED = range(8)
#: Where a joint is closed half a turn off, and where a tree of joints would turn a body over.
HALF_TURN, TURNED_OVER = 8, 9

#: In the integers shared with the thread that watches, behind those of single runs: runs that are done.
RUNS_DONE = abi.N_CONTROL
N_CONTROL = abi.N_CONTROL + 1
