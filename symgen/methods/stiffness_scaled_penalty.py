"""Augmented Lagrangian iteration with penalties like the stiffness of rows: redundant rows share their load."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.ir.program import Correction
from symgen.methods._augmented import ITERATION_TOLERANCE
from symgen.methods._base import TOLERANCE, Iteration, Method, MethodParameter, augmented_iteration
from symgen.methods._formula import System


class StiffnessScaledPenalty(Method):
    """The iteration of `index1-augmented-lagrangian` with ``a_i = T^2 k_i`` and redundant rows kept.

    From lambda = 0 all iterates are ``lambda = a D z``: of all multipliers that give the motion those that rows of
    stiffness k would have, shared like k. The motion is that of `direct-correction`, whose corrections follow each
    step; T decides how fast the iteration is and nothing else.
    """

    name = "stiffness-scaled-penalty"
    dense = "which reads the stiffness of single rows"
    summary = "iterated penalties like the stiffness of rows: redundant rows share their load like it"
    reference = (
        "Ruzzeh, Kovecses, J. Comput. Nonlinear Dyn. 6 (2011) 021008; "
        "Gonzalez, Kovecses, Multibody Syst. Dyn. 29 (2013) 57-76, doi 10.1007/s11044-012-9322-y"
    )
    default_integrator = "dop853"
    unique_multipliers = True
    parameters = (
        MethodParameter("stiffness", 1e9, "N/m", "of rows for which the file names none; chosen here", 1e-300),
        MethodParameter("period", 0.1, "s", "T; 1e7 kg as the source's penalty for the default stiffness", 1e-300),
        ITERATION_TOLERANCE,
        TOLERANCE,
    )

    def law(self, system: System, options: Mapping[str, str]) -> Iteration:
        """Return the iteration for the constraints at acceleration level."""
        stiffness = system.row_stiffness(system.parameter("stiffness"))
        penalties = (system.parameter("period") ** 2) * stiffness
        return augmented_iteration(system, penalties, system.gamma, every=True)

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return that of `direct-correction`."""
        return Correction("newton", True, "identity")


KIND = StiffnessScaledPenalty()
