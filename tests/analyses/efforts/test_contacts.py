"""Inverse dynamics with friction by reactions and with stops: Newton's equations by hand, and runs of known efforts."""

import numpy as np
import pytest

import symgen
from benchmarks.bounded.machines import FOLDER
from symgen.analyses.state.subject import make_subject
from symgen.base.settings import Settings

G = 9.81

#: A wheel with its centre off the pin, which has friction by its own reaction, and a driver that turns one without.
CRANK = """
[mechanism]
name = "turned-crank"
gravity = [0.0, -9.81]
[run]
until = 2.0
[bodies.crank]
mass = 2.0
inertia = 0.1
position = [0.3, 0.0]
points = { pin = [-0.3, 0.0] }
[joints.pin]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], "pin"]
"""
FRICTION = "friction = { coefficient = 0.2, radius = 0.05, viscous = 0.01 }"
MOTOR = '[joints.motor]\ntype = "driver"\njoint = "pin"\nvalue = "3.0*t + 0.5*sin(2*t)"'

#: A block on a rail against a stop, pulled by a spring and pushed by an input.
BLOCK = """
[mechanism]
name = "pushed-block"
gravity = [0.0, -9.81]
[run]
until = 1.5
[inputs]
push = { default = 6.0, unit = "N" }
[bodies.block]
mass = 2.0
inertia = 0.1
[joints.rail]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
angle = 0.0
stop = { upper = 0.2 }
[forces.spring]
type = "force"
body = "block"
force = ["PULL", 0.0]
[forces.drive]
type = "force"
body = "block"
force = ["push", 0.0]
"""


def load(tmp_path, text):
    (path := tmp_path / "file.toml").write_text(text)
    return symgen.load(path)


@pytest.mark.slow
def test_friction_of_a_pin_by_its_reaction(tmp_path):
    """Torque = I a + m g l cos + mu r |N|, the reaction N being m (a - g) of the centre."""
    t = np.linspace(0.0, 2.0, 41)
    turning = load(tmp_path, CRANK + MOTOR).kinematics(times=t)
    found = load(tmp_path, CRANK + FRICTION).inverse(turning, actuators=["pin"])
    angle, rate, second = 3.0 * t + 0.5 * np.sin(2.0 * t), 3.0 + np.cos(2.0 * t), -2.0 * np.sin(2.0 * t)
    along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    reaction = 2.0 * (0.3 * (second * across - rate**2 * along) + np.array([[0.0], [G]]))
    torque = (0.1 + 2.0 * 0.09) * second + 2.0 * G * 0.3 * np.cos(angle)
    torque += 0.01 * np.linalg.norm(reaction, axis=0) + 0.01 * rate
    np.testing.assert_allclose(found.efforts["pin"], torque, rtol=0.0, atol=1e-10)


@pytest.mark.slow
@pytest.mark.slow_cases("-5.0*block.x-1.0")
@pytest.mark.parametrize(("pull", "least"), [("-5.0*block.x", 1.0), ("5.0*block.x", 0.0)])
def test_a_closed_stop_bears_what_it_can(tmp_path, pull, least):
    """Before the impact efforts are those of the run; on the stop the least that hold the block there.

    A spring that pulls it off asks for its 1 N; one that presses it on asks for nothing.
    """
    model = load(tmp_path, BLOCK.replace("PULL", pull))
    run = model.simulate(method="lagrange", integrator="dop853", rtol=1e-11, atol=1e-12, output_step=0.05)
    found = model.inverse(run, actuators=["push"])
    closed = run["rail.upper.mode"] > 0.5
    assert 5 < closed.sum() < len(run.t) - 5
    np.testing.assert_allclose(found.efforts["push"], np.where(closed, least, 6.0), rtol=0.0, atol=1e-8)
    assert found.missing.max() < 1e-8
    (note,) = [note for note in found.notes if "rail.upper" in note]
    assert note == f"rail.upper is closed at {closed.sum()} times: efforts are the least with what it can bear"


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_machine_at_rest_on_its_stop_has_no_impact(coordinates):
    """Speeds of rounding are no scale of speeds, at whichever moment of the rest a run ended."""
    bucket = symgen.load(FOLDER / "bucket.toml")
    for until in np.linspace(0.06, 0.2, 15):
        run = bucket.simulate(until=until, coordinates=coordinates)
        subject = make_subject(bucket.mechanism, Settings(start=run, coordinates=coordinates))
        assert [row.name for row in subject.shut] == ["cylinder.lower"]
