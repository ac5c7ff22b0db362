"""Efforts beside contacts and friction that holds: closed forms of the least, and of the range, over a parameter."""

import math
from functools import cache

import numpy as np
import pytest
from scipy.optimize import linprog
from support.rotation import of_turn

import symgen
from symgen.analyses.efforts.least_efforts import Limits, efforts_within_limits
from symgen.analyses.prescribed.driven_motion import Kinematics
from symgen.api import Model
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

G = 9.81


def written(text: str, name: str) -> Model:
    """Return the model of a file's text."""
    return symgen.load(validate(parse_toml(text, name), name))


BOX = f'[mechanism]\nname = "box"\ngravity = [0.0, -{G}]\n[run]\nuntil = 1.0\n'
BOX += "[parameters]\npull = 0.0\n[inputs]\ndrive = 0.0\n"
BOX += "[bodies.box]\nmass = 2.0\ninertia = 0.05\nposition = [0.0, 0.1]\n"
BOX += '[forces.load]\ntype = "force"\nbody = "box"\nforce = ["pull", 0.0]\nat = [0.0, -0.1]\n'
BOX += '[forces.push]\ntype = "force"\nbody = "box"\nforce = ["drive", 0.0]\nat = [0.0, -0.1]\n'


@cache
def box() -> Model:
    """A box on two feet that a load pulls, and a drive at the floor."""
    feet = ""
    for name, x in (("left", -0.3), ("right", 0.2)):
        shapes = f'[{{ body = "box", at = [{x}, -0.1] }}, {{ line = "ground" }}]'
        feet += f"[contacts.{name}]\nbetween = {shapes}\nfriction = {{ sliding = 0.3, static = 0.4 }}\n"
    return written(BOX + feet, "box.toml")


@cache
def still_box() -> Model:
    """The same at rest, by a joint."""
    return written(
        BOX + '[joints.weld]\ntype = "rigid"\nbetween = ["ground", "box"]\nat = [[0.0, 0.1], "centre"]\n', "still.toml"
    )


def check_box(pull: float) -> None:
    """Friction takes up to 0.4 m g of the pull; the drive has the rest, and may have as much more to both sides."""
    motion = still_box().simulate(times=(0.0, 1.0), until=1.0, method="lagrange", integrator="rk4", step=0.5)
    found = box().inverse(motion, actuators=["drive"], parameters={"pull": pull})
    bound = 0.4 * 2.0 * G
    least = -math.copysign(max(abs(pull) - bound, 0.0), pull)
    np.testing.assert_allclose(found.efforts["drive"], least, rtol=0.0, atol=1e-9 * bound)
    np.testing.assert_allclose(found.lowest["drive"], -pull - bound, rtol=1e-9)
    np.testing.assert_allclose(found.highest["drive"], -pull + bound, rtol=1e-9)
    assert found.missing.max() < 1e-9
    assert any(note.startswith("friction of left is at rest at 2 times: efforts are the least") for note in found.notes)


@pytest.mark.parametrize("pull", [-3.0, 12.0])
def test_friction_of_a_box_takes_what_it_can(pull: float) -> None:
    check_box(pull)


@pytest.mark.slow
def test_pulls_of_300_sizes() -> None:
    for pull in of_turn(np.linspace(-20.0, 20.0, 300), 3, "pulls"):
        check_box(float(pull))


def test_a_box_that_slides_has_the_friction_of_motion() -> None:
    """It starts from rest by its acceleration: m a + 0.3 m g along the way; feet share the weight by moments."""
    driven = BOX + '[joints.rail]\ntype = "translational"\nbetween = ["ground", "box"]\nat = [[0.0, 0.1], "centre"]\n'
    driven += 'axis = [1.0, 0.0]\n[joints.motor]\ntype = "driver"\njoint = "rail"\nvalue = "0.2*t**2"\n'
    motion = written(driven, "driven.toml").kinematics(times=np.linspace(0.0, 1.0, 5))
    found = box().inverse(motion, actuators=["drive"])
    np.testing.assert_allclose(found.efforts["drive"], 2.0 * 0.4 + 0.3 * 2.0 * G, rtol=1e-9)
    np.testing.assert_allclose(found.highest["drive"], found.lowest["drive"], rtol=1e-9)
    assert found.missing.max() < 1e-9


HAND = f"""
[mechanism]
name = "hand"
gravity = [0.0, -{G}]
[parameters]
mu = 0.4
[bodies.palm]
mass = 1.0
inertia = 0.01
position = [0.0, 0.3]
[bodies.left]
mass = 0.2
inertia = 0.001
position = [-0.15, 0.0]
[bodies.right]
mass = 0.2
inertia = 0.001
position = [0.15, 0.0]
[bodies.box]
mass = 2.0
inertia = 0.01
position = [0.0, 0.0]
[joints.column]
type = "translational"
between = ["ground", "palm"]
at = [[0.0, 0.3], "centre"]
axis = [0.0, 1.0]
angle = 0.0
[joints.left_rail]
type = "translational"
between = ["palm", "left"]
at = [[-0.15, -0.3], "centre"]
axis = [1.0, 0.0]
angle = 0.0
[joints.right_rail]
type = "translational"
between = ["palm", "right"]
at = [[0.15, -0.3], "centre"]
axis = [-1.0, 0.0]
angle = 0.0
"""


