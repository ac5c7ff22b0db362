"""Baumgarte stabilisation with gains that depend on the step size."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.errors import InputError
from symgen.derive.methods._augmented import SOURCE
from symgen.derive.methods._base import SOLVER, MethodOption, MethodParameter, MultiplierMethod
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Vector

#: The zero of the stability function of `rk4`, z^4 + 4 z^3 + 12 z^2 + 24 z + 24, that is nearest to the real axis.
_ZERO = (1.729444231067705, 0.8889743761218646)


class AdaptiveBaumgarte(MultiplierMethod):
    """`baumgarte` with gains that depend on the step h.

    ``rule=gain``: ``alpha = beta = min(gain, a / h)``, our own choice: a / h keeps the root inside the region of
    stability of every explicit integrator but `abm`, whatever the step, and `gain` bounds it where steps are short.
    ``rule=taylor``: ``alpha = 1 / h``, ``beta = sqrt(2) / h``, from ``Phi + h Phi' + h^2 Phi'' / 2 = 0``.
    ``rule=pole-placed``: the roots are zeros of the integrator's stability function over h, so that one step ends a
    violation of linear constraints.

    It provides stability at any step, not accuracy: gains that grow like 1 / h feed back the violations of the stages,
    which are no error of the step, times 1 / h^2, and reduce any integrator to order 2.
    """

    name = "adaptive-baumgarte"
    summary = "Baumgarte's gains by the step: stable at any step; gains of 1/h leave order 2"
    reference = (
        "Chang, Nikravesh, J. Mech. Trans. Autom. Des. 107 (1985) 488-492 (gains that follow the run); "
        "Weijia, Zhenkuan, Yibing, Appl. Math. Mech. 21 (2000) 103-108 (taylor); "
        "Lin, Hong, J. Mech. Des. 120 (1998) 565-572; "
        "Lin, Huang, J. Mech. Des. 124 (2002) 633-640, doi 10.1115/1.1519277 (pole-placed)"
    )
    parameters = (
        MethodParameter("gain", 5.0, "1/s", f"rule=gain: largest gain alpha = beta; for `baumgarte` {SOURCE}"),
        MethodParameter("a", 1.0, "1", "rule=gain: largest gain times the step"),
        MethodParameter("decay", _ZERO[0], "1", "rule=pole-placed: minus the real part of the root times the step"),
        MethodParameter("frequency", _ZERO[1], "1", "rule=pole-placed: the imaginary part of the same"),
    )
    options = (
        MethodOption("rule", ("gain", "taylor", "pole-placed"), "how the gains follow from the step"),
        SOLVER,
    )

    def chosen_target(self, system: System, options: Mapping[str, str]) -> Vector:
        """Return gamma - 2 alpha Phi' - beta^2 Phi."""
        per_step = system.inverse_step
        if options["rule"] == "gain":
            alpha = system.parameter("gain").smaller(system.parameter("a") * per_step)
            square = alpha**2
        elif options["rule"] == "taylor":
            alpha, square = per_step, 2.0 * per_step**2
        else:
            decay = system.parameter("decay")
            alpha = decay * per_step
            square = (decay**2 + system.parameter("frequency") ** 2) * per_step**2
        drift = system.D @ system.v - system.nu
        return system.gamma - (2.0 * alpha) * drift - square * system.phi

    def placed(self, options: Mapping[str, str], zero: complex | None, integrator: str) -> dict[str, float]:
        """Return the zero of the integrator's stability function, for the rule that uses it."""
        if options["rule"] != "pole-placed":
            return {}
        if zero is None:
            expected = "an explicit Runge-Kutta scheme, whose stability function has zeros, for rule=pole-placed"
            raise InputError(f"integrator '{integrator}'", expected, "another one")
        return {"decay": -zero.real, "frequency": zero.imag}


KIND = AdaptiveBaumgarte()
