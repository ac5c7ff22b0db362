"""Augmented Lagrangian method: penalty terms whose error is removed by iterating the multipliers."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._augmented import ITERATION_TOLERANCE, MU, OMEGA, PENALTY, stabilised_acceleration
from symgen.derive.methods._base import Iteration, Method, augmented_iteration
from symgen.derive.methods._system import System


class AugmentedLagrangian(Method):
    """Iterates ``(M + a D^T D) dv' = f - M v' - D^T (lambda + a (D v' - g))``, ``lambda += a (D v' - g)``.

    ``g = gamma - 2 omega mu Phi' - omega^2 Phi``: violations decay like a damped oscillator, as with `baumgarte`. M + a
    D^T D is positive definite for every rank of D, so redundant rows and singular positions need no special treatment.
    """

    name = "augmented-lagrangian"
    summary = "penalty terms with iterated multipliers and stabilised constraints"
    reference = "Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195"
    default_integrator = "dop853"
    parameters = (PENALTY, OMEGA, MU, ITERATION_TOLERANCE)

    def law(self, system: System, options: Mapping[str, str]) -> Iteration:
        """Return the iteration for the stabilised constraints."""
        penalties = system.of_mean_mass(system.parameter("penalty"))
        return augmented_iteration(system, penalties, stabilised_acceleration(system))


KIND = AugmentedLagrangian()
