"""Corners of gaps: states that go on past them, and impacts there, in one source for all targets.

A step has ended before a corner, in the row of the piece before it (`symgen.run.loops.searching`). Past it the gap has
the row of another piece, whose rate is that of a closed gap without its row in force: impacts and modes decide.
"""

from __future__ import annotations

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.scales import larger_number
from symgen.run.layout.start_records import Instant
from symgen.run.loops.search_records import (
    CORNER,
    COUNT,
    D_START,
    FIRED,
    GRAIN,
    MARGIN,
    N_HEAD,
    ROW,
    SIDE,
)
from symgen.run.modes.bounded_rows import (
    HELD,
    STILL,
    is_held,
    is_shut,
    open_rows,
    row_scale,
    sign_of_number,
    switch_off,
)
from symgen.run.modes.probing import copy_state, write_rates
from symgen.run.modes.reading import take_for_still
from symgen.run.modes.row_records import Choice
from symgen.run.modes.strikes import Strikes, accelerate_in_force

#: Largest number of doublings of the time in which a state passes a corner, and that time over the resolution of time.
_DOUBLINGS, _PASSING = 24, 4.0
#: A start lies on a corner below this part of the size of its terms.
_GRAIN = 1e-13
#: Least time of which that resolution is a part [s].
_EARLY = 1e-3
#: Depth over the mechanism's length to which a gap beside a closed one only touches: closed ones are as far from 0.
_TOUCHED = 1e-10


@exact()
def is_passed(hunt: Array, n: int, k: int) -> bool:
    """Return whether the latest step has ended before a corner that it passes."""
    at = N_HEAD
    return bool(hunt[at + MARGIN * n + k] == float(CORNER) and hunt[at + FIRED * n + k] != 0.0)


@exact(entry=True)
def pass_corners(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array, iw: Integers, hunt: Array) -> int:
    """Move a state on from before corners of closed gaps until rounding no longer hides that it is past them.

    It moves with its velocities, which the rows of the gaps change past the corners: all rows are off, and gaps that
    are closed stay so until an impact or a choice of modes opens them. A state whose velocities do not take it there
    stays where it is. Returns the number of corners.
    """
    n, found, work = int(hunt[COUNT]), 0, s.effects.past.out
    for k in range(n):
        found += 1 if is_passed(hunt, n, k) else 0
    if found == 0:
        return 0
    copy_state(c, y, w, iw)
    write_rates(t, c, p)
    step, ahead = _PASSING * abi.RESOLVED_TIME * larger_number(t, _EARLY), False
    for _ in range(_DOUBLINGS):
        if not ahead:
            for i in range(y.shape[0]):
                c.y[i] = y[i] + (step * c.rate[i] if i < c.rows.layout.nq else 0.0)
            s.effects.happens(t, c.y, p, w, c.rate, work)
            ahead = True
            for k in range(n):
                far = 2.0 * hunt[N_HEAD + GRAIN * n + k]
                ahead = ahead and not (is_passed(hunt, n, k) and hunt[N_HEAD + SIDE * n + k] * work[k] <= far)
            step *= 2.0
    if ahead:
        for i in range(c.rows.layout.nq):
            y[i] = c.y[i]
    for k in range(n):
        hunt[N_HEAD + D_START * n + k] = work[n + k]
    switch_off(c, w)
    return found


@exact(entry=True)
def has_corners(hunt: Array) -> bool:
    """Whether any gap has corners."""
    n, found = int(hunt[COUNT]), 0
    for k in range(n):
        if hunt[N_HEAD + MARGIN * n + k] == float(CORNER):
            found = 1
    return found == 1


@exact(entry=True)
def begin_at_corners(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array, iw: Integers, hunt: Array) -> int:
    """Move a start on that lies on corners of closed gaps, as `pass_corners` does; return the number of corners.

    Rows have been read. A start has no modes: gaps that touch count as closed.
    """
    n, at, work, found = int(hunt[COUNT]), N_HEAD, s.effects.past.out, 0
    for i in range(c.rows.dry, c.rows.count):
        w[c.rows.first + MODE_NUMBERS * i + HELD] = 1.0 if is_shut(c, w, i) else 0.0
    accelerate_in_force(t, c, Instant(y, p, w), iw)
    s.effects.happens(t, y, p, w, c.rate, work)
    for k in range(n):
        if hunt[at + MARGIN * n + k] == float(CORNER):
            grain = _GRAIN * work[2 * n + k]
            lies = abs(work[k]) <= grain and abs(work[n + k]) > 0.0
            hunt[at + FIRED * n + k] = 1.0 if lies else 0.0
            hunt[at + SIDE * n + k], hunt[at + GRAIN * n + k] = sign_of_number(work[n + k]), grain
    found = pass_corners(t, c, s, y, p, w, iw, hunt)
    if found == 0:
        open_rows(c, w)
    return int(found)


@exact(entry=True)
def spare_touching(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers) -> None:
    """Take the rates of gaps that only touch for 0: they turn before they are as deep as rounding.

    A gap shares the corner of the closed one that goes past it: beside that one it comes to 0 with a rate of 0, and
    rounding finds it there long before. Rows have been read.
    """
    accelerate_in_force(t, c, Instant(y, p, w), iw)
    for i in range(c.rows.dry, c.rows.count):
        rate, deep = c.read.speed[i], 2.0 * _TOUCHED * row_scale(c, w, i, abi.LENGTH) * c.out[i]
        if rate < 0.0 and rate * rate < deep and is_shut(c, w, i) and not is_held(c, w, i):
            take_for_still(c, i)


@exact(entry=True)
def find_both_pieces(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array, hunt: Array) -> int:
    """Return 1 where an impact at a corner sends the motion back into the piece that it came along, and name the row.

    Gaps of both pieces differ by a multiple of what is 0 at the corner. Before the impact the rate of the piece before
    it was 0, so that rates before and after it tell that of this piece now.
    """
    n, at, work, found = int(hunt[COUNT]), N_HEAD, s.effects.past.out, 0
    for i in range(c.rows.dry, c.rows.count):
        w[c.rows.first + MODE_NUMBERS * i + HELD] = 1.0 if s.active[i] != 0 else 0.0
    s.effects.happens(t, y, p, w, c.rate, work)
    open_rows(c, w)
    for k in range(n):
        i = int(hunt[at + ROW * n + k])
        if is_passed(hunt, n, k) and s.active[i] != 0 and s.before[i] < 0.0:
            before, after = hunt[at + D_START * n + k], work[n + k]
            rate = c.read.speed[i] - s.before[i] * (after / before)
            if hunt[at + SIDE * n + k] * after < 0.0 and rate < -STILL * row_scale(c, w, i, abi.SPEED):
                c.named[0], found = i, 1
    return found
