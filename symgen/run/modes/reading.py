"""Rows with bounds at a state, compiled: what is read of them, and what is wrong with it."""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.modes.bounded_rows import (
    NEGATIVE_GAP,
    NO_BOUND_IN_MOTION,
    NO_BOUNDS,
    NO_NUMBER,
    NO_RESTITUTION,
    OUT_OF_RANGE,
    ROUNDED,
    SAME,
    UNMOVED,
    is_kept_shut,
    row_scale,
    sign_of_number,
)
from symgen.run.modes.row_records import Choice


@exact(entry=True)
def read_rows(t: float, c: Choice, y: Array, p: Array, w: Array) -> int:
    """Read coordinates, rates and bounds at a state; return `SAME`, or `OUT_OF_RANGE`."""
    k, dry, out = c.rows.count, c.rows.dry, c.out
    c.rows.states(t, y, p, w, c.rate, out)
    valid = True
    for i in range(k):
        c.read.value[i], c.read.speed[i] = out[i], out[k + i]
        c.read.static[i] = c.read.sliding[i] = c.read.restitution[i] = 0.0
        valid = valid and math.isfinite(out[i]) and math.isfinite(out[k + i])
        if i < dry:
            static, sliding = out[2 * k + i], out[2 * k + dry + i]
            if c.rows.varying[i] != 0 and static < sliding and sliding <= static * (1.0 + ROUNDED):
                static = sliding
            c.read.static[i], c.read.sliding[i] = static, sliding
            valid = valid and math.isfinite(static) and sliding >= 0.0 and static >= sliding
            valid = valid and not (sliding == 0.0 and static > 0.0)
            if c.rows.shifted != 0:
                c.read.middle[i] = out[3 * k + dry + i]
                valid = valid and abs(c.read.middle[i]) <= (static - sliding) + ROUNDED * static
        else:
            restitution = out[2 * k + dry + i]
            c.read.restitution[i] = restitution
            valid = valid and restitution >= 0.0 and restitution <= 1.0
            deep = out[i] < -c.found.depth[0] * row_scale(c, w, i, abi.LENGTH)
            valid = valid and not (deep and not is_kept_shut(c, w, i))
    return SAME if valid else OUT_OF_RANGE


@exact(entry=True)
def find_fault(c: Choice, w: Array) -> int:
    """Return the kind of number that is out of range at rows that have been read, and name the first such row.

    Of bounds of two directions those of one remain.
    """
    for i in range(c.rows.count):
        if not math.isfinite(
            c.read.value[i] + c.read.speed[i] + c.read.static[i] + c.read.sliding[i] + c.read.restitution[i]
        ):
            c.named[0] = i
            return NO_NUMBER
    for i in range(c.rows.dry, c.rows.count):
        if not (c.read.value[i] >= -c.found.depth[0] * row_scale(c, w, i, abi.LENGTH) or is_kept_shut(c, w, i)):
            c.named[0] = i
            return NEGATIVE_GAP
    for i in range(c.rows.dry, c.rows.count):
        if not (c.read.restitution[i] >= 0.0 and c.read.restitution[i] <= 1.0):
            c.named[0] = i
            return NO_RESTITUTION
    for i in range(c.rows.dry):
        if c.read.sliding[i] == 0.0 and c.read.static[i] > 0.0:
            c.named[0] = i
            return NO_BOUND_IN_MOTION
    c.named[0] = 0
    for i in range(c.rows.dry):
        static, sliding = c.read.static[i], c.read.sliding[i]
        shifted = c.rows.shifted != 0 and abs(c.read.middle[i]) > (static - sliding) + ROUNDED * static
        if not (sliding >= 0.0 and static >= sliding) or shifted:
            c.named[0] = i
            if shifted:  # the bounds of the way in which they are wrong
                way, middle = -sign_of_number(c.read.middle[i]), c.out[3 * c.rows.count + 2 * c.rows.dry + i]
                c.read.static[i], c.read.sliding[i] = static + way * (middle + c.read.middle[i]), sliding + way * middle
            break
    return NO_BOUNDS


@exact(entry=True)
def find_starting(t: float, c: Choice, w: Array) -> int:
    """Find the coordinates at rest with a sign that have just broken loose; return the number of rows with two bounds.

    Others with a sign have moved and come to rest. What a choice has let go at this instant under other inputs is at
    rest: its static bound may hold it under those of now.
    """
    for i in range(c.rows.dry):
        near = abs(c.read.value[i] - c.found.place[i]) <= UNMOVED * row_scale(c, w, i, abi.LENGTH)
        now = c.found.begins[0] != 0 and c.found.let_go[i] == t
        c.read.starting[i] = 1 if near and c.found.let_go[i] <= t and not now else 0
    return int(c.rows.dry)


@exact()
def recall_rates(c: Choice, rates: Array) -> None:
    """Set rates that have been read before, at the same state."""
    for i in range(c.rows.count):
        c.read.speed[i] = rates[i]


@exact()
def take_for_still(c: Choice, i: int) -> None:
    """Take the rate of a row for 0."""
    c.read.speed[i] = 0.0
