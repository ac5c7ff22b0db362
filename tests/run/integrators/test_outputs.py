"""Outputs: dense, off the grid, at asked times; tolerances that do what they say."""

import numpy as np
import pytest
from support.kinds import ADAPTIVE, CORRECTING, INTEGRATORS, METHODS
from support.runs import fixed, positions, run

from symgen.api import load


@pytest.fixture(scope="module")
def four_bar():
    return load("four-bar")


@pytest.fixture(scope="module")
def exact(four_bar):
    """q of the four-bar at 401 times up to 2 s, from fine constant steps that hit each of them."""
    outcome = run(four_bar, **fixed("dop853"), method="lagrange", until=2.0, step=0.0025, output_step=0.005)
    return outcome.times, positions(outcome)


@pytest.mark.parametrize("integrator", ADAPTIVE)
@pytest.mark.parametrize("method", METHODS)
def test_error_follows_the_tolerance(four_bar, exact, method, integrator):
    """Largest error over dense outputs: falls with the tolerance, in proportion within a factor."""
    tolerances = 10.0 ** -np.arange(5, 11)
    errors, steps = [], []
    for tolerance in tolerances:
        outcome = run(
            four_bar,
            method=method,
            integrator=integrator,
            rtol=tolerance,
            atol=tolerance,
            until=2.0,
            times=exact[0],
            max_violation=1.0,
        )
        assert outcome.code == 0
        errors.append(np.abs(positions(outcome) - exact[1]).max())
        steps.append(outcome.steps)
    slope = np.polyfit(np.log(tolerances), np.log(errors), 1)[0]
    assert 0.75 <= slope <= 1.35, f"errors {errors}"
    assert max(e / t for e, t in zip(errors, tolerances, strict=True)) < 300.0
    assert steps == sorted(steps)


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_dense_output_is_as_accurate_as_the_steps(four_bar, exact, integrator):
    """Errors between the steps are not much larger than errors at their ends."""
    tolerance = 1e-8
    keys = {"method": "lagrange", "integrator": integrator, "rtol": tolerance, "atol": tolerance, "until": 2.0}
    dense = run(four_bar, **keys, times=exact[0])
    assert dense.steps < len(exact[0]) / 3, "most outputs lie inside steps"
    error = np.abs(positions(dense) - exact[1]).max(axis=1)
    assert error.max() <= 10.0 * error[-1] + 20.0 * tolerance


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_dense_output_does_not_change_the_steps(four_bar, integrator):
    """The trajectory is the same whatever is asked for; a projected output is not propagated."""
    keys = {"method": "direct-correction", "integrator": integrator, "until": 1.0}
    few = run(four_bar, **keys, times=[0.0, 1.0])
    many = run(four_bar, **keys, times=np.linspace(0.0, 1.0, 777))
    np.testing.assert_array_equal(few.states[-1], many.states[-1])
    assert (few.steps, few.rejected) == (many.steps, many.rejected)


@pytest.mark.parametrize("integrator", [*ADAPTIVE, "picard", "abm", "radau5", "sdirk"])
def test_outputs_do_not_change_steps_that_are_chosen_for_the_work(integrator):
    """The work's error is judged by the energies of the state that a step began with, not by those of an output."""
    model, keys = load("cart-pole"), {"method": "lagrange", "integrator": integrator, "rtol": 1e-7, "until": 1.0}
    few, many = (model.simulate(**keys, times=times) for times in ([1.0], np.linspace(0.0, 1.0, 38)))
    np.testing.assert_array_equal(few.q.values[-1], many.q.values[-1])
    assert (few.steps, few.rejected) == (many.steps, many.rejected)


@pytest.mark.parametrize("method", CORRECTING)
@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_dense_outputs_are_corrected(four_bar, method, integrator):
    outcome = run(four_bar, method=method, integrator=integrator, until=1.0, times=np.linspace(0, 1.0, 97))
    assert outcome.status_columns[:, 0].max() <= 1e-11
    assert outcome.status_columns[:, 1].max() <= 1e-11


TIMES = (0.0, 0.0013, 0.1, 0.10005, 0.3337, 0.5, 0.98765, 1.0)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("method", METHODS)
def test_outputs_are_at_the_asked_times(four_bar, method, integrator):
    outcome = run(four_bar, method=method, integrator=integrator, step=1e-3, until=1.0, times=TIMES)
    assert outcome.times.tolist() == list(TIMES)
    assert len(outcome.states) == len(TIMES)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_off_grid_outputs_of_constant_steps(four_bar, integrator):
    """They have the accuracy of the scheme, and change nothing for the steps after them."""
    keys = fixed(integrator) | {"method": "direct-correction", "step": 0.01, "until": 1.0}
    plain, asked = run(four_bar, **keys), run(four_bar, **keys, times=TIMES)
    for t in (0.0, 0.1, 0.5, 1.0):
        np.testing.assert_array_equal(asked.states[TIMES.index(t)], plain.states[round(t / 0.01)])
    fine = run(four_bar, **fixed("dop853"), method="lagrange", step=0.00125, until=1.0, times=TIMES)
    assert (
        np.abs(positions(asked) - positions(fine)).max() <= 3.0 * np.abs(positions(asked) - positions(fine))[-1].max()
    )


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_an_end_that_is_no_multiple_of_the_step(four_bar, integrator):
    keys = fixed(integrator) | {"method": "lagrange", "step": 0.03, "output_step": 0.03, "max_violation": 1.0}
    outcome = run(four_bar, **keys, until=1.0)
    assert outcome.times[-1] == 1.0 == outcome.end
    assert outcome.steps == 34
    np.testing.assert_allclose(np.diff(outcome.times)[:-1], 0.03, rtol=1e-12)
    fine = run(four_bar, **fixed("dop853"), method="lagrange", step=0.00125, until=1.0, times=[1.0])
    np.testing.assert_allclose(positions(outcome)[-1], positions(fine)[-1], atol=1e-5)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_many_steps_do_not_lose_time(integrator):
    """t is counted, not added up: 10^5 steps of 1e-4 end at 10."""
    outcome = run(load("pendulum"), **fixed(integrator), method="lagrange", step=1e-4, until=10.0, times=[10.0])
    assert (outcome.steps, outcome.end, outcome.times.tolist()) == (100_000, 10.0, [10.0])


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_a_first_step_can_be_given(four_bar, integrator):
    free = run(four_bar, integrator=integrator, until=0.5)
    given = run(four_bar, integrator=integrator, until=0.5, step=1e-5)
    assert given.steps >= free.steps
    np.testing.assert_allclose(positions(given), positions(free), atol=1e-6)
