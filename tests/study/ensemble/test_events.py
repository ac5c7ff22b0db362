"""Events, inputs and held joints in the runs of sweeps: closed forms first, then the single runs."""

import copy
import math

import numpy as np
import pytest
from support.checks import assert_same_motion
from support.emitted import mechanism_of

import symgen
from study.ensemble.single_runs import assert_rows
from symgen.api import Model
from symgen.base.errors import InputError
from symgen.describe.catalogue import raw
from symgen.describe.files.builder import MechanismBuilder

G, E = 9.81, 0.7
BALL = {
    "mechanism": {"name": "ball", "gravity": [0.0, -G]},
    "run": {"until": 5.0, "step": 1e-2},
    "parameters": {"bounce": E, "height": 1.0},
    "bodies": {"ball": {"type": "point", "mass": 1.3, "position": [0.0, "height"]}},
}
IMPACT = {"impact": {"when": "ball.y < 0", "reset": {"ball.vy": "-bounce*ball.vy"}}}
LAND = {"land": {"when": "ball.y < 0", "action": "stop"}}
FALLING = {"method": "lagrange", "integrator": "rk4", "step": 1e-2}


def ball(**events):
    return symgen.load(mechanism_of({**copy.deepcopy(BALL), "events": events}))


@pytest.mark.slow
def test_runs_end_where_their_balls_land_and_show_the_state_there():
    """A fall from h takes sqrt(2 h / g) and ends at sqrt(2 g h): where only the end is kept, that is the end."""
    heights = np.array([0.5, 1.0, 3.0])
    found = symgen.sweep(
        ball(**LAND), {"height": heights}, quantities=("ball", "energy.error", "event.land"), until=5.0, **FALLING
    )
    assert list(found.status) == ["ok"] * 3
    times = np.sqrt(2.0 * heights / G)
    np.testing.assert_allclose(found["end"], times, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found["event.land.first"], times, rtol=0.0, atol=1e-12)
    np.testing.assert_array_equal(found["event.land.last"], found["event.land.first"])
    np.testing.assert_array_equal(found["event.land.count"], 1.0)
    np.testing.assert_allclose(found["ball.y"][:, 0], 0.0, atol=1e-12)
    np.testing.assert_allclose(found["ball.vy"][:, 0], -np.sqrt(2.0 * G * heights), rtol=1e-12)
    np.testing.assert_allclose(found["energy.error"], 0.0, atol=1e-11)
    assert found.to_json()["events"] == {"land": {"runs": 3, "count": 3}}


def test_a_condition_that_is_asked_for_twice_is_one_event():
    found = symgen.sweep(
        ball(), {"height": [0.5, 3.0]}, stop_when="ball.y < 0", record_when="ball.y  < 0", until=5.0, **FALLING
    )
    np.testing.assert_array_equal(found["event.ball.y < 0.count"], 1.0)
    np.testing.assert_array_equal(found["event.ball.y < 0.first"], found["end"])


def test_outputs_that_were_asked_for_end_with_their_run():
    found = symgen.sweep(
        ball(), {"height": [0.5, 3.0]}, stop_when="ball.y < 0", times=(0.0, 0.4, 0.7), until=5.0, **FALLING
    )
    y = found["ball.y"]
    (
        np.testing.assert_allclose(y[0, :1], [0.5]),
        np.testing.assert_allclose(y[1], 3.0 - 0.5 * G * np.array([0.0, 0.16, 0.49])),
    )
    assert np.isnan(y[0, 1:]).all() and found.ensemble.events == ("ball.y < 0",)
    with pytest.raises(InputError, match=r"did you mean 'event\.ball\.y < 0\.first'"):
        found["event.ball.y < 0.frst"]


