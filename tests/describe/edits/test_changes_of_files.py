"""Parts of mechanism files added, renamed and taken out: the rest of the text stays byte for byte."""

import difflib
import math
import tomllib
from collections.abc import Mapping

import numpy as np
import pytest

from symgen.api import load
from symgen.base.errors import InputError
from symgen.describe import catalogue
from symgen.describe.edits.renaming import remove_from_text, rename_in_text
from symgen.describe.edits.section_words import words_of_sections
from symgen.describe.edits.snippet_tables import Spot
from symgen.describe.edits.snippets import snippet_changes
from symgen.describe.edits.text_changes import Change, apply_changes, keep_line_ends, utf16_places
from symgen.describe.files.load import parse_toml
from symgen.describe.files.origins import Source
from symgen.describe.files.places import outline_of_document
from symgen.describe.files.validate import collect_errors, validate


def text_of(name: str) -> str:
    file = catalogue.file_of_entry(name)
    assert file is not None
    return file.read_text(encoding="utf-8")


FOUR_BAR = text_of("four-bar")
EMPTY = '# mine\n[mechanism]\nname = "new"\n'


def added(text: str, kind: str, *spots: Spot, angles: Mapping[str, float] | None = None) -> tuple[str, str]:
    changes, path = snippet_changes(kind, spots, parse_toml(text, "x"), outline_of_document(text), text, angles)
    return apply_changes(text, changes), path


def is_inserted(before: str, after: str) -> bool:
    """Whether a text is another one with lines put in."""
    matcher = difflib.SequenceMatcher(None, before.split("\n"), after.split("\n"), autojunk=False)
    return {op[0] for op in matcher.get_opcodes()} == {"equal", "insert"}


def test_changes_that_overlap_are_refused() -> None:
    assert apply_changes("abc", [Change(2, 3, "z"), Change(0, 1, "")]) == "bz"
    with pytest.raises(InputError):
        apply_changes("abc", [Change(0, 2, ""), Change(1, 3, "")])


def test_characters_beyond_the_first_plane_are_two_for_pages() -> None:
    assert utf16_places("abc") is None
    assert utf16_places("a\U0001f600b") == [0, 1, 3, 4]


def test_line_ends() -> None:
    assert keep_line_ends("a\nb\n", "a\nc\n") == "a\nb\n"
    assert keep_line_ends("a\nb\n", "a\r\nc\r\n") == "a\r\nb\r\n"
    assert keep_line_ends("a\nb\nc\n", "a\r\nb\n") == "a\r\nb\nc\r\n"


def test_an_outline_has_all_headers_and_mentions() -> None:
    text = 'a.b = 1\n[x."y z"]\n  [x.w]  # c\nk = { m = [1, "t"] }\n[[n]]\n'
    parts = outline_of_document(text)
    assert {path: text[slice(*span)] for path, span in parts.values.items()}["x", "w", "k", "m"] == '[1, "t"]'
    assert [(h.path, text[h.start : h.end]) for h in parts.headers] == [
        (("x", "y z"), '[x."y z"]'),
        (("x", "w"), "  [x.w]"),
        (("n", 0), "[[n]]"),
    ]
    assert [text[m.start : m.end] for m in parts.mentions if m.path == ("x",)] == ["x", "x"]


# -- adding ------------------------------------------------------------------------------------------------------------


def test_a_bar_from_a_pin_to_a_free_place() -> None:
    after, path = added(FOUR_BAR, "body", Spot(8.0, 4.5, "rocker", "C", (2.5, 0.0), "C"), Spot(11.0, 8.5))
    assert path == "bodies.bar1" and is_inserted(FOUR_BAR, after)
    order = ("[bodies.bar1]", "[joints.A]", "[joints.D]", "[joints.pin1]")
    assert sorted(order, key=after.index) == [*order]
    mechanism = validate(parse_toml(after, "x"), "x")
    assert mechanism.joint_named("pin1").bodies == ("rocker", "bar1")
    raw = parse_toml(after, "x")["bodies"]["bar1"]
    assert raw["inertia"] == pytest.approx(25.0 / 12.0, rel=1e-5)
    assert raw["points"] == {"A": [0.0, 0.0], "B": [3.0, 4.0]} and raw["centre_of_mass"] == [1.5, 2.0]
    assert raw["position"] == [8.0, 4.5] and "angle" not in raw


