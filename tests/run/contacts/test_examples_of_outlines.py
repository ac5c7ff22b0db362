"""Examples of outlines beside formulas: a walking hexagon, a latch, a ratchet, a Geneva wheel of one outline."""

import math
from itertools import pairwise
from pathlib import Path

import pytest

from symgen import load

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


@pytest.mark.slow
def test_a_hexagon_walks_as_fast_as_a_rimless_wheel() -> None:
    """What its rate differs by falls at each landing by the square of the part of it that is kept, 0.42."""
    run = load(EXAMPLES / "walking-hexagon.toml").simulate()
    kept = (5.0 / 12.0 + 0.5) / (5.0 / 12.0 + 1.0)
    steady = float(run.outputs["steady"][-1])
    rates = [-kept * event.v["bar.omega"] for event in run.events if event.name == "feet.hit"]
    assert run.status == "ok" and len(rates) == 14
    squares = [rate**2 - steady**2 for rate in rates]
    for before, after in pairwise(squares):
        assert abs(after - kept**2 * before) < 1e-9
    assert abs(rates[-1] - steady) < 1e-5


@pytest.mark.slow
def test_a_latch_holds_its_door_against_the_seal() -> None:
    """The catch of 4 mm is at the back of the nose, 40 mm from the door: the seal is 5 mm thinner by then."""
    run = load(EXAMPLES / "latch.toml").simulate()
    assert run.status == "ok" and abs(run["door.x"][-1] + 0.056) < 1e-12 and abs(run["hook.theta"][-1]) < 1e-12
    assert abs(run["nose.force"][-1] - 900.0 * 0.005) < 1e-9


@pytest.mark.slow
def test_slots_of_one_outline_move_as_eight_walls() -> None:
    run, walls = load(EXAMPLES / "geneva-outline.toml").simulate(), load("geneva").simulate()
    assert run.status == walls.status == "ok" and len(run.events) == len(walls.events) > 40
    assert abs(run["wheel.theta"][-1] - walls["wheel.theta"][-1]) < 1e-9


@pytest.mark.slow
def test_a_ratchet_comes_to_rest_with_its_pawl_in_a_notch() -> None:
    """The roller is 4 mm from the radial face and from the chord from a root at 40 mm to the next tip at 50 mm."""
    run = load(EXAMPLES / "ratchet.toml").simulate()
    root, tip, roller = 0.04, (0.025, 0.05 * math.sin(math.pi / 3.0)), 0.004
    long = math.hypot(tip[0] - root, tip[1])
    along = root + roller * (long - root + tip[0]) / tip[1]
    assert run.status == "ok" and abs(run["pawl.y"][-1] - math.hypot(along, roller)) < 1e-9
    expected = 0.5 * math.pi - math.atan2(roller, along) - 4.0 * math.pi / 3.0  # four teeth on
    assert abs(run["wheel.theta"][-1] - expected) < 1e-9
