"""The choice of fixed velocities: which velocities rows fix alone, in an order that fills in few entries."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from symgen.base.ir.program import FixedVelocities
from symgen.derive.formulate.equations import Equations
from symgen.derive.lower.saddle_matrix import SaddleMatrix


def fixed_velocities(equations: Equations, hinges: bool) -> tuple[FixedVelocities, ...]:
    """Return the velocities that rows in force at all times fix, in an order that fills in few entries.

    `hinges`: two angular velocities of a body are fixed by the two rows that keep its axis parallel to another one,
    where these have no part along a third. Their determinant is the cosine of the angle between the axes.
    """
    nv, rows = equations.nv, tuple(row.entries for row in equations.rows)
    matrix = SaddleMatrix(equations.graph.copy(), nv, mass_entries(equations), rows)
    candidates = list(_candidate_blocks(matrix, equations, hinges))
    costs = {block: _products_of_elimination(matrix, block) for block in candidates}
    by_unknown: dict[int, list[FixedVelocities]] = {}
    for block in candidates:
        for x in (*block.columns, *(nv + r for r in block.rows)):
            by_unknown.setdefault(x, []).append(block)
    taken: dict[int, FixedVelocities] = {}
    while costs:
        block = min(costs, key=lambda block: (costs[block], block.rows, block.columns))
        if _closes_a_cycle(matrix, taken, block):
            del costs[block]
            continue
        taken |= dict.fromkeys(block.columns, block)
        touched = matrix.eliminate_fixed(block)
        for x in (*touched, *block.columns, *(nv + r for r in block.rows)):
            for other in by_unknown.get(x, ()):
                if other in costs:
                    costs[other] = _products_of_elimination(matrix, other)
                    if not _is_untouched(matrix, other):
                        del costs[other]
    return tuple(dict.fromkeys(taken.values()))


def mass_entries(equations: Equations) -> dict[tuple[int, int], int]:
    """Return the entries of M by row and column."""
    return {
        (i, j): node
        for block in equations.mass
        for i, line in zip(block.columns, block.entries, strict=True)
        for j, node in zip(block.columns, line, strict=True)
    }


def _closes_a_cycle(matrix: SaddleMatrix, taken: Mapping[int, FixedVelocities], block: FixedVelocities) -> bool:
    """Whether the velocities of a block would follow from each other, by the rows of those `taken` by column.

    Entries may cancel, so that elimination alone does not show it.
    """
    waiting, seen = [block], {block}
    while waiting:
        for r in waiting.pop().rows:
            for c in matrix.before[matrix.nv + r]:
                other = taken.get(c)
                if other is not None and other not in seen:
                    if any(d in matrix.before[matrix.nv + r] for r in other.rows for d in block.columns):
                        return True
                    seen.add(other)
                    waiting.append(other)
    return False


def _candidate_blocks(matrix: SaddleMatrix, equations: Equations, hinges: bool) -> Iterator[FixedVelocities]:
    of_joint: dict[str, list[int]] = {}
    for r, row in enumerate(equations.rows):
        if row.held is not None:
            continue
        if row.axes:
            of_joint.setdefault(row.joint, []).append(r)
        for c, _ in row.entries:
            if matrix.is_unit(matrix.nv + r, c):
                yield FixedVelocities((c,), (r,))
    bodies = [v.name.rpartition(".")[0] for v in equations.velocities]
    for rows in of_joint.values() if hinges else ():
        columns = sorted({c for r in rows for c, _ in equations.rows[r].entries})
        for body in dict.fromkeys(bodies[c] for c in columns):
            two = tuple(c for c in columns if bodies[c] == body)
            if len(two) == len(rows) == 2:
                yield FixedVelocities(two, tuple(rows))


def _is_untouched(matrix: SaddleMatrix, block: FixedVelocities) -> bool:
    """Whether velocities and rows are left over, and their common entries as they were."""
    rows = [matrix.nv + r for r in block.rows]
    if not matrix.left.issuperset((*block.columns, *rows)):
        return False
    return not any((r, c) in matrix.changed for r in rows for c in block.columns)


def _products_of_elimination(matrix: SaddleMatrix, block: FixedVelocities) -> int:
    """Return about the number of products that the elimination takes."""
    k, rows = matrix.entries, [matrix.nv + r for r in block.rows]
    beside = {i for c in block.columns for i in k[c]} - {*block.columns, *rows}
    motion = {i for r in rows for i in k[r]} - set(block.columns)
    scaled = sum(not all(matrix.is_unit(i, r) for r in rows) for i in motion)
    return len(rows) * (len(motion) * (len(motion) + 1) // 2 + scaled + len(motion) * len(beside))