def test_a_plate_has_the_inertia_of_its_triangle() -> None:
    corners = np.array([[0.0, 0.0], [3.0, 0.0], [1.0, 2.0]])
    after, _ = added(EMPTY, "body", *(Spot(*corner) for corner in corners))
    raw = parse_toml(after, "x")["bodies"]["plate1"]
    # by quadrature over the triangle: three points in the middles of its sides are exact for squares
    middles = 0.5 * (corners + np.roll(corners, 1, axis=0)) - corners.mean(axis=0)
    assert raw["inertia"] == pytest.approx((middles**2).sum() / 3.0, rel=1e-5)
    assert after.startswith(EMPTY.rstrip("\n"))


def test_a_four_bar_from_nothing() -> None:
    text = EMPTY
    text, _ = added(text, "body", Spot(0.0, 0.0), Spot(1.0, 2.0))
    text, _ = added(text, "body", Spot(1.0, 2.0, "bar1", "B"), Spot(5.0, 3.0))
    text, _ = added(text, "body", Spot(5.0, 3.0, "bar2", "B"), Spot(6.0, 0.0))
    text, _ = added(text, "pin", Spot(0.0, 0.0, "bar1", "A"), Spot(0.0, 0.0))
    text, foot = added(text, "pin", Spot(6.0, 0.0), Spot(6.0, 0.0, "bar3", "B"))
    model = load(validate(parse_toml(text, "x"), "x"))
    compiled = model.compile(shape="looped")
    start = model.assemble(compiled)
    assert compiled.info.nv - start.rank == 1
    assert start.y[:9] == pytest.approx(model.initial_state({})[0], abs=1e-15)  # it was drawn closed
    text, motor = added(text, "motor", Spot(0.0, 0.0, "bar1", "A", joint="pin3"))
    assert motor == "joints.motor1" and foot == "joints.pin4" and 'value = "2.0*t"' in text
    driven = load(validate(parse_toml(text, "x"), "x"))
    compiled = driven.compile(shape="looped")
    start = driven.assemble(compiled)
    assert compiled.info.nv == start.rank and start.y[:9] == pytest.approx(model.initial_state({})[0], abs=1e-15)


def test_numbers_are_those_of_the_hand_whatever_sums_leave_of_rounding() -> None:
    text, _ = added(EMPTY, "body", Spot(0.1, 0.2), Spot(0.1 + 0.2, 0.7))
    raw = parse_toml(text, "x")["bodies"]["bar1"]
    assert raw["points"] == {"A": [0.0, 0.0], "B": [0.2, 0.5]} and raw["position"] == [0.1, 0.2]
    text, _ = added(text, "pin", Spot(0.3, 0.7, "bar1", "B"), Spot(0.1 + 0.2, 0.7 - 1e-17))
    assert "at = [[0.3, 0.7]" in text
    third = added(EMPTY, "body", Spot(1.0 / 3.0, 0.0), Spot(1.0, 0.0))[0]  # no decimal is meant: all digits stay
    assert parse_toml(third, "x")["bodies"]["bar1"]["position"][0] == pytest.approx(1.0 / 3.0, abs=1e-14)


CRANK, ROD, BLOCK = (Spot(0.0, 0.0), Spot(0.1, 0.1)), (Spot(0.1, 0.1), Spot(0.5, 0.0)), (Spot(0.5, 0.0), Spot(0.6, 0.0))


def drawn_slider_crank(order: str) -> str:
    """Return a crank, a rod and a block, drawn one after the other and pinned together."""
    text, names = EMPTY, dict[str, str]()
    for letter in order:
        ends = {"c": CRANK, "r": ROD, "b": BLOCK}[letter]
        text, path = added(text, "body", *ends)
        names[letter] = path.removeprefix("bodies.")
    text, _ = added(text, "pin", Spot(0.0, 0.0, names["c"], "A"), Spot(0.0, 0.0))
    text, _ = added(text, "pin", Spot(0.1, 0.1, names["c"], "B"), Spot(0.1, 0.1, names["r"], "A"))
    return added(text, "pin", Spot(0.5, 0.0, names["r"], "B"), Spot(0.5, 0.0, names["b"], "A"))[0]


