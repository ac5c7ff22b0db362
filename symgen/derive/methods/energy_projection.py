"""Energy projection: after the mass-orthogonal correction, velocities are scaled so that the energy balances."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._base import TOLERANCE, MultiplierMethod


class EnergyProjection(MultiplierMethod):
    """As `direct-correction` in the metric of M; then ``v <- v_p + s (v - v_p)`` with T + V = E0 + W.

    ``v_p = M^-1 D^T S^-1 nu`` is the part prescribed by drivers; the rest is orthogonal to it in the metric of M, so
    that ``s^2 = (E0 + W - V - T(v_p)) / T(v - v_p)``. This is the smallest change in the metric of M that keeps ``D v =
    nu``. Where s^2 would leave 1/4 to 4, as at turning points, velocities are not scaled. The formula is our reading:
    only the abstract of the reference was available. The energy of such a run does not indicate its error.
    """

    name = "energy-projection"
    summary = "positions and velocities are projected in the metric of M, then velocities scaled to the energy"
    reference = "Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064"
    parameters = (TOLERANCE,)

    def needs_regular_mass(self, options: Mapping[str, str]) -> bool:
        """Return True: M is inverted."""
        return True

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return Newton's iteration for positions, one correction of velocities, and their scaling."""
        return Correction("newton", True, "mass", energy=True)


KIND = EnergyProjection()
