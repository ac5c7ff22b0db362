"""Index-3 augmented Lagrangian method with projections of velocities and accelerations (ALI3-P)."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._base import Descriptor, MethodParameter, MultiplierMethod
from symgen.derive.methods._system import System


class Index3AugmentedLagrangian(MultiplierMethod):
    """``M v' + D^T (lambda + a Phi) = f`` at the end of a trapezoidal step, ``lambda += a Phi`` until Phi = 0.

    The leading matrix ``W = M + h/2 C + h^2/4 (a D^T D + K)`` has the exact stiffness K and damping C of forces and
    constraints. Velocities and accelerations, which the trapezoidal rule leaves off their constraints, are projected
    with W. Nonholonomic rows have ``h/2 a (D v - nu)`` in place of a Phi, and the same term of W. With h^2/4 a D M^-1
    D^T well above 1 a few iterations suffice; redundant constraints need no special treatment.
    """

    name = "index3-augmented-lagrangian"
    summary = "trapezoidal rule in positions with iterated multipliers, velocities and accelerations projected (ALI3-P)"
    reference = (
        "Cuadrado, Cardenal, Morer, Bayo, Multibody Syst. Dyn. 4 (2000) 55-73; "
        "Dopico, Gonzalez, Cuadrado, Kovecses, J. Comput. Nonlinear Dyn. 9 (2014) 041006"
    )
    forms = ("index-3-projected",)
    default_integrator = "trapezoidal"
    parameters = (
        MethodParameter("penalty", 1e9, "1/s^2", "factor a of D^T D at position level over the mean mass", 1e-300),
    )

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the constraints at position level and of the projections."""
        return Descriptor("projected", system.gamma)


KIND = Index3AugmentedLagrangian()
