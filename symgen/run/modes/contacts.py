"""Modes of contacts at one state, compiled: every combination is solved for, and verified.

A contact is a one-sided row N and the friction T along it, ``|T| <= mu N``. Each closed contact opens, sticks, or
slides one of two ways; in motion the way is known. In a combination the accelerations of some rows are 0 and forces at
bounds are multiples of others: a small linear system. It is right where its forces are within their bounds and
accelerations have the signs of its modes. Such a problem has no minimum, and may have no solution, or several: all are
sought.

Rows that do not depend on each other are parts, of which those without contacts are left to `symgen.run.modes.choice`.
The same combinations on rates are those of an impact (`symgen.run.modes.contact_impacts`).
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.scales import larger_number
from symgen.run.loops.search_records import COUNT, MARGIN, MEASURE, N_HEAD, RATE, ROW
from symgen.run.modes.bounded_rows import (
    AT_REST,
    CONSTANT,
    EFFORT,
    HELD,
    LIMIT,
    NO_CONTACT_MODES,
    NO_FACTOR,
    NO_FORCES,
    NOT_FINITE,
    ROUNDED,
    SAME,
    SEVERAL_MODES,
    SIGN,
    TOO_MANY,
    Choice,
    row_scale,
    usual_of,
)
from symgen.run.modes.choice import (
    add_forces,
    copy_state,
    find_mobility,
    find_rest,
    measure_margins,
    size_forces,
    solve_rest,
    symmetrise,
    write_modes,
    write_rates,
)
from symgen.run.modes.holding import hold_rows

#: Modes of rows in a combination: without force, in force, at the upper and at the lower bound.
OFF, ON, UPPER, LOWER = range(4)
#: Rounding of accelerations and forces over what they are differences of, and of those that are solved for.
_ROUNDING, _SOLVED = 1e-10, 1e-7
#: Pivots below this part of the diagonal are rounding.
_NO_PIVOT = 1e-11
#: Accelerations of two solutions that differ by less than this part are one.
_ONE = 1e-7
#: Rows depend on each other above this part of their own mobilities.
_COUPLED = 1e-12
#: Most contacts that depend on each other, and most rows of their part.
MOST_CONTACTS, _MOST_ROWS = 4, 10
#: Rounds in which forces that rows share come to equal parts of their bounds.
_SHARING = 30


@exact()
def keep_touching(c: Choice, n: int) -> int:
    """Leave the friction of open contacts out of the rows at rest, and their signs; return the number at rest."""
    for r in range(n):
        c.taken[c.rest[r]] = 1
    kept = 0
    for r in range(n):
        i = c.rest[r]
        j = c.partner[i]
        if c.pushes[i] == 0 and j >= 0 and c.taken[j] == 0:
            c.taken[i] = 0
        else:
            c.rest[kept] = i
            kept += 1
    for i in range(c.dry):
        j = c.partner[i]
        if j >= 0 and c.taken[j] == 0:
            c.signs[i] = 0.0
    c.at_rest[0] = kept
    return kept


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
        c.w[at + SIGN] = c.signs[i] if c.pushes[i] == 0 and c.partner[i] < 0 else 0.0
    if j < c.count:
        at = c.first + MODE_NUMBERS * j
        if c.pushes[j] != 0:
            c.w[at + SIGN] = -force
        else:
            c.w[at + EFFORT] = force
    if c.w[abi.STEP_STATUS] == 0.0:  # of laws whose gains follow the step, before the first one
        c.w[abi.STEP_STATUS] = c.step[0]
    write_rates(t, c, p)
    control[abi.EVALUATIONS] += 1
    c.accelerations(t, c.y, p, c.w, c.rate, c.out)
    for i in range(c.count):
        if not math.isfinite(c.out[i]):
            return NOT_FINITE
    return SAME


@exact()
def probe_contacts(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Set G of the rows at rest and of the sliding friction of contacts, and accelerations without these forces."""
    k, n = c.count, c.at_rest[0]
    for i in range(k * k):
        c.matrix[i] = 0.0
    if accelerate_by(t, c, k, 0.0, y, p, w, iw, control) != SAME:
        return NOT_FINITE
    for i in range(k):
        c.offset[i] = c.out[i]
    find_mobility(c)
    rows = n
    for i in range(c.dry):
        if c.partner[i] >= 0 and c.signs[i] != 0.0 and c.taken[i] == 0:
            c.rest[rows] = i
            rows += 1
    for r in range(rows):
        j = c.rest[r]
        force, usual = 1.0, larger_number(abs(c.offset[j]), usual_of(c, w, j))
        if c.alone[j] > 0.0 and usual > 0.0:  # accelerations as large as those that are there
            force = usual / c.alone[j]
        if accelerate_by(t, c, j, force, y, p, w, iw, control) != SAME:
            return NOT_FINITE
        for i in range(k):
            c.matrix[i * k + j] = (c.offset[i] - c.out[i]) / force
    c.at_rest[0] = rows
    symmetrise(c)
    size_forces(c, rows, w)
    for r in range(rows):  # the rounding of a bound is that of what presses
        i = c.rest[r]
        if c.pushes[i] == 0 and c.partner[i] >= 0:
            c.scale[i] += c.static[i] * c.scale[c.partner[i]]
    return SAME


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
                tied = c.partner[i] == j or abs(c.matrix[i * k + j]) > _COUPLED * size
                if tied and c.part[j] < c.part[i]:
                    c.part[i], again = c.part[j], True
    return int(n)


