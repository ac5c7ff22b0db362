"""RATTLE: two half steps of velocities around one step of positions; order 2, its own adjoint."""

from __future__ import annotations

import numpy as np

from symgen.run.integrators._constrained import ConstrainedTableau

KIND = ConstrainedTableau(
    name="rattle",
    order=2,
    reference="Andersen, J. Comput. Phys. 52 (1983) 24-34, doi 10.1016/0021-9991(83)90014-1",
    forms=("index-3-explicit",),
    scheme="rattle",
    a=np.ones((1, 1)),
    c=np.ones(1),
    real_boundary=2.0,
)
