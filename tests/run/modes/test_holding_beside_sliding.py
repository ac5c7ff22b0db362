"""A joint at rest holds beside another one that slides on: it is judged by forces that are there."""

import math
from pathlib import Path

import numpy as np
import pytest

from tests.result.targets.test_c_modes import loaded

#: Sliding force of the floor, static and sliding force between the blocks and wind on the upper one [N]; the stiffness.
FLOOR, TOP, WIND, STIFFNESS = 2.0, (2.5, 1.5), 5.9, 100.0
#: Where both blocks turn round, and the time of a run after that [s], in which the upper block needs at most 2.2 N.
TURN, AFTER = 0.041, 0.07
G = 9.81


def slide(name: str, on: str, body: str, height: float, static: float, sliding: float) -> str:
    """Return a joint along x with dry friction."""
    text = f'[joints.{name}]\ntype = "translational"\nbetween = ["{on}", "{body}"]\nat = [[0.0, {height}], "centre"]\n'
    return text + f"axis = [1.0, 0.0]\nfriction = {{ static = {static!r}, sliding = {sliding!r} }}\n"


def touch(name: str, on: str, body: str, place: float, weight: float, static: float, sliding: float) -> str:
    """Return the contact of a block that does not turn, with the same friction."""
    text = (
        f'[contacts.{name}]\nbetween = [{{ body = "{body}", disc = 0.1 }}, {{ line = "{on}", on = [0.0, {place}] }}]\n'
    )
    text += f"friction = {{ static = {static / weight!r}, sliding = {sliding / weight!r} }}\n"
    return text + f'[joints.up_{body}]\ntype = "orientation"\nbetween = ["ground", "{body}"]\n'


def blocks(static: float, touching: str, moving: bool) -> str:
    """Return a block on a floor with a spring, and another one on top of it; in motion, or where they turn round."""
    x, v = (0.0, rate_at_zero()) if moving else (TURN, 0.0)
    text = f'[mechanism]\nname = "block-on-block"\ngravity = [0.0, {-G}]\n'
    text += f"[run]\nuntil = {time_of_turn(moving) + AFTER!r}\n"
    for name, y in (("a", 0.0), ("b", 0.2)):
        text += f"[bodies.{name}]\nmass = 1.0\ninertia = 0.1\nposition = [{x!r}, {y}]\nvelocity = [{v!r}, 0.0]\n"
    floor, top = (static, FLOOR), TOP
    text += (
        touch("floor", "ground", "a", -0.1, 2.0 * G, *floor)
        if "a" in touching
        else slide("floor", "ground", "a", 0.0, *floor)
    )
    text += touch("top", "a", "b", 0.1, G, *top) if "b" in touching else slide("top", "a", "b", 0.2, *top)
    text += f'[forces.spring]\ntype = "force"\nbody = "a"\nforce = ["-{STIFFNESS}*a.x", 0.0]\n'
    return text + f'[forces.wind]\ntype = "force"\nbody = "b"\nforce = [-{WIND}, 0.0]\n'


def rate_at_zero() -> float:
    """Return the rate at x = 0 of two blocks that turn round at `TURN`."""
    rest = -(WIND + FLOOR) / STIFFNESS
    return math.sqrt(STIFFNESS / 2.0) * math.sqrt((TURN - rest) ** 2 - rest**2)


def time_of_turn(moving: bool) -> float:
    """Return when both turn round [s]."""
    rest = -(WIND + FLOOR) / STIFFNESS
    return math.acos(-rest / (TURN - rest)) / math.sqrt(STIFFNESS / 2.0) if moving else 0.0


def place_at_end() -> float:
    """Return where both are at the end: one mass on a spring, whose friction has changed sides at the turn."""
    rest = -(WIND - FLOOR) / STIFFNESS
    return rest + (TURN - rest) * math.cos(math.sqrt(STIFFNESS / 2.0) * AFTER)


@pytest.mark.parametrize("touching", ["", "a", "b", "ab"])
def test_what_is_held_stays_held_where_another_slides_on(touching: str, tmp_path: Path) -> None:
    """The upper block needs 1.9 N after the turn; beside the static force of the floor it would need up to 3.9 N."""
    for moving in (True, False):
        for static in (2.5, 3.5, 5.5):
            result = loaded(blocks(static, touching, moving), tmp_path).simulate(verify=False)
            assert np.max(np.abs(result["b.x"] - result["a.x"])) < 1e-12
            assert result["a.x"][-1] == pytest.approx(place_at_end(), abs=1e-10)
            assert [event.name for event in result.events] == ["floor.reverse"] * moving


@pytest.mark.slow
def test_rows_of_a_sweep_hold_as_single_runs_do(tmp_path: Path) -> None:
    text = (
        blocks(3.5, "", True)
        .replace("static = 3.5", 'static = "bound"')
        .replace("[run]", "[parameters]\nbound = 3.5\n[run]")
    )
    values = np.linspace(2.0, 6.0, 100)
    swept = loaded(text, tmp_path).sweep(vary={"bound": values}, quantities=("a.x", "b.x")).to_dataframe()
    assert (swept["status"] == "ok").all()
    assert np.max(np.abs(swept["b.x"] - swept["a.x"])) < 1e-12
    assert np.max(np.abs(swept["a.x"] - place_at_end())) < 1e-10


def test_a_load_beyond_the_static_bound_breaks_it_loose_all_the_same(tmp_path: Path) -> None:
    """With more wind the upper block needs more than it can hold beside the floor that slides: both move."""
    text = blocks(3.5, "", False).replace(f"force = [-{WIND}", "force = [-8.0")
    result = loaded(text, tmp_path).simulate(until=0.05, verify=False)
    lower, upper = -STIFFNESS * TURN + FLOOR - TOP[1], -8.0 + TOP[1]
    assert upper < lower - 1e-3
    assert result["b.x"][0] == result["a.x"][0]
    assert result["b.vx"][-1] == pytest.approx(upper * 0.05, rel=1e-10)
