"""``symgen draw``, ``model.draw`` and shapes of a file."""

import json
import pickle
import tomllib
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symgen.api import load
from symgen.base.errors import AssemblyError, InputError
from symgen.cli import main
from symgen.describe.drawing import build_scene
from symgen.describe.drawing.paper import Path as Stroke
from symgen.describe.drawing.paper import View, items_on_paper, view_axes
from symgen.describe.drawing.scene import DrawnCircle, Poses, Solid
from symgen.describe.files.validate import validate

#: A four-bar whose links are too short to meet: at best each of the three open gaps is a third of what is missing.
FILE = """
[mechanism]
name = "short"
[bodies.crank]
mass = 1.0
inertia = 0.1
points = {{ b = [0.3, 0.0] }}
[bodies.coupler]
mass = 1.0
inertia = 0.1
points = {{ b = [0.6, 0.0] }}
position = [0.3, 0.1]
[bodies.rocker]
mass = 1.0
inertia = 0.1
points = {{ b = [0.4, 0.0] }}
position = [{base}, 0.0]
angle = 2.0
[joints.O]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], [0.0, 0.0]]
[joints.A]
type = "revolute"
between = ["crank", "coupler"]
at = ["b", [0.0, 0.0]]
[joints.B]
type = "revolute"
between = ["coupler", "rocker"]
at = ["b", "b"]
[joints.C]
type = "revolute"
between = ["ground", "rocker"]
at = [[{base}, 0.0], [0.0, 0.0]]
"""


def test_what_does_not_close_is_drawn_with_the_fault_marked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, picture = tmp_path / "short.toml", tmp_path / "short.svg"
    file.write_text(FILE.format(base=2.0))
    assert main(["draw", str(file), "-o", str(picture), "--json"]) == 2
    told = capsys.readouterr()
    assert "cannot be assembled" in told.err
    marked = json.loads(told.out)["open"]
    assert marked and set(marked) <= {"O", "A", "B", "C"}
    root = ET.parse(picture).getroot()
    assert {g.attrib["data-name"] for g in root.iter() if g.attrib.get("class") == "fault"} == set(marked)
    assert any("cannot be assembled" in (t.text or "") for t in root.iter())


def test_the_error_says_where_closing_stopped() -> None:
    raw = tomllib.loads(FILE.format(base=2.0))
    model = load(validate(raw, "short.toml"))
    with pytest.raises(AssemblyError) as caught:
        model.assemble(model.compile())
    error = caught.value
    assert error.joints and len(error.q) == 9
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.joints, again.q) == (str(error), error.joints, error.q)


@pytest.mark.slow_cases("pdf", "png")
@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_pictures_are_the_same_bytes_each_time(ending: str, tmp_path: Path) -> None:
    files = [tmp_path / f"{i}.{ending}" for i in range(2)]
    for file in files:
        assert main(["draw", "four-bar", "-o", str(file)]) == 0
    assert files[0].read_bytes() == files[1].read_bytes()
    assert len(files[0].read_bytes()) > 2000


def test_check_draws_on_request(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "pendulum", "--draw", str(tmp_path / "x.svg")]) == 0
    assert (tmp_path / "x.svg").read_text().startswith("<svg")
    file = tmp_path / "short.toml"
    file.write_text(FILE.format(base=3.0))
    assert main(["check", str(file), "--draw", str(tmp_path / "y.svg")]) == 2
    assert 'class="fault"' in (tmp_path / "y.svg").read_text()
    capsys.readouterr()


def test_at_a_time_it_is_where_the_run_is(tmp_path: Path) -> None:
    model = load("pendulum")
    result = model.simulate(until=0.3, times=(0.0, 0.3), step=1e-3)
    assert main(["draw", "pendulum", "--at", "0.3", "-o", str(tmp_path / "x.svg")]) == 0
    assert (tmp_path / "x.svg").read_text() == model.draw(q=result.q.values[-1]).svg


@pytest.mark.slow
def test_what_a_run_does_not_reach_is_not_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The last output that there was stood for the time asked for, the start where a run failed."""
    text = """