@pytest.mark.parametrize("order", ["crb", "cbr", "rbc", "bcr"])
def test_a_slide_at_a_pin_takes_the_block_in_whatever_order_it_was_drawn(order: str) -> None:
    text = drawn_slider_crank(order)
    block = f"bar{order.index('b') + 1}"
    after, path = added(text, "slide", Spot(0.5, 0.0, f"bar{order.index('r') + 1}", "B", joint="pin3"))
    entry = parse_toml(after, "x")["joints"]["slide1"]
    assert path == "joints.slide1"
    assert entry["between"] == ["ground", block] and entry["at"] == [[0.5, 0.0], "A"]
    assert entry["axis"] == [1.0, 0.0] and "angle" not in entry
    model = load(validate(parse_toml(after, "x"), "x"))
    compiled = model.compile(shape="looped")
    start = model.assemble(compiled)
    assert compiled.info.nv - start.rank == 1 and not start.warnings
    assert start.y[:9] == pytest.approx(model.initial_state({})[0], abs=1e-15)


def test_a_slide_at_a_pin_of_equals_takes_the_body_that_was_drawn_last() -> None:
    text, _ = added(EMPTY, "body", *ROD)
    text, _ = added(text, "body", Spot(0.5, 0.0, "bar1", "B"), Spot(0.6, 0.0))
    after, _ = added(text, "slide", Spot(0.5, 0.0, "bar1", "B", joint="pin1"))
    assert parse_toml(after, "x")["joints"]["slide1"]["between"] == ["ground", "bar2"]


def test_a_slide_runs_where_the_hand_draws_it() -> None:
    text, _ = added(EMPTY, "body", *BLOCK)
    spot = Spot(0.5, 0.0, "bar1", "A")
    for place, axis in (((0.5, 2.0), [0.0, 1.0]), ((0.1, 0.0), [-1.0, 0.0]), ((0.8, 0.1), [0.3, 0.1])):
        entry = parse_toml(added(text, "slide", spot, Spot(*place))[0], "x")["joints"]["slide1"]
        assert entry["axis"] == axis and entry["between"] == ["ground", "bar1"]
    # along another body, which is turned: the axis is in its frame, and the block keeps its angle
    text, _ = added(text, "body", Spot(0.0, 0.0), Spot(0.5, 1.0))
    angles = {"bar2": 0.3, "bar1": 0.1}
    after, _ = added(text, "slide", spot, Spot(0.5, 1.0, "bar2", "B", (0.5, 1.0)), angles=angles)
    entry = parse_toml(after, "x")["joints"]["slide1"]
    assert entry["between"] == ["bar2", "bar1"] and entry["at"] == ["B", "A"]
    assert entry["axis"] == pytest.approx([math.sin(0.3), math.cos(0.3)], abs=1e-14) and entry["angle"] == -0.2


def test_a_weld_keeps_angles_and_a_bar_gets_further_points() -> None:
    text, _ = added(EMPTY, "body", *ROD)
    text, _ = added(text, "body", Spot(0.5, 0.0), Spot(0.5, 0.3))
    after, path = added(
        text, "weld", Spot(0.5, 0.0, "bar1", "B"), Spot(0.5, 0.0, "bar2", "A"), angles={"bar2": 0.25, "bar1": 1e-12}
    )
    assert path == "joints.weld1" and parse_toml(after, "x")["joints"]["weld1"]["angle"] == 0.25
    validate(parse_toml(after, "x"), "x")
    for name, place in (("C", (0.3, 0.05)), ("D", (0.3, 0.25))):
        text, path = added(text, "point", Spot(0.1, 0.1, "bar1", "A"), Spot(*place))
        assert path == f"bodies.bar1.points.{name}"
    points = parse_toml(text, "x")["bodies"]["bar1"]["points"]
    assert points == {"A": [0.0, 0.0], "B": [0.4, -0.1], "C": [0.2, -0.05], "D": [0.2, 0.15]}
    turned = added(text, "point", Spot(0.1, 0.1, "bar1", "A"), Spot(0.1, 1.1), angles={"bar1": 0.5})[0]
    new = parse_toml(turned, "x")["bodies"]["bar1"]["points"]["E"]
    assert new == pytest.approx([math.sin(0.5), math.cos(0.5)], abs=1e-14)


