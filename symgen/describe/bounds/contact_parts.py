"""Rows of a contact whose surface has several smooth parts, such as an outline with concave corners.

Each part has a gap of its own, and with friction a slip. All have the contact's name, with which their events and
outputs are called.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial, reduce

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr, call, sum_of_terms
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import effort_in_force, measure_derivative
from symgen.describe.bounds.contact_rows import ContactGap, Tangent
from symgen.describe.bounds.contact_rows_in_space import TangentInSpace
from symgen.describe.mechanism import Output


def _label(row: TangentOfPart | GapOfPart) -> str:
    return f"{row.name}.{row.part}" if row.part else row.name


class TangentOfPart(Tangent, frozen=True):
    """Friction along one of the parts of a contact.

    Parameters
    ----------
    part : int
        Its number, counted from 1; 0 alone, as in looped code.
    """

    part: int = 1

    @property
    def contact(self) -> str:
        """The label of its gap."""
        return _label(self)

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield the friction of all parts and the rate of slip at the nearest one, once for all of them."""
        if self.part != 1:
            return
        parts = [row for row in beside if isinstance(row, TangentOfPart) and row.name == self.name]
        gaps = {row.row: row.place[1] for row in beside if isinstance(row, GapOfPart)}
        nearest: Expr = gaps[self.pressed[0]]
        slip: Expr = measure_derivative(self)
        for row in parts[1:]:
            nearer = call("lt", gaps[row.pressed[0]], nearest)
            slip = call("where", nearer, measure_derivative(row), slip)
            nearest = call("min", gaps[row.pressed[0]], nearest)
        yield Output(f"{self.name}.friction", sum_of_terms(*(row.total_effort(beside) for row in parts)), "N")
        yield Output(f"{self.name}.slip", slip, "m/s")


class GapOfPart(ContactGap, frozen=True):
    """Gap of one of the parts of a contact.

    Parameters
    ----------
    part : int
        Its number, counted from 1; 0 alone, as in looped code.
    """

    part: int = 1

    @property
    def label(self) -> str:
        """The name with the number of the part."""
        return _label(self)

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield the mode of the part that is closed, the sum of the forces, and the least gap, once for all parts."""
        if self.part != 1:
            return
        parts = [row for row in beside if isinstance(row, GapOfPart) and row.name == self.name]
        modes = [row.mode for row in parts]
        largest, least = reduce(partial(call, "max"), modes), reduce(partial(call, "min"), modes)
        yield Output(f"{self.name}.mode", call("where", call("gt", largest, ZERO), largest, least), "")
        yield Output(f"{self.name}.force", sum_of_terms(*map(effort_in_force, parts)), "N")
        yield Output(f"{self.name}.gap", reduce(partial(call, "min"), (row.place[1] for row in parts)), "m")


def part_of_contact(gap: ContactGap, part: int) -> tuple[BoundedRow, ...]:
    """Return the rows of a part of a contact, with the number of the part, from the gap of the whole contact."""
    tangent: Tangent | None = None
    if isinstance(gap.tangent, TangentInSpace):
        tangent = msgspec.structs.replace(gap.tangent, part=part)
    elif gap.tangent is not None:
        own = {name: getattr(gap.tangent, name) for name in Tangent.__struct_fields__}
        tangent = TangentOfPart(**own, part=part)
    whole = {name: getattr(gap, name) for name in ContactGap.__struct_fields__}
    row = GapOfPart(**{**whole, "tangent": tangent}, part=part)
    return (row,) if tangent is None else (*tangent.rows, row)
