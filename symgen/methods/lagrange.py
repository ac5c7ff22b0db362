"""Standard Lagrange multipliers: index-1 form, nothing against drift."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from symgen.methods._base import Acceleration, Method, multiplier_law

if TYPE_CHECKING:
    from symgen.lower.algebra import System


class Lagrange(Method):
    """``[M D^T; D 0] [v'; lambda] = [f; gamma]``.

    The constraints hold at acceleration level only, so position violations grow with time; it is the baseline to which
    the other methods' cost is related.
    """

    name = "lagrange"
    summary = "constraints at acceleration level only; violations grow with time"
    reference = "Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988"

    def law(self, system: System, options: Mapping[str, str]) -> Acceleration:
        """Return the law: gamma as derived."""
        return multiplier_law(system, system.gamma)


KIND = Lagrange()
