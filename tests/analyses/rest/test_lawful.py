"""Rests that obey the laws of stops, contacts and dry friction, beside closed forms over a parameter."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from support.rotation import of_turn

import symgen
from symgen.api import Model
from symgen.base.errors import AnalysisError
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

G = 9.81


def written(text: str, name: str) -> Model:
    """Return the model of a file's text."""
    return symgen.load(validate(parse_toml(text, name), name))


def head(name: str, parameters: str, gravity: str = f"[0.0, -{G}]") -> str:
    """Return the head of a file."""
    return f'[mechanism]\nname = "{name}"\ngravity = {gravity}\n[parameters]\n{parameters}'


LENGTH, MASS, ANGLE, WALL = 4.0, 10.0, 0.9, 0.3


@cache
def ladder() -> Model:
    """A ladder on a floor, against a wall; the coefficient at the floor is a parameter."""
    x, y = -0.5 * LENGTH * math.cos(ANGLE), 0.5 * LENGTH * math.sin(ANGLE)
    text = head("ladder", "mu = 0.4\n")
    text += f"[bodies.ladder]\nmass = {MASS}\ninertia = {MASS * LENGTH**2 / 12.0}\n"
    text += f"position = [{x!r}, {y!r}]\nangle = {ANGLE}\n"
    for name, end, friction, surface in (
        ("floor", -1.0, '"mu"', '{ line = "ground" }'),
        ("wall", 1.0, str(WALL), '{ line = "ground", on = [0.0, 0.0], normal = [-1.0, 0.0] }'),
    ):
        shapes = f'[{{ body = "ladder", at = [{end * 0.5 * LENGTH}, 0.0] }}, {surface}]'
        text += f"[contacts.{name}]\nbetween = {shapes}\nfriction = {friction}\n"
    return written(text, "ladder.toml")


def holding_coefficient() -> float:
    """Return the coefficient at the floor that just holds the ladder, with the wall at its own bound."""
    normal = MASS * G / 2.0 / (math.tan(ANGLE) + WALL)  # of the wall, by moments about the foot
    return normal / (MASS * G - WALL * normal)


def held_at_its_place(model: Model, name: str, place: float, **settings: Any) -> dict[str, float] | None:
    """Return the multipliers of the rest at a place, None if the rest is elsewhere or there is none."""
    try:
        rest = model.equilibrium(**settings)
    except AnalysisError:
        return None
    return rest.multipliers if abs(rest.q[name] - place) < 1e-9 else None


def check_ladder(mu: float, forces: dict[str, float] | None) -> None:
    """Compare with the closed form, and forces with the balance and their cones."""
    assert (forces is not None) == (mu >= holding_coefficient())
    if forces is None:
        return
    up, along, push, rise = (-forces[f"{name}.{way}"] for name in ("floor", "wall") for way in ("normal", "tangent"))
    np.testing.assert_allclose([up + abs(rise), push, abs(along)], [MASS * G, abs(along), push], rtol=1e-9)
    lever = 0.5 * math.cos(ANGLE), math.sin(ANGLE), math.cos(ANGLE)
    np.testing.assert_allclose(push * lever[1] + abs(rise) * lever[2], MASS * G * lever[0], rtol=1e-9)
    assert abs(along) <= mu * up * (1.0 + 1e-8) and abs(rise) <= WALL * push * (1.0 + 1e-8)


@pytest.mark.parametrize("part", [1.0 - 1e-6, 1.0 + 1e-6])
def test_a_ladder_stands_as_long_as_friction_can_hold_it(part: float) -> None:
    """Four forces and three equations: some of them obey both cones, though the smallest ones do not."""
    mu = part * holding_coefficient()
    check_ladder(mu, held_at_its_place(ladder(), "ladder.theta", ANGLE, parameters={"mu": mu}))


@pytest.mark.slow
def test_ladders_of_300_coefficients() -> None:
    for mu in of_turn(np.linspace(0.4, 0.9, 300), 3, "ladders"):
        check_ladder(mu, held_at_its_place(ladder(), "ladder.theta", ANGLE, parameters={"mu": float(mu)}))


