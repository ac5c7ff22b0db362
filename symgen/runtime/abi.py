"""The interface between emitted functions and the loops: types, and where things stand in the arrays.

Emitted functions are called through first-class function types, so one cached compilation of a loop serves every model.
"""

from __future__ import annotations

from symgen.ir.program import COUNTERS, STATUS
from symgen.native import types

_F8 = types.float64
_A = types.float64[::1]
_I = types.int64[::1]

#: rhs(t, y, p, w, iw, ydot) -> status, 0 when done.
RHS = types.FunctionType(types.int64(_F8, _A, _A, _A, _I, _A))
#: derive(t, y, p, w, ydot) at eight nodes: element i of a state at ``8 i + node``; see `symgen.native.nodes`.
NODES = types.FunctionType(types.int64(_A, _A, _A, _A, _A))
#: accept(t, y, p, w, iw) -> bits: 1 the correction failed, 2 the state was changed.
ACCEPT = types.FunctionType(types.int64(_F8, _A, _A, _A, _I))
#: residual(t, y, k, p, w, r) and tangent(t, y, k, p, w, j); j holds the structural nonzeros alone.
STAGE = types.FunctionType(types.int64(_F8, _A, _A, _A, _A, _A))
#: geometry(t, y, p, w).
MEASURE = types.FunctionType(types.int64(_F8, _A, _A, _A))
#: move(y, w) or turn(y, w): the section ``change`` applied to the coordinates.
MOVE = types.FunctionType(types.int64(_A, _A))
#: observe(t, y, p, w, ydot, out).
OBSERVE = types.FunctionType(types.int64(_F8, _A, _A, _A, _A, _A))
#: decide(hunt, n, notes, following, h, hunting, width, y, w, iw) of `symgen.runtime.searching`.
DECIDE = types.FunctionType(types.int64(_A, types.int64, types.int64, _F8, _F8, types.int64, types.int64, _A, _A, _I))

# -- positions in the status section at the beginning of w, and in iw --------------------------------------------------
PHI = STATUS.index("position_violation")
DRIFT = STATUS.index("velocity_violation")
KINETIC = STATUS.index("kinetic")
POTENTIAL = STATUS.index("potential")
PIVOT = STATUS.index("smallest_pivot")
RANK = STATUS.index("rank")
LENGTH = STATUS.index("length_scale")
SPEED = STATUS.index("speed_scale")
PHI_MEASURE = STATUS.index("position_measure")
DRIFT_MEASURE = STATUS.index("velocity_measure")
SHORTEST_ROW = STATUS.index("shortest_row")
MEAN_MASS = STATUS.index("mean_mass")
STEP_STATUS = STATUS.index("step")
POWER = STATUS.index("power")
N_STATUS = RANK + 1  # what an output keeps of the status
WINDING = len(STATUS)  # where the section of angles begins that count turns
PROBING = COUNTERS.index("probing")
BALANCED = COUNTERS.index("balanced")
LIGHT = COUNTERS.index("light")
ITERATIONS = COUNTERS.index("iterations")
N_COUNTERS = len(COUNTERS)

# -- control: integers that a run keeps, shared with the thread that watches it ----------------------------------------
(
    STOP,  # raised from outside: the run is to end
    STEPS,
    REJECTED,
    EVALUATIONS,
    OUTPUTS,
    EVENTS,
    IN_ZONE,
    LAST_RANK,
    JACOBIANS,
    NEWTON_ITERATIONS,
    BEGUN,  # 1 once the first state is accepted, `AFRESH` where inputs or velocities were changed since
    INDEX,  # steps of the grid that began at `ORIGIN`
    REFUSED,  # 1 where the last attempt was
    BARRED,  # 1 where a zone is not to be crossed in one step: an attempt to do so has failed
    KNOWN,  # 1 where what the scheme keeps of the beginning of the step is that of the state
    POINTS,  # past points of a multistep scheme; slow steps of an iterated one
    ORDER,  # of the error estimate, plus one
    MARKED,  # attempts at `MARK`
    MASKED,  # rows that are left out because they depend on others for ever
    PASSED,  # stops that are behind
) = range(20)
N_CONTROL = 20
#: What ``control[BEGUN]`` says of a run whose rates were changed where it stands: the scheme begins anew.
AFRESH = 2

