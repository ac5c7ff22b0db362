"""Rows at rest that are put into force, compiled: independent ones, which carry the forces of all others."""

from __future__ import annotations

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array
from symgen.run.layout.scales import larger_number
from symgen.run.modes.bounded_rows import (
    AT_BOUND,
    AT_REST,
    CONSTANT,
    DEPENDENT,
    EFFORT,
    HELD,
    LIMIT,
    NO_ACCELERATION,
    NO_FACTOR,
    ROUNDED,
    SIGN,
    usual_of,
)
from symgen.run.modes.box import independent_set, solve_independent
from symgen.run.modes.probing import by_reaction
from symgen.run.modes.row_records import Choice

#: Rows at rest that are put into force: see `take_rows`.
PUSHING, WITHIN, ALL = range(3)
#: Rows of which equal parts are independent, up to this part, hold one coordinate.
_LEVEL = 1e-6


@exact()
def undetermined_part(c: Choice, i: int) -> float:
    """Return the part of a row at rest that rows put into force do not determine."""
    return float(c.rest_of[i * c.rows.count + i] / c.problem.alone[i]) if c.problem.alone[i] > 0.0 else 0.0


@exact()
def is_followed(c: Choice, i: int) -> bool:
    """Return whether margins read the bound of a row, as it varies; that by a reaction has a limit besides."""
    return bool(c.rows.varying[i] != 0 and c.rows.pressed[i] == 0)


@exact()
def take_rows(c: Choice, n: int, which: int, w: Array) -> None:
    """Put the most independent rows at rest into force, one after the other.

    `which` is `PUSHING` for one-sided rows that push, `WITHIN` for others whose force is within its bounds, else `ALL`.
    """
    k, left = c.rows.count, c.rest_of
    while True:
        best, most = -1, 0.0
        for r in range(n):
            i = c.rest[r]
            free = c.taken[i] == 0 and c.signs[i] == 0.0 and not (c.rows.pushes[i] != 0 and c.loose[i] != 0)
            if which == WITHIN:
                free = free and (c.rows.pushes[i] != 0 or abs(c.forces[i]) < AT_BOUND * c.holds[i])
            elif which == PUSHING:
                free = free and c.rows.pushes[i] != 0
                free = free and -c.forces[i] * c.problem.matrix[i * k + i] > NO_ACCELERATION * usual_of(c, w, i)
            part = undetermined_part(c, i)
            # of rows with one and two bounds on one coordinate the former carries both: one force with all bounds
            first = best < 0 or part > (1.0 + _LEVEL) * most or (c.rows.pushes[i] != 0 and part > (1.0 - _LEVEL) * most)
            if free and part > DEPENDENT and first:
                best, most = i, part
        if best < 0:
            break
        c.taken[best] = 1
        pivot = left[best * k + best]
        for i in range(k):
            c.trial[i], c.box.right[i] = left[i * k + best], left[best * k + i]
        for i in range(k):
            for j in range(k):
                left[i * k + j] -= c.trial[i] * c.box.right[j] / pivot


@exact()
def bound_at_rest(c: Choice, i: int) -> float:
    """Return the bound at rest of a row as a force, of contacts for each unit of the force that presses."""
    return float(c.read.static[i] * (c.sizes[i] if by_reaction(c, i) else 1.0))


@exact()
def set_holds(c: Choice) -> None:
    """Set the bounds at rest as forces."""
    for i in range(c.rows.count):
        c.holds[i] = bound_at_rest(c, i)


@exact()
def write_signs(c: Choice) -> None:
    """Write the signs of rates to the modes."""
    for i in range(c.rows.count):
        c.after[MODE_NUMBERS * i + SIGN] = 0.0 if c.rows.pushes[i] != 0 else c.signs[i]


