"""Steps that the state alone chose, and are too long for its derivatives: found, and reported with the time."""

import math
import re

import numpy as np
import pytest
from scipy.integrate import RK45

import symgen
from tests.run.directions.lengths import ROD, model

#: Of small swings of the rod.
RATE = math.sqrt(1.5 * 9.81)
SENTENCE = (
    r"steps follow the state alone: in the one that ends at t = [\d.]+ s the derivative by \w+ errs by about "
    r"\S+ of its size; take a smaller max_step, or a constant step"
)


@pytest.fixture(scope="module")
def rod(tmp_path_factory):
    return model(tmp_path_factory.mktemp("rod"), ROD)


def swing(rod, angle, **settings):
    """Return a run, and how far the derivative of its angle by that of the start is from the closed form."""
    settings = {"until": 3.0, "times": [3.0], "coordinates": "joint", "rtol": 1e-8, "atol": 1e-10, **settings}
    run = rod.simulate(parameters={"angle": angle}, sensitivities=("angle", "length", "g"), **settings)
    return run, abs(run.gradient("rod.theta").row()["angle"] - math.cos(3.0 * RATE))


@pytest.mark.slow_cases("abm-0.0")
@pytest.mark.parametrize("angle", [0.0, 1e-6, 1e-5])
@pytest.mark.parametrize("integrator", ["dop853", "dopri5", "abm"])
def test_a_start_at_an_equilibrium_or_near_it(rod, integrator, angle):
    run, error = swing(rod, angle, integrator=integrator)
    assert run.status == "unverified"
    assert run.sensitivities.error > 300.0 * 1e-8
    # multistep schemes begin at order 1, which takes a short first step
    finer = {"max_step": 0.02} if integrator != "abm" else {"integrator": "abm4", "step": 1e-3}
    fine, small = swing(rod, angle, **{"integrator": integrator, **finer})
    assert fine.status == "ok"
    assert (fine.sensitivities.error or 0.0) < 300.0 * 1e-8
    assert small < 1e-7
    if angle == 0.0:
        assert error > 1e-3
    plain = rod.simulate(
        parameters={"angle": angle}, until=3.0, coordinates="joint", integrator=integrator, rtol=1e-8, atol=1e-10
    )
    assert (plain.steps, plain.rejected) == (run.steps, run.rejected)


def test_the_estimate_is_that_of_the_scheme(rod):
    # one step of a linear equation, by the coefficients in SciPy
    h, rates = 0.5, []
    matrix = np.array([[0.0, 1.0], [-RATE * RATE, 0.0]])
    for row in RK45.A:
        rates.append(matrix @ (np.array([1.0, 0.0]) + h * sum(a * k for a, k in zip(row, rates, strict=False))))
    end = np.array([1.0, 0.0]) + h * np.array(rates).T @ RK45.B
    error = h * np.abs(np.array([*rates, matrix @ end]).T @ RK45.E)
    sizes = np.maximum(np.abs(end), [0.0, abs(end[0]) / h])
    run = rod.simulate(
        parameters={"angle": 0.0},
        sensitivities="angle",
        integrator="dopri5",
        coordinates="joint",
        step=h,
        until=h,
        times=[h],
    )
    assert run.steps == 1
    assert run.sensitivities.error == pytest.approx((error / sizes).max(), rel=1e-9)


def test_the_sentence_has_the_time_and_reaches_searches(rod):
    run, _ = swing(rod, 0.0, integrator="dop853")
    assert re.fullmatch(SENTENCE, run.reason)
    settings = {"until": 3.0, "parameters": {"angle": 1e-6}, "integrator": "dop853", "rtol": 1e-8, "atol": 1e-10}
    for way in ("forward", "adjoint"):
        by = rod.objective("rod.theta", by=("angle", "length", "g"), way=way, **settings)
        assert re.fullmatch(SENTENCE, by.doubt)
        assert by.first.result.status == "unverified"
    moved = rod.objective("rod.theta", by=("length", "g"), way="adjoint", **{**settings, "parameters": {}})
    assert moved.doubt is None
    assert moved.first.result.status == "ok"


@pytest.mark.slow
def test_the_sentence_reaches_a_fit(rod):
    t = np.linspace(0.1, 3.0, 30)
    data = {"t": t, "rod.theta": 1e-6 * np.cos(RATE * t) - math.pi / 2}
    settings = {"integrator": "dop853", "rtol": 1e-8, "atol": 1e-8}
    fit = rod.identify(data, free=("angle",), parameters={"angle": 2e-6}, **settings)
    assert any(re.search("derivatives are in doubt: " + SENTENCE, note) for note in fit.notes)


def test_constant_steps_have_no_estimate(rod):
    run, error = swing(rod, 0.0, integrator="rk4", step=1e-3)
    assert (run.status, run.sensitivities.error) == ("ok", None)
    assert error < 1e-8


def test_a_tight_relative_tolerance_alone(rod):
    # the absolute one bounds steps, for derivatives as well
    run, _ = swing(rod, 1.0, integrator="dop853", rtol=1e-13, atol=1e-10)
    assert run.status == "ok"
    assert 300.0 * 1e-13 < run.sensitivities.error < 300.0 * 1e-10


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "rolling-disc"])
def test_ordinary_runs_are_not_in_doubt(name):
    mass = {"four-bar": "crank_mass", "slider-crank": "rod_mass", "rolling-disc": "radius"}[name]
    for coordinates in ("absolute", "joint"):
        run = symgen.simulate(name, sensitivities=mass, until=2.0, integrator="dop853", coordinates=coordinates)
        assert run.status == "ok"
        assert 0.0 < run.sensitivities.error < 300.0 * 1e-8


def test_a_number_that_changes_nothing_but_rounding(rod):
    run = symgen.simulate("pendulum", sensitivities="bob_mass", until=3.0, integrator="dop853")
    assert run.status == "ok"
    assert run.sensitivities.error == 0.0
