"""Penalty formulation: constraints as stiff springs, dampers and inertias."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._augmented import MU, OMEGA, stabilised_acceleration
from symgen.derive.methods._base import Acceleration, Descriptor, Method, MethodParameter
from symgen.derive.methods._system import System


class Penalty(Method):
    """``(M + a D^T D) v' = f + a D^T g`` with ``g = gamma - 2 omega mu Phi' - omega^2 Phi``; ``lambda = a (D v' - g)``.

    The first step of the augmented Lagrangian method, not iterated: the constraints hold up to an error that falls like
    1 / a, while rounding grows like a. a is in units of the mean mass, so both are the same for light and heavy
    mechanisms. M + a D^T D is positive definite, so redundant rows need no special treatment.
    """

    name = "penalty"
    summary = "constraints as stiff elements; the error falls like 1 / penalty"
    reference = (
        "Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195; "
        "Ruzzeh, Kovecses, J. Comput. Nonlinear Dyn. 6 (2011) 021008"
    )
    forms = ("ode", "index-1")
    parameters = (
        MethodParameter(
            "penalty",
            1e9,
            "1",
            "factor a of D^T D over the mean mass: the error falls like 1 / a until rounding, which grows like a, "
            "takes over near 1e10",
            1e-300,
        ),
        OMEGA,
        MU,
    )

    def law(self, system: System, options: Mapping[str, str]) -> Acceleration:
        """Return the law: one solve with M + a D^T D."""
        penalties = system.penalties(system.of_mean_mass(system.parameter("penalty")))
        target = stabilised_acceleration(system)
        right = system.f + system.D.transposed(penalties.times(target))
        acceleration = system.solve(system.augmented_factor(penalties), right)
        return Acceleration(acceleration, penalties.times(system.D @ acceleration - target))

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the same equations with lambda = a (D v' - g) kept as an unknown."""
        compliance = system.inverses(system.of_mean_mass(system.parameter("penalty")))
        return Descriptor("acceleration", stabilised_acceleration(system), compliance)


KIND = Penalty()
