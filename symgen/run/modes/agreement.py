"""Forces at rest with bounds that depend on reactions, compiled, and how efforts in force follow reactions.

Reactions at rest depend on the forces at rest, and their bounds on the reactions: both are one problem of laws.
"""

from __future__ import annotations

from symgen.base.ir.numerics import SKIP
from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.loopcode.loop_instances import Meanings, exact_instance
from symgen.compile.native.annotations import Array
from symgen.run.laws.motions import NO_MOTION, NOT_SOUGHT, SEVERAL_MOTIONS, count_motions, find_forces
from symgen.run.laws.problem import BALL, COMPONENTS, ON, begin_row, load_of
from symgen.run.laws.problem import LOWER as DOWN
from symgen.run.laws.sharing import share_forces
from symgen.run.layout.redundancy import farthest_row, is_off
from symgen.run.modes.bounded_rows import (
    AT_REST,
    CONSTANT,
    DISAGREED,
    EFFORT,
    HELD,
    LIMIT,
    NO_FACTOR,
    NO_FORCES,
    SAME,
    SEVERAL_BY_REACTION,
    SHARED,
)
from symgen.run.modes.box import INSIDE, LOWER, UPPER, solve_box
from symgen.run.modes.holding import find_carriers
from symgen.run.modes.resting import set_bounds, solve_rest
from symgen.run.modes.row_records import Choice


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


@exact()
def reacts(c: Choice, part: int) -> bool:
    """Return whether bounds of a part depend on reactions."""
    for i in range(c.rows.dry):
        if c.rows.pressed[i] != 0 and c.part[i] == part:
            return True
    return False


@exact()
def list_part(c: Choice, n: int) -> int:
    """List the rows at rest of a part, and those in motion by reactions, in ``order``; return their number."""
    order, count = c.box.order, n
    for r in range(n):
        order[r] = c.rest[r]
    for i in range(c.rows.dry):
        moves = c.rows.pressed[i] != 0 and c.signs[i] != 0.0 and c.part[i] == c.part[c.rest[0]]
        for r in range(n):  # one at rest may begin to move
            moves = moves and c.rest[r] != i
        if moves:
            order[count] = i
            count += 1
    return count


@exact()
def fill_laws(c: Choice, n: int) -> int:
    """Write the problem of a part, the rows at rest within the bounds of the box; return its number of rows."""
    k, box, laws, count = c.rows.count, c.box, c.laws, list_part(c, n)
    for r in range(count):
        i = box.order[r]
        begin_row(count, r, laws)
        laws.offset[r] = box.offset[r] if r < n else c.problem.offset[i]
        for q in range(count):
            laws.matrix[r * count + q] = c.problem.matrix[i * k + box.order[q]]
        laws.law[r], laws.beta[r], laws.way[r] = BALL, c.read.sliding[i], c.signs[i] if r >= n else 0.0
        if r < n:
            laws.beta[r] = 0.5 * (box.bounds[r] - box.lower[r])
            laws.middle[r] = 0.5 * (box.bounds[r] + box.lower[r])
        if c.rows.pressed[i] != 0:
            laws.kappa[r], laws.beta[r], laws.components[r] = laws.beta[r], 0.0, 2
            for component in range(2):
                at = COMPONENTS * r + component
                laws.apart[at] = c.problem.apart[2 * i + component]
                for q in range(count):
                    laws.parts[at * count + q] = c.problem.parts[(2 * i + component) * k + box.order[q]]
    return count


@exact()
def agree_within(c: Choice, n: int, part: float) -> int:
    """Find the forces at rest of a part as `solve_within` does, with bounds that may depend on reactions.

    Returns `SAME`, `NO_FORCES` or `DISAGREED`.
    """
    box, laws = c.box, c.laws
    set_bounds(c, n, part)
    if not reacts(c, c.part[c.rest[0]]):
        return SAME if solve_box(n, box) == 0 else NO_FORCES
    count = fill_laws(c, n)
    if not find_forces(count, laws, 1):
        return DISAGREED
    share_forces(count, laws)
    for r in range(count):
        i = box.order[r]
        c.forces[i] = laws.forces[r] - (c.read.middle[i] if r < n else 0.0)
        c.sizes[i] = load_of(count, r, laws) if c.rows.pressed[i] != 0 else 1.0
    for r in range(n):
        i = c.rest[r]
        box.left[r], box.forces[r] = laws.left[r], laws.forces[r]
        box.bounds[r] *= c.sizes[i]
        box.lower[r] *= c.sizes[i]
        box.place[r] = INSIDE if laws.state[r] == ON else LOWER if laws.state[r] == DOWN else UPPER
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
        laws.forces[r] = c.forces[i] + (c.read.middle[i] if r < n else 0.0)
    motions = count_motions(count, laws) if find_forces(count, laws, 0) else NO_MOTION
    c.unsought[0] = max(c.unsought[0], count if motions == NOT_SOUGHT else 0)
    if motions != SEVERAL_MOTIONS:
        return 0
    for r in range(count):
        if laws.state[r] != laws.other[r]:
            c.named[differ] = box.order[r]
            differ += 1
    c.named[differ] = -1
    return 1


