"""The problem of rows with bounds: one matrix, and one of two laws for each row; numbers only.

Forces c enter accelerations linearly, ``a = a0 - G c`` with ``G >= 0``. A row *pushes*: ``c <= 0``, ``a >= 0``, and one
of both is 0. Or it is a *ball* ``|c - m| <= B``: it rests, ``a = 0``, or begins to move, ``c = m + B`` with ``a >= 0``
or ``c = m - B`` with ``a <= 0``; in motion its way is known, ``c = s B``. A ball may have two rows, in a plane: |c|
is a length then, and c has the direction of a. The bound is ``B = beta + kappa load``: the load is the force of a row
that pushes, or the size of a reaction with up to three components, ``|n0 - N c|``.

Rates are accelerations and impulses are forces at an impact: the laws are the same.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.layout.scales import larger_number

#: Laws of rows: it pushes; it is a ball, or the second row of the ball before it; it has no force.
PUSH, BALL, SECOND, NOTHING = range(4)
#: What a row does: no force; rest, or a gap that stays closed; at its upper and at its lower bound.
OFF, ON, UPPER, LOWER = range(4)
#: Most components of a load; a size that is no divisor of zero.
COMPONENTS, TINY = 3, 1e-300
#: Accelerations below a tiny part of usual ones are rounding: problems count as large as this part of them at least.
_USUAL = 1e-2


class Laws(Record):
    """A problem of up to k rows, its solution and working memory. With n rows, matrices have n rows of n numbers.

    Attributes
    ----------
    matrix, offset : Array, shapes (k k,), (k,)
        G and a0.
    usual : Array, shape (k,)
        Accelerations whose rounding a0 has, 0 where it is exact: what balances each other leaves nothing else.
    law : Array of int64, shape (k,)
        `PUSH`, `BALL`, `SECOND` or `NOTHING`.
    way : Array, shape (k,)
        Direction of the force of a ball in motion, of length 1; 0 at rest.
    beta, kappa, middle : Array, shapes (k,)
        Bound without a load, and over the load; the middle m of a ball of one row, over a reaction that is its load.
    presser : Array of int64, shape (k,)
        Row that pushes whose force is the load, -1 for none.
    components : Array of int64, shape (k,)
        Components of the reaction that is the load, 0 for none.
    apart, parts : Array, shapes (3 k,), (3 k k,)
        Reactions without forces, n0, and N: three for each row.
    forces, left : Array, shapes (k,)
        C and a.
    state : Array of int64, shape (k,)
        `OFF`, `ON`, `UPPER` or `LOWER`.
    other : Array of int64, shape (k,)
        States of a second motion, where there are several.
    root : Array, shape (k,)
        Roots of own mobilities, 1 for rows that nothing moves: units cancel by them.
    slopes, right, kept, first, column, option, does, depends : Array, Array of int64
        Working memory.
    """

    matrix: Array
    offset: Array
    usual: Array
    law: Integers
    way: Array
    beta: Array
    kappa: Array
    middle: Array
    presser: Integers
    components: Integers
    apart: Array
    parts: Array
    forces: Array
    left: Array
    state: Integers
    other: Integers
    root: Array
    slopes: Array
    right: Array
    kept: Array
    first: Array
    column: Integers
    option: Integers
    does: Integers
    depends: Integers


def new_laws(k: int) -> Any:
    """Return memory for a problem of `k` rows."""
    whole = {"law", "presser", "components", "state", "other", "column", "option", "does", "depends"}
    longer = {"matrix": k * k, "slopes": k * k, "first": 2 * k, "apart": COMPONENTS * k, "parts": COMPONENTS * k * k}
    kinds = {x: np.int64 if x in whole else np.float64 for x in Laws._fields}
    return Laws._make(np.zeros(longer.get(x, k), dtype=kind) for x, kind in kinds.items())


@exact()
def begin_row(n: int, i: int, laws: Laws) -> None:
    """Make a row one that pushes, without anything that its law depends on."""
    laws.law[i], laws.presser[i], laws.components[i] = PUSH, -1, 0
    laws.way[i] = laws.beta[i] = laws.kappa[i] = laws.middle[i] = laws.usual[i] = 0.0
    for part in range(COMPONENTS):
        laws.apart[COMPONENTS * i + part] = 0.0
        for j in range(n):
            laws.parts[(COMPONENTS * i + part) * n + j] = 0.0


@exact()
def acceleration_of(n: int, i: int, laws: Laws) -> float:
    """Return the acceleration that the present forces leave."""
    total = laws.offset[i]
    for j in range(n):
        total -= laws.matrix[i * n + j] * laws.forces[j]
    return float(total)


@exact()
def reaction_of(n: int, i: int, part: int, laws: Laws) -> float:
    """Return a component of the reaction that is the load of a row."""
    total, at = laws.apart[COMPONENTS * i + part], (COMPONENTS * i + part) * n
    for j in range(n):
        total -= laws.parts[at + j] * laws.forces[j]
    return float(total)


@exact()
def load_of(n: int, i: int, laws: Laws) -> float:
    """Return the load of a row, 0 without one."""
    if laws.presser[i] >= 0:
        return float(larger_number(-laws.forces[laws.presser[i]], 0.0))
    square = 0.0
    for part in range(laws.components[i]):
        x = reaction_of(n, i, part, laws)
        square += x * x
    return math.sqrt(square)


@exact()
def load_within(n: int, i: int, chosen: bool, laws: Laws) -> float:
    """Return the load of a row in the equations of Newton's method: in `chosen` states a force of any sign."""
    if chosen and laws.presser[i] >= 0:
        return float(-laws.forces[laws.presser[i]])
    return float(load_of(n, i, laws))


