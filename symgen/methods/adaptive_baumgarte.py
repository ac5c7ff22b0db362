"""Baumgarte stabilisation with gains that follow the step size."""

from __future__ import annotations

from symgen.methods._base import MethodParameter, MultiplierMethod
from symgen.methods._formula import System, Vector


class AdaptiveBaumgarte(MultiplierMethod):
    """`baumgarte` with ``alpha = beta = min(gain, a / h)``, h being the step that is taken.

    Fixed gains are weak for one step and unstable for another one; Chang and Nikravesh adapt them while the run goes
    on, Lin and Huang take them from the integrator's region of stability as a multiple of 1 / h. Both readings meet
    here: a / h keeps the root of the violations inside the region of every explicit integrator (whose real boundary
    is at least 2), whatever the step, and `gain` bounds it where steps are short: gains that grow like 1 / h feed the
    stages' own violations back and cost the integrator its order.
    """

    name = "adaptive-baumgarte"
    summary = "Baumgarte's gains bounded by a multiple of one over the step"
    reference = (
        "Chang, Nikravesh, J. Mech. Trans. Autom. Des. 107 (1985) 488-492; "
        "Lin, Huang, J. Mech. Des. 124 (2002) 633-640, doi 10.1115/1.1519277"
    )
    parameters = (
        MethodParameter("gain", 20.0, "1/s", "largest gain alpha = beta"),
        MethodParameter("a", 1.0, "1", "largest gain times the step"),
    )

    def target(self, system: System) -> Vector:
        """Return gamma - 2 alpha Phi' - alpha^2 Phi."""
        alpha = system.parameter("gain").smaller(system.parameter("a") * system.inverse_step)
        drift = system.D @ system.v - system.nu
        return system.gamma - (2.0 * alpha) * drift - (alpha**2) * system.phi


KIND = AdaptiveBaumgarte()
