"""Every mistake in a file gives one sentence that names the file, the key, what was expected and what was found."""

import copy
import re
import subprocess
import sys
import tomllib

import pytest

from symgen.base.errors import InputError
from symgen.describe.files.load import LARGEST_FILE, load_mechanism, parse_toml
from symgen.describe.files.validate import collect_errors, validate

GOOD = """
[mechanism]
name = "rod-pendulum"
gravity = [0.0, -9.81]

[parameters]
rod_mass = 2.0
length = 1.0

[tables.profile]
x = [0.0, 1.0]
y = [0.0, 1.0]

[bodies.rod]
mass = "rod_mass"
inertia = 0.5
points = { top = [-0.5, 0.0] }

[bodies.bob]
type = "point"
mass = 0.1

[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "top"]

[joints.string]
type = "distance"
between = ["rod", "bob"]
at = ["centre", "centre"]
length = 0.5

[forces.motor]
type = "torque"
body = "rod"
torque = "0.5*sin(t)"
"""

GONE = object()
SLIDE = {"type": "translational", "between": ["ground", "rod"], "at": [[0.0, 0.0], "top"], "axis": [1.0, 0.0]}
GEARS = {"type": "gear", "between": ["rod", "ground"], "carrier": "ground", "ratio": 2.0}
SPRING = {"type": "spring-damper", "between": ["ground", "rod"], "at": [[0.0, 0.0], "top"], "stiffness": 1.0}

