"""A half-explicit Runge-Kutta scheme of order 3 on index 2: its stages satisfy D v = nu."""

from __future__ import annotations

import numpy as np

from symgen.run.integrators._constrained import ConstrainedTableau

KIND = ConstrainedTableau(
    name="half-explicit",
    order=3,
    reference="Brasey, Hairer, SIAM J. Numer. Anal. 30 (1993) 538-552, doi 10.1137/0730025",
    forms=("index-2-explicit",),
    scheme="half_explicit",
    a=np.array([[1 / 3, 0.0, 0.0], [-1.0, 2.0, 0.0], [0.0, 3 / 4, 1 / 4]]),
    c=np.array([1 / 3, 1.0, 1.0]),
    real_boundary=2.5127,
)
