"""Events within some roundings of the end of a run, of a step and of an output: none fails, none loses a sample."""

import itertools
import math
from typing import Any

import numpy as np
import pytest

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

WHEEL = """
[mechanism]
name = "wheel"
[run]
until = 1.0
[inputs]
u = 0.0
[bodies.a]
mass = 1.0
inertia = 0.5
SPEED
[joints.l]
type = "revolute"
between = ["ground", "a"]
at = [[0.0, 0.0], "centre"]
KEYS
[forces.f]
type = "torque"
body = "a"
torque = "TORQUE"
"""
TURNING = "angular_velocity = 1.0"
KICK = '[events.k]\nwhen = "WHEN"\nreset = { "a.omega" = -0.5 }\n'
#: Speed, keys of the joint, torque, an event, and the angle after 1 s; all happen at 0.5 s.
KINDS: dict[str, tuple[str, str, str, str, float]] = {
    "impact": (TURNING, "stop = { upper = 0.5, restitution = 0.5 }", "u", "", 0.25),
    "impact and jump": (TURNING, "stop = { upper = 0.5, restitution = 0.5 }", "0 if t < 0.5 else -0.5", "", 0.125),
    "impact without rebound": (TURNING, "stop = { upper = 0.5 }", "u", "", 0.5),
    "impact, then a push": (TURNING, "stop = { upper = 0.5 }", "u if t < 0.5 else 0.5", "", 0.5),
    "stick": (TURNING, "friction = { sliding = 1.0 }", "u", "", 0.25),
    "stick and jump": (TURNING, "friction = { sliding = 1.0 }", "0 if t < 0.5 else 2.0", "", 0.5),
    "slip": ("", "friction = { sliding = 1.0 }", "2*t + u", "", 4.0 * 0.5**3 / 6.0),
    "slip and kink": ("", "friction = { sliding = 1.0 }", "2*t if t < 0.5 else 4*t - 1", "", 8.0 * 0.5**3 / 6.0),
    "leave": ("", "stop = { lower = 0.0 }", "2*t - 1 + u", "", 4.0 * 0.5**3 / 6.0),
    "reset": (TURNING, "", "u", KICK.replace("WHEN", "a.theta - 0.5"), 0.25),
    "reset in time": (TURNING, "", "u", KICK.replace("WHEN", "t - 0.5"), 0.25),
}
INTEGRATORS = [{"integrator": name} for name in ("radau5", "dop853", "picard", "sdirk")]
INTEGRATORS.append({"integrator": "rk4", "step": 1e-3})
DIVISIONS = [(0.1,) * 10, (0.495, 0.005, 0.5), (0.01,) * 100, (0.5, 0.5), (0.25,) * 4]


def wheel(kind: str) -> symgen.Model:
    speed, keys, torque, event, _ = KINDS[kind]
    text = WHEEL.replace("SPEED", speed).replace("KEYS", keys).replace("TORQUE", torque) + event
    return symgen.Model(validate(parse_toml(text, "wheel.toml"), "wheel.toml"))


def stepped(model: symgen.Model, lengths: tuple[float, ...], **settings: Any) -> symgen.Result:
    run = model.start(**settings)
    for length in lengths:
        run.step(length)
    return run.result()


@pytest.mark.by_turns(8)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("kind", [*KINDS])
@pytest.mark.slow
def test_a_run_in_steps_whose_ends_are_events_is_the_run(kind: str, coordinates: str) -> None:
    model, end = wheel(kind), KINDS[kind][-1]
    for settings, lengths in itertools.product(INTEGRATORS, DIVISIONS):
        result = stepped(model, lengths, coordinates=coordinates, **settings)
        assert result["a.theta"][-1] == pytest.approx(end, abs=2e-6), (settings, lengths)


@pytest.mark.by_turns(8)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("kind", [*KINDS])
@pytest.mark.slow
def test_runs_and_outputs_that_end_at_an_event_are_whole(kind: str, coordinates: str) -> None:
    model, times = wheel(kind), [0.0, 0.25, 0.5, 0.75, 1.0]
    for settings in INTEGRATORS:
        whole = model.simulate(times=times, coordinates=coordinates, verify=False, **settings)
        assert whole.status == "ok" and whole.t.tolist() == times
        for roundings in range(-10, 11, 5):
            until = 0.5 * (1.0 + roundings * 2.0**-52)
            half = model.simulate(until=until, times=[0.25, until], coordinates=coordinates, verify=False, **settings)
            assert half.status == "ok" and half.t.tolist() == [0.25, until], (settings, roundings)
            assert half["a.theta"][-1] == pytest.approx(whole["a.theta"][2], abs=1e-8)


@pytest.mark.parametrize("integrator", ["picard", "dop853", "radau5"])
@pytest.mark.fast("dop853")
def test_a_ball_whose_run_ends_at_its_impact(integrator: str) -> None:
    text = """
[mechanism]
name = "ball"
gravity = [0.0, -9.81]
[bodies.ball]
type = "point"
mass = 1.0
position = [0.0, 1.0]
[stops.floor]
gap = "ball.y"
restitution = 0.7
"""
    model = symgen.Model(validate(parse_toml(text, "ball.toml"), "ball.toml"))
    fall = math.sqrt(2.0 / 9.81)
    for first in (fall, fall + 2.0 * 0.7 * fall):
        until = first
        for _ in range(8):
            run = model.simulate(until=until, integrator=integrator, verify=False)
            assert run.status == "ok" and run.t[-1] == until and abs(run["ball.y"][-1]) < 1e-9
            until = float(np.nextafter(until, np.inf))
