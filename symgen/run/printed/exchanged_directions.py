"""Directions of the states of model exchange, of all that follows from states, and of rates, for FMUs.

The arrays are longer: ``y``, the parameters ``p``, the scratch ``w`` and the rates are followed by a direction of each
of their elements, and in ``w`` the direction of time comes last. Emitted functions have a form with directions
(`symgen.compile.native.directed_functions`).
"""

from __future__ import annotations

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.ensemble_abi import Prepare
from symgen.run.layout.scales import fill_jacobian
from symgen.run.layout.start_records import Layout
from symgen.run.printed.partition import (
    eliminate_columns,
    fill_position_rows,
    row_counts,
    solve_dependent,
    velocity_rows,
)
from symgen.run.printed.partition_tables import Partition, PartitionTables

#: Layout and tables; ``prepare`` of the model and of the law, ``masses``, ``geometry``, ``rhs`` and its confirmation,
#: all with directions; numbers of elements of the state and of the scratch.
DirectedExchange = tuple[
    Layout, PartitionTables, Prepare, Prepare, abi.Move, abi.Measure, abi.Rhs, abi.Rhs, int, int
]  # fmt: skip


@exact()
def direct_positions(
    layout: Layout, tables: PartitionTables, y: Array, w: Array, part: Partition, ny: int, nw: int
) -> bool:
    """Set the directions of dependent coordinates by rows with directions; return whether they are determined."""
    nq, count, spins, right = layout.nq, tables.holonomic.shape[0], tables.spins, part.right
    rows, rank = count + spins.shape[0] // 2, tables.rank_q + part.held[0]
    fill_position_rows(layout, tables, y, w, part, True)
    for i in range(count):
        counts = row_counts(tables.of_positions[i], w, True)
        right[i] = -w[nw + layout.residual + tables.holonomic[i]] if counts else 0.0
    for i in range(count, rows):
        e = spins[2 * (i - count)]
        right[i] = 0.0
        for k in range(4):
            right[i] -= y[e + k] * y[ny + e + k]
    if eliminate_columns(part, rows, nq, rank, part.left_q, nq - rank) == 0.0:
        return False
    solve_dependent(part, nq, rank)
    for j in range(nq):
        y[ny + j] += part.change[j] * (w[abi.LENGTH] if tables.metres[j] != 0 else 1.0)
    return True


@exact()
def direct_velocities(
    layout: Layout, tables: PartitionTables, y: Array, w: Array, part: Partition, ny: int, nw: int
) -> bool:
    """Set the directions of dependent velocities by rows with directions; return whether they are determined."""
    nq, nv, right, d, rank = layout.nq, layout.nv, part.right, part.d, tables.rank_v + part.held[1]
    fill_jacobian(layout, w, d)
    velocity_rows(layout, tables, y, w, part, True)
    for i in range(layout.m):
        right[i] = 0.0
        if row_counts(layout.switches[i], w, True):
            right[i] = w[nw + tables.nu + i]
            for k in range(nv):
                right[i] -= d[i * nv + k] * y[ny + nq + k]
    for k in range(layout.constants.shape[0]):
        row, slot = layout.entries[3 * k], layout.entries[3 * k + 2]
        if slot >= 0 and row_counts(layout.switches[row], w, True):
            right[row] -= w[nw + layout.jacobian + slot] * y[nq + layout.entries[3 * k + 1]]
    if eliminate_columns(part, layout.m, nv, rank, part.left_v, nv - rank) == 0.0:
        return False
    solve_dependent(part, nv, rank)
    for j in range(nv):
        y[ny + nq + j] += part.change[j] * (1.0 if tables.angular[j] != 0 else w[abi.LENGTH])
    return True


@exact(entry=True)
def direct_rates(
    model: DirectedExchange, t: float, y: Array, p: Array, w: Array, iw: Integers, rate: Array, part: Partition
) -> bool:
    """Set the directions of a state and its rates from directions of independent numbers, parameters and time.

    Parameters
    ----------
    model : tuple
        See `DirectedExchange`.
    t : float
        Time [s].
    y, p, w, iw, rate : Array
        A state whose joints are closed, prepared parameters, scratch and counters; rates are written. Directions of
        dependent coordinates and velocities are 0 before.
    part : Partition
        The choice of independent numbers.

    Returns
    -------
    bool
        False where dependent coordinates or velocities are not determined.
    """
    layout, tables, prepare, prepare_law, masses, geometry, rhs, confirm, ny, nw = model
    prepare(p)
    prepare_law(p)
    masses(p, w)
    # rows are those of changes that keep Euler parameters of length 1, which the first pass makes of the given ones
    for _ in range((2 if tables.spins.shape[0] > 0 else 1) if tables.rank_q + part.held[0] > 0 else 0):
        geometry(t, y, p, w)
        if not direct_positions(layout, tables, y, w, part, ny, nw):
            return False
    if tables.rank_v + part.held[1] > 0:
        geometry(t, y, p, w)
        if not direct_velocities(layout, tables, y, w, part, ny, nw):
            return False
    if rhs(t, y, p, w, iw, rate) != 0:
        confirm(t, y, p, w, iw, rate)
    return True
