"""Correction of dependent coordinates alone: independent ones keep the integrator's values."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._base import TOLERANCE, Descriptor, MultiplierMethod
from symgen.derive.methods._system import System


class DependentCorrection(MultiplierMethod):
    """As `lagrange`, all coordinates integrated; after each step ``dv = -P D^T (D P D^T)^-1 Phi``, likewise for v.

    P keeps the dependent columns, chosen as for `coordinate-partitioning`, which closes the stages as well. Near a
    singular position no partition determines the motion: all coordinates are corrected in the metric of M. The
    references choose the partition by another criterion.
    """

    name = "dependent-correction"
    dense = "which chooses its partition on a dense matrix"
    summary = "dependent coordinates are corrected after each step, independent ones are left"
    reference = "Terze, Naudet, Multibody Syst. Dyn. 20 (2008) 85-106; Terze, Lefeber, Muftic, ibid. 6 (2001) 229-243"
    forms = ("ode",)
    parameters = (TOLERANCE,)

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return None: partitions are chosen in explicit steps only."""
        return None

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return the closure of the dependent coordinates."""
        return Correction("newton", True, "independent")


KIND = DependentCorrection()