@pytest.mark.slow
def test_balls_bounce_each_with_its_own_restitution_until_their_impacts_accumulate():
    """Impacts of a ball stand at T + 2 T (e + e^2 + ...), T the time of its fall, and gather at T (1 + e) / (1 - e)."""
    values = np.array([0.5, 0.7])
    found = symgen.sweep(ball(**IMPACT), {"bounce": values}, times=(1.0,), until=5.0, **FALLING)
    fall = math.sqrt(2.0 / G)
    gather = fall * (1.0 + values) / (1.0 - values)
    assert list(found.status) == ["failed"] * 2
    for i, (e, end) in enumerate(zip(values, gather, strict=True)):
        assert found.reason[i].startswith("events of 'impact' accumulate at t = ")
        assert float(found.reason[i].split()[7]) == pytest.approx(end, abs=1e-9)
        n = int(found["event.impact.count"][i])
        last = fall + 2.0 * fall * sum(e**k for k in range(1, n))
        assert found["event.impact.first"][i] == pytest.approx(fall, abs=1e-12)
        assert found["event.impact.last"][i] == pytest.approx(last, abs=1e-9)
        one = ball(**IMPACT).simulate(parameters={"bounce": float(e)}, times=(1.0,), until=5.0, **FALLING)
        assert (found.reason[i], n) == (one.reason, len(one.events))
        assert_same_motion(found["ball.y"][i, 0], one["ball.y"][0])


@pytest.mark.slow_cases("adaptive")
@pytest.mark.parametrize("scheme", [{}, {"integrator": "dop853", "step": None}], ids=["constant", "adaptive"])
def test_an_output_at_a_reset_holds_the_state_behind_it(scheme):
    """Thrown up with 3 m/s at 0.25 s, where h - g t^2 / 2 is the height: in rows as in single runs."""
    model = ball(throw={"when": "t > 0.25", "reset": {"ball.vy": "3.0"}})
    settings = {**FALLING, **scheme, "until": 0.5}
    at = model.simulate(**settings).events[0].t
    settings["times"] = (0.1, at, 0.5)
    found = symgen.sweep(model, {"height": [1.0, 2.0]}, quantities=("q", "v", "energy"), **settings)
    np.testing.assert_allclose(found["ball.vy"], [[-0.1 * G, 3.0, 3.0 - 0.25 * G]] * 2, atol=1e-9)
    np.testing.assert_allclose(found["ball.y"][:, 1], [1.0 - 0.5 * G / 16.0, 2.0 - 0.5 * G / 16.0], atol=1e-9)
    assert_rows(found, model, **settings)


@pytest.mark.slow
def test_an_input_that_cannot_be_is_not_blamed_on_an_event():
    """The ball has bounced when the input jumps to where a formula of it is no number."""
    raw_ball = copy.deepcopy(BALL)
    raw_ball["inputs"] = {"lift": 1.0}
    raw_ball["forces"] = {"lift": {"type": "force", "body": "ball", "force": [0.0, "sqrt(lift)"]}}
    model = symgen.load(mechanism_of({**raw_ball, "events": IMPACT}))
    jump = {"t": [0.0, 0.9], "u": [1.0, -1.0], "interpolation": "hold"}
    found = symgen.sweep(model, {"bounce": [0.5, 0.7]}, inputs={"lift": jump}, times=(1.0,), until=1.0, **FALLING)
    assert list(found.status) == ["failed"] * 2 and (found["event.impact.count"] >= 1).all()
    assert not any("impact" in reason for reason in found.reason), found.reason


def test_a_reset_that_cannot_be_is_a_failed_row():
    """A pendulum cannot be thrown along its rod; a run that never gets there is none the worse."""
    description = copy.deepcopy(raw("pendulum"))
    description["parameters"]["when"] = 0.05
    description["events"] = {"kick": {"when": "t > when", "reset": {"bob.vx": "3.0", "bob.vy": "5.0"}}}
    settings = {"until": 0.1, "step": 1e-2, "integrator": "rk4", "method": "lagrange"}
    found = symgen.sweep(symgen.load(mechanism_of(description)), {"when": [0.05, 1.0]}, **settings)
    assert list(found.status) == ["failed", "ok"]
    assert found.reason[0] == (
        "event 'kick': reset: expected velocities that the joints and each other allow, got others at t = 0.05 s"
    )