@exact(entry=True)
def hold_rows(c: Choice, w: Array) -> int:
    """Put independent rows among those at rest into force; set their constants and largest efforts.

    Bounds that vary are no numbers: margins read them, times the largest effort of a row that another one carries.

    Rows that push come first: a coordinate that they keep at rest does not slide. One whose rate only passes zero, at
    a dead centre, does. Returns the number of rows in force.
    """
    k, n = c.rows.count, c.at_rest[0]
    for i in range(k * k):
        c.rest_of[i] = c.problem.matrix[i]
    set_holds(c)
    kept = 0
    for r in range(n):
        i = c.rest[r]
        if c.problem.matrix[i * k + i] > DEPENDENT * c.problem.alone[i] or c.signs[i] == 0.0:
            c.rest[kept] = i
            kept += 1
    take_rows(c, kept, PUSHING, w)
    for r in range(kept):
        i = c.rest[r]
        if c.rows.pushes[i] == 0 and c.passing[i] == 0 and undetermined_part(c, i) <= DEPENDENT:
            c.signs[i] = 0.0
    take_rows(c, kept, WITHIN, w)
    take_rows(c, kept, ALL, w)
    count = 0
    for i in range(k):
        if c.taken[i] != 0:
            count += 1
            hold_row(c, i)
    for r in range(kept):
        i = c.rest[r]
        other = c.taken[i] == 0 and c.signs[i] == 0.0 and c.problem.matrix[i * k + i] > DEPENDENT * c.problem.alone[i]
        if other and not (c.rows.pushes[i] != 0 and undetermined_part(c, i) > DEPENDENT):
            share_force(c, i, count)
    write_signs(c)
    return int(count)


@exact()
def find_carriers(c: Choice, i: int, count: int) -> float:
    """Write what each row in force carries of a unit of force of another row at rest to ``box.left``.

    Returns the largest size; parts below `NO_FACTOR` of this are rounding.
    """
    k, box = c.rows.count, c.box
    a = 0
    for j in range(k):
        if c.taken[j] != 0:
            box.offset[a] = c.problem.matrix[j * k + i]
            b = 0
            for other in range(k):
                if c.taken[other] != 0:
                    box.matrix[a * count + b] = c.problem.matrix[j * k + other]
                    b += 1
            a += 1
    for j in range(count):
        box.order[j] = j
    rank, most = independent_set(count, count, box), 0.0
    for j in range(rank):
        box.right[j] = box.offset[box.order[j]]
    solve_independent(count, rank, box)
    for j in range(count):
        box.left[j] = 0.0
    for j in range(rank):
        box.left[box.order[j]] = box.right[j]
        most = larger_number(most, abs(box.right[j]))
    return float(most)


@exact()
def share_force(c: Choice, i: int, count: int) -> None:
    """Give the effort of a row that rows in force determine to the one that carries it.

    Where several do, a row with two bounds keeps the effort that it has: as long as theirs are within their bounds all
    rest, and where one reaches its bound, efforts are shared out anew.
    """
    most = find_carriers(c, i, count)
    owners, owner, a, factor = 0, -1, 0, 0.0
    for j in range(c.rows.count):
        if c.taken[j] != 0:
            if abs(c.box.left[a]) > NO_FACTOR * most:
                owners += 1
                owner, factor = j, abs(c.box.left[a])
            a += 1
    if owners == 1 and c.rows.pushes[i] == 0:
        carry_force(c, i, owner, factor)
    else:
        keep_force(c, i)


@exact()
def hold_row(c: Choice, i: int) -> None:
    """Put a row into force. Of bounds that margins read, the number ``limit`` has nothing."""
    at, read = MODE_NUMBERS * i, c.rows.pushes[i] != 0 or c.rows.partner[i] >= 0 or by_reaction(c, i)
    c.after[at + HELD] = 1.0
    c.after[at + CONSTANT] = c.before[at + CONSTANT] if c.before[at + HELD] != 0.0 else c.read.value[i]
    c.after[at + LIMIT] += 0.0 if read or is_followed(c, i) else c.holds[i]


@exact()
def carry_force(c: Choice, i: int, owner: int, factor: float) -> None:
    """Have row `owner` carry the force of row `i`: `factor` of its own for each unit."""
    c.after[MODE_NUMBERS * i + CONSTANT] = float(owner + 1)
    if c.rows.partner[i] >= 0 or is_followed(c, i):
        c.after[MODE_NUMBERS * i + LIMIT] = factor
    else:
        c.after[MODE_NUMBERS * owner + LIMIT] += abs(factor) * c.holds[i]


@exact()
def keep_force(c: Choice, i: int) -> None:
    """Have a row at rest keep its force. One at its bound is not watched at zero, and none is not watched."""
    at = MODE_NUMBERS * i
    c.after[at + CONSTANT], c.after[at + LIMIT] = AT_REST, 1.0
    if c.rows.pushes[i] == 0:
        slack = 0.1 * ROUNDED * (c.problem.scale[i] + abs(c.forces[i]) + c.holds[i])
        c.after[at + EFFORT] = c.forces[i]
        c.after[at + LIMIT] = slack if abs(c.forces[i]) > slack else 1.0
