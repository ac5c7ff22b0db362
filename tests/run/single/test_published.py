"""Published and exact solutions: the pendulum's elliptic one, Andrews' mechanism, the N-four-bar's regular branch."""

import json
from pathlib import Path

import mpmath
import numpy as np
import pytest
from support.runs import positions, run

from symgen.api import load

DATA = Path(__file__).parents[2] / "data"
ANDREWS = json.loads((DATA / "andrews_ivp.json").read_text())
N_FOUR_BAR = json.loads((DATA / "n_four_bar_reference.json").read_text())["values"]


def pendulum(times) -> np.ndarray:
    """Position released from the horizontal on the left: sin(theta/2) = k sn(w t + K, k), k = sin(45 degrees)."""
    with mpmath.workdps(30):
        m, w = mpmath.mpf(1) / 2, mpmath.sqrt(mpmath.mpf("9.81"))
        quarter = mpmath.ellipk(m)
        angles = [2 * mpmath.asin(mpmath.sqrt(m) * mpmath.ellipfun("sn", w * t + quarter, m=m)) for t in times]
        return np.array([[-float(mpmath.sin(a)), -float(mpmath.cos(a))] for a in angles])


@pytest.mark.parametrize(
    ("method", "integrator", "tolerance", "error"),
    [
        ("direct-correction", "dop853", 1e-13, 1e-9),
        ("direct-correction", "dopri5", 1e-14, 1e-9),
        ("baumgarte", "dop853", 1e-13, 1e-9),
        ("lagrange", "dop853", 1e-14, 1e-8),
    ],
)
def test_pendulum_over_100_seconds(method, integrator, tolerance, error):
    times = np.linspace(0.0, 100.0, 31)
    outcome = run(
        load("pendulum"), method=method, integrator=integrator, rtol=tolerance, atol=tolerance, until=100.0, times=times
    )
    assert outcome.code == 0
    assert np.abs(positions(outcome) - pendulum(times)).max() <= error


SLOW = pytest.mark.slow


@pytest.mark.parametrize(
    "method", ["direct-correction", pytest.param("lagrange", marks=SLOW), pytest.param("baumgarte", marks=SLOW)]
)
def test_andrews_mechanism(method):
    """The seven angles at 0.03 s to nine digits; those of the test set are sums and differences of body angles."""
    outcome = run(load("andrews"), method=method, integrator="dop853", rtol=1e-13, atol=1e-13, until=0.03, times=[0.03])
    names = [q.name for q in outcome.compiled.info.coordinates]
    k = {i: positions(outcome)[0][names.index(f"K{i}.theta")] for i in range(1, 8)}
    found = [k[1], k[2] - k[1], k[3], k[4] - k[5], k[5], k[6] - k[7], k[7]]
    np.testing.assert_allclose(found, ANDREWS["end"][:7], rtol=5e-10)


def b0(outcome) -> np.ndarray:
    """Position of the pin B0, the end of the first vertical link."""
    x, y, theta = positions(outcome)[:, :3].T
    return np.array([x + 0.5 * np.cos(theta), y + 0.5 * np.sin(theta)]).T


@pytest.mark.parametrize("weight", ["identity", "mass"])
@pytest.mark.parametrize("windows", [1, pytest.param(2, marks=SLOW)])
def test_n_four_bar_through_its_singular_positions(windows, weight):
    """Ten passages in 10 s; which steps fall near them matters: bounds are those of the worst of many, next test."""
    rows = np.array([r for r in N_FOUR_BAR[str(windows)] if r[0] <= 10.0])
    outcome = run(
        load(f"n-four-bar:{windows}"),
        method="direct-correction",
        integrator="rk4",
        step=1e-3,
        until=10.0,
        times=rows[:, 0].tolist(),
        options={"method.weight": weight},
    )
    assert outcome.code == 0
    assert outcome.rank_event_count == 10
    assert np.abs(b0(outcome) - rows[:, 1:3]).max() <= (1e-6 if windows == 1 else 1e-5)
    assert outcome.energy_drift_max <= 1e-6


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("windows", "weight", "median", "worst", "beyond"),
    [
        (1, "identity", 1e-9, 1e-6, 0),
        (1, "mass", 1e-9, 1e-6, 0),
        (2, "mass", 1e-8, 1e-5, 0),
        (10, "mass", 1e-8, 1e-5, 3),
    ],
)
def test_n_four_bar_for_twenty_steps(windows, weight, median, worst, beyond):
    """A step that ends all but in a singular position leaves to rounding what is made of it.

    With ten windows that is so in 6 of 300 steps of this range, off by up to 6e-4 m, and once a run failed with its
    reason; which ones differs between processors. That 4 of 20 are is less likely than 1e-3.
    """
    rows = np.array([r for r in N_FOUR_BAR[str(windows)] if r[0] <= 10.0])
    errors = []
    for step in np.linspace(0.95e-3, 1.05e-3, 20):
        outcome = run(
            load(f"n-four-bar:{windows}"),
            method="direct-correction",
            integrator="rk4",
            step=step,
            until=10.0,
            times=rows[:, 0].tolist(),
            options={"method.weight": weight},
        )
        errors.append(np.abs(b0(outcome) - rows[:, 1:3]).max() if outcome.code == 0 else np.inf)
    print(f"\nN = {windows}, weight {weight}: median {np.median(errors):.1e} m, worst {max(errors):.1e} m")
    assert np.median(errors) <= median
    assert sum(error > worst for error in errors) <= beyond


def test_four_bar_as_the_source_runs_it():
    """Constant steps of 1 ms with RK4 for 10 s: violations at rounding, energy to a millionth of a joule."""
    outcome = run(load("four-bar"), method="direct-correction", integrator="rk4", step=1e-3, until=10.0)
    assert outcome.position_violation_max <= 1e-12
    assert outcome.velocity_violation_max <= 1e-12
    assert outcome.energy_drift_max <= 1e-6
    tight = run(load("four-bar"), method="direct-correction", integrator="dop853", rtol=1e-12, atol=1e-12, until=10.0)
    assert tight.energy_drift_max <= 1e-8
    np.testing.assert_allclose(outcome.states[-1], tight.states[-1], atol=1e-5)


def test_methods_agree_with_each_other():
    """Different laws, one motion: all end where the others end."""
    keys = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-12, "until": 3.0, "times": [1.0, 2.0, 3.0]}
    found = [
        positions(run(load("slider-crank"), method=m, **keys)) for m in ("lagrange", "baumgarte", "direct-correction")
    ]
    np.testing.assert_allclose(found[0], found[2], atol=2e-8)
    np.testing.assert_allclose(found[1], found[2], atol=2e-8)
