"""Linkages for three positions, beside perpendicular bisectors of their pins' places, and for a straight path."""

import json
import math
import subprocess
import sys
import tomllib

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.study.synthesis.synthesizing import synthesize
from symgen.study.synthesis.tasks import read_task

ROOM = 1.5


def drawn_positions(number):
    """Return three positions of a body."""
    rng = np.random.default_rng(number)
    x, y = np.cumsum(rng.uniform(0.3, 1.0, 3)), rng.uniform(0.0, 1.0, 3)
    return {"x": x, "y": y, "angle": np.cumsum(rng.uniform(0.2, 0.6, 3))}


def centre(points):
    """Return where the perpendicular bisectors of the ways from the first of three points to the others meet."""
    a, *others = points
    rows = np.array([b - a for b in others])
    return np.linalg.solve(rows, [0.5 * (b @ b - a @ a) for b in others])


def places_of(pin, task):
    """Return the places of a pin of the body in three positions, from the one in the first."""
    tips = np.column_stack([task["x"], task["y"]])
    for tip, angle in zip(tips, task["angle"] - task["angle"][0], strict=True):
        c, s = math.cos(angle), math.sin(angle)
        yield tip + np.array([[c, -s], [s, c]]) @ (np.array(pin) - tips[0])


def passed(text, turn, task, folder):
    """Return how near a run of a file comes to three positions when its crank has turned to each of them."""
    file = folder / "linkage.toml"
    file.write_text(text, encoding="utf-8")
    motion = symgen.load(file).kinematics(np.array([0.0, *turn, 1.0]))
    tips = np.column_stack([motion["coupler.P.x"], motion["coupler.P.y"]])
    off = np.linalg.norm(tips - np.column_stack([task["x"], task["y"]]), axis=1)
    return max(off.max(), np.abs(motion["coupler.theta"] - task["angle"]).max())


@pytest.mark.slow
@pytest.mark.parametrize("number", range(20))
def test_linkages_pass_three_positions_by_pins_on_circles(number, tmp_path):
    task = drawn_positions(number)
    found = synthesize(task, starts=2)
    assert found.ok, found.reason
    angles = [each.transmission for each in found.linkages]
    assert angles == sorted(angles, reverse=True) and angles[-1] >= math.radians(30.0) - 1e-6
    for each in found.linkages:
        pins = each.pins
        for pin, pivot in ((pins.crank_pin, pins.crank_pivot), (pins.rocker_pin, pins.rocker_pivot)):
            assert centre([*places_of(pin, task)]) == pytest.approx(np.array(pivot), abs=1e-7)
        way = np.array([*places_of(pins.crank_pin, task)]) - pins.crank_pivot
        around = np.unwrap(np.arctan2(way[:, 1], way[:, 0])) - math.atan2(way[0, 1], way[0, 0])
        around += 2.0 * math.pi * np.round((each.turn - around[2]) / (2.0 * math.pi)) * (np.arange(3) == 2)
        second = around[1] if 0.0 < around[1] / each.turn < 1.0 else around[1] + math.copysign(2.0 * math.pi, each.turn)
        assert around[2] == pytest.approx(each.turn, abs=1e-9)
        assert passed(each.text, [second / each.turn], task, tmp_path) < 1e-8


@pytest.mark.slow
def test_a_straight_path_is_met_better_than_by_hoekens_linkage():
    # proportions for half a turn: ground 2.2, coupler and rocker 2.8 and the tip at twice that, crank 1
    alpha = np.linspace(0.5 * math.pi, 1.5 * math.pi, 361)
    pin = np.exp(1j * alpha)
    to = 2.2 - pin
    height = np.sqrt(2.8**2 - 0.25 * np.abs(to) ** 2)
    tips = pin + 2.0 * (0.5 * to + 1j * height * to / np.abs(to))
    straight = float(np.ptp(tips.imag) / np.ptp(tips.real))
    assert straight == pytest.approx(0.00096, rel=0.01)  # published: 0.096 % of its length
    path = {"x": np.linspace(0.0, 1.0, 9), "y": np.zeros(9)}
    found = synthesize(path, starts=4)
    assert found.ok and found.linkages[0].deviation < 0.5 * straight
    assert all(each.transmission >= math.radians(30.0) - 1e-6 for each in found.linkages)


@pytest.mark.slow
def test_the_command_writes_the_linkage_that_is_taken(tmp_path):
    file, out = tmp_path / "positions.csv", tmp_path / "linkage.toml"
    file.write_text("x [mm],y [mm],angle [deg]\n0,0,0\n1000,400,30\n1600,200,65\n", encoding="utf-8")
    words = ["synthesize", str(file), "--starts", "1", "--json", "-o", str(out)]
    said = subprocess.run([sys.executable, "-m", "symgen", *words], capture_output=True, text=True, check=False)
    assert said.returncode == 0, said.stderr
    first = json.loads(said.stdout)["linkages"][0]
    assert out.read_text(encoding="utf-8") == first["text"] and first["deviation"] < 1e-9
    assert symgen.load(out).simulate().ok


