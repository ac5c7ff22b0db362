"""Solvers of starts: shortest changes, and whole turns of angles.

A shortest change is the x with D x = right whose x / scale is shortest, for D of any rank, dense or sparse. Its solvers
use the results of ``geometry`` in the scratch array, and weigh rows so that all have the unit of length.

Directions determine the angle between them up to whole turns only. The section ``winding`` stores the angle;
``measure``, called after ``geometry`` at the same state, follows it from state to now. At a start it begins on the
branch of (-pi, pi] and is shifted here by whole turns.

All are passed to the functions of a start as first-class functions: copied to every call, they would take seconds to
compile.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.redundancy import row_weight_in_force
from symgen.run.layout.scales import entry_of, free_scale, row_weight
from symgen.run.layout.start_records import Instant, Layout, Work
from symgen.run.starts import decisions


@exact(entry=True)
def dense_change(spread: abi.Move, layout: Layout, now: Instant, work: Work) -> int:
    """Set `work.x` by an orthogonal factorisation of the dense D; return its rank. `spread` is not used."""
    m, n, numbers, x, scale = layout.m, layout.nv, work.numbers, work.x, work.scale
    entries, w = layout.entries, now.w
    for i in range(m * n):
        numbers[i] = 0.0
    for k in range(layout.constants.shape[0]):
        row, column = entries[3 * k], entries[3 * k + 1]
        value = entry_of(layout, w, k) * scale[column]
        numbers[row * n + column] = row_weight_in_force(layout, w, row) * value
    for i in range(m):
        work.right[i] *= row_weight_in_force(layout, w, i)
    rank = least_norm(numbers, m, n, work.right, x, part(numbers, m * n, m * min(m, n) + m + n), work.order)
    for j in range(n):
        x[j] *= scale[j]
    return int(rank)


@exact(entry=True)
def sparse_change(spread: abi.Move, layout: Layout, now: Instant, work: Work) -> int:
    """Set `work.x` without a dense D: by the model's ``spread`` in the metric of the gauge, else by iteration."""
    m, n, w, right, scale, x = layout.m, layout.nv, now.w, work.right, work.scale, work.x
    free = True
    for j in range(n):
        free = free and scale[j] == free_scale(layout, w, j)
    if not free:
        return int(iterated_change(spread, layout, now, work))
    for i in range(m):
        w[layout.residual + i] = -right[i]
    spread(now.p, w)
    for j in range(n):
        x[j] = w[layout.change + j]
    return 0


@exact(entry=True)
def iterated_change(spread: abi.Move, layout: Layout, now: Instant, work: Work) -> int:
    """Set `work.x` by conjugate gradients on the normal equations (CGLS). `spread` is not used.

    The iteration begins at 0 and so never leaves the row space.
    """
    m, n, w, right, scale, x = layout.m, layout.nv, now.w, work.right, work.scale, work.x
    for j in range(n):
        x[j] = 0.0
    gradient, direction = part(work.numbers, 0, n), part(work.numbers, n, n)
    product = part(work.numbers, 2 * n, m)
    size = first = 0.0
    for i in range(m):
        right[i] *= row_weight_in_force(layout, w, i)
    for k in range(decisions.ITERATIONS_A_ROW * m + decisions.ITERATIONS_AT_LEAST):
        _multiply_transposed(layout, w, right, gradient)
        before, size = size, 0.0
        for j in range(n):
            gradient[j] *= scale[j]
            size += gradient[j] * gradient[j]
        first = size if k == 0 else first
        if not size > decisions.GRADIENT_FALL * first:
            break
        for j in range(n):
            direction[j] = gradient[j] + (direction[j] * (size / before) if k > 0 else 0.0)
            gradient[j] = scale[j] * direction[j]
        multiply(layout, w, gradient, product)
        square = 0.0
        for i in range(m):
            product[i] *= row_weight_in_force(layout, w, i)
            square += product[i] * product[i]
        for i in range(m):
            right[i] -= size / square * product[i]
        for j in range(n):
            x[j] += size / square * gradient[j]
    return 0


@exact()
def multiply(layout: Layout, w: Array, x: Array, result: Array) -> None:
    """Set `result` to D x."""
    for i in range(layout.m):
        result[i] = 0.0
    for k in range(layout.constants.shape[0]):
        result[layout.entries[3 * k]] += entry_of(layout, w, k) * x[layout.entries[3 * k + 1]]