CASES = [
    ("mechansim", {}, "the unknown section 'mechansim'; did you mean 'mechanism'?"),
    ("mechanism", GONE, "mechanism: expected a section [mechanism] with a name, got no such section"),
    ("mechanism.name", GONE, "mechanism.name: expected a text, got no such key"),
    ("mechanism.name", 3, "mechanism.name: expected a text, got 3"),
    ("mechanism.name", "Four Bar", "such as 'four-bar', got 'Four Bar'; for example 'four-bar'"),
    ("mechanism.name", "a" * 65, "expected lower-case words joined by dashes"),
    ("mechanism.space", "spatal", "mechanism.space: expected 'planar' or 'spatial', got 'spatal'"),
    ("mechanism.space", "spatial", "mechanism.gravity: expected three numbers or expressions of parameters [x, y, z]"),
    ("mechanism.gravity", [0.0], ": expected two numbers or expressions of parameters [x, y], got [0.0]"),
    ("mechanism.gravity", [0.0, float("nan")], "mechanism.gravity: expected a finite number, got nan"),
    ("mechanism.gravity", 9.81, ": expected two numbers or expressions of parameters [x, y], in space three"),
    ("mechanism.nam", "x", "got the unknown key 'nam'; did you mean 'name'?"),
    ("parameters", 3, "parameters: expected a table of parameters, one entry a name, got 3"),
    ("parameters.t", 1.0, "parameters: expected a parameter name that has no meaning of its own, got 't'; 't_'"),
    ("outputs.t", "t", "expected an output name that has no meaning of its own, got 't'"),
    ("parameters.s", 1.0, "expected a parameter name that has no meaning of its own, got 's'"),
    ("parameters.lambda", 1.0, "expected a parameter name that has no meaning of its own, got 'lambda'"),
    ("parameters._a", 1.0, "of letters, digits and _, a letter first, got '_a'; for example 'a'"),
    ("parameters.__class__", 1.0, "of letters, digits and _, a letter first, got '__class__'"),
    ("parameters.é", 1.0, "of letters, digits and _, a letter first, got 'é'"),
    ('parameters.x"]; import os', 1.0, "of letters, digits and _, a letter first, got 'x\"]; import os'"),
    ("parameters.a\nb", 1.0, "of letters, digits and _, a letter first, got 'a\\nb'; for example 'a_b'"),
    ("parameters." + "a" * 65, 1.0, "expected a parameter name of at most 64 characters, got 65 characters"),
    ("parameters.x", "2*rod_mas", ": expected a number or an expression of parameters, got the unknown name"),
    ("parameters.x", "2*t", ": expected a number or an expression of parameters, got 't', which has no mean"),
    ("parameters.x", "profile(1)", ": expected a number or an expression of parameters, got the table 'pro"),
    ("parameters.x", "x/2", ": expected a formula that does not lead back to its own parameter, got x -> x"),
    ("parameters.rod_mass", {"value": "1/(length - 1)"}, "parameters.rod_mass: expected a finite number, got '1.0/(le"),
    ("parameters.x", "1e308*(length + 9)", "parameters.x: expected a finite number, got '1e+308*(length + 9.0)' = "),
    ("parameters.x", "sqrt(-length)", ": expected a finite number, got 'sqrt(-length)' = sqrt(-1.0)"),
    ("parameters.x", "1/0", ": expected a number or an expression of parameters, got '1.0/0.0', which has"),
    ("parameters.x", float("inf"), "parameters.x: expected a finite number, got inf"),
    ("parameters.x", 10**400, ": expected a number or an expression of parameters, got an integer beyond 1e18"),
    ("parameters.x", True, "parameters.x: expected a number or an expression of parameters, got true"),
    (
        "parameters.x",
        {"valu": 1.0},
        "parameters.x: expected the keys value, unit, note, smallest, largest, got the unknown key 'valu'",
    ),
    ("parameters.x", {"unit": "kg"}, "parameters.x.value: expected a number or an expression of parameters"),
    ("parameters.profile", 1.0, "tables.profile: expected a name used once, got 'profile', which is a parameter"),
    ("tables.f", {"x": [0.0], "y": [1.0]}, "tables.f.x: expected two numbers or more, got 1"),
    ("tables.f", {"x": [0.0, 0.0], "y": [1.0, 2.0]}, "tables.f.x: expected increasing numbers, got 0.0 after 0.0"),
    ("tables.f", {"x": [0.0, 1.0], "y": [1.0]}, "tables.f.y: expected as many numbers as x has, 2, got 1"),
    ("tables.f", {"x": [0.0, float("nan")], "y": [1.0, 2.0]}, "tables.f.x: expected finite numbers, got nan"),
    ("tables.f", {"x": [0.0, "a"], "y": [1.0, 2.0]}, "tables.f.x: expected a list of numbers, got 'a'"),
    ("run.until", 0.0, "run.until: expected a number above 0, got 0.0"),
    ("run.step", float("nan"), "run.step: expected a number above 0, got nan"),
    ("run.until", float("inf"), "run.until: expected a finite number, got inf"),
    ("run.step", 20.0, "run.step: expected at most until = 10.0, got 20.0"),
    ("run.steps", 1, "got the unknown key 'steps'; did you mean 'step'?"),
    ("bodies", {}, "bodies: expected at least one body, [bodies.NAME], got none"),
    ("bodies.rod", 3, "bodies.rod: expected a table, got 3"),
    ("bodies.ground", {"mass": 1.0}, "bodies: expected a body name that has no meaning of its own, got 'ground'"),
    ("bodies.pin", {"type": "point", "mass": 1.0}, "joints.pin: expected a name used once, got 'pin', which is a body"),
    ("bodies.rod.mass", GONE, "bodies.rod.mass: expected a number or an expression of parameters, got no such key"),
    ("bodies.rod.mass", "rod_mass - 2", "bodies.rod.mass: expected a value above 0, got 0.0"),
    ("bodies.rod.mass", "rodmass", "got the unknown name 'rodmass'; did you mean 'rod_mass'?"),
    ("bodies.rod.mass", "rod.x", "expected a number or an expression of parameters, got 'rod.x', which has no meaning"),
    ("bodies.rod.mass", [1.0], "bodies.rod.mass: expected a number or an expression of parameters, got [1.0]"),
    ("bodies.rod.mass", "__import__('os').getpid()", ": expected a number or an expression of parameters"),
    ("bodies.rod.inertia", GONE, 'got no such key; a body without one is written type = "point"'),
    ("bodies.rod.inertia", -1.0, "bodies.rod.inertia: expected a value above 0, got -1.0"),
    ("bodies.rod.type", "pont", "bodies.rod.type: expected 'rigid' or 'point', got 'pont'"),
    ("bodies.rod.type", "point", "bodies.rod.inertia: expected no such key, as a point mass has none, got 0.5"),
    ("bodies.rod.points", {"a": [1.0]}, "bodies.rod.points.a: expected two numbers or expressions of parameters"),
    ("bodies.rod.points", {"a": [1.0, "q"]}, "bodies.rod.points.a: expected a number or an expression of parameters"),
    ("bodies.rod.points", {"centre": [1.0, 0.0]}, "got 'centre', which is the centre of mass"),
    ("bodies.rod.points", [1], ": expected a table of points, name = [x, y] or [x, y, z] in the body's frame, got [1]"),
    ("bodies.rod.angle", "1/(rod_mass - 2)", "bodies.rod.angle: expected a finite number, got '1.0/(rod_mass - 2.0)'"),
    ("bodies.rod.velocity", ["1/(rod_mass - 2)", 0.0], ": expected a finite number, got '1.0/(rod_mass"),
    ("joints.pin", [], "joints.pin: expected a table, got []"),
    ("joints.pin.type", GONE, "joints.pin.type: expected a joint type, got no such key"),
    ("joints.pin.type", "revolut", ": expected a joint type, got 'revolut'; did you mean 'revolute'? (known:"),
    ("joints.pin.type", "../../os", "joints.pin.type: expected a joint type, got '../../os'; known: "),
    ("joints.pin.between", ["ground"], "expected the names of two bodies, one of which may be 'ground'"),
    ("joints.pin.between", ["ground", "rodd"], "got the unknown body 'rodd'; did you mean 'rod'?"),
    ("joints.pin.between", ["rod", "rod"], "joints.pin.between: expected two different bodies, got 'rod' twice"),
    ("joints.pin.at", [[0.0, 0.0], "tip"], "got 'tip', which is no point of 'rod'; did you mean 'top'?"),
    ("joints.pin.at", ["O", "top"], "joints.pin.at: expected coordinates [x, y] of a point of the ground, got 'O'"),
    ("joints.pin.at", [[0.0, True], "top"], "expected two points, one of each body: a name, 'centre' or coordinates"),
    ("joints.pin.at", GONE, "joints.pin.at: expected two points, one of each body"),
    ("joints.pin.cut", "yes", "joints.pin.cut: expected true or false, got"),
    ("joints.string.cut", True, "joints.string.cut: expected a joint that can carry a body, got a distance joint"),
    (
        "joints.pin.att",
        1,
        "joints.pin: got the unknown key 'att'; did you mean 'at'? (expected the keys type, start, cut, "
        "rotor_inertia, gear_ratio, holds, holds_at, clearance, friction, stop, between, at, axis, reference)",
    ),
    ("joints.string.length", 0.0, "joints.string.length: expected a value above 0, got 0.0"),
    ("joints.string.at", ["centre", [0.1, 0.0]], "expected 'centre' or [0, 0], the one point of the point mass 'bob'"),
    ("joints.weld", SLIDE | {"between": ["rod", "bob"], "at": ["top", "centre"]}, "got the point mass 'bob'"),
    ("joints.slide", SLIDE | {"axis": [0.0, 0.0]}, "joints.slide.axis: expected a direction, got a vector of length 0"),
    (
        "joints.slide",
        SLIDE | {"axis": 1.0},
        "joints.slide.axis: expected a direction [x, y], in space [x, y, z] or two such, one in the frame of "
        "each body, got 1.0",
    ),
    ("joints.gears", GEARS, "joints.gears.carrier: expected a body that is neither wheel, got 'ground'"),
    ("joints.gears", GEARS | {"mesh": "outer"}, "joints.gears.mesh: expected 'external' or 'internal', got 'outer'"),
    ("joints.drive", {"type": "driver", "value": "t"}, ": expected either the key joint or the key body"),
    (
        "joints.drive",
        {"type": "driver", "joint": "pn", "value": "t"},
        "joints.drive.joint: expected the name of a joint, got the unknown joint 'pn'; did you mean 'pin'?",
    ),
    (
        "joints.drive",
        {"type": "driver", "joint": "drive", "value": "t"},
        "joints.drive.joint: expected a joint that stands by itself, got 'drive', which leads back to this one",
    ),
    (
        "joints.drive",
        {"type": "driver", "joint": "string", "value": "t"},
        "joints.drive.joint: expected a joint that has a coordinate, got 'string', a distance joint without",
    ),
    (
        "joints.drive",
        {"type": "driver", "joint": "pin", "coordinate": "displacement", "value": "t"},
        "joints.drive.coordinate: expected a coordinate of joint 'pin', got 'displacement'; known: angle",
    ),
    (
        "joints.drive",
        {"type": "driver", "body": "bob", "coordinate": "theta", "value": "t"},
        "joints.drive.coordinate: expected 'x' or 'y', got 'theta'",
    ),
    (
        "joints.drive",
        {"type": "driver", "joint": "pin", "value": "profile(t)"},
        "joints.drive.value: expected a number or an expression of t and parameters, got the table 'profile'",
    ),
    ("forces.motor.type", "torqe", "forces.motor.type: expected a force type, got 'torqe'; did you mean 'torque'?"),
    ("forces.motor.body", "ground", "forces.motor.body: expected a body that moves, got 'ground'"),
    ("forces.motor.body", "bob", ": expected a body with an angle for 'torque', got the point mass 'bob'"),
    (
        *("forces.motor.torque", "rod.alpha"),
        "got 'rod.alpha', which follows from all forces and may depend on this formula, a circle",
    ),
    ("forces.motor.torque", "lambda: 1", "got the word 'lambda' at column 1"),
    ("forces.motor.torque", "rod.__class__", "got the character '_' at column 5"),
    ("forces.motor.potential", "angle*t", "expected an expression of parameters and angle, got 't', which has"),
    (
        "forces.spring",
        SPRING | {"actuator": "length - 1"},
        "forces.spring.actuator: expected 'length' to mean the element's own, got 'length', which is a parameter too; "
        "rename the parameter",
    ),
    ("forces.push", {"type": "force", "body": "rod"}, "expected either the key force or the key potential"),
    (
        "forces.push",
        {"type": "force", "body": "bob", "force": [1.0, 0.0], "frame": "body"},
        "forces.push.body: expected a body with an angle for 'force', got the point mass 'bob'",
    ),
]


