"""Backward differentiation formulas: their orders, polynomials that they integrate exactly, and what they are for."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError

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


def test_steps_of_any_length_integrate_polynomials_of_its_degree_exactly():
    """Outputs between steps are ends of shorter steps, so past states have unequal distances."""
    states = {f"z{n}": {"rate": f"{n}*t**{n - 1}", "start": 0.0} for n in (1, 2, 3, 4, 5)}
    model = symgen.load(mechanism_of(BEAD | {"states": states}))
    times = np.array([0.0, 0.13, 0.31, 0.312, 0.55, 0.8])
    settings = {"integrator": "bdf", "step": 0.01, "until": 0.8, "times": times, "options": CONSTANT}
    result = model.simulate(method="ggl", max_energy_error=1.0, **settings)
    for n in (1, 2, 3, 4, 5):
        np.testing.assert_allclose(result[f"z{n}"], times**n, rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("method", ["ggl", "direct-correction"])
def test_errors_follow_the_tolerance(method):
    model, exact, errors, steps = symgen.load(mechanism_of(BEAD)), bead_at(6.0), [], []
    for rtol in (1e-5, 1e-7, 1e-9):
        result = model.simulate(method=method, integrator="bdf", rtol=rtol, atol=rtol, until=6.0, times=[6.0])
        assert result.status == "ok" and result.position_violation_max < 1e-12, result.reason
        errors.append(abs(result["p.x"][-1] - exact))
        steps.append(result.steps)
    assert errors[0] < 3e-3 and errors[1] < 5e-5 and errors[2] < 1e-6, errors
    assert steps[2] < 1400 and steps[0] < 300, steps


def test_a_stiff_rate_takes_steps_of_the_motion():
    """The solution decays with 1e6 1/s to a sine, on which an explicit scheme would take a million steps."""
    states = {"z": {"rate": "-1e6*(z - sin(t)) + cos(t)", "start": 0.5}}
    result = symgen.load(mechanism_of(BEAD | {"states": states})).simulate(
        method="ggl", integrator="bdf", rtol=1e-7, atol=1e-7, until=2.0
    )
    assert result.status == "ok" and result.steps < 700 and result.rejected < 40
    np.testing.assert_allclose(result["z"][1:], np.sin(result.t[1:]), rtol=0.0, atol=1e-6)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_run_begins_anew_after_each_bounce():
    """A ball with restitution 1/2 on the ground: times of impacts in closed form."""
    ball = {
        "mechanism": {"name": "ball", "gravity": [0.0, -G]},
        "bodies": {"p": {"type": "point", "mass": 1.0, "position": [0.0, 1.0]}},
        "stops": {"floor": {"gap": "p.y", "restitution": 0.5}},
    }
    result = symgen.load(mechanism_of(ball)).simulate(
        method="ggl", integrator="bdf", rtol=1e-9, atol=1e-9, until=1.2, verify=False
    )
    first = math.sqrt(2.0 / G)
    hits = [event.t for event in result.outcome.happened if event.name == "floor.hit"]
    np.testing.assert_allclose(hits, [first, 2.0 * first, 2.5 * first], rtol=0.0, atol=1e-7)


def test_the_order_is_a_whole_number():
    for value in (2.5, 6, 0):
        with pytest.raises(InputError, match=r"option integrator.order: expected a whole number from 1 to 5, got"):
            symgen.load(mechanism_of(BEAD)).simulate(
                method="ggl", integrator="bdf", options={"integrator.order": value}, until=0.1
            )


def test_steps_with_a_history_have_no_derivatives():
    run = symgen.load(mechanism_of(BEAD)).start(method="ggl", integrator="bdf")
    run.step(0.01)
    with pytest.raises(InputError, match="expected a scheme whose steps have derivatives"):
        run.derivatives()
