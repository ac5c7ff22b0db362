"""Which modes of a part are right, compiled: every combination is solved for, and verified.

A combination is right where its forces are within their bounds and accelerations have the signs of its modes. Such a
problem has no minimum, and may have no solution, or several: all are sought.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.run.effects.pushing import POISSON
from symgen.run.modes.bounded_rows import (
    NO_CONTACT_MODES,
    ROUNDED,
    SAME,
    SEVERAL_MODES,
    Choice,
)
from symgen.run.modes.contact_combinations import (
    OFF,
    ON,
    UPPER,
    next_combination,
    press,
    set_combination,
    solve_combination,
)
from symgen.run.modes.contact_laws import solve_by_laws
from symgen.run.modes.contact_parts import has_reaction

#: Rounding of accelerations and forces over what they are differences of, and of those that are solved for.
_ROUNDING, _SOLVED = 1e-10, 1e-7
#: Accelerations of two solutions that differ by less than this part are one.
_ONE = 1e-7
#: Most contacts that depend on each other, and most rows of their part, of which all combinations are tried.
_MOST_CONTACTS, _MOST_ROWS = 4, 10


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
        box.left[i] = total
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
def is_same(c: Choice, count: int) -> bool:
    """Return whether a combination has the accelerations of the first one that is right.

    Differences are compared with the accelerations that the forces of all rows make at bodies alone. Where no force
    acts along a row, its acceleration is rounding of other rows.
    """
    k, box, most = c.count, c.box, 0.0
    for a in range(count):
        j = box.order[a]
        most += math.sqrt(abs(c.matrix[j * k + j])) * (abs(box.forces[j]) + abs(c.forces[j]))
    for a in range(count):
        i = box.order[a]
        size = abs(c.offset[i]) + math.sqrt(abs(c.matrix[i * k + i])) * most
        if abs(box.left[i] - c.trial[i]) > _ONE * size:
            return False
    return True


@exact()
def has_middle(c: Choice, count: int) -> bool:
    """Whether bounds at rest of a row of a part have another middle than those in motion."""
    for a in range(count):
        if c.middle[c.box.order[a]] != 0.0:
            return True
    return False


@exact()
def try_combinations(c: Choice, count: int) -> int:
    """Find the modes of a part; return `SAME`, or what `solve_by_laws` does.

    Combinations with equal accelerations are one: forces may be several. Those of many rows, and
    with bounds of two directions or by reactions, are not tried.
    """
    box, solutions, contacts = c.box, 0, 0
    for a in range(count):
        i = box.order[a]
        contacts += 1 if c.pushes[i] != 0 else 0
        c.option[i] = 0
    if contacts > _MOST_CONTACTS or count > _MOST_ROWS or has_middle(c, count) or POISSON or has_reaction(c, count):
        code = solve_by_laws(c, count)
        if code == NO_CONTACT_MODES or code == SEVERAL_MODES:
            name_fault(c, count)
        return int(code)
    more = True
    while more:
        if set_combination(c, count) and solve_combination(c, count) and is_right(c, count):
            if solutions == 0:
                solutions = 1
                for a in range(count):
                    i = box.order[a]
                    c.best[i], c.part[i] = c.mode[i], c.carrier[i]
                    c.forces[i], c.trial[i], c.bounds[i] = box.forces[i], box.left[i], c.sizes[i]
            elif solutions == 1 and not is_same(c, count):
                solutions = 2
                for a in range(count):
                    c.other[box.order[a]] = c.mode[box.order[a]]
        more = next_combination(c, count)
    if solutions == 0:
        name_fault(c, count)
        return NO_CONTACT_MODES
    if solutions == 2:
        name_fault(c, count)
        return SEVERAL_MODES
    return SAME
