"""Index-3 form for the generalised-alpha integrator."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.ir.program import Correction
from symgen.derive.methods._base import SOLVER, Descriptor, MethodOption, MultiplierMethod
from symgen.derive.methods._system import System


class GeneralizedAlpha(MultiplierMethod):
    """``M v' = f - D^T lambda``, ``Phi(t, q) = 0`` at the end of every step, by the integrator `generalized-alpha`.

    Positions satisfy their constraints to the tolerance of Newton's iteration; velocities violate theirs by the
    integrator's error of order two, which counts as an error and not as drift. `rho` sets the damping of high
    frequencies, including those of the constraints.

    ``index=2`` also projects the velocities at the end of every step, ``v -= M^-1 D^T mu`` with ``D v = nu``, by
    multipliers of their own: they then satisfy their constraints to rounding, at the same order.
    """

    name = "generalized-alpha"
    summary = "constraints at position level (index 3) with controlled numerical damping"
    reference = (
        "Arnold, Bruls, Multibody Syst. Dyn. 18 (2007) 185-202, doi 10.1007/s11044-007-9084-0; "
        "Lunk, Simeon, ZAMM 86 (2006) 772-784 (index=2)"
    )
    options = (
        MethodOption("index", ("3", "2"), "2: velocities are projected onto their constraints after each step"),
        SOLVER,
    )
    forms = ("index-3",)
    default_integrator = "generalized-alpha"
    velocities_follow = True

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the constraints at position level."""
        return Descriptor("position")

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return the projection of velocities in the metric of M, for index 2."""
        return Correction("none", True, "mass") if options["index"] == "2" else Correction()

    def needs_regular_mass(self, options: Mapping[str, str]) -> bool:
        """Whether the projection inverts M."""
        return options["index"] == "2"


KIND = GeneralizedAlpha()
