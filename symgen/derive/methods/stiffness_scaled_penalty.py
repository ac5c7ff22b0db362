"""Multipliers by penalties in proportion to stiffness: redundant rows share the load."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from symgen.base.ir.program import Correction
from symgen.derive.methods._base import (
    TOLERANCE,
    Acceleration,
    Iteration,
    Method,
    MethodOption,
    MethodParameter,
    augmented_iteration,
    multiplier_law,
)
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Vector

#: The largest penalty over the mean mass, and how often what a solution leaves of the force is solved for again: each
#: pass leaves a part m / a of it.
_HEAVY, _PASSES = 1e6, 6


class StiffnessScaledPenalty(Method):
    """The motion of `direct-correction` with the multipliers of elastic rows of stiffness k.

    The independent rows determine the constraint force F = D^T lambda. ``(M + D^T a D) z = F``,
    ``lambda += a D z``, ``F -= D^T a D z`` with penalties a like the stiffness k, of redundant rows as well, gives
    ``lambda = k D z``: loads are shared in proportion to k. Penalties act on multipliers alone: redundant rows
    are independent at the stages of a step, so that in the law itself their penalties would change the motion.
    """

    name = "stiffness-scaled-penalty"
    dense = "which reads the stiffness of single rows"
    summary = "the motion of direct-correction; redundant rows share their load like their stiffness"
    reference = (
        "Ruzzeh, Kovecses, J. Comput. Nonlinear Dyn. 6 (2011) 021008; "
        "Gonzalez, Kovecses, Multibody Syst. Dyn. 29 (2013) 57-76, doi 10.1007/s11044-012-9322-y"
    )
    unique_multipliers = True
    parameters = (
        MethodParameter("stiffness", 1e9, "N/m", "of rows for which the file names none; chosen here", 1e-300),
        TOLERANCE,
    )
    options = (
        MethodOption(
            "solver",
            ("elimination", "augmented"),
            "how v' is computed: by elimination, or with M + W D^T D, for light and massless bodies",
        ),
    )

    def law(self, system: System, options: Mapping[str, str]) -> Acceleration | Iteration:
        """Return the motion of `direct-correction` and multipliers in proportion to the stiffness."""
        if options["solver"] == "augmented":
            iterated = augmented_iteration(system, system.heavy_penalty, system.gamma)
            multipliers = system.variable("multipliers", system.gamma.size)
            return replace(iterated, multipliers=self._multipliers_by_stiffness(system, multipliers))
        motion = multiplier_law(system, system.gamma)
        return Acceleration(motion.acceleration, self._multipliers_by_stiffness(system, motion.multipliers))

    def _multipliers_by_stiffness(self, system: System, multipliers: Vector) -> Vector:
        """Return multipliers of the same force in proportion to the stiffness."""
        stiffness = system.row_stiffness(system.parameter("stiffness"))
        penalties = (_HEAVY * system.scale("mean_mass") / stiffness.dot(stiffness).root()) * stiffness
        factor = system.augmented_factor(penalties)
        left = system.D.transposed(multipliers)
        shared = system.zeros("m")
        for _ in range(_PASSES):
            more = penalties.times(system.D @ system.solve(factor, left))
            shared, left = shared + more, left - system.D.transposed(more)
        return shared

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return the correction of `direct-correction`."""
        return Correction("newton", True, "identity")


KIND = StiffnessScaledPenalty()
