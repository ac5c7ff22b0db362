"""Linear systems whose inputs follow formulas or data: changes are those beside what is given, derived by hand."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from analyses.rods import of_text
from symgen.base.errors import InputError

MASS, STIFFNESS = 2.0, 30.0
#: A block on a spring that an input pushes, the more the further it is, and an output that reads the input.
FILE = f"""
[mechanism]
name = "pushed"
[bodies.block]
mass = {MASS}
inertia = 1.0
[joints.guide]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
[inputs]
push = 0.7
idle = 0.2
[forces.spring]
type = "force"
body = "block"
force = ["-{STIFFNESS}*block.x + push*(1 + block.x)", 0.0]
[outputs]
felt = "3*push + block.x + idle"
"""
#: Given, what it is at 0.25 s, and how it changes with the place.
GIVEN = {
    "number": (1.5, 1.5, 0.0),
    "formula": ("4*t", 1.0, 0.0),
    "data": ({"t": [0.0, 1.0], "u": [1.0, 3.0]}, 1.5, 0.0),
    "smooth data that end": (
        {"t": [0.0, 0.1, 0.2, 0.25], "u": [0.0, 0.1, 0.2, 0.25], "interpolation": "cubic"},
        0.25,
        0.0,
    ),
    "state": ("2 - 5*block.x", None, -5.0),
    "before a jump": ("1 if t < 0.26 else 3", 1.0, 0.0),
    "at a jump": ("1 if t < 0.25 else 3", 3.0, 0.0),
    "behind a jump": ("1 if t < 0.2 else 3", 3.0, 0.0),
    "at a sample that is held": ({"t": [0.0, 0.25], "u": [1.0, 3.0], "interpolation": "hold"}, 3.0, 0.0),
}


@pytest.fixture(scope="module")
def model():
    return of_text(FILE)


@pytest.mark.fast(
    "number-absolute",
    "formula-absolute",
    "data-absolute",
    "state-absolute",
    "before a jump-absolute",
    "at a jump-absolute",
    "behind a jump-joint",
    "at a sample that is held-absolute",
)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", GIVEN)
def test_inputs_change_beside_what_they_are_given(model, name, coordinates):
    given, value, slope = GIVEN[name]
    asked = {"at": 0.25, "instantaneous": True, "states": ["block.x", "block.vx"], "inputs": {"push": given}}
    found = model.linearise(**asked, coordinates=coordinates)
    x = found.about["block.x"]
    value = 2.0 - 5.0 * x if value is None else value
    assert found.inputs == ("push", "idle")
    assert found.about["push"] == pytest.approx(value, rel=1e-12)
    assert found.about["idle"] == 0.2
    by_place = -STIFFNESS + value + slope * (1.0 + x)
    assert_allclose(found.A, [[0.0, 1.0], [by_place / MASS, 0.0]], rtol=0.0, atol=1e-9)
    assert_allclose(found.B, [[0.0, 0.0], [(1.0 + x) / MASS, 0.0]], rtol=0.0, atol=1e-9)
    assert_allclose(found.C, [[1.0 + 3.0 * slope, 0.0]], rtol=0.0, atol=1e-9)
    assert_allclose(found.D, [[3.0, 1.0]], rtol=0.0, atol=1e-12)


#: The same block, moved by a motor with constant speed: what the motor exerts is what the input does not.
DRIVEN = (
    FILE.replace(f"-{STIFFNESS}*block.x + push*(1 + block.x)", "push")
    + """
[joints.motor]
type = "driver"
joint = "guide"
value = "0.1*t"
"""
)


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("1 if t < -0.05 else 3", [1.0, 3.0, 3.0, 3.0]),
        ("(1 if t < -0.05 else 3) if t < 0.15 else 4", [1.0, 3.0, 3.0, 4.0]),
        ("sign(sin(10*t + 0.5))", [-1.0, 1.0, 1.0, -1.0]),
        ({"t": [-1.0, -0.05, 0.2], "u": [1.0, 3.0, 5.0], "interpolation": "hold"}, [1.0, 3.0, 3.0, 5.0]),
        ({"t": [-0.1, 0.3], "u": [1.0, 5.0]}, [1.0, 2.0, 3.0, 5.0]),
    ],
)
def test_prescribed_motions_before_zero_have_what_inputs_are_then(given, expected):
    driven = of_text(DRIVEN)
    found = driven.kinematics([-0.1, 0.0, 0.1, 0.3], inputs={"push": given})
    assert_allclose(found.efforts["motor"], np.negative(expected), rtol=0.0, atol=1e-12)


def test_smooth_data_cover_the_times_before_zero():
    driven = of_text(DRIVEN)
    short = {"t": [0.0, 0.1, 0.2, 0.3], "u": [0.0, 0.1, 0.2, 0.3], "interpolation": "cubic"}
    with pytest.raises(InputError, match=r"data from -0\.1 to 0\.3 s"):
        driven.kinematics([-0.1, 0.3], inputs={"push": short})
