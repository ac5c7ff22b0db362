"""What is wrong in a mechanism file: everything, each with its place, without what only follows."""

import pickle
import re
import tomllib

import pytest

from symgen.base.errors import InputError
from symgen.describe.files.load import LARGEST_FILE, load_mechanism
from symgen.describe.files.problems import problems_of_text, sentence_with_line
from symgen.describe.files.validate import collect_errors, validate

GOOD = """\
[mechanism]
name = "cart"

[parameters]
mass = 2.0
half = "mass/2"
quarter = "half/2"

[tables.road]
x = [0.0, 1.0]
y = [0.0, 1.0]

[bodies.cart]
mass = "mass"
inertia = 0.1
points.hook = [
  "quarter",
  0.0,
]

[bodies.load]
mass = 1.0
inertia = 0.1

[joints.rail]
type = "translational"
between = ["ground", "cart"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]

[joints.pin]
type = "revolute"
between = ["cart", "load"]
at = ["hook", "centre"]

[joints.mesh]
type = "coupling"
terms = { pin = 1.0, wheel = -1.0 }

[joints.wheel]
type = "revolute"
between = ["ground", "load"]
at = [[0.0, 0.0], "centre"]

[forces.push]
type = "force"
body = "cart"
at = "centre"
force = ["road(cart.x)", 0.0]

[states.heat]
rate = "cart.vx"

[outputs]
"far" = "load.x"
warm = "heat"

[events.low]
when = "load.y < -1"
reset = { "load.vy" = "-load.vy" }
"""


def found(text):
    return [(problem.line, problem.where) for problem in problems_of_text(text, "cart.toml")]


def changed(*changes):
    text = GOOD
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return text


def test_nothing_is_wrong_with_a_good_file():
    assert problems_of_text(GOOD, "cart.toml") == ()


ONE = {
    "a parameter that others need": (("mass = 2.0", 'mass = "weight"'), (5, "parameters.mass")),
    "formulas in a circle": (("mass = 2.0", 'mass = "quarter"'), (5, "parameters.mass")),
    "a key of a parameter": (("mass = 2.0", "mass = { value = 2.0, units = 'kg' }"), (5, "parameters.mass")),
    "a name": (("mass = 2.0", '"my mass" = 2.0\nmass = 2.0'), (5, "parameters")),
    "a table that a force reads": (("x = [0.0, 1.0]", "x = [1.0, 0.0]"), (10, "tables.road.x")),
    "a point over several lines": (("0.0,\n]", "0.0, 0.0,\n]"), (16, "bodies.cart.points.hook")),
    "a key that is missing": (("[bodies.load]\nmass = 1.0", "[bodies.load]"), (21, "bodies.load.mass")),
    "an unknown key": (("[bodies.load]\nmass = 1.0", "[bodies.load]\nmass = 1.0\nmas = 1.0"), (23, "bodies.load")),
    "a joint that another one needs": (('at = ["hook", "centre"]', 'at = ["hok", "centre"]'), (34, "joints.pin.at")),
    "a quoted key": (('"far" = "load.x"', '"far" = "load.q"'), (55, "outputs.far")),
    "a state that an output reads": (('rate = "cart.vx"', 'rate = "cart.vq"'), (52, "states.heat.rate")),
    "a key with a dot": (('"-load.vy"', '"-load.vz"'), (60, "events.low.reset.load.vy")),
    "an unknown section": (("[bodies.load]", "[body.load]"), (21, "")),
    "another space by its key": (('name = "cart"', 'name = "cart"\nspac = "spatial"'), (3, "mechanism")),
    "an unknown space": (('name = "cart"', 'name = "cart"\nspace = "flat"'), (3, "mechanism.space")),
    "a table that is a number": (('[states.heat]\nrate = "cart.vx"', "[states]\nheat = 1.0"), (52, "states.heat")),
}


@pytest.mark.parametrize("change", ONE)
def test_one_mistake_is_one_problem_with_its_line(change):
    """What needs something that is wrong is no problem of its own."""
    (old, new), expected = ONE[change]
    assert found(changed((old, new))) == [expected]


