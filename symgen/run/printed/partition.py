"""Coordinate partitioning: independent coordinates and velocities, the states of model exchange, and what follows.

The others follow from the constraints by Newton's method with pivots of all rows and columns. Rows with bounds count
where modes put them into force: some of the independent ones follow from these rows too, and the rest is left.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.scales import fill_jacobian
from symgen.run.layout.start_records import Layout
from symgen.run.printed.partition_tables import Partition, PartitionModel, PartitionTables

#: Rounding of numbers of order 1; pivots below the second are rounding, and those of rows in force below the third.
_EPSILON, _LOST, _DEPENDENT = 2.2e-16, 50 * 2.2e-16, 1e-9
#: Newton's method: most iterations, gaps that are closed, gaps that may be left if they no longer fall.
_ROUNDS, _CLOSED, _NEARLY = 25, 2 * _EPSILON, 1e4 * _EPSILON
#: Another choice of coordinates is made where this one is by this factor worse than where it was made.
POOR = 0.4


# -- rows --------------------------------------------------------------------------------------------------------------


@exact()
def row_counts(switch: int, w: Array, is_imposed: bool) -> bool:
    """Whether a row counts: one with bounds does where it is in force, and imposed."""
    return switch < 0 or (is_imposed and w[switch] != 0.0)


@exact()
def fill_position_row(layout: Layout, tables: PartitionTables, y: Array, row: int, part: Partition, first: int) -> None:
    """Write a row of D as one of changes of coordinates: omega = 2 G e' in body axes."""
    spins, matrix, d = tables.spins, part.matrix, part.d
    q, v, count = 0, row * layout.nv, spins.shape[0] // 2
    for s in range(count + 1):
        end = spins[2 * s] if s < count else layout.nq
        while q < end:
            matrix[first + q] = d[v]
            q += 1
            v += 1
        if s < count:
            a, b, c = d[v], d[v + 1], d[v + 2]
            matrix[first + q] = -2.0 * (a * y[q + 1] + b * y[q + 2] + c * y[q + 3])
            matrix[first + q + 1] = 2.0 * (a * y[q] - b * y[q + 3] + c * y[q + 2])
            matrix[first + q + 2] = 2.0 * (a * y[q + 3] + b * y[q] - c * y[q + 1])
            matrix[first + q + 3] = 2.0 * (-a * y[q + 2] + b * y[q + 1] + c * y[q])
            q += 4
            v += 3


@exact()
def position_rows(
    model: PartitionModel, t: float, y: Array, p: Array, w: Array, part: Partition, is_imposed: bool
) -> float:
    """Write rows of positions, as changes of coordinates in lengths, and what closes the joints; return the gap."""
    layout, geometry, tables = model
    geometry(t, y, p, w)
    return fill_position_rows(layout, tables, y, w, part, is_imposed)


@exact()
def fill_position_rows(
    layout: Layout, tables: PartitionTables, y: Array, w: Array, part: Partition, is_imposed: bool
) -> float:
    """Write rows of positions from the results of ``geometry``, as `position_rows` does."""
    nq, count, spins, matrix, right = layout.nq, tables.holonomic.shape[0], tables.spins, part.matrix, part.right
    length, largest, rows = w[abi.LENGTH], 0.0, count + tables.spins.shape[0] // 2
    fill_jacobian(layout, w, part.d)
    for i in range(rows * nq):
        matrix[i] = 0.0
    for i in range(count):
        row = tables.holonomic[i]
        right[i] = 0.0
        if row_counts(tables.of_positions[i], w, is_imposed):
            fill_position_row(layout, tables, y, row, part, i * nq)
            right[i] = -w[layout.residual + row]
            size = abs(right[i]) * (1.0 / length if tables.measured[row] != 0 else 1.0)
            if not size <= largest:
                largest = size
    for i in range(count, rows):
        e = spins[2 * (i - count)]
        right[i] = (1.0 - y[e] * y[e] - y[e + 1] * y[e + 1] - y[e + 2] * y[e + 2] - y[e + 3] * y[e + 3]) / 2.0
        for k in range(4):
            matrix[i * nq + e + k] = y[e + k]
        if abs(right[i]) > largest:
            largest = abs(right[i])
    for i in range(rows):
        for j in range(nq):
            matrix[i * nq + j] *= length if tables.metres[j] != 0 else 1.0
    return largest