#: What the forces at rest are found by where bounds depend on reactions.
AGREEING = Meanings("rows at rest with bounds that depend on reactions", solve_within=agree_within)
solve_pressed = exact_instance(solve_rest, AGREEING)


@exact(entry=True)
def can_move(c: Choice) -> int:
    """Return whether the mechanism can move with the chosen rows in force; assumed of too large ones."""
    layout = c.rows.layout
    if c.room.shape[0] == 0:
        return 1
    for i in range(c.rows.count):
        c.w[c.rows.first + MODE_NUMBERS * i + HELD] = c.after[MODE_NUMBERS * i + HELD]
    return 1 if farthest_row(layout, layout.nv, layout.m, SKIP, 1, c.w, c.room) < layout.nv else 0


@exact()
def is_shared_among(c: Choice, i: int, count: int) -> bool:
    """Whether the reaction of a row at rest with bounds by it depends on how row `i` shares its effort.

    It changes by less than rounding then, by the whole of the bound of the row.
    """
    k, most = c.rows.count, find_carriers(c, i, count)
    for p in range(k):
        if c.rows.pressed[p] != 0 and c.after[MODE_NUMBERS * p + HELD] != 0.0:
            for part in range(2):
                at, a = (2 * p + part) * k, 0
                total = c.problem.parts[at + i]
                size = abs(total)
                for j in range(k):
                    if c.taken[j] != 0:
                        carries = abs(c.box.left[a]) > NO_FACTOR * most
                        if j == p and carries:
                            return True
                        total -= c.box.left[a] * c.problem.parts[at + j]
                        size += abs(c.box.left[a] * c.problem.parts[at + j])
                        a += 1
                if abs(total) * c.holds[i] > NO_FACTOR * (size * c.holds[i] + c.sizes[p]):
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
    for j in range(c.rows.count):
        if j == owner or carrier_of(c, j) == owner:
            pressed += 1 if c.rows.pressed[j] != 0 else 0
            if c.rows.varying[j] != 0 and c.rows.pressed[j] == 0:
                return False
    return pressed == 1


@exact()
def keep_efforts(c: Choice) -> None:
    """Put a row with a bound by its reaction into force for those that share its effort, which keep what they have.

    Its reaction is known then. At its bound efforts are shared out anew (`symgen.run.modes.resting`).
    """
    after = c.after
    for i in range(c.rows.count):
        if c.rows.pressed[i] != 0 and can_keep_efforts(c, i):
            at, owner = MODE_NUMBERS * i, carrier_of(c, i)
            for j in range(c.rows.count):
                if j != i and carrier_of(c, j) == owner:
                    after[MODE_NUMBERS * j + CONSTANT] = float(i + 1)
            after[MODE_NUMBERS * owner + HELD] = after[MODE_NUMBERS * owner + LIMIT] = 0.0
            after[MODE_NUMBERS * owner + CONSTANT] = float(i + 1)
            after[at + HELD] = 1.0
            after[at + CONSTANT] = c.before[at + CONSTANT] if c.before[at + HELD] != 0.0 else c.read.value[i]
            c.taken[i], c.taken[owner] = 1, 0
    for i in range(c.rows.count):
        owner = carrier_of(c, i)
        c.trial[i] = 1.0 if owner >= 0 and c.rows.pressed[owner] != 0 and can_keep_efforts(c, i) else 0.0
    for i in range(c.rows.count):
        if c.trial[i] != 0.0:
            at = MODE_NUMBERS * i
            after[at + CONSTANT], after[at + LIMIT], after[at + EFFORT] = AT_REST, 0.0, c.forces[i]


@exact(entry=True)
def follow_reactions(c: Choice) -> int:
    """Have largest efforts follow the reaction, unless it depends on a force that rows share; else return `SHARED`."""
    after, shared, count = c.after, False, 0
    for i in range(c.rows.count):
        c.trial[i] = 0.0
    if c.rows.changes != 0 or can_move(c) != 0:
        keep_efforts(c)
    for i in range(c.rows.count):
        count += 1 if c.taken[i] != 0 else 0
    for i in range(c.rows.count):
        at = MODE_NUMBERS * i
        if after[at + HELD] == 0.0 and after[at + CONSTANT] != 0.0 and c.trial[i] == 0.0:
            shared = shared or c.rows.pressed[i] != 0 or is_shared_among(c, i, count)
    if shared and (c.rows.changes != 0 or can_move(c) != 0):
        count = 0
        for i in range(c.rows.count):
            at = MODE_NUMBERS * i
            if after[at + HELD] != 0.0 or after[at + CONSTANT] != 0.0:
                c.named[count] = i
                count += 1
        c.named[count] = -1
        return SHARED
    for i in range(c.rows.count):
        at = MODE_NUMBERS * i
        if c.rows.pressed[i] != 0 and (not shared or after[at + HELD] == 0.0):
            after[at + LIMIT] = 0.0
    return SAME


@exact()
def rest_of_part(c: Choice, n: int, w: Array) -> int:
    """Find the forces of the rows at rest of a part without one-sided rows; return `SAME`, or why there are none."""
    code = solve_pressed(c, n, w)
    if code == SAME and reacts(c, c.part[c.rest[0]]) and moves_otherwise(c, n) != 0:
        return SEVERAL_BY_REACTION
    return int(code)
