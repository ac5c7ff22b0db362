"""The choice of modes at one state of a run with contacts, compiled.

A contact is a one-sided row N and the friction T along it, ``|T| <= mu N``. Each closed contact opens, sticks, or
slides one of two ways; in motion the way is known. Rows that depend on each other are a part
(`symgen.run.modes.contact_parts`), whose laws are solved together (`symgen.run.modes.contact_laws`), with bounds by
reactions too. Parts without either are left to `symgen.run.modes.resting`. The same laws on rates are those of an
impact (`symgen.run.modes.contact_impacts`).
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.pushing import PAIRED, REACTIONS
from symgen.run.laws.problem import LOWER, OFF, ON, UPPER
from symgen.run.laws.sharing import STILL
from symgen.run.layout import abi
from symgen.run.loops.search_records import COUNT, MARGIN, MEASURE, N_HEAD, RATE, ROW
from symgen.run.modes.bounded_rows import (
    AT_BOUND,
    HELD,
    JAMMED,
    NOT_FINITE,
    OTHERS,
    REDUNDANT,
    ROUNDED,
    SAME,
    SIGN,
    row_scale,
    sign_of_number,
)
from symgen.run.modes.choice import find_rest, write_modes
from symgen.run.modes.choice import measure_margins as measure_margins_of_rows
from symgen.run.modes.contact_laws import fill_part, find_forces_of_part, is_still, part_used, solve_by_laws
from symgen.run.modes.contact_parts import PLAIN, choose_part, find_parts, find_redundant, has_loads, keep_touching
from symgen.run.modes.holding import bound_at_rest, carry_force, hold_row, hold_rows, keep_force, set_holds, write_signs
from symgen.run.modes.paired_rows import find_direction, first_of, is_first, is_second, length_at, write_pair
from symgen.run.modes.probing import add_forces, by_reaction, probe_contacts, size_forces_of_parts
from symgen.run.modes.resting import HALVINGS, SPENT, solve_rest
from symgen.run.modes.row_records import Choice


@exact()
def breaks(c: Choice, i: int) -> bool:
    """Return whether the bound at rest of a row does not hold it, in the modes found, and that in motion is less."""
    moves = c.rows.pushes[i] == 0 and c.best[i] >= UPPER and c.signs[i] == 0.0
    return bool(moves and c.loose[i] == 0 and c.read.static[i] > c.read.sliding[i])


@exact()
def solve_part(c: Choice, count: int, first: int, part: float) -> int:
    """Find the modes of a part with the bounds of now, or a part of those at rest; return `SAME` or a code."""
    for a in range(count):
        c.part[c.box.order[a]] = first
    return int(solve_by_laws(c, count, part))


@exact()
def static_bound(c: Choice, i: int) -> float:
    """Return the bound at rest of a row by the forces found."""
    presses = abs(c.forces[c.rows.partner[i]]) if c.rows.partner[i] >= 0 else 1.0
    return float(bound_at_rest(c, i) * presses)


@exact()
def part_held(c: Choice, count: int, first: int, i: int) -> float:
    """Return the part of its bound at rest that friction let go needs if it holds again, inf where it does not hold."""
    second = PAIRED and is_first(c, i)
    c.loose[i] = 0
    if second:
        c.loose[i + 1] = 0
    holds = solve_part(c, count, first, 1.0) == SAME
    for a in range(count):
        holds = holds and not breaks(c, c.box.order[a])
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
    """Do what `symgen.run.modes.resting.hold_again` does, in a part with contacts; ``passing`` is 1 for rows let go."""
    again = False
    while True:
        best, least, released = -1, math.inf, 0
        for a in range(count):
            released += 0 if PAIRED and is_second(c, c.box.order[a]) else c.passing[c.box.order[a]]
        for a in range(count):
            i = c.box.order[a]
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
    i = c.box.order[a]
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
        i = c.box.order[a]
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
        i = c.box.order[a]
        if tried and part == 1.0 and c.rows.pushes[i] == 0 and c.rows.partner[i] < 0 and c.signs[i] == 0.0:
            c.loose[i] = 1 if c.passing[i] != 0 or part_used(c, count, a) >= AT_BOUND else c.loose[i]
        c.passing[i] = 0
    return part


@exact()
def choose_modes_of_part(c: Choice, count: int, first: int) -> int:
    """Choose the modes of a part with contacts: friction that its bound at rest does not hold has that in motion."""
    again, part = True, hold_by_others(c, count)
    while again:
        code = solve_part(c, count, first, part)
        if code != SAME:
            return int(code)
        again = False
        for a in range(count):
            i = c.box.order[a]
            if breaks(c, i):
                c.loose[i], c.passing[i], again, part = 1, 1, True, 1.0
    return int(hold_again(c, count, first))


@exact()
def write_part(c: Choice, count: int) -> None:
    """Write the modes of a part."""
    for a in range(count):
        i = c.box.order[a]
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
    """Choose the modes of parts whose bounds depend on forces, and leave others; return `SAME` or a code."""
    for first in range(c.rows.count):
        count = choose_part(c, first, rows)
        if has_loads(c, count):
            code = choose_modes_of_part(c, count, first)
            if code != SAME:
                return int(code)
            for a in range(count):
                c.taken[c.box.order[a]] = 2
            write_part(c, count)
            for a in range(count):
                c.part[c.box.order[a]] = c.rows.count
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
def choose_contacts(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Choose modes as `symgen.run.modes.choice.choose_modes` does, where there are contacts.

    Returns `SAME`, `OTHERS`, or why there are no modes.
    """
    n, code, rows, left, struck = keep_touching(c, find_rest(c, w)), SAME, 0, 0, False
    if REACTIONS:
        c.named[0] = find_redundant(c, w)
        if c.named[0] >= 0:
            return REDUNDANT
    if n > 0 or REACTIONS:
        if probe_contacts(t, c, y, p, w, iw, control) != SAME:
            return NOT_FINITE
        if REACTIONS and find_jammed(c):
            return JAMMED
        rows = find_parts(c)
        size_forces_of_parts(c, rows)
        code = choose_parts(c, rows)
        if code != SAME:
            return int(code)
    if PLAIN:
        for r in range(n):
            if c.taken[c.rest[r]] != 2:
                c.rest[left] = c.rest[r]
                left += 1
        c.at_rest[0] = left
        for i in range(c.rows.count):
            c.taken[i] = 0
        if left > 0:
            code = solve_rest(c, left, w)
            if code != SAME:
                return int(code)
        hold_rows(c, w)
    else:
        set_holds(c)
        write_signs(c)
    add_forces(c)
    for i in range(c.rows.count):
        struck = struck or c.shut[i] != 0
        c.shut[i] = 0
    code = write_modes(c, w)
    # an impact has taken all rows out of force, and where none comes back there are others all the same
    return int(OTHERS) if struck else int(code)


@exact(entry=True)
def measure_margins_of_contacts(c: Choice, w: Array, hunt: Array) -> int:
    """Do what `symgen.run.modes.choice.measure_margins` does; friction at rest that others carry is watched as well.

    A drive may move it, though the rows in force stay at rest.
    """
    n, at, found = int(hunt[COUNT]), N_HEAD, measure_margins_of_rows(c, w, hunt)
    for k in range(n):
        i = int(hunt[at + ROW * n + k])
        numbers = c.rows.first + MODE_NUMBERS * i
        still = w[numbers + HELD] == 0.0 and w[numbers + SIGN] == 0.0
        if PAIRED and is_first(c, i):  # watched as long as one of both rows is not in force
            still = still or (w[numbers + MODE_NUMBERS + HELD] == 0.0 and w[numbers + SIGN] == 0.0)
        if hunt[at + MARGIN * n + k] == float(RATE) and c.rows.pushes[i] == 0 and c.rows.partner[i] >= 0 and still:
            hunt[at + MEASURE * n + k] = row_scale(c, w, i, abi.SPEED)
    return int(found)
