"""What of a model is partitioned into independent coordinates and others, and memory for a choice of these."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.layout import abi
from symgen.run.layout.start_records import Layout
from symgen.run.starts.assembler import layout_of_starts

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

#: Smallest singular value that counts for the rank of rows, relative to the largest.
_RANK = 1e-9


class PartitionTables(Record):
    """What of a model is partitioned.

    Attributes
    ----------
    nu, rank_q, rank_v, rest : int
        First number of nu in the scratch; numbers of dependent coordinates and velocities, and of states of the file
        and integrals.
    moded : int
        1 where rows have bounds, else 0.
    holonomic : Array of int64
        Rows that are functions of positions.
    spins : Array of int64
        First Euler parameter and first angular velocity of each body that turns in space.
    measured : Array of int64, shape (m,)
        1 for rows in metres, else 0.
    metres, angular : Array of int64, shapes (nq,), (nv,)
        1 for coordinates in metres, and for velocities of angles, else 0.
    of_positions : Array of int64
        Places of the modes of rows of positions, -1 where a row is always in force.
    """

    nu: int
    rank_q: int
    rank_v: int
    rest: int
    moded: int
    holonomic: Integers
    spins: Integers
    measured: Integers
    metres: Integers
    angular: Integers
    of_positions: Integers


#: Layout, ``geometry`` and these tables.
PartitionModel = tuple[Layout, abi.Measure, PartitionTables]


class Partition(Record):
    """The choice, and working memory.

    Attributes
    ----------
    matrix, right, change : Array
        Rows of an elimination, what they are to become, changes of their columns.
    best : Array, shape (4,)
        Smallest pivots of positions and velocities where they were chosen, then of those that rows in force hold.
    d : Array, shape (m nv,)
        The dense D.
    free_q, free_v, left_q, left_v : Array of int64
        Places of independent coordinates and velocities, and of those that rows in force leave independent.
    held : Array of int64, shape (2,)
        Numbers of coordinates and velocities that rows in force take.
    row_at, column_at, is_free, taken : Array of int64
        Of an elimination.
    """

    matrix: Array
    right: Array
    change: Array
    best: Array
    d: Array
    free_q: Integers
    free_v: Integers
    left_q: Integers
    left_v: Integers
    held: Integers
    row_at: Integers
    column_at: Integers
    is_free: Integers
    taken: Integers


def tables_of(compiled: CompiledModel, w: Array, is_moded: bool) -> PartitionTables:
    """Return the parts of a model that are partitioned, with the ranks of its rows at the scratch of a start."""
    info, rows, switches = compiled.info, compiled.jacobian(w), layout_of_starts(compiled).switches
    holonomic = [i for i, row in enumerate(info.rows) if row.holonomic]
    rows[list(info.switchable)] = 0.0  # states of an importer are those that are independent in all modes
    ranks = _rank(rows[holonomic]) + len(info.spins), _rank(rows)
    arrays = (
        holonomic,
        info.spins,
        [row.unit == "m" for row in info.rows],
        [q.unit == "m" for q in info.coordinates],
        [q.unit != "m/s" for q in info.velocities],
        [*(switches[row] for row in holonomic), *(-1 for _ in info.spins)],
    )
    numbers = info.sections["nu"][0], *ranks, len(info.states) + info.integrals, int(is_moded)
    return PartitionTables._make((*numbers, *(np.array(x, dtype=np.int64).ravel() for x in arrays)))


def _rank(rows: NDArray[np.float64]) -> int:
    sizes = np.linalg.svd(rows, compute_uv=False) if rows.size else np.zeros(0)
    return int(np.sum(sizes > _RANK * sizes.max(initial=0.0)))


def count_states(layout: Layout, tables: PartitionTables) -> int:
    """Return the number of independent numbers of a state."""
    return int(layout.nq - tables.rank_q + layout.nv - tables.rank_v + tables.rest)


def new_partition(layout: Layout, tables: PartitionTables) -> Partition:
    """Return working memory."""
    rows = max(layout.m, len(tables.holonomic) + len(tables.spins) // 2) + 1
    columns = max(layout.nq, layout.nv)
    sizes = rows * columns, rows, columns, 4, layout.m * layout.nv
    numbers = layout.nq, layout.nv, layout.nq, layout.nv, 2, rows, columns, columns, rows
    return Partition._make((*map(np.zeros, sizes), *(np.zeros(size, dtype=np.int64) for size in numbers)))
