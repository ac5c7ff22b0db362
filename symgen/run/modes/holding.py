"""Modes of rows at rest, compiled: in force, carried by one that is in force, or with an effort of their own.

Bounds that vary are no numbers: margins read them, times the largest effort of a row that another one carries.
"""

from __future__ import annotations

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.run.modes.bounded_rows import AT_REST, CONSTANT, EFFORT, HELD, LIMIT, ROUNDED, SIGN
from symgen.run.modes.probing import by_reaction
from symgen.run.modes.row_records import Choice


@exact()
def is_followed(c: Choice, i: int) -> bool:
    """Return whether margins read the bound of a row, as it varies; that by a reaction has a limit besides."""
    return bool(c.rows.varying[i] != 0 and c.rows.pressed[i] == 0)


@exact()
def bound_at_rest(c: Choice, i: int) -> float:
    """Return the bound at rest of a row as a force, of contacts for each unit of the force that presses."""
    return float(c.read.static[i] * (c.sizes[i] if by_reaction(c, i) else 1.0))


@exact()
def set_holds(c: Choice) -> None:
    """Set the bounds at rest as forces."""
    for i in range(c.rows.count):
        c.holds[i] = bound_at_rest(c, i)


@exact()
def write_signs(c: Choice) -> None:
    """Write the signs of rates to the modes."""
    for i in range(c.rows.count):
        c.after[MODE_NUMBERS * i + SIGN] = 0.0 if c.rows.pushes[i] != 0 else c.signs[i]


@exact()
def hold_row(c: Choice, i: int) -> None:
    """Put a row into force. Of bounds that margins read, the number ``limit`` has nothing."""
    at, read = MODE_NUMBERS * i, c.rows.pushes[i] != 0 or c.rows.partner[i] >= 0 or by_reaction(c, i)
    c.after[at + HELD] = 1.0
    c.after[at + CONSTANT] = c.before[at + CONSTANT] if c.before[at + HELD] != 0.0 else c.read.value[i]
    c.after[at + LIMIT] += 0.0 if read or is_followed(c, i) else c.holds[i]


@exact()
def carry_force(c: Choice, i: int, owner: int, factor: float) -> None:
    """Have row `owner` carry the force of row `i`: `factor` of its own for each unit."""
    c.after[MODE_NUMBERS * i + CONSTANT] = float(owner + 1)
    if c.rows.partner[i] >= 0 or is_followed(c, i):
        c.after[MODE_NUMBERS * i + LIMIT] = factor if c.rows.partner[i] >= 0 else abs(factor)
    else:
        c.after[MODE_NUMBERS * owner + LIMIT] += abs(factor) * c.holds[i]


@exact()
def keep_force(c: Choice, i: int) -> None:
    """Have a row at rest keep its force. One at its bound is not watched at zero, and none is not watched."""
    at = MODE_NUMBERS * i
    c.after[at + CONSTANT], c.after[at + LIMIT] = AT_REST, 1.0
    if c.rows.pushes[i] == 0:
        slack = 0.1 * ROUNDED * (c.problem.scale[i] + abs(c.forces[i]) + c.holds[i])
        c.after[at + EFFORT] = c.forces[i]
        c.after[at + LIMIT] = slack if abs(c.forces[i]) > slack else 1.0
