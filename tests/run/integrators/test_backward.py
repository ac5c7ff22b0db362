"""Backward differentiation formulas: their orders, polynomials that they integrate exactly, and what they are for."""

import itertools
import math

import pytest
from scipy.integrate import solve_ivp
from support.emitted import mechanism_of

import symgen

G = 9.81
#: A bead on a wire y = x^2 / 2, pulled along it by its weight.
BEAD = {
    "mechanism": {"name": "bead", "gravity": [0.0, -G]},
    "bodies": {"p": {"type": "point", "mass": 2.0, "position": [1.0, 0.5], "velocity": [0.5, 0.5]}},
    "joints": {"wire": {"type": "rows", "rows": [{"position": "p.y - p.x**2/2", "label": "wire"}]}},
}
CONSTANT = {"integrator.adaptive": "false"}


def bead_at(t):
    """Return x of the bead by Lagrange's equation of its one coordinate."""

    def rate(_, y):
        x, u = y
        return [u, -(x * u * u + G * x) / (1.0 + x * x)]

    found = solve_ivp(rate, (0.0, t), [1.0, 0.5], "DOP853", rtol=3e-14, atol=1e-14)
    return found.y[0, -1]


@pytest.mark.parametrize("method", ["ggl", "direct-correction"])
@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_each_order_by_step_halving(order, method):
    model, exact, errors = symgen.load(mechanism_of(BEAD)), bead_at(0.8), []
    for step in (0.008, 0.004, 0.002):
        options = CONSTANT | {"integrator.order": order}
        result = model.simulate(
            method=method, integrator="bdf", step=step, until=0.8, times=[0.8], options=options, max_energy_error=1.0
        )
        assert result.status == "ok", result.reason
        errors.append(abs(result["p.x"][-1] - exact))
    slopes = [math.log2(a / b) for a, b in itertools.pairwise(errors)]
    assert order - 0.25 < slopes[-1] < order + 0.6, (errors, slopes)
