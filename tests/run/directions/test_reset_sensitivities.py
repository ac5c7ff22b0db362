"""Sensitivities through events that change the state: closed forms, mirrored motions, and differences of whole runs."""

import numpy as np
import pytest

from tests.run.directions.differences import differences
from tests.run.directions.lengths import FOUR_BAR, ROD, ROD_BY, ROD_STATE, model

TIGHT = {"rtol": 1e-13, "atol": 1e-13, "integrator": "dop853"}

BALL = """
[mechanism]
name = "ball"
gravity = [0.0, "-g"]
[parameters]
h0 = { value = 1.0, unit = "m" }
e = 0.7
g = { value = 9.81, unit = "m/s^2" }
[bodies.ball]
type = "point"
mass = 1.0
position = [0.0, "h0"]
[events.bounce]
when = "ball.y"
direction = "falling"
reset = { "ball.vy" = "-e*ball.vy" }
"""


@pytest.fixture(scope="module")
def ball(tmp_path_factory):
    return model(tmp_path_factory.mktemp("ball"), BALL)


@pytest.mark.parametrize(
    ("until", "values"),
    [
        (1.0, {"h0": 1.365029880359517, "e": 2.42944691807002, "g": -0.1162049051621287}),
        (1.5, {"h0": 1.488826194916769, "e": 4.310179282157103, "g": -0.1463225081634283}),
    ],
)
def test_a_ball_that_bounces_once_and_twice(ball, until, values):
    run = ball.simulate(until=until, times=[until], sensitivities=tuple(values), **TIGHT)
    assert run.status == "ok"
    assert run.gradient("ball.y").row() == pytest.approx(values, rel=1e-11)


def test_steps_through_resets_are_those_of_a_run_without_sensitivities(ball):
    plain, directed = (ball.simulate(until=1.5, integrator="dop853", **more) for more in ({}, {"sensitivities": "e"}))
    assert (plain.steps, plain.rejected) == (directed.steps, directed.rejected)
    assert [event.name for event in directed.events] == ["bounce", "bounce"]
    np.testing.assert_allclose(plain.v.values, directed.v.values, rtol=0.0, atol=1e-12)


@pytest.fixture(scope="module")
def mirrored(tmp_path_factory):
    """Return a rod that is thrown back without loss where it would pass the vertical."""
    event = '[events.back]\nwhen = "rod.theta + pi/2"\ndirection = "falling"\nreset = {"rod.omega" = "-rod.omega"}\n'
    return model(tmp_path_factory.mktemp("mirrored"), ROD + event)


@pytest.mark.slow_cases(
    "direct-correction-joint", "energy-projection-absolute", "energy-projection-joint", "lagrange-joint"
)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("method", ["lagrange", "direct-correction", "energy-projection"])
def test_a_mirrored_motion_has_mirrored_sensitivities(mirrored, coordinates, method):
    run = mirrored.simulate(
        until=3.0, times=[3.0], sensitivities=tuple(ROD_BY), coordinates=coordinates, method=method, **TIGHT
    )
    assert len(run.events) == 3  # an odd number of mirrors
    assert run.v.row()["rod.omega"] == pytest.approx(-ROD_STATE[1], rel=1e-11)
    for name, (of_angle, of_speed) in ROD_BY.items():
        assert run.gradient("rod.theta").row()[name] == pytest.approx(-of_angle, rel=1e-11)
        assert run.gradient("rod.omega").row()[name] == pytest.approx(-of_speed, rel=1e-11)


def test_a_floor_that_rises_and_a_reset_by_the_time(tmp_path):
    text = BALL.replace('"ball.y"', '"ball.y - c*t"').replace('"-e*ball.vy"', '"k*t^2"'.replace("^", "**"))
    text = text.replace("e = 0.7", "c = 0.5\nk = 10.0")
    run = model(tmp_path, text).simulate(until=0.6, times=[0.6], sensitivities=("h0", "c", "k", "g"), **TIGHT)
    h0, c, k, g, end = 1.0, 0.5, 10.0, 9.81, 0.6
    root = np.sqrt(c * c + 2.0 * g * h0)
    t = (root - c) / g
    # y = c t + k t^2 (end - t) - g (end - t)^2 / 2
    by_time = c + k * (2.0 * t * end - 3.0 * t * t) + g * (end - t)
    of_time = {"h0": 1.0 / root, "c": (c / root - 1.0) / g, "k": 0.0, "g": h0 / (g * root) - t / g}
    own = {"h0": 0.0, "c": t, "k": t * t * (end - t), "g": -0.5 * (end - t) ** 2}
    assert len(run.events) == 1
    expected = {name: own[name] + by_time * of_time[name] for name in own}
    assert run.gradient("ball.y").row() == pytest.approx(expected, rel=1e-11)


def test_a_reset_of_a_state_of_the_file(tmp_path):
    text = BALL.replace('"-e*ball.vy" }', '"-e*ball.vy", hits = "2*hits + ball.vy" }')
    text += '[states.hits]\nstart = 0.0\nrate = "g"\n'
    run = model(tmp_path, text).simulate(until=1.0, times=[1.0], sensitivities=("h0", "g"), **TIGHT)
    t = np.sqrt(2.0 / 9.81)  # hits = g (1 - t) + 2 g t - g t = g
    assert run.events[0].t == pytest.approx(t, rel=1e-12)
    assert run.outputs is not None
    assert run.gradient("hits").row() == pytest.approx({"h0": 0.0, "g": 1.0}, abs=1e-11)


@pytest.mark.slow
def test_events_that_are_together_by_chance_are_in_doubt(tmp_path):
    body, event = BALL[BALL.index("[bodies.ball]") :].split("[events.bounce]")
    other = (body + "[events.second]" + event).replace("ball", "other").replace('"h0"', '"2 - h0"')
    run = model(tmp_path, BALL + other).simulate(until=1.0, sensitivities=("h0",), **TIGHT)
    assert run.status == "unverified"
    assert run.reason is not None
    assert run.reason.startswith("the events 'bounce' and 'second' at t = 0.451524 s are together for these numbers")
    assert model(tmp_path, BALL + other).simulate(until=1.0, sensitivities=("g",), **TIGHT).status == "ok"


STRUCK = (
    FOUR_BAR.replace('g = { value = 9.81, unit = "m/s^2" }', 'g = { value = 9.81, unit = "m/s^2" }\ne = 0.6')
    + '[events.back]\nwhen = "crank.theta - 0.8"\ndirection = "falling"\nreset = {"rocker.omega" = "-e*rocker.omega"}\n'
)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_closed_loop_that_is_struck(tmp_path_factory, coordinates):
    struck = model(tmp_path_factory.mktemp("struck"), STRUCK)
    values = {"a": 2.0, "c": 5.0, "m2": 8.0, "e": 0.6}
    settings = {"until": 1.0, "times": [1.0], "coordinates": coordinates, **TIGHT}
    run = struck.simulate(sensitivities=tuple(values), **settings)
    assert len(run.events) == 1
    assert run.sensitivities.violation < 1e-9
    for name, value in values.items():
        for quantity in ("crank.theta", "coupler.omega"):
            expected = differences(struck, name, value, 1e-3 * value, quantity, **settings)
            assert run.gradient(quantity).row()[name] == pytest.approx(expected, rel=1e-8)