@exact()
def choose_part(c: Choice, part: int, rows: int) -> int:
    """Set the rows of a part in the order of ``box``; return their number, 0 where it has no contact."""
    count, contacts = 0, 0
    for r in range(rows):
        i = c.rest[r]
        if c.part[i] == part:
            c.box.order[count] = i
            count += 1
            contacts += 1 if c.partner[i] >= 0 else 0
    return count if contacts > 0 else 0


@exact()
def bound_of(c: Choice, i: int) -> float:
    """Return the bound of a row in a combination, of a contact over the force that presses."""
    return float(c.sliding[i] if c.loose[i] != 0 else c.static[i])


@exact()
def press(c: Choice, i: int) -> float:
    """Return the force up to which a row holds in a combination."""
    j = c.partner[i]
    return float(bound_of(c, i) * (1.0 if j < 0 else larger_number(-c.box.forces[j], 0.0)))


@exact()
def fill_system(c: Choice, count: int) -> int:
    """Write the equations of the rows in force to ``factor`` and ``right``; return their number."""
    k, box, m = c.count, c.box, 0
    for a in range(count):
        i = box.order[a]
        c.carrier[i] = -1
        box.forces[i] = 0.0
        if c.mode[i] == ON:
            box.place[m] = i
            m += 1
    for a in range(m):
        i = box.place[a]
        box.right[a] = c.offset[i]
        for b in range(m):
            j = box.place[b]
            friction, entry = c.partner[j], c.matrix[i * k + j]
            if c.pushes[j] != 0 and friction >= 0 and c.mode[friction] >= UPPER:  # W_N - s mu W_T
                sign = 1.0 if c.mode[friction] == UPPER else -1.0
                entry -= sign * bound_of(c, friction) * c.matrix[i * k + friction]
            box.factor[a * m + b] = entry
        for q in range(count):
            j = box.order[q]
            if c.mode[j] >= UPPER and c.partner[j] < 0:
                box.right[a] -= (1.0 if c.mode[j] == UPPER else -1.0) * bound_of(c, j) * c.matrix[i * k + j]
    return m


