"""The classical Runge-Kutta scheme of order 4, the source's integrator."""

from __future__ import annotations

import numpy as np

from symgen.run.integrators._tableau import Tableau

KIND = Tableau(
    name="rk4",
    order=4,
    reference="Kutta, Z. Math. Phys. 46 (1901) 435-453",
    a=np.array([[0.0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1.0, 0]]),
    b=np.array([1 / 6, 1 / 3, 1 / 3, 1 / 6]),
    c=np.array([0.0, 0.5, 0.5, 1.0]),
    real_boundary=2.785,
)