def test_events_that_are_only_recorded_are_looked_for_where_they_are_asked_for():
    """Zero crossings of a free fall thrown up at v: at 0 < t = 2 v / g; nothing of it where nobody asks."""
    model = ball(low={"when": "ball.y < height", "action": "record"})
    vary = {"ball.vy": [1.0, 2.0]}
    plain = symgen.sweep(model, vary, until=1.0, **FALLING)
    assert plain.ensemble.recipe.watch is None and plain.to_json()["events"] == {}
    found = symgen.sweep(model, vary, quantities=("ball.y", "event"), until=1.0, **FALLING)
    np.testing.assert_allclose(found["event.low.first"], 2.0 * np.array([1.0, 2.0]) / G, atol=1e-12)
    assert_same_motion(found["ball.y"], plain["ball.y"])
    with pytest.raises(InputError, match=r"quantity 'event\.lo': expected an event of ball, got none; did you mean"):
        symgen.sweep(model, vary, quantities=("event.lo",), until=1.0, **FALLING)


# -- inputs ------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def cart():
    """A point of mass `mass` that an input pushes."""
    return Model(
        MechanismBuilder("cart")
        .run(until=1.0, step=0.01)
        .parameter("mass", 1.0)
        .parameter("late", 0.25)
        .input("push", 0.5, unit="N")
        .body("block", type="point", mass="mass", velocity=(0.0, 0.0))
        .force("all", "force", body="block", force=("push", 0.0))
        .output("shove", "2*push", unit="N")
        .build()
    )


ASKED = {"method": "lagrange", "integrator": "rk4", "step": 0.03, "until": 1.0}


def test_a_formula_of_time_is_an_input_of_every_run(cart):
    """v = (1 - cos w t)/(m w) under a push sin(w t)."""
    mass = np.array([1.0, 4.0])
    found = symgen.sweep(
        cart,
        {"mass": mass},
        inputs={"push": "sin(3*t)"},
        integrator="dop853",
        rtol=1e-11,
        atol=1e-13,
        until=1.0,
        method="lagrange",
    )
    np.testing.assert_allclose(found["block.vx"][:, 0], (1.0 - math.cos(3.0)) / (3.0 * mass), rtol=1e-10)
    assert found.ensemble.recipe.watch is None  # nothing jumps: it costs nothing
    assert '"push": "sin(3*t)"' in found.attributes["inputs"]


def test_jumps_are_met_exactly_where_each_run_has_them(cart):
    """A push of 2 N from `late` on, between the steps of a run: v = 2 (1 - late)/m, x = (1 - late)^2/m, exactly."""
    late, mass = np.array([0.25, 0.511]), np.array([1.0, 4.0])
    asked = {"inputs": {"push": "2 if t > late else 0"}, "times": (0.2, 1.0), **ASKED}
    found = symgen.sweep(cart, {"late": late, "mass": mass}, quantities=("block", "shove", "block.ax"), **asked)
    assert found.counts["ok"] == 4
    rest = 1.0 - late[:, None]
    np.testing.assert_allclose(found["block.vx"][..., 1], 2.0 * rest / mass, rtol=1e-13)
    np.testing.assert_allclose(found["block.x"][..., 1], rest**2 / mass, rtol=1e-13)
    np.testing.assert_array_equal(found["shove"][..., 0], 0.0)
    np.testing.assert_array_equal(found["shove"][..., 1], 4.0)
    np.testing.assert_allclose(found["block.ax"][..., 1], np.broadcast_to(2.0 / mass, (2, 2)), rtol=1e-15)
    one = cart.simulate(parameters={"late": 0.511, "mass": 4.0}, **asked)
    for name in ("block.x", "block.vx", "block.ax"):
        assert_same_motion(found[name][1, 1], one[name], name)


