"""The half-explicit pair of order 5: its conditions, its order, velocities to rounding, and steps by its estimate."""

import numpy as np
import pytest
from support.convergence import orders

from symgen.api import load
from symgen.run.integrators import INTEGRATORS

SCHEME = INTEGRATORS.get("phem56")
CONSTANT = {"method": "half-explicit", "integrator": "phem56", "options": {"integrator.adaptive": "false"}}
#: In the plane, in space with redundant rows and open, in joint coordinates and as looped code: name, end [s], a step
#: from which on the error falls by the order, settings.
MOTIONS = [
    ("four-bar", 2.0, 4e-3, {}),
    ("four-bar", 2.0, 4e-3, {"shape": "looped"}),
    ("spatial-slider-crank", 0.4, 1.25e-3, {}),
    ("spatial-slider-crank", 0.4, 2.5e-3, {"coordinates": "joint"}),
    ("bricard", 1.0, 2e-2, {}),
    ("heavy-top", 0.5, 2.5e-3, {}),
]


def reference(name, until):
    """Positions at forty times by another method at tight tolerances."""
    times = np.linspace(0.0, until, 41)[1:]
    exact = load(name).simulate(
        method="direct-correction", integrator="picard", rtol=1e-13, atol=1e-13, until=until, times=times
    )
    return times, np.asarray(exact.q)


def test_conditions_of_the_coefficients():
    """Both schemes integrate their quadratures; every state is of stage order 2, those that multipliers close too."""
    a, b, c, closing, closed = SCHEME.a, SCHEME.closing[-1], SCHEME.c, SCHEME.closing, SCHEME.closed
    for k in range(1, 6):
        assert b @ c ** (k - 1) == pytest.approx(1.0 / k, abs=1e-14)
    ends = np.append(c, 1.0)
    for k in range(1, 5):
        assert SCHEME.embedded @ ends ** (k - 1) == pytest.approx(1.0 / k, abs=1e-14)
    assert abs(SCHEME.embedded @ ends**4 - 0.2) > 1e-4  # one order less, or nothing is estimated
    np.testing.assert_allclose(a[2:] @ c, c[2:] ** 2 / 2, atol=1e-14)
    np.testing.assert_allclose(closing[1:] @ c, closed[1:] ** 2 / 2, atol=1e-14)
    np.testing.assert_allclose(closing[2:] @ c**2, closed[2:] ** 3 / 3, atol=1e-14)
    # stages without weight at the second stage, so that its lower order stays out
    assert b[1] == b @ a[:, 1] == pytest.approx(0.0, abs=1e-14)


@pytest.mark.by_turns(3)
@pytest.mark.fast("heavy-top-0.5-0.0025-keys5")
@pytest.mark.parametrize(("name", "until", "step", "keys"), MOTIONS)
def test_order_five_with_velocities_to_rounding(name, until, step, keys):
    (times, exact), model, errors = reference(name, until), load(name), []
    for h in (step, step / 2):
        result = model.simulate(step=h, until=until, times=times, **CONSTANT, **keys)
        # a row that is left out as redundant follows by the drift of positions
        assert result.status == "ok" and result.velocity_violation_max < (1e-10 if name == "bricard" else 1e-13)
        errors.append(np.abs(np.asarray(result.q) - exact).max())
    assert 4.8 < orders(errors)[0] < 5.3


@pytest.mark.slow
def test_steps_are_chosen_by_the_error():
    """The estimate is of order 4: a thousandth of the tolerance takes 1000^(1/5) = 4 times the steps."""
    (times, exact), model, runs = reference("four-bar", 2.0), load("four-bar"), []
    for rtol in (1e-6, 1e-9):
        settings = {"method": "half-explicit", "integrator": "phem56", "rtol": rtol, "atol": 0.01 * rtol}
        runs.append(model.simulate(until=2.0, times=times, **settings))
        assert runs[-1].status == "ok" and runs[-1].velocity_violation_max < 1e-13
        assert np.abs(np.asarray(runs[-1].q) - exact).max() < 10.0 * rtol
    assert 3.2 < runs[1].steps / runs[0].steps < 4.8


@pytest.mark.slow
def test_a_nonholonomic_motion_keeps_its_rows():
    """A disc rolls: its rows are on velocities only, and its motion is that of another method."""
    times, exact = reference("rolling-disc", 1.0)
    result = load("rolling-disc").simulate(
        method="half-explicit", integrator="phem56", rtol=1e-10, atol=1e-12, until=1.0, times=times
    )
    assert result.status == "ok" and result.velocity_violation_max < 1e-13
    np.testing.assert_allclose(np.asarray(result.q), exact, rtol=0.0, atol=1e-8)
