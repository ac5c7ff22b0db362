"""Arrows of forces and torques in turned positions: directions worked out by hand, on paper."""

import math
from typing import Any

import numpy as np
import pytest

from symgen.describe.drawing import build_scene
from symgen.describe.drawing.paper import Path, View, items_on_paper
from symgen.describe.drawing.scene import Scene
from symgen.describe.files.validate import validate

#: Turned as at the start, by a little, across, and nearly round.
ANGLES = (0.3, 0.9, 0.3 + 0.5 * math.pi, -2.6)
#: To the right on paper is y, upwards z, towards the eye x.
ASIDE = View(0.0, 0.0)


def planar(**force: Any) -> Scene:
    """Return the scene of an arm turned by 0.3 rad, pushed at its tip."""
    raw = {
        "mechanism": {"name": "arm"},
        "inputs": {"thrust": 0.0},
        "bodies": {"a": {"mass": 1.0, "inertia": 1.0, "points": {"tip": [2.0, 0.5]}, "angle": 0.3}},
        "joints": {"pin": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], "centre"]}},
        "forces": {"f": {"type": "force", "body": "a", "at": "tip", **force}},
    }
    return build_scene(validate(raw, "here"))


def spatial(pair: dict[str, Any] | None = None, driver: dict[str, Any] | None = None, **force: Any) -> Scene:
    raw = {
        "mechanism": {"name": "arm", "space": "spatial"},
        "bodies": {"a": {"mass": 1.0, "inertia": [1.0, 1.0, 1.0], "points": {"tip": [0.0, 1.0, 0.5]}}},
        "joints": ({"j": {"between": ["ground", "a"], **pair}} if pair else {}) | ({"f": driver} if driver else {}),
        "forces": {"f": force} if force else {},
    }
    return build_scene(validate(raw, "here"))


def strokes(scene: Scene, q: list[float]) -> list[np.ndarray]:
    """Return the points on paper of what is drawn of the force: a line, and a head that begins at its tip."""
    (drawn,) = (d for d in items_on_paper(scene, np.array(q), ASIDE) if d.item.name == "f")
    return [part.points for part in drawn.parts if isinstance(part, Path)]


def along(points: np.ndarray) -> np.ndarray:
    return np.asarray((points[-1] - points[0]) / np.linalg.norm(points[-1] - points[0]))


def about_x(angle: float) -> list[float]:
    return [math.cos(angle / 2), math.sin(angle / 2), 0.0, 0.0]


@pytest.mark.parametrize("angle", ANGLES)
def test_a_force_of_the_ground_keeps_its_direction(angle: float) -> None:
    line, head = strokes(planar(force=[3.0, -4.0]), [1.0, 7.0, angle])
    c, s = math.cos(angle), math.sin(angle)
    tip = [1.0 + 2.0 * c - 0.5 * s, 7.0 + 2.0 * s + 0.5 * c]
    assert line[-1] == pytest.approx(tip, abs=1e-12) and head[0] == pytest.approx(tip, abs=1e-12)
    assert along(line) == pytest.approx([0.6, -0.8], abs=1e-12)
    assert along(np.array([head[1:].mean(axis=0), head[0]])) == pytest.approx([0.6, -0.8], abs=1e-12)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize(
    ("force", "own"),
    [
        ({"force": [3.0, -4.0], "frame": "body"}, (0.6, -0.8)),
        ({"force": ["thrust", 0.0], "frame": "body"}, (1.0, 0.0)),  # nothing at the start
        ({"force": [0.0, "2*sin(t)"], "frame": "body"}, (0.0, 1.0)),
        ({"force": ["5*cos(a.theta + 0.7)", "5*sin(a.theta + 0.7)"]}, (math.cos(0.7), math.sin(0.7))),
    ],
)
def test_a_force_of_the_body_turns_with_it(force: dict[str, Any], own: tuple[float, float], angle: float) -> None:
    line, _ = strokes(planar(**force), [0.0, 0.0, angle])
    c, s = math.cos(angle), math.sin(angle)
    assert along(line) == pytest.approx([c * own[0] - s * own[1], s * own[0] + c * own[1]], abs=1e-12)


