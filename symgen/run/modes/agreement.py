"""Modes where bounds depend on reactions, compiled: both are found in turns, until they agree.

Reactions at rest depend on the forces at rest, and their bounds on the reactions. One function of the loop language for
single runs and rows of sweeps, beside that of `symgen.run.modes.choice`.
"""

from __future__ import annotations

import math

from symgen.base.ir.numerics import SKIP
from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.loopcode.loop_instances import Meanings, exact_instance
from symgen.compile.native.annotations import Array, Integers
from symgen.run.laws.motions import SEVERAL_MOTIONS, count_motions, find_forces
from symgen.run.laws.problem import BALL, COMPONENTS, ON, begin_row, load_of
from symgen.run.laws.problem import LOWER as DOWN
from symgen.run.layout.redundancy import farthest_row, is_off
from symgen.run.modes.bounded_rows import (
    AT_REST,
    CONSTANT,
    DISAGREED,
    EFFORT,
    HELD,
    JAMMED,
    LIMIT,
    NO_FACTOR,
    NO_FORCES,
    NOT_DETERMINED,
    NOT_FINITE,
    REDUNDANT,
    SAME,
    SEVERAL_BY_REACTION,
    SHARED,
    Choice,
)
from symgen.run.modes.box import INSIDE, LOWER, UPPER, solve_box
from symgen.run.modes.choice import (
    accelerate,
    add_forces,
    find_mobility,
    find_rest,
    size_forces,
    symmetrise,
    write_modes,
)
from symgen.run.modes.holding import find_carriers, hold_rows
from symgen.run.modes.resting import set_bounds, solve_rest

#: Bounds by reactions agree within this part of them, after so many solutions at most; then Newton's method follows.
_AGREED, _AGREEMENTS = 1e-14, 60


