"""RATTLE: positions and velocities on their constraints after every explicit step, reversible in time."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.derive.methods._base import Descriptor, MultiplierMethod
from symgen.derive.methods._system import System


class Rattle(MultiplierMethod):
    """``Phi(q1) = 0`` by forces along D_0^T in the first half of a step, ``D_1 v1 = nu`` by D_1^T in the second one.

    Explicit for position-dependent forces, of order 2 and reversible: the error of energy stays bounded over very long
    runs. Multipliers and accelerations of results are those of `lagrange`.
    """

    name = "rattle"
    summary = "index 3, explicit: positions and velocities on their constraints, reversible, energy bounded"
    reference = (
        "Ryckaert, Ciccotti, Berendsen, J. Comput. Phys. 23 (1977) 327-341; Andersen, J. Comput. Phys. 52 (1983) "
        "24-34, doi 10.1016/0021-9991(83)90014-1"
    )
    forms = ("index-3-explicit",)
    default_integrator = "rattle"

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the constraints at position and velocity level, with M and D as the only derivatives."""
        return Descriptor("explicit")


KIND = Rattle()