@exact()
def _multiply_transposed(layout: Layout, w: Array, y: Array, result: Array) -> None:
    """Set `result` to D^T y, where y belongs to weighed rows."""
    for j in range(layout.nv):
        result[j] = 0.0
    for k in range(layout.constants.shape[0]):
        row = layout.entries[3 * k]
        result[layout.entries[3 * k + 1]] += entry_of(layout, w, k) * (row_weight_in_force(layout, w, row) * y[row])


@exact()
def least_norm(a: Array, m: int, n: int, right: Array, x: Array, room: Array, order: Integers) -> int:
    """Set `x` to the shortest vector that minimises ``|a x - right|`` at a start; see `least_norm_above`."""
    return int(least_norm_above(a, m, n, right, x, room, order, decisions.RANK_CUTOFF))


@exact()
def least_norm_above(
    a: Array, m: int, n: int, right: Array, x: Array, room: Array, order: Integers, cutoff: float
) -> int:
    """Set `x` to the shortest vector that minimises ``|a x - right|``; return the rank of `a`.

    Parameters
    ----------
    a : Array
        Matrix, m x n, row by row; overwritten.
    right : Array, shape (m,)
        Right-hand side; overwritten.
    x : Array, shape (n,)
        Result.
    room : Array
        Working memory for ``m * min(m, n) + m + n`` numbers.
    order : Array of int, shape (m,)
        Order of the rows on return: independent ones first.
    cutoff : float
        Rows whose independent part is below this, times the largest row, depend on others.

    Notes
    -----
    Householder's reflections from the right with pivoting of rows give ``a = P L Q^T``; where rows depend on others,
    the trapezoid L is reduced from the left as well (a complete orthogonal decomposition; Golub, Van Loan, Matrix
    Computations, section 5.5).
    """
    beta = 0  # offsets in the working memory: factors of the reflections, then the trapezoid
    trapezoid = n + m
    for i in range(m):
        order[i] = i
    rank, first = 0, 0.0
    for k in range(min(m, n)):
        best, at = 0.0, k
        for i in range(k, m):
            row = order[i] * n
            square = 0.0
            for j in range(k, n):
                square += a[row + j] * a[row + j]
            if square > best:
                best, at = square, i
        size = math.sqrt(best)
        if k == 0:
            first = size
        if not size > cutoff * first:
            break
        order[k], order[at] = order[at], order[k]
        row = order[k] * n
        # the reflection maps the rest of the row to its first component, away from cancellation
        head = a[row + k]
        diagonal = -size if head > 0.0 else size
        a[row + k] = head - diagonal
        room[beta + k] = -1.0 / (diagonal * (head - diagonal))
        for i in range(k + 1, m):
            other = order[i] * n
            total = 0.0
            for j in range(k, n):
                total += a[row + j] * a[other + j]
            total *= room[beta + k]
            for j in range(k, n):
                a[other + j] -= total * a[row + j]
        x[k] = diagonal  # kept here until the trapezoid is written
        rank += 1
    for i in range(m):
        for k in range(min(i, rank)):
            room[trapezoid + i * rank + k] = a[order[i] * n + k]
        for k in range(i, rank):
            room[trapezoid + i * rank + k] = x[k] if k == i else 0.0
        room[n + i] = right[order[i]]
    for i in range(m):
        right[i] = room[n + i]
    if rank < m:
        _reduce_rows(room, trapezoid, m, rank, right)
        for k in range(rank - 1, -1, -1):
            total = right[k]
            for j in range(k + 1, rank):
                total -= room[trapezoid + k * rank + j] * x[j]
            x[k] = total / room[trapezoid + k * rank + k]
    else:
        for k in range(rank):
            total = right[k]
            for j in range(k):
                total -= room[trapezoid + k * rank + j] * x[j]
            x[k] = total / room[trapezoid + k * rank + k]
    for j in range(rank, n):
        x[j] = 0.0
    for k in range(rank - 1, -1, -1):
        row = order[k] * n
        total = 0.0
        for j in range(k, n):
            total += a[row + j] * x[j]
        total *= room[beta + k]
        for j in range(k, n):
            x[j] -= total * a[row + j]
    return rank


