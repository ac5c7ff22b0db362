"""The implicit trapezoidal rule: order 2, A-stable, without numerical damping."""

from __future__ import annotations

import numpy as np

from symgen.integrators._implicit import ImplicitTableau

KIND = ImplicitTableau(
    name="trapezoidal",
    order=2,
    reference="Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, section IV.3",
    forms=("index-1",),
    a=np.array([[0.0, 0.0], [0.5, 0.5]]),
    b=np.array([0.5, 0.5]),
    c=np.array([0.0, 1.0]),
)
