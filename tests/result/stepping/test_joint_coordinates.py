"""Runs step by step whose state is that of the joints of a tree: the same as runs in one piece."""

import numpy as np
import pytest
from support.checks import assert_same_motion

from symgen import InputError, load

ARM = """
[mechanism]
name = "arm"
gravity = [0.0, -9.81]
[parameters]
length = 0.7
mass = 1.2
[inputs]
torque = { default = 0.3, unit = "N m" }
[bodies.upper]
mass = "mass"
inertia = 0.05
points = { end = ["length", 0.0] }
angle = 0.3
[bodies.lower]
mass = 0.8
inertia = 0.03
centre_of_mass = [0.3, 0.0]
position = ["length*cos(0.3)", "length*sin(0.3)"]
angle = -0.4
angular_velocity = 0.5
[joints.shoulder]
type = "revolute"
between = ["ground", "upper"]
at = [[0.0, 0.0], [0.0, 0.0]]
[joints.elbow]
type = "revolute"
between = ["upper", "lower"]
at = ["end", [0.0, 0.0]]
[forces.motor]
type = "torque"
body = "upper"
torque = "torque"
"""


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    path = tmp_path_factory.mktemp("stepped") / "arm.toml"
    path.write_text(ARM, encoding="utf-8")
    return load(path)


@pytest.mark.parametrize("integrator", ["rk4", "abm4"])
def test_pieces_are_one_run(arm, integrator):
    given = {"coordinates": "joint", "method": "lagrange", "integrator": integrator, "step": 1e-3}
    whole = arm.simulate(until=0.06, output_step=0.06, **given)
    sim = arm.start(**given)
    assert sim.q.names == ("upper.theta", "lower.theta")
    for _ in range(10):
        sim.step(0.003)
    kept, half = sim.save(), sim.bodies
    sim.run(0.06)
    first = sim.bodies
    assert_same_motion(list(first.values()), [whole[name][-1] for name in first])
    sim.restore(kept)
    assert sim.bodies == half
    sim.run(0.06)
    assert sim.bodies == first


def test_bodies_stand_on_their_joints(arm):
    sim = arm.start(coordinates="joint", integrator="rk4", step=1e-3)
    sim.run(0.2)
    at = sim.bodies
    (a, b), (wa, wb) = sim.q.tolist(), sim.v.tolist()
    # coordinates of a body are those of its centre of mass
    assert at["lower.x"] == pytest.approx(0.7 * np.cos(a) + 0.3 * np.cos(b), abs=1e-14)
    assert at["lower.vy"] == pytest.approx(0.7 * np.cos(a) * wa + 0.3 * np.cos(b) * wb, abs=1e-14)


def test_controllers_read_joints(arm):
    """A spring of torque between ground and arm, held between beats: the equations of motion say what it does."""
    seen = []

    def controller(t, run):
        seen.append((t, float(run.q["upper.theta"])))
        return {"torque": -2.0 * float(run.q["upper.theta"])}

    sim = arm.start(coordinates="joint", integrator="rk4", step=1e-3)
    sim.every(0.01, controller)
    sim.run(0.05)
    other = arm.start(integrator="rk4", step=1e-3)
    other.every(0.01, controller)
    other.run(0.05)
    joint, absolute = seen[:5], seen[5:]
    assert [t for t, _ in joint] == [t for t, _ in absolute] == [k * 0.01 for k in range(5)]
    # RK4 at this step is off by 1e-10 or less in both
    np.testing.assert_allclose([x for _, x in joint], [x for _, x in absolute], atol=1e-9)


def test_masses_may_change_and_lengths_may_not(arm):
    sim = arm.start(coordinates="joint", integrator="rk4", step=1e-3)
    sim.run(0.02)
    before = sim.bodies
    with pytest.raises(InputError, match="leave the position of every joint as it is, got some that move lower"):
        sim.set(length=0.9)
    assert sim.parameters["length"] == 0.7 and sim.bodies == before
    sim.set(mass=2.0)
    assert sim.parameters["mass"] == 2.0
    sim.run(0.03)
    assert sim.bodies != before


def test_bodies_of_a_run_in_their_own_coordinates(arm):
    sim = arm.start(integrator="rk4", step=1e-3)
    assert sim.bodies["lower.theta"] == sim.q["lower.theta"]