@exact()
def _reduce_rows(matrix: Array, at: int, m: int, n: int, right: Array) -> None:
    """Reflect the columns of a matrix of full rank, m x n from index `at` on: leave R and Q^T right."""
    for k in range(n):
        square = 0.0
        for i in range(k, m):
            square += matrix[at + i * n + k] * matrix[at + i * n + k]
        head = matrix[at + k * n + k]
        size = math.sqrt(square)
        diagonal = -size if head > 0.0 else size
        factor = -1.0 / (diagonal * (head - diagonal))
        matrix[at + k * n + k] = head - diagonal
        for j in range(k + 1, n):
            total = 0.0
            for i in range(k, m):
                total += matrix[at + i * n + k] * matrix[at + i * n + j]
            total *= factor
            for i in range(k, m):
                matrix[at + i * n + j] -= total * matrix[at + i * n + k]
        total = 0.0
        for i in range(k, m):
            total += matrix[at + i * n + k] * right[i]
        total *= factor
        for i in range(k, m):
            right[i] -= total * matrix[at + i * n + k]
        matrix[at + k * n + k] = diagonal


# -- whole turns -------------------------------------------------------------------------------------------------------


@exact(entry=True)
def choose_turns(geometry: abi.Measure, measure: abi.Measure, layout: Layout, now: Instant, work: Work) -> int:
    """Shift the section ``winding`` by the whole turns with which the rows on angles are nearest to closed.

    Parameters
    ----------
    geometry, measure : emitted functions
        See `symgen.run.layout.abi`.
    layout, now, work : Layout, Instant, Work
        See `symgen.run.layout.start_records`; the coordinates are those described.
    """
    m, count, w, residual = layout.m, layout.windings, now.w, layout.residual
    rest, effects = work.right, work.numbers
    for i in range(count):
        w[abi.WINDING + i] = 0.0
    geometry(layout.t, now.y, now.p, w)
    finite = True
    for r in range(m):
        rest[r] = w[residual + r]
        finite = finite and math.isfinite(rest[r])
    measure(layout.t, now.y, now.p, w)  # from here on the section of the residual may hold other values
    for i in range(count):
        angle = w[abi.WINDING + i]
        w[abi.WINDING + i] = angle + math.tau
        geometry(layout.t, now.y, now.p, w)
        w[abi.WINDING + i] = angle
        for r in range(m):
            effect = w[residual + r] - rest[r]
            finite = finite and math.isfinite(effect)
            least = decisions.LEAST_EFFECT * w[abi.LENGTH] / row_weight(layout, w, r)
            effects[r * count + i] = effect if abs(effect) >= least else 0.0
    if finite:
        turns = m * count
        whole_turns(m, count, effects, rest, turns)
        for i in range(count):
            w[abi.WINDING + i] += math.tau * effects[turns + i]
    return 0


@exact()
def whole_turns(m: int, count: int, effects: Array, rest: Array, turns: int) -> None:
    """Set the number of turns to add to each angle.

    Parameters
    ----------
    m, count : int
        Rows and angles.
    effects : Array, shape (m * count + 2 * count + m,)
        Change of the residual of each row by one turn of each angle, row by row; then room for the result.
    rest : Array, shape (m,)
        The residual without turns; on return with turns.
    turns : int
        First index of the result in `effects`.

    Notes
    -----
    Rows are taken in turn, first those with a single angle to shift (drivers, then angles that gears couple to them),
    among these the ones on which a turn has the largest effect. A row with several such angles is closed by the one
    that closes it best, and the others stay free for further rows.
    """
    free, waiting = turns + count, turns + 2 * count
    for k in range(turns, waiting + m):
        effects[k] = 0.0
    for r in range(m):
        for i in range(count):
            if effects[r * count + i] != 0.0:
                effects[free + i] = effects[waiting + r] = 1.0
    for _ in range(m):
        row, least, largest = -1, count + 1, 0.0
        for r in range(m):
            if effects[waiting + r] != 0.0:
                choices, size = 0, 0.0
                for i in range(count):
                    effect = abs(effects[r * count + i])
                    choices += 1 if effect != 0.0 and effects[free + i] != 0.0 else 0
                    size = effect if effect > size else size
                if choices < least or (choices == least and size > largest):
                    row, least, largest = r, choices, size
        if row < 0:
            return
        effects[waiting + row] = 0.0
        column, best, turn_count = -1, math.inf, 0.0
        for i in range(count):
            effect = effects[row * count + i]
            if effect != 0.0 and effects[free + i] != 0.0:
                number = float(round(-rest[row] / effect))
                left = abs(rest[row] + number * effect)
                if left < best:
                    column, best, turn_count = i, left, number
        if column >= 0:
            effects[turns + column] = turn_count
            effects[free + column] = 0.0
            for r in range(m):
                rest[r] += turn_count * effects[r * count + column]


@exact(entry=True)
def choose_no_turns(geometry: abi.Measure, measure: abi.Measure, layout: Layout, now: Instant, work: Work) -> int:
    """Replace `choose_turns` where no angle counts turns, so that it is not compiled."""
    return 0
