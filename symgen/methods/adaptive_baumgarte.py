"""Baumgarte stabilisation with gains that follow the step size."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from symgen.methods._base import Acceleration, Method, MethodParameter, multiplier_law

if TYPE_CHECKING:
    from symgen.lower.algebra import System

class AdaptiveBaumgarte(Method):
    """`baumgarte` with ``alpha = a / h`` and ``beta = b / h``, h being the step that is taken.

    Gains that are right for one step are weak or unstable for another one. Lin and Huang choose them from the stability
    region of the integrator, so that violations are damped within a few steps: for Runge-Kutta of order 4 they take gains
    of the size of 1 / h. With the defaults a = b = 1 both roots lie at -1 / h, well inside the region of all explicit
    integrators here, whose real boundary is at least 2.
    """

    name = "adaptive-baumgarte"
    summary = "Baumgarte's gains as multiples of one over the step"
    reference = (
        "Chang, Nikravesh, J. Mech. Trans. Autom. Des. 107 (1985) 488-492; "
        "Lin, Huang, J. Mech. Des. 124 (2002) 633-640, doi 10.1115/1.1519277"
    )
    parameters = (
        MethodParameter("a", 1.0, "1", "velocity gain times the step"),
        MethodParameter("b", 1.0, "1", "position gain times the step"),
    )

    def law(self, system: System, options: Mapping[str, str]) -> Acceleration:
        """Return the law: gamma - 2 (a / h) Phi' - (b / h)^2 Phi."""
        rate = system.inverse_step
        alpha, beta = system.parameter("a") * rate, system.parameter("b") * rate
        drift = system.D @ system.v - system.nu
        return multiplier_law(system, system.gamma - (2.0 * alpha) * drift - (beta**2) * system.phi)


KIND = AdaptiveBaumgarte()
