"""What a run keeps of its switching functions: one array, in parts.

Numbers of the step; columns with one number for each function; what the emitted function writes (values, rates, and
what the rounding of each value is a part of); a state and its rate; ``w`` and ``iw`` at the beginning of the step and
at the state that is looked at; notes (time, number of the event, state); points of tables.
"""

from __future__ import annotations

from symgen.runtime.frame import LOW, RECALL

#: Numbers of a step, behind those that the frame reads (`TRY`, `LOW`): what is being done, how many functions
#: there are, 1 where rates need v', end of the bracket that is looked at, the whole step, what time resolves, ...
DOING, COUNT, NEEDS_RATES, HIGH, WHOLE, RESOLUTION = range(LOW + 1, LOW + 7)
#: ... attempts at extrema, rounds in a bracket, its width three rounds ago, notes, those of accepted steps, switches
#: passed since some time, that time, the step that the error estimate proposes, where the points of tables begin, and
#: in what time rounding hides a root.
PROBES, ROUNDS, WIDTH, NOTED, ACCEPTED, PASSED, SINCE, REACH, TABLES, BLUR = range(LOW + 7, LOW + 17)
#: What describes each function: direction (0: any), action, how many points its table has (0: it is passed at
#: zero), where these begin, the period of the table, part of a step by which a passage may be missed; ...
DIRECTION, ACTION, POINTS, FIRST, PERIOD, MISSED = range(6)
#: ... side at the beginning of the step, 1 where it has just happened, 1 where g is on the other side by rounding, side
#: at the lower end of the bracket, how large g was in the step before, what counts as rounding of it; ...
SIDE, FIRED, GRAZING, LOCAL, SIZE, GRAIN = range(6, 12)
#: ... of a table the number of the point that the interval of its argument begins at, the point that is looked at, 1 or
#: -1 where the argument comes to it from below or above, the argument and its rate at the last state that was looked at
#: and at the beginning of the step, and the rate of the rate there; ...
PLACE, LEVEL, WAY, ARGUMENT, SLOPE, ARGUMENT_START, SLOPE_START, CURVE = range(12, 20)
#: ... g and g' at the beginning and at the end of the step and of the bracket.
G_START, D_START, G_END, D_END, G_LOW, D_LOW, G_HIGH, D_HIGH = range(20, 28)
N_HEAD, N_COLUMNS, N_VALUES = LOW + 17, 28, 3
#: Actions: the passage is noted; it is noted and ends the loop; the step ends there and the scheme begins anew.
NOTE, LEAVE, ANEW = range(3)
#: What is done beside `LOOK`, `REMEMBER` and `RECALL` with what is kept: keep and give back what emitted functions
#: remember of a state that is looked at, and end the next step at a point of a table.
KEEP, GIVE_BACK, AIM = range(RECALL + 1, RECALL + 4)
#: So many notes have room, and those of all events twice more: a loop is left at the end of a step where half of this
#: is taken, and at the next event where all of it is.
NOTES = 256
