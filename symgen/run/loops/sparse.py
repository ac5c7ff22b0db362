"""Sparse elimination of Newton matrices: one pattern a run, columns in a fixed order, pivots kept while they are good.

A *plan* (`symgen.run.loops.newton`) holds the pattern, and how its entries are assembled from the output of
``tangent``. The first factorisation is left-looking (Gilbert, Peierls, SIAM J. Sci. Stat. Comput. 9, 1988): each column
is solved with those before it, and its pivot is the diagonal entry unless that is much smaller than the largest one.
Later matrices reuse the pattern and the pivots without a search, until a pivot has become small.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.bare import part
from symgen.compile.native.annotations import Array, Integers
from symgen.compile.store.jit import jit

#: Head of a plan: sizes, then first indices of its parts.
(
    SIZE,  # unknowns
    ENTRIES,  # structural entries of the matrix
    TERMS,  # terms of entries
    PRODUCTS,
    TURNS,
    ROOM,  # room for entries of L and U
    FACTORISED,  # 1 if pivots of an earlier matrix can be tried
    COLUMNS,  # first entry of each column, columns in the order of elimination
    ROWS,  # row of each entry
    PLACES,  # position of that row's pivot
    ORDER,  # column at each position
    SLOTS,  # entry of each term
    FACTORS,  # coefficient of each term
    SOURCES,  # source of each term
    TARGETS,  # source to which a product is added
    LEFT,
    RIGHT,
    TRIPLES,  # sources of a rotation vector's entries of one row, and first index of its body's velocities
    OWN,  # at each position the entry of an acceleration in its own equation, or else `OTHER` or `MULTIPLIER`
    WORK,  # working memory: nine times `SIZE`
    POOL,  # positions of the entries of L and U
) = range(21)
N_HEAD = 21
#: Parts of the working memory, each as long as the number of unknowns.
_PLACE, _UPPER, _LOWER, _END, _REACHED, _MARK, _STACK, _NEXT, _PIVOT_ROW = range(9)

#: In place of the entry of an acceleration: an unknown of another kind.
OTHER, MULTIPLIER = -1, -2
#: In place of `FACTORISED`: there was no room for the factors.
_TOO_SMALL = -1
#: A pivot below this belongs to a dependent equation (rows and columns are scaled to 1): its unknown is set to 0. For
#: accelerations the limit is this fraction of the mass.
SKIPPED = 1e-13
#: The diagonal entry is the pivot if it is at least this fraction of the largest candidate, to keep the fill low.
PREFERRED = 1e-3
#: A pivot of an earlier matrix is good while it is at least this fraction of the largest candidate.
THRESHOLD = 1e-4


@jit()
def multiply_sources(plan: Integers, sources: Array) -> None:
    """Set the sources that are sums of products of others: derivatives along bodies' motions, and D^T D."""
    targets, left = part(plan, plan[TARGETS], plan[PRODUCTS]), part(plan, plan[LEFT], plan[PRODUCTS])
    right = part(plan, plan[RIGHT], plan[PRODUCTS])
    for i in range(plan[PRODUCTS]):
        sources[targets[i]] = 0.0
    for i in range(plan[PRODUCTS]):
        sources[targets[i]] += sources[left[i]] * sources[right[i]]


@jit()
def turn_rows(plan: Integers, sources: Array, delta: Array) -> None:
    """Convert derivatives by a rotation to derivatives by its rotation vector d.

    Where d grows by e, the body turns by T e more, ``T = 1 - d x / 2 + d x d x / 6`` up to terms of third order.

    Parameters
    ----------
    plan, sources : Array
        As in `assemble_matrix`.
    delta : Array, shape (nv,)
        The change of position at which the Jacobian is wanted.
    """
    for k in range(plan[TURNS]):
        base = plan[TRIPLES] + 4 * k
        first, second, third, j = plan[base], plan[base + 1], plan[base + 2], plan[base + 3]
        x, y, z = delta[j], delta[j + 1], delta[j + 2]
        a, b, c = sources[first], sources[second], sources[third]
        # a row times d x is the cross product of both
        u, v, w = b * z - c * y, c * x - a * z, a * y - b * x
        sources[first] = a - 0.5 * u + (v * z - w * y) / 6.0
        sources[second] = b - 0.5 * v + (w * x - u * z) / 6.0
        sources[third] = c - 0.5 * w + (u * y - v * x) / 6.0


