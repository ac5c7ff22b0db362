"""The interface between emitted functions and the loops: types, and positions in the arrays.

Emitted functions are called through first-class function types, so one cached compilation of a loop serves every model.
"""

from __future__ import annotations

from collections.abc import Callable

from symgen.base.ir.program import COUNTERS, STATUS
from symgen.compile.native.annotations import Array, Integers, function_type

#: rhs(t, y, p, w, iw, ydot) -> status, 0 when done.
Rhs = Callable[[float, Array, Array, Array, Integers, Array], int]
#: derive(t, y, p, w, ydot) at eight nodes, element i of a state at ``8 i + node``:
#: `symgen.compile.native.node_functions`.
Derive = Callable[[Array, Array, Array, Array, Array], int]
#: accept(t, y, p, w, iw) -> bits: 1 the correction failed, 2 the state was changed.
Accept = Callable[[float, Array, Array, Array, Integers], int]
#: residual(t, y, k, p, w, r) and tangent(t, y, k, p, w, j); j holds only the structural nonzeros.
Stage = Callable[[float, Array, Array, Array, Array, Array], int]
#: balance(t, y, p, w, ydot).
Balance = Callable[[float, Array, Array, Array, Array], int]
#: geometry(t, y, p, w).
Measure = Callable[[float, Array, Array, Array], int]
#: move(y, w) or turn(y, w): the section ``change`` applied to the coordinates.
Move = Callable[[Array, Array], int]
#: observe(t, y, p, w, ydot, out).
Observe = Callable[[float, Array, Array, Array, Array, Array], int]
#: decide(hunt, n, notes, following, h, search, width, y, w, iw) of `symgen.run.loops.searching`.
Decide = Callable[[Array, int, int, float, float, int, int, Array, Array, Integers], int]
#: Their types in compiled code.
RHS, NODES, ACCEPT, STAGE = (function_type(x) for x in (Rhs, Derive, Accept, Stage))
MEASURE, MOVE, OBSERVE, DECIDE = (function_type(x) for x in (Measure, Move, Observe, Decide))

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
N_STATUS = RANK + 1  # length of the status in an output
WINDING = len(STATUS)  # first of the angles that count turns
PROBING = COUNTERS.index("probing")
BALANCED = COUNTERS.index("balanced")
LIGHT = COUNTERS.index("light")
ITERATIONS = COUNTERS.index("iterations")
LAW_ITERATIONS = COUNTERS.index("law_iterations")
N_COUNTERS = len(COUNTERS)

# -- control: integers of a run, shared with the thread that watches it ------------------------------------------------
(
    STOP,  # set from outside to end the run: `AT_ONCE`, or once it has taken more evaluations than this number
    STEPS,
    REJECTED,
    EVALUATIONS,
    OUTPUTS,
    PASSAGES,
    IN_ZONE,
    LAST_RANK,
    JACOBIANS,
    NEWTON_ITERATIONS,
    BEGUN,  # 1 once the first state is accepted, `AFRESH` or `ONWARD` if rates have changed since
    INDEX,  # steps since `ORIGIN` on the grid of constant steps
    REFUSED,  # 1 if the last attempt was refused
    BARRED,  # 1 if a zone must not be crossed in one step, because an attempt failed
    KNOWN,  # 1 if the scheme's data for the beginning of the step belong to the present state
    POINTS,  # past points of a multistep scheme; slow steps of an iterated one
    ORDER,  # of the error estimate, plus one
    MARKED,  # attempts at `MARK`
    MASKED,  # rows left out because they always depend on others
    PASSED,  # seams that have been passed
) = range(20)
N_CONTROL = 20
#: Value of ``control[STOP]`` that ends a run before its next step; 0 lets it go on.
AT_ONCE = 1
#: Value of ``control[BEGUN]`` if the rates have changed at the present state: the scheme begins anew.
AFRESH = 2
#: The same, but the step goes on: other rows are in force, and the motion is as fast as before.
ONWARD = 3

# -- clock: time and steps of a run ------------------------------------------------------------------------------------
(
    TIME,  # present time
    ORIGIN,  # begin of the grid of constant steps
    NEXT,  # next step to try if steps vary; 0: not chosen yet
    STEP,  # last accepted step
    ALLOWED,  # growth that its error estimate allows; 0 if unknown
    MARK,  # time from which progress is judged
) = range(6)
N_CLOCK = 6
#: Times are equal if they differ by less than this part of a constant step or, if steps vary, of the time: shorter
#: steps are lost in its rounding.
SAME_TIME, RESOLVED_TIME = 1e-9, 4e-16
#: The end of a run of varying steps is reached where less than this part of the time is left: ten roundings.
END_TIME = 2.2e-15
#: Least step at time 0, which resolves any [s].
SHORTEST_STEP = 1e-30

# -- gauges: measures of the states of a run ---------------------------------------------------------------------------
(
    MAX_PHI,  # largest |Phi| over accepted steps and outputs
    MAX_DRIFT,  # largest |D v - nu|
    MAX_ENERGY,  # largest |E - E0 - W|
    ENERGY_START,  # E0
    ENERGY_SCALE,  # largest kinetic energy, change of potential energy or work so far
    LIMIT_PHI,  # max_violation, of the largest coordinate so far
    LIMIT_DRIFT,  # max_violation, of the largest speed
    LIMIT_ENERGY,  # fraction of the energy scale
    WARN_PIVOT,
    SMALLEST_PIVOT,
    POTENTIAL_START,
    ENERGY_ENTRY,  # E - E0 - W at the last accepted state before a passage
    MAX_ENERGY_JUMP,  # largest change of ENERGY_ENTRY over a passage
    LAST_TIME,  # time, root of the smallest pivot, and its rate of fall, at the previous accepted state
    LAST_SINE,
    FALL,
    LAST_SHORT,  # root of the shortest row at the previous accepted state, and its rate of fall
    SHORT_FALL,
    CHOSEN,  # largest value of the smallest pivot since independent rows were last chosen
    LAST_POTENTIAL,  # potential energy less work at the previous accepted state
    FORCE,  # largest change of that or of the work over distance, where the balance of energy was in doubt
    LARGEST_SINE,  # largest root of the smallest pivot so far
) = range(22)
N_GAUGES = 22

#: Columns of the table of passages near singular positions.
PASSAGE_IN, PASSAGE_OUT, PASSAGE_RANK, PASSAGE_PIVOT = range(4)
N_PASSAGE = 4
MAX_PASSAGES = 1000

# -- codes with which a loop ends --------------------------------------------------------------------------------------
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
    JUMPED,
    TURNED,
    HALTED,
) = range(17)
#: The loop can be entered again: after a number of steps, once a matrix has more room, or once other independent rows
#: are chosen; `LEFT`: a run in a lane is left to the loop over single runs.
PAUSED, NO_ROOM, LEFT, CHOOSE = -1, -2, -3, -4
#: The loop can be entered again after an event that ends a run or changes its state, or once event notes are read.
MET, NOTED = -5, -6
#: The loop can be entered again once the caller has evaluated the numbers that depend on changed parameters.
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
    JUMPED: "a row jumps or has a kink, which would take an impulse; a run by itself names the row",
    TURNED: "a constant step turns a body too far for the angle of a place to count turns: take shorter ones",
    HALTED: "what an event or a change asks for cannot be",
    VANISHED: "a row that is an angle has lost its gradient: the joint stands where it determines nothing",
}
