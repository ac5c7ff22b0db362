"""Index-1 augmented Lagrangian method with mass-orthogonal projections."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._augmented import ITERATION_TOLERANCE, PENALTY
from symgen.derive.methods._base import Iteration, Method, MethodParameter, augmented_iteration
from symgen.derive.methods._system import System


class Index1AugmentedLagrangian(Method):
    """The iteration of `augmented-lagrangian` for ``D v' = gamma``, then mass-orthogonal projections of q and v.

    Violations are not fed back (omega = 0): after each accepted step positions and velocities are projected with the
    leading matrix of the iteration, M + a D^T D. Readings of the name differ; this is ours, after Cuadrado,
    Cardenal and Bayo.
    """

    name = "index1-augmented-lagrangian"
    summary = "iterated multipliers for accelerations, mass-orthogonal projections of positions and velocities"
    reference = (
        "Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130; "
        "Cuadrado, Cardenal, Bayo, Multibody Syst. Dyn. 1 (1997) 259-280"
    )
    default_integrator = "dop853"
    parameters = (
        PENALTY,
        ITERATION_TOLERANCE,
        MethodParameter(
            "tolerance", 1e-13, "m", "violation at which projections end, times the mechanism's length or speed"
        ),
    )

    def law(self, system: System, options: Mapping[str, str]) -> Iteration:
        """Return the iteration for the constraints at acceleration level."""
        return augmented_iteration(system, system.of_mean_mass(system.parameter("penalty")), system.gamma)

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return the mass-orthogonal projection."""
        return Correction("newton", True, "augmented")


KIND = Index1AugmentedLagrangian()
