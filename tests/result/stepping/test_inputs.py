"""Inputs of runs that go on step by step: held numbers, formulas, data, jumps; against runs in one piece."""

import math

import numpy as np
import pytest
from support.checks import assert_same_motion

from symgen.api import Model
from symgen.base.errors import InputError
from symgen.describe.files.builder import MechanismBuilder

STIFFNESS = 40.0
OMEGA = math.sqrt(STIFFNESS)
TIMES, PUSHES = [0.0, 0.1, 0.2, 0.3, 0.4], [2.0, -1.5, 0.25, 3.0, -0.5]


@pytest.fixture(scope="module")
def model():
    return Model(
        MechanismBuilder("pushed-rod", gravity=(0.0, -9.81))
        .run(until=0.5, step=0.01)
        .parameter("stiffness", STIFFNESS)
        .input("push", 0.5, unit="N")
        .input("side", 0.0)
        .body("block", type="point", mass=1.0, velocity=(0.0, 0.0))
        .body("rod", mass=0.5, inertia=0.04, points={"hub": (-0.3, 0.0)}, position=(0.3, 0.0))
        .joint("hub", "revolute", between=("ground", "rod"), at=((0.0, 0.0), "hub"))
        .force("all", "force", body="block", force=("push - stiffness*block.x", "side + 9.81"))
        .force("motor", "torque", body="rod", torque="0.3*push")
        .build()
    )


def swung(x, v, u, h):
    """The block after h with a constant push."""
    rest = u / STIFFNESS
    c, s = math.cos(OMEGA * h), math.sin(OMEGA * h)
    return rest + (x - rest) * c + v / OMEGA * s, -(x - rest) * OMEGA * s + v * c


def block(sim):
    return sim.q["block.x"], sim.v["block.vx"]


SETTINGS = {"method": "direct-correction", "step": 0.01, "until": 0.5}


@pytest.mark.parametrize("integrator", ["rk4", "abm4"])
def test_values_that_are_held_are_data_that_are_held(model, integrator):
    held = {"t": TIMES, "u": PUSHES, "interpolation": "hold"}
    whole = model.simulate(integrator=integrator, inputs={"push": held}, **SETTINGS)
    sim = model.start(integrator=integrator, **SETTINGS)
    for push in PUSHES:
        sim.step(0.05, u={"push": push})
        sim.step(0.05)
    assert_same_motion(sim.q, whole.q.values[-1])
    assert_same_motion(sim.v, whole.v.values[-1])
    assert sim.parameters == {"stiffness": STIFFNESS, "push": PUSHES[-1], "side": 0.0}


@pytest.mark.parametrize("integrator", ["dop853", "picard", "abm", "radau5"])
def test_adaptive_steps_meet_the_closed_form(model, integrator):
    sim, x = model.start(integrator=integrator, rtol=1e-11, atol=1e-12), (0.0, 0.0)
    for k in range(20):
        push = math.sin(7.0 * k)
        sim.step(0.05, u={"push": push})
        x = swung(*x, push, 0.05)
        assert block(sim) == pytest.approx(x, abs=1e-9 if integrator == "dop853" else 1e-7)
    sim.set(push=1.0, stiffness=STIFFNESS)  # with a number that is no input, the long way
    sim.step(0.1)
    assert block(sim) == pytest.approx(swung(*x, 1.0, 0.1), abs=1e-9 if integrator == "dop853" else 1e-7)


@pytest.mark.parametrize("integrator", ["rk4", "abm4"])
@pytest.mark.parametrize(
    "push",
    [
        "2 if t < 0.13 else abs(t - 0.3)",
        {"t": [0.0, 0.13, 0.3], "u": [1.0, 2.0, -4.0], "interpolation": "hold"},
        "sign(sin(9*t))*stiffness/20",
    ],
)
def test_jumps_and_kinks_are_those_of_the_run_in_one_piece(model, push, integrator):
    settings = {**SETTINGS, "integrator": integrator, "inputs": {"push": push, "side": "cos(t)"}}
    whole = model.simulate(**settings)
    one, pieces, again = (model.start(**settings) for _ in range(3))
    one.run(0.5)
    assert_same_motion(one.state, np.append(whole.q.values[-1], whole.v.values[-1]))
    # ends of pieces at the jump, where the grid has a step, and between
    at = [0.07, 0.13, 0.2, 0.3, 0.5] if not isinstance(push, str) or "0.13" in push else [0.07, 0.2, 0.5]
    for until in at:
        pieces.run(until)
        saved = pieces.save()
        again.restore(saved)
        again.run(min(until + 0.04, 0.5))
        again.restore(saved)
    if len(at) == 5:
        np.testing.assert_array_equal(pieces.state, one.state)
        np.testing.assert_array_equal(again.state, one.state)
    np.testing.assert_allclose(pieces.state, one.state, rtol=0.0, atol=1e-5)
    assert set(pieces.parameters) == {"stiffness", "push", "side"}
    with pytest.raises(InputError, match="jumps of inputs are known up to there"):
        pieces.step(0.1)


