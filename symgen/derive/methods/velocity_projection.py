"""Velocity projection: velocities are corrected after each step, positions drift slowly."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._base import SOLVER, WEIGHT, MultiplierMethod


class VelocityProjection(MultiplierMethod):
    """As `lagrange`; after each step ``v -= D^+ (D v - nu)``.

    The velocity constraint holds to rounding, so positions violate theirs only by the error of integrating exact
    velocities: linear growth instead of the quadratic one of `lagrange`.
    """

    name = "velocity-projection"
    summary = "velocities are projected after each step; positions are left"
    reference = "Garcia Orden, Nonlinear Dyn. 60 (2010) 49-62"
    options = (WEIGHT, SOLVER)

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return one correction at velocity level."""
        return Correction("none", True, options["weight"])


KIND = VelocityProjection()
