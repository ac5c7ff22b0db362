"""Gaps that are closed at a start without being exactly 0 are put to 0: what lies on its stop lies on it."""

from __future__ import annotations

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.redundancy import row_weight_in_force
from symgen.run.layout.scales import entry_of, free_scale
from symgen.run.modes.bounded_rows import CONSTANT, HELD, row_scale
from symgen.run.modes.probing import copy_state, write_rates
from symgen.run.modes.row_records import Choice
from symgen.run.starts.start_solvers import least_norm

#: Gaps below this part of the mechanism's length are rounding.
_RESOLVED = 1e-13
#: Changes of positions; the second and third correct what is not linear.
_TIMES = 3


@exact(entry=True)
def put_gaps(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers) -> int:
    """Put the gaps in force to 0 by the shortest change of positions that leaves joints closed; return their number.

    The modes of a start have been chosen: gaps that nothing presses are not in force, and stay as they are. `moved` has
    the gaps that were not 0.
    """
    layout, found = c.rows.layout, 0
    m, n, matrix, right, x, at = layout.m, layout.nv, c.placing.matrix, c.placing.right, c.placing.change, layout.nq
    for i in range(c.rows.count):
        constant = w[c.rows.first + MODE_NUMBERS * i + CONSTANT]
        closed = c.rows.pushes[i] != 0 and w[c.rows.first + MODE_NUMBERS * i + HELD] != 0.0
        c.placing.moved[i] = constant if closed and abs(constant) > _RESOLVED * row_scale(c, w, i, abi.LENGTH) else 0.0
        found += 1 if c.placing.moved[i] != 0.0 else 0
    if found == 0 or matrix.shape[0] == 0:
        return 0
    for i in range(c.rows.count):
        if c.placing.moved[i] != 0.0:
            w[c.rows.first + MODE_NUMBERS * i + CONSTANT] = 0.0
    for _ in range(_TIMES):
        copy_state(c, y, w, iw)
        c.rows.geometry(t, c.y, p, c.w)
        for i in range(m * n):
            matrix[i] = 0.0
        for e in range(layout.constants.shape[0]):
            row, column = layout.entries[3 * e], layout.entries[3 * e + 1]
            weight = row_weight_in_force(layout, c.w, row)
            matrix[row * n + column] = weight * (entry_of(layout, c.w, e) * free_scale(layout, c.w, column))
        for i in range(m):
            right[i] = -row_weight_in_force(layout, c.w, i) * c.w[layout.residual + i]
        least_norm(matrix, m, n, right, x, c.placing.space, c.placing.order)
        for j in range(n):
            c.y[at + j] = x[j] * free_scale(layout, c.w, j)
        write_rates(t, c, p)  # of which the first ones are those of coordinates at these velocities
        for i in range(at):
            y[i] += c.rate[i]
    return found