def changed(path, value):
    raw = copy.deepcopy(tomllib.loads(GOOD))
    *sections, last = path.split(".", 2)
    table = raw
    for section in sections:
        table = table.setdefault(section, {})
    if value is GONE:
        del table[last]
    else:
        table[last] = value
    return raw


def test_the_file_that_is_changed_is_good():
    assert validate(tomllib.loads(GOOD), "rod.toml").name == "rod-pendulum"


@pytest.mark.parametrize(("path", "value", "sentence"), CASES, ids=[f"{i}-{c[0][:40]!r}" for i, c in enumerate(CASES)])
def test_one_sentence(path, value, sentence):
    """A sentence that begins with a colon stands behind its own key."""
    sentence = path + sentence if sentence.startswith(":") else sentence
    with pytest.raises(InputError) as error:
        validate(changed(path, value), "rod.toml")
    message = str(error.value)
    assert message.startswith("rod.toml: ")
    assert re.search(r": expected .*, got |: got .*; did you mean .* \(expected ", message)
    assert sentence in message
    assert "\n" not in message
    assert error.value.exit_code == 2
    first, *others = map(str, collect_errors(changed(path, value), "rod.toml"))
    assert first == message
    assert not others or path == "mechanism.space"  # in the other space more of the file is wrong


# Files ----------------------------------------------------------------------------------------------------