def test_the_rest_that_friction_holds_is_one_of_a_set_and_another_one_says_why() -> None:
    sentence = "friction holds other positions too: this is one of a set of equilibria"
    assert sentence in ladder().equilibrium(parameters={"mu": 0.6}).notes
    elsewhere = ladder().equilibrium(parameters={"mu": 0.1}).notes
    assert sentence not in elsewhere
    assert any(note.startswith("another rest than with rows as at the start, where friction at") for note in elsewhere)


@cache
def block() -> Model:
    """A block on two feet on a slope."""
    text = head("block", "mu = 0.4\nslope = 0.3\n", f'["{G}*sin(slope)", "-{G}*cos(slope)"]')
    text += "[bodies.block]\nmass = 2.0\ninertia = 0.05\nposition = [0.0, 0.1]\n"
    for name, x in (("left", -0.3), ("right", 0.2)):
        shapes = f'[{{ body = "block", at = [{x}, -0.1] }}, {{ line = "ground" }}]'
        text += f'[contacts.{name}]\nbetween = {shapes}\nfriction = "mu"\n'
    return written(text, "block.toml")


@pytest.mark.slow
def test_blocks_on_300_slopes() -> None:
    for slope in of_turn(np.linspace(0.01, 0.4, 300), 3, "blocks"):
        forces = held_at_its_place(block(), "block.x", 0.0, parameters={"slope": float(slope)})
        assert (forces is not None) == (math.tan(slope) <= 0.4)
        if forces is not None:
            parts = [-forces[f"{name}.normal"] for name in ("left", "right")]
            assert math.isclose(sum(parts), 2.0 * G * math.cos(slope), rel_tol=1e-10)
            assert math.isclose(
                -forces["left.tangent"] - forces["right.tangent"], -2.0 * G * math.sin(slope), rel_tol=1e-10
            )


STIFFNESS, STOP = 800.0, 0.25


@cache
def press() -> Model:
    """A ram that a force drives against a spring, and against a stop, with dry friction in its slide."""
    text = head("press", "force = 100.0\nfriction = 10.0\n", "[0.0, 0.0]")
    text += '[bodies.ram]\nmass = 3.0\ninertia = 0.1\nposition = [0.0, 0.0]\n[joints.rail]\ntype = "translational"\n'
    text += 'between = ["ground", "ram"]\nat = [[0.0, 0.0], "centre"]\naxis = [1.0, 0.0]\n'
    text += f'friction = {{ sliding = "friction" }}\nstop = {{ upper = {STOP} }}\n'
    text += f'[forces.drive]\ntype = "force"\nbody = "ram"\nforce = ["force - {STIFFNESS}*ram.x", 0.0]\n'
    return written(text, "press.toml")


def check_press(force: float, coordinates: str) -> None:
    """The stop takes what the spring leaves at it; short of it the spring does."""
    rest = press().equilibrium(parameters={"force": force}, coordinates=coordinates)
    at = min(force / STIFFNESS, STOP)
    assert rest.q["ram.x"] == pytest.approx(at, abs=1e-12)
    if force > STIFFNESS * STOP:
        assert rest.multipliers["rail.upper.stop"] == pytest.approx(STIFFNESS * STOP - force, rel=1e-9)
        assert any("in the rest that was found: rail.upper closed" in note for note in rest.notes)
    else:
        low, high = rest.band["rail.displacement"]
        assert low == pytest.approx((force - 10.0) / STIFFNESS, abs=1e-9)
        assert high == pytest.approx(min((force + 10.0) / STIFFNESS, STOP), abs=1e-9)


@pytest.mark.parametrize("force", [150.0, 250.0])
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_press_comes_to_rest_at_its_stop(force: float, coordinates: str) -> None:
    check_press(force, coordinates)


