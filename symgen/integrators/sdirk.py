"""The singly diagonally implicit scheme of order 4 of Hairer and Wanner: L-stable and stiffly accurate."""

from __future__ import annotations

import numpy as np

from symgen.integrators._implicit import ImplicitTableau

_A = np.array(
    [
        [1 / 4, 0, 0, 0, 0],
        [1 / 2, 1 / 4, 0, 0, 0],
        [17 / 50, -1 / 25, 1 / 4, 0, 0],
        [371 / 1360, -137 / 2720, 15 / 544, 1 / 4, 0],
        [25 / 24, -49 / 48, 125 / 16, -85 / 12, 1 / 4],
    ]
)
_LOWER = np.array([59 / 48, -17 / 96, 225 / 32, -85 / 12, 0])

KIND = ImplicitTableau(
    name="sdirk",
    order=4,
    reference="Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, table IV.6.5",
    forms=("index-1",),
    a=_A,
    b=_A[4],
    c=np.array([1 / 4, 3 / 4, 11 / 20, 1 / 2, 1.0]),
    errors=np.concatenate([[0.0], _A[4] - _LOWER]),
    error_order=3,
    filter_factor=0.25,
)
