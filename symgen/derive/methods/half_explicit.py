"""Half-explicit Runge-Kutta: every explicit stage satisfies the velocity constraint by its own multipliers."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._base import Descriptor, MultiplierMethod
from symgen.derive.methods._system import System


class HalfExplicit(MultiplierMethod):
    """``V_(i+1) = v + h sum_j a_ij V'_j``, ``M V'_i = f_i - D_i^T lambda_i``, ``D_(i+1) V_(i+1) = nu_(i+1)``.

    One linear system per stage, with D at both ends, determines V'_i and lambda_i: no gamma, no Newton iteration and no
    gains. Velocities meet their constraint to rounding after every step; positions drift by the error of integrating
    exact velocities. Multipliers and accelerations of results are those of `lagrange`.
    """

    name = "half-explicit"
    summary = "index 2: velocities meet their constraint in every explicit stage; positions drift slowly"
    reference = (
        "Hairer, Lubich, Roche, The Numerical Solution of Differential-Algebraic Systems by Runge-Kutta Methods, "
        "Springer 1989; Brasey, Hairer, SIAM J. Numer. Anal. 30 (1993) 538-552, doi 10.1137/0730025"
    )
    forms = ("index-2-explicit",)
    default_integrator = "half-explicit"

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the constraints at velocity level, with M and D as the only derivatives."""
        return Descriptor("explicit")


KIND = HalfExplicit()
