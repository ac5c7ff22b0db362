"""Parameters that the augmented Lagrangian and penalty methods share."""

from __future__ import annotations

from symgen.derive.methods._base import MethodParameter
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Vector

SOURCE = "the source's value (Marques, Souto, Flores, Multibody Syst. Dyn. 39, 2017)"

PENALTY = MethodParameter(
    "penalty", 1e7, "1", f"factor a of D^T D over the mean mass, usual range 1e4 to 1e7; {SOURCE}, in kg", 1e-300
)
OMEGA = MethodParameter("omega", 10.0, "1/s", f"natural frequency of the violations; {SOURCE}")
MU = MethodParameter("mu", 1.0, "1", f"damping ratio of the violations; {SOURCE}")
ITERATION_TOLERANCE = MethodParameter(
    "iteration_tolerance", 1e-13, "1", "change of v' in an iteration, relative to v', at which it ends"
)


def stabilised_acceleration(system: System) -> Vector:
    """Return gamma - 2 omega mu Phi' - omega^2 Phi."""
    omega, mu = system.parameter("omega"), system.parameter("mu")
    drift = system.D @ system.v - system.nu
    return system.gamma - (2.0 * (omega * mu)) * drift - (omega**2) * system.phi
