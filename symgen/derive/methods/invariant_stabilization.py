"""Stabilised invariants: the rates of positions are changed so that their violations decay exactly."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from symgen.derive.methods._base import Acceleration, Method, MethodParameter
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Scalar


class InvariantStabilization(Method):
    """``q' = N (v - D^+ (w + kappa Phi))``, ``D v' = gamma - kappa w`` with w = D v - nu: ``Phi' = -kappa Phi``.

    ``D^+ = M^-1 D^T S^-1``, so that v' and the change of q' share one factor of S. Phi decays with the rate kappa
    exactly and without oscillation; w likewise, except for the rotation of D along the change of q', a term of the
    order of v times the violations. With kappa near 1 / h it is `post-stabilization` within a step. Gains that grow
    like 1 / h feed the stages' own violations back and cost the integrator its order. The form with a change of q' is
    our reading of the references; of the first only the abstract was available.
    """

    name = "invariant-stabilization"
    dense = "which needs rates of positions at other velocities than the state's"
    summary = "violations decay with one rate, positions by a change of q'"
    reference = (
        "Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; "
        "Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157"
    )
    parameters: ClassVar[tuple[MethodParameter, ...]] = (
        MethodParameter("kappa", 10.0, "1/s", "rate at which violations decay; chosen here, as omega of `penalty`"),
    )

    def rate(self, system: System) -> Scalar:
        """Return the rate at which violations decay."""
        return system.parameter("kappa")

    def needs_regular_mass(self, options: Mapping[str, str]) -> bool:
        """Return True: M is inverted."""
        return True

    def law(self, system: System, options: Mapping[str, str]) -> Acceleration:
        """Return v' with its feedback, and q' without the part that violates the constraints."""
        kappa, drift = self.rate(system), system.D @ system.v - system.nu
        multipliers = system.solve_schur(system.D @ system.minv(system.f) - system.gamma + kappa * drift)
        impulse = system.solve_schur(drift + kappa * system.phi)
        velocities = system.v - system.minv(system.D.transposed(impulse))
        acceleration = system.minv(system.f - system.D.transposed(multipliers))
        return Acceleration(acceleration, multipliers, system.at_velocity(system.q_rates, velocities))

    def largest_step(self, parameters: Mapping[str, float], boundary: float) -> float | None:
        """Return ``boundary / kappa``."""
        return boundary / parameters["kappa"] if parameters["kappa"] > 0.0 else None


KIND = InvariantStabilization()
