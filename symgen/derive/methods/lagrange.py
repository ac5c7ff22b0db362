"""Standard Lagrange multipliers: index-1 form without stabilisation."""

from __future__ import annotations

from symgen.derive.methods._base import MultiplierMethod


class Lagrange(MultiplierMethod):
    """``[M D^T; D 0] [v'; lambda] = [f; gamma]``.

    The constraints hold at acceleration level only, so position violations grow with time; the cost of other methods
    is relative to this one.
    """

    name = "lagrange"
    summary = "constraints at acceleration level only; violations grow with time"
    reference = "Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988"


KIND = Lagrange()
