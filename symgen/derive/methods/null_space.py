"""Null-space method: accelerations in a basis of the tangent space that is continued from step to step."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._base import TOLERANCE, Method, TangentLaw
from symgen.derive.methods._system import System


class NullSpace(Method):
    """``v' = b + R z'`` with ``D R = 0``, ``b = D^+ gamma`` and ``R^T M R z' = R^T (f - M b)``.

    The basis R begins with unit vectors of independent coordinates and is projected onto each new tangent space, ``R <-
    orth((1 - D^+ D) R)``, so that it changes as little as the mechanism does, without a new decomposition at every
    step. After each step positions and velocities are corrected as in `direct-correction`, in the metric of the rank
    decision: 1 rad weighs as much as the length of its body. Readings of the name differ: Mani, Haug and Atkinson take
    R from a singular value decomposition, Kim and Vanderploeg from a QR one.
    """

    name = "null-space"
    dense = "whose basis of the tangent space is dense"
    summary = "accelerations in a tangent basis that is carried on from step to step"
    reference = (
        "Mani, Haug, Atkinson, J. Mech. Trans. Autom. Des. 107 (1985) 82-87; "
        "Singh, Likins, J. Appl. Mech. 52 (1985) 943-948; "
        "Kim, Vanderploeg, J. Mech. Trans. Autom. Des. 108 (1986) 183-188; "
        "Blajer, Comput. Methods Appl. Mech. Eng. 121 (1995) 45-57"
    )
    default_integrator = "dop853"
    parameters = (TOLERANCE,)

    def law(self, system: System, options: Mapping[str, str]) -> TangentLaw:
        """Return the law on a tangent basis."""
        return TangentLaw()

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return Newton's iteration at position level and one correction at velocity level."""
        return Correction("newton", True, "scaled")


KIND = NullSpace()
