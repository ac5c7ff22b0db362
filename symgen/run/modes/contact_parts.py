"""Mobility among closed contacts and their friction, compiled, and the parts of it that do not depend on each other.

G has the accelerations of rows by the forces of others. Rows at rest that G connects are one part, of which the modes
are chosen together; a part without contacts is a box problem, see `symgen.run.modes.choice`. Where bounds depend on
reactions, a probe reads these as well, and rows are one part by their loads too.
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.pushing import REACTIONS
from symgen.run.layout.scales import larger_number
from symgen.run.modes.bounded_rows import (
    CONSTANT,
    EFFORT,
    HELD,
    LIMIT,
    NOT_FINITE,
    SAME,
    SIGN,
    Choice,
    usual_of,
)
from symgen.run.modes.choice import copy_state, find_mobility, measure_accelerations, size_forces, symmetrise

#: Rows depend on each other above this part of their own mobilities.
COUPLED = 1e-12


@exact()
def keep_touching(c: Choice, n: int) -> int:
    """Leave the friction of open contacts out of the rows at rest, and their signs; return the number at rest."""
    for r in range(n):
        c.taken[c.rest[r]] = 1
    count = 0
    for r in range(n):
        i = c.rest[r]
        j = c.partner[i]
        if c.pushes[i] == 0 and j >= 0 and c.taken[j] == 0:
            c.taken[i] = 0
        else:
            c.rest[count] = i
            count += 1
    for i in range(c.dry):
        j = c.partner[i]
        if j >= 0 and c.taken[j] == 0:
            c.signs[i] = 0.0
    c.at_rest[0] = count
    return count


@exact()
def accelerate_by(
    t: float, c: Choice, j: int, force: float, y: Array, p: Array, w: Array, iw: Integers, control: Integers
) -> int:
    """Write the accelerations of coordinates with all rows off, and a force of ``-force`` at row j, if any, to ``out``.

    Dry friction without a contact has its sign; that of contacts has none.
    """
    copy_state(c, y, w, iw)
    for i in range(c.count):
        at = c.first + MODE_NUMBERS * i
        c.w[at + HELD] = c.w[at + CONSTANT] = c.w[at + LIMIT] = c.w[at + EFFORT] = 0.0
        c.w[at + SIGN] = c.signs[i] if c.pushes[i] == 0 and c.partner[i] < 0 and not by_reaction(c, i) else 0.0
    if j < c.count:
        at = c.first + MODE_NUMBERS * j
        if c.pushes[j] != 0:
            c.w[at + SIGN] = -force
        else:
            c.w[at + EFFORT] = force
    return int(measure_accelerations(t, c, p, control))


@exact()
def by_reaction(c: Choice, i: int) -> bool:
    """Return whether the bound of a row depends on the reaction of a joint."""
    return bool(REACTIONS and c.pressed[i] != 0)


@exact()
def store_columns(t: float, c: Choice, p: Array, number: int, force: float) -> None:
    """Store the accelerations of the last probe, and the reactions, without forces or by a unit of force `number`."""
    k, place = c.count, 0
    for i in range(k):
        if number < 0:
            c.offset[i] = c.out[i]
        else:
            c.matrix[i * k + number] = (c.offset[i] - c.out[i]) / force
    if REACTIONS:
        c.reactions(t, c.y, p, c.w, c.rate, c.out)
        for i in range(k):
            if c.pressed[i] != 0:
                for part in range(2):
                    if number < 0:
                        c.apart[2 * i + part] = c.out[place + part]
                    else:
                        change = c.apart[2 * i + part] - c.out[place + part]
                        c.parts[(2 * i + part) * k + number] = change / force
                place += 2


@exact()
def probe_contacts(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Set G of the rows at rest and of sliding friction by loads, and accelerations without these forces."""
    k, n = c.count, c.at_rest[0]
    for i in range(k * k):
        c.matrix[i] = 0.0
    if accelerate_by(t, c, k, 0.0, y, p, w, iw, control) != SAME:
        return NOT_FINITE
    store_columns(t, c, p, -1, 1.0)
    find_mobility(c)
    rows = n
    for i in range(c.dry):
        if (c.partner[i] >= 0 or by_reaction(c, i)) and c.signs[i] != 0.0 and c.taken[i] == 0:
            c.rest[rows] = i
            rows += 1
    most = 0.0  # accelerations as large as those that are there, of all rows: a row's own may be rounding of others'
    for r in range(rows):
        i = c.rest[r]
        if c.alone[i] > 0.0:
            most = larger_number(most, larger_number(abs(c.offset[i]), usual_of(c, w, i)) / math.sqrt(c.alone[i]))
    for r in range(rows):
        j, force = c.rest[r], 1.0
        if c.alone[j] > 0.0 and most > 0.0:
            force = most / math.sqrt(c.alone[j])
        if accelerate_by(t, c, j, force, y, p, w, iw, control) != SAME:
            return NOT_FINITE
        store_columns(t, c, p, j, force)
    c.at_rest[0] = rows
    symmetrise(c)
    size_forces(c, rows, w)
    return SAME