@pytest.mark.parametrize("force", [["-9*a.vx", 0.0], ["sqrt(0.2 - t)", 0.0], ["2*(1 + a.theta**2)", 0.0]])
def test_formulas_along_one_axis_of_the_ground(force: list[Any]) -> None:
    line, _ = strokes(planar(force=force), [0.0, 0.0, 2.0])
    assert along(line) == pytest.approx([1.0, 0.0], abs=1e-12)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("frame", ["ground", "body"])
def test_forces_in_space(frame: str, angle: float) -> None:
    """Turned about x, which looks towards the eye."""
    scene = spatial(type="force", body="a", at="tip", force=[0.0, 3.0, 4.0], frame=frame)
    line, _ = strokes(scene, [0.0, 2.0, 1.0, *about_x(angle)])
    c, s = math.cos(angle), math.sin(angle)
    assert line[-1] == pytest.approx([2.0 + c - 0.5 * s, 1.0 + s + 0.5 * c], abs=1e-12)
    own = (0.6, 0.8) if frame == "ground" else (0.6 * c - 0.8 * s, 0.6 * s + 0.8 * c)
    assert along(line) == pytest.approx(own, abs=1e-12)


def turning(points: np.ndarray, middle: tuple[float, float]) -> float:
    """Return in which sense a round arrow turns about a point on paper; all of it is equally far from there."""
    away = points - middle
    assert np.linalg.norm(away, axis=1) == pytest.approx(np.linalg.norm(away[0]), rel=1e-9)
    turned = away[:-1, 0] * away[1:, 1] - away[:-1, 1] * away[1:, 0]
    assert np.all(turned > 0.0) or np.all(turned < 0.0)
    return float(np.sign(turned[0]))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_torques_about_axes_of_the_ground(sign: float) -> None:
    """Seen from the tip of x, whatever the body does: no joint says anything of the axis."""
    scene = spatial(type="torque", body="a", torque=[2.0 * sign, 0.0, 0.0])
    for rotation in ([1.0, 0.0, 0.0, 0.0], [0.6, 0.0, 0.8, 0.0], [0.5, 0.5, -0.5, 0.5]):
        line, _ = strokes(scene, [5.0, 2.0, 1.0, *rotation])
        assert turning(line, (2.0, 1.0)) == sign


def test_torques_about_axes_of_the_body() -> None:
    """About body z, which a quarter turn about y lays along x."""
    scene = spatial(type="torque", body="a", torque=[0.0, 0.0, "1 + t"], frame="body")
    line, _ = strokes(scene, [5.0, 2.0, 1.0, math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0])
    assert turning(line, (2.0, 1.0)) == 1.0
    flat, _ = strokes(scene, [5.0, 2.0, 1.0, 1.0, 0.0, 0.0, 0.0])
    assert np.ptp(flat[:, 1]) < 1e-12


@pytest.mark.parametrize("kind", ["torque", "driver"])
def test_either_angle_of_a_universal_joint(kind: str) -> None:
    """The first angle is about z of the ground, the second about y of the body, turned to the opposite of x."""
    pair = {"type": "universal", "at": [[0.0, 0.0, 0.0], "centre"], "axes": [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]}
    turned = [0.0, 0.0, 0.0, math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]
    scenes = [
        spatial(pair, type="torque", joint="j", coordinate=name, torque=2.0)
        if kind == "torque"
        else spatial(pair, {"type": "driver", "joint": "j", "coordinate": name, "value": "0.1*t"})
        for name in ("angle1", "angle2")
    ]
    first, second = (strokes(scene, turned)[0] for scene in scenes)
    assert np.ptp(first[:, 1]) < 1e-12 < np.ptp(first[:, 0])
    assert turning(second, (0.0, 0.0)) == -1.0
