"""The choice of modes at one state, compiled: rows at rest, their forces, and which of them are put into force.

A coordinate at rest stays so as long as a force within its bounds keeps it; all of these forces follow from the box
problem (`symgen.run.modes.box`) on accelerations, which are linear in them. Static bounds hold for coordinates that
come to rest, those in motion for coordinates that have just broken loose; a coordinate that its static bound does not
hold breaks loose too. Rows at rest that other ones determine stay off: the rows in force carry their part.

A one-sided row is in force where its gap is 0 and stays so, by a force that pushes. Gaps that strike have impacts first
(`symgen.run.modes.strikes`).
"""

from __future__ import annotations

import math

from symgen.base.ir.numerics import SKIP
from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.redundancy import choose_rows, farthest_row, is_off
from symgen.run.layout.scales import entry_of, larger_number
from symgen.run.loops.afresh import forget_steps
from symgen.run.loops.event_loop import EventState
from symgen.run.loops.search_records import (
    COUNT,
    FORCE,
    GAP,
    LOOKED,
    MARGIN,
    MEASURE,
    N_HEAD,
    PACE,
    RATE,
    ROW,
    STEEPEST,
)
from symgen.run.modes.bounded_rows import (
    CONSTANT,
    DEPENDENT,
    EFFORT,
    HELD,
    LEAST_MASS,
    LIMIT,
    NEGATIVE_GAP,
    NO_BOUND_IN_MOTION,
    NO_BOUNDS,
    NO_NUMBER,
    NO_RESTITUTION,
    NOT_FINITE,
    OTHERS,
    OUT_OF_RANGE,
    ROUNDED,
    SAME,
    SIGN,
    STILL,
    UNMOVED,
    Choice,
    is_held,
    is_kept_shut,
    is_shut,
    row_scale,
    sign_of_number,
    usual_of,
)
from symgen.run.modes.holding import hold_rows
from symgen.run.modes.resting import solve_rest


@exact(entry=True)
def read_rows(t: float, c: Choice, y: Array, p: Array, w: Array) -> int:
    """Read coordinates, rates and bounds at a state; return `SAME`, or `OUT_OF_RANGE`."""
    k, dry, out = c.count, c.dry, c.out
    c.states(t, y, p, w, c.rate, out)
    valid = True
    for i in range(k):
        c.value[i], c.speed[i] = out[i], out[k + i]
        c.static[i] = c.sliding[i] = c.restitution[i] = 0.0
        valid = valid and math.isfinite(out[i]) and math.isfinite(out[k + i])
        if i < dry:
            static, sliding = out[2 * k + i], out[2 * k + dry + i]
            if c.varying[i] != 0 and static < sliding and sliding <= static * (1.0 + ROUNDED):
                static = sliding
            c.static[i], c.sliding[i] = static, sliding
            valid = valid and math.isfinite(static) and sliding >= 0.0 and static >= sliding
            valid = valid and not (sliding == 0.0 and static > 0.0)
            if c.shifted != 0:
                c.middle[i] = out[3 * k + dry + i]
                valid = valid and abs(c.middle[i]) <= (static - sliding) + ROUNDED * static
        else:
            restitution = out[2 * k + dry + i]
            c.restitution[i] = restitution
            valid = valid and restitution >= 0.0 and restitution <= 1.0
            deep = out[i] < -c.depth[0] * row_scale(c, w, i, abi.LENGTH)
            valid = valid and not (deep and not is_kept_shut(c, w, i))
    return SAME if valid else OUT_OF_RANGE


