"""Modes of parts of rows that depend on each other, compiled: Newton's method on all laws.

Rest is tried first, then other beginnings, then combinations where they are few; each motion is verified. Of few rows
all motions are counted. Where other beginnings of many rows lead to different motions there are several, unless what
was at rest goes on resting; others than those found are not sought.
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.run.effects.pushing import PAIRED, POISSON
from symgen.run.laws.motions import NOT_SOUGHT, SEVERAL_MOTIONS, count_motions, find_forces, seek_another
from symgen.run.laws.problem import (
    BALL,
    COMPONENTS,
    LOWER,
    NOTHING,
    OFF,
    ON,
    PUSH,
    SECOND,
    UPPER,
    Laws,
    begin_row,
    load_of,
    middle_of,
)
from symgen.run.laws.problem import bound_of as load_bound
from symgen.run.laws.sharing import find_dependent, share_forces
from symgen.run.laws.verify import size_of_terms
from symgen.run.layout.scales import larger_number
from symgen.run.modes.bounded_rows import (
    AT_BOUND,
    CONSTANT,
    DISAGREED,
    HELD,
    NO_ACCELERATION,
    NO_CONTACT_MODES,
    NO_FACTOR,
    NOTHING_FOUND,
    SAME,
    SEVERAL_BY_REACTION,
    SEVERAL_MODES,
)
from symgen.run.modes.contact_parts import has_reaction
from symgen.run.modes.paired_rows import is_first, is_second, settle_pair
from symgen.run.modes.probing import by_reaction
from symgen.run.modes.row_records import Choice


@exact()
def bound_of(c: Choice, i: int, part: float) -> float:
    """Return the bound of a row, or a part of that at rest, of a contact over the force that presses."""
    return float(c.read.sliding[i] if c.loose[i] != 0 or c.signs[i] != 0.0 else part * c.read.static[i])


@exact()
def fill_part(c: Choice, count: int, part: float) -> None:
    """Write the problem of the rows of a part, in their order in ``order``, with a part of the bounds at rest."""
    k, order, laws = c.rows.count, c.box.order, c.laws
    for a in range(count):
        i = order[a]
        begin_row(count, a, laws)
        laws.offset[a], laws.usual[a] = c.problem.offset[i], c.problem.usual[i]
        for b in range(count):
            laws.matrix[a * count + b] = c.problem.matrix[i * k + order[b]]
            # forces count from the middle of motion
            laws.offset[a] += c.problem.matrix[i * k + order[b]] * c.read.middle[order[b]]
        laws.law[a] = PUSH if c.rows.pushes[i] != 0 else BALL
        if c.rows.pushes[i] == 0 and c.rows.partner[i] < 0:
            laws.beta[a], laws.middle[a] = bound_of(c, i, part), 0.0 if c.loose[i] != 0 else part * c.read.middle[i]
            if by_reaction(c, i):
                laws.kappa[a], laws.beta[a], laws.way[a], laws.components[a] = laws.beta[a], 0.0, c.signs[i], 2
                for component in range(2):
                    at = COMPONENTS * a + component
                    laws.apart[at] = c.problem.apart[2 * i + component]
                    for b in range(count):
                        laws.parts[at * count + b] = c.problem.parts[(2 * i + component) * k + order[b]]
        if PAIRED and is_second(c, i):
            laws.law[a], laws.way[a] = SECOND, c.signs[i]
        elif c.rows.pushes[i] == 0 and c.rows.partner[i] >= 0:
            laws.kappa[a], laws.way[a] = bound_of(c, i, part), c.signs[i]
            laws.beta[a] = bound_of(c, i, part) * c.problem.apart[2 * i] if POISSON else 0.0
            for b in range(count):
                if order[b] == c.rows.partner[i]:
                    laws.presser[a] = b


@exact()
def rested(c: Choice, count: int) -> bool:
    """Whether all rows of a part rest in the motion found, and did before."""
    for a in range(count):
        at = MODE_NUMBERS * c.box.order[a]
        if c.laws.state[a] != ON or (c.before[at + HELD] == 0.0 and c.before[at + CONSTANT] == 0.0):
            return False
    return True


@exact()
def find_carriers_of_part(c: Choice, count: int) -> None:
    """Say of each row at rest that others determine which one carries it, if that is one with two bounds.

    ``part`` is -1 for rows that are put into force, the number of rows for those that keep their forces.
    """
    order, laws = c.box.order, c.laws
    find_dependent(count, laws)
    for b in range(count):
        j, owners, owner = order[b], 0, -1
        c.part[j] = -1
        if laws.depends[b] == 2:
            for a in range(count):
                if laws.depends[a] == 1 and abs(laws.slopes[a * count + b]) > NO_FACTOR:
                    owners += 1 if c.rows.pushes[order[a]] == 0 else 2
                    owner, c.factors[j] = order[a], laws.slopes[a * count + b]
            # a reaction follows how rows share a force: where a bound depends on one, each row keeps its part
            c.part[j] = owner if owners == 1 and not (PAIRED or has_reaction(c, count)) else c.rows.count


@exact()
def stays_open(c: Choice, count: int, i: int) -> bool:
    """Whether a gap without a force was open before, where a row of its part breaks loose: nothing closes it."""
    at, breaks = MODE_NUMBERS * i, 0
    for a in range(count):
        breaks += c.found.broken[c.box.order[a]]
    return bool(breaks > 0 and c.before[at + HELD] == 0.0 and c.before[at + CONSTANT] == 0.0 and c.shut[i] == 0)


@exact()
def let_gaps_close(count: int, laws: Laws) -> None:
    """Let gaps push that have stayed open while forces were found."""
    for a in range(count):
        laws.law[a] = PUSH if laws.law[a] == NOTHING else laws.law[a]


@exact()
def find_forces_of_part(c: Choice, count: int) -> bool:
    """Find forces that obey all laws; gaps that have just opened, or may go on so, stay open unless they would close.

    What balances leaves rounding alone, which tells nothing of what closes.
    """
    laws, closes = c.laws, False
    for a in range(count):
        i = c.box.order[a]
        if c.rows.pushes[i] != 0 and (c.loose[i] != 0 or stays_open(c, count, i)):
            laws.law[a] = NOTHING
    found = find_forces(count, laws, 1)
    for a in range(count):
        if laws.law[a] == NOTHING:
            least = larger_number(size_of_terms(count, a, laws), laws.usual[a])
            closes = closes or laws.left[a] < -NO_ACCELERATION * least
    if not found or closes:
        let_gaps_close(count, laws)
        found = find_forces(count, laws, 1)
    return bool(found)


@exact()
def is_still(c: Choice, count: int, a: int, part: float) -> bool:
    """Whether the acceleration of a row is below a part of what it is a difference of."""
    return bool(abs(c.laws.left[a]) <= part * size_of_terms(count, a, c.laws))


@exact()
def part_used(c: Choice, count: int, a: int) -> float:
    """Return the part of its bound that the force of a row is; 0 for rows without one."""
    laws, bound = c.laws, load_bound(count, a, c.laws)
    return float(abs(laws.forces[a] - middle_of(a, load_of(count, a, laws), laws)) / bound if bound > 0.0 else 0.0)


@exact()
def settle_at_bounds(c: Choice, count: int) -> None:
    """Decide what forces leave open: gaps without a force stay closed, and rows at their bounds move if they are loose.

    Only rounding would tell whether a gap that nothing presses opens where nothing accelerates it, or its friction.
    """
    laws = c.laws
    for a in range(count):
        i, still = c.box.order[a], is_still(c, count, a, NO_ACCELERATION)
        if PAIRED and is_first(c, i):
            both = still and is_still(c, count, a + 1, NO_ACCELERATION)
            settle_pair(a, i, both, load_bound(count, a, laws), c.loose, c)
            continue
        if laws.law[a] == PUSH and laws.state[a] == OFF and c.loose[i] == 0 and still:
            laws.state[a] = OFF if stays_open(c, count, i) else ON
        if laws.law[a] == BALL and c.loose[i] == 0 and still and laws.way[a] == 0.0 and laws.state[a] != OFF:
            laws.state[a] = ON
        if laws.law[a] == BALL and laws.state[a] == ON and c.loose[i] != 0:
            bound = load_bound(count, a, laws)
            if bound > 0.0 and abs(laws.forces[a]) >= AT_BOUND * bound:
                laws.state[a] = UPPER if laws.forces[a] > 0.0 else LOWER


@exact()
def name_different(c: Choice, count: int) -> None:
    """Name the rows of a part that differ in two motions."""
    differ = 0
    for a in range(count):
        if c.laws.state[a] != c.laws.other[a]:
            c.named[differ] = c.box.order[a]
            differ += 1
    c.named[differ] = -1


@exact()
def name_fault(c: Choice, count: int) -> None:
    """Name the contact of a part that comes nearest to jamming, with what is left of its mobility."""
    k, least = c.rows.count, math.inf
    for a in range(count):
        i = c.box.order[a]
        j = c.rows.partner[i]
        if c.rows.pushes[i] != 0:
            if least == math.inf:
                c.named[0], c.jam[0] = i, c.problem.matrix[i * k + i]
            if j >= 0 and c.problem.matrix[i * k + i] > 0.0:
                turned = c.read.sliding[j] * c.problem.matrix[i * k + j]
                if PAIRED and is_first(c, j):
                    other = c.read.sliding[j] * c.problem.matrix[i * k + j + 1]
                    size = math.sqrt(turned * turned + other * other)
                    turned = c.signs[j] * turned + c.signs[j + 1] * other if c.signs[j] != 0.0 else size
                else:
                    turned = c.signs[j] * turned if c.signs[j] != 0.0 else abs(turned)
                left = c.problem.matrix[i * k + i] - turned
                if left / c.problem.matrix[i * k + i] < least:
                    c.named[0], c.jam[0], least = i, left, left / c.problem.matrix[i * k + i]


@exact(entry=True)
def solve_by_laws(c: Choice, count: int, part: float) -> int:
    """Find the modes of a part with a part of the bounds at rest.

    Returns `SAME`, `NO_CONTACT_MODES`, `NOTHING_FOUND` or `SEVERAL_MODES`.

    Where bounds depend on reactions, `DISAGREED` or `SEVERAL_BY_REACTION` with the rows that differ.
    """
    order, laws, reacts = c.box.order, c.laws, has_reaction(c, count)
    fill_part(c, count, part)
    if not find_forces_of_part(c, count):
        name_fault(c, count)
        if reacts:
            return DISAGREED
        if c.jam[0] <= 0.0:
            return NO_CONTACT_MODES
        c.jam[0] = float(count)
        return NOTHING_FOUND
    share_forces(count, laws)
    let_gaps_close(count, laws)
    settle_at_bounds(c, count)
    motions = count_motions(count, laws)
    several = motions == SEVERAL_MOTIONS
    c.unsought[0] = max(c.unsought[0], count if motions == NOT_SOUGHT else 0)
    if motions == NOT_SOUGHT and not rested(c, count):
        several = seek_another(count, laws)
    for a in range(count):
        i = order[a]
        c.best[i], c.other[i], c.trial[i] = laws.state[a], laws.other[a], laws.left[a]
        c.forces[i] = laws.forces[a] - c.read.middle[i]
        c.sizes[i] = load_of(count, a, laws) if by_reaction(c, i) else 1.0
    for a in range(count):  # the friction of an open contact is off
        i = order[a]
        if c.rows.pushes[i] == 0 and c.rows.partner[i] >= 0 and c.best[c.rows.partner[i]] == OFF:
            c.best[i] = c.best[i] if POISSON and c.problem.apart[2 * i] > 0.0 else OFF
    find_carriers_of_part(c, count)
    if several and reacts:
        name_different(c, count)
        return SEVERAL_BY_REACTION
    if several:
        name_fault(c, count)
    return SEVERAL_MODES if several else SAME
