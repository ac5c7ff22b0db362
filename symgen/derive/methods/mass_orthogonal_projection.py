"""Mass-orthogonal projections with the augmented leading matrix."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._augmented import PENALTY
from symgen.derive.methods._base import MethodParameter, MultiplierMethod


class MassOrthogonalProjection(MultiplierMethod):
    """As `lagrange`; after each step q, then v, by ``(M + a D^T D) dv = -M delta - D^T (a Phi + lambda)``, iterated.

    ``delta += dv``, ``lambda += a Phi``: the change is orthogonal to the admissible motions in the metric of M. Where
    D has full rank it is `direct-correction` with ``weight=mass``, reached without inverting D M^-1 D^T.
    """

    name = "mass-orthogonal-projection"
    summary = "positions and velocities projected in the metric of M by iterations with M + a D^T D"
    reference = "Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296"
    parameters = (
        PENALTY,
        MethodParameter(
            "tolerance", 1e-13, "m", "violation at which the iteration ends, times the mechanism's length or speed"
        ),
    )

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return the mass-orthogonal projection."""
        return Correction("newton", True, "augmented")


KIND = MassOrthogonalProjection()