@exact()
def eliminate(c: Choice, m: int) -> None:
    """Solve the equations of ``factor``, gaps before friction: ``lower`` has the equation of each, -1 where it depends.

    Columns of dependent rows are what one unit of their force takes from the others.
    """
    k, box = c.count, c.box
    for a in range(m):
        box.lower[a] = -1.0
        box.bounds[a] = 0.0  # 1 for equations that are used
    for turn in range(2):
        while True:
            column, row, most = -1, -1, _NO_PIVOT
            for b in range(m):
                j = box.place[b]
                if box.lower[b] < 0.0 and (c.pushes[j] != 0) == (turn == 0):
                    for a in range(m):
                        i = box.place[a]
                        size = math.sqrt(abs(c.matrix[i * k + i] * c.matrix[j * k + j]))
                        if box.bounds[a] == 0.0 and abs(box.factor[a * m + b]) > most * size:
                            column, row, most = b, a, abs(box.factor[a * m + b]) / size
            if column < 0:
                break
            box.lower[column], box.bounds[row] = float(row), 1.0
            pivot = box.factor[row * m + column]
            for b in range(m):
                box.factor[row * m + b] /= pivot
            box.right[row] /= pivot
            for a in range(m):
                part = box.factor[a * m + column]
                if a != row and part != 0.0:
                    for b in range(m):
                        box.factor[a * m + b] -= part * box.factor[row * m + b]
                    box.right[a] -= part * box.right[row]


@exact()
def share(c: Choice, m: int) -> None:
    """Give friction that depends on others equal parts of the bounds, and say which row carries it."""
    box = c.box
    for _ in range(_SHARING):
        for b in range(m):
            j = box.place[b]
            own = press(c, j)
            if box.lower[b] < 0.0 and c.pushes[j] == 0 and own > 0.0:
                along, across = box.forces[j] / own, 1.0 / own
                for e in range(m):
                    i = box.place[e]
                    if box.lower[e] >= 0.0 and c.pushes[i] == 0 and press(c, i) > 0.0:
                        at = int(box.lower[e]) * m + b
                        z = box.factor[at]
                        along -= z * box.forces[i] / press(c, i)
                        across += z * z / press(c, i)
                change = -along / across
                box.forces[j] += change
                for e in range(m):
                    if box.lower[e] >= 0.0:
                        at = int(box.lower[e]) * m + b
                        box.forces[box.place[e]] -= box.factor[at] * change
    for b in range(m):
        j, owners, owner = box.place[b], 0, -1
        if box.lower[b] < 0.0:
            for e in range(m):
                at = int(box.lower[e]) * m + b
                if at >= 0 and abs(box.factor[at]) > NO_FACTOR:
                    owners += 1 if c.pushes[box.place[e]] == 0 else 2
                    owner, c.sizes[j] = box.place[e], box.factor[at]
            c.carrier[j] = owner if owners == 1 else c.count


@exact()
def solve_combination(c: Choice, count: int) -> bool:
    """Set the forces in the modes of a combination; return whether they are finite."""
    box, finite = c.box, True
    m = fill_system(c, count)
    eliminate(c, m)
    for b in range(m):
        if box.lower[b] >= 0.0:
            at = int(box.lower[b])
            box.forces[box.place[b]] = box.right[at]
    share(c, m)
    for a in range(count):
        i = box.order[a]
        if c.mode[i] >= UPPER:
            box.forces[i] = press(c, i) if c.mode[i] == UPPER else -press(c, i)
        finite = finite and math.isfinite(box.forces[i])
    return finite


@exact()
def is_right(c: Choice, count: int) -> bool:
    """Set the accelerations that forces leave; return whether these and forces are right for the modes."""
    k, box, right = c.count, c.box, True
    for a in range(count):
        i = box.order[a]
        total, size = c.offset[i], abs(c.offset[i])
        for b in range(count):
            j = box.order[b]
            total -= c.matrix[i * k + j] * box.forces[j]
            size += abs(c.matrix[i * k + j] * box.forces[j])
        box.left[i], box.scale[i] = total, size
        own, tiny, force = c.matrix[i * k + i], _ROUNDING * size, box.forces[i]
        little = tiny / own if own > 0.0 else 0.0
        if c.mode[i] == ON:
            right = right and abs(total) <= _SOLVED * size
            if c.pushes[i] != 0:
                right = right and force <= little
            else:
                right = right and abs(force) <= press(c, i) * (1.0 + ROUNDED) + little
        elif c.mode[i] == OFF:
            right = right and (c.pushes[i] == 0 or total >= -tiny)
        elif c.signs[i] == 0.0:  # of friction that slides already the acceleration is free
            right = right and (total >= -tiny if c.mode[i] == UPPER else total <= tiny)
    return right


