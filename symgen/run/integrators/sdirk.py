"""The singly diagonally implicit scheme of order 4 of Hairer and Wanner: L-stable and stiffly accurate.

Their error estimate is 1/4 of (0, -3/4, -27/8, 25/8, 0, 1), the difference to an embedded formula of order 3. It
omits the derivative at the beginning of a step: a jump before the first stage, at a quarter of the step, affects all
stages alike. Other formulas of order 3 that contain this derivative, but not the fourth stage, differ by multiples of
(1, -11/4, -11/8, 25/8, 0, 0). A twentieth of that is added: a jump anywhere in a step counts for a twentieth of its
effect or more, and estimates of smooth motions keep their size.
"""

from __future__ import annotations

import numpy as np

from symgen.run.integrators._implicit import ImplicitTableau

_A = np.array(
    [
        [1 / 4, 0, 0, 0, 0],
        [1 / 2, 1 / 4, 0, 0, 0],
        [17 / 50, -1 / 25, 1 / 4, 0, 0],
        [371 / 1360, -137 / 2720, 15 / 544, 1 / 4, 0],
        [25 / 24, -49 / 48, 125 / 16, -85 / 12, 1 / 4],
    ]
)
_ERRORS = np.array([0, -3 / 4, -27 / 8, 25 / 8, 0, 1]) / 4 + np.array([1, -11 / 4, -11 / 8, 25 / 8, 0, 0]) / 20

KIND = ImplicitTableau(
    name="sdirk",
    order=4,
    reference="Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, table IV.6.5",
    forms=("index-1",),
    a=_A,
    b=_A[4],
    c=np.array([1 / 4, 3 / 4, 11 / 20, 1 / 2, 1.0]),
    errors=_ERRORS,
    error_order=3,
    filter_factor=0.25,
)
