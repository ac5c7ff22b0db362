"""Combinations of modes of the rows of a part, compiled: each is a small linear system.

In a combination the accelerations of some rows are 0, and forces at bounds are multiples of others: a sliding contact
pushes along ``W_N - s mu W_T``. Friction that depends on others, as that of two feet of a block does, has an equal part
of its bound.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.run.layout.scales import larger_number
from symgen.run.modes.bounded_rows import NO_FACTOR, Choice

#: Modes of rows in a combination: without force, in force, at the upper and at the lower bound.
OFF, ON, UPPER, LOWER = range(4)
#: Pivots below this part of the diagonal are rounding.
_NO_PIVOT = 1e-11
#: Rounds in which forces that rows share come to equal parts of their bounds.
_SHARING = 30


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
def bound_of(c: Choice, i: int) -> float:
    """Return the bound of a row in a combination, of a contact over the force that presses; sliding has its own."""
    return float(c.sliding[i] if c.loose[i] != 0 or c.signs[i] != 0.0 else c.static[i])


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
