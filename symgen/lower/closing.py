"""Loops in closed form: two velocities follow from the two rows of a joint, one loop after the other.

Drivers may leave just two velocities to each loop. Where they do not, some velocities are chosen to stay free: by the
determinants of the loops at the described start (`symgen.compiling.closing`), as their values decide how long a loop
can be closed this way.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symgen.formulate.equations import Equations
from symgen.ir.program import FixedVelocities
from symgen.lower.blocks import SaddleMatrix, mass_entries

#: The two rows of a joint, and the velocities left over in them.
Pair = tuple[tuple[int, int], tuple[int, ...]]


def loop_pairs(equations: Equations, fixed: Sequence[FixedVelocities]) -> tuple[Pair, ...]:
    """Return the joints with two rows left over behind fixed velocities; none where a row has no velocity left."""
    matrix = _behind(equations, fixed)
    left = [r for r in range(equations.m) if equations.nv + r in matrix.left]
    of_joint: dict[str, list[int]] = {}
    for r in left:
        if equations.rows[r].held is None and not equations.rows[r].axes:
            of_joint.setdefault(equations.rows[r].joint, []).append(r)
    if not all(matrix.columns(r) for r in left):
        return ()
    pairs = ((rows[0], rows[1]) for rows in of_joint.values() if len(rows) == 2)
    return tuple((rows, tuple(sorted({*matrix.columns(rows[0]), *matrix.columns(rows[1])}))) for rows in pairs)


def loop_order(pairs: Iterable[Pair], free: Iterable[int]) -> tuple[FixedVelocities, ...]:
    """Return the loops that follow from free velocities, each as soon as it has two others that do not."""
    waiting, known, loops = list(pairs), {*free}, list[FixedVelocities]()
    while True:
        ready = next(((p, two) for p in waiting if len(two := tuple(c for c in p[1] if c not in known)) == 2), None)
        if ready is None:
            return tuple(loops)
        (rows, _), columns = ready
        waiting.remove(ready[0])
        known |= {*columns}
        loops.append(FixedVelocities(columns, rows))


def closed_loops(
    equations: Equations, fixed: Sequence[FixedVelocities], free: Sequence[int] = ()
) -> tuple[FixedVelocities, ...]:
    """Return the loops that are closed behind fixed velocities, in order; none where columns are always parallel."""
    loops, matrix = loop_order(loop_pairs(equations, fixed), free), _behind(equations, fixed)
    for loop in loops:
        square, _ = matrix.close(loop)
        if square == matrix.graph.zero:
            return ()
    idle = any(not matrix.columns(x - matrix.nv) for x in matrix.left if x >= matrix.nv)
    return () if idle else loops


def _behind(equations: Equations, fixed: Sequence[FixedVelocities]) -> SaddleMatrix:
    """Return the matrix of a mechanism from which fixed velocities have been eliminated."""
    rows = tuple(row.entries for row in equations.rows)
    matrix = SaddleMatrix(equations.graph.copy(), equations.nv, mass_entries(equations), rows)
    for block in fixed:
        matrix.fix(block)
    return matrix
