"""Heun's scheme of order 2: the explicit trapezoidal rule."""

from __future__ import annotations

import numpy as np

from symgen.run.integrators._tableau import Tableau

KIND = Tableau(
    name="heun",
    order=2,
    reference="Heun, Z. Math. Phys. 45 (1900) 23-38",
    a=np.array([[0.0, 0.0], [1.0, 0.0]]),
    b=np.array([0.5, 0.5]),
    c=np.array([0.0, 1.0]),
    real_boundary=2.0,
)
