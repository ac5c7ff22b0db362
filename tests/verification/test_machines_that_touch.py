"""The machines of the catalogue whose bodies touch: each runs as it comes, with numbers of closed forms."""

import math

import numpy as np
import pytest

import symgen
from tests.run.contacts.test_contacts import rocking_times


def run(name, **settings):
    """The machine as it comes, or with other settings."""
    result = symgen.load(name).simulate(**settings)
    assert result.status == "ok" and not result.warnings, (result.reason, result.warnings)
    return result


def test_the_wheel_comes_back_and_rolls():
    result = run("skidding-wheel")
    k = 0.24**2 / 0.3**2
    rolls = (4.0 - k * 0.3 * 30.0) / (1.0 + k)
    (stick,) = result.events
    assert rolls < 0.0 and stick.name == "road.stick" and abs(stick.t - (4.0 - rolls) / (0.25 * 9.81)) < 1e-9
    assert abs(result["wheel.vx"][-1] - rolls) < 1e-9 and abs(result["wheel.omega"][-1] + rolls / 0.3) < 1e-9
    assert abs(result["wheel.x"].max() - 16.0 / (2.0 * 0.25 * 9.81)) < 1e-3


@pytest.mark.slow
def test_the_block_rocks_as_housner_says():
    result, (hits, limit) = run("rocking-block"), rocking_times(0.1, 0.4, 0.1)
    times = [event.t for event in result.events if event.name.endswith(".hit")]
    assert np.allclose(times[:4], hits[:4], rtol=0.0, atol=1e-8)
    (note,) = [note for note in result.notes if "accumulate" in note]
    assert abs(float(note.split("t = ")[1].split(" s:")[0]) - limit) < 1e-6


@pytest.mark.slow
def test_the_pin_strikes_and_slides():
    """Angles of the rod by an event-driven simulation in NumPy."""
    result = run("slider-crank-with-clearance", until=0.012, times=[0.0, 0.001, 0.004, 0.012])
    assert abs(result.events[0].t - 0.00022728603204) < 1e-11
    assert np.allclose(result["rod.theta"][1:], [-0.20840645997, -0.36747490995, 0.00154321194], rtol=0.0, atol=1e-8)


@pytest.mark.slow
def test_the_woodpecker_has_the_period_of_its_author():
    result = run("woodpecker", until=24.0, integrator="dop853", rtol=1e-12, verify=False)
    knocks = [event.t for event in result.events if event.name == "beak.hit"]
    assert abs((knocks[-1] - knocks[-11]) / 10.0 - 0.145976065144) < 1e-10


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_the_wheel_turns_by_a_quarter_a_turn():
    result = run("geneva")
    # beside the middle of a slot by what the play is there
    assert abs(result["wheel.theta"][-1] + 0.25 * math.pi + math.pi) < 4.0 * 1e-4 / 0.07
    rests = [event.name for event in result.events if event.name.endswith(".rest")]
    assert rests == ["north_right.rest", "north_left.rest", "west_right.rest", "west_left.rest"]