@pytest.mark.slow
def test_presses_of_300_forces() -> None:
    for force in of_turn(np.linspace(20.0, 400.0, 300), 3, "presses"):
        check_press(float(force), "absolute")


@cache
def gripper() -> Model:
    """Two fingers that springs press on the sides of a box; each side touches with two corners."""
    text = head("gripper", "mu = 0.4\npush = 30.0\n")
    text += "[bodies.box]\nmass = 2.0\ninertia = 0.01\nposition = [0.0, 0.0]\n"
    for name, way in (("left", 1.0), ("right", -1.0)):
        text += f"[bodies.{name}]\nmass = 0.5\ninertia = 0.01\nposition = [{-0.2 * way}, 0.0]\n"
        text += f'[joints.{name}_rail]\ntype = "translational"\nbetween = ["ground", "{name}"]\n'
        text += (
            f'at = [[0.0, 0.0], "centre"]\naxis = [1.0, 0.0]\n[forces.{name}_push]\ntype = "force"\nbody = "{name}"\n'
        )
        text += f'force = ["{way}*(push - 500.0*({name}.x + {0.2 * way})*{way})", 0.0]\n'
        for place, y in (("low", -0.04), ("high", 0.05)):
            shapes = f'[{{ body = "box", at = [{-0.1 * way}, {y}] }}, '
            shapes += f'{{ line = "{name}", on = [{0.1 * way}, 0.0], normal = [{way}, 0.0] }}]'
            text += f'[contacts.{name}_{place}]\nbetween = {shapes}\nfriction = "mu"\n'
    return written(text, "gripper.toml")


def check_gripper(push: float) -> None:
    """Friction at both sides carries the weight: 2 mu push = m g at the least."""
    forces = held_at_its_place(gripper(), "box.y", 0.0, parameters={"push": push})
    assert (forces is not None) == (2.0 * 0.4 * push >= 2.0 * G)
    if forces is None:
        return
    for side in ("left", "right"):
        own = [(forces[f"{side}_{x}.normal"], forces[f"{side}_{x}.tangent"]) for x in ("low", "high")]
        assert sum(normal for normal, _ in own) == pytest.approx(-push, rel=1e-9)
        assert all(abs(along) <= -0.4 * normal + 1e-7 for normal, along in own)


@pytest.mark.parametrize("part", [1.0 - 1e-6, 1.0 + 1e-6])
def test_a_gripper_holds_a_box_as_long_as_it_presses(part: float) -> None:
    check_gripper(part * 2.0 * G / 0.8)


@pytest.mark.slow
def test_grippers_of_300_pushes() -> None:
    for push in of_turn(np.linspace(23.0, 60.0, 300), 3, "grippers"):
        check_gripper(float(push))


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("slope", [0.2, 0.4])
def test_dry_friction_alone_holds_a_start(slope: float, coordinates: str) -> None:
    """A block on a rail that slopes has no rest without friction: with enough of it, any place is one."""
    text = head("block", f"slope = {slope}\n")
    text += '[bodies.block]\nmass = 2.0\ninertia = 0.1\nposition = [0.7, 0.0]\n[joints.rail]\ntype = "translational"\n'
    text += 'between = ["ground", "block"]\nat = [[0.7, 0.0], "centre"]\naxis = ["cos(slope)", "sin(slope)"]\n'
    text += f"friction = {{ sliding = {2.0 * G * math.sin(0.3)!r} }}\n"
    model = written(text, "rail.toml")
    if slope > 0.3:
        with pytest.raises(AnalysisError, match="no equilibrium was found from this start"):
            model.equilibrium(coordinates=coordinates)
        return
    rest = model.equilibrium(coordinates=coordinates)
    assert rest.q["block.x"] == pytest.approx(0.7, abs=1e-12)
    held = [value for name, value in rest.multipliers.items() if "held" in name]
    assert [abs(x) for x in held] == pytest.approx([2.0 * G * math.sin(slope)], rel=1e-10)
    assert any("one of a set of equilibria" in note for note in rest.notes)
