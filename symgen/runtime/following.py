"""Motions that are prescribed: positions, velocities and accelerations of mechanisms whose freedom is all driven.

Nothing is integrated: at every time Newton's iteration closes the positions, and two linear solutions give what follows
from them, from the emitted functions that starts and corrections use. The iteration begins where the state before
leads, and a step that would need a far correction is taken in shorter ones, so that the branch is kept.
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.runtime import following_records as f
from symgen.runtime.bare import bare
from symgen.runtime.redundancy import FALLEN
from symgen.store.jit import jit
from symgen.store.loops import from_its_source

#: Newton's iteration at one time ends after so many steps; the state that it corrects may be at most this far off, in
#: all and beside the sine by which the rows are apart: two branches are nearer to each other where that is small.
STEPS, FARTHEST, BESIDE_SINE = 8, 0.1, 0.1
#: A linear solution is refined while the last change was above this, times the smallest pivot: what rounding left of it
#: is the change times the rounding over the pivot.
REFINED = 1e-2
#: Energies are measured again where velocities have changed by more than this part.
MEASURED = 1e-13
#: Rounds of refinement.
ROUNDS = 4
#: A step moves nothing by more than this [rad, or the length of the mechanism].
LONGEST = 0.5
#: Behind steps that move something by more than this, and below this sine, the sign of the determinant is looked at;
#: else where 0 may have been passed.
LONG, LOOKED_AT = 0.1, 0.05

_A, _K, _I8 = types.float64[::1], types.int64[::1], types.int64


@jit()
def size_of(course: Any, values: Any, first: int) -> float:
    """Return the largest component of velocities, or of a change of them, as a number."""
    largest = 0.0
    for j in range(course.nv):
        size = abs(values[first + j]) * course.scale[j]
        largest = size if size > largest else largest
    return largest


@jit()
def close(geometry: Any, move: Any, spread: Any, course: Any, t: float, p: Any, w: Any, z: Any) -> float:
    """Close the positions of a state near them; return how far they moved, or -1 if there are none in reach.

    D and its factorisation are those of the closed positions then. A violation that is not finite leaves nan.
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
            closed = True  # all that rounding allows
        if closed and size <= 0.02 * course.tolerance:
            return moved
        spread(p, w)
        step = size_of(course, w, course.change)
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
def refine(course: Any, spread: Any, p: Any, w: Any, values: Any, first: int) -> float:
    """Take D^+ times the section of the residual out of some velocities; return how much that was beside them."""
    spread(p, w)
    step = size_of(course, w, course.change)
    for j in range(course.nv):
        values[first + j] += w[course.change + j]
    size = size_of(course, values, first)
    return step / size if size > 0.0 else 0.0


@jit()
def attempt(
    geometry: Any, measure: Any, move: Any, spread: Any, observe: Any, course: Any, h: float, p: Any, w: Any, stand: Any
) -> int:
    """Try the state that lies `h` behind the present one; it is accepted where `DONE` is returned."""
    nq, nv, y, a, z, rates, jerk = course.nq, course.nv, stand.y, stand.a, stand.trial, stand.rates, stand.jerk
    t = stand.clock[f.TIME] + h
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
    stand.clock[f.FAR] = far
    if far > LONGEST:
        return f.REFUSED
    if nq != nv:
        move(z, w)
    for i in range(course.windings):
        w[abi.WINDING + i] = stand.turned[i]
    moved = close(geometry, move, spread, course, t, p, w, z)
    if math.isnan(moved):
        return f.UNDEFINED
    if moved < 0.0:
        return f.REFUSED
    if w[abi.RANK] < course.rank:
        return f.SINGULAR
    sine = math.sqrt(w[abi.PIVOT])
    if moved > BESIDE_SINE * sine and stand.counts[f.SETTLED] != 0:
        return f.REFUSED
    part_of, enough = 1.0, REFINED * w[abi.PIVOT]
    for _ in range(ROUNDS):
        measure(t, z, p, w)
        part_of = refine(course, spread, p, w, z, nq)
        if part_of <= enough:
            break
    if part_of > MEASURED:
        measure(t, z, p, w)
    for _ in range(ROUNDS):
        observe(t, z, p, w, rates, stand.rows)
        for i in range(course.m):
            w[course.residual + i] = stand.rows[i]
        if refine(course, spread, p, w, rates, nq) <= enough:
            break
    for j in range(nv):
        if not math.isfinite(z[nq + j] + rates[nq + j]):
            return f.UNDEFINED
    return f.DONE


