"""Mobility among closed contacts and their friction, compiled, and the parts of it that do not depend on each other.

G has the accelerations of rows by the forces of others. Rows at rest that G connects are one part, of which the modes
are chosen together. Where bounds depend on reactions, a probe reads these as well, and rows are one part by their loads
too.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array
from symgen.run.laws.problem import LOADS
from symgen.run.layout.redundancy import is_off
from symgen.run.modes.probing import by_reaction
from symgen.run.modes.row_records import Choice

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
        j = c.rows.partner[i]
        if c.rows.pushes[i] == 0 and j >= 0 and c.taken[j] == 0:
            c.taken[i] = 0
        else:
            c.rest[count] = i
            count += 1
    for i in range(c.rows.dry):
        j = c.rows.partner[i]
        if j >= 0 and c.taken[j] == 0:
            c.signs[i] = 0.0
    c.at_rest[0] = count
    return count


@exact()
def is_load(c: Choice, i: int, j: int) -> bool:
    """Return whether the bound of a row depends on the force of another one."""
    if LOADS and c.rows.partner[i] == j:
        return True
    at = 2 * i * c.rows.count + j
    return bool(by_reaction(c, i) and (c.problem.parts[at] != 0.0 or c.problem.parts[at + c.rows.count] != 0.0))


@exact()
def find_parts(c: Choice) -> int:
    """Set the parts of G among the rows of ``rest``, as the least row of each; return the number of rows."""
    k, n, again = c.rows.count, c.at_rest[0], True
    for r in range(n):
        c.part[c.rest[r]] = c.rest[r]
    while again:
        again = False
        for a in range(n):
            for b in range(n):
                i, j = c.rest[a], c.rest[b]
                size = math.sqrt(abs(c.problem.matrix[i * k + i] * c.problem.matrix[j * k + j]))
                tied = is_load(c, i, j) or is_load(c, j, i) or abs(c.problem.matrix[i * k + j]) > COUPLED * size
                if tied and c.part[j] < c.part[i]:
                    c.part[i], again = c.part[j], True
    return int(n)


@exact()
def choose_part(c: Choice, part: int, rows: int) -> int:
    """Set the rows of a part in the order of ``order``; return their number."""
    count = 0
    for r in range(rows):
        i = c.rest[r]
        if c.part[i] == part:
            c.order[count] = i
            count += 1
    return int(count)


@exact()
def has_reaction(c: Choice, count: int) -> bool:
    """Return whether bounds of a part depend on reactions."""
    for a in range(count):
        if by_reaction(c, c.order[a]):
            return True
    return False


@exact()
def may_rest(c: Choice, count: int) -> bool:
    """Return whether any row of a part may rest."""
    for a in range(count):
        if c.rows.pushes[c.order[a]] != 0 or c.signs[c.order[a]] == 0.0:
            return True
    return False


@exact()
def reaches_reactions(c: Choice, row: int, w: Array) -> bool:
    """Return whether a row is tied, by rows in force, to a coordinate whose bounds depend on a reaction.

    Rows with bounds count as in force; coordinates and rows found are marked in ``rate`` and in the scratch.
    """
    entries, again = c.rows.layout.entries, True
    for j in range(c.rows.layout.nv):
        c.rate[j] = 0.0
    for i in range(c.rows.layout.m):
        c.w[i] = 1.0 if i == row else 0.0
    while again:
        again = False
        for e in range(entries.shape[0] // 3):
            i, j = entries[3 * e], entries[3 * e + 1]
            if c.rows.place_of[i] >= 0 or not is_off(c.rows.layout, i, w):
                if c.w[i] != c.rate[j]:
                    c.w[i], c.rate[j], again = 1.0, 1.0, True
    for i in range(c.rows.layout.m):
        if c.w[i] != 0.0 and c.rows.place_of[i] >= 0 and c.rows.pressed[c.rows.place_of[i]] != 0:
            return True
    return False


@exact(entry=True)
def find_redundant(c: Choice, w: Array) -> int:
    """Return the first row left out that has no bounds and leaves such reactions undetermined, -1 for none."""
    for i in range(c.rows.layout.m):
        if w[c.rows.layout.mask + i] != 0.0 and c.rows.place_of[i] < 0 and reaches_reactions(c, i, w):
            return int(i)
    return -1