@exact()
def reaches_reactions(c: Choice, row: int, w: Array) -> bool:
    """Return whether a row is tied, by rows in force, to a coordinate whose bounds depend on a reaction.

    Rows with bounds count as in force; coordinates and rows found are marked in ``rate`` and in the scratch.
    """
    entries, again = c.layout.entries, True
    for j in range(c.layout.nv):
        c.rate[j] = 0.0
    for i in range(c.layout.m):
        c.w[i] = 1.0 if i == row else 0.0
    while again:
        again = False
        for e in range(entries.shape[0] // 3):
            i, j = entries[3 * e], entries[3 * e + 1]
            if c.place_of[i] >= 0 or not is_off(c.layout, i, w):
                if c.w[i] != c.rate[j]:
                    c.w[i], c.rate[j], again = 1.0, 1.0, True
    for i in range(c.layout.m):
        if c.w[i] != 0.0 and c.place_of[i] >= 0 and c.pressed[c.place_of[i]] != 0:
            return True
    return False


@exact(entry=True)
def find_redundant(c: Choice, w: Array) -> int:
    """Return the first row left out that has no bounds and leaves such reactions undetermined, -1 for none."""
    for i in range(c.layout.m):
        if w[c.layout.mask + i] != 0.0 and c.place_of[i] < 0 and reaches_reactions(c, i, w):
            return int(i)
    return -1


@exact()
def store_probe(t: float, c: Choice, p: Array, number: int, force: float) -> None:
    """Store the accelerations and reactions of the last probe: without forces, or by a unit of force `number`."""
    k = c.count
    if number < 0:
        for i in range(k):
            c.offset[i] = c.out[i]
    else:
        for i in range(k):
            c.matrix[i * k + number] = (c.offset[i] - c.out[i]) / force
    c.reactions(t, c.y, p, c.w, c.rate, c.out)
    place = 0
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
def probe_row(t: float, c: Choice, j: int, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Set the column of a row in G, and what its force adds to the reactions."""
    if c.sliding[j] > 0.0 or c.varying[j] != 0:
        for i in range(c.count):
            c.trial[i] = 0.0 if c.pressed[i] != 0 else c.signs[i]
        force = 1.0
        if c.pressed[j] != 0 or c.sliding[j] == 0.0 or c.middle[j] != 0.0:
            c.trial[j], c.pushed[0] = 0.0, j
        else:
            c.trial[j], force = 1.0, c.sliding[j]
        code = accelerate(t, c, y, p, w, iw, control)
        c.pushed[0] = -1
        if code != SAME:
            return NOT_FINITE
        store_probe(t, c, p, j, force)
    return SAME


@exact(entry=True)
def probe_reactions(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Set G among all rows, and the reactions without efforts by reactions and by their forces.

    Returns `SAME`, `NOT_FINITE`, or `JAMMED` where an effort alone would bring about all of its reaction.
    """
    k, n = c.count, c.at_rest[0]
    for i in range(k * k):
        c.matrix[i] = 0.0
    for i in range(2 * k * k):
        c.parts[i] = 0.0
    for i in range(k):
        c.forces[i] = 0.0
        c.trial[i] = 0.0 if c.pressed[i] != 0 else c.signs[i]
    if accelerate(t, c, y, p, w, iw, control) != SAME:
        return NOT_FINITE
    store_probe(t, c, p, -1, 1.0)
    find_mobility(c)
    for r in range(n):
        if probe_row(t, c, c.rest[r], y, p, w, iw, control) != SAME:
            return NOT_FINITE
    for j in range(k):
        if c.pressed[j] != 0 and c.signs[j] != 0.0 and probe_row(t, c, j, y, p, w, iw, control) != SAME:
            return NOT_FINITE
    for i in range(k):
        if c.pressed[i] != 0:
            bound = c.sliding[i] if c.signs[i] != 0.0 else c.static[i]
            x, y_part = c.parts[2 * i * k + i], c.parts[(2 * i + 1) * k + i]
            c.jam[0] = bound * math.sqrt(x * x + y_part * y_part)
            if not c.jam[0] < 1.0:
                c.named[0] = i
                return JAMMED
    return SAME


@exact()
def begin_sizes(c: Choice) -> None:
    """Set the sizes of reactions without efforts by reactions; at rest, what holds all."""
    for i in range(c.count):
        c.sizes[i] = 1.0
        if c.pressed[i] != 0:
            x, y = c.apart[2 * i], c.apart[2 * i + 1]
            c.sizes[i] = math.sqrt(x * x + y * y) if c.signs[i] != 0.0 else math.inf


@exact()
def follow_bounds(c: Choice, n: int) -> None:
    """Have bounds and accelerations without forces at rest follow the present sizes of reactions."""
    k, box = c.count, c.box
    for i in range(k):
        if c.pressed[i] != 0 and c.signs[i] != 0.0:
            c.forces[i] = c.signs[i] * c.sliding[i] * c.sizes[i]
    for r in range(n):
        i, total = c.rest[r], 0.0
        if box.bounds[r] > 0.0:
            box.bounds[r] *= c.sizes[i]
            box.lower[r] *= c.sizes[i]
        for j in range(k):
            if c.pressed[j] != 0 and c.signs[j] != 0.0:
                total += c.matrix[i * k + j] * c.forces[j]
        box.offset[r] = c.offset[i] - total


@exact()
def follow_sizes(c: Choice) -> bool:
    """Set the sizes of reactions by the present forces; return whether they agree with the bounds."""
    k, agree = c.count, True
    for i in range(k):
        if c.pressed[i] != 0:
            x, y = c.apart[2 * i], c.apart[2 * i + 1]
            for j in range(k):
                x -= c.parts[2 * i * k + j] * c.forces[j]
                y -= c.parts[(2 * i + 1) * k + j] * c.forces[j]
            size = math.sqrt(x * x + y * y)
            agree = agree and size < math.inf and abs(size - c.sizes[i]) <= _AGREED * size
            c.sizes[i] = size
    return agree


@exact()
def fill_laws(c: Choice, n: int) -> int:
    """Write the problem of the rows at rest, within bounds over reactions, and of those in motion by reactions.

    Returns their number; ``order`` has them.
    """
    k, box, laws, count = c.count, c.box, c.laws, n
    for r in range(n):
        box.order[r] = c.rest[r]
    for i in range(k):
        moves = c.pressed[i] != 0 and c.signs[i] != 0.0
        for r in range(n):  # one at rest may begin to move
            moves = moves and c.rest[r] != i
        if moves:
            box.order[count] = i
            count += 1
    for r in range(count):
        i = box.order[r]
        begin_row(count, r, laws)
        laws.offset[r], laws.law[r] = c.offset[i], BALL
        for q in range(count):
            laws.matrix[r * count + q] = c.matrix[i * k + box.order[q]]
        laws.beta[r] = c.sliding[i]
        if r < n:
            laws.beta[r], laws.middle[r] = (
                0.5 * (box.bounds[r] - box.lower[r]),
                0.5 * (box.bounds[r] + box.lower[r]),
            )
        else:
            laws.way[r] = c.signs[i]
        if c.pressed[i] != 0:
            laws.kappa[r], laws.beta[r], laws.components[r] = laws.beta[r], 0.0, 2
            for part in range(2):
                at = COMPONENTS * r + part
                laws.apart[at] = c.apart[2 * i + part]
                for q in range(count):
                    laws.parts[at * count + q] = c.parts[(2 * i + part) * k + box.order[q]]
    return count


@exact(entry=True)
def agree_by_newton(c: Choice, n: int, part: float) -> int:
    """Find the forces at rest where bounds and forces in turns never agree; return `SAME` or `DISAGREED`."""
    box, laws = c.box, c.laws
    set_bounds(c, n, part)
    count = fill_laws(c, n)
    if not find_forces(count, laws, 1):
        return DISAGREED
    for r in range(count):
        i = box.order[r]
        c.forces[i] = laws.forces[r]
        if c.pressed[i] != 0:
            c.sizes[i] = load_of(count, r, laws)
    for r in range(n):
        i = c.rest[r]
        box.left[r], box.forces[r] = laws.left[r], laws.forces[r]
        box.bounds[r] *= c.sizes[i]
        box.lower[r] *= c.sizes[i]
        box.place[r] = INSIDE if laws.state[r] == ON else LOWER if laws.state[r] == DOWN else UPPER
        c.forces[i] -= c.middle[i]
    return SAME


@exact(entry=True)
def moves_otherwise(c: Choice, n: int) -> int:
    """Return 1 where the rows at rest, and those in motion by reactions, have another motion beside that found, else 0.

    The rows that differ are named. Motions of many rows are not sought.
    """
    box, laws, differ = c.box, c.laws, 0
    for r in range(n):
        size = c.sizes[c.rest[r]]
        if size > 0.0:
            box.bounds[r] /= size
            box.lower[r] /= size
    count = fill_laws(c, n)
    for r in range(count):
        i = box.order[r]
        laws.forces[r] = c.forces[i] + (c.middle[i] if r < n else 0.0)
    if not find_forces(count, laws, 0) or count_motions(count, laws) != SEVERAL_MOTIONS:
        return 0
    for r in range(count):
        if laws.state[r] != laws.other[r]:
            c.named[differ] = box.order[r]
            differ += 1
    c.named[differ] = -1
    return 1


@exact()
def agree_within(c: Choice, n: int, part: float) -> int:
    """Find the forces at rest as `solve_within` does, with bounds that agree with them.

    Returns `SAME`, `NO_FORCES` or `DISAGREED`.
    """
    begin_sizes(c)
    for _ in range(_AGREEMENTS):
        set_bounds(c, n, part)
        follow_bounds(c, n)
        if solve_box(n, c.box) != 0:
            return NO_FORCES
        for r in range(n):
            c.forces[c.rest[r]] = c.box.forces[r] - c.middle[c.rest[r]]
        if follow_sizes(c):
            return SAME
    return int(agree_by_newton(c, n, part))


#: What the forces at rest are found by where bounds depend on reactions.
AGREEING = Meanings("rows at rest with bounds that depend on reactions", solve_within=agree_within)
solve_pressed = exact_instance(solve_rest, AGREEING)


@exact()
def apply_sizes(c: Choice) -> None:
    """Make bounds by reactions forces."""
    for i in range(c.count):
        if c.pressed[i] != 0:
            c.static[i] *= c.sizes[i]
            c.sliding[i] *= c.sizes[i]


@exact(entry=True)
def can_move(c: Choice) -> int:
    """Return whether the mechanism can move with the chosen rows in force; assumed of too large ones."""
    layout = c.layout
    if c.room.shape[0] == 0:
        return 1
    for i in range(c.count):
        c.w[c.first + MODE_NUMBERS * i + HELD] = c.after[MODE_NUMBERS * i + HELD]
    return 1 if farthest_row(layout, layout.nv, layout.m, SKIP, 1, c.w, c.room) < layout.nv else 0


@exact()
def is_shared_among(c: Choice, i: int, count: int) -> bool:
    """Whether the reaction of a row at rest with bounds by it depends on how row `i` shares its effort.

    It changes by less than rounding then, by the whole of the bound of the row.
    """
    k, most = c.count, find_carriers(c, i, count)
    for p in range(k):
        if c.pressed[p] != 0 and c.after[MODE_NUMBERS * p + HELD] != 0.0:
            for part in range(2):
                at, a = (2 * p + part) * k, 0
                total = c.parts[at + i]
                size = abs(total)
                for j in range(k):
                    if c.taken[j] != 0:
                        carries = abs(c.box.left[a]) > NO_FACTOR * most
                        if j == p and carries:
                            return True
                        total -= c.box.left[a] * c.parts[at + j]
                        size += abs(c.box.left[a] * c.parts[at + j])
                        a += 1
                if abs(total) * c.static[i] > NO_FACTOR * (size * c.static[i] + c.sizes[p]):
                    return True
    return False


@exact()
def carrier_of(c: Choice, i: int) -> int:
    """Return the row in force that carries the effort of another one at rest, -1 for none."""
    at = MODE_NUMBERS * i
    return int(c.after[at + CONSTANT]) - 1 if c.after[at + HELD] == 0.0 and c.after[at + CONSTANT] > 0.0 else -1


@exact()
def can_keep_efforts(c: Choice, i: int) -> bool:
    """Whether a row at rest shares its effort with one row with a bound by its reaction, and with constant ones."""
    owner, pressed = carrier_of(c, i), 0
    if owner < 0:
        return False
    for j in range(c.count):
        if j == owner or carrier_of(c, j) == owner:
            pressed += 1 if c.pressed[j] != 0 else 0
            if c.varying[j] != 0 and c.pressed[j] == 0:
                return False
    return pressed == 1


@exact()
def keep_efforts(c: Choice) -> None:
    """Put a row with a bound by its reaction into force for those that share its effort, which keep what they have.

    Its reaction is known then. At its bound efforts are shared out anew (`symgen.run.modes.resting`).
    """
    after = c.after
    for i in range(c.count):
        if c.pressed[i] != 0 and can_keep_efforts(c, i):
            at, owner = MODE_NUMBERS * i, carrier_of(c, i)
            for j in range(c.count):
                if j != i and carrier_of(c, j) == owner:
                    after[MODE_NUMBERS * j + CONSTANT] = float(i + 1)
            after[MODE_NUMBERS * owner + HELD] = after[MODE_NUMBERS * owner + LIMIT] = 0.0
            after[MODE_NUMBERS * owner + CONSTANT] = float(i + 1)
            after[at + HELD] = 1.0
            after[at + CONSTANT] = c.before[at + CONSTANT] if c.before[at + HELD] != 0.0 else c.value[i]
            c.taken[i], c.taken[owner] = 1, 0
    for i in range(c.count):
        owner = carrier_of(c, i)
        c.trial[i] = 1.0 if owner >= 0 and c.pressed[owner] != 0 and can_keep_efforts(c, i) else 0.0
    for i in range(c.count):
        if c.trial[i] != 0.0:
            at = MODE_NUMBERS * i
            after[at + CONSTANT], after[at + LIMIT], after[at + EFFORT] = AT_REST, 0.0, c.forces[i]


@exact(entry=True)
def follow_reactions(c: Choice) -> int:
    """Have largest efforts follow the reaction, unless it depends on a force that rows share; else return `SHARED`."""
    after, shared, count = c.after, False, 0
    for i in range(c.count):
        c.trial[i] = 0.0
    if c.changes != 0 or can_move(c) != 0:
        keep_efforts(c)
    for i in range(c.count):
        count += 1 if c.taken[i] != 0 else 0
    for i in range(c.count):
        at = MODE_NUMBERS * i
        if after[at + HELD] == 0.0 and after[at + CONSTANT] != 0.0 and c.trial[i] == 0.0:
            shared = shared or c.pressed[i] != 0 or is_shared_among(c, i, count)
    if shared and (c.changes != 0 or can_move(c) != 0):
        count = 0
        for i in range(c.count):
            at = MODE_NUMBERS * i
            if after[at + HELD] != 0.0 or after[at + CONSTANT] != 0.0:
                c.named[count] = i
                count += 1
        c.named[count] = -1
        return SHARED
    for i in range(c.count):
        at = MODE_NUMBERS * i
        if c.pressed[i] != 0 and (not shared or after[at + HELD] == 0.0):
            after[at + LIMIT] = 0.0
    return SAME


@exact(entry=True)
def choose_pressed(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Choose modes as `choose_modes` does, where bounds depend on reactions; no row is one-sided."""
    c.named[0] = find_redundant(c, w)
    if c.named[0] >= 0:
        return REDUNDANT
    n = find_rest(c, w)
    for i in range(c.count):
        c.bounds[i], c.bounds[c.count + i] = c.static[i], c.sliding[i]
    code = probe_reactions(t, c, y, p, w, iw, control)
    if code == SAME and n > 0:
        symmetrise(c)
        size_forces(c, n, w)
        code = solve_pressed(c, n, w)
        if code == SAME and moves_otherwise(c, n) != 0:
            code = SEVERAL_BY_REACTION
        apply_sizes(c)
        add_forces(c)
    if code == SAME:
        code = NOT_DETERMINED if hold_rows(c, w) != SAME else follow_reactions(c)
    for i in range(c.count):
        c.static[i], c.sliding[i] = c.bounds[i], c.bounds[c.count + i]
    return int(write_modes(c, w)) if code == SAME else int(code)
