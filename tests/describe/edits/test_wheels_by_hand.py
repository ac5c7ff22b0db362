"""Wheels, contacts, racks and ropes added by a hand move as closed forms say, wherever the hand puts them."""

import math
import tomllib

import numpy as np
import pytest

from symgen.api import load
from symgen.base.errors import InputError
from symgen.cli._editor.drafts import Drafts
from symgen.describe.edits.snippet_tables import Spot
from symgen.describe.edits.snippets import snippet_changes
from symgen.describe.edits.text_changes import apply_changes
from symgen.describe.files.load import parse_toml
from symgen.describe.files.places import outline_of_document

EMPTY = '[mechanism]\nname = "mine"\ngravity = [0.0, -9.81]\n\n[run]\nuntil = 0.5\n'
G = 9.81


def drawn(text: str, *acts: tuple[object, ...]) -> str:
    """Return a text after acts of a hand: a kind and its points."""
    for kind, *spots in acts:
        raw = parse_toml(text, "x")
        text = apply_changes(text, snippet_changes(str(kind), spots, raw, outline_of_document(text), text)[0])
    return text


def run(text: str, tmp_path, **settings):
    file = tmp_path / "mine.toml"
    file.write_text(text)
    result = load(file).simulate(**settings)
    assert result.status == "ok", result.reason
    return result


@pytest.mark.parametrize("slope", [-50.0, -20.0, 10.0, 35.0])
@pytest.mark.parametrize("radius", [0.05, 0.4])
def test_a_wheel_rolls_down_a_line_of_any_slope(radius: float, slope: float, tmp_path) -> None:
    """A uniform disc takes two thirds of the weight along the line; a file in degrees and metres says where it is."""
    a = math.radians(slope)
    normal = (-math.sin(a), math.cos(a))
    foot = Spot(1.0, 0.5)
    centre = Spot(1.0 + radius * normal[0], 0.5 + radius * normal[1])
    rim = Spot(centre.x + radius, centre.y)
    held = centre._replace(body="wheel1", point="A")
    result = run(drawn(EMPTY, ("wheel", centre, rim), ("roll", held, foot)), tmp_path)
    way = -np.sign(slope) * np.hypot(result["wheel1.x"] - centre.x, result["wheel1.y"] - centre.y)
    assert way == pytest.approx(-0.5 * (2.0 / 3.0) * G * math.sin(a) * result.t**2, abs=1e-8)
    assert result["wheel1.theta"] == pytest.approx(-way / radius, abs=1e-7)


@pytest.mark.parametrize("on_body", [False, True])
def test_a_wheel_falls_onto_a_line_and_bounces(on_body: bool, tmp_path) -> None:
    """It meets the line after sqrt(2 h/g) and leaves with a fifth of its speed."""
    centre, rim, foot = Spot(0.0, 0.5), Spot(0.0, 0.6), Spot(0.3, 0.0)
    acts: list[tuple[object, ...]] = [("wheel", centre, rim)]
    if on_body:  # a bar that is welded to the ground
        acts += [("body", Spot(-1.0, 0.0), Spot(1.0, 0.0)), ("weld", Spot(-1.0, 0.0, "bar1", "A"), Spot(-1.0, 0.0))]
        foot = Spot(0.0, 0.0, "bar1", "", (1.0, 0.0))
    acts.append(("touch", centre._replace(body="wheel1", point="A"), foot._replace(x=0.0)))
    text = drawn(EMPTY, *acts)
    assert '"wheel1_radius"' in text.split("[contacts.")[1]
    result = run(text, tmp_path, until=0.39)
    falls = math.sqrt(2.0 * 0.4 / G)
    (hit,) = [event for event in result.events if event.name == "touch1.hit"][:1]
    assert hit.t == pytest.approx(falls, abs=1e-9)
    after = result.t > falls
    free = 0.1 + 0.2 * G * falls * (result.t - falls) - 0.5 * G * (result.t - falls) ** 2
    assert result["wheel1.y"][after] == pytest.approx(free[after], abs=1e-8)


@pytest.mark.parametrize("along", [0.0, 30.0, 90.0, 200.0])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_rack_moves_as_its_pinion_turns(side: float, along: float, tmp_path) -> None:
    """What touches the rack has its speed, in size and in sense, whatever way the rack runs."""
    a, radius = math.radians(along), 0.2
    way, across = (math.cos(a), math.sin(a)), (-math.sin(a), math.cos(a))
    foot = (0.5 - side * radius * across[0], 0.3 - side * radius * across[1])
    start = (foot[0] + 0.4 * way[0], foot[1] + 0.4 * way[1])
    centre = Spot(0.5, 0.3)
    pinion = centre._replace(body="wheel1", point="A")
    end = Spot(*start, "bar1", "A")
    ahead = Spot(start[0] + way[0], start[1] + way[1])
    text = drawn(
        EMPTY,
        ("wheel", centre, Spot(0.5 + radius, 0.3)),
        ("pin", pinion, centre),
        ("body", Spot(*start), ahead),
        ("slide", end, ahead),
        ("rack", pinion._replace(joint="pin1"), end),
        ("motor", pinion._replace(joint="pin1")),
    )
    result = run(text, tmp_path)
    turned = result["wheel1.theta"]
    assert turned == pytest.approx(2.0 * result.t, abs=1e-9)
    # the foot is at -side*radius across the rack from the centre, and moves at theta' times that, turned by 90 degrees
    bar = tomllib.loads(text)["bodies"]["bar1"]["position"]
    moved = (result["bar1.A.x"] - bar[0]) * way[0] + (result["bar1.A.y"] - bar[1]) * way[1]
    assert moved == pytest.approx(side * radius * turned, abs=1e-9)


