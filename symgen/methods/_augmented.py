"""What the augmented Lagrangian methods share: parameters, and the iteration in residual form."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.methods._base import Iteration, IterationState, MethodParameter

if TYPE_CHECKING:
    from symgen.lower.algebra import Scalar, System, Vector

SOURCE = "the source's value (Marques, Souto, Flores, Multibody Syst. Dyn. 39, 2017)"

PENALTY = MethodParameter("penalty", 1e7, "kg", f"factor a of D^T D, usual range 1e4 to 1e7; {SOURCE}", 1e-300)
OMEGA = MethodParameter("omega", 10.0, "1/s", f"natural frequency of the violations; {SOURCE}")
MU = MethodParameter("mu", 1.0, "1", f"damping ratio of the violations; {SOURCE}")
TOLERANCE = MethodParameter("tolerance", 1e-13, "1", "change of v' in an iteration, relative to v', at which it ends")


def stabilised(system: System) -> Vector:
    """Return gamma - 2 omega mu Phi' - omega^2 Phi."""
    omega, mu = system.parameter("omega"), system.parameter("mu")
    drift = system.D @ system.v - system.nu
    return system.gamma - (2.0 * (omega * mu)) * drift - (omega**2) * system.phi


def augmented_iteration(system: System, penalty: Scalar, target: Vector) -> Iteration:
    """Return the augmented Lagrangian iteration for D v' = target.

    ``(M + a D^T D) dv' = f - M v' - D^T (lambda + a (D v' - target))``, ``v' += dv'``,
    ``lambda += a (D v' - target)``, from ``v' = M^-1 f`` and ``lambda = 0``. It is the textbook's iteration (Bayo, Garcia de
    Jalon, Serna 1988) written for increments, so that rounding is that of the residual and not that of a times it.
    """
    factor = system.keep_factor(system.augmented_factor(penalty))
    constraints = system.keep_constraints()
    force, target = system.keep("kept_force", system.f), system.keep("kept_target", target)
    rows, columns = len(target.nodes), len(force.nodes)
    v = system.variable("kept_acceleration", columns)
    multipliers = system.variable("multipliers", rows)
    residual = constraints @ v - target
    right = force - system.mass(v) - constraints.transposed(multipliers + penalty * residual)
    increment = system.solve(factor, right)
    following = v + increment
    raised = multipliers + penalty * (constraints @ following - target)
    return Iteration(
        (
            IterationState("kept_acceleration", system.minv(system.f), following),
            IterationState("multipliers", system.zeros(rows), raised),
        ),
        increment,
    )