[mechanism]
name = "ball"
gravity = [0.0, -9.81]
[bodies.ball]
type = "point"
mass = 1.0
position = [0.0, 1.0]
"""
    stop, lost = (
        '[events.low]\nwhen = "ball.y < 0.5"\naction = "stop"\n',
        "[forces.wind]\ntype = 'force'\nbody = 'ball'\n",
    )
    lost += "force = ['sqrt(0.1 - t)', 0.0]\n"
    for words, code, told in ((stop, 2, "up to t = 0.319275 s"), (lost, 1, "the run to t = 1 s failed")):
        (tmp_path / "ball.toml").write_text(text + words)
        assert main(["draw", str(tmp_path / "ball.toml"), "--at", "1", "-o", str(tmp_path / "x.svg")]) == code
        assert told in capsys.readouterr().err
        assert not (tmp_path / "x.svg").exists()
    (tmp_path / "ball.toml").write_text(text + stop)
    assert main(["draw", str(tmp_path / "ball.toml"), "--at", "0.3", "-o", str(tmp_path / "x.svg")]) == 0


# -- shapes ------------------------------------------------------------------------------------------------------------


def shaped(shape: Any, spatial: bool = True) -> Any:
    body: dict[str, Any] = {"mass": 1.0, "inertia": [1.0, 1.0, 1.0] if spatial else 1.0, "shape": shape}
    body["centre_of_mass"] = [0.5, 0.0, 0.0] if spatial else [0.5, 0.0]
    head = {"name": "shaped", "space": "spatial" if spatial else "planar"}
    return validate({"mechanism": head, "parameters": {"r": 0.25}, "bodies": {"b": body}}, "f")


def test_a_box_and_a_sphere_are_where_the_file_has_them() -> None:
    shapes = [{"type": "box", "size": [2.0, 0.4, "2*r"]}, {"type": "sphere", "radius": "r", "at": [0.0, 1.0, 0.0]}]
    mechanism = shaped(shapes)
    scene = build_scene(mechanism)
    solid, ball = scene.items[0].marks[:2]
    assert isinstance(solid, Solid) and isinstance(ball, DrawnCircle)
    corners = np.array([p for face in solid.faces for p in face])
    assert corners.min(axis=0) == pytest.approx([-1.0, -0.2, -0.25])
    assert corners.max(axis=0) == pytest.approx([1.0, 0.2, 0.25])
    assert ball.radius == 0.25 and ball.at == (-0.5, 1.0, 0.0)
    # every face is seen counter-clockwise from outside, so that what is turned away is left out
    for face in np.array(solid.faces):
        assert np.cross(face[1] - face[0], face[2] - face[1]) @ face.mean(axis=0) > 0.0
    seen = items_on_paper(scene, np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]))[0]
    assert sum(isinstance(part, Stroke) and len(part.points) == 4 for part in seen.parts) == 3


def test_the_motion_does_not_depend_on_a_shape() -> None:
    from symgen.describe.facts.digest import digest

    plain, drawn = shaped([]), shaped({"type": "sphere", "radius": 1.0, "colour": "#FF0000"})
    assert digest(plain) == digest(drawn) and drawn.shapes[0][1].colour == "#ff0000"


@pytest.mark.parametrize(
    ("shape", "told"),
    [
        ({"type": "ball"}, "f: bodies.b.shape.type: expected 'polyline' or 'box'"),
        ({"type": "box"}, "bodies.b.shape.size: expected a value"),
        ([{"type": "box", "size": [1.0, 1.0]}], "bodies.b.shape[0].size: expected 3 lengths"),
        ({"type": "sphere", "radius": -1.0}, "above 0"),
        ({"type": "sphere", "radius": 1.0, "length": 1.0}, "no such key for a sphere"),
        ({"type": "sphere", "radius": 1.0, "colour": "red"}, "a colour such as"),
        ({"type": "polyline", "points": [[0.0, 0.0, 0.0]]}, "2 to 2000 points"),
        ({"type": "cylinder", "radius": 1.0}, "shape.length: expected a value"),
        ({"type": "sphere", "radus": 1.0}, "did you mean 'radius'"),
        ("round", "expected a table"),
        ([{"type": "sphere", "radius": 1.0}] * 101, "at most 100"),
    ],
)
def test_wrong_shapes_are_refused(shape: Any, told: str) -> None:
    with pytest.raises(InputError) as caught:
        shaped(shape)
    assert told in str(caught.value)


def test_space_is_seen_by_an_orthogonal_frame() -> None:
    scene = build_scene(load("heavy-top").mechanism)
    eye = view_axes(scene, View(0.3, 0.7))
    assert eye @ eye.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(eye) == pytest.approx(1.0)
    assert Poses(scene.frames, [0.0] * 3 + [1.0, 0.0, 0.0, 0.0], True).turns[0] == pytest.approx(np.eye(3))


@pytest.mark.parametrize(("turn", "tilt"), [(0.0, 0.0), (0.0, 30.0), (40.0, 15.0), (200.0, -25.0), (-70.0, 85.0)])
def test_space_is_seen_from_above_by_the_tilt(turn: float, tilt: float, tmp_path: Path) -> None:
    """Pictures were taken from below: against an eye that is placed by its direction, x ahead of it and z up at 0,0."""
    places = {"a": (1.0, 0.0, 0.0), "b": (-1.0, 0.2, 0.1), "c": (0.0, 0.9, 0.0), "d": (0.1, -0.6, 0.8)}
    bodies = "".join(
        f"[bodies.{name}]\nmass = 1.0\ninertia = [0.1, 0.1, 0.1]\nposition = {list(place)}\n"
        for name, place in places.items()
    )
    file, picture = tmp_path / "apart.toml", tmp_path / "apart.svg"
    file.write_text('[mechanism]\nname = "apart"\nspace = "spatial"\ngravity = [0.0, 0.0, -9.81]\n' + bodies)
    assert main(["draw", str(file), "-o", str(picture), f"--view={turn},{tilt}"]) == 0
    round_it, above = np.radians([turn, tilt])
    # what is turned by an angle is seen as from an eye that went round it the other way
    eye = np.array([np.cos(above) * np.cos(round_it), -np.cos(above) * np.sin(round_it), np.sin(above)])
    right = np.cross([0.0, 0.0, 1.0], eye) / np.cos(above)
    seen = np.array(list(places.values())) @ np.stack([right, np.cross(eye, right)]).T
    groups = [g for g in ET.parse(picture).getroot() if g.attrib.get("class") == "body"]
    centres = {
        g.attrib["data-name"]: [float(c.attrib[k]) for k in ("cx", "cy")]
        for g in groups
        for c in g
        if c.tag.endswith("circle")
    }
    drawn = np.array([centres[name] for name in places]) * [1.0, -1.0]
    seen, drawn = seen - seen[0], drawn - drawn[0]
    scale = np.sum(seen * drawn) / np.sum(seen**2)
    assert scale > 0.0
    assert drawn == pytest.approx(scale * seen, abs=0.25)  # places are written to a tenth of a pixel
