"""The symplectic Euler scheme: order 1, one evaluation per step, used by game engines."""

from __future__ import annotations

from typing import Any

import numpy as np

from symgen.run.integrators.rkmk4 import LieTableau


class SymplecticEuler(LieTableau):
    """``v1 = v0 + h v'(q0, v0)``, then q1 is q0 advanced by ``h v1``."""

    def loop(self, adaptive: bool) -> Any:
        """Return the loop of the scheme."""
        from symgen.run.loops.schemes import symplectic

        return symplectic.constant


KIND = SymplecticEuler(
    name="symplectic-euler",
    order=1,
    forms=("ode", "semi-implicit"),
    reference="Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., Springer 2006, section I.1.2",
    a=np.zeros((1, 1)),
    b=np.array([1.0]),
    c=np.zeros(1),
    real_boundary=2.0,
)
