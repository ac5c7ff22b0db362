"""Compliant constraints: S + e in place of S, regular for any rank of D."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._augmented import MU, OMEGA, stabilised_acceleration
from symgen.derive.methods._base import Acceleration, Descriptor, Method, MethodParameter
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Vector


class CompliantConstraints(Method):
    """``(S + e) lambda = D M^-1 f - g``, ``M v' = f - D^T lambda``, so that ``D v' = g + e lambda``.

    S = D M^-1 D^T, ``g = gamma - 2 omega mu Phi' - omega^2 Phi``. In exact arithmetic it is `penalty` with a = 1 / e,
    without that method's loss of digits where a is large. At rest ``Phi = e lambda / omega^2``: joints are springs of
    stiffness omega^2 / e. S + e is positive definite, so singular positions require no decision on rank. Game engines
    call e constraint force mixing (CFM).
    """

    name = "compliant-constraints"
    summary = "constraints that give way in proportion to their force; regular at singular positions"
    reference = "Eich, Hanke, Z. Angew. Math. Mech. 75 (1995) 761-773"
    forms = ("ode", "index-1")
    parameters = (
        MethodParameter("compliance", 1e-9, "1", "e times the mean mass, 1 / a of `penalty`", 1e-300),
        OMEGA,
        MU,
    )

    def needs_regular_mass(self, options: Mapping[str, str]) -> bool:
        """Return True: M is inverted."""
        return True

    def law(self, system: System, options: Mapping[str, str]) -> Acceleration:
        """Return the law: one solve with S + e."""
        factor = system.compliant_factor(self._compliance(system))
        multipliers = system.solve(factor, system.D @ system.minv(system.f) - stabilised_acceleration(system))
        return Acceleration(system.minv(system.f - system.D.transposed(multipliers)), multipliers)

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the same equations without elimination."""
        return Descriptor("acceleration", stabilised_acceleration(system), self._compliance(system))

    def _compliance(self, system: System) -> Vector:
        """Return e of each row."""
        return system.inverses(system.of_mean_mass(system.inverse(system.parameter("compliance"))))


KIND = CompliantConstraints()
