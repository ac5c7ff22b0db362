"""Generalised coordinate partitioning: only independent coordinates are integrated."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._base import TOLERANCE, Descriptor, MultiplierMethod
from symgen.derive.methods._system import System


class CoordinatePartitioning(MultiplierMethod):
    """Integrates independent coordinates w; dependent ones u follow from ``Phi = 0``, their rates from ``D v = nu``.

    Before every evaluation u is found by Newton's iteration on the dependent columns of D and u' by one solve, so
    that all states of a step satisfy the constraints. The integrated u serves as prediction only. The
    partition results from an elimination of D with complete pivoting, and exchanges; a new one is chosen when its
    determinant has fallen below 0.3 of the best since the choice.
    """

    name = "coordinate-partitioning"
    dense = "which chooses its partition on a dense matrix"
    summary = "independent coordinates are integrated, dependent ones follow from the constraints"
    reference = (
        "Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318; "
        "Nikravesh, Haug, J. Mech. Trans. Autom. Des. 105 (1983) 379-384"
    )
    forms = ("ode",)
    default_integrator = "dop853"
    integrates = "independent"
    parameters = (TOLERANCE,)

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return None: the partition does not close the dependent coordinates of an implicit stage."""
        return None

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return the closure of the dependent coordinates."""
        return Correction("newton", True, "independent", stages=True)


KIND = CoordinatePartitioning()
