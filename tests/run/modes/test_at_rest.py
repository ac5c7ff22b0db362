"""Motions that begin at rest, without any force: no energy is there that errors could be a part of.

A sled on a straight guide is pushed from t = 1/2 s on by a force of a (t - 1/2)^n: speed and way are integrals of that,
written out here.
"""

from __future__ import annotations

import math

import pytest
from support.emitted import mechanism_of

from symgen.api import load
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

SLED = """
[mechanism]
name = "sled"
gravity = [0.0, 0.0]
[bodies.sled]
mass = {mass}
inertia = 1.0
points = {{ P = [0.0, 0.0] }}
position = [0.0, 0.0]
angle = 0.0
[joints.guide]
type = "prismatic"
between = ["ground", "sled"]
at = [[0.0, 0.0], "P"]
axis = [1.0, 0.0]
[forces.push]
type = "force"
body = "sled"
at = "P"
force = ["{force}", 0.0]
"""
MASS, PUSH = 2.0, 6.0


def sled(force: str, mass: float = MASS):
    return load(validate(parse_toml(SLED.format(force=force, mass=mass), "sled.toml"), "sled.toml"))


@pytest.mark.parametrize("integrator", ["dop853", "dopri5", "picard", "radau5", "sdirk", "abm"])
@pytest.mark.parametrize("power", [1, 2, 3])
def test_a_force_that_sets_in_later(integrator, power):
    force = f"{PUSH} * max(t - 0.5, 0) ** {power}"
    run = sled(force).simulate(method="lagrange", integrator=integrator, rtol=1e-8, until=1.0)
    assert (run.status, run.reason) == ("ok", None)
    speed = PUSH / MASS * 0.5 ** (power + 1) / (power + 1)
    way = PUSH / MASS * 0.5 ** (power + 2) / ((power + 1) * (power + 2))
    # a hundred tolerances of way and speed: errors of all steps, of which there are up to some hundred
    assert run["sled.vx"][-1] == pytest.approx(speed, abs=1e-6 * speed)
    assert run["sled.x"][-1] == pytest.approx(way, abs=1e-6 * way)


def test_constant_steps_from_rest():
    run = sled(f"{PUSH} * max(t - 0.5, 0) ** 2").simulate(method="lagrange", integrator="rk4", step=1e-3, until=1.0)
    assert (run.status, run.reason) == ("ok", None)


def test_a_first_order_scheme_falls_from_rest():
    # Euler's steps: v = g t, way g t (t - h) / 2, so the energy is off by m g^2 t h / 2, all of it after one step
    step, until, weight = 1e-3, 0.5, 6.0
    run = sled(f"{weight}").simulate(method="lagrange", integrator="euler", step=step, until=until)
    assert (run.status, run.reason) == ("ok", None)
    assert run["sled.vx"][-1] == pytest.approx(weight / MASS * until, rel=1e-12)
    # the work of the force is integrated by Euler's steps as well, by the speeds at their beginning
    assert run.energy_drift_max == pytest.approx(weight**2 / MASS * until * step / 2, rel=1e-9)


def test_a_first_order_scheme_falls_from_rest_in_pieces_as_in_one():
    """Where a piece ends, at a jump or where a call ends, no energy is judged that a whole run does not judge."""
    settings = {"method": "lagrange", "integrator": "euler", "step": 1e-3}
    model = sled("6.0")
    whole = model.simulate(until=0.5, **settings)
    assert whole.ok
    run = model.start(**settings, until=0.5)
    for end in (2e-3, 5e-3, 0.5):
        run.run(end)
    assert run.state["sled.x"] == whole["sled.x"][-1]
    short = model.start(**settings, until=2e-3)  # which is no end of it
    short.run(5e-3)
    pushed = load(
        mechanism_of(
            {
                "mechanism": {"name": "pushed", "gravity": [0.0, 0.0]},
                "bodies": {"sled": {"type": "point", "mass": MASS}},
                "inputs": {"push": 6.0},
                "forces": {"push": {"type": "force", "body": "sled", "force": ["push", 0.0]}},
            }
        )
    )
    jump = {"t": [0.0, 2e-3], "u": [6.0, 6.5], "interpolation": "hold"}
    jumps = pushed.simulate(until=0.5, inputs={"push": jump}, **settings)
    assert (jumps.status, jumps.reason) == ("ok", None)


def test_an_energy_that_stays_wrong_ends_a_run_and_so_does_one_at_its_end():
    for until in (0.05, 0.4):
        run = load("pendulum").simulate(method="lagrange", integrator="euler", step=1e-2, until=until)
        assert run.status == "failed"


def test_nothing_moves_where_nothing_pushes():
    run = sled("0 * t").simulate(method="direct-correction", integrator="dop853", rtol=1e-8, until=1.0)
    assert run.status == "ok" and run["sled.x"][-1] == 0.0 and run.energy_drift_max == 0.0


def test_a_wrong_energy_of_a_light_body_still_ends_a_run():
    # its energy is a billionth of what its speed would give the other, a thousand times what constant steps leave open
    heavy, light = 1e3, 1e-6
    text = (
        SLED.format(force="0 * t", mass=heavy)
        + f"""
[bodies.bob]
mass = {light}
inertia = 1e-7
points = {{ A = [0.0, 0.5] }}
position = [0.0, -0.5]
angle = 0.0
angular_velocity = 40.0
velocity = [20.0, 0.0]
[joints.pin]
type = "revolute"
between = ["sled", "bob"]
at = ["P", "A"]
"""
    )
    model = load(validate(parse_toml(text, "bob.toml"), "bob.toml"))
    run = model.simulate(method="direct-correction", integrator="euler", step=2e-3, until=2.0)
    assert run.status == "failed" and "energy" in str(run.reason)


@pytest.mark.parametrize(("integrator", "step"), [("rk4", 1e-3), ("rk4", 5e-4), ("euler", 1e-4), ("picard", None)])
def test_a_body_that_stands_still_does_not_fail(integrator, step):
    """It creeps where the push is the friction: 1 = 2.943 tanh(v / 1e-3). The works of both cancel."""
    model = sled("1.0 - 0.3*9.81*tanh(sled.vx/1e-3)", mass=1.0)
    run = model.simulate(method="direct-correction", integrator=integrator, step=step, until=10.0)
    assert (run.status, run.reason) == ("ok", None)
    assert run["sled.vx"][-1] == pytest.approx(1e-3 * math.atanh(1.0 / 2.943), rel=1e-9)


def test_limits_of_the_energy_bound_a_body_that_stands_still_as_well():
    model = sled("1.0 - 0.3*9.81*tanh(sled.vx/1e-3)", mass=1.0)
    settings = {"method": "direct-correction", "integrator": "rk4", "until": 10.0}
    assert model.simulate(**settings, step=2e-3).status == "failed"  # 40 times as fast as it creeps
    assert model.simulate(**settings, step=1e-3, max_energy_error=1e-6).status == "failed"
