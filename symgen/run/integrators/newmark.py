"""Newmark's scheme; with its default parameters the average acceleration, which is the trapezoidal rule."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.run.integrators._alpha import AlphaFamily
from symgen.run.loops.integrator import IntegratorParameter


def _coefficients(values: Mapping[str, float]) -> tuple[float, float, float, float]:
    return 0.0, 0.0, values["gamma"], values["beta"]


KIND = AlphaFamily(
    name="newmark",
    order=2,
    reference="Newmark, J. Eng. Mech. Div. 85 (1959) 67-94",
    forms=("index-1",),
    parameters=(
        IntegratorParameter("gamma", 0.5, "above 1/2 it damps and is of order 1", 0.5, 1.0),
        IntegratorParameter("beta", 0.25, "at least (gamma + 1/2)^2 / 4 for unconditional stability", 0.0, 1.0),
    ),
    coefficients=_coefficients,
)
