"""Data of a run's switching functions: one array, in parts.

Numbers of the step; columns with one number for each function; the output of the emitted function (values, rates, and
the magnitude on which the rounding of each value depends); states and rates (`N_STATES`); ``w`` and ``iw`` at the
beginning of the step and at the examined state; notes (time, number of the event, state); points of tables; the
beginning of the step and its end before the correction.
"""

from __future__ import annotations

from symgen.run.loops.frame_parts import LOW, RECALL

#: Numbers of a step, after those that the frame reads (`TRY`, `LOW`): the present task, the number of functions, 1
#: where rates need v', end of the examined bracket, the whole step, the resolution of time, ...
DOING, COUNT, NEEDS_RATES, HIGH, WHOLE, RESOLUTION = range(LOW + 1, LOW + 7)
#: ... attempts at extrema, rounds in a bracket, its width three rounds ago, notes, those of accepted steps, switches
#: passed since some time, that time, the step that the error estimate proposes, first index of the points of tables,
#: the time in which rounding hides a root, ...
PROBES, ROUNDS, WIDTH, NOTED, ACCEPTED, PASSED, SINCE, REACH, TABLES, BLUR = range(LOW + 7, LOW + 17)
#: ... first index of time and state at the beginning of the step and of the state before its correction (0: rows have
#: no switches), how far the step has moved coordinates, and by how far its correction coordinates and velocities.
BEGINNING, WENT, MOVED, SPED = range(LOW + 17, LOW + 21)
#: ... number of inner points of the step at which functions are known (0: only at its ends), 1 where the next attempt
#: ends at a point at which a function may be on its other side, the longest step whose inner points show functions (0:
#: unlimited), refusals of steps because they do not, without a gain (-1: no step is refused any more), how badly they
#: show them in the last refused step, times of the inner points after the beginning of the
#: step [s], and working memory for slopes by differences.
INSIDE, PROBING, LONGEST, DIVIDED, COARSEST, PLACES = range(LOW + 21, LOW + 27)
#: Number of inner points of a step.
N_INSIDE = 7
SPREAD = PLACES + N_INSIDE
#: Columns of each function: direction (0: any), action, number of points of its table (0: it is passed at zero), first
#: index of these, period of the table, fraction of a step by which a passage may be missed, the kind of a margin of a
#: bounded row (`FORCE` and following, 0 for other functions), the number of that row, and 1 for a function of forces or
#: accelerations, whose rates count as constant in its own; ...
DIRECTION, ACTION, POINTS, FIRST, PERIOD, MISSED, MARGIN, ROW, OF_FORCES = range(9)
#: ... side at the beginning of the step, 1 where it has just happened, 1 where g is on the other side by rounding, side
#: at the lower end of the bracket, size of g in the step before, rounding of g; ...
SIDE, FIRED, GRAZING, LOCAL, SIZE, GRAIN = range(9, 15)
#: ... of a table the number of the point at which the interval of its argument begins, the examined point, 1 or -1
#: where the argument comes to it from below or above, the argument and its rate at the last examined state and at the
#: beginning of the step, and the second derivative there; ...
PLACE, LEVEL, WAY, ARGUMENT, SLOPE, ARGUMENT_START, SLOPE_START, CURVE = range(15, 23)
#: ... g and g' at the beginning and at the end of the step and of the bracket; ...
G_START, D_START, G_END, D_END, G_LOW, D_LOW, G_HIGH, D_HIGH = range(23, 31)
#: ... of margins the size that their rounding is relative to, the rate above which it is no rounding, and what is added
#: to one that sleeps, 0 for one that is awake; ...
MEASURE, PACE, ASLEEP = range(31, 34)
#: ... the largest slope in the last steps, 0 where it is unknown, g and g' at inner points of the step, and the output
#: of the emitted function at its end.
STEEPEST, G_INSIDE, D_INSIDE, AT_END = 34, 35, 35 + N_INSIDE, 35 + 2 * N_INSIDE
#: Kinds of margins: of a force to its bound, of a gap, of a rate, of a part of a reaction; of a closed row, what is
#: 0 at a corner of its gap.
FORCE, GAP, RATE, PART, CORNER = range(1, 6)
#: Whether gaps have corners; otherwise none are sought.
CORNERS = False
#: Whether rows have bounds; otherwise there are no margins.
MARGINS = False
#: Of a margin, which has no table: the longest step since modes were chosen inside which its force is known.
LOOKED = PLACE
#: Margins below this part of their size are rounding.
UNCERTAIN = 2.0**-42
N_HEAD, N_COLUMNS, N_VALUES = SPREAD + N_INSIDE + 2, AT_END + 3, 3
#: A state and its rate, another state, and rates at the beginning and at the end of the step.
N_STATES = 5
#: Actions: the passage is noted; it is noted and ends the loop; the step ends there and the scheme restarts; the same,
#: noted, after the caller has examined the rows that change there.
NOTE, LEAVE, ANEW, EXAMINE = range(4)
#: Tasks in addition to `LOOK`, `REMEMBER` and `RECALL`: save and restore the memory of emitted functions at an examined
#: state, and end the next step at a point of a table.
KEEP, GIVE_BACK, AIM = range(RECALL + 1, RECALL + 4)
#: Present tasks: look for events, take the whole step, take a step that ends in an event, or one that ends before a
#: jump, so that its stages are on one side of it.
LOOKING, WHOLE_STEP, TO_EVENT, BEFORE = range(4)
#: Room for notes, in addition to twice those of all events: a loop is left at the end of a step where half of it is
#: taken, and at the next event where all of it is taken.
NOTES = 256
