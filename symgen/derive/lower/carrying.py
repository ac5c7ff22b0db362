"""What rows in force carry for others, before formulas that read it.

A row that rests because joints or other rows lock it is off, and the row in force in its place carries its effort too.
Which row that is, is a number of the modes, so that the sums of all rows are found together, by adding each bound to
the sum of its carrier: as many statements as rows, where formulas of all others in each row would be as many as their
square.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symgen.base.ir.program import CARRYING, Block
from symgen.base.vocabulary.expressions import Expr, Reading, call
from symgen.base.vocabulary.measures import Carrying, Driven
from symgen.describe.bounds.bounded_modes import LEAST_BOUND, effort_in_force, mode_names
from symgen.describe.mechanism import Mechanism


@dataclass(frozen=True)
class CarriedSums:
    """The sums of the section ``carrying``, which formulas read.

    Attributes
    ----------
    block : Block
        Of each row that others may carry three numbers: its bound at rest, that and no less than what
        efforts may be divided by, and its effort where it is in force.
    places : tuple of int
        Of these rows among all rows with bounds, from 0.
    count : int
        Of all rows with bounds.
    modes : mapping of str to int
        Places of the numbers of rows with bounds in the section ``modes``, by ``ROW.NUMBER``.
    names : tuple of str
        Of these rows.
    shares : bool
        Whether formulas read what carriers exert.
    """

    block: Block
    places: tuple[int, ...]
    count: int
    modes: Mapping[str, int]
    names: tuple[str, ...]
    shares: bool


def slot_of_carrying(mechanism: Mechanism, source: Carrying) -> int:
    """Return the place in the section ``carrying`` of what a formula reads there."""
    place = next(i for i, row in enumerate(mechanism.bounded) if row.row == source.row)
    return 1 + place + 2 * (len(mechanism.bounded) + 1) * source.share


def formulas_of_carried(mechanism: Mechanism) -> list[Expr]:
    """Return the three numbers of each row that others may carry, see `CarriedSums`."""
    formulas = list[Expr]()
    for row in mechanism.bounded:
        if row.signed:
            (gap,), (_, coefficient) = row.pressed, row.numbers[0]
            bound = call("mul", coefficient, Reading(gap, Driven(gap, row.measure)))
            formulas += [bound, call("max", bound, LEAST_BOUND), effort_in_force(row)]
    return formulas


def carried_sums(
    mechanism: Mechanism, block: Block, slots: Mapping[str, tuple[int, int]], read: set[int]
) -> CarriedSums:
    """Return the sums with the block of their formulas; of ``carrying`` among the sections of ``w`` some is `read`."""
    count = len(mechanism.bounded)
    assert slots[CARRYING][1] == 3 * (count + 1), "the model has the same rows with bounds"
    rows = [(i, row.row) for i, row in enumerate(mechanism.bounded) if row.signed]
    return CarriedSums(
        block,
        tuple(i for i, _ in rows),
        count,
        mode_names(mechanism),
        tuple(name for _, name in rows),
        any(place > 2 * (count + 1) for place in read),
    )