@cache
def hand() -> Model:
    """A hand whose two fingers hold a box by friction at its four corners."""
    text = HAND
    for name, way in (("left", 1.0), ("right", -1.0)):
        for place, y in (("low", -0.05), ("high", 0.05)):
            shapes = f'[{{ body = "box", at = [{-0.1 * way}, {y}] }}, '
            shapes += f'{{ line = "{name}", on = [{0.05 * way}, 0.0], normal = [{way}, 0.0] }}]'
            text += f'[contacts.{name}_{place}]\nbetween = {shapes}\nfriction = "mu"\n'
    return written(text, "hand.toml")


@cache
def lifted() -> Kinematics:
    """The hand and the box as they are lifted, by drivers and a joint in place of contacts."""
    text = HAND + '[joints.lift]\ntype = "driver"\njoint = "column"\nvalue = "0.1*(1 - cos(5*t))"\n'
    for name in ("left", "right"):
        text += f'[joints.{name}_kept]\ntype = "driver"\njoint = "{name}_rail"\nvalue = 0.0\n'
    text += '[joints.weld]\ntype = "rigid"\nbetween = ["left", "box"]\nat = [[0.15, 0.0], "centre"]\n'
    return written(text, "lifted.toml").kinematics(times=np.linspace(0.0, 1.2, 7))


def check_hand(mu: float) -> None:
    """Each finger presses by m (g + a)/(2 mu) at the least; more of it does no harm."""
    motion = lifted()
    found = hand().inverse(motion, actuators=["column", "left_rail", "right_rail"], parameters={"mu": mu})
    upwards = G + 2.5 * np.cos(5.0 * motion.t)
    for name in ("left_rail", "right_rail"):
        np.testing.assert_allclose(found.efforts[name], 2.0 * upwards / (2.0 * mu), rtol=1e-8)
        np.testing.assert_allclose(found.lowest[name], 2.0 * upwards / (2.0 * mu), rtol=1e-8)
        assert np.all(np.isinf(found.highest[name]))
    np.testing.assert_allclose(found.efforts["column"], 3.4 * upwards, rtol=1e-8)
    assert found.missing.max() < 1e-8


def test_a_hand_presses_as_little_as_friction_allows() -> None:
    check_hand(0.4)


@pytest.mark.slow
def test_hands_of_300_coefficients() -> None:
    for mu in of_turn(np.linspace(0.1, 1.2, 300), 3, "hands"):
        check_hand(float(mu))


def test_least_efforts_and_ranges_are_those_of_linear_programmes() -> None:
    """Drawn problems: no cost is below, no limit is passed, and ranges are those of programmes of all unknowns."""
    draws = np.random.default_rng(5)
    for _ in range(60):
        d, n, m = draws.integers(1, 4), draws.integers(1, 3), draws.integers(1, 4)
        effects, by_forces = draws.standard_normal((d, n)), draws.standard_normal((d, m))
        width = np.where(draws.random(m) < 0.5, np.inf, draws.uniform(0.5, 2.0, m))
        inside = np.minimum(draws.uniform(0.0, 1.0, m), width)
        goal = effects @ draws.standard_normal(n) + by_forces @ inside
        weights = draws.uniform(0.5, 2.0, n)
        x = efforts_within_limits(effects, by_forces, goal, weights, Limits(np.eye(m), np.zeros(m), width))
        assert x.missing < 1e-9 and np.all(x.forces > -1e-8) and np.all(x.forces < width + 1e-8)
        limits = [(None, None)] * n + [(0.0, w if np.isfinite(w) else None) for w in width]
        whole = np.hstack([effects, by_forces])
        for i in range(n):
            for way, end in ((1.0, x.lowest[i]), (-1.0, x.highest[i])):
                found = linprog(way * np.eye(n + m)[i], A_eq=whole, b_eq=goal, bounds=limits)
                assert (found.status == 3) == (not np.isfinite(end))
                assert found.status == 3 or abs(way * found.fun - end) < 1e-6
        # towards any other point within limits the cost does not fall
        other = linprog(
            draws.standard_normal(n + m),
            A_eq=whole,
            b_eq=goal,
            bounds=[(a, b or 5.0) if a == 0.0 else (-9, 9) for a, b in limits],
        )
        if other.status == 0:
            slope = 2.0 * (weights**2 * x.efforts) @ (other.x[:n] - x.efforts)
            assert slope > -1e-5