def test_samples_and_held_values_are_inputs_of_every_run(cart, tmp_path):
    file = tmp_path / "push.csv"
    file.write_text("t,u\n0.0,1.0\n0.4,3.0\n")
    mass = np.array([1.0, 2.0])
    held = {"inputs": {"push": f"{file}:u:hold"}, **ASKED}
    found = symgen.sweep(cart, {"mass": mass}, **held)
    np.testing.assert_allclose(found["block.vx"][:, 0], (0.4 + 1.8) / mass, rtol=1e-13)
    number = symgen.sweep(cart, {"mass": mass}, inputs={"push": 3.0}, **ASKED)
    assert number.ensemble.recipe.watch is None
    np.testing.assert_allclose(number["block.vx"][:, 0], 3.0 / mass, rtol=1e-13)
    with pytest.raises(InputError, match="vary 'push': expected one way of giving it a value, got two"):
        symgen.sweep(cart, {"push": [1.0]}, inputs={"push": 3.0}, **ASKED)


# -- starts ------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_joint_coordinates_vary_and_are_held():
    """The crank of a slider-crank is turned by what its pin to the rod shows: phi, rod and pin make a triangle."""
    model = symgen.load("slider-crank")
    joint = next(x.name for x in model.mechanism.joints if set(x.bodies) == {"crank", "rod"})
    name, angles = f"{joint}.angle", np.array([-1.0, -0.6])
    asked = {"integrator": "rk4", "until": 0.02, "step": 1e-3, "times": (0.0, 0.02)}
    found = symgen.sweep(model, {name: angles}, quantities=("q", "v", name), **asked)
    assert list(found.status) == ["ok", "ok"]
    np.testing.assert_allclose(found[name][:, 0], angles, atol=1e-12)
    # sin(crank) r = -sin(rod) l, and the pin's angle is that of the rod less that of the crank
    crank, rod = found["crank.theta"][:, 0], found["rod.theta"][:, 0]
    np.testing.assert_allclose(0.15 * np.sin(crank) + 0.45 * np.sin(rod), 0.0, atol=1e-12)
    np.testing.assert_allclose(rod - crank, angles, atol=1e-12)
    for i, angle in enumerate(angles):
        one = model.simulate(start={name: float(angle)}, **asked)
        for quantity in (*one.q.names, *one.v.names):
            assert_same_motion(found[quantity][i], one[quantity], quantity)
    constant = symgen.sweep(model, {"rod_mass": [0.5, 1.5]}, start={name: -0.6}, quantities=("q",), **asked)
    assert_same_motion(constant["crank.theta"][:, 0], np.repeat(found["crank.theta"][1, 0], 2))
    assert found.to_xarray().sizes[f"{name}(0)"] == 2
    lanes = symgen.sweep(model, {name: angles}, quantities=("q",), target="lanes", **asked)
    np.testing.assert_allclose(lanes["crank.theta"], found["crank.theta"], rtol=1e-12)


def test_one_thing_does_not_vary_twice():
    model = symgen.load("slider-crank")
    joint = next(x.name for x in model.mechanism.joints if set(x.bodies) == {"ground", "crank"})
    with pytest.raises(InputError, match=r"expected each thing once, got crank\.theta and .*, which are the same"):
        symgen.sweep(model, {"crank.theta": [0.1], f"{joint}.angle": [0.2]}, until=0.01)


def test_other_targets_refuse_them_in_one_sentence(cart):
    for asked, said in (
        ({"inputs": {"push": "2 if t > late else 0"}}, "target 'lanes': expected no inputs that jump, got some"),
        ({"stop_when": "t > 1"}, "target 'lanes': expected no events, got the event 't > 1', which ends runs"),
        ({"coordinates": "joint"}, "target 'lanes': expected absolute coordinates, got joint"),
    ):
        with pytest.raises(InputError, match=said):
            symgen.sweep(cart, {"mass": [1.0]}, target="lanes", **ASKED, **asked)
