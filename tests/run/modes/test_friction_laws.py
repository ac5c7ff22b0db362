"""Friction with a smooth law in place of the exact one, and sliding friction in inverse dynamics."""

from pathlib import Path

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

#: A mass of 1 kg at 1 m with a dry torque, and 1.5 kg m^2 about the pin; it hangs at 0.
PENDULUM = """
[mechanism]
name = "pendulum"
gravity = [0.0, -9.81]

[bodies.bob]
mass = 1.0
inertia = 0.5
points = { pivot = [0.0, 1.0] }

[joints.pin]
type = "revolute"
between = ["ground", "bob"]
at = [[0.0, 0.0], "pivot"]
start = { angle = 0.04 }
friction = { FRICTION }
"""


def pendulum(friction: str) -> Mechanism:
    return validate(parse_toml(PENDULUM.replace("FRICTION", friction), "p"), "p.toml")


@pytest.mark.slow
def test_a_smooth_law_creeps_where_the_exact_one_rests(tmp_path: Path) -> None:
    """It holds by its rate alone: 0.5 N m tanh(rate / speed) = m g l sin(angle)."""
    exact = symgen.load(pendulum("sliding = 0.5")).simulate(until=10.0, output_step=1.0)
    np.testing.assert_allclose(exact["pin.angle"], 0.04, rtol=0, atol=1e-12)
    smooth = symgen.load(pendulum('sliding = 0.5, law = "tanh", speed = 1e-3'))
    assert smooth.mechanism.bounded == () and smooth.mechanism.forces[0].name == "pin.friction"
    result = smooth.simulate(until=10.0, integrator="dop853", rtol=1e-10, output_step=1.0)
    held = 9.81 * np.sin(result["pin.angle"])
    rates = -1e-3 * np.arctanh(held / 0.5)
    np.testing.assert_allclose(result["pin.angle.rate"][1:], rates[1:], rtol=0.0, atol=2e-6)
    np.testing.assert_allclose(result.outputs["pin.force"], -0.5 * np.tanh(result["pin.angle.rate"] / 1e-3), atol=1e-12)
    assert not result.events
    smooth.generate(tmp_path / "smooth", target="c")


@pytest.mark.parametrize(
    ("friction", "sentence"),
    [
        ('sliding = 0.5, law = "tanh"', r"friction\.speed: expected a rate beside law = \"tanh\", got no such key"),
        ("sliding = 0.5, speed = 1e-3", r"friction\.speed: expected no such key without law"),
        ('sliding = 0.5, law = "tanh", speed = 0.0', r"friction\.speed: expected a value above 0"),
        ('sliding = 0.5, law = "sign", speed = 1.0', r"friction\.law: expected"),
        (
            'sliding = 0.5, static = 0.6, law = "tanh", speed = 1.0',
            r"friction\.law: .* the key static without stribeck",
        ),
        ('coefficient = 0.5, radius = 0.1, law = "tanh", speed = 1.0', r"friction\.law: .* got the key coefficient"),
    ],
)
def test_wrong_laws(friction: str, sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        pendulum(friction)


def test_inverse_dynamics_overcome_sliding_friction() -> None:
    """1.5 angle'' + m g l sin(angle) + 0.5 sign(rate) + 0.2 rate is the torque at the pin; at rest without friction."""
    driven = PENDULUM.replace("friction = { FRICTION }", "").replace("start = { angle = 0.04 }", "")
    driven += '[joints.motor]\ntype = "driver"\njoint = "pin"\nvalue = "0.3*sin(2*t)"\n'
    t = np.linspace(0.0, 2.0, 41)
    turning = symgen.load(validate(parse_toml(driven, "p"), "p.toml")).kinematics(times=t)
    angle, rate, second = 0.3 * np.sin(2.0 * t), 0.6 * np.cos(2.0 * t), -1.2 * np.sin(2.0 * t)
    model = symgen.load(pendulum("sliding = 0.5, viscous = 0.2"))
    found = model.inverse(turning, actuators=["pin"])
    expected = 1.5 * second + 9.81 * np.sin(angle) + 0.5 * np.sign(rate) + 0.2 * rate
    np.testing.assert_allclose(found.efforts.values[:, 0], expected, rtol=0, atol=1e-10)