@jit()
def assemble_matrix(plan: Integers, sources: Array, coefficients: Array, numbers: Array) -> None:
    """Write the entries of the matrix: sums of coefficients times sources.

    Parameters
    ----------
    plan : Array of int64
        See `symgen.run.loops.newton`.
    sources : Array
        Output of ``tangent`` for each stage, then products, then 1.
    coefficients : Array
        Factors of the loop: 1, multiples of the step.
    numbers : Array
        The plan's numbers; entries are the first.
    """
    slots, factors = part(plan, plan[SLOTS], plan[TERMS]), part(plan, plan[FACTORS], plan[TERMS])
    origin = part(plan, plan[SOURCES], plan[TERMS])
    for i in range(plan[ENTRIES]):
        numbers[i] = 0.0
    for i in range(plan[TERMS]):
        numbers[slots[i]] += coefficients[factors[i]] * sources[origin[i]]


@jit()
def prepare_pattern(plan: Integers, sources: Array, coefficients: Array, numbers: Array) -> int:
    """Assemble and factorise a matrix; return the count of skipped pivots, -1 where `enlarge_pattern` is needed."""
    assemble_matrix(plan, sources, coefficients, numbers)
    skipped = factorise(plan, numbers)
    if skipped < 0:
        plan[FACTORISED] = _TOO_SMALL
    return int(skipped)


