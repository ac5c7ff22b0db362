"""Rows whose bounds depend on reactions as forces along a known motion, where the rate says which way they act."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import ZERO, Expr, Name, call
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import measure_derivative
from symgen.describe.bounds.dry_friction import Friction


def force_over_reaction(row: BoundedRow) -> Expr:
    """Return the force of such a row over the size of the reaction, a formula of outputs; 0 at rest."""
    assert isinstance(row, Friction), "no other row depends on reactions"
    rate = measure_derivative(row)
    return call("neg", call("mul", call("sign", rate), row.bound_in_motion(rate)))


def force_without_reaction(row: BoundedRow) -> Expr:
    """Return its force that does not depend on the reaction, a formula of ``rate``."""
    return call("neg", call("mul", row.viscous, Name("rate"))) if isinstance(row, Friction) else ZERO
