"""Baumgarte stabilisation of momenta: violations of positions decay, no second derivative of constraints."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from symgen.derive.methods._augmented import ITERATION_TOLERANCE, PENALTY, SOURCE
from symgen.derive.methods._base import MethodParameter
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Vector
from symgen.derive.methods.augmented_hamiltonian import AugmentedHamiltonian


class HamiltonianBaumgarte(AugmentedHamiltonian):
    """`augmented-hamiltonian` with ``D v = nu - alpha Phi``: ``Phi' = -alpha Phi`` in every evaluation.

    ``p = M v + D^T sigma``, ``p' = f + (dD/dt)^T sigma``. `augmented-hamiltonian` leaves violations of positions
    unchanged; here they decay. Both need one derivative of the constraints only. The content of the reference is known
    to us at second hand.
    """

    name = "hamiltonian-baumgarte"
    summary = "momenta are integrated; velocities let violations of positions decay in every evaluation"
    reference = "Baumgarte, J. Appl. Mech. 50 (1983) 869-870"
    parameters: ClassVar[tuple[MethodParameter, ...]] = (
        MethodParameter("alpha", 5.0, "1/s", f"rate at which Phi decays; for `baumgarte` {SOURCE}"),
        PENALTY,
        ITERATION_TOLERANCE,
    )

    def target(self, system: System) -> Vector:
        """Return nu - alpha Phi."""
        return system.nu - system.parameter("alpha") * system.phi

    def largest_step(self, parameters: Mapping[str, float], boundary: float) -> float | None:
        """Return ``boundary / alpha``."""
        return boundary / parameters["alpha"] if parameters["alpha"] > 0.0 else None


KIND = HamiltonianBaumgarte()
