"""Velocity projection in part, which sets how much energy it takes."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._base import MethodParameter, MultiplierMethod


class ControllableVelocityProjection(MultiplierMethod):
    """As `lagrange`; after each step ``v -= theta M^-1 D^T S^-1 w``, w = D v - nu.

    Each step multiplies w by 1 - theta. For nu = 0 it changes the kinetic energy by ``-(theta - theta^2 / 2) w^T S^-1
    w``; the complete projection, theta = 1, which is `velocity-projection` with ``weight=mass``, removes most. The
    reference solves ``(M + a D^T D) v = M v* + a D^T nu``, which is theta = s / (s + 1 / a) for each eigenvalue s of S.
    Replacing it by one factor theta is our reading.
    """

    name = "controllable-velocity-projection"
    summary = "a chosen part of the velocity projection in the metric of M after each step"
    reference = "Garcia Orden, Conde Martin, Nonlinear Dyn. 68 (2012) 245-257; Garcia Orden, ibid. 60 (2010) 49-62"
    parameters = (
        MethodParameter("theta", 1.0, "1", "part of the projection; 1 is all of it, beyond 2 violations grow"),
    )

    def needs_regular_mass(self, options: Mapping[str, str]) -> bool:
        """Return True: M is inverted."""
        return True

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return one correction at velocity level, scaled by theta."""
        return Correction("none", True, "mass", share="theta")


KIND = ControllableVelocityProjection()
