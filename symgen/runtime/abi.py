"""The interface between emitted functions and the loops: types, and where things stand in the arrays.

Emitted functions are called through first-class function types, so one cached compilation of a loop serves every model.
"""

from __future__ import annotations

from numba import types

from symgen.ir.program import COUNTERS, STATUS

_F8 = types.float64
_A = types.float64[::1]
_I = types.int64[::1]

#: rhs(t, y, p, w, iw, ydot) -> status, 0 when done.
RHS = types.FunctionType(types.int64(_F8, _A, _A, _A, _I, _A))
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

# -- positions in the status section at the beginning of w, and in iw
# ---------------------------------------------------
PHI = STATUS.index("position_violation")
DRIFT = STATUS.index("velocity_violation")
KINETIC = STATUS.index("kinetic")
POTENTIAL = STATUS.index("potential")
PIVOT = STATUS.index("smallest_pivot")
RANK = STATUS.index("rank")
LENGTH = STATUS.index("length_scale")
SPEED = STATUS.index("speed_scale")
STEP_STATUS = STATUS.index("step")
POWER = STATUS.index("power")
WINDING = len(STATUS)  # where the section of angles begins that count turns
PROBING = COUNTERS.index("probing")
LIGHT = COUNTERS.index("light")
ITERATIONS = COUNTERS.index("iterations")
SUSPECTS = COUNTERS.index("suspects")
FAILURES = COUNTERS.index("failures")
N_COUNTERS = len(COUNTERS)

# -- control: integers shared with the thread that watches a run
# ---------------------------------------------------------
STOP, STEPS, REJECTED, EVALUATIONS, OUTPUTS, EVENTS, IN_ZONE, LAST_RANK, JACOBIANS, NEWTON_ITERATIONS = range(10)
N_CONTROL = 10

# -- gauges: floating-point numbers a run keeps
# --------------------------------------------------------------------------
(
    TIME,  # how far the run is
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
    STEP,  # last step of an adaptive run
    POTENTIAL_START,
    ENERGY_ENTRY,  # E - E0 - W where the run entered a warn zone
    MAX_ENERGY_JUMP,  # largest change of it over a passage
    LAST_TIME,  # time, root of the smallest pivot, and how fast that root fell, at the accepted state before
    LAST_SINE,
    FALL,
) = range(18)
N_GAUGES = 18

#: Columns of the table of rank events.
EVENT_IN, EVENT_OUT, EVENT_RANK, EVENT_PIVOT = range(4)
N_EVENT = 4
MAX_EVENTS = 1000

# -- how a loop ended
# -----------------------------------------------------------------------------------------------------
DONE, STOPPED, NOT_FINITE, POSITION, VELOCITY, ENERGY, CORRECTION, TINY_STEP, NEWTON = range(9)

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
}