@exact()
def velocity_rows(
    layout: Layout, tables: PartitionTables, y: Array, w: Array, part: Partition, is_imposed: bool
) -> None:
    """Write rows of velocities, D v = nu, as rows of changes of v."""
    nq, nv, matrix, right, d, length = layout.nq, layout.nv, part.matrix, part.right, part.d, w[abi.LENGTH]
    for i in range(layout.m):
        right[i] = 0.0
        for k in range(nv):
            matrix[i * nv + k] = 0.0
        if row_counts(layout.switches[i], w, is_imposed):
            right[i] = w[tables.nu + i]
            for k in range(nv):
                right[i] -= d[i * nv + k] * y[nq + k]
                matrix[i * nv + k] = d[i * nv + k] * (1.0 if tables.angular[k] != 0 else length)


# -- elimination -------------------------------------------------------------------------------------------------------


@exact()
def normalise(part: Partition, rows: int, columns: int) -> None:
    """Divide each row by its largest entry."""
    a, b = part.matrix, part.right
    for i in range(rows):
        largest = 0.0
        for j in range(columns):
            if abs(a[i * columns + j]) > largest:
                largest = abs(a[i * columns + j])
        if largest > 0.0:
            for j in range(columns):
                a[i * columns + j] /= largest
            b[i] /= largest


@exact()
def eliminate_columns(part: Partition, rows: int, columns: int, rank: int, free: Integers, count: int) -> float:
    """Eliminate `rank` columns with the largest pivots, none of them one of the `count` free ones.

    Returns
    -------
    float
        The smallest pivot, rows having a largest entry of 1; 0 where there are too few.
    """
    a, b, row_at, column_at, is_free = part.matrix, part.right, part.row_at, part.column_at, part.is_free
    least, choices = 1.0, 0
    normalise(part, rows, columns)
    for i in range(rows):
        row_at[i] = i
    for j in range(columns):
        is_free[j] = 0
    for k in range(count):
        is_free[free[k]] = 1
    for j in range(columns):
        if is_free[j] == 0:
            column_at[choices] = j
            choices += 1
    for k in range(rank):
        best_row, best_column, best = k, k, 0.0
        for i in range(k, rows):
            line = row_at[i] * columns
            for j in range(k, choices):
                size = abs(a[line + column_at[j]])
                if size > best:
                    best, best_row, best_column = size, i, j
        if not best > _LOST:
            return 0.0
        least = best if best < least else least
        row, column = row_at[best_row], column_at[best_column]
        row_at[best_row], column_at[best_column] = row_at[k], column_at[k]
        row_at[k], column_at[k] = row, column
        for i in range(k + 1, rows):
            line, pivot = row_at[i] * columns, row * columns
            factor = a[line + column] / a[pivot + column]
            if factor != 0.0:
                for j in range(k, choices):
                    a[line + column_at[j]] -= factor * a[pivot + column_at[j]]
                b[row_at[i]] -= factor * b[row]
    return float(least)


@exact()
def solve_dependent(part: Partition, columns: int, rank: int) -> None:
    """Set the changes of the columns that have been eliminated; free columns do not change."""
    a, b, change, row_at, column_at = part.matrix, part.right, part.change, part.row_at, part.column_at
    for j in range(columns):
        change[j] = 0.0
    for k in range(rank - 1, -1, -1):
        total = b[row_at[k]]
        for j in range(k + 1, rank):
            total -= a[row_at[k] * columns + column_at[j]] * change[column_at[j]]
        change[column_at[k]] = total / a[row_at[k] * columns + column_at[k]]


@exact()
def keep_others(part: Partition, columns: int, rank: int, free: Integers, left: Integers) -> None:
    """Write the columns that have not been eliminated to both lists, in their order."""
    for j in range(columns):
        part.is_free[j] = 1
    for k in range(rank):
        part.is_free[part.column_at[k]] = 0
    count = 0
    for j in range(columns):
        if part.is_free[j] != 0:
            free[count] = left[count] = j
            count += 1