@pytest.mark.parametrize("heavy", [1.5, 2.0, 5.0])
def test_a_rope_over_a_sheave_pulls_alike_on_both_sides(heavy: float, tmp_path) -> None:
    """Atwood's machine: (m - 1)/(m + 1) of gravity."""
    left, right = Spot(-0.1, 0.0), Spot(0.1, 0.0)
    text = drawn(
        EMPTY,
        ("body", Spot(-0.1, -0.2), left),
        ("body", Spot(0.1, -0.2), right),
        (
            "rope",
            left._replace(body="bar1", point="B"),
            Spot(0.0, 1.0),
            Spot(0.0, 1.1),
            right._replace(body="bar2", point="B"),
        ),
    )
    text = text.replace("mass = 1.0", f"mass = {heavy}", 1)
    result = run(text, tmp_path)
    start = Drafts(tmp_path / "mine.toml").check_text(text)  # as the page draws it
    assert start["errors"] == [] and start["freedoms"]["count"] == 5
    fallen = 0.5 * (heavy - 1.0) / (heavy + 1.0) * G * result.t**2
    assert result["bar1.y"][0] - result["bar1.y"] == pytest.approx(fallen, abs=1e-8)
    assert result["bar2.y"] - result["bar2.y"][0] == pytest.approx(fallen, abs=1e-8)


@pytest.mark.parametrize(
    ("kind", "spots", "sentence"),
    [
        ("wheel", (Spot(0, 0), Spot(0, 0)), "wheel: expected points in different places"),
        ("touch", (Spot(0, 0), Spot(0, -1)), "touch: expected a point of a body"),
        ("touch", (Spot(0, 1, "bar1", "A"), Spot(0, 0, "bar1", "B")), "touch: expected a line of another body"),
        ("roll", (Spot(0, 1, "bar1", "A"), Spot(0, 1)), "roll: expected points in different places"),
        ("rack", (Spot(0, 0, "bar1", "A"), Spot(1, 0)), "rack: expected the pin of the pinion"),
        ("rope", (Spot(0, 0), Spot(1, 1), Spot(1, 2), Spot(2, 0)), "rope: expected ends on two bodies"),
        ("rope", (Spot(0, 0), Spot(1, 1)), "rope: expected 4 points, got 2"),
    ],
)
def test_wheels_that_cannot_be_added(kind: str, spots: tuple[Spot, ...], sentence: str) -> None:
    text = drawn(EMPTY, ("body", Spot(0.0, 1.0), Spot(1.0, 1.0)))
    with pytest.raises(InputError, match=sentence):
        drawn(text, (kind, *spots))


@pytest.mark.slow
@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize("centre", [0.15, 0.2])
def test_a_roller_on_a_cam_sticks_for_many_turns(centre: float, shape: str, tmp_path) -> None:
    """The roller is as high as two circles that touch, and rolls: its turns are counted beyond the first half."""
    hub, seat = Spot(0.0, 0.0), Spot(0.0, centre + 0.3)
    end = Spot(0.0, 1.0)
    wheel, roller = Spot(0.0, centre, "wheel1", "A"), seat._replace(body="bar1", point="A")
    text = drawn(
        EMPTY,
        ("wheel", Spot(0.0, centre), Spot(0.0, centre + 0.2)),
        ("pin", hub._replace(body="wheel1", at=(0.0, -centre)), hub),
        ("body", seat, end),
        ("wheel", roller, Spot(0.1, centre + 0.3)),
        ("slide", end._replace(body="bar1", point="B"), Spot(0.0, 2.0)),
        ("touch", wheel, roller._replace(joint="pin2")),
        ("motor", hub._replace(body="wheel1", at=(0.0, -centre), joint="pin1")),
    )
    assert text.count("disc = ") == 2 and '"wheel2_radius"' in text.split("[contacts.")[1]
    result = run(text, tmp_path, until=4.0, shape=shape)
    turned = 0.5 * math.pi + 2.0 * result.t
    x, y = centre * np.cos(turned), centre * np.sin(turned)
    assert result["wheel2.y"] == pytest.approx(y + np.sqrt(0.3**2 - x**2), abs=1e-8)
    sticks = result.t > next(event.t for event in result.events if event.name == "touch1.stick")
    # no slip: the rates of both circles, beside the turning of their line of centres
    line = np.gradient(np.unwrap(np.arctan2(result["wheel2.y"] - y, -x)), result.t, edge_order=2)
    slip = 0.2 * (2.0 - line) + 0.1 * (result["wheel2.omega"] - line)
    assert np.abs(slip[sticks]).max() < 1e-4 and result["wheel2.theta"][-1] < -4.0 * math.pi


@pytest.mark.parametrize("spot", [Spot(0.0, 1.0, "bar1", "A"), Spot(0.0, 1.0, "bar1", "A", joint="pin1")])
def test_a_wheel_that_is_pinned_rolls_by_its_own_radius(spot: Spot) -> None:
    """A click at the pin means the wheel, not the bar that it was pinned to."""
    text = drawn(EMPTY, ("body", Spot(0.0, 1.0), Spot(1.0, 1.0)), ("wheel", spot._replace(joint=""), Spot(0.0, 1.2)))
    rolling = tomllib.loads(drawn(text, ("roll", spot, Spot(0.0, 0.8))))["joints"]["roll1"]
    meant = ("wheel1", "wheel1_radius") if spot.joint else ("bar1", 0.2)
    assert (rolling["between"][0], rolling["radius"]) == meant
