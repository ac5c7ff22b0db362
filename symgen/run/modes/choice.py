"""Rows at rest at one state, before modes are chosen (`symgen.run.modes.choosing`), and what follows a choice."""

from __future__ import annotations

import math

from symgen.base.ir.numerics import SKIP
from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array
from symgen.run.effects.pushing import PAIRED
from symgen.run.layout import abi
from symgen.run.layout.redundancy import choose_rows, farthest_row, is_off
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
    HELD,
    OTHERS,
    SAME,
    SIGN,
    STILL,
    is_held,
    is_shut,
    row_scale,
    sign_of_number,
)
from symgen.run.modes.paired_rows import component_at, is_first, length_at, share_found
from symgen.run.modes.row_records import Choice


@exact(entry=True)
def find_rest(c: Choice, w: Array) -> int:
    """Set the rows at rest, which of them are loose, and the signs of all others; return the number at rest."""
    n = 0
    for i in range(c.rows.count):
        c.signs[i] = 0.0
        for number in range(MODE_NUMBERS):
            c.before[MODE_NUMBERS * i + number] = w[c.rows.first + MODE_NUMBERS * i + number]
            c.after[MODE_NUMBERS * i + number] = 0.0
        c.forces[i] = 0.0
        c.taken[i] = 0
    for i in range(c.rows.count):
        at, pushes = MODE_NUMBERS * i, c.rows.pushes[i] != 0
        if PAIRED:
            share_found(c, w, i)
        found = c.found.broken[i] + c.found.stopped[i] != 0
        still = abs(c.read.speed[i]) <= STILL * row_scale(c, w, i, abi.SPEED) or found
        if PAIRED:
            still = length_at(c, c.read.speed, i) <= STILL * row_scale(c, w, i, abi.SPEED) or found
        still = (still or is_held(c, w, i)) and not (pushes and not is_shut(c, w, i))
        loose = (still and c.read.starting[i] != 0 and c.before[at + SIGN] != 0.0) or c.found.broken[i] != 0
        loose = (loose and c.found.stopped[i] == 0) or c.found.left[i] != 0
        owner = int(c.before[at + CONSTANT]) - 1
        if c.before[at + HELD] == 0.0 and c.before[at + SIGN] == 0.0 and owner >= 0:
            moves = c.found.broken[owner] + c.found.left[owner] != 0
            loose = loose or (moves and c.before[MODE_NUMBERS * owner + HELD] != 0.0)
        c.loose[i] = 1 if loose else 0
        c.signs[i] = 0.0 if still or pushes else sign_of_number(c.read.speed[i])
        if PAIRED and not (still or pushes):
            c.signs[i] = component_at(c, c.read.speed, i)
        if still:
            c.rest[n] = i
            n += 1
    c.at_rest[0] = n
    return n


@exact(entry=True)
def write_modes(c: Choice, w: Array) -> int:
    """Write the chosen modes; return `OTHERS` where they differ from those before, else `SAME`."""
    code = SAME
    for i in range(MODE_NUMBERS * c.rows.count):
        if w[c.rows.first + i] != c.after[i]:
            code = OTHERS
        w[c.rows.first + i] = c.after[i]
    return code


@exact(entry=True)
def measure_margins(c: Choice, w: Array, hunt: Array) -> int:
    """Set the sizes that the rounding of margins is relative to; return their number.

    Rows along contacts at rest that others carry are watched: a drive may move them, though the rows in force stay at
    rest.
    """
    n, at, found = int(hunt[COUNT]), N_HEAD, 0
    for k in range(n):
        kind, i = int(hunt[at + MARGIN * n + k]), int(hunt[at + ROW * n + k])
        size, pace, numbers = 1.0, math.inf, c.rows.first + MODE_NUMBERS * i
        rests = is_held(c, w, i)
        if c.rows.pushes[i] == 0 and c.rows.partner[i] >= 0 and w[numbers + SIGN] == 0.0:
            rests = rests and w[numbers + HELD] != 0.0
            if PAIRED and is_first(c, i):  # as long as one of both rows is not in force
                rests = rests and w[numbers + MODE_NUMBERS + HELD] != 0.0
        if kind == FORCE:
            size = c.problem.scale[i]
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
    layout, m = c.rows.layout, c.rows.layout.m
    c.rows.geometry(t, y, p, w)
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
        c.rows.geometry(t, y, p, w)
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
