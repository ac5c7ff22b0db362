"""Udwadia-Kalaba equation: accelerations by a pseudoinverse, no multipliers needed."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._base import Acceleration, Method
from symgen.derive.methods._system import System


class UdwadiaKalaba(Method):
    """``v' = a + M^-1/2 (D M^-1/2)^+ (gamma - D a)`` with ``a = M^-1 f``: Gauss's principle solved in closed form.

    With ``B = D M^-1/2`` the pseudoinverse is ``B^T (B B^T)^+``; dependent rows, as decided by D D^T, are skipped.
    Where D has full rank the accelerations are those of `lagrange` up to rounding. Multipliers are reported as ``(B
    B^T)^+ (D a - gamma)``. Singular mass matrices (Udwadia, Phohomsiri 2006) are not covered.
    """

    name = "udwadia-kalaba"
    summary = "accelerations closest to the free ones in the metric of M, by a pseudoinverse"
    reference = (
        "Udwadia, Kalaba, Proc. R. Soc. Lond. A 439 (1992) 407-410, doi 10.1098/rspa.1992.0158; "
        "Arabyan, Wu, Multibody Syst. Dyn. 2 (1998) 49-69"
    )

    def needs_regular_mass(self, options: Mapping[str, str]) -> bool:
        """Return True: M is inverted."""
        return True

    def law(self, system: System, options: Mapping[str, str]) -> Acceleration:
        """Return the law in terms of B = D M^-1/2."""
        root = system.inverse_mass_root
        weighted = system.D.times_transposed(root)
        free = system.minv(system.f)
        factor = system.pseudoinverse_factor(weighted)
        multipliers = system.solve(factor, system.D @ free - system.gamma)
        change = root.transposed(weighted.transposed(multipliers))
        return Acceleration(free - change, multipliers)


KIND = UdwadiaKalaba()