@jit()
def take(course: Any, h: float, w: Any, stand: Any) -> bool:
    """Make the state that was tried the present one, unless a singular position lies between; return whether it is."""
    clock, nq = stand.clock, course.nq
    sine, before, slope, sign = math.sqrt(w[abi.PIVOT]), clock[f.SINE], clock[f.SLOPE], clock[f.SIGN]
    fresh = abs(sine - before) / abs(h) if h != 0.0 else math.inf
    steepest = slope if slope > fresh else fresh
    clock[f.TRIED_SINE] = sine
    # a sine falls to 0 and rises again in a straight line
    if h == 0.0 or clock[f.FAR] > LONG or sine < LOOKED_AT or before + sine <= 2.0 * steepest * abs(h):
        sign = sign_of(course, w, stand.dense)
        if h != 0.0 and sign * clock[f.SIGN] < 0.0:
            return False
    clock[f.SINE], clock[f.SLOPE], clock[f.SIGN] = sine, fresh, sign
    clock[f.BEST] = sine if h == 0.0 or sine > clock[f.BEST] else clock[f.BEST]
    for i in range(course.ny):
        stand.y[i] = stand.trial[i]
    for j in range(course.nv):
        stand.jerk[j] = (stand.rates[nq + j] - stand.a[j]) / h if h != 0.0 else 0.0
        stand.a[j] = stand.rates[nq + j]
    for i in range(course.windings):
        stand.turned[i] = w[abi.WINDING + i]
    return True


@jit()
def sign_of(course: Any, w: Any, dense: Any) -> float:
    """Return the sign of the determinant of D, rows that depend on others left out; 0 where it is not square."""
    n, m, row = course.nv, course.m, 0
    for i in range(n * n):
        dense[i] = 0.0
    kept = 0
    for i in range(m):
        kept += 1 if w[course.mask + i] == 0.0 else 0
    if kept != n:
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


@from_its_source(
    _I8(*(abi.MEASURE, abi.MEASURE, abi.MOVE, abi.MOVE, abi.OBSERVE), *(f.COURSE, _A, _A, _A, f.STAND, f.FOLLOWED, _K))
)
def follow(
    geometry: Any,
    measure: Any,
    move: Any,
    spread: Any,
    observe: Any,
    course: Any,
    times: Any,
    p: Any,
    w: Any,
    stand: Any,
    followed: Any,
    control: Any,
) -> int:
    """Follow a motion through times that all lie behind, or all before, the time at which the loop stands.

    Parameters
    ----------
    geometry, measure, move, spread, observe : emitted functions
        See `symgen.runtime.abi`.
    course : Course
        Of the model.
    times : Array, shape (k,)
        In the order in which they are met [s].
    p, w : Array
        As emitted functions take them.
    stand : Stand
        Where the loop stands; it is left where it got to.
    followed : Followed
        Written, from the time ``stand.counts[AT]`` on.
    control : Array of int
        What the watching thread shares.

    Returns
    -------
    int
        `DONE`, or why the next step failed: `REFUSED` (no closed position in reach), `UNDEFINED` (a number that is
        not finite) however short it is, `SINGULAR` (at a singular position) or `PASSING` (one lies between);
        `CHOOSE` where other rows may have to stand for all.
    """
    course, p, w, stand, seen = bare(course), bare(p), bare(w), bare(stand), bare(followed)
    clock, counts = stand.clock, stand.counts
    if counts[f.SETTLED] == 0:
        code = attempt(geometry, measure, move, spread, observe, course, 0.0, p, w, stand)
        if code != f.DONE:
            return int(code)
        take(course, 0.0, w, stand)
        counts[f.SETTLED] = 1
    for k in range(counts[f.AT], times.shape[0]):
        if control[abi.STOP] != 0:
            break
        target = times[k]
        while clock[f.TIME] != target:
            if course.masked != 0 and clock[f.SINE] * clock[f.SINE] < FALLEN * clock[f.BEST] * clock[f.BEST]:
                return f.CHOOSE
            h = target - clock[f.TIME]
            whole = abs(h) <= clock[f.REACH]
            h = h if whole else math.copysign(clock[f.REACH], h)
            clock[f.TRIED] = target if whole else clock[f.TIME] + h
            code = attempt(geometry, measure, move, spread, observe, course, h, p, w, stand)
            if code == f.SINGULAR:
                return f.SINGULAR
            if code != f.DONE:
                clock[f.REACH] = 0.5 * abs(h)
                if clock[f.REACH] < course.least:
                    return int(code)
                continue
            if not take(course, h, w, stand):
                return f.PASSING
            clock[f.TIME] = clock[f.TRIED]
            clock[f.REACH] = 2.0 * abs(h) if 2.0 * abs(h) > clock[f.REACH] else clock[f.REACH]
            counts[f.TAKEN] += 1
        for i in range(course.ny):
            seen.states[k, i] = stand.y[i]
        for j in range(course.nv):
            seen.accelerations[k, j] = stand.a[j]
        for i in range(abi.N_STATUS):
            seen.status[k, i] = w[i]
        for i in range(course.windings):
            seen.status[k, abi.N_STATUS + i] = stand.turned[i]
        counts[f.AT] = k + 1
    return f.DONE
