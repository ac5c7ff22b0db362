"""The method of Hilber, Hughes and Taylor for constraints at position level, as Adams and Chrono have it."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.run.integrators._alpha import AlphaFamily
from symgen.run.loops.integrator import IntegratorParameter


def _coefficients(values: Mapping[str, float]) -> tuple[float, float, float, float]:
    alpha = values["alpha"]
    return 0.0, -alpha, 0.5 - alpha, 0.25 * (1.0 - alpha) ** 2


KIND = AlphaFamily(
    name="hht",
    order=2,
    reference=(
        "Hilber, Hughes, Taylor, Earthq. Eng. Struct. Dyn. 5 (1977) 283-292; Negrut, Rampalli, Ottarsson, Sajdak, "
        "J. Comput. Nonlinear Dyn. 2 (2007) 73-85, doi 10.1115/1.2389231"
    ),
    forms=("index-3",),
    parameters=(
        IntegratorParameter("alpha", -0.2, "-1/3 damps most; 0 (no damping) is refused on index 3", -1.0 / 3.0, -0.001),
    ),
    coefficients=_coefficients,
    estimates=True,
)