def test_mistakes_in_all_kinds_of_tables_are_found_at_once():
    changes = (
        ("mass = 2.0", "mass = 2.0\nspare = true"),
        ("x = [0.0, 1.0]", "x = [0.0]"),
        ("[bodies.cart]", "[bodies.cart]\nhold = 'all'"),
        ("[bodies.load]", "[bodies.load]\nshape = { type = 'ball' }"),
        ("axis = [1.0, 0.0]", "axis = [1.0, 0.0]\nfriction = { sliding = -1.0 }"),
        ("terms = { pin = 1.0, wheel = -1.0 }", "terms = { pinn = 1.0, wheel = -1.0 }"),
        ('at = "centre"\nforce', 'at = "center"\nforce'),
        ('rate = "cart.vx"', 'rates = "cart.vx"'),
        ('"load.x"', '"load.X"'),
        ("[events.low]", "[run]\nuntil = -1.0\n[stops.floor]\ngap = 'load.z'\n[events.low]"),
        ('when = "load.y < -1"', 'when = "load.z < -1"'),
    )
    assert found(changed(*changes)) == [
        (6, "parameters.spare"),
        (11, "tables.road.x"),
        (15, "bodies.cart.hold"),
        (24, "bodies.load.shape.type"),
        (33, "joints.rail.friction.sliding"),
        (42, "joints.mesh.terms.pinn"),
        (52, "forces.push.at"),
        (56, "states.heat"),
        (59, "outputs.far"),
        (63, "run.until"),
        (65, "stops.floor.gap"),
        (67, "events.low.when"),
    ]


FORMULAS = """\
[mechanism]
name = "wrong"

[parameters]
a = 1.0

[bodies.rod]
mass = 1.0
inertia = 1.0

[joints.pin]   # joints tell all of theirs, and friction and stops in them
type = "revolute"
between = ["ground", "rod"]
at = [["ux", "a"], ["vx", "vy"]]
friction = { sliding = "fr" }

[joints.slide]
type = "translational"
between = ["ground", "rod"]
at = [["wx", 0.0], ["a", 0.0]]
axis = ["q1", "q2"]
angle = "q3"

[joints.turn]
type = "driver"
joint = "pin"
value = "w1*t"

[forces.spring]
type = "spring-damper"
between = ["ground", "rod"]
at = [["s1", 0.0], ["s2", "s3"]]
stiffness = "k1"
damping = "c1"

[forces.push]
type = "force"
body = "rod"
at = ["f1", "a"]
force = ["f2", "f3*t"]
"""


def test_all_wrong_formulas_of_a_table_are_told_at_once():
    problems = problems_of_text(FORMULAS, "wrong.toml")
    told = [(p.line, p.where, re.findall(r"unknown name '(\w+)'", p.got)) for p in problems]
    assert told == [
        *((14, "joints.pin.at", [name]) for name in ("ux", "vx", "vy")),
        (15, "joints.pin.friction.sliding", ["fr"]),
        (20, "joints.slide.at", ["wx"]),
        *((21, "joints.slide.axis", [name]) for name in ("q1", "q2")),
        (22, "joints.slide.angle", ["q3"]),
        (27, "joints.turn.value", ["w1"]),  # though the pin that it turns is wrong
        *((32, "forces.spring.at", [name]) for name in ("s1", "s2", "s3")),
        (33, "forces.spring.stiffness", ["k1"]),
        (34, "forces.spring.damping", ["c1"]),
        (39, "forces.push.at", ["f1"]),
        *((40, "forces.push.force", [name]) for name in ("f2", "f3")),
    ]


def test_components_of_gravity_and_drivers_of_wrong_pins_are_told_at_once():
    """What a driver says by itself does not wait for the joint that it drives."""
    text = """\
[mechanism]
name = "arm"
gravity = ["gx", "gy"]
[bodies.arm]
mass = 1.0
inertia = 1.0
[joints.pin]
type = "revolut"
between = ["ground", "arm"]
at = [[0.0, 0.0], "centre"]
[joints.motor]
type = "driver"
joint = "pin"
value = "2 * t + offset"
"""
    places = [(3, "mechanism.gravity"), (3, "mechanism.gravity"), (8, "joints.pin.type"), (14, "joints.motor.value")]
    assert found(text) == places
    assert found(text.replace(" + offset", "").replace("revolut", "revolute")) == places[:2]