@pytest.mark.parametrize("integrator", ["rk4", "dopri5"])
def test_an_input_jumps_where_a_parameter_says_that_is_set_on_the_way(integrator):
    """Pushed with 1 N until a time, from rest: 1 kg is then as fast as that time."""
    pushed = Model(
        MechanismBuilder("pushed")
        .run(until=1.0, step=0.01)
        .parameter("begin", 0.1)
        .parameter("long", 0.2)
        .parameter("until", "begin + long")
        .input("push", 0.0)
        .body("block", type="point", mass=1.0, velocity=(0.0, 0.0))
        .force("all", "force", body="block", force=("push", 0.0))
        .build()
    )
    sim = pushed.start(method="lagrange", integrator=integrator, inputs={"push": "1 if t < until else 0"})
    sim.run(0.1)
    sim.set(long=0.7)  # later
    sim.run(0.25)
    kept = sim.save()
    sim.run(1.0)
    assert block(sim)[1] == pytest.approx(0.8, abs=1e-12)
    sim.restore(kept)
    sim.set(long=0.1)  # is over
    sim.run(1.0)
    assert block(sim)[1] == pytest.approx(0.25, abs=1e-12)
    sim.restore(kept)
    sim.run(0.6)
    sim.set(until=0.65)  # in the place of its formula
    sim.run(1.0)
    assert block(sim)[1] == pytest.approx(0.65, abs=1e-12)
    other = pushed.start(method="lagrange", integrator=integrator, inputs={"push": "1 if t < until else 0"})
    other.restore(kept)
    other.run(1.0)
    assert block(other)[1] == pytest.approx(0.8, abs=1e-12)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_parameters_with_which_a_driver_would_jump_are_not_set(coordinates):
    led = Model(
        MechanismBuilder("led")
        .run(until=1.0, step=0.01)
        .parameter("jump", 0.0)
        .body("cart", mass=1.0, inertia=1.0)
        .joint("rail", "translational", between=("ground", "cart"), at=((0.0, 0.0), "centre"), axis=(1.0, 0.0))
        .joint("motor", "driver", joint="rail", value="0.1*t + (jump if t > 0.5 else 0)")
        .build()
    )
    sim = led.start(coordinates=coordinates)
    sim.run(0.1)
    with pytest.raises(InputError, match=r"a value that jumps by 0\.2 m at t = 0\.5 s"):
        sim.set(jump=0.2)
    sim.run(1.0)
    assert sim.bodies["cart.x"] == pytest.approx(0.1, abs=1e-12)


def test_what_an_input_is_told_is_not_set_as_well(model):
    sim = model.start(inputs={"push": "cos(t)"}, **SETTINGS)
    sim.step(0.1, u={"side": 1.0})
    with pytest.raises(
        InputError, match=r"set: 'push': expected an input that is a number in this run, got 'cos\(t\)'"
    ):
        sim.step(0.1, u={"push": 1.0})
    with pytest.raises(InputError, match="input 'side'"):
        sim.set(side=math.nan)
    with pytest.raises(InputError, match="none of that name"):
        sim.set(sidle=1.0)
    before = sim.save()
    with pytest.raises(InputError, match=r"expected (values for which every formula is finite|a finite number)"):
        sim._loop.changes.give_values({"side": math.inf})
    np.testing.assert_array_equal(sim.save().arrays["p"], before.arrays["p"])
    sim.set({"stiffness": 10.0, "side": 2.0})
    assert sim.parameters["side"] == 2.0 and sim.parameters["stiffness"] == 10.0


@pytest.mark.parametrize("push", ["2 if t < 0.2 else -1", {"t": [0.0, 0.2], "u": [2.0, -1.0], "interpolation": "hold"}])
def test_a_run_that_goes_on_where_an_input_has_jumped_is_the_run_in_one_piece(model, push):
    settings = {"integrator": "abm4", "step": 0.01, "inputs": {"push": push, "side": 0.5}}
    whole = model.simulate(until=0.5, **settings)
    for end in (0.2, 0.3):
        first = model.simulate(until=end, **settings)
        rest = model.simulate(until=0.5, start=first, **settings)
        assert rest.ok and "coordinates and velocities alone" not in rest.notes[0]
        np.testing.assert_array_equal(rest.q.values[-1], whole.q.values[-1])


def test_a_run_that_goes_on_with_another_number_has_it(model):
    settings = {"integrator": "rk4", "step": 0.01}
    first = model.simulate(until=0.2, inputs={"push": 2.0}, **settings)
    rest = model.simulate(until=0.5, start=first, inputs={"push": -1.0}, **settings)
    expected = swung(*swung(0.0, 0.0, 2.0, 0.2), -1.0, 0.3)
    assert (rest["block.x"][-1], rest["block.vx"][-1]) == pytest.approx(expected, abs=1e-5)
    assert rest.inputs["push"] == -1.0 and "coordinates and velocities alone" not in rest.notes[0]
