"""Post-stabilisation: one correction of positions and velocities after each step."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._base import SOLVER, WEIGHT, MultiplierMethod


class PostStabilization(MultiplierMethod):
    """As `lagrange`; after each step once ``q -= N D^+ Phi`` and once ``v -= D^+ (D v - nu)``.

    The stabilisation with F = D^T (D D^T)^-1 of Ascher, Chin and Reich: one step towards the constraints, which keeps
    the violation at the square of the increment of a step, at fixed cost.
    """

    name = "post-stabilization"
    summary = "one correction of positions and velocities after each step, not iterated"
    reference = (
        "Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; "
        "Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157; "
        "Cline, Pai, Proc. IEEE Int. Conf. Robotics and Automation (2003)"
    )
    options = (WEIGHT, SOLVER)

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return one correction at both levels."""
        return Correction("once", True, options["weight"])


KIND = PostStabilization()
