"""Generalised-alpha for constraints at position level: order 2 with numerical damping chosen by `rho`."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.run.integrators._alpha import AlphaFamily
from symgen.run.loops.integrator import IntegratorParameter


def _coefficients(values: Mapping[str, float]) -> tuple[float, float, float, float]:
    rho = values["rho"]
    alpha_m, alpha_f = (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0)
    gamma = 0.5 + alpha_f - alpha_m
    return alpha_m, alpha_f, gamma, 0.25 * (gamma + 0.5) ** 2


KIND = AlphaFamily(
    name="generalized-alpha",
    order=2,
    reference=(
        "Chung, Hulbert, J. Appl. Mech. 60 (1993) 371-375; "
        "Arnold, Bruls, Multibody Syst. Dyn. 18 (2007) 185-202, doi 10.1007/s11044-007-9084-0"
    ),
    forms=("index-3",),
    parameters=(
        IntegratorParameter(
            "rho", 0.9, "spectral radius at infinite frequency; 1 (no damping) is refused on index 3", 0.0, 0.999
        ),
    ),
    coefficients=_coefficients,
    estimates=True,
)
