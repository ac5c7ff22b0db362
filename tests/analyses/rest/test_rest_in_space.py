"""Rests, modes and linear systems beside friction of contacts in space: a ball, a table on three feet."""

import math
from pathlib import Path

import numpy as np
import pytest

from symgen import InputError
from symgen.base.errors import AnalysisError
from tests.run.contacts.scenes import G, loaded
from tests.run.contacts.scenes_in_space import ball_of, contact, head
from tests.run.contacts.test_friction_in_space import FEET, FLOOR, slider, tripod

#: A table whose floor gravity is not across.
LEANT = tripod((0.0, 0.0, -G), (0.0, 0.0, 0.0)).replace(
    "gravity = [0.0, 0.0, -9.81]", 'gravity = ["gx", "gy", "gz"]\n[parameters]\ngx = 0.0\ngy = 0.0\ngz = -9.81'
)


@pytest.mark.slow
@pytest.mark.by_turns(4)
@pytest.mark.parametrize("quarter", range(4))
def test_three_hundred_ways_of_leaning_a_table(quarter: int, tmp_path: Path) -> None:
    """It rests up to the angle of friction, by forces of its feet that balance weight and friction at the floor."""
    model, rests = loaded(LEANT, tmp_path), set()
    at = np.array(FEET)[:, :2]
    columns = np.array([np.ones(3), at[:, 1], at[:, 0]])
    places = zip(np.linspace(0.0, 0.39, 300), np.linspace(0.0, 40.0, 300), strict=True)
    for tilt, way in [*places][quarter::4]:
        pull = G * math.sin(tilt) * np.array([math.cos(way), math.sin(way)])
        down = G * math.cos(tilt)
        values = {"gx": float(pull[0]), "gy": float(pull[1]), "gz": -down}
        if math.tan(tilt) > 0.4:
            with pytest.raises(AnalysisError, match=r"slides there|does not hold it"):
                model.equilibrium(parameters=values)
            continue
        rest = model.equilibrium(parameters=values)
        rests.add(rest.stability)
        # no moment about the floor's axes through the centre's foot: weight acts 0.3 m above them
        pressed = np.linalg.solve(columns, 2.0 * np.array([down, 0.3 * pull[1], 0.3 * pull[0]]))
        forces = [rest.multipliers[f"foot{i}.normal"] for i in range(3)]
        assert np.abs(pressed + forces).max() < 1e-10
        along = np.array([[rest.multipliers[f"foot{i}.tangent{k}"] for k in (1, 2)] for i in range(3)])
        assert np.all(np.hypot(*along.T) <= 0.4 * pressed * (1.0 + 1e-8))
        assert abs(np.hypot(*along.sum(axis=0)) - 2.0 * G * math.sin(tilt)) < 1e-10
    assert rests == {"stable"}


@pytest.mark.slow
@pytest.mark.by_turns(4)
@pytest.mark.parametrize("quarter", range(4))
def test_a_ball_rolls_about_the_ground_of_bowls(quarter: int, tmp_path: Path) -> None:
    """Three hundred radii: two modes of 5/7 g / (R - r), spin and turns about the vertical free, from a start aside."""
    text = head() + "[parameters]\nR = 1.0\n" + ball_of(0.1, (0.0, 0.0, 0.0)).replace("0.0, 0.0, 0.0]", "0, 0, 0]", 1)
    text = text.replace("position = [0, 0, 0]", 'position = ["(R - 0.1)*sin(0.2)", 0.0, "-(R - 0.1)*cos(0.2)"]')
    model = loaded(
        text + contact('body = "ball", sphere = 0.1', 'body = "ground", sphere = "-R"', friction=0.5), tmp_path
    )
    for radius in np.linspace(0.15, 2.0, 300)[quarter::4].tolist():
        found = np.sort(np.abs(model.modes(parameters={"R": radius}).eigenvalues.imag))
        wanted = math.sqrt(5.0 / 7.0 * G / (radius - 0.1))
        assert np.allclose(found[-4:], wanted, rtol=1e-8) and np.abs(found[:-4]).max() < 1e-6 * wanted


def test_a_ball_at_rest(tmp_path: Path) -> None:
    """On a floor it may roll; on a slope no rest is found, but where it resists rolling it is held."""
    ball = ball_of(0.2, (0.0, 0.0, 0.2), mass=1.3) + contact('body = "ball", sphere = 0.2', FLOOR, friction=0.3)
    rest = loaded(head() + ball, tmp_path).equilibrium()
    assert rest.stability == "indifferent" and rest.multipliers["touch.normal"] == pytest.approx(-1.3 * G, rel=1e-12)
    assert "friction holds other positions too" in " ".join(rest.notes)
    with pytest.raises(AnalysisError, match="no equilibrium"):
        loaded(head((1.0, 0.0, -9.0)) + ball, tmp_path).equilibrium()
    held = loaded(head((0.1, 0.0, -G)) + ball + "rolling = 0.02\ntorsion = 0.01\n", tmp_path)
    assert held.equilibrium().multipliers["touch.rolling2"] == pytest.approx(1.3 * 0.1 * 0.2, rel=1e-9)
    assert held.linearise().states and not held.modes().eigenvalues.any()


def test_a_ball_that_slides_has_no_analysis(tmp_path: Path) -> None:
    model = loaded(slider(), tmp_path)
    with pytest.raises(InputError, match="closed contacts at rest, got touch, which slides at"):
        model.modes(at="start")
    with pytest.raises(
        InputError, match="inverse dynamics: expected a mechanism without friction of contacts in space"
    ):
        model.inverse()