def freedoms(text: str) -> int:
    """Return the degrees of freedom of a file, which closes as it is described."""
    model = load(validate(parse_toml(text, "x"), "x"))
    compiled = model.compile(shape="looped")
    start = model.assemble(compiled)
    described = model.initial_state({})[0]
    assert start.y[: len(described)] == pytest.approx(described, abs=1e-12)
    return int(compiled.info.nv - start.rank)


def two_wheels() -> str:
    """Return two bars on pins of the ground, one metre apart."""
    text = EMPTY
    for k, x in enumerate((0.0, 1.0)):
        text, _ = added(text, "body", Spot(x, 0.0), Spot(x, 0.2))
        text, _ = added(text, "pin", Spot(x, 0.0, f"bar{k + 1}", "A"), Spot(x, 0.0))
    return text


def test_a_slot_lets_its_body_turn_where_a_slide_does_not() -> None:
    text, _ = added(EMPTY, "body", *ROD)
    end = Spot(0.5, 0.0, "bar1", "B")
    slid, slot = added(text, "slide", end)[0], added(text, "slot", end)[0]
    assert (freedoms(slid), freedoms(slot)) == (1, 2)
    entry = parse_toml(slot, "x")["joints"]["slot1"]
    assert entry["between"] == ["bar1", "ground"] and entry["at"] == ["B", [0.5, 0.0]]
    # a stone in the slot of a rocker, which is turned: the slot runs along the rocker
    text, _ = added(text, "body", Spot(0.5, 0.0), Spot(0.5, 1.0))
    after, _ = added(text, "slot", end, Spot(0.5, 1.0, "bar2", "B", (0.0, 1.0)), angles={"bar2": 0.5})
    entry = parse_toml(after, "x")["joints"]["slot1"]
    assert entry["between"] == ["bar1", "bar2"] and entry["at"] == ["B", "B"]
    assert entry["axis"] == pytest.approx([math.sin(0.5), math.cos(0.5)], abs=1e-14)


def test_gears_a_rod_and_a_cylinder() -> None:
    text = two_wheels()
    assert freedoms(text) == 2
    pins = [Spot(x, 0.0, f"bar{k + 1}", "A", joint=f"pin{k + 1}") for k, x in enumerate((0.0, 1.0))]
    geared, path = added(text, "gear", *pins)
    assert path == "joints.gear1" and freedoms(geared) == 1
    assert parse_toml(geared, "x")["joints"]["gear1"] == {
        **{"type": "gear", "between": ["bar1", "bar2"], "radii": [0.5, 0.5]},
    }
    offset = parse_toml(added(text, "gear", *pins, angles={"bar1": 0.3})[0], "x")["joints"]["gear1"]["offset"]
    assert offset == pytest.approx(0.15, abs=1e-15)  # r_a theta_a + r_b theta_b
    tips = [Spot(x, 0.2, f"bar{k + 1}", "B") for k, x in enumerate((0.0, 1.0))]
    rodded, _ = added(text, "rod", *tips)
    assert parse_toml(rodded, "x")["joints"]["rod1"]["length"] == 1.0 and freedoms(rodded) == 1
    pushed, path = added(text, "cylinder", *tips)
    assert path == "forces.cylinder1" and parse_toml(pushed, "x")["forces"]["cylinder1"]["actuator"] == 100.0
    validate(parse_toml(pushed, "x"), "x")


def test_a_click_gives_a_joint_a_stop_and_friction() -> None:
    text = two_wheels()
    pin = Spot(0.0, 0.0, "bar1", "A", joint="pin1")
    after, path = added(text, "stop", pin)
    after, _ = added(after, "friction", pin)
    assert path == "joints.pin1" and is_inserted(text, after)
    entry = parse_toml(after, "x")["joints"]["pin1"]
    assert entry["stop"]["upper"] == "90 deg" and entry["friction"] == {"sliding": 0.1}
    assert "stop" not in parse_toml(after, "x")["joints"]["pin2"]
    assert len(validate(parse_toml(after, "x"), "x").bounded) == 3
    turned = parse_toml(added(text, "stop", pin, angles={"bar1": 2.0})[0], "x")["joints"]["pin1"]["stop"]
    assert (turned["lower"], turned["upper"]) == (0.5, 3.5)  # about where it is
    with pytest.raises(InputError, match="a joint without stop, got 'pin1', which has one"):
        added(after, "stop", pin)