@exact()
def set_combination(c: Choice, count: int) -> bool:
    """Set the modes of the present combination; return whether it is one: an open contact has no friction."""
    box = c.box
    for a in range(count):
        i = box.order[a]
        if c.pushes[i] != 0:
            c.mode[i] = ON if (c.option[i] == 0) == (c.loose[i] == 0) else OFF
        elif c.signs[i] != 0.0 and c.partner[i] >= 0:
            c.mode[i] = UPPER if c.signs[i] > 0.0 else LOWER
        elif c.loose[i] != 0:
            c.mode[i] = UPPER if c.option[i] == 0 else (LOWER if c.option[i] == 1 else ON)
        else:
            c.mode[i] = ON if c.option[i] == 0 else (UPPER if c.option[i] == 1 else LOWER)
    for a in range(count):
        i = box.order[a]
        j = c.partner[i]
        if c.pushes[i] == 0 and j >= 0 and c.mode[j] == OFF:
            if c.option[i] != 0:
                return False
            c.mode[i] = OFF
    return True


@exact()
def next_combination(c: Choice, count: int) -> bool:
    """Go on to the next combination; return whether there is one."""
    for a in range(count):
        i = c.box.order[a]
        slides = c.pushes[i] == 0 and c.partner[i] >= 0 and c.signs[i] != 0.0
        c.option[i] += 1
        if c.option[i] < (1 if slides else 2 if c.pushes[i] != 0 else 3):
            return True
        c.option[i] = 0
    return False


@exact()
def name_fault(c: Choice, count: int) -> None:
    """Name the contact of a part that comes nearest to jamming, with what is left of its mobility."""
    k, least = c.count, math.inf
    for a in range(count):
        i = c.box.order[a]
        j = c.partner[i]
        if c.pushes[i] != 0:
            if least == math.inf:
                c.named[0], c.jam[0] = i, c.matrix[i * k + i]
            if j >= 0 and c.matrix[i * k + i] > 0.0:
                turned = c.sliding[j] * c.matrix[i * k + j]
                turned = c.signs[j] * turned if c.signs[j] != 0.0 else abs(turned)
                left = c.matrix[i * k + i] - turned
                if left / c.matrix[i * k + i] < least:
                    c.named[0], c.jam[0], least = i, left, left / c.matrix[i * k + i]


@exact()
def try_combinations(c: Choice, count: int) -> int:
    """Find the modes of a part; return `SAME`, `NO_CONTACT_MODES`, `SEVERAL_MODES` or `TOO_MANY`.

    Combinations with equal accelerations are one: forces may be several.
    """
    box, found, contacts = c.box, 0, 0
    for a in range(count):
        i = box.order[a]
        contacts += 1 if c.pushes[i] != 0 else 0
        c.option[i] = 0
    if contacts > MOST_CONTACTS or count > _MOST_ROWS:
        c.named[0] = box.order[count - 1]
        return TOO_MANY
    more = True
    while more:
        if set_combination(c, count) and solve_combination(c, count) and is_right(c, count):
            if found == 0:
                found = 1
                for a in range(count):
                    i = box.order[a]
                    c.best[i], c.part[i] = c.mode[i], c.carrier[i]
                    c.forces[i], c.trial[i], c.bounds[i] = box.forces[i], box.left[i], c.sizes[i]
            elif found == 1:
                for a in range(count):
                    i = box.order[a]
                    if abs(box.left[i] - c.trial[i]) > _ONE * box.scale[i]:
                        found = 2
                if found == 2:
                    for a in range(count):
                        c.other[box.order[a]] = c.mode[box.order[a]]
        more = next_combination(c, count)
    if found == 0:
        name_fault(c, count)
        return NO_CONTACT_MODES
    if found == 2:
        name_fault(c, count)
        return SEVERAL_MODES
    return SAME


@exact()
def break_loose(c: Choice, count: int) -> bool:
    """Let the friction slide that its bound at rest does not hold, by that in motion; return whether any does."""
    again = False
    for a in range(count):
        i = c.box.order[a]
        breaks = c.pushes[i] == 0 and c.best[i] >= UPPER and c.signs[i] == 0.0 and c.loose[i] == 0
        if breaks and c.static[i] > c.sliding[i]:
            c.loose[i], again = 1, True
    return again


