"""What stepped runs measure while they run, beginning anew, and the result that they end in."""

import numpy as np
import pytest

import symgen
from symgen import MechanismBuilder
from symgen.base.errors import InputError
from symgen.result.stepping import history

TABLES = ("q", "v", "a", "lam", "reactions", "points", "elements", "outputs", "energy", "violations")


@pytest.fixture(scope="module")
def model():
    builder = MechanismBuilder("sprung-arm", gravity=(0.0, -9.81)).input("push", 0.5, unit="N m")
    builder.body("arm", mass=1.2, inertia=0.05, points={"hub": (-0.3, 0.0), "tip": (0.3, 0.0)}, position=(0.3, 0.0))
    builder.joint("hub", "revolute", between=("ground", "arm"), at=((0.0, 0.0), "hub"))
    builder.force("motor", "torque", body="arm", torque="push")
    builder.force(
        "spring", "spring-damper", between=("ground", "arm"), at=((0.6, 0.5), "tip"), stiffness=80.0, damping=0.4
    )
    builder.output("height", "arm.tip.y", unit="m").output("spent", "integral(spring.power)", unit="J")
    return symgen.load(builder.build())


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_result_is_that_of_the_run_in_one_go(model, coordinates):
    sim = model.start(integrator="rk4", step=1e-3, coordinates=coordinates)
    for _ in range(50):
        sim.step(2e-3)
    whole = model.simulate(until=0.1, integrator="rk4", step=1e-3, output_step=2e-3, coordinates=coordinates)
    result = sim.result()
    assert result.ok and result.end == sim.t and np.array_equal(result.t, whole.t)
    for table in TABLES:
        assert np.array_equal(getattr(result, table).values, getattr(whole, table).values), table
    sim.step(0.01)
    assert len(result.t) == 51 and result["arm.theta"][-1] == whole["arm.theta"][-1]  # it does not go on


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_what_is_measured_is_that_of_results(model, coordinates):
    sim = model.start(integrator="rk4", step=1e-3, coordinates=coordinates)
    whole = model.simulate(until=0.02, integrator="rk4", step=1e-3, coordinates=coordinates)
    for k in (0, 7, 20):
        sim.run(whole.t[k])
        for name in ("outputs", "points", "elements", "reactions"):
            assert getattr(sim, name) == getattr(whole, name).row(k)
        assert sim["spring.force"] == whole["spring.force"][k] and sim["arm.tip.vx"] == whole["arm.tip.vx"][k]
    with pytest.raises(InputError, match=r"did you mean 'spring.force'\?"):
        sim["spring.forc"]


def test_a_sensor_sees_what_was_set(model):
    sim = model.start(integrator="rk4", step=1e-3)
    before = sim["arm.alpha"]
    sim.set(push=2.0)
    hinge = 0.05 + 1.2 * 0.3**2
    assert sim["arm.alpha"] - before == pytest.approx(1.5 / hinge, rel=1e-12)


def test_pieces_have_the_parameters_of_their_time(model):
    sim = model.start(integrator="rk4", step=1e-3)
    sim.step(0.01)
    sim.step(0.01, {"push": 3.0})
    result = sim.result()
    first, second = (model.simulate(until=0.01, integrator="rk4", step=1e-3, inputs={"push": u}) for u in (0.5, 3.0))
    del second
    assert result["arm.alpha"][1] == first["arm.alpha"][-1]  # before the input changed
    assert result["arm.alpha"][2] == sim["arm.alpha"]


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_beginning_anew(model, coordinates):
    sim = model.start(integrator="rk4", step=1e-3, coordinates=coordinates)
    sim.run(0.05)
    first = sim.bodies
    sim.set(push=4.0)
    sim.run(0.1)
    sim.reset()
    assert sim.t == 0.0 and sim.steps == 0 and sim.parameters["push"] == 0.5
    sim.run(0.05)
    assert sim.bodies == first
    sim.reset({"arm.theta": 0.4})
    sim.run(0.05)
    other = model.simulate(until=0.05, integrator="rk4", step=1e-3, start={"arm.theta": 0.4}, coordinates=coordinates)
    assert sim.bodies["arm.theta"] == other["arm.theta"][-1]
    assert sim.result().start["q"]["arm.theta"] == 0.4
    sim.reset(other)
    assert sim.t == 0.05 and sim.bodies["arm.theta"] == other["arm.theta"][-1]
    sim.run(0.06)
    assert sim.result().t[0] == 0.05


def test_controllers_begin_anew(model):
    beats = []
    sim = model.start(integrator="rk4", step=1e-3)
    sim.every(0.01, lambda t, run: beats.append(t))
    sim.run(0.03)
    sim.reset()
    sim.run(0.03)
    assert beats == [*beats[:3]] * 2 and beats[0] == 0.0


def test_memory_is_bounded(model, monkeypatch):
    """Every second state is kept where there are too many, and always the present one."""
    monkeypatch.setattr(history, "MOST", 16)
    monkeypatch.setattr(history, "BYTES", 1.0)
    sim = model.start(integrator="rk4", step=1e-3)
    for _ in range(1000):
        sim.step(1e-3)
    result = sim.result()
    assert len(result.t) <= 65 and result.t[0] == 0.0 and result.end == sim.t == result.t[-1]
    assert len(set(np.round(np.diff(result.t)[:-1], 9))) == 1