@exact()
def choose_within(
    part: Partition,
    rows: int,
    columns: int,
    rank: int,
    switches: Integers,
    free: Integers,
    free_count: int,
    left: Integers,
    side: int,
) -> None:
    """Choose which of the independent columns `free` follow from rows in force too; `left` receives the others.

    Pivots of the rows in force come after the `rank` pivots of the others, whose `switches` are -1.
    """
    a, row_taken, column_taken = part.matrix, part.taken, part.column_at
    least, count, left_count = 1.0, 0, 0
    normalise(part, rows, columns)
    for i in range(rows):
        row_taken[i] = 0
    for j in range(columns):
        part.is_free[j] = column_taken[j] = 0
    for k in range(free_count):
        part.is_free[free[k]] = 1
    for k in range(rank + free_count):
        best_row, best_column, best = -1, -1, _LOST if k < rank else _DEPENDENT
        for i in range(rows):
            if row_taken[i] == 0 and (k >= rank or switches[i] < 0):
                for j in range(columns):
                    size = abs(a[i * columns + j])
                    meant = column_taken[j] == 0 and (part.is_free[j] != 0) == (k >= rank)
                    if meant and size > best:
                        best, best_row, best_column = size, i, j
        if best_row < 0 and k >= rank:
            break
        if best_row >= 0:
            row_taken[best_row] = column_taken[best_column] = 1
            if k >= rank:
                count += 1
                least = best if best < least else least
            for i in range(rows):
                factor = a[i * columns + best_column] / a[best_row * columns + best_column]
                if row_taken[i] == 0 and factor != 0.0:
                    for j in range(columns):
                        a[i * columns + j] -= factor * a[best_row * columns + j]
    for k in range(free_count):
        if column_taken[free[k]] == 0:
            left[left_count] = free[k]
            left_count += 1
    part.held[side], part.best[2 + side] = count, least


# -- the choice --------------------------------------------------------------------------------------------------------


@exact(entry=True)
def choose_states(model: PartitionModel, t: float, y: Array, p: Array, w: Array, part: Partition) -> int:
    """Choose independent coordinates and velocities at a state."""
    layout, _, tables = model
    rows = tables.holonomic.shape[0] + tables.spins.shape[0] // 2
    position_rows(model, t, y, p, w, part, False)
    part.best[0] = eliminate_columns(part, rows, layout.nq, tables.rank_q, part.free_q, 0)
    if part.best[0] > 0.0:
        keep_others(part, layout.nq, tables.rank_q, part.free_q, part.left_q)
    velocity_rows(layout, tables, y, w, part, False)
    part.best[1] = eliminate_columns(part, layout.m, layout.nv, tables.rank_v, part.free_v, 0)
    if part.best[1] > 0.0:
        keep_others(part, layout.nv, tables.rank_v, part.free_v, part.left_v)
    part.held[0] = part.held[1] = 0
    return 0


@exact(entry=True)
def choose_left(model: PartitionModel, t: float, y: Array, p: Array, w: Array, part: Partition) -> int:
    """Choose the coordinates and velocities that rows in force leave independent, at a state."""
    layout, _, tables = model
    rows, free_q, free_v = tables.of_positions.shape[0], layout.nq - tables.rank_q, layout.nv - tables.rank_v
    switches = tables.of_positions, layout.switches
    position_rows(model, t, y, p, w, part, True)
    choose_within(part, rows, layout.nq, tables.rank_q, switches[0], part.free_q, free_q, part.left_q, 0)
    velocity_rows(layout, tables, y, w, part, True)
    choose_within(part, layout.m, layout.nv, tables.rank_v, switches[1], part.free_v, free_v, part.left_v, 1)
    return 0


@exact()
def eliminate_positions(model: PartitionModel, part: Partition, free: Integers, held: int) -> float:
    """Eliminate the dependent coordinates, `held` of them by rows in force; return the smallest pivot."""
    layout, _, tables = model
    rows, rank = tables.holonomic.shape[0] + tables.spins.shape[0] // 2, tables.rank_q + held
    return float(eliminate_columns(part, rows, layout.nq, rank, free, layout.nq - rank))


