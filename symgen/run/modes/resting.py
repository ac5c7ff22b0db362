"""Forces at rest, compiled: those within static bounds hold, and rows that none hold begin to move.

Where more rows rest than the mechanism has freedom, forces at rest are not determined. Rows in force take what changes,
and others keep the efforts that they have, until one is at its bound. As any forces within all bounds hold, efforts are
then shared out anew: those whose largest part of a static bound is least. Only where this part is 1 does the row move.
Rows that begin to move have their sliding forces before others at rest are let go for good.
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array
from symgen.run.modes.bounded_rows import (
    AT_BOUND,
    AT_REST,
    CONSTANT,
    CONTRARY,
    HELD,
    NO_ACCELERATION,
    NO_FACTOR,
    NO_FORCES,
    ROUNDED,
    SAME,
    SIGN,
    sign_of_number,
    usual_of,
)
from symgen.run.modes.box import INSIDE, is_contrary, solve_box
from symgen.run.modes.row_records import Choice

#: Rows are at their bounds beyond this part; number of halvings in which the least part is found.
SPENT, HALVINGS = 1.0 - 1e-11, 30


@exact()
def moves_at(c: Choice, n: int, r: int) -> bool:
    """Whether the acceleration of the row at place `r` among those at rest is more than rounding."""
    box, size = c.box, abs(c.box.offset[r])
    for j in range(n):
        size += abs(box.matrix[r * n + j]) * abs(box.forces[j])
    return bool(box.place[r] != INSIDE and abs(box.left[r]) > NO_ACCELERATION * size)


@exact()
def is_shared(c: Choice, n: int, i: int) -> bool:
    """Whether a row at rest shares its effort with rows that keep one of their own."""
    for r in range(n):
        j = c.rest[r]
        at, both = MODE_NUMBERS * j, c.problem.matrix[i * c.rows.count + i] * c.problem.matrix[j * c.rows.count + j]
        keeps = c.rows.pushes[j] == 0 and c.before[at + HELD] == 0.0 and c.before[at + SIGN] == 0.0
        keeps = keeps and c.before[at + CONSTANT] == AT_REST
        if keeps and c.problem.matrix[i * c.rows.count + j] * c.problem.matrix[i * c.rows.count + j] > NO_FACTOR * both:
            return True
    return False


@exact()
def is_tied(c: Choice, n: int, i: int) -> bool:
    """Whether a force at rest accelerates a row at its bound."""
    for r in range(n):
        if c.found.broken[c.rest[r]] != 0 and c.problem.matrix[i * c.rows.count + c.rest[r]] != 0.0:
            return True
    return False


@exact()
def set_bounds(c: Choice, n: int, part: float) -> None:
    """Set the bounds of forces at rest: static bounds, of which tied rows have a part, or bounds of motion.

    Forces count from the middle of the bounds of motion, so that 0 is within all bounds.
    """
    box = c.box
    for r in range(n):
        i = c.rest[r]
        bound, shift = c.read.sliding[i], 0.0
        if c.taken[i] != 0:
            bound, shift = c.read.static[i], c.read.middle[i]
            if part < 1.0 and is_tied(c, n, i):
                bound, shift = bound * part, shift * part
        pushes = c.rows.pushes[i] != 0
        box.bounds[r] = 0.0 if pushes else bound + shift
        box.lower[r] = shift - bound if not pushes else (0.0 if c.loose[i] != 0 else -math.inf)


@exact()
def solve_within(c: Choice, n: int, part: float) -> int:
    """Find the forces at rest within bounds, tied ones within a part of static bounds; return `SAME` or `NO_FORCES`."""
    set_bounds(c, n, part)
    return SAME if solve_box(n, c.box) == 0 else NO_FORCES


@exact()
def rest_within(c: Choice, n: int, part: float) -> bool:
    """Whether the rows that share the effort of a broken one all rest within a part of their static bounds."""
    if solve_within(c, n, part) != SAME:
        return False
    for r in range(n):
        if is_tied(c, n, c.rest[r]) and moves_at(c, n, r):
            return False
    return True


@exact()
def share_anew(c: Choice, n: int) -> float:
    """Return the part of static bounds within which a row at its bound rests by other efforts of those that share it.

    Where there is none it is loose, and the part is 1.
    """
    low, high, found = 0.0, SPENT, False
    for r in range(n):
        i = c.rest[r]
        if c.found.broken[i] != 0 and c.loose[i] != 0 and c.rows.pushes[i] == 0 and is_shared(c, n, i):
            c.taken[i], found = 1, True
    if not found:
        return 1.0
    if rest_within(c, n, SPENT):
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if rest_within(c, n, middle):
                high = middle
            else:
                low = middle
        for r in range(n):
            i = c.rest[r]
            c.loose[i] = 0 if c.taken[i] != 0 else c.loose[i]
        return high
    for r in range(n):  # those that share it are at their bounds as well
        i, bound = c.rest[r], 0.5 * (c.box.bounds[r] - c.box.lower[r])
        spent = abs(c.box.forces[r] - 0.5 * (c.box.bounds[r] + c.box.lower[r])) >= AT_BOUND * bound
        c.loose[i] = 1 if c.rows.pushes[i] == 0 and spent and is_tied(c, n, i) else c.loose[i]
        c.taken[i] = 0 if c.loose[i] != 0 else c.taken[i]
    return 1.0


@exact()
def let_rows_slide(c: Choice, n: int, w: Array, part: float) -> int:
    """Find the forces at rest, where rows that their static bounds do not hold have sliding bounds.

    ``option`` is 1 for the rows let go. Returns `SAME`, or why there are no forces.
    """
    box = c.box
    while True:
        code = solve_within(c, n, part)
        if code != SAME:
            return int(code)
        for r in range(n):
            if c.rows.pushes[c.rest[r]] != 0 and box.left[r] < -NO_ACCELERATION * usual_of(c, w, c.rest[r]):
                if is_contrary(n, r, box):
                    return CONTRARY
        again = False
        for r in range(n):
            i = c.rest[r]
            if moves_at(c, n, r):
                if c.rows.pushes[i] == 0 and c.taken[i] != 0 and c.read.static[i] > c.read.sliding[i]:
                    c.taken[i], c.option[i], again = 0, 1, True
                if c.rows.pushes[i] != 0 and c.loose[i] != 0 and box.left[r] < -NO_ACCELERATION * usual_of(c, w, i):
                    c.loose[i], again = 0, True
        if not again:
            return SAME
        part = 1.0


@exact()
def part_held(c: Choice, n: int, i: int, w: Array) -> float:
    """Return the part of its static bound that a row let go needs if it holds again, inf where it does not hold."""
    box, needs = c.box, math.inf
    c.taken[i] = 1
    holds = solve_within(c, n, 1.0) == SAME
    for r in range(n):
        j = c.rest[r]
        if c.rows.pushes[j] != 0:
            holds = holds and not box.left[r] < -NO_ACCELERATION * usual_of(c, w, j)
        elif c.taken[j] != 0 and c.read.static[j] > c.read.sliding[j]:
            holds = holds and not moves_at(c, n, r)
        if j == i:
            bound = 0.5 * (box.bounds[r] - box.lower[r])
            needs = abs(box.forces[r] - 0.5 * (box.bounds[r] + box.lower[r])) / bound if bound > 0.0 else math.inf
    c.taken[i] = 0
    return needs if holds and needs < AT_BOUND else math.inf


@exact()
def hold_again(c: Choice, n: int, w: Array) -> int:
    """Have rows hold again that were let go beside forces of modes which are given up; return `SAME`, or a code.

    A row that reaches its static bound beside the static force of another one has been judged by a force that is not
    there once the other one slides. Which of several holds follows from the state alone: the one that needs the least
    part of its bound.
    """
    again = False
    while True:
        best, least, count = -1, math.inf, 0
        for r in range(n):
            count += c.option[c.rest[r]]
        for r in range(n):
            i = c.rest[r]
            if c.option[i] != 0 and (again or count > 1):  # one alone has been judged by what is there
                needs = part_held(c, n, i, w)
                if needs < (1.0 - ROUNDED) * least:
                    best, least = i, needs
        if best < 0:
            break
        c.taken[best], c.option[best], again = 1, 0, True
    return int(solve_within(c, n, 1.0)) if again or count > 1 else SAME


@exact()
def solve_rest(c: Choice, n: int, w: Array) -> int:
    """Find the forces at rest, and the signs of rows that they do not hold; return `SAME`, or why there are none."""
    k, box = c.rows.count, c.box
    for r in range(n):
        i = c.rest[r]
        box.offset[r] = c.problem.offset[i]
        for s in range(n):
            box.offset[r] += c.problem.matrix[i * k + c.rest[s]] * c.read.middle[c.rest[s]]
        c.taken[i] = 1 if c.rows.pushes[i] == 0 and c.loose[i] == 0 else 0  # its static bound holds
        c.option[i] = 0
        for s in range(n):
            box.matrix[r * n + s] = c.problem.matrix[i * k + c.rest[s]]
    code = let_rows_slide(c, n, w, share_anew(c, n))
    if code == SAME:
        code = hold_again(c, n, w)
    if code != SAME:
        return int(code)
    for r in range(n):
        i = c.rest[r]
        bound, force, moves = box.bounds[r], box.forces[r], moves_at(c, n, r)
        c.passing[i] = 1 if moves else 0
        if c.rows.pushes[i] != 0:
            moves = moves and box.left[r] > 0.0
        elif c.loose[i] != 0 and abs(force) >= AT_BOUND * bound and bound > 0.0:
            moves = True
        c.forces[i] = force - c.read.middle[i]
        c.signs[i] = 0.0
        if moves:
            c.signs[i] = sign_of_number(box.left[r] if force == 0.0 or c.rows.pushes[i] != 0 else force)
        c.taken[i] = 0
    return SAME