@exact(entry=True)
def find_fault(c: Choice, w: Array) -> int:
    """Return the kind of number that is out of range at rows that have been read, and name the first such row.

    Of bounds of two directions those of one remain.
    """
    for i in range(c.count):
        if not math.isfinite(c.value[i] + c.speed[i] + c.static[i] + c.sliding[i] + c.restitution[i]):
            c.named[0] = i
            return NO_NUMBER
    for i in range(c.dry, c.count):
        if not (c.value[i] >= -c.depth[0] * row_scale(c, w, i, abi.LENGTH) or is_kept_shut(c, w, i)):
            c.named[0] = i
            return NEGATIVE_GAP
    for i in range(c.dry, c.count):
        if not (c.restitution[i] >= 0.0 and c.restitution[i] <= 1.0):
            c.named[0] = i
            return NO_RESTITUTION
    for i in range(c.dry):
        if c.sliding[i] == 0.0 and c.static[i] > 0.0:
            c.named[0] = i
            return NO_BOUND_IN_MOTION
    c.named[0] = 0
    for i in range(c.dry):
        static, sliding = c.static[i], c.sliding[i]
        shifted = c.shifted != 0 and abs(c.middle[i]) > (static - sliding) + ROUNDED * static
        if not (sliding >= 0.0 and static >= sliding) or shifted:
            c.named[0] = i
            if shifted:  # the bounds of the way in which they are wrong
                way, middle = -sign_of_number(c.middle[i]), c.out[3 * c.count + 2 * c.dry + i]
                c.static[i], c.sliding[i] = static + way * (middle + c.middle[i]), sliding + way * middle
            break
    return NO_BOUNDS


@exact(entry=True)
def find_starting(t: float, c: Choice, w: Array) -> int:
    """Find the coordinates at rest with a sign that have just broken loose; return the number of rows with two bounds.

    Others with a sign have moved and come to rest. What a choice has let go at this instant under other inputs is at
    rest: its static bound may hold it under those of now.
    """
    for i in range(c.dry):
        near = abs(c.value[i] - c.place[i]) <= UNMOVED * row_scale(c, w, i, abi.LENGTH)
        c.starting[i] = 1 if near and c.let_go[i] <= t and not (c.begins[0] != 0 and c.let_go[i] == t) else 0
    return int(c.dry)


@exact(entry=True)
def find_mobility(c: Choice) -> int:
    """Set the acceleration of each coordinate by a force on it if no joints held the bodies.

    A body without inertia counts with a part of the mean one: its joints decide how far it moves.
    """
    layout = c.layout
    for i in range(c.count):
        c.alone[i] = 0.0
    for e in range(layout.constants.shape[0]):
        i, j = c.place_of[layout.entries[3 * e]], layout.entries[3 * e + 1]
        if i >= 0:
            entry = entry_of(layout, c.w, e)
            least = LEAST_MASS * c.w[abi.MEAN_MASS] / c.w[layout.gauge + j]
            c.alone[i] += entry * entry / larger_number(c.w[layout.mass + j], least)
    return int(c.count)


@exact()
def copy_state(c: Choice, y: Array, w: Array, iw: Integers) -> None:
    """Copy a state and its scratch, in which modes may be tried."""
    for i in range(w.shape[0]):
        c.w[i] = w[i]
    for i in range(y.shape[0]):
        c.y[i] = y[i]
    for i in range(iw.shape[0]):
        c.iw[i] = iw[i]


@exact()
def write_rates(t: float, c: Choice, p: Array) -> None:
    """Write the rates of the copied state to ``rate``."""
    if c.rates(t, c.y, p, c.w, c.iw, c.rate) != 0:
        c.confirm(t, c.y, p, c.w, c.iw, c.rate)


@exact()
def measure_accelerations(t: float, c: Choice, p: Array, control: Integers) -> int:
    """Write the accelerations of coordinates in the modes of the copied state to ``out``."""
    if c.w[abi.STEP_STATUS] == 0.0:  # of laws whose gains follow the step, before the first one
        c.w[abi.STEP_STATUS] = c.step[0]
    write_rates(t, c, p)
    control[abi.EVALUATIONS] += 1
    c.accelerations(t, c.y, p, c.w, c.rate, c.out)
    for i in range(c.count):
        if not math.isfinite(c.out[i]):
            return NOT_FINITE
    return SAME


