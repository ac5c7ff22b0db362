"""The choice of modes at one state, compiled: rows at rest, their forces, and which of them are put into force.

A coordinate at rest stays so as long as a force within its bounds keeps it. Static bounds hold for coordinates that
come to rest, those in motion for coordinates that have just broken loose; a coordinate that its static bound does not
hold breaks loose too, and has its sliding force before others at rest are let go for good. A gap stays closed by a
force that pushes; ones that strike have impacts first (`symgen.run.modes.strikes`). A contact is a gap N and the
row T along it, ``|T| <= mu N``: closed, it opens, sticks, or slides one of two ways; in motion the way is known.

Rows that depend on each other are a part (`symgen.run.modes.contact_parts`), whose laws are solved together
(`symgen.run.modes.contact_laws`). Rows at rest that other ones determine stay off: the rows in force carry their part.
Where more rows rest than the mechanism has freedom, others keep the efforts that they have until one is at its bound;
as any forces within all bounds hold, efforts are then shared out anew: those whose largest part of a static bound is
least.
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.pushing import PAIRED, REACTIONS
from symgen.run.laws.problem import LOADS, LOWER, OFF, ON, UPPER
from symgen.run.laws.sharing import STILL
from symgen.run.modes.bounded_rows import (
    AT_BOUND,
    JAMMED,
    NOT_FINITE,
    OTHERS,
    REDUNDANT,
    ROUNDED,
    SAME,
    SIGN,
    sign_of_number,
)
from symgen.run.modes.choice import find_rest, write_modes
from symgen.run.modes.contact_laws import fill_part, find_forces_of_part, is_still, part_used, solve_by_laws
from symgen.run.modes.contact_parts import choose_part, find_parts, find_redundant, keep_touching, may_rest
from symgen.run.modes.holding import bound_at_rest, carry_force, hold_row, keep_force, set_holds, write_signs
from symgen.run.modes.paired_rows import find_direction, first_of, is_first, is_second, length_at, write_pair
from symgen.run.modes.probing import add_forces, by_reaction, probe, size_forces_of_parts
from symgen.run.modes.row_records import Choice

#: Rows are at their bounds beyond this part; number of halvings in which the least part is found.
SPENT, HALVINGS = 1.0 - 1e-11, 30


@exact()
def breaks(c: Choice, i: int) -> bool:
    """Return whether the bound at rest of a row does not hold it, in the modes found, and that in motion is less."""
    moves = c.rows.pushes[i] == 0 and c.best[i] >= UPPER and c.signs[i] == 0.0
    return bool(moves and c.loose[i] == 0 and c.read.static[i] > c.read.sliding[i])


@exact()
def solve_part(c: Choice, count: int, first: int, part: float) -> int:
    """Find the modes of a part with the bounds of now, or a part of those at rest; return `SAME` or a code."""
    for a in range(count):
        c.part[c.order[a]] = first
    return int(solve_by_laws(c, count, part))


@exact()
def static_bound(c: Choice, i: int) -> float:
    """Return the bound at rest of a row by the forces found."""
    presses = abs(c.forces[c.rows.partner[i]]) if c.rows.partner[i] >= 0 else 1.0
    return float(bound_at_rest(c, i) * presses)


@exact()
def part_held(c: Choice, count: int, first: int, i: int) -> float:
    """Return the part of its bound at rest that a row let go needs if it holds again, inf where it does not hold."""
    second = PAIRED and is_first(c, i)
    c.loose[i] = 0
    if second:
        c.loose[i + 1] = 0
    holds = solve_part(c, count, first, 1.0) == SAME
    for a in range(count):
        holds = holds and not breaks(c, c.order[a])
    most = static_bound(c, i)
    needs = (
        (length_at(c, c.forces, i) if PAIRED else abs(c.forces[i])) / most
        if holds and c.best[i] == ON and most > 0.0
        else math.inf
    )
    c.loose[i] = 1
    if second:
        c.loose[i + 1] = 1
    return needs if needs < AT_BOUND else math.inf


@exact()
def hold_again(c: Choice, count: int, first: int) -> int:
    """Have rows hold again that were let go beside forces of modes which are given up; return `SAME`, or a code.

    A row that reaches its static bound beside the static force of another one has been judged by a force that is not
    there once the other one slides. Which of several holds follows from the state alone: the one that needs the least
    part of its bound. ``passing`` is 1 for rows let go.
    """
    again = False
    while True:
        best, least, released = -1, math.inf, 0
        for a in range(count):
            released += 0 if PAIRED and is_second(c, c.order[a]) else c.passing[c.order[a]]
        for a in range(count):
            i = c.order[a]
            if c.passing[i] != 0 and (again or released > 1) and not (PAIRED and is_second(c, i)):
                needs = part_held(c, count, first, i)
                if needs < (1.0 - ROUNDED) * least:
                    best, least = i, needs
        if best < 0:
            break
        c.loose[best], c.passing[best], again = 0, 0, True
        if PAIRED and is_first(c, best):
            c.loose[best + 1] = c.passing[best + 1] = 0
    return solve_part(c, count, first, 1.0) if again or released > 1 else SAME


@exact()
def leaves_its_bound(c: Choice, count: int, a: int) -> bool:
    """Return whether a row with a bound at rest moves by the forces found, or has more than its bound."""
    i = c.order[a]
    if c.rows.pushes[i] != 0 or c.rows.partner[i] >= 0 or c.loose[i] != 0 or c.signs[i] != 0.0:
        return False
    if c.laws.state[a] != ON and not is_still(c, count, a, STILL):
        return True
    return bool(part_used(c, count, a) * SPENT > 1.0)


@exact()
def rests_within(c: Choice, count: int, part: float) -> bool:
    """Whether all rows with bounds at rest rest by forces within a part of these."""
    fill_part(c, count, part)
    if not find_forces_of_part(c, count):
        return False
    for a in range(count):
        if leaves_its_bound(c, count, a):
            return False
    return True


@exact()
def hold_by_others(c: Choice, count: int) -> float:
    """Return the least part of static bounds within which rows at theirs rest by other forces of those that share them.

    Where there is none the part is 1, and all that are at their bounds are loose.
    """
    low, high, part, tried = 0.0, SPENT, 1.0, False
    for a in range(count):
        i = c.order[a]
        rested = c.rows.pushes[i] == 0 and c.rows.partner[i] < 0 and c.before[MODE_NUMBERS * i + SIGN] == 0.0
        c.passing[i] = 1 if rested and c.loose[i] != 0 else 0
        c.loose[i], tried = 0 if c.passing[i] != 0 else c.loose[i], tried or c.passing[i] != 0
    if tried and rests_within(c, count, SPENT):
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if rests_within(c, count, middle):
                high = middle
            else:
                low = middle
        part = high
    for a in range(count):
        i = c.order[a]
        if tried and part == 1.0 and c.rows.pushes[i] == 0 and c.rows.partner[i] < 0 and c.signs[i] == 0.0:
            c.loose[i] = 1 if c.passing[i] != 0 or part_used(c, count, a) >= AT_BOUND else c.loose[i]
        c.passing[i] = 0
    return part


@exact()
def choose_modes_of_part(c: Choice, count: int, first: int) -> int:
    """Choose the modes of a part: a row that its bound at rest does not hold has that in motion."""
    again, part = True, hold_by_others(c, count)
    while again:
        code = solve_part(c, count, first, part)
        if code != SAME:
            return int(code)
        again = False
        for a in range(count):
            i = c.order[a]
            if breaks(c, i):
                c.loose[i], c.passing[i], again, part = 1, 1, True, 1.0
    return int(hold_again(c, count, first))


@exact()
def write_part(c: Choice, count: int) -> None:
    """Write the modes of a part."""
    for a in range(count):
        i = c.order[a]
        c.holds[i] = bound_at_rest(c, i)
        if c.best[i] == ON and c.part[i] < 0:
            hold_row(c, i)
        elif c.best[i] == ON and c.part[i] < c.rows.count and c.rows.pushes[i] == 0:
            carry_force(c, i, c.part[i], c.factors[i])
        elif c.best[i] == ON:
            keep_force(c, i)
        begins = PAIRED and c.best[i] == UPPER and c.signs[i] == 0.0
        if PAIRED and is_first(c, first_of(c, i)):
            c.signs[i] = find_direction(c, i) if begins else c.signs[i] if c.best[i] == UPPER else 0.0
        else:
            c.signs[i] = 1.0 if c.best[i] == UPPER else (-1.0 if c.best[i] == LOWER else 0.0)
        if PAIRED and is_second(c, i):  # after both have been written
            write_pair(c, i - 1, begins)
        # a rate that only passes zero, as at a dead centre
        if c.best[i] == OFF and c.rows.pushes[i] == 0 and c.rows.partner[i] < 0:
            c.signs[i] = sign_of_number(c.trial[i])


@exact()
def choose_parts(c: Choice, rows: int) -> int:
    """Choose the modes of all parts; return `SAME` or a code."""
    for first in range(c.rows.count):
        count = choose_part(c, first, rows)
        if may_rest(c, count):
            code = choose_modes_of_part(c, count, first)
            if code != SAME:
                return int(code)
            write_part(c, count)
            for a in range(count):
                c.part[c.order[a]] = c.rows.count
    return SAME


@exact()
def find_jammed(c: Choice) -> bool:
    """Return whether an effort by a reaction would bring about all of it, alone; name the row."""
    for i in range(c.rows.dry):
        if by_reaction(c, i):
            bound, at = c.read.sliding[i] if c.signs[i] != 0.0 else c.read.static[i], 2 * i * c.rows.count + i
            x, y = c.problem.parts[at], c.problem.parts[at + c.rows.count]
            c.jam[0] = bound * math.sqrt(x * x + y * y)
            if not c.jam[0] < 1.0:
                c.named[0] = i
                return True
    return False


@exact(entry=True)
def choose_modes(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Choose the modes of a state whose rows have been read; return `SAME`, `OTHERS`, or why there are none."""
    n, code, struck = find_rest(c, w), SAME, False
    if LOADS:
        n = keep_touching(c, n)
    if REACTIONS:
        c.named[0] = find_redundant(c, w)
        if c.named[0] >= 0:
            return REDUNDANT
    if n > 0 or REACTIONS:
        if probe(t, c, y, p, w, iw, control) != SAME:
            return NOT_FINITE
        if REACTIONS and find_jammed(c):
            return JAMMED
        rows = find_parts(c)
        size_forces_of_parts(c, rows)
        code = choose_parts(c, rows)
        if code != SAME:
            return int(code)
    set_holds(c)
    write_signs(c)
    add_forces(c)
    for i in range(c.rows.count):
        struck = struck or c.shut[i] != 0
        c.shut[i] = 0
    code = write_modes(c, w)
    # an impact has taken all rows out of force, and where none comes back there are others all the same
    return int(OTHERS) if struck else int(code)