@exact()
def bound_of(n: int, i: int, laws: Laws) -> float:
    """Return B at the present forces."""
    return float(laws.beta[i] + laws.kappa[i] * load_of(n, i, laws))


@exact()
def middle_of(i: int, load: float, laws: Laws) -> float:
    """Return the middle of the bounds of a ball at rest."""
    return float(laws.middle[i] * (load if laws.components[i] > 0 else 1.0))


@exact()
def slope_of_load(n: int, i: int, j: int, load: float, chosen: bool, laws: Laws) -> float:
    """Return the derivative of `load_within` by a force."""
    if laws.presser[i] >= 0:
        return -1.0 if laws.presser[i] == j and (chosen or load > 0.0) else 0.0
    slope = 0.0
    if load > 0.0:
        for part in range(laws.components[i]):
            slope -= reaction_of(n, i, part, laws) * laws.parts[(COMPONENTS * i + part) * n + j] / load
    return slope


@exact()
def rows_of(n: int, i: int, laws: Laws) -> int:
    """Return the number of rows of a ball."""
    return 2 if i + 1 < n and laws.law[i + 1] == SECOND else 1


@exact()
def mobility_of(n: int, i: int, laws: Laws) -> float:
    """Return the own mobility of a law, of the ball of a second row."""
    first = i - 1 if laws.law[i] == SECOND else i
    if rows_of(n, first, laws) == 2:
        return float(0.5 * (laws.matrix[first * n + first] + laws.matrix[(first + 1) * n + first + 1]))
    return float(laws.matrix[i * n + i])


@exact()
def size_of_offset(i: int, laws: Laws) -> float:
    """Return the size of the acceleration of a row without forces, of what balances that of what there may be."""
    return float(larger_number(abs(laws.offset[i]), _USUAL * laws.usual[i]))


@exact()
def weigh_laws(n: int, laws: Laws) -> float:
    """Set the roots of mobilities; return the largest acceleration without forces, or by forces in motion, over its."""
    most = TINY
    for i in range(n):
        own, square = mobility_of(n, i, laws), 0.0
        laws.root[i] = math.sqrt(own) if own > 0.0 else 1.0
        most = larger_number(most, size_of_offset(i, laws) / laws.root[i] if own > 0.0 else 0.0)
        if laws.way[i] != 0.0:
            for part in range(laws.components[i]):
                square += laws.apart[COMPONENTS * i + part] ** 2
            most = larger_number(most, (laws.beta[i] + laws.kappa[i] * math.sqrt(square)) * laws.root[i])
    return float(most)