@pytest.mark.parametrize(
    ("task", "sentence"),
    [
        ({"x": [0, 1, 2], "z": [0, 1, 2]}, "expected the columns x and y, and angle for positions, got 'z'"),
        ({"x": [0, 1], "y": [0, 1]}, "expected 3 to 20 points, got 2"),
        ({"x": [0, 1, 2, 3], "y": [0, 1, 0, 1], "angle": [0, 1, 2, 3]}, "three positions, or a path without angles"),
        ({"x": [0, 0, 1], "y": [0, 0, 1]}, "expected places that differ from row to row, got rows 1 and 2"),
        ({"x": [0, 1, 2], "y": [0, 1, float("nan")]}, "expected finite numbers"),
        ({"x": [0, 1, 2], "y": [0, 1]}, "expected columns of one length, got 2 and 3 numbers"),
        ({"x": [1, 1, 1], "y": [0, 0, 0], "angle": [0, 1, 2]}, "expected places that differ, got one place"),
        ({"x [kg]": [0, 1, 2], "y": [0, 1, 0]}, "kg"),
        (3, "expected a CSV file, or columns x, y and angle"),
    ],
)
def test_tasks_that_are_refused(task, sentence):
    with pytest.raises(InputError, match=sentence.replace("(", r"\(")):
        read_task(task)


def test_a_linkage_in_a_file_that_has_its_names_keeps_what_is_there(tmp_path):
    task = {"x": [0.0, 0.4, 0.8], "y": [0.0, 0.2, 0.2], "angle": [0.0, 0.4, 0.8]}
    first = synthesize(task, starts=1).linkages[0]
    once = first.add_to_text('[mechanism]\nname = "two"\n\n[run]\nuntil = 2.0\n')
    twice = first.add_to_text(once)
    names = set(tomllib.loads(twice)["bodies"])
    assert names == {"crank", "coupler", "rocker", "crank1", "coupler1", "rocker1"}
    assert set(once.splitlines()) <= set(twice.splitlines())
    file = tmp_path / "two.toml"
    file.write_text(twice, encoding="utf-8")
    assert first.kind not in ("crank-rocker", "double-crank")  # so that it swings: back after two seconds
    motion = symgen.load(file).kinematics([0.0, 1.0, 2.0])
    for name in ("coupler", "coupler1"):
        tips = np.column_stack([motion[f"{name}.P.x"], motion[f"{name}.P.y"]])
        assert tips == pytest.approx(np.array([[0.0, 0.0], [0.8, 0.2], [0.0, 0.0]]), abs=1e-8)


def hoeken(angles):
    """Return tips of Hoeken's linkage: crank 1 on a ground of 2.2, coupler and rocker 2.8, the tip at twice that."""
    pin = np.exp(1j * angles)
    to = 2.2 - pin
    height = np.sqrt(2.8**2 - 0.25 * np.abs(to) ** 2)
    return pin + 2.0 * (0.5 * to + 1j * height * to / np.abs(to))


@pytest.mark.slow
def test_the_curve_of_a_known_linkage_gives_that_linkage_or_its_cognate():
    """Points of a whole turn of Hoeken's curve have an optimum of 0: its own pins, and those of Roberts' cognates."""
    tips = hoeken(np.linspace(0.0, 2.0 * math.pi, 13))
    tips[-1] = tips[0]
    found = synthesize({"x": tips.real, "y": tips.imag}, transmission=math.radians(20.0))
    assert found.ok and found.linkages[0].deviation < 1e-9
    exact = [each for each in found.linkages if each.deviation < 1e-9]
    own = [each.pins for each in exact if np.hypot(*each.pins.crank_pivot) < 1e-6]
    assert own, [each.pins for each in found.linkages]
    assert own[0].rocker_pivot == pytest.approx((2.2, 0.0), abs=1e-6)
    assert math.dist(own[0].crank_pivot, own[0].crank_pin) == pytest.approx(1.0, abs=1e-6)
    assert math.dist(own[0].rocker_pin, own[0].rocker_pivot) == pytest.approx(2.8, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("turned", [1.0, 0.75])
@pytest.mark.parametrize("flat", [0.5, 0.8])
def test_an_ellipse_is_met_by_linkages_that_keep_the_transmission_angle(flat, turned):
    """Where least squares fall short of the angle between the points, the search goes on with more weight on it."""
    angles = np.linspace(0.0, 2.0 * math.pi * turned, 13)
    x, y = 0.4 * np.cos(angles), 0.4 * flat * np.sin(angles)
    if turned == 1.0:
        x[-1], y[-1] = x[0], y[0]
    found = synthesize({"x": x, "y": y})
    assert found.ok, found.reason
    assert found.linkages[0].deviation < 0.02 * 0.8
    assert all(each.transmission >= math.radians(30.0) - 1e-6 for each in found.linkages)
