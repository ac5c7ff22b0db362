"""Formulas that are not defined where a few evaluations of plain Python look at them: numbers that are nan there."""

from __future__ import annotations

import math

import numpy as np
import pytest

import symgen
from symgen.compiling.linearised import compile_linearised
from symgen.compiling.pipeline import choose_method, compile_model
from symgen.describe import MechanismBuilder


def sliding(force, velocity=0.0):
    """A mass of 2 kg on a guide, pushed by a formula."""
    return (
        MechanismBuilder("undefined")
        .run(until=0.5, step=0.01)
        .body("mass", mass=2.0, inertia=0.1, velocity=(velocity, 0.0))
        .joint("guide", "translational", between=("ground", "mass"), at=((0.0, 0.0), "centre"), axis=(1.0, 0.0))
        .force("push", "force", body="mass", force=(force, 0.0))
    )


#: A force, and its slope by the velocity of the mass, as floating-point numbers have it; roots rise by a number that is
#: as good as no bound, of which nothing is left where what they are taken of does not change.
SLOPES = (
    ("-sqrt(abs(mass.vx))", 0.0, 0.0),
    ("-sqrt(mass.vx)", -1.0, math.nan),
    ("-sqrt(mass.vx)", 0.0, -5e99),
    ("-log(mass.vx)", 0.0, -math.inf),
    ("-exp(mass.vx)", 1e4, -math.inf),
    ("-sqrt(mass.vx)", 4.0, -0.25),
)


@pytest.mark.parametrize(("force", "velocity", "slope"), SLOPES)
def test_derivatives_where_they_do_not_exist(force, velocity, slope):
    mechanism = sliding(force).build()
    compiled = compile_model(mechanism, choose_method("lagrange"))
    form, y = compile_linearised(mechanism, compiled), np.zeros(compiled.info.ny)
    y[compiled.info.nq] = velocity
    found = form.at(0.0, y, np.zeros(3), compiled.parameter_array({}, {}), compiled.scratch())
    np.testing.assert_allclose(found.by("balance", "v")[0, 0], -slope, rtol=1e-14)


def test_methods_are_chosen_where_a_force_has_no_slope():
    """A force of 3 N less sqrt(v), from rest: the time to v is the integral of 2/(3 - sqrt(v))."""
    model = symgen.load(sliding("3 - sqrt(abs(mass.vx))").build())
    found = model.simulate(method="auto", integrator="auto", rtol=1e-9)
    assert found.status == "ok"
    root = math.sqrt(found.v["mass.vx"][-1])
    assert 4.0 * (-root - 3.0 * math.log1p(-root / 3.0)) == pytest.approx(0.5, rel=1e-6)


def test_a_reset_that_is_not_defined_at_rest():
    """A ball of 1 kg falls 5 m at 10 m/s^2 and is thrown back at sqrt(v^2 - 19) = 9 m/s."""
    mechanism = (
        MechanismBuilder("thrown-back", gravity=(0.0, -10.0))
        .run(until=1.5, step=0.01)
        .body("ball", type="point", mass=1.0, position=(0.0, 5.0))
        .event("floor", when="ball.y < 0", reset={"ball.vy": "sqrt(ball.vy**2 - 19)"})
        .build()
    )
    found = symgen.load(mechanism).simulate(method="lagrange", times=(1.5,))
    assert found.status == "ok" and len(found.events) == 1
    assert found.v["ball.vy"][-1] == pytest.approx(9.0 - 5.0, rel=1e-8)
