"""Positions in the arrays of ensembles: the summary row of each run."""

from __future__ import annotations

from collections.abc import Callable

from symgen.compile.native.annotations import Array, function_type
from symgen.run.layout import abi

#: prepare(p).
Prepare = Callable[[Array], int]
PREPARE = function_type(Prepare)

# -- sources of a column of the outputs
# ------------------------------------------------------------------------
STATE, STATUS, ENERGY, ENERGY_ERROR, ACCELERATION, MULTIPLIER, JOINT = range(7)
# -- sources of columns evaluated after the loops: by formulas of a run, and from D and the multipliers
SIDE, REACTION, BODY_REACTION, MAGNITUDE = range(7, 11)

#: Arrays that such a formula reads: the state, v' after places for q', and ``w``.
OF_Y, OF_RATES, OF_W = range(3)

# -- the summary row of each run
# ---------------------------------------------------------------------------
SUMMARY = (
    "start",  # end of the assembly: codes below
    "start_moved",  # largest change of a coordinate by closing
    "start_velocities",  # 1 if specified velocities contradicted the constraints and were projected
    "start_where",  # index of the joint that stays open or is half a turn off, or of the massless velocity, ...
    "start_size",  # gap that stays open
    "redundant_rows",  # rows that depend on others, at the start and near it
    "light",  # 1 if the law's solver was replaced
    "code",  # end of the loop, as in `symgen.run.layout.abi`
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
    "narrowest_time",  # begin of the passage with the smallest pivot
    "narrowest_pivot",
    "position_violation",  # at the end, with its scales
    "velocity_violation",
    "length_scale",
    "speed_scale",
    "imbalance",  # what accelerations leave of the forces, over their terms
)
N_SUMMARY = len(SUMMARY)
#: Positions of the first of them.
START, START_MOVED, START_VELOCITIES, START_WHERE, START_SIZE, REDUNDANT_ROWS, LIGHT, CODE = range(8)
END, OUTPUTS, ENERGY_START, IMBALANCE = map(SUMMARY.index, ("end", "outputs", "energy_start", "imbalance"))

#: Code of a run with an impossible reset, in addition to those of single runs (`symgen.run.layout.abi`).
IMPOSSIBLE = 50
#: Code of a run at a state at which modes of bounded rows are not determined.
NO_MODES = 51

# -- after that row, if the run has events or modes --------------------------------------------------------------------
#: First the time at which they accumulate, the accumulating ones (a sum of powers of 2), and the one that is impossible
#: or undefined.
ACCUMULATION, GATHERING, IMPOSSIBLE_EVENT = range(3)
#: Where modes are not determined: why (`symgen.run.modes.bounded_rows`), the row, or rows as a sum of powers of 2,
#: and two numbers of the sentence (`symgen.run.modes.refusals`).
FAILURE, WHICH, FIRST_NUMBER, SECOND_NUMBER = range(3, 7)
#: Most rows that depend on each other, of which other motions than the one found were not sought.
UNSOUGHT = 7
HEAD_OF_EVENTS = 8
#: Then for each event: its count, first and last time.
EVENT_COLUMNS = (("count", "1"), ("first", "s"), ("last", "s"))
OF_EVENT = len(EVENT_COLUMNS)

#: Codes with which an assembly ends.
ASSEMBLED, UNDEFINED, NO_MASS, OPEN, CONTRADICTION, MOVED, PROJECTED, UNDETERMINED = range(8)
#: A joint is closed half a turn off; a tree of joints would turn a body over.
HALF_TURN, TURNED_OVER = 8, 9

#: In the integers shared with the watching thread, after those of single runs: number of completed runs.
RUNS_DONE = abi.N_CONTROL
#: Then the state of the examination of the present run: `NOT_EXAMINED`; `WAITS` where the loop was left for it; its
#: result, `HOLDS` or `JUMPS`.
EXAMINATION = abi.N_CONTROL + 1
NOT_EXAMINED, WAITS, HOLDS, JUMPS = range(4)
N_CONTROL = abi.N_CONTROL + 2