@exact()
def eliminate_velocities(model: PartitionModel, part: Partition, free: Integers, held: int) -> float:
    """Eliminate the dependent velocities, `held` of them by rows in force; return the smallest pivot."""
    layout, _, tables = model
    rank = tables.rank_v + held
    return float(eliminate_columns(part, layout.m, layout.nv, rank, free, layout.nv - rank))


@exact(entry=True)
def complete_state(model: PartitionModel, t: float, y: Array, p: Array, w: Array, part: Partition) -> bool:
    """Complete a state from the independent coordinates and velocities that it holds; return whether that succeeds."""
    layout, _, tables = model
    nq, nv, length, before = layout.nq, layout.nv, w[abi.LENGTH], math.inf
    for k in range(_ROUNDS):
        gap = position_rows(model, t, y, p, w, part, True)
        if gap <= _CLOSED or (k > 1 and gap < _NEARLY and gap > before / 4.0):
            break
        if not gap < math.inf or k == _ROUNDS - 1:
            return False
        before = gap
        if eliminate_positions(model, part, part.left_q, part.held[0]) == 0.0:
            return False
        solve_dependent(part, nq, tables.rank_q + part.held[0])
        for j in range(nq):
            y[j] += part.change[j] * (length if tables.metres[j] != 0 else 1.0)
    for _ in range(2 if layout.m > 0 else 0):
        velocity_rows(layout, tables, y, w, part, True)
        if eliminate_velocities(model, part, part.left_v, part.held[1]) == 0.0:
            return False
        solve_dependent(part, nv, tables.rank_v + part.held[1])
        for j in range(nv):
            y[nq + j] += part.change[j] * (1.0 if tables.angular[j] != 0 else length)
    return True


@exact(entry=True)
def quality_of_choice(model: PartitionModel, t: float, y: Array, p: Array, w: Array, part: Partition) -> float:
    """Return the quality of a choice at a state over that where it was made; at 0 the others are undetermined."""
    layout, _, tables = model
    position_rows(model, t, y, p, w, part, False)
    q = eliminate_positions(model, part, part.free_q, 0) / part.best[0]
    velocity_rows(layout, tables, y, w, part, False)
    v = eliminate_velocities(model, part, part.free_v, 0) / part.best[1]
    least = q if q < v else v
    if tables.moded != 0:
        within = 1.0  # where no row with bounds is in force
        if part.held[0] + part.held[1] > 0:
            position_rows(model, t, y, p, w, part, True)
            q = eliminate_positions(model, part, part.left_q, part.held[0])
            q /= part.best[0] if part.best[0] < part.best[2] else part.best[2]
            velocity_rows(layout, tables, y, w, part, True)
            v = eliminate_velocities(model, part, part.left_v, part.held[1])
            v /= part.best[1] if part.best[1] < part.best[3] else part.best[3]
            within = q if q < v else v
        least = least if least < within else within
    return float(least)


@exact(entry=True)
def read_states(model: PartitionModel, y: Array, part: Partition, values: Array) -> int:
    """Write the independent numbers of a state, or of its rates."""
    layout, _, tables = model
    nq, free_q, free_v = layout.nq, layout.nq - tables.rank_q, layout.nv - tables.rank_v
    for i in range(free_q):
        values[i] = y[part.free_q[i]]
    for i in range(free_v):
        values[free_q + i] = y[nq + part.free_v[i]]
    for i in range(tables.rest):
        values[free_q + free_v + i] = y[nq + layout.nv + 1 + i]
    return 0


@exact(entry=True)
def write_states(model: PartitionModel, values: Array, part: Partition, y: Array) -> int:
    """Set the independent numbers of a state."""
    layout, _, tables = model
    nq, free_q, free_v = layout.nq, layout.nq - tables.rank_q, layout.nv - tables.rank_v
    for i in range(free_q):
        y[part.free_q[i]] = values[i]
    for i in range(free_v):
        y[nq + part.free_v[i]] = values[free_q + i]
    for i in range(tables.rest):
        y[nq + layout.nv + 1 + i] = values[free_q + free_v + i]
    return 0
