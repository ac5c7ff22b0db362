"""A pendulum between two stops against quadrature: a long step may pass a stop twice, which its ends do not show."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

PENDULUM = """
[mechanism]
name = "limited-pin"
gravity = [0.0, -9.81]

[parameters]
speed = 5.0
restitution = 0.5

[bodies.p]
mass = 1.0
inertia = 0.05
centre_of_mass = [0.0, -0.5]
angle = 0.0
hold = "angle"
angular_velocity = "speed"

[joints.pin]
type = "revolute"
between = ["ground", "p"]
at = [[0.0, 0.0], [0.0, 0.0]]
stop = { lower = -1.0, upper = 1.0, restitution = "restitution" }
"""
#: Torque of gravity over the inertia about the pin [1/s^2], and the end of the runs [s].
PULL, UNTIL = 9.81 * 0.5 / (0.05 + 0.25), 5.0
#: Rates at a stop below which a hit is one only by rounding [rad/s].
SLOW = 1e-3


def pendulum() -> symgen.Model:
    return symgen.Model(validate(parse_toml(PENDULUM, "pendulum"), "pendulum"))


def flight(rate: float, first: float) -> float:
    """Return the time to a stop from the angle `first`, with a rate at the stop; the angle is cos u."""

    def slowness(u: float) -> float:
        return float(np.sin(u) / np.sqrt(rate**2 + 2.0 * PULL * (np.cos(np.cos(u)) - np.cos(1.0))))

    return float(quad(slowness, 0.0, np.arccos(first), epsabs=1e-13, epsrel=1e-13, limit=400)[0])


def hits(speed: float, restitution: float) -> tuple[list[float], bool]:
    """Return the times of all hits until a rate is slow, and whether it becomes slow."""
    square = speed**2 - 2.0 * PULL * (1.0 - np.cos(1.0))
    if square <= 0.0:
        return [], False
    rate, t = float(np.sqrt(square)), 0.0
    t, times = flight(rate, 0.0), list[float]()
    while t < UNTIL:
        times.append(t)
        rate *= restitution
        if rate < SLOW:
            return times, True
        t += flight(rate, -1.0)
    return times, False


def verdicts(count: int, tolerance: float, **settings: Any) -> dict[str, int]:
    """Return how many random starts are right, unverified, or `ok` and wrong."""
    rng, model = np.random.default_rng(round(-np.log10(tolerance))), pendulum()
    found = {"right": 0, "unverified": 0, "wrong": 0}
    for i in range(count):
        speed, restitution = rng.uniform(1.0, 12.0), (0.0, 1.0, *rng.uniform(0.0, 1.0, 6))[i % 8]
        expected, slow = hits(speed, restitution)
        result = model.simulate(
            parameters={"speed": speed, "restitution": restitution}, integrator="picard", until=UNTIL, **settings
        )
        times = [event.t for event in result.events if event.name.endswith(".hit")]
        near = np.allclose(times[: len(expected)], expected, rtol=0.0, atol=1e-6 + 1e4 * tolerance)
        many = len(times) >= len(expected) if slow else len(times) == len(expected)
        inside = float(np.abs(result["p.theta"]).max()) < 1.0 + 1e-6 + 1e3 * tolerance
        right = near and many and inside
        found["unverified" if result.status == "unverified" else "right" if right else "wrong"] += 1
    return found


def test_every_hit_of_a_pendulum_is_found() -> None:
    """Four of seven were, and the run was `ok`."""
    expected, _ = hits(5.0, 0.5)
    for settings in ({"rtol": 1e-8}, {}):
        result = pendulum().simulate(until=UNTIL, **settings)
        assert result.status == "ok"
        times = [event.t for event in result.events if event.name.endswith(".hit")]
        np.testing.assert_allclose(times, expected, rtol=0.0, atol=1e-7)
    assert len(expected) == 7 and min(b - a for a, b in pairwise(expected)) > 0.5


@pytest.mark.slow
@pytest.mark.parametrize("rtol", [1e-6, 1e-8, 1e-10])
def test_no_start_is_ok_and_wrong(rtol: float) -> None:
    found = verdicts(24, rtol, rtol=rtol)
    assert found["wrong"] == 0 and found["right"] >= 23


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("rtol", [1e-6, 1e-8, 1e-10])
def test_of_many_starts_none_is_ok_and_wrong(rtol: float) -> None:
    for settings in ({"rtol": rtol}, {}):
        found = verdicts(100, rtol, **settings)
        assert found["wrong"] == 0 and found["unverified"] <= 2


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_rows_of_a_sweep_find_the_same_hits() -> None:
    speeds = list(np.linspace(3.0, 8.0, 9))
    model = pendulum()
    rows = model.sweep({"speed": speeds}, integrator="picard", until=UNTIL, rtol=1e-8, quantities=("q",), times=[UNTIL])
    for i, speed in enumerate(speeds):
        alone = model.simulate(
            parameters={"speed": speed}, integrator="picard", until=UNTIL, rtol=1e-8, verify=False, times=[UNTIL]
        )
        assert rows["steps"][i] == alone.steps
        assert rows["p.theta"][i].tolist() == alone["p.theta"].tolist()
        count = sum(event.name.endswith(".hit") for event in alone.events)
        assert count == len(hits(speed, 0.5)[0])
