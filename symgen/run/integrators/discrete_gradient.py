"""Discrete gradient: forces and D averaged along the path of a step; order 2, energy to rounding."""

from __future__ import annotations

import numpy as np

from symgen.run.integrators._constrained import ConstrainedTableau

KIND = ConstrainedTableau(
    name="discrete-gradient",
    order=2,
    reference=(
        "Gonzalez, Physica D 132 (1999) 165-174, doi 10.1016/S0167-2789(99)00054-8; "
        "Quispel, McLaren, J. Phys. A 41 (2008) 045206, doi 10.1088/1751-8113/41/4/045206"
    ),
    forms=("index-3-mean",),
    scheme="discrete_gradient",
    a=np.ones((1, 1)),
    c=np.ones(1),
    real_boundary=2.0,
)
