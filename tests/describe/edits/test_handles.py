"""Points that a hand moves: the numbers that follow them bring them where they were moved, and nothing else changes."""

import re
from typing import Any

import numpy as np
import pytest

from symgen.api import load
from symgen.describe import catalogue
from symgen.describe.edits.handles import Handle, movable_points, spans_of_parameters
from symgen.describe.edits.text_changes import Change, apply_changes
from symgen.describe.files.load import parse_toml
from symgen.describe.files.places import outline_of_document
from symgen.describe.files.validate import validate

RIG = """\
# a rig with every way to write a point
[mechanism]
name = "rig"

[parameters]
half = { value = 500, unit = "mm" }   # of the bar
reach = 2.0
mast = "1.5 m"

[bodies.bar]   # turned by 30 degrees
mass = 1.0
inertia = 0.1
centre_of_mass = [0.1, 0.0]
points = { A = ["-half", 0.0], B = ["2*half", '25 mm'], C = [1_0e-1, -0.2] }
position = [0.5, 0.3]
angle = "pi/6"

[bodies.block]
mass = 1.0
inertia = 0.1
position = [2.0, 1.0]
angle = -1.2

[joints.foot]
type = "revolute"
between = ["ground", "bar"]
at = [[0.0669873, 0.05], "A"]

[forces.spring]
type = "spring-damper"
between = ["ground", "block"]
at = [["reach", "mast"], [0.3, 4e-1]]
stiffness = 10.0
"""


def found(text: str) -> tuple[dict[str, Handle], Any]:
    """Return the handles of the described start by name, and the mechanism."""
    raw, mechanism = parse_toml(text, "rig.toml"), validate(parse_toml(text, "rig.toml"), "rig.toml")
    model = load(mechanism)
    q = model.initial_state(model.parameters())[0]
    return {h.name: h for h in movable_points(mechanism, raw, outline_of_document(text).values, text, list(q))}, model


def moved(text: str, handle: Handle, dx: float, dy: float) -> str:
    return apply_changes(
        text, [Change(f.start, f.end, repr(f.value + f.right * dx + f.up * dy)) for f in handle.followers]
    )


def places(text: str) -> dict[str, tuple[float, float]]:
    return {name: (h.x, h.y) for name, h in found(text)[0].items()}


def test_points_lie_where_the_picture_has_them() -> None:
    by_name, model = found(RIG)
    assert set(by_name) == {
        *("joints.foot", "bodies.bar.points.B", "bodies.bar.points.C", "forces.spring.at.0", "forces.spring.at.1"),
    }
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    corner = by_name["bodies.bar.points.C"]
    assert (corner.x, corner.y) == pytest.approx((0.5 + c * 1.0 + s * 0.2, 0.3 + s * 1.0 - c * 0.2))
    assert (by_name["forces.spring.at.0"].x, by_name["forces.spring.at.0"].y) == (2.0, 1.5)
    assert by_name["joints.foot"].kind == "pivot" and by_name["bodies.bar.points.B"].kind == "point"
    assert {h.kind for n, h in by_name.items() if n.startswith("forces")} == {"end"}
    # the same points as traces of pages have them, which are measured from centres of mass
    scene = model.draw(at="described").scene
    poses = scene.poses(model.initial_state(model.parameters())[0])
    spring = next(item for item in scene.items if item.name == "spring").marks[0]
    end = by_name["forces.spring.at.1"]
    assert poses.to_ground(spring.other, [spring.to])[0][:2] == pytest.approx((end.x, end.y))


@pytest.mark.parametrize(
    "name", ["bodies.bar.points.C", "forces.spring.at.0", "forces.spring.at.1", "bodies.bar.points.B", "joints.foot"]
)
@pytest.mark.parametrize("way", [(0.3, 0.0), (0.0, -0.2), (0.17, 0.4)])
def test_a_point_goes_where_it_is_moved(name: str, way: tuple[float, float]) -> None:
    handle = found(RIG)[0][name]
    text = moved(RIG, handle, *way)
    before, after = places(RIG)[name], places(text)[name]
    if name == "joints.foot":  # the pivot itself: the bar follows when the loop is closed
        ground = parse_toml(text, "rig")["joints"]["foot"]["at"][0]
        assert ground == pytest.approx((0.0669873 + way[0], 0.05 + way[1]))
    else:
        assert after == pytest.approx((before[0] + way[0], before[1] + way[1]), abs=1e-9)
    # nothing but the digits of its numbers has changed
    spans = sorted((f.start, f.end) for f in handle.followers)
    rest = [RIG[a:b] for a, b in zip([0, *(e for _, e in spans)], [*(s for s, _ in spans), len(RIG)], strict=True)]
    assert re.fullmatch(r"[-+\d.e_]+".join(map(re.escape, rest)), text)


def test_a_pin_of_two_bodies_moves_on_both() -> None:
    file = catalogue.file_of_entry("four-bar")
    assert file is not None
    text = file.read_text(encoding="utf-8")
    handle = found(text)[0]["joints.B"]
    after = moved(text, handle, 0.25, 0.125)
    raw = parse_toml(after, "x")
    assert len(handle.followers) == 4
    assert raw["bodies"]["crank"]["points"]["B"] != [1.0, 0.0] and raw["bodies"]["coupler"]["points"]["C"] == [4.0, 0.0]
    # at the described start the pin still is one point, and where the hand left it
    model = load(validate(raw, "x"))
    scene = model.draw(at="described").scene
    assert scene.gaps(model.initial_state(model.parameters())[0]).max() < 1e-9
    assert places(after)["joints.B"] == pytest.approx((handle.x + 0.25, handle.y + 0.125))


def test_the_centre_of_mass_of_a_uniform_bar_stays_in_its_middle() -> None:
    text = RIG.replace("centre_of_mass = [0.1, 0.0]", "centre_of_mass = [0.25, 0.05]").replace(
        """{ A = ["-half", 0.0], B = ["2*half", '25 mm'], C = [1_0e-1, -0.2] }""",
        "{ A = [-0.5, 0.0], B = [1.0, 0.1], C = [0.7, 0.9] }",
    )
    for name in ("B", "A"):
        handle = found(text)[0]["joints.foot" if name == "A" else f"bodies.bar.points.{name}"]
        body = parse_toml(moved(text, handle, 0.2, -0.3), "x")["bodies"]["bar"]
        points = np.array([body["points"]["A"], body["points"]["B"]])
        assert body["centre_of_mass"] == pytest.approx(points.mean(axis=0), abs=1e-12)
    free = found(text)[0]["bodies.bar.points.C"]  # a further hole moves nothing else
    assert len(free.followers) == 2
    other = found(text.replace("[0.25, 0.05]", "[0.3, 0.05]"))[0]["bodies.bar.points.B"]
    assert len(other.followers) == 2  # it lies elsewhere on purpose


def test_a_formula_of_several_parameters_stays_as_it_is() -> None:
    text = RIG.replace('["reach", "mast"]', '["reach*mast", "sin(reach)*mast"]')
    handle = found(text)[0]["forces.spring.at.0"]
    assert handle.followers == ()


def test_in_space_nothing_is_dragged() -> None:
    file = catalogue.file_of_entry("heavy-top")
    assert file is not None
    assert found(file.read_text(encoding="utf-8"))[0] == {}


def test_numbers_of_parameters_are_found_by_their_digits() -> None:
    spans = spans_of_parameters(parse_toml(RIG, "x"), outline_of_document(RIG).values, RIG)
    assert {name: RIG[slice(*span)] for name, span in spans.items()} == {"half": "500", "reach": "2.0", "mast": "1.5"}
