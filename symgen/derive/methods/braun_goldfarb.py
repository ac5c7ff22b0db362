"""Elimination of drift after Braun and Goldfarb: gains of 1/h close violations within a few steps."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Scalar
from symgen.derive.methods.invariant_stabilization import InvariantStabilization


class BraunGoldfarb(InvariantStabilization):
    """`invariant-stabilization` with kappa = 1 / h, where h is the current step.

    ``q' = N (v - M^-1 D^T S^-1 (w + Phi / h))``, ``D v' = gamma - w / h``: the smallest changes of velocities and
    accelerations in the metric of M that close positions and velocities at the end of an Euler step. It reduces the
    order of higher-order schemes. The formula is our reading: only the abstract of the reference was available.
    """

    name = "braun-goldfarb"
    summary = "as `invariant-stabilization` at one over the step: violations vanish within a few steps"
    reference = "Braun, Goldfarb, Comput. Methods Appl. Mech. Eng. 198 (2009) 3151-3160"
    parameters = ()

    def rate(self, system: System) -> Scalar:
        """Return one over the step."""
        return system.inverse_step

    def largest_step(self, parameters: Mapping[str, float], boundary: float) -> float | None:
        """Return 0 if minus one is outside the region of stability, else None: the rate follows the step."""
        return None if boundary >= 1.0 else 0.0


KIND = BraunGoldfarb()
