"""Scenes of contacts whose numbers two simulations in NumPy agree on, each in bodies and in joint coordinates."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.run.contacts.scenes import LIGHT, body, floor, head, loaded, rods
from tests.run.contacts.test_contacts import WAYS

pytestmark = pytest.mark.slow
ways = pytest.mark.parametrize(("integrator", "coordinates"), WAYS, ids=["-".join(way) for way in WAYS])


def run_of(text: str, folder: Path, until: float, integrator: str, coordinates: str, **keys: Any) -> Any:
    """Return a run with tight tolerances."""
    settings = {"rtol": 1e-12, "atol": 1e-13, "verify": False, "integrator": integrator, "coordinates": coordinates}
    return loaded(text, folder).simulate(until=until, **settings | keys)


def transitions_of(run: Any, count: int) -> list[tuple[str, float]]:
    """Return names and times of the first events."""
    return [(event.name, event.t) for event in run.events[:count]]


def assert_transitions(run: Any, expected: list[tuple[str, float]], most: float) -> None:
    found = transitions_of(run, len(expected))
    assert [name for name, _ in found] == [name for name, _ in expected]
    np.testing.assert_allclose([t for _, t in found], [t for _, t in expected], rtol=0.0, atol=most)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_rods_strike_a_floor(coordinates: str, tmp_path: Path) -> None:
    """Rates of both rods after the impact of a tip that sticks."""
    text = rods(0.45, 0.6, (1.0, 0.8), (1.0, 0.7), (25.0, 40.0, -0.3, -0.1))
    run = run_of(text, tmp_path, 1e-3, "dop853", coordinates)
    rates = [run["one.omega"][0], run["two.omega"][0]]
    np.testing.assert_allclose(rates, [-0.39595370114883477, 0.5333456050540222], rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_disc_strikes_floor_and_wall_at_once(coordinates: str, tmp_path: Path) -> None:
    text = head("corner") + body("disc", 1.0, 0.005, (0.1, 0.1), (-1.5, -2.0), 12.0) + floor("disc", 0.1, 0.3, 0.6)
    text += '[contacts.wall]\nbetween = [{ body = "disc", disc = 0.1 }, { line = "ground", normal = [1.0, 0.0] }]\n'
    run = run_of(text + "friction = 0.2\nrestitution = 0.4\n", tmp_path, 1e-3, "dop853", coordinates)
    rates = [run[f"disc.{name}"][0] for name in ("vx", "vy", "omega")]
    np.testing.assert_allclose(rates, [0.6, 1.2, 1.9148936170212778], rtol=0.0, atol=1e-13)


@ways
def test_a_pressed_block_sticks_and_slips(integrator: str, coordinates: str, tmp_path: Path) -> None:
    """A spring pulls a block that a force presses ever more and less; at rest friction is larger."""
    text = head("pressed") + "[bodies.block]\nmass = 1.5\ninertia = 0.01\n"
    text += '[joints.upright]\ntype = "rows"\nrows = [{ position = "block.theta" }]\n'
    text += '[forces.pull]\ntype = "force"\nbody = "block"\nforce = ["40*(0.1*t - block.x)", "-4*sin(3*t)"]\n'
    text += '[contacts.floor]\nbetween = [{ body = "block" }, { line = "ground" }]\n'
    text += "friction = { sliding = 0.25, static = 0.35 }\n"
    times = [1.165719849887082, 1.9316203460850319, 3.0849981345242083]
    times += [3.879192513175815, 5.166118169117274, 5.962417434863097]
    run = run_of(text, tmp_path, 6.0, integrator, coordinates)
    words = ["floor.slip", "floor.stick"] * 3
    assert_transitions(run, list(zip(words, times, strict=True)), 1e-10)
    assert abs(run["block.x"][-1] - 0.5893681710650291) < 1e-10


@ways
def test_the_tip_of_a_falling_rod_slips(integrator: str, coordinates: str, tmp_path: Path) -> None:
    """From 0.2 rad off the vertical it slips forwards, and the floor strikes both ends at last."""
    lean, lands = 0.2, 0.7368110807871634
    rod = body("rod", 1.0, 1.0 / 12.0, (0.5 * math.sin(lean), 0.5 * math.cos(lean)), angle=-lean)
    text = head("pencil") + rod
    for name, y, rest in (("tip", -0.5, "friction = 0.45\n"), ("top", 0.5, "")):
        text += f'[contacts.{name}]\nbetween = [{{ body = "rod", at = [0.0, {y}] }}, {{ line = "ground" }}]\n{rest}'
    run = run_of(text, tmp_path, 0.75, integrator, coordinates)
    assert_transitions(run, [("tip.slip", 0.5811071480893494), ("tip.hit", lands), ("top.hit", lands)], 1e-10)
    slips = run.events[0]
    assert abs(-slips.q["rod.theta"] - 0.9190687754904392) < 1e-10


@ways
def test_a_disc_rolls_off_another(integrator: str, coordinates: str, tmp_path: Path) -> None:
    start, far = 0.15, 0.5
    disc = body("disc", 1.0, 0.005, (far * math.sin(start), far * math.cos(start)))
    text = head("dome") + disc + '[contacts.dome]\nbetween = [{ body = "disc", disc = 0.1 }, '
    run = run_of(text + '{ body = "ground", disc = 0.4 }]\nfriction = 0.35\n', tmp_path, 0.75, integrator, coordinates)
    assert_transitions(run, [("dome.slip", 0.5887862075037075), ("dome.lift", 0.6978383446988979)], 1e-10)
    leaves = run.events[1]
    assert abs(math.atan2(leaves.q["disc.x"], leaves.q["disc.y"]) - 0.9306583165553616) < 1e-10


def test_a_light_slider_with_play(tmp_path: Path) -> None:
    """The simulations differ from each other by as much at each time."""
    times, known = [0.0, 0.002, 0.005, 0.01], [0.25997361068826536, 0.5510457126927509, 0.9104729629198011]
    angles = [run_of(LIGHT, tmp_path, 0.01, "dop853", c, times=times)["crank.theta"] for c in ("absolute", "joint")]
    assert np.all(np.abs(angles[0][1:] - known) < [1e-12, 4e-10, 4e-9])
    np.testing.assert_allclose(angles[0], angles[1], rtol=0.0, atol=1e-10)