@exact()
def is_load(c: Choice, i: int, j: int) -> bool:
    """Return whether the bound of a row depends on the force of another one."""
    if c.partner[i] == j:
        return True
    at = 2 * i * c.count + j
    return bool(by_reaction(c, i) and (c.parts[at] != 0.0 or c.parts[at + c.count] != 0.0))


@exact()
def find_parts(c: Choice) -> int:
    """Set the parts of G among the rows of ``rest``, as the least row of each; return the number of rows."""
    k, n, again = c.count, c.at_rest[0], True
    for r in range(n):
        c.part[c.rest[r]] = c.rest[r]
    while again:
        again = False
        for a in range(n):
            for b in range(n):
                i, j = c.rest[a], c.rest[b]
                size = math.sqrt(abs(c.matrix[i * k + i] * c.matrix[j * k + j]))
                tied = is_load(c, i, j) or is_load(c, j, i) or abs(c.matrix[i * k + j]) > COUPLED * size
                if tied and c.part[j] < c.part[i]:
                    c.part[i], again = c.part[j], True
    return int(n)


@exact()
def size_forces_of_parts(c: Choice, rows: int) -> None:
    """Set the sizes of forces on gaps, of which any row of their part has a share, and of friction, which they press.

    What presses two discs that only touch is the rounding of what presses them to a floor.
    """
    k = c.count
    for r in range(rows):
        i = c.rest[r]
        own, most = c.matrix[i * k + i], 0.0
        for q in range(rows):
            j = c.rest[q]
            if c.part[j] == c.part[i]:
                most = larger_number(most, c.scale[j] * math.sqrt(c.matrix[j * k + j]))
        c.bounds[i] = most / math.sqrt(own) if own > 0.0 else 0.0
    for r in range(rows):
        i = c.rest[r]
        if c.pushes[i] != 0:
            c.scale[i] = c.bounds[i]
        elif c.partner[i] >= 0:  # the rounding of a bound is that of what presses
            c.scale[i] += c.static[i] * c.bounds[c.partner[i]]


@exact()
def choose_part(c: Choice, part: int, rows: int) -> int:
    """Set the rows of a part in the order of ``box``; return their number."""
    count = 0
    for r in range(rows):
        i = c.rest[r]
        if c.part[i] == part:
            c.box.order[count] = i
            count += 1
    return int(count)


@exact()
def has_contact(c: Choice, count: int) -> bool:
    """Return whether a part has a contact with friction."""
    for a in range(count):
        if c.partner[c.box.order[a]] >= 0:
            return True
    return False


@exact()
def has_reaction(c: Choice, count: int) -> bool:
    """Return whether bounds of a part depend on reactions."""
    for a in range(count):
        if by_reaction(c, c.box.order[a]):
            return True
    return False


@exact()
def has_both(c: Choice, count: int) -> bool:
    """Return whether a part has one-sided rows beside bounds that depend on reactions."""
    pushes = False
    for a in range(count):
        pushes = pushes or c.pushes[c.box.order[a]] != 0
    return bool(REACTIONS and pushes and has_reaction(c, count))