def write(tmp_path, content):
    path = tmp_path / "rod.toml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("[mechanism", "rod.toml: expected ']' at the end of a table's name, got '[mechanism' (at line 1, column 11)"),
        ("[a]\n[a]\n", "rod.toml: expected one table [a], got a second one (at line 2"),
        (GOOD + "\n[joints.pin]\n", "expected one table [joints.pin], got a second one (at line 39"),
        (b"\xff\xfe", "rod.toml: expected text in UTF-8, got another byte at position 0"),
        ("a = " + "[" * 5000 + "]" * 5000, "expected tables nested at most 20 levels deep, got deeper nesting"),
        ("a = " + "[" * 30 + "]" * 30, "expected tables nested at most 20 levels deep, got deeper nesting"),
        ("#" * (LARGEST_FILE + 1), "rod.toml: expected a file of at most 1000000 bytes, got a larger one"),
        ("a = " + "9" * 5000, "rod.toml: expected whole numbers of at most 4300 digits, got a longer one"),
        ("[mechanism]\nname = 2001-01-01", "rod.toml: mechanism.name: expected a text, got a date"),
        ("", "rod.toml: mechanism: expected a section [mechanism] with a name, got no such section"),
    ],
)
def test_files_that_cannot_be_read(tmp_path, content, sentence):
    with pytest.raises(InputError) as error:
        load_mechanism(write(tmp_path, content))
    assert sentence in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("model", "sentence"),
    [
        ("four-bars", "model: expected a catalogue name or the path of a file, got 'four-bars'"),
        ("n-four-bar:0", "model: expected a size of 'n-four-bar' from 1 to 5000, got 0"),
        ("n-four-bar:999999", "model: expected a size of 'n-four-bar' from 1 to 5000, got 999999"),
        ("n-four-bar:x", "got 'n-four-bar:x'; a size is written as in 'chain:4'"),
        ("four-bar:3", "model: expected 'four-bar' without a size, got 'four-bar:3'"),
        ("nowhere/rod.toml", "expected a catalogue name or the path of a file, got 'nowhere/rod.toml'"),
        ("x" * 5000, "expected a catalogue name or the path of a file, got 'xxx"),
        ("a\0b", "expected a catalogue name or the path of a file, got 'a\\x00b'"),
        ("", "expected a catalogue name or the path of a file, got ''"),
    ],
)
def test_models_that_do_not_exist(model, sentence):
    with pytest.raises(InputError) as error:
        load_mechanism(model)
    assert sentence in str(error.value)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"crank_mas": 1.0}, "parameters: expected the name of a parameter, got the unknown parameter 'crank_mas'"),
        ({"crank_mass": 0.0}, "four-bar: bodies.crank.mass: expected a value above 0, got 0.0"),
        ({"crank_mass": float("nan")}, "four-bar: parameters.crank_mass: expected a finite number, got nan"),
    ],
)
def test_other_values_are_checked_as_the_files_are(values, sentence):
    with pytest.raises(InputError) as error:
        load_mechanism("four-bar", values)
    assert sentence in str(error.value)
    with pytest.raises(InputError, match=r"'x'; it has no parameters$"):
        load_mechanism("n-four-bar", {"x": 1.0})


