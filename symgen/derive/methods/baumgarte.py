"""Baumgarte stabilisation: the acceleration constraint is replaced by a damped oscillator in Phi."""

from __future__ import annotations

import math
from collections.abc import Mapping

from symgen.derive.methods._augmented import SOURCE
from symgen.derive.methods._base import SOLVER, MethodOption, MethodParameter, MultiplierMethod
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Vector

#: Rule whose gains follow from the motion, before the run.
MOTION = "motion"


class Baumgarte(MultiplierMethod):
    """``Phi'' + 2 alpha Phi' + beta^2 Phi = 0`` in place of ``Phi'' = 0``.

    ``rule=motion`` sets ``alpha = beta`` to the rate of the motion, rms(v') / rms(v) over its first second: least
    violations of an explicit scheme lie there, as drift falls with the gains and the violations of stages, which the
    gains feed back, grow.

    ``alpha = beta`` is critically damped. The roots ``-alpha +- sqrt(alpha^2 - beta^2)`` belong to the integrated
    system, so they limit the step: ``|root| h < 2.785`` for RK4. Nonholonomic rows have no ``Phi``: their velocity
    residual decays with ``2 alpha``.
    """

    name = "baumgarte"
    summary = "violations decay like a damped oscillator with gains alpha, beta"
    reference = "Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7"
    parameters = (
        MethodParameter("alpha", 5.0, "1/s", f"velocity gain; {SOURCE}"),
        MethodParameter("beta", 5.0, "1/s", f"position gain; {SOURCE}"),
    )

    options = (
        MethodOption("rule", ("fixed", MOTION), "motion: the rate of the first second, from a run before", False),
        SOLVER,
    )

    def target(self, system: System) -> Vector:
        """Return gamma - 2 alpha Phi' - beta^2 Phi, Phi' = D v - nu."""
        alpha, beta = system.parameter("alpha"), system.parameter("beta")
        drift = system.D @ system.v - system.nu
        return system.gamma - (2.0 * alpha) * drift - (beta**2) * system.phi

    def largest_step(self, parameters: Mapping[str, float], boundary: float) -> float | None:
        """Return ``boundary / |root|`` for the root farthest from the origin."""
        alpha, beta = parameters["alpha"], parameters["beta"]
        a, b = 0.5 * alpha, 0.5 * beta  # half of the root, by factors: squares and sums of huge gains overflow
        half = b if a < b else a + math.sqrt(a - b) * math.sqrt(a + b)
        return 0.5 * boundary / half if half > 0.0 else None


KIND = Baumgarte()
