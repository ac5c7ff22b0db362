"""What kinds of rows with bounds share: answers that only some of them give otherwise."""

from __future__ import annotations

from typing import ClassVar, Self

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr
from symgen.base.vocabulary.measures import Measure


class Bounds(msgspec.Struct, frozen=True):
    """Base of the kinds: two bounds, which depend on no reaction (`symgen.describe.bounded.BoundedRow`)."""

    one_sided: ClassVar[bool] = False
    signed: ClassVar[bool] = False
    in_contact: ClassVar[bool] = False
    paired: ClassVar[bool] = False
    turns: ClassVar[bool] = False

    @property
    def second(self) -> bool:
        """Whether it is the second one of two rows."""
        return False

    @property
    def reversed(self) -> bool:
        """Whether its measure is the coordinate with the other sign."""
        return False

    @property
    def smooth(self) -> bool:
        """Whether a smooth force replaces it."""
        return False

    @property
    def pressed(self) -> tuple[str, ...]:
        """Rows of a joint whose forces are the reaction that bounds depend on."""
        return ()

    @property
    def changing(self) -> bool:
        """Whether its bounds depend on more than parameters."""
        return False

    @property
    def unequal(self) -> bool:
        """Whether its bounds differ in the two directions."""
        return False

    @property
    def shift(self) -> Expr | None:
        """Middle of the bounds at rest less the middle of those in motion; None where it is 0."""
        return None

    def middle_of_bounds(self) -> Expr:
        """Return the force in the middle between the bounds of two directions as a motion begins."""
        return ZERO

    @property
    def across(self) -> tuple[tuple[Measure, ...], ...]:
        """Cosines of the axes of `pressed` with directions across the joint."""
        return ()

    @property
    def coefficient(self) -> Expr:
        """Bound in motion over the size of the reaction."""
        return ZERO

    @property
    def way(self) -> Expr | None:
        """Component of the direction of its motion; None where that is the number ``sign`` of the row."""
        return None

    @property
    def renewed(self) -> Expr | None:
        """The number ``sign`` after a step; None where steps leave it as it is."""
        return None

    @property
    def surface(self) -> Expr:
        """How fast a surface moves along it by itself [m/s]."""
        return ZERO

    @property
    def without_reaction(self) -> Self:
        """The row with that part of its effort alone which depends on no reaction."""
        return self
