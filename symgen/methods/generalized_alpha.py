"""Index-3 form for the generalised-alpha integrator."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.methods._base import Descriptor, MultiplierMethod
from symgen.methods._formula import System


class GeneralizedAlpha(MultiplierMethod):
    """``M v' = f - D^T lambda``, ``Phi(t, q) = 0`` at the end of every step, by the integrator `generalized-alpha`.

    Positions satisfy their constraints to the tolerance of Newton's iteration; velocities violate theirs by the
    integrator's error of order two, which counts as an error and not as drift. `rho` sets the damping of high
    frequencies, including those of the constraints.
    """

    name = "generalized-alpha"
    summary = "constraints at position level (index 3) with controlled numerical damping"
    reference = "Arnold, Bruls, Multibody Syst. Dyn. 18 (2007) 185-202, doi 10.1007/s11044-007-9084-0"
    forms = ("index-3",)
    default_integrator = "generalized-alpha"
    velocities_follow = True

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the constraints at position level."""
        return Descriptor("position")


KIND = GeneralizedAlpha()