@exact(entry=True)
def accelerate(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Write the accelerations of coordinates with all rows off and efforts of the signs of ``trial`` to ``out``.

    A coordinate whose bounds depend on a reaction, or are 0 for a time, may be ``pushed`` by a force of -1.
    """
    copy_state(c, y, w, iw)
    for i in range(c.count):
        at = c.first + MODE_NUMBERS * i
        c.w[at + HELD] = c.w[at + CONSTANT] = c.w[at + LIMIT] = c.w[at + EFFORT] = 0.0
        c.w[at + SIGN] = c.trial[i]
    if c.pushed[0] >= 0:
        c.w[c.first + MODE_NUMBERS * c.pushed[0] + EFFORT] = 1.0
    return int(measure_accelerations(t, c, p, control))


@exact(entry=True)
def probe(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Set G among the rows at rest, and the accelerations without their forces."""
    k, n = c.count, c.at_rest[0]
    for i in range(k * k):
        c.matrix[i] = 0.0
    for i in range(k):
        c.trial[i] = c.signs[i]
    if accelerate(t, c, y, p, w, iw, control) != SAME:
        return NOT_FINITE
    for i in range(k):
        c.offset[i] = c.out[i]
    find_mobility(c)
    for r in range(n):
        j = c.rest[r]
        force, sign = c.sliding[j], 1.0
        if c.pushes[j] != 0 and c.alone[j] > 0.0:  # accelerations as large as those that are there
            force = larger_number(abs(c.offset[j]), usual_of(c, w, j)) / c.alone[j]
            sign = -force
        if force > 0.0 or c.varying[j] != 0:
            for i in range(k):
                c.trial[i] = c.signs[i]
            c.trial[j] = sign
            if force == 0.0 or c.middle[j] != 0.0:  # a bound of 0 holds what it holds at rest as soon as it rises
                force, c.trial[j], c.pushed[0] = 1.0, 0.0, j
            code = accelerate(t, c, y, p, w, iw, control)
            c.pushed[0] = -1
            if code != SAME:
                return NOT_FINITE
            for i in range(k):
                c.matrix[i * k + j] = (c.offset[i] - c.out[i]) / force
    symmetrise(c)
    size_forces(c, n, w)
    return SAME


@exact()
def size_forces(c: Choice, n: int, w: Array) -> None:
    """Set the forces at rest that make accelerations as large as those without them, and as usual ones."""
    for r in range(n):
        i = c.rest[r]
        own = c.matrix[i * c.count + i]
        c.scale[i] = (abs(c.offset[i]) + usual_of(c, w, i)) / own if own > 0.0 else 0.0


@exact(entry=True)
def symmetrise(c: Choice) -> int:
    """Make G symmetric among rows at rest, and 0 for rows that joints hold still, as at a dead centre."""
    k, n, matrix = c.count, c.at_rest[0], c.matrix
    for a in range(n):
        for b in range(a):
            i, j = c.rest[a], c.rest[b]
            mean = 0.5 * (matrix[i * k + j] + matrix[j * k + i])
            matrix[i * k + j] = matrix[j * k + i] = mean
    for a in range(n):
        i = c.rest[a]
        if matrix[i * k + i] <= DEPENDENT * c.alone[i]:
            for b in range(n):
                j = c.rest[b]
                matrix[i * k + j] = matrix[j * k + i] = 0.0
    return int(n)


@exact(entry=True)
def find_rest(c: Choice, w: Array) -> int:
    """Set the rows at rest, which of them are loose, and the signs of all others; return the number at rest."""
    n = 0
    for i in range(c.count):
        c.signs[i] = 0.0
        for number in range(MODE_NUMBERS):
            c.before[MODE_NUMBERS * i + number] = w[c.first + MODE_NUMBERS * i + number]
            c.after[MODE_NUMBERS * i + number] = 0.0
        c.forces[i] = 0.0
        c.taken[i] = 0
    for i in range(c.count):
        at, pushes = MODE_NUMBERS * i, c.pushes[i] != 0
        still = abs(c.speed[i]) <= STILL * row_scale(c, w, i, abi.SPEED) or c.broken[i] + c.stopped[i] != 0
        still = (still or is_held(c, w, i)) and not (pushes and not is_shut(c, w, i))
        loose = (still and c.starting[i] != 0 and c.before[at + SIGN] != 0.0) or c.broken[i] != 0
        loose = (loose and c.stopped[i] == 0) or c.left[i] != 0
        owner = int(c.before[at + CONSTANT]) - 1
        if c.before[at + HELD] == 0.0 and c.before[at + SIGN] == 0.0 and owner >= 0:
            moves = c.broken[owner] + c.left[owner] != 0
            loose = loose or (moves and c.before[MODE_NUMBERS * owner + HELD] != 0.0)
        c.loose[i] = 1 if loose else 0
        c.signs[i] = 0.0 if still or pushes else sign_of_number(c.speed[i])
        if still:
            c.rest[n] = i
            n += 1
    c.at_rest[0] = n
    return n


@exact(entry=True)
def write_modes(c: Choice, w: Array) -> int:
    """Write the chosen modes; return `OTHERS` where they differ from those before, else `SAME`."""
    code = SAME
    for i in range(MODE_NUMBERS * c.count):
        if w[c.first + i] != c.after[i]:
            code = OTHERS
        w[c.first + i] = c.after[i]
    return code


@exact(entry=True)
def choose_modes(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Choose the modes of a state whose rows have been read; return `SAME`, `OTHERS`, or why there are none."""
    n = find_rest(c, w)
    if n > 0:
        if probe(t, c, y, p, w, iw, control) != SAME:
            return NOT_FINITE
        found = solve_rest(c, n, w)
        if found != SAME:
            return int(found)
    code = hold_rows(c, w)
    for i in range(c.count):
        c.shut[i] = 0
    add_forces(c)
    return int(write_modes(c, w)) if code == SAME else int(code)


@exact()
def add_forces(c: Choice) -> None:
    """Add the forces at rest and their bounds to the sizes of forces."""
    for i in range(c.count):
        c.scale[i] += abs(c.forces[i]) + c.static[i]


@exact(entry=True)
def measure_margins(c: Choice, w: Array, hunt: Array) -> int:
    """Set the sizes that the rounding of margins is relative to; return their number."""
    n, at, found = int(hunt[COUNT]), N_HEAD, 0
    for k in range(n):
        kind, i = int(hunt[at + MARGIN * n + k]), int(hunt[at + ROW * n + k])
        size, pace = 1.0, math.inf
        rests = is_held(c, w, i)
        if kind == FORCE:
            size = c.scale[i]
        elif kind == GAP:
            size, pace = row_scale(c, w, i, abi.LENGTH), STILL * row_scale(c, w, i, abi.SPEED)
        elif kind == RATE:
            size = math.inf if rests else row_scale(c, w, i, abi.SPEED)
        hunt[at + MEASURE * n + k], hunt[at + PACE * n + k] = size, pace
        if kind != 0:
            hunt[at + STEEPEST * n + k] = hunt[at + LOOKED * n + k] = 0.0
        found += 1 if kind != 0 else 0
    return found


@exact(entry=True)
def follow_modes(t: float, c: Choice, y: Array, p: Array, w: Array) -> int:
    """Evaluate the geometry in new modes, and choose which redundant rows are left out; return 1 where others are.

    Rows of too large mechanisms stay the same.
    """
    layout, m = c.layout, c.layout.m
    c.geometry(t, y, p, w)
    if c.room.shape[0] == 0:
        return 0
    off, changed = 0, 0
    for i in range(m):
        off += 1 if is_off(layout, i, w) else 0
    redundant = m - off - farthest_row(layout, layout.nv, m, SKIP, 1, w, c.room)
    for i in range(m):
        c.w[i] = w[layout.mask + i]
        w[layout.mask + i] = 0.0
    if redundant > 0:
        choose_rows(layout, m - redundant, 1, w, c.room)
    for i in range(m):
        changed = changed if c.w[i] == w[layout.mask + i] else 1
    if changed != 0:
        c.geometry(t, y, p, w)
    return int(changed)


def look_anew(state: EventState) -> None:
    """Have the scheme begin anew, and passages of singular positions be looked for anew: there are other rows."""
    gauges, w = state.gauges, state.w
    sine, short = math.sqrt(max(w[abi.PIVOT], 0.0)), math.sqrt(max(w[abi.SHORTEST_ROW], 0.0))
    gauges[abi.LAST_SINE], gauges[abi.LARGEST_SINE], gauges[abi.LAST_SHORT] = sine, sine, short
    gauges[abi.FALL], gauges[abi.SHORT_FALL], gauges[abi.CHOSEN] = 0.0, 0.0, 0.0
    if state.control[abi.BEGUN] == 1:
        state.control[abi.BEGUN] = abi.ONWARD
    forget_steps(state)
