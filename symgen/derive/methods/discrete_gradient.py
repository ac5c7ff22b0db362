"""Energy to rounding: forces and constraint forces averaged along the path of a step."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._base import Descriptor, MultiplierMethod
from symgen.derive.methods._system import System


class DiscreteGradient(MultiplierMethod):
    """``M (v1 - v0) = h (mean of f - mean of D^T lambda)`` along the step, ``Phi(q1) = 0``, at the mean velocity.

    The energy of motions without damping and drivers is kept to rounding where M is constant, as in absolute
    coordinates; so are linear momenta, and angular ones of points at distances. Velocities violate their constraint by
    the error of order two, which does not grow. Multipliers and accelerations of results are those of `lagrange`.
    """

    name = "discrete-gradient"
    summary = "index 3 on the mean of a step: positions on their constraints, energy kept to rounding"
    reference = (
        "Gonzalez, Physica D 132 (1999) 165-174, doi 10.1016/S0167-2789(99)00054-8; "
        "Betsch, Steinmann, Int. J. Numer. Methods Eng. 53 (2002) 2271-2304, doi 10.1002/nme.347"
    )
    forms = ("index-3-mean",)
    default_integrator = "discrete-gradient"
    velocities_follow = True

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the constraints at position level, with M and D as the only derivatives."""
        return Descriptor("explicit")


KIND = DiscreteGradient()