def test_a_motor_moves_a_slide_of_the_ground_on_from_where_it_is() -> None:
    text, _ = added(EMPTY, "body", *BLOCK)
    text, _ = added(text, "slide", Spot(0.5, 0.0, "bar1", "A"), Spot(0.8, 0.4))
    driven, path = added(text, "motor", Spot(0.5, 0.0, "bar1", "A"))
    assert path == "joints.motor1" and 'joint = "slide1"\nvalue = "0.1*t"' in driven and freedoms(driven) == 0
    later, _ = added(text, "motor", Spot(0.8, 0.4, "bar1", "A"))  # as after a point was dragged
    assert 'value = "0.5 + 0.1*t"' in later
    with pytest.raises(InputError, match="a pin, which it turns, or a slide"):
        added(text, "motor", Spot(0.6, 0.0, "bar1", "B"))


def test_a_copy_of_a_body_lies_where_the_hand_puts_it() -> None:
    text, _ = added(EMPTY, "body", *ROD)
    after, path = added(text, "copy", Spot(0.5, 0.0, "bar1", "B"), Spot(0.8, 0.4))
    raw = parse_toml(after, "x")["bodies"]
    assert path == "bodies.bar2" and is_inserted(text, after)
    assert raw["bar2"] == {**raw["bar1"], "position": [0.4, 0.5]}
    with pytest.raises(InputError, match="a body whose position is in numbers"):
        added(text.replace("position = [0.1, 0.1]", 'position = ["pi", 0.1]'), "copy", Spot(0, 0, "bar1"), Spot(1, 1))


def test_a_spring_a_slide_and_a_load() -> None:
    end, other = Spot(8.4, 4.7, "rocker", "C"), Spot(12.0, 4.7)
    for kind, spots in (("spring", (end, other)), ("slide", (end,)), ("load", (end,))):
        after, path = added(FOUR_BAR, kind, *spots, angles={"rocker": 0.3})
        assert is_inserted(FOUR_BAR, after), kind
        validate(parse_toml(after, "x"), "x")
        assert path.endswith(f"{kind}1")
    assert parse_toml(added(FOUR_BAR, "spring", end, other)[0], "x")["forces"]["spring1"]["free_length"] == 3.6


