"""Prescribed motions: positions, velocities and accelerations of mechanisms whose degrees of freedom are all driven.

Nothing is integrated: at every time Newton's iteration closes the positions, and two linear solutions give velocities
and accelerations, with the emitted functions of starts and corrections. The iteration begins at the extrapolated state,
and a step that would need a far correction is divided, so that the branch is kept.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import bare
from symgen.compile.native.annotations import Array, Integers, Matrix, Record
from symgen.compile.store.jit import jit
from symgen.run.layout import abi
from symgen.run.layout.redundancy import FALLEN

#: Newton's iteration at one time ends after this many steps; it may move the state by at most this much, in all and
#: relative to the sine between the rows: two branches are nearer to each other where that is small.
STEPS, FARTHEST, BESIDE_SINE = 8, 0.1, 0.1
#: A linear solution is refined while the last change is above this, times the smallest pivot: its remaining error is
#: the change times the rounding over the pivot.
REFINED = 1e-2
#: Energies are measured again if velocities have changed by more than this part.
MEASURED = 1e-13
#: Most rounds of refinement.
ROUNDS = 4
#: A step moves nothing by more than this [rad, or the length of the mechanism].
LONGEST = 0.5
#: The sign of the determinant is checked after steps with a motion above this, below this sine, and where 0 may have
#: been passed.
LONG, LOOKED_AT = 0.1, 0.05

#: Codes with which a step, and the loop, end.
DONE, REFUSED, UNDEFINED, SINGULAR, PASSING, CHOOSE = range(6)

#: Entries of a clock: time, longest step to try, sine, its rate of change, sign of the determinant; time, sine and
#: predicted motion of the last attempt; largest sine since independent rows were last chosen.
TIME, REACH, SINE, SLOPE, SIGN, TRIED, TRIED_SINE, FAR, BEST = range(9)
N_CLOCK = 9
#: Entries of the counts: times done, steps, and whether a state was settled.
AT, TAKEN, SETTLED = range(3)
N_COUNTS = 3


class Course(Record):
    """Data of a model for the loop.

    Attributes
    ----------
    nq, nv, m, ny, windings : int
        Coordinates, velocities, constraint rows, length of the state, angles whose turns are counted.
    residual, change, mask, jacobian : int
        First indices of these sections of ``w``.
    masked, rank : int
        Rows that always depend on others, and the rank of D at a regular position: the number of velocities.
    tolerance, least : float
        Tolerance of the violation of positions [m], and shortest step [s].
    entries, constants : Array of int64, Array
        D's structural entries, see `symgen.run.layout.model_arrays.entries_of`.
    scale : Array, shape (nv,)
        Factors that make changes dimensionless: 1 for angles, one over the length of the mechanism for lengths.
    """

    nq: int
    nv: int
    m: int
    ny: int
    windings: int
    residual: int
    change: int
    mask: int
    jacobian: int
    masked: int
    rank: int
    tolerance: float
    least: float
    entries: Integers
    constants: Array
    scale: Array


class Stand(Record):
    """Present state of the loop, and room for trial states.

    Attributes
    ----------
    y, a, jerk : Array, shapes (ny,), (nv,), (nv,)
        State, accelerations, and their change in the last step over its length.
    clock, counts : Array, Array of int64
        See `TIME` and `AT`.
    trial, rates : Array, shape (ny,)
        Trial state, and its rates.
    rows : Array
        Output of ``observe``.
    turned : Array, shape (windings,)
        Angles whose turns are counted, in the accepted state.
    dense : Array
        A square D.
    """

    y: Array
    a: Array
    jerk: Array
    clock: Array
    counts: Integers
    trial: Array
    rates: Array
    rows: Array
    turned: Array
    dense: Array


class Followed(Record):
    """Output of the loop: states, accelerations and status, one row for each time.

    For the status see `symgen.run.single.outcome.Motion`.
    """

    states: Matrix
    accelerations: Matrix
    status: Matrix


CourseModel = tuple[Course, abi.Measure, abi.Measure, abi.Move, abi.Move, abi.Observe]


@jit()
def size_of_velocities(course: Course, values: Array, first: int) -> float:
    """Return the largest dimensionless component of velocities, or of their change."""
    largest = 0.0
    for j in range(course.nv):
        size = abs(values[first + j]) * course.scale[j]
        largest = size if size > largest else largest
    return largest


@jit()
def close_positions_of_trial(
    geometry: abi.Measure, move: abi.Move, spread: abi.Move, course: Course, t: float, p: Array, w: Array, z: Array
) -> float:
    """Close the positions of a state; return the distance moved, or -1 if no closed ones are in reach.

    D and its factorisation are then those of the closed positions. If the violation is not finite, nan is returned.
    """
    moved, before = 0.0, math.inf
    for k in range(STEPS):
        geometry(t, z, p, w)
        size = w[abi.PHI_MEASURE]
        if not math.isfinite(size):
            return math.nan
        closed = size <= course.tolerance
        if not closed and size > 0.5 * before and k > 1:
            if size > 1e3 * course.tolerance:
                return -1.0
            closed = True  # to rounding
        if closed and size <= 0.02 * course.tolerance:
            return moved
        spread(p, w)
        step = size_of_velocities(course, w, course.change)
        moved += step
        if not moved <= FARTHEST:
            return -1.0
        if course.nq == course.nv:
            for j in range(course.nv):
                z[j] += w[course.change + j]
        else:
            move(z, w)
        if closed:  # by less than the rounding of D
            return moved
        before = size
    return -1.0


@jit()
def refine_velocities(course: Course, spread: abi.Move, p: Array, w: Array, values: Array, first: int) -> float:
    """Correct velocities by D^+ times the section of the residual; return the relative change."""
    spread(p, w)
    step = size_of_velocities(course, w, course.change)
    for j in range(course.nv):
        values[first + j] += w[course.change + j]
    size = size_of_velocities(course, values, first)
    return step / size if size > 0.0 else 0.0


@jit()
def attempt_position(model: CourseModel, h: float, p: Array, w: Array, stand: Stand) -> int:
    """Compute a trial state at `h` after the present one; return `DONE` if it is acceptable."""
    course, geometry, measure, move, spread, observe = model
    nq, nv, y, a, z, rates, jerk = course.nq, course.nv, stand.y, stand.a, stand.trial, stand.rates, stand.jerk
    t = stand.clock[TIME] + h
    for i in range(nq):
        z[i] = y[i]
    far = 0.0
    for j in range(nv):
        change = h * (y[nq + j] + h * (0.5 * a[j] + h * jerk[j] / 6.0))
        far = max(far, abs(change) * course.scale[j])
        if nq == nv:
            z[j] += change
        else:
            w[course.change + j] = change
        z[nq + j] = y[nq + j] + h * (a[j] + 0.5 * h * jerk[j])
        rates[nq + j] = a[j] + h * jerk[j]
    stand.clock[FAR] = far
    if far > LONGEST:
        return REFUSED
    if nq != nv:
        move(z, w)
    for i in range(course.windings):
        w[abi.WINDING + i] = stand.turned[i]
    moved = close_positions_of_trial(geometry, move, spread, course, t, p, w, z)
    if math.isnan(moved):
        return UNDEFINED
    if moved < 0.0:
        return REFUSED
    if w[abi.RANK] < course.rank:
        return SINGULAR
    sine = math.sqrt(w[abi.PIVOT])
    if moved > BESIDE_SINE * sine and stand.counts[SETTLED] != 0:
        return REFUSED
    part_of, enough = 1.0, REFINED * w[abi.PIVOT]
    for _ in range(ROUNDS):
        measure(t, z, p, w)
        part_of = refine_velocities(course, spread, p, w, z, nq)
        if part_of <= enough:
            break
    if part_of > MEASURED:
        measure(t, z, p, w)
    for _ in range(ROUNDS):
        observe(t, z, p, w, rates, stand.rows)
        for i in range(course.m):
            w[course.residual + i] = stand.rows[i]
        if refine_velocities(course, spread, p, w, rates, nq) <= enough:
            break
    for j in range(nv):
        if not math.isfinite(z[nq + j] + rates[nq + j]):
            return UNDEFINED
    return DONE


@jit()
def accept_trial(course: Course, h: float, w: Array, stand: Stand) -> bool:
    """Accept the trial state unless a singular position lies between; return whether it is accepted."""
    clock, nq = stand.clock, course.nq
    sine, before, slope, sign = math.sqrt(w[abi.PIVOT]), clock[SINE], clock[SLOPE], clock[SIGN]
    fresh = abs(sine - before) / abs(h) if h != 0.0 else math.inf
    steepest = slope if slope > fresh else fresh
    clock[TRIED_SINE] = sine
    # a sine falls to 0 and rises again in a straight line
    if h == 0.0 or clock[FAR] > LONG or sine < LOOKED_AT or before + sine <= 2.0 * steepest * abs(h):
        sign = determinant_sign(course, w, stand.dense)
        if h != 0.0 and sign * clock[SIGN] < 0.0:
            return False
    clock[SINE], clock[SLOPE], clock[SIGN] = sine, fresh, sign
    clock[BEST] = sine if h == 0.0 or sine > clock[BEST] else clock[BEST]
    for i in range(course.ny):
        stand.y[i] = stand.trial[i]
    for j in range(course.nv):
        stand.jerk[j] = (stand.rates[nq + j] - stand.a[j]) / h if h != 0.0 else 0.0
        stand.a[j] = stand.rates[nq + j]
    for i in range(course.windings):
        stand.turned[i] = w[abi.WINDING + i]
    return True


@jit()
def determinant_sign(course: Course, w: Array, dense: Array) -> float:
    """Return the sign of the determinant of D without dependent rows; 0 if it is not square."""
    n, m, row = course.nv, course.m, 0
    for i in range(n * n):
        dense[i] = 0.0
    count = 0
    for i in range(m):
        count += 1 if w[course.mask + i] == 0.0 else 0
    if count != n:
        return 0.0
    place, last = -1, -1
    for k in range(course.constants.shape[0]):
        row, column, slot = course.entries[3 * k], course.entries[3 * k + 1], course.entries[3 * k + 2]
        if w[course.mask + row] != 0.0:
            continue
        if row != last:
            place, last = place + 1, row
        dense[place * n + column] = course.constants[k] if slot < 0 else w[course.jacobian + slot]
    sign = 1.0
    for c in range(n):
        best = c
        for r in range(c + 1, n):
            if abs(dense[r * n + c]) > abs(dense[best * n + c]):
                best = r
        pivot = dense[best * n + c]
        if pivot == 0.0:
            return 0.0
        if best != c:
            sign = -sign
            for j in range(c, n):
                dense[c * n + j], dense[best * n + j] = dense[best * n + j], dense[c * n + j]
        sign = -sign if pivot < 0.0 else sign
        for r in range(c + 1, n):
            factor = dense[r * n + c] / pivot
            if factor != 0.0:
                for j in range(c, n):
                    dense[r * n + j] -= factor * dense[c * n + j]
    return sign


@jit(entry=True)
def follow_motion(
    model: CourseModel, times: Array, p: Array, w: Array, stand: Stand, followed: Followed, control: Integers
) -> int:
    """Follow a motion through times that are all after, or all before, the present time of the loop.

    Parameters
    ----------
    model : tuple
        A `Course`, then ``geometry``, ``measure``, ``move``, ``spread`` and ``observe`` (`symgen.run.layout.abi`).
    times : Array, shape (k,)
        Times in the order of the motion [s].
    p, w : Array
        Parameters and scratch of emitted functions.
    stand : Stand
        Present state of the loop, updated.
    followed : Followed
        Output, written from the time ``stand.counts[AT]`` on.
    control : Array of int
        Integers shared with the watching thread.

    Returns
    -------
    int
        `DONE`, or why the next step failed: `REFUSED` (no closed position in reach), `UNDEFINED` (a number that is
        not finite) however short it is, `SINGULAR` (at a singular position) or `PASSING` (one lies between);
        `CHOOSE` if other independent rows may have to be chosen.
    """
    course, geometry, measure, move, spread, observe = model
    course, p, w, stand, seen = bare(course), bare(p), bare(w), bare(stand), bare(followed)
    model = course, geometry, measure, move, spread, observe
    clock, counts = stand.clock, stand.counts
    if counts[SETTLED] == 0:
        code = attempt_position(model, 0.0, p, w, stand)
        if code != DONE:
            return int(code)
        accept_trial(course, 0.0, w, stand)
        counts[SETTLED] = 1
    for k in range(counts[AT], times.shape[0]):
        if control[abi.STOP] != 0:
            break
        target = times[k]
        while clock[TIME] != target:
            if course.masked != 0 and clock[SINE] * clock[SINE] < FALLEN * clock[BEST] * clock[BEST]:
                return CHOOSE
            h = target - clock[TIME]
            whole = abs(h) <= clock[REACH]
            h = h if whole else math.copysign(clock[REACH], h)
            clock[TRIED] = target if whole else clock[TIME] + h
            code = attempt_position(model, h, p, w, stand)
            if code == SINGULAR:
                return SINGULAR
            if code != DONE:
                clock[REACH] = 0.5 * abs(h)
                if clock[REACH] < course.least:
                    return int(code)
                continue
            if not accept_trial(course, h, w, stand):
                return PASSING
            clock[TIME] = clock[TRIED]
            clock[REACH] = 2.0 * abs(h) if 2.0 * abs(h) > clock[REACH] else clock[REACH]
            counts[TAKEN] += 1
        for i in range(course.ny):
            seen.states[k, i] = stand.y[i]
        for j in range(course.nv):
            seen.accelerations[k, j] = stand.a[j]
        for i in range(abi.N_STATUS):
            seen.status[k, i] = w[i]
        for i in range(course.windings):
            seen.status[k, abi.N_STATUS + i] = stand.turned[i]
        counts[AT] = k + 1
    return DONE
