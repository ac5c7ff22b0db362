"""Sketches: every mechanism has one, where things stand in it, and that names of a file stay text."""

import math
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from symgen.api import load
from symgen.base.errors import InputError
from symgen.describe import catalogue
from symgen.describe.drawing import build_scene, sketch
from symgen.describe.drawing.drawn_surfaces import outlines_of_contacts
from symgen.describe.drawing.mechanism_scene import convex_hull
from symgen.describe.drawing.paper import Circle, items_on_paper
from symgen.describe.drawing.scene import DrawnCircle
from symgen.describe.files.validate import validate

SVG = "{http://www.w3.org/2000/svg}"
NAMES = [e.name for e in (*catalogue.entries(), *catalogue.entries(catalogue.MACHINES))]


def groups(text: str) -> dict[str, ET.Element]:
    return {g.attrib["id"]: g for g in ET.fromstring(text).iter(f"{SVG}g") if "id" in g.attrib}


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("front-suspension", "stewart-platform", "flyball-governor")
@pytest.mark.parametrize("name", NAMES)
def test_everything_of_the_catalogue_is_drawn(name: str) -> None:
    mechanism = load(name).mechanism
    found = groups(sketch(mechanism))
    wanted = {f"body-{b.name}" for b in mechanism.bodies} | {f"joint-{j.name}" for j in mechanism.joints}
    touching = {f"contact-{name}" for name, _ in outlines_of_contacts(mechanism)}
    assert set(found) == wanted | touching | {f"force-{f.name}" for f in mechanism.forces if f.kind != "modal"}
    assert all(len(found[f"body-{b.name}"]) > 1 for b in mechanism.bodies)
    shown = (j for j in mechanism.joints if j.kind not in ("place", "rows"))  # contacts, and formulas
    assert all(len(found[f"joint-{j.name}"]) > 1 for j in shown)
    assert sketch(mechanism) == sketch(mechanism)


def test_pins_stand_where_the_bodies_put_them() -> None:
    """A crank of length 2 at 0.3 rad: its far pin, worked out by hand, in the scene and at one scale on paper."""
    raw = {
        "mechanism": {"name": "arm"},
        "bodies": {
            "crank": {
                "mass": 1.0,
                "inertia": 1.0,
                "centre_of_mass": [0.5, 0.0],
                "points": {"tip": [2.0, 0.0]},
                "position": [1.0, -1.0],
                "angle": 0.3,
            },
            "bob": {"type": "point", "mass": 1.0, "position": [5.0, 5.0]},
        },
        "joints": {
            "base": {"type": "revolute", "between": ["ground", "crank"], "at": [[1.0, -1.0], [0.0, 0.0]]},
            "pin": {"type": "revolute", "between": ["crank", "bob"], "at": ["tip", "centre"]},
        },
    }
    mechanism = validate(raw, "here")
    x, y = 1.0 + 2.0 * math.cos(0.3), -1.0 + 2.0 * math.sin(0.3)
    q = [1.0 + 0.5 * math.cos(0.3), -1.0 + 0.5 * math.sin(0.3), 0.3, x, y]
    scene = build_scene(mechanism, q)
    pin = next(item for item in scene.items if (item.role, item.name) == ("joint", "pin"))
    drawn = next(d for d in items_on_paper(scene, np.array(q)) if d.item is pin)
    (circle,) = drawn.parts
    assert isinstance(circle, Circle) and isinstance(pin.marks[0], DrawnCircle)
    assert (circle.x, circle.y) == pytest.approx((x, y), abs=1e-12)
    # on paper: the pin and the stand are as far apart as lengths and one scale have it, y downwards
    found = groups(sketch(mechanism, q))
    at = [float(found["joint-pin"][1].attrib[k]) for k in ("cx", "cy")]
    base = next(e for e in found["joint-base"] if e.tag == f"{SVG}circle")
    way = at[0] - float(base.attrib["cx"]), float(base.attrib["cy"]) - at[1]
    assert math.atan2(way[1], way[0]) == pytest.approx(0.3, abs=2e-3)  # coordinates have one decimal of a pixel


def test_a_turned_body_in_space_is_where_its_rotation_says() -> None:
    """A tip at distance 1 along body z, turned by 2 rad about x, by Rodrigues' formula written out."""
    mechanism = load("heavy-top").mechanism
    turn = 2.0
    q = np.array([0.1, -0.2, 0.3, math.cos(turn / 2), math.sin(turn / 2), 0.0, 0.0])
    from symgen.describe.drawing.scene import Poses

    found = Poses(build_scene(mechanism).frames, 3.0 * np.array([*q[:3] / 3.0, *q[3:]]), True).to_ground(
        0, [(0.0, 0.0, 1.0)]
    )
    assert found[0] == pytest.approx([0.1, -0.2 - math.sin(turn), 0.3 + math.cos(turn)], abs=1e-15)


def test_the_hull_holds_all_points_and_turns_left() -> None:
    points = np.random.default_rng(5).standard_normal((40, 2))
    corners = points[convex_hull(points)]
    edges = np.roll(corners, -1, axis=0) - corners
    for a, e in zip(corners, edges, strict=True):
        assert np.all(e[0] * (points[:, 1] - a[1]) - e[1] * (points[:, 0] - a[0]) >= -1e-12)


def test_open_joints_are_marked() -> None:
    mechanism = load("four-bar").mechanism
    name = mechanism.joints[1].name
    found = groups(sketch(mechanism, open_joints=[name], caption="open by <1> & more"))
    marked = found[f"fault-{name}"]
    assert marked.attrib["class"] == "fault" and any(e.tag == f"{SVG}polyline" for e in marked)
    assert "open by &lt;1&gt; &amp; more" in sketch(mechanism, caption="open by <1> & more")


def test_texts_of_a_file_stay_text() -> None:
    raw = {
        "mechanism": {"name": "arm", "title": "</title><script>alert(1)</script>"},
        "bodies": {"a": {"type": "point", "mass": 1.0}},
    }
    text = sketch(validate(raw, "here"))
    assert "<script" not in text and ET.fromstring(text).find(f"{SVG}title").text == raw["mechanism"]["title"]  # type: ignore[index,union-attr]


def test_a_wrong_number_of_coordinates_is_refused() -> None:
    with pytest.raises(InputError, match="coordinates, as four-bar has"):
        sketch(load("four-bar").mechanism, [0.0])


def test_springs_and_dampers_are_told_apart() -> None:
    force = {"type": "spring-damper", "between": ["ground", "a"], "at": [[0.0, 0.0], "centre"]}
    for keys, kind in (
        ({"stiffness": 2.0}, "spring"),
        ({"damping": 2.0}, "damper"),
        ({"stiffness": 1.0, "damping": 2.0}, "spring-damper"),
        ({"actuator": 5.0}, "actuator"),
        ({"potential": "length**4"}, "spring"),
    ):
        raw = {
            "mechanism": {"name": "m"},
            "bodies": {"a": {"type": "point", "mass": 1.0, "position": [1.0, 0.0]}},
            "forces": {"f": force | keys},
        }
        item = next(i for i in build_scene(validate(raw, "here")).items if i.role == "force")
        assert getattr(item.marks[0], "kind", "") == kind
    assert re.search("polyline", sketch(validate(raw, "here")))