@pytest.mark.parametrize(
    ("kind", "spots", "sentence"),
    [
        ("body", (Spot(0, 0),), "expected 2 to 3 points, got 1"),
        ("body", (Spot(0, 0), Spot(0, 0)), "points in different places"),
        ("pin", (Spot(0, 0), Spot(1, 0)), "'ground' twice"),
        ("spring", (Spot(0, 0, "crank", "A"), Spot(1, 0, "crank", "B")), "'crank' twice"),
        ("load", (Spot(0, 0),), "a point of a body"),
        ("motor", (Spot(0, 0, "crank", "A"),), "a pin, which it turns"),
        ("anchor", (Spot(0, 0),), "a part that can be added"),
        (
            "slide",
            (Spot(0, 0, "crank", "A", joint="A"),),
            "a point that can slide, got one that a pin holds on the ground",
        ),
        ("slide", (Spot(1, 0, "crank", "B"), Spot(1, 0)), "a direction"),
        ("weld", (Spot(0, 0, "crank", "A"), Spot(1, 0, "crank", "B")), "'crank' twice"),
        ("point", (Spot(0, 0), Spot(1, 0)), "a point of a body"),
        ("slot", (Spot(0, 0, "crank", "A", joint="A"),), "a point that can move along it"),
        ("rod", (Spot(0, 0, "crank", "A"), Spot(0, 0)), "points in different places"),
        ("gear", (Spot(0, 0, "crank", "A", joint="A"), Spot(1, 0)), "two pins on one body"),
        ("friction", (Spot(0, 0, "crank", "A"),), "a pin or a slide, got another point"),
    ],
)
def test_what_cannot_be_added(kind: str, spots: tuple[Spot, ...], sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        added(FOUR_BAR, kind, *spots)


def test_in_space_nothing_is_added_by_points() -> None:
    with pytest.raises(InputError, match="in the plane"):
        added(text_of("heavy-top"), "load", Spot(0, 0, "top", "tip"))


# -- names -------------------------------------------------------------------------------------------------------------

NAMED = """\
# crank drives; crank is a word here
[mechanism]
name = "crank"
title = "the crank"

[parameters]
arm = 1.0            # arm
arms = "2*arm"

[bodies.crank]
mass = "arm"
inertia = 0.1
points = { arm = ["arm", 0.0] }

[bodies."rod"]
mass = 1.0
inertia = 0.1
angular_velocity = "arm/2"

[joints.arm]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], "centre"]

[joints.knee]
type = "revolute"
between = ["crank", "rod"]
at = ["arm", ["-arm", 0.0]]

[forces.push]
type = "torque"
body = "crank"
torque = "-crank.omega*arm + rod.omega - arm.angle"

[events.turn]
when = "crank.arm.y < -0.5"
action = "reset"
reset = { "crank.omega" = "-0.5*crank.omega" }
"""


def lines_that_differ(before: str, after: str) -> list[str]:
    old, new = before.split("\n"), after.split("\n")
    assert len(old) == len(new)
    return [b for a, b in zip(old, new, strict=True) if a != b]


def test_a_body_is_renamed_wherever_it_is_named_and_nowhere_else() -> None:
    assert lines_that_differ(NAMED, rename_in_text(NAMED, "bodies.crank", "wheel", "x")) == [
        "[bodies.wheel]",
        'between = ["ground", "wheel"]',
        'between = ["wheel", "rod"]',
        'body = "wheel"',
        'torque = "-wheel.omega*arm + rod.omega - arm.angle"',
        'when = "wheel.arm.y < -0.5"',
        'reset = { "wheel.omega" = "-0.5*wheel.omega" }',
    ]


#: One formula in all forms that TOML has for texts: lines, tabs, escapes, both kinds of quotation marks.
FORMS = {
    "lines": '"""\nrod.x\n + 1"""',
    "literal lines": "'''rod.x\n\t+ 1'''",
    "a line that goes on": '"""rod.x \\\n   + 1"""',
    "carriage returns": '"""rod.x\r\n + 1"""',
    "a tab": '"rod.x +\t1"',
    "escapes": '"rod.x\\t+\\n1"',
    "a code point": '"rod.x + \\u0031"',
    "a literal": "'rod.x + 1'",
}
BROKEN = '[outputs]\nother = "nothing.x"\n'


@pytest.mark.parametrize("heading", ["[outputs]\n", BROKEN], ids=["a valid file", "a file with another error"])
@pytest.mark.parametrize("form", FORMS)
def test_a_formula_keeps_its_meaning_in_every_form_of_a_text(form: str, heading: str) -> None:
    text = (
        '[mechanism]\nname = "bob"\n[bodies.rod]\nmass = 1.0\ninertia = 0.1\n[joints.pin]\ntype = "revolute"\n'
        f'between = ["ground", "rod"]\nat = [[0.0, 0.0], [-1.0, 0.0]]\n{heading}far = {FORMS[form]}\n'
    )
    before = tomllib.loads(text)["outputs"]["far"]
    after = rename_in_text(text, "bodies.rod", "arm", "x")
    assert tomllib.loads(after)["outputs"]["far"] == before.replace("rod", "arm")
    problems = [len(collect_errors(parse_toml(each, "x"), "x")) for each in (text, after)]
    assert problems[0] == problems[1] == (heading is BROKEN)


def test_a_parameter_a_point_and_a_joint_of_one_name_are_told_apart() -> None:
    assert lines_that_differ(NAMED, rename_in_text(NAMED, "parameters.arm", "r", "x")) == [
        "r = 1.0            # arm",
        'arms = "2*r"',
        'mass = "r"',
        'points = { arm = ["r", 0.0] }',
        'angular_velocity = "r/2"',
        'at = ["arm", ["-r", 0.0]]',
        'torque = "-crank.omega*r + rod.omega - arm.angle"',
    ]
    assert lines_that_differ(NAMED, rename_in_text(NAMED, "bodies.crank.points.arm", "tip", "x")) == [
        'points = { tip = ["arm", 0.0] }',
        'at = ["tip", ["-arm", 0.0]]',
        'when = "crank.tip.y < -0.5"',
    ]
    assert lines_that_differ(NAMED, rename_in_text(NAMED, "joints.arm", "shaft", "x")) == [
        "[joints.shaft]",
        'torque = "-crank.omega*arm + rod.omega - shaft.angle"',
    ]


@pytest.mark.parametrize(
    ("path", "name", "sentence"),
    [
        ("bodies.crank", "rod", "a name that is free"),
        ("bodies.crank", "a b", "expected"),
        ("bodies.crank", "<b>", "expected"),
        ("bodies.wheel", "rim", "something that the file has, got 'wheel'"),
        ("mechanism.name", "x", "an entry of a section"),
        ("bodies.crank.mass", "x", "something|an entry"),
    ],
)
def test_names_that_are_refused(path: str, name: str, sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        rename_in_text(NAMED, path, name, "x")


def test_a_body_goes_with_its_joints_and_comments_stay_with_their_tables() -> None:
    text = FOUR_BAR.replace("[bodies.rocker]", "# the rocker\n# of steel\n[bodies.rocker]").replace(
        "[joints.A]", "# all pins\n\n# first\n[joints.A]"
    )
    after = remove_from_text(text, "bodies.rocker", "x")
    raw = parse_toml(after, "x")
    assert set(raw["bodies"]) == {"crank", "coupler"} and set(raw["joints"]) == {"A", "B"}
    assert "rocker" not in after.replace("rocker_mass", "") and "of steel" not in after
    assert "# all pins\n\n# first\n[joints.A]" in after
    assert set(after.split("\n")) <= set(text.split("\n"))


def test_a_parameter_goes_with_its_line_unless_it_is_needed() -> None:
    text = FOUR_BAR.replace("[parameters]\n", "[parameters]\nspare = 3.0  # of no use\n")
    assert remove_from_text(text, "parameters.spare", "x") == FOUR_BAR
    with pytest.raises(InputError, match="crank_mass"):
        remove_from_text(FOUR_BAR, "parameters.crank_mass", "x")


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "jansen-leg",
    "scissor-lift",
    "geneva",
    "klann-leg",
    "shaper",
    "engine",
    "toggle-press",
    "flexible-slider-crank",
    "dry-four-bar",
)
@pytest.mark.parametrize("name", [*catalogue.names(catalogue.MACHINES), "four-bar", "andrews", "flyball-governor"])
def test_every_body_and_joint_of_the_catalogue_can_be_renamed(name: str) -> None:
    text, source = text_of(name), Source.of_file(catalogue.file_of_entry(name))
    raw = parse_toml(text, name)
    for section in ("bodies", "joints"):
        for old in [*raw.get(section, {})][:3]:
            after = rename_in_text(text, f"{section}.{old}", "other_name", source)
            assert collect_errors(parse_toml(after, name), source) == ()
            assert rename_in_text(after, f"{section}.other_name", old, source) == text


# -- words -------------------------------------------------------------------------------------------------------------


def test_words_have_sentences() -> None:
    found = words_of_sections()
    sections = found["sections"]
    assert sections["bodies"]["keys"]["mass"] == "scalar. [kg], above 0."
    revolute = sections["joints"]["types"]["revolute"]
    assert revolute["text"].startswith("A pin that holds") and revolute["keys"]["at"].startswith(
        "pair of points. The pin"
    )
    assert set(sections["joints"]["types"]) >= {"revolute", "prismatic", "driver"}
    assert "N" in found["units"]
    for section in sections.values():
        tables = [section["keys"], *(kind["keys"] for kind in section.get("types", {}).values())]
        assert all(text for table in tables for key, text in table.items() if key != "type")


def test_a_body_takes_its_own_parameters_along_and_the_last_one_the_title() -> None:
    """Parameters that others read as well stay, and so do those that nothing read before."""
    text = (
        '[mechanism]\nname = "m"\ntitle = "two rods"\n\n[parameters]\nspare = 1.0\nboth = 2.0\nbase = 3.0\n'
        'mine = { value = "2*base", unit = "kg" }  # of a\n\n'
        '[bodies.a]\nmass = "mine"\ninertia = "both"\n\n[bodies.b]\nmass = 1.0\ninertia = "both"\n'
    )
    once = remove_from_text(text, "bodies.a", "x")
    assert parse_toml(once, "x")["parameters"] == {"spare": 1.0, "both": 2.0} and 'title = "two rods"' in once
    twice = parse_toml(remove_from_text(once, "bodies.b", "x"), "x")
    assert twice["parameters"] == {"spare": 1.0} and twice["mechanism"] == {"name": "m"}


def test_sentences_beside_completions_have_no_markup() -> None:
    assert "`" not in str(words_of_sections())