@exact()
def write_part(c: Choice, count: int) -> None:
    """Write the modes of a part."""
    after = c.after
    for a in range(count):
        i = c.box.order[a]
        at, carrier = MODE_NUMBERS * i, c.part[i]
        if c.best[i] == ON and carrier < 0:
            after[at + HELD] = 1.0
            after[at + CONSTANT] = c.before[at + CONSTANT] if c.before[at + HELD] != 0.0 else c.value[i]
            after[at + LIMIT] += c.static[i] if c.pushes[i] == 0 and c.partner[i] < 0 else 0.0
        elif c.best[i] == ON and c.pushes[i] != 0:
            after[at + CONSTANT], after[at + LIMIT] = AT_REST, 1.0
        elif c.best[i] == ON and carrier < c.count:
            after[at + CONSTANT] = float(carrier + 1)
            if c.partner[i] >= 0:
                after[at + LIMIT] = c.bounds[i]
            else:
                after[MODE_NUMBERS * carrier + LIMIT] += abs(c.bounds[i]) * c.static[i]
        elif c.best[i] == ON:
            slack = ROUNDED * (c.scale[i] + abs(c.forces[i]))
            after[at + CONSTANT], after[at + EFFORT], after[at + LIMIT] = AT_REST, c.forces[i], slack
        c.signs[i] = 1.0 if c.best[i] == UPPER else (-1.0 if c.best[i] == LOWER else 0.0)
        after[at + SIGN] = 0.0 if c.pushes[i] != 0 else c.signs[i]


@exact()
def choose_parts(c: Choice, rows: int) -> int:
    """Choose the modes of all parts with contacts, and leave the rows of others at rest; return `SAME` or a code."""
    for first in range(c.count):
        count = choose_part(c, first, rows)
        again = count > 0
        while again:
            code = try_combinations(c, count)
            if code != SAME:
                return int(code)
            again = break_loose(c, count)
            if again:
                for a in range(count):
                    c.part[c.box.order[a]] = first
        if count > 0:
            for a in range(count):
                i = c.box.order[a]
                c.taken[i] = 2
            write_part(c, count)
            for a in range(count):
                c.part[c.box.order[a]] = c.count
    return SAME


@exact(entry=True)
def choose_contacts(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Choose modes as `symgen.run.modes.choice.choose_modes` does, where there are contacts.

    Returns `SAME`, `OTHERS`, or why there are no modes.
    """
    n, code, rows, left = keep_touching(c, find_rest(c, w)), SAME, 0, 0
    if n > 0:
        if probe_contacts(t, c, y, p, w, iw, control) != SAME:
            return NOT_FINITE
        rows = find_parts(c)
        code = choose_parts(c, rows)
        if code != SAME:
            return int(code)
        for r in range(rows):
            i = c.rest[r]
            if c.taken[i] != 2:
                c.rest[left] = i
                left += 1
    c.at_rest[0] = left
    for i in range(c.count):
        c.taken[i] = 0
    if left > 0 and solve_rest(c, left, w) != SAME:
        return NO_FORCES
    code = hold_rows(c, w)
    for i in range(c.count):
        c.shut[i] = 0
    add_forces(c)
    return int(write_modes(c, w)) if code == SAME else int(code)


@exact(entry=True)
def measure_margins_of_contacts(c: Choice, w: Array, hunt: Array) -> int:
    """Do what `symgen.run.modes.choice.measure_margins` does; friction at rest that others carry is watched as well.

    A drive may move it, though the rows in force stay at rest.
    """
    n, at, found = int(hunt[COUNT]), N_HEAD, measure_margins(c, w, hunt)
    for k in range(n):
        i = int(hunt[at + ROW * n + k])
        numbers = c.first + MODE_NUMBERS * i
        still = w[numbers + HELD] == 0.0 and w[numbers + SIGN] == 0.0
        if hunt[at + MARGIN * n + k] == float(RATE) and c.pushes[i] == 0 and c.partner[i] >= 0 and still:
            hunt[at + MEASURE * n + k] = row_scale(c, w, i, abi.SPEED)
    return int(found)