# -- clock: floating-point numbers that a run keeps of its time and steps ----------------------------------------------
(
    TIME,  # how far the run is
    ORIGIN,  # where the grid of constant steps begins
    NEXT,  # step to try next where steps vary; 0: not chosen yet
    STEP,  # last accepted step
    ALLOWED,  # by how much its error estimate would have let it grow; 0 where nothing is known of it
    MARK,  # time from which on progress is judged
) = range(6)
N_CLOCK = 6
#: Times are the same that are closer than this part of a constant step, or, where steps vary, of the time: steps below
#: that are lost in its rounding.
SAME_TIME, RESOLVED_TIME = 1e-9, 4e-16

# -- gauges: floating-point numbers that a run keeps of its states -----------------------------------------------------
(
    MAX_PHI,  # largest |Phi| over accepted steps and outputs
    MAX_DRIFT,  # largest |D v - nu|
    MAX_ENERGY,  # largest |E - E0 - W|
    ENERGY_START,  # E0
    ENERGY_SCALE,  # largest kinetic energy, change of potential energy or work so far
    LIMIT_PHI,  # max_violation, of the largest coordinate so far
    LIMIT_DRIFT,  # the same, of the largest speed
    LIMIT_ENERGY,  # fraction of the energy scale
    WARN_PIVOT,
    SMALLEST_PIVOT,
    POTENTIAL_START,
    ENERGY_ENTRY,  # E - E0 - W at the last accepted state before a passage
    MAX_ENERGY_JUMP,  # largest change of it over a passage
    LAST_TIME,  # time, root of the smallest pivot, and how fast that root fell, at the accepted state before
    LAST_SINE,
    FALL,
    LAST_SHORT,  # root of the shortest row at the accepted state before, and how fast it fell
    SHORT_FALL,
    CHOSEN,  # largest value of the smallest pivot since rows were chosen that stand for all
    LAST_KINETIC,  # kinetic energy at the accepted state before
    FORCE,  # largest change of kinetic energy or work over its way, where the balance of energy was in doubt
    LARGEST_SINE,  # largest root of the smallest pivot so far
) = range(22)
N_GAUGES = 22

#: Columns of the table of rank events.
EVENT_IN, EVENT_OUT, EVENT_RANK, EVENT_PIVOT = range(4)
N_EVENT = 4
MAX_EVENTS = 1000

# -- how a loop ended --------------------------------------------------------------------------------------------------
(
    DONE,
    STOPPED,
    NOT_FINITE,
    POSITION,
    VELOCITY,
    ENERGY,
    CORRECTION,
    TINY_STEP,
    NEWTON,
    NO_PROGRESS,
    VANISHED,
    GATHERED,
    UNDEFINED,
    UNPREPARED,
) = range(14)
#: A loop that can go on when it is entered again: after so many steps, once there is more room for a matrix, and once
#: other rows stand for all; and a run in a lane that is left to the loop over single runs.
PAUSED, NO_ROOM, LEFT, CHOOSE = -1, -2, -3, -4
#: The same, at an event that ends a run or changes its state, and where the notes of events have to be taken.
MET, NOTED = -5, -6
#: The same, where the caller works out what depends on parameters that have changed.
CHANGED = -7

REASONS = {
    DONE: "",
    STOPPED: "interrupted",
    NOT_FINITE: "the state is no longer finite",
    POSITION: "the position violation |Phi| exceeds max_violation",
    VELOCITY: "the velocity violation |D v - nu| exceeds max_violation",
    ENERGY: "the energy leaves its balance by more than max_energy_error of the energy in motion",
    CORRECTION: "the correction of positions did not converge",
    NEWTON: "Newton's iteration of an implicit stage did not converge",
    TINY_STEP: "the step size fell below what the time can resolve",
    NO_PROGRESS: "the run makes no progress",
    GATHERED: "events accumulate",
    UNDEFINED: "the condition of an event is undefined",
    UNPREPARED: "inputs: expected values for which every formula is finite, got others",
    VANISHED: "a row that is an angle has lost its gradient: the joint stands where it determines nothing",
}
