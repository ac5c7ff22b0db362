"""Implicit constraint enforcement: accelerations that put the end of the step on the linearised constraints."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._base import Descriptor, MethodParameter, MultiplierMethod
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Vector


class ImplicitConstraint(MultiplierMethod):
    """``D v' = -w / h - e Phi / h^2``, w = D v - nu and h the step: with ``v1 = v + h v'``, ``D v1 = nu - e Phi / h``.

    With e = 1 and `symplectic-euler`, whose positions move by ``h v1``, this is one Newton step of SHAKE for ``Phi(q1)
    = 0``. gamma is omitted: the step itself produces the quadratic terms. Game engines take the same step with the
    error reduction e of 0.2 to 0.8. Both constraints are violated by the scheme's error, of order 1 in velocities.
    """

    name = "implicit-constraint"
    summary = "the step that ends on the linearised constraints, as in game engines; with symplectic-euler"
    reference = (
        "Hong, Welch, Trapp, Choi, Proc. Pacific Graphics 2005; Baraff, SIGGRAPH 1996; error reduction as in R. Smith, "
        "Open Dynamics Engine, 2006"
    )
    forms = ("semi-implicit",)
    default_integrator = "symplectic-euler"
    parameters = (
        MethodParameter("erp", 1.0, "1", "e, the part of Phi that a step takes away; 1 is all of it, chosen here"),
    )

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return None: the law belongs to an explicit step."""
        return None

    def target(self, system: System) -> Vector:
        """Return -w / h - e Phi / h^2."""
        rate, drift = system.inverse_step, system.D @ system.v - system.nu
        return -(rate * drift) - (system.parameter("erp") * rate**2) * system.phi


KIND = ImplicitConstraint()