def test_injected_text_is_never_run(tmp_path):
    marker = tmp_path / "ran"
    attack = f"__import__('pathlib').Path('{marker}').touch()"
    for path in ("forces.motor.torque", "bodies.rod.mass", "parameters.x", "joints.string.length"):
        with pytest.raises(InputError):
            validate(changed(path, attack), "rod.toml")
    for path in ("bodies", "joints", "forces", "parameters"):
        with pytest.raises(InputError):
            validate(changed(f"{path}.{attack}", 1.0), "rod.toml")
    assert not marker.exists()


def test_a_huge_formula_costs_nothing(tmp_path):
    text = GOOD.replace("0.5*sin(t)", "(" * 400_000)
    code = (
        "import resource, sys\nresource.setrlimit(resource.RLIMIT_AS, (400_000_000,) * 2)\n"
        "from symgen.describe import load\nfrom symgen.base.errors import InputError\n"
        "try: load(sys.argv[1])\nexcept InputError as error: print(error)"
    )
    result = subprocess.run(
        [sys.executable, "-c", code, write(tmp_path, text)], capture_output=True, text=True, check=True
    )
    assert "forces.motor.torque: expected a formula of at most 10000 characters" in result.stdout


def test_text_from_elsewhere_gets_its_own_source():
    with pytest.raises(InputError, match=r"^typed in: "):
        parse_toml("[", "typed in")
