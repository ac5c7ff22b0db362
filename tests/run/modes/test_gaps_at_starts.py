"""Gaps that touch at a start within the resolution of positions are put to 0, and left where nothing presses."""

import numpy as np
import pytest

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

BALL = """
[mechanism]
name = "ball"
gravity = [0.0, "g"]
[parameters]
height = 1.0
g = -9.81
[bodies.ball]
type = "point"
mass = 2.0
position = [0.0, "height"]
[joints.rail]
type = "rows"
rows = [{ position = "ball.x" }]
[stops.floor]
gap = "ball.y"
restitution = 0.6
"""
#: A lamp in space on a skew pin, with a second arm on a ball joint, whose tip lies on a table.
LAMP = """
[mechanism]
name = "lamp"
space = "spatial"
gravity = [0.0, 0.0, -9.81]
[parameters]
above = 4e-10
[bodies.upper]
mass = 1.0
inertia = [0.01, 0.02, 0.03]
points = { a = [-0.2, 0.0, 0.0], b = [0.2, 0.0, 0.0] }
position = [0.2, 0.0, 0.5]
[bodies.lower]
mass = 1.0
inertia = [0.01, 0.02, 0.03]
points = { a = [-0.3, 0.0, 0.0], b = [0.3, 0.0, 0.0] }
position = [0.7, 0.0, 0.5]
[joints.shoulder]
type = "revolute"
between = ["ground", "upper"]
at = [[0.0, 0.0, 0.5], "a"]
axis = [0.0, 0.8, 0.6]
[joints.elbow]
type = "spherical"
between = ["upper", "lower"]
at = ["b", "a"]
[stops.table]
gap = "lower.z - 0.5 + above"
[stops.shelf]
gap = "upper.z - 0.5 + 2*above"
"""


def model(text: str) -> symgen.Model:
    return symgen.Model(validate(parse_toml(text, "gap.toml"), "gap.toml"))


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_ball_lies_on_its_floor(coordinates: str) -> None:
    run = model(BALL).simulate(until=0.1, coordinates=coordinates, parameters={"height": 5e-10})
    assert run.status == "ok" and not run.events
    assert np.array_equal(run["ball.y"], np.zeros(len(run.t)))
    assert run["floor.force"] == pytest.approx(np.full(len(run.t), 19.62), abs=1e-12)
    assert "gaps that touch at the start were put to 0: floor (5e-10)" in run.notes


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_gap_that_nothing_presses_is_left(coordinates: str) -> None:
    run = model(BALL).simulate(until=0.1, coordinates=coordinates, parameters={"g": 9.81, "height": 5e-10})
    assert run["ball.y"][0] == 5e-10 and run["ball.y"][-1] == pytest.approx(5e-10 + 0.5 * 9.81 * 0.01, abs=1e-14)
    assert not any("put to 0" in note for note in run.notes)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_arms_in_space_are_laid_down_with_their_joints_closed(coordinates: str) -> None:
    """The gaps are closed from below: positions go up by what the tables lie too high."""
    run = model(LAMP.replace("+ above", "- above").replace("+ 2*above", "- 2*above")).simulate(
        until=0.02, coordinates=coordinates
    )
    assert run.status == "ok" and run.position_violation_max < 1e-14
    for name, row in (("table", "lower"), ("shelf", "upper")):
        above = 4e-10 * (1.0 if name == "table" else 2.0)
        assert any(name in note for note in run.notes if "put to 0" in note)
        assert run[f"{row}.z"][0] - 0.5 == pytest.approx(above, abs=3e-16)
    turn = run["upper.e0"][0] ** 2 + sum(run[f"upper.e{k}"][0] ** 2 for k in (1, 2, 3))
    assert turn == pytest.approx(1.0, abs=1e-15)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_heights_over_a_floor_from_0_on_are_smooth(coordinates: str) -> None:
    heights = np.linspace(0.0, 1e-8, 301)
    settings = {"until": 0.1, "coordinates": coordinates}
    rows = model(BALL).sweep({"height": heights}, quantities=("ball.y", "floor.force"), output_step=0.05, **settings)
    assert set(rows.status) == {"ok"}
    assert float(np.abs(rows["ball.y"][:, 1:]).max()) < 1e-15
    assert rows["floor.force"][:, 1:] == pytest.approx(np.full((301, 2), 19.62), abs=1e-9)
    for k in (0, 7, 29, 31, 300):
        alone = model(BALL).simulate(parameters={"height": heights[k]}, output_step=0.05, verify=False, **settings)
        assert alone["ball.y"] == pytest.approx(rows["ball.y"][k], abs=1e-15)
