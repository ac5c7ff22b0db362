"""Radau IIA with three stages: order 5, L-stable, for stiff problems and constraints in every stage."""

from __future__ import annotations

import numpy as np

from symgen.run.integrators._implicit import ImplicitTableau

_S6 = np.sqrt(6.0)
_A = np.array(
    [
        [(88 - 7 * _S6) / 360, (296 - 169 * _S6) / 1800, (-2 + 3 * _S6) / 225],
        [(296 + 169 * _S6) / 1800, (88 + 7 * _S6) / 360, (-2 - 3 * _S6) / 225],
        [(16 - _S6) / 36, (16 + _S6) / 36, 1 / 9],
    ]
)
# 1 / gamma_0 is the real eigenvalue of A^-1
_GAMMA = float(1.0 / max(np.linalg.eigvals(np.linalg.inv(_A)), key=lambda z: -abs(z.imag)).real)
# Hairer's estimate gamma_0 h y'_0 + sum e_i (Y_i - y_0) with Y_i - y_0 = h sum a_ij y'_j
_E = _GAMMA / 3.0 * np.array([-13 - 7 * _S6, -13 + 7 * _S6, -1.0])

KIND = ImplicitTableau(
    name="radau5",
    order=5,
    reference="Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, section IV.8",
    forms=("index-1", "index-2"),
    a=_A,
    b=_A[2],
    c=np.array([(4 - _S6) / 10, (4 + _S6) / 10, 1.0]),
    errors=np.concatenate([[_GAMMA], _E @ _A]),
    error_order=3,
    filter_factor=_GAMMA,
    index2_order=5,
)