def test_problems_say_what_errors_say():
    text = changed(("mass = 2.0", "mass = true"), ("[bodies.load]\nmass = 1.0", "[bodies.load]\nmass = [1.0]"))
    errors = collect_errors(tomllib.loads(text), "cart.toml")
    assert [f"cart.toml: {problem}" for problem in problems_of_text(text, "cart.toml")] == list(map(str, errors))
    assert len(errors) == 2
    with pytest.raises(InputError) as first:
        validate(tomllib.loads(text), "cart.toml")
    assert str(first.value) == str(errors[0])


def test_places_are_those_of_keys_and_values():
    (problem,) = problems_of_text(changed(('force = ["road(cart.x)", 0.0]', "force = { x = 1.0 }")), "cart.toml")
    assert problem.place.key == (49, 1, len("force"))
    assert problem.place.value == (49, 9, len("{ x = 1.0 }"))


BEAMS = """\
[mechanism]
name = "arm"

[beams.arm]
start = [0.0, 0.0]
end = [1.0, 0.0]
elements = 4
axial = 1000.0
bending = 1.0
mass = 0.5
rotary = 0.01

[forces.load]
type = "force"
body = "arm.end"
at = "centre"
force = [0.0, -1.0]
"""


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("bending = 1.0", "bending = 0.0", (9, "forces.arm.e1.bending")),
        ("axial = 1000.0", "axial = []", (8, "beams.arm.axial")),
        ("elements = 4", "element = 4", (7, "beams.arm")),
        ('"arm.end"', '"arm.nd"', (15, "forces.load.body")),
    ],
)
def test_elements_of_beams_have_the_places_of_the_beam(old, new, expected):
    assert problems_of_text(BEAMS, "arm.toml") == ()
    assert BEAMS.count(old) == 1
    assert found(BEAMS.replace(old, new)) == [expected]


# Sentences with lines -------------------------------------------------------------------------------------


@pytest.fixture
def wrong(tmp_path):
    path = tmp_path / "cart.toml"
    path.write_text(changed(("[bodies.load]\nmass = 1.0", "[bodies.load]\nmass = -1.0")))
    return path


def test_an_error_has_its_line_where_it_is_printed(wrong):
    with pytest.raises(InputError) as error:
        load_mechanism(wrong)
    assert str(error.value) == "cart.toml: bodies.load.mass: expected a value above 0, got -1.0"
    assert sentence_with_line(error.value) == "cart.toml:22: bodies.load.mass: expected a value above 0, got -1.0"


@pytest.mark.parametrize("later", [GOOD.replace("[mechanism]", "[mechanism"), b"\xff", "#" * (LARGEST_FILE + 1), None])
def test_an_error_keeps_its_sentence_where_the_file_was_changed(wrong, later):
    with pytest.raises(InputError) as error:
        load_mechanism(wrong)
    if later is None:
        wrong.unlink()
    else:
        wrong.write_bytes(later if isinstance(later, bytes) else later.encode())
    assert sentence_with_line(error.value) == str(error.value)


def test_errors_of_other_sources_have_no_file(tmp_path):
    with pytest.raises(InputError) as error:
        validate(tomllib.loads(GOOD.replace("mass = 1.0", "mass = -1.0")), "cart.toml")
    assert error.value.file is None
    assert sentence_with_line(error.value) == str(error.value)


def test_the_key_of_an_error_survives_pickling():
    error = pickle.loads(pickle.dumps(InputError("a.toml: b", "c", "d", "e", "f")))
    assert (error.where, error.expected, error.got, error.hint, error.key) == ("a.toml: b", "c", "d", "e", "f")


def test_all_keys_of_a_table_are_told_at_once_and_a_missing_section_at_the_end() -> None:
    text = (
        '[mechanism]\nname = "two"\n\n[parameters]\nm = 1.0\n\n[bodies.a]\n'
        "mas = 1.0\ninertia = true\npositon = [0.0, 0.0]\n"
        '\n[bodies.b]\nmass = "mm"\ninertia = "2*"\npoints = { A = ["q", 0.0] }\nposition = ["1/0", 0.0]\n'
    )
    found = problems_of_text(text, "two.toml")
    assert [problem.line for problem in found] == [8, 9, 10, 13, 14, 15, 16]
    assert "no such key" not in "".join(map(str, found))  # what was misspelled is wrong once
    (missing,) = problems_of_text('[mechanism]\nname = "none"\n\n# nothing yet\n', "none.toml")
    assert missing.line == 4 and missing.has_place and str(missing).startswith("bodies: expected at least one body")
