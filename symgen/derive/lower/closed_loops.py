"""Loops in closed form: two velocities follow from the two rows of a joint, one loop after the other.

Drivers may leave just two velocities to each loop. Where they do not, some velocities are chosen to stay free: by the
determinants of the loops at the described start (`symgen.run.compiling.free_by_loops`), as their values decide how
long a loop can be closed this way.
"""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.ir.loop_order import Pair, loop_order
from symgen.base.ir.program import FixedVelocities
from symgen.derive.formulate.equations import Equations
from symgen.derive.lower.fixed_velocities import mass_entries
from symgen.derive.lower.saddle_matrix import SaddleMatrix


def loop_pairs(equations: Equations, fixed: Sequence[FixedVelocities]) -> tuple[Pair, ...]:
    """Return the joints that have two rows left over after fixed velocities; none where a row has no velocity left."""
    matrix = _matrix_without_fixed(equations, fixed)
    left = [r for r in range(equations.m) if equations.nv + r in matrix.left and not equations.rows[r].bounded]
    of_joint: dict[str, list[int]] = {}
    for r in left:
        if equations.rows[r].held is None and not equations.rows[r].axes:
            of_joint.setdefault(equations.rows[r].joint, []).append(r)
    if not all(matrix.velocities_left_in_row(r) for r in left):
        return ()
    pairs = ((rows[0], rows[1]) for rows in of_joint.values() if len(rows) == 2)
    return tuple(
        (rows, tuple(sorted({*matrix.velocities_left_in_row(rows[0]), *matrix.velocities_left_in_row(rows[1])})))
        for rows in pairs
    )


def loops_in_order(
    equations: Equations, fixed: Sequence[FixedVelocities], free: Sequence[int] = ()
) -> tuple[FixedVelocities, ...]:
    """Return the loops that are closed after fixed velocities, in order; none where columns are always parallel."""
    loops, matrix = loop_order(loop_pairs(equations, fixed), free), _matrix_without_fixed(equations, fixed)
    for loop in loops:
        square, _ = matrix.eliminate_loop(loop)
        if square == matrix.graph.zero:
            return ()
    rows = [x - matrix.nv for x in matrix.left if x >= matrix.nv]
    idle = any(not matrix.velocities_left_in_row(row) and not equations.rows[row].bounded for row in rows)
    return () if idle else loops


def _matrix_without_fixed(equations: Equations, fixed: Sequence[FixedVelocities]) -> SaddleMatrix:
    """Return the matrix of a mechanism from which fixed velocities have been eliminated."""
    rows = tuple(row.entries for row in equations.rows)
    matrix = SaddleMatrix(equations.graph.copy(), equations.nv, mass_entries(equations), rows)
    for block in fixed:
        matrix.eliminate_fixed(block)
    return matrix
