"""Lengths and angles of a picture: a typed value changes the numbers that decide it, and nothing else."""

import math
import re

import numpy as np
import pytest

from symgen.api import load
from symgen.base.errors import InputError
from symgen.describe.edits.dimensions import Dimension, dimension_changes, dimensions_of_file, read_dimension
from symgen.describe.edits.text_changes import apply_changes
from symgen.describe.files.load import parse_toml
from symgen.describe.files.places import outline_of_document
from symgen.describe.files.validate import validate

RIG = """\
# a rig with every way to write a length
[mechanism]
name = "rig"

[parameters]
rod = { value = 500, unit = "mm" }   # of the bar
half = "rod/2"
a = 1.0
b = 2.0

[bodies.bar]   # its length is a parameter, of which another one is half
mass = 1.0
inertia = 0.1
points = { A = ["-half", 0.0], B = ["half", 0.0] }
angle = "pi/6"   # a formula of numbers

[bodies.link]   # drawn by hand
mass = 1.0
inertia = 0.1
centre_of_mass = [0.15, 0.2]   # in its middle
points = { A = [0.0, 0.0], B = [0.3, 0.4] }

[bodies.plate]
mass = 1.0
inertia = 0.1
points = { A = [0.0, 0.0], B = ['200 mm', 0.0], C = [0.0, 1_0e-2] }   # of steel
position = [1.0, 1.0]
angle = "30 deg"

[bodies.odd]
mass = 1.0
inertia = 0.1
points = { A = ["a", 0.0], B = ["a + b", 0.0] }
angle = 0.25

[joints.left]
type = "revolute"
between = ["ground", "bar"]
at = [[-0.2165063509461097, -0.125], "A"]

[joints.right]
type = "revolute"
between = ["ground", "plate"]
at = [[1.0, 1.0], "A"]
"""


def state(text: str) -> tuple:
    """Return what dimensions are of: a mechanism at its described start."""
    raw = parse_toml(text, "rig.toml")
    mechanism = validate(raw, "rig.toml")
    model = load(mechanism)
    q = [float(x) for x in model.initial_state(model.parameters())[0]]
    return mechanism, raw, outline_of_document(text).values, text, q


def found(text: str) -> dict[str, Dimension]:
    return {each.name: each for each in dimensions_of_file(*state(text))}


def changed(text: str, name: str, value: str) -> str:
    return apply_changes(text, dimension_changes(*state(text), name, value))


def different_lines(before: str, after: str) -> list[str]:
    pairs = zip(before.splitlines(), after.splitlines(), strict=True)
    return [new for old, new in pairs if old != new]


def test_dimensions_are_where_the_points_are() -> None:
    every = found(RIG)
    assert set(every) == {
        *("bodies.bar.A-B", "bodies.bar.angle", "bodies.link.A-B", "bodies.link.angle", "bodies.odd.A-B"),
        *("bodies.plate.A-B", "bodies.plate.B-C", "bodies.plate.C-A", "bodies.plate.angle", "bodies.odd.angle"),
        "ground.left-right",
    }
    assert every["bodies.bar.A-B"].value == pytest.approx(0.5, abs=1e-15)
    assert every["bodies.link.angle"].value == pytest.approx(math.atan2(4.0, 3.0), abs=1e-15)
    assert every["bodies.plate.B-C"].value == pytest.approx(math.hypot(0.2, 0.1), abs=1e-15)
    assert every["ground.left-right"].parts == ("joints.left", "joints.right")
    x0, y0, x1, y1 = every["bodies.plate.A-B"].ends
    assert (x1 - x0, y1 - y0) == pytest.approx((0.2 * math.cos(math.pi / 6), 0.1), abs=1e-15)
    # of a length two parameters decide alike, of an angle one number does
    assert [name for name, each in every.items() if each.fixed] == []


@pytest.mark.parametrize(
    ("name", "value", "lines"),
    [
        ("bodies.bar.A-B", "0.75", ['rod = { value = 750.0, unit = "mm" }   # of the bar']),
        ("bodies.bar.angle", "45", ['angle = "45.0 deg"   # a formula of numbers']),
        (
            *("bodies.link.A-B", "1"),
            ["centre_of_mass = [0.3, 0.4]   # in its middle", "points = { A = [0.0, 0.0], B = [0.6, 0.8] }"],
        ),
        (
            *("bodies.link.angle", "0"),
            ["centre_of_mass = [0.25, 0.0]   # in its middle", "points = { A = [0.0, 0.0], B = [0.5, 0.0] }"],
        ),
        (
            *("bodies.plate.A-B", "250 mm"),
            ["points = { A = [0.0, 0.0], B = ['250.0 mm', 0.0], C = [0.0, 1_0e-2] }   # of steel"],
        ),
        ("bodies.plate.angle", "-15 deg", ['angle = "-15.0 deg"']),
        ("bodies.odd.angle", "0.5 rad", ["angle = 0.5"]),
        ("bodies.odd.A-B", "3", ["b = 3.0"]),
    ],
)
def test_a_typed_value_changes_the_numbers_that_decide_it(name: str, value: str, lines: list[str]) -> None:
    after = changed(RIG, name, value)
    assert different_lines(RIG, after) == lines
    kind = found(RIG)[name].kind
    assert found(after)[name].value == pytest.approx(read_dimension(kind, value), rel=1e-12, abs=1e-12)


@pytest.mark.slow
def test_lengths_of_each_kind_are_what_was_typed() -> None:
    rng = np.random.default_rng(8)
    parts = {"bodies.bar.A-B": "bodies.bar", "bodies.link.A-B": "bodies.link", "ground.left-right": "joints.left"}
    parts |= {"bodies.plate.B-C": "bodies.plate", "bodies.plate.C-A": "bodies.plate"}
    for name, part in parts.items():
        for length in 10.0 ** rng.uniform(-2.0, 1.0, 10):
            text = changed(RIG, name, repr(float(length)))
            own = {each.name: each for each in dimensions_of_file(*state(text), part)}
            assert own[name].value == pytest.approx(length, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("bodies.link.A-B", "0", "expected a length above 0, such as 0.25 or '25 mm', got '0'"),
        ("bodies.link.A-B", "-1", "expected a length above 0"),
        ("bodies.link.A-B", "3 kg", "expected a length above 0"),
        ("bodies.link.A-B", "long", "expected a length above 0"),
        ("bodies.link.angle", "3 m", "expected an angle, such as 30 or '0.5 rad', got '3 m'"),
        ("bodies.link.B-A", "1", "expected one of the picture, got 'bodies.link.B-A'; did you mean 'bodies.link.A-B'?"),
    ],
)
def test_what_is_no_length_or_angle_is_refused(name: str, value: str, words: str) -> None:
    with pytest.raises(InputError, match=re.escape(words)):
        changed(RIG, name, value)


def test_what_several_numbers_decide_stays_in_the_text() -> None:
    text = RIG.replace('["a + b", 0.0]', '["a + a*b", 0.0]')
    assert found(text)["bodies.odd.A-B"].fixed
    words = "expected a dimension that one number of the file decides, got one of a, b; change them in the text"
    with pytest.raises(InputError, match=re.escape(words)):
        changed(text, "bodies.odd.A-B", "3")
