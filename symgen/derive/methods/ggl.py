"""Gear-Gupta-Leimkuhler: stabilised index 2, positions and velocities enforced together."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._base import Descriptor, MultiplierMethod
from symgen.derive.methods._system import System


class Ggl(MultiplierMethod):
    """``q' = N (v - D^T eta)``, ``M v' = f - D^T lambda``, ``Phi = 0``, ``D v = nu``; eta vanishes on solutions.

    For implicit integrators only: every stage satisfies the constraints at both levels and needs no correction.
    Nonholonomic rows have no Phi: their eta is set to 0.
    """

    name = "ggl"
    summary = "stabilised index 2: constraints at position and velocity level in every implicit stage"
    reference = "Gear, Leimkuhler, Gupta, J. Comput. Appl. Math. 12-13 (1985) 77-90, doi 10.1016/0377-0427(85)90008-1"
    forms = ("index-2",)
    default_integrator = "radau5"

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the constraints at both levels."""
        return Descriptor("stabilised")


KIND = Ggl()