def enlarge_pattern(
    plan: NDArray[np.int64], numbers: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return a plan and its numbers with twice the room for factors, where `prepare_pattern` had too little."""
    if plan[FACTORISED] != _TOO_SMALL:
        return plan, numbers
    more = int(plan[ROOM])  # factors are at the end of both
    plan, numbers = np.append(plan, np.zeros(more, dtype=np.int64)), np.append(numbers, np.zeros(more))
    plan[FACTORISED], plan[ROOM] = 0, 2 * more
    return plan, numbers


@jit(unrolled=True)
def factorise(plan: Integers, numbers: Array) -> int:
    """Factorise the matrix of `assemble_matrix`.

    Parameters
    ----------
    plan, numbers : Array
        Changed: scales, and L and U.

    Returns
    -------
    int
        Number of skipped pivots; -1 without room.

    Notes
    -----
    The largest mass is the unit of multipliers, so that results do not depend on the unit of mass. Rows, then columns
    are scaled so that the largest entry of each is 1. A pivot below `SKIPPED` then belongs to a dependent equation: its
    unknown is set to 0 by `solve`, and its row waits for another column. Without scales of columns, unknowns that stiff
    springs dwarf, above all multipliers, would be taken for undetermined ones. The pivot of an acceleration is compared
    with its own mass, as a light body next to a heavy one is not dependent.
    """
    n, size = plan[SIZE], plan[ENTRIES]
    columns, rows, work = part(plan, plan[COLUMNS], n + 1), part(plan, plan[ROWS], size), plan[WORK]
    values, row_scale = part(numbers, 0, size), part(numbers, size, n)
    column_scale, least = part(numbers, size + n, n), part(numbers, size + 4 * n, n)
    own = part(plan, plan[OWN], n)
    total, unit = 0.0, 0.0
    for k in range(n):
        row_scale[k] = 0.0
        if own[k] >= 0:
            unit = max(unit, abs(values[own[k]]))
    for k in range(n):
        column_scale[k] = unit if own[k] == MULTIPLIER and 0.0 < unit < math.inf else 1.0
        for i in range(columns[k], columns[k + 1]):
            values[i] *= column_scale[k]
            entry = abs(values[i])
            row_scale[rows[i]] = max(row_scale[rows[i]], entry)
            total += entry
    if not math.isfinite(total):  # the solution is unknown: return no made-up one
        inverse = part(numbers, size + 2 * n, n)
        for k in range(n):
            inverse[k] = math.nan
            plan[work + _PLACE * n + k] = plan[work + _PIVOT_ROW * n + k] = k
            plan[work + _UPPER * n + k] = plan[work + _LOWER * n + k] = plan[work + _END * n + k] = 0
        plan[FACTORISED] = 0
        return 0
    for i in range(n):
        row_scale[i] = 1.0 / row_scale[i] if row_scale[i] > 0.0 else 0.0
    for k in range(n):
        largest = 0.0
        for i in range(columns[k], columns[k + 1]):
            values[i] *= row_scale[rows[i]]
            largest = max(largest, abs(values[i]))
        scale = 1.0 / largest if largest > 0.0 else 0.0
        column_scale[k] *= scale
        for i in range(columns[k], columns[k + 1]):
            values[i] *= scale
        mass = abs(values[own[k]]) if own[k] >= 0 else 0.0
        least[k] = SKIPPED * (mass if mass > 0.0 else 1.0)
    if plan[FACTORISED] == 1 and factorise_again(plan, numbers):
        return 0
    return int(factorise_anew(plan, numbers))


@jit(unrolled=True)
def factorise_again(plan: Integers, numbers: Array) -> bool:
    """Factorise with the pivots and the pattern of `factorise_anew`; return whether they are good enough."""
    n, size, work, room = plan[SIZE], plan[ENTRIES], plan[WORK], plan[ROOM]
    columns, places = part(plan, plan[COLUMNS], n + 1), part(plan, plan[PLACES], size)
    upper, lower = part(plan, work + _UPPER * n, n), part(plan, work + _LOWER * n, n)
    end = part(plan, work + _END * n, n)
    positions = part(plan, plan[POOL], room)
    values, inverse, x = part(numbers, 0, size), part(numbers, size + 2 * n, n), part(numbers, size + 3 * n, n)
    least, pool = part(numbers, size + 4 * n, n), part(numbers, size + 5 * n, room)
    for k in range(n):
        for i in range(columns[k], columns[k + 1]):
            x[places[i]] = values[i]
        for i in range(upper[k], lower[k]):
            j = positions[i]
            u = x[j]
            x[j] = 0.0
            pool[i] = u
            for e in range(lower[j], end[j]):
                x[positions[e]] -= pool[e] * u
        pivot, largest = x[k], 0.0
        x[k] = 0.0
        reciprocal = 1.0 / pivot if pivot != 0.0 else 0.0
        for e in range(lower[k], end[k]):
            entry = x[positions[e]]
            x[positions[e]] = 0.0
            largest = max(largest, abs(entry))
            pool[e] = entry * reciprocal
        if not (abs(pivot) > least[k] and abs(pivot) >= THRESHOLD * largest):
            return False
        inverse[k] = reciprocal
    return True


@jit(unrolled=True)
def factorise_anew(plan: Integers, numbers: Array) -> int:
    """Factorise with a search for pivots; return the number of skipped ones, -1 without room."""
    n, size, work, room = plan[SIZE], plan[ENTRIES], plan[WORK], plan[ROOM]
    columns, rows = part(plan, plan[COLUMNS], n + 1), part(plan, plan[ROWS], size)
    order, places = part(plan, plan[ORDER], n), part(plan, plan[PLACES], size)
    upper, lower = part(plan, work + _UPPER * n, n), part(plan, work + _LOWER * n, n)
    end = part(plan, work + _END * n, n)
    place, pivot_row = part(plan, work + _PLACE * n, n), part(plan, work + _PIVOT_ROW * n, n)
    reached, mark = part(plan, work + _REACHED * n, n), part(plan, work + _MARK * n, n)
    positions = part(plan, plan[POOL], room)
    values, inverse, x = part(numbers, 0, size), part(numbers, size + 2 * n, n), part(numbers, size + 3 * n, n)
    least, pool = part(numbers, size + 4 * n, n), part(numbers, size + 5 * n, room)
    plan[FACTORISED] = 0
    for i in range(n):
        place[i] = pivot_row[i] = mark[i] = -1
    used, skipped = 0, 0
    for k in range(n):
        top = filled_rows(plan, k)
        if used + n - top > room:
            return -1
        for f in range(top, n):
            x[reached[f]] = 0.0
        for i in range(columns[k], columns[k + 1]):
            x[rows[i]] = values[i]
        upper[k] = used
        for f in range(top, n):
            j = place[reached[f]]
            if j >= 0:
                u = x[reached[f]]
                positions[used] = j
                pool[used] = u
                used += 1
                for e in range(lower[j], end[j]):
                    x[positions[e]] -= pool[e] * u
        lower[k] = used
        best, diagonal, at = 0.0, 0.0, -1
        for f in range(top, n):
            r = reached[f]
            if place[r] < 0:
                if abs(x[r]) > best:
                    best, at = abs(x[r]), r
                if r == order[k]:
                    diagonal = abs(x[r])
        if best <= least[k]:
            used = lower[k] = end[k] = upper[k]
            inverse[k] = 0.0
            skipped += 1
        else:
            if diagonal >= PREFERRED * best:
                at = order[k]
            inverse[k] = 1.0 / x[at]
            place[at] = k
            pivot_row[k] = at
            for f in range(top, n):
                if place[reached[f]] < 0:
                    positions[used] = reached[f]
                    pool[used] = x[reached[f]] * inverse[k]
                    used += 1
            end[k] = used
        for f in range(top, n):
            x[reached[f]] = 0.0
    free = 0
    for i in range(n):  # rows that no column has taken go to the places of skipped pivots
        if place[i] < 0:
            while pivot_row[free] >= 0:
                free += 1
            place[i] = free
            pivot_row[free] = i
    for k in range(n):
        for e in range(lower[k], end[k]):
            positions[e] = place[positions[e]]
    for i in range(size):
        places[i] = place[rows[i]]
    plan[FACTORISED] = 1 if skipped == 0 else 0
    return skipped


@jit()
def filled_rows(plan: Integers, k: int) -> int:
    """Find the rows in which column `k` has entries after the elimination of earlier columns, in its order.

    Returns
    -------
    int
        First index of the rows in the section ``found``: the row of an earlier pivot precedes all rows it acts on.
    """
    n, work = plan[SIZE], plan[WORK]
    columns, rows, positions = plan[COLUMNS], plan[ROWS], plan[POOL]
    place, lower = part(plan, work + _PLACE * n, n), part(plan, work + _LOWER * n, n)
    end = part(plan, work + _END * n, n)
    reached, mark = part(plan, work + _REACHED * n, n), part(plan, work + _MARK * n, n)
    stack, following = part(plan, work + _STACK * n, n), part(plan, work + _NEXT * n, n)
    top = n
    for i in range(plan[columns + k], plan[columns + k + 1]):
        if mark[plan[rows + i]] == k:
            continue
        depth = 0
        stack[0] = plan[rows + i]
        following[0] = 0
        mark[stack[0]] = k
        while depth >= 0:
            j = place[stack[depth]]
            deeper = False
            if j >= 0:
                e = lower[j] + following[depth]
                while e < end[j] and not deeper:
                    row = plan[positions + e]
                    e += 1
                    if mark[row] != k:
                        mark[row] = k
                        following[depth] = e - lower[j]
                        depth += 1
                        stack[depth] = row
                        following[depth] = 0
                        deeper = True
            if not deeper:
                top -= 1
                reached[top] = stack[depth]
                depth -= 1
    return int(top)


@jit(unrolled=True)
def solve(plan: Integers, numbers: Array, right: Array, x: Array) -> None:
    """Solve with the factors of `factorise`; `right` and `x` are different arrays."""
    n, size, work, room = plan[SIZE], plan[ENTRIES], plan[WORK], plan[ROOM]
    upper, lower = part(plan, work + _UPPER * n, n), part(plan, work + _LOWER * n, n)
    end, pivot_row = part(plan, work + _END * n, n), part(plan, work + _PIVOT_ROW * n, n)
    order = part(plan, plan[ORDER], n)
    positions = part(plan, plan[POOL], room)
    row_scale, column_scale = part(numbers, size, n), part(numbers, size + n, n)
    inverse, y = part(numbers, size + 2 * n, n), part(numbers, size + 3 * n, n)
    pool = part(numbers, size + 5 * n, room)
    for k in range(n):
        y[k] = right[pivot_row[k]] * row_scale[pivot_row[k]]
    for k in range(n):
        for e in range(lower[k], end[k]):
            y[positions[e]] -= pool[e] * y[k]
    for k in range(n - 1, -1, -1):
        y[k] *= inverse[k]
        for i in range(upper[k], lower[k]):
            y[positions[i]] -= pool[i] * y[k]
    for k in range(n):
        x[order[k]] = y[k] * column_scale[k]
        y[k] = 0.0
