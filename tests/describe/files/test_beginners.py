"""Mistakes that beginners make, each with the sentence that says what was meant."""

import subprocess
import sys

import pytest

from symgen.api import load
from symgen.base.errors import AssemblyError, InputError
from symgen.describe.files.problems import sentence_with_line

CRANE = """\
[mechanism]
name = "crane"
gravity = [0.0, -9.81]

[bodies.boom]
mass = "12 kg"
inertia = "4 kg m^2"
points = { root = [-1.0, 0.0], tip = [1.0, 0.0] }
position = [1.0, 0.0]
angle = "0 deg"

[bodies.weight]
mass = 40.0
inertia = 0.5
position = [2.0, -1.0]
points = { eye = [0.0, 1.0] }

[joints.base]
type = "revolute"
between = ["ground", "boom"]
at = [[0.0, 0.0], "root"]

[joints.hook]
type = "revolute"
between = ["boom", "weight"]
at = ["tip", "eye"]

[forces.wind]
type = "torque"
body = "boom"
torque = "3*sin(t)"
"""
HINGE = 'type = "revolute"\nbetween = ["ground"'
#: What is replaced, what by, and what the sentence says; the first words are the line.
SLIPS = {
    "decimal comma": ('"12 kg"', "12,0", ":6: expected a decimal point, got '12,0' (at", "did you mean 12.0?"),
    "unit without quotes": ('"12 kg"', "12 kg", ":6: expected a number with its unit in", 'did you mean "12 kg"?'),
    "power of numbers": ('"4 kg m^2"', '"2^2/12"', ":7: bodies.boom.inertia", "a power of a number is written **"),
    "power in a formula": ("3*sin(t)", "3*t^2", ":31: forces.wind.torque", "a power is written **"),
    "no sign of a product": ("3*sin(t)", "3sin(t)", ":31: forces.wind.torque", "a product is written with *"),
    "colon": ('mass = "12 kg"', "mass: 12", ":6: expected KEY = VALUE", "did you mean 'mass = 12'?"),
    "semicolon": ("inertia = 0.5", "inertia = 0.5;", ":14: expected nothing after", "lines end without a semicolon"),
    "comment of C": ("inertia = 0.5", "inertia = 0.5 // disc", ":14: expected a comment", "did you mean '# disc'?"),
    "comment of Matlab": ("inertia = 0.5", "inertia = 0.5 % disc", ":14: expected a comment", "did you mean '# disc'?"),
    "True": ("inertia = 0.5", "inertia = 0.5\nguided = True", ":15: expected true or false", "did you mean true?"),
    "curly quotes": ('"torque"', "“torque”", ":29: expected straight quotation", 'did you mean "torque"?'),
    "text without quotes": ('"torque"', "torque", ":29: expected a text in quotation", 'did you mean "torque"?'),
    "names without quotes": ('["ground", "boom"]', "[ground, boom]", ":20: expected texts", '["ground", "boom"]?'),
    "open quotes": ('"3*sin(t)"', '"3*sin(t)', ":31: expected a closing quotation mark", "between two of them"),
    "name with a blank": ("[bodies.weight]", "[bodies.big weight]", ":12: expected a name", "'[bodies.big_weight]'?"),
    "open header": ("[mechanism]", "[mechanism", ":1: expected ']' at the end", "did you mean '[mechanism]'?"),
    "table twice": (
        "[forces.wind]",
        "[bodies.boom]",
        ":28: expected one table [bodies.boom]",
        "first one is at line 5",
    ),
    "key twice": ("inertia = 0.5", "inertia = 0.5\ninertia = 1", ":15: expected each key once", "one of the two lines"),
    "hinge": (HINGE, HINGE.replace("revolute", "hinge"), ":19: joints.base.type", "did you mean 'revolute'? (known:"),
    "slider": (HINGE, HINGE.replace("revolute", "slider"), ":19: joints.base.type", "did you mean 'translational'?"),
    "weld": (HINGE, HINGE.replace("revolute", "weld"), ":19: joints.base.type", "did you mean 'rigid'?"),
    "motor": (HINGE, HINGE.replace("revolute", "motor"), ":19: joints.base.type", "did you mean 'driver'?"),
    "spring": ('"torque"\nbody', '"spring"\nbody', ":29: forces.wind.type", "did you mean 'spring-damper'?"),
    "section": ("[forces.wind]", "[force.wind]", ":28: ", "got the unknown section 'force'; did you mean 'forces'? ("),
    "key": ('mass = "12 kg"', 'mas = "12 kg"', ":6: bodies.boom: got the unknown key", "did you mean 'mass'? (expec"),
    "Ground": ('["ground"', '["Ground"', ":20: joints.base.between", "did you mean 'ground'?"),
    "body": ('"weight"]', '"wieght"]', ":25: joints.hook.between", "did you mean 'weight'?"),
    "point": ('["tip"', '["top"', ":26: joints.hook.at", "did you mean 'tip'?"),
    "unit": ("12 kg", "12 kgs", ":6: bodies.boom.mass", "did you mean 'kg'?"),
    "other unit": ("12 kg", "12 m", ":6: bodies.boom.mass: expected a unit such as kg", "got 'm'"),
    "function": ("3*sin(t)", "3*Sin(t)", ":31: forces.wind.torque", "did you mean 'sin'?"),
    "time": ("3*sin(t)", "3*sin(time)", ":31: forces.wind.torque", "did you mean 't'?"),
    "PI": ("3*sin(t)", "3*sin(PI*t)", ":31: forces.wind.torque", "did you mean 'pi'?"),
    "degrees in a formula": ("3*sin(t)", "3*sin(30 deg)", ":31: forces.wind.torque", "make the number in deg a para"),
    "negative mass": ('"12 kg"', "-12", ":6: bodies.boom.mass: expected a value above 0", "got -12"),
    "no mass": ('mass = "12 kg"\n', "", ":5: bodies.boom.mass: expected a number", "got no such key"),
    "no value": ("mass = 40.0", "mass =", ":13: expected a value after '='", "a line without a value is left out"),
    "no sign": ("mass = 40.0", "mass 40.0", ":13: expected KEY = VALUE", "did you mean 'mass = 40.0'?"),
    "two signs": ("mass = 40.0", "mass == 40.0", ":13: expected one '='", "did you mean 40.0?"),
    "blank of a word processor": ("mass = 40.0", "mass =\u00a040.0", ":13: expected plain blanks", "'mass = 40.0'?"),
    "no digit after the point": ("40.0", "40.", ":13: expected a digit on both sides", "did you mean 40.0?"),
    "no digit before the point": ("0.5", ".5", ":14: expected a digit on both sides", "did you mean 0.5?"),
    "formula without quotes": ("40.0", "1/2", ":13: expected a formula in quotation marks", 'did you mean "1/2"?'),
    "list with semicolons": ("[2.0, -1.0]", "[2.0; -1.0]", ":15: expected a list", "did you mean [2.0, -1.0]?"),
    "list in round brackets": ("[2.0, -1.0]", "(2.0, -1.0)", ":15: expected a list", "did you mean [2.0, -1.0]?"),
    "list without commas": ("[2.0, -1.0]", "[2.0 -1.0]", ":15: expected a list", "did you mean [2.0, -1.0]?"),
    "list that stays open": ("[2.0, -1.0]", "[2.0, -1.0", ":15: expected a list", "did you mean [2.0, -1.0]?"),
    "list as a text": ("[2.0, -1.0]", '"2.0, -1.0"', ":15: bodies.weight.position", "did you mean [2.0, -1.0]?"),
    "decimal commas in a list": ("[2.0, -1.0]", "[2,0, -1,0]", ":15: bodies.weight.position", "mean [2.0, -1.0]?"),
    "table of a section": ("[bodies.weight]", "[weight]", ":12: ", "did you mean '[bodies.weight]'?"),
    "table without brackets": ("[bodies.weight]", "bodies.weight:", ":12: ", "did you mean '[bodies.weight]'?"),
    "list of tables": ("[bodies.weight]", "[[bodies]]", ":12: expected one pair of brackets", "'[bodies.NAME]'"),
    "letter with an accent": ("[bodies.weight]", "[bodies.wéight]", ":12: expected a name of letters", "'é' is none"),
    "name with a digit first": ("[bodies.weight]", "[bodies.2nd]", ":12: bodies: expected a body name", "got '2nd'"),
    "theta": ('angle = "0 deg"', "theta = 0.0", ":10: bodies.boom: got the unknown key", "did you mean 'angle'?"),
    "g": ("gravity =", "g =", ":3: mechanism: got the unknown key 'g'", "did you mean 'gravity'?"),
    "world": ('["ground"', '["world"', ":20: joints.base.between", "did you mean 'ground'?"),
    "one body twice": ('["boom", "weight"]', '["boom", "boom"]', ":25: joints.hook.between: expected two different"),
    "no bodies": (
        'between = ["boom", "weight"]\n',
        "",
        ":23: joints.hook.between: expected the names of two",
        "no such",
    ),
    "no points": ('at = ["tip", "eye"]\n', "", ":23: joints.hook.at: expected two points", "got no such key"),
    "force without a body": ('body = "boom"\n', "", ":28: forces.wind.body: expected a value", "got no such key"),
    "negative inertia": ("inertia = 0.5", "inertia = -0.5", ":14: bodies.weight.inertia: expected a value above 0"),
    "force for a mass": ("12 kg", "5 N", ":6: bodies.boom.mass: expected a unit such as kg", "got 'N'"),
    "bracket that stays open": ("3*sin(t)", "3*sin(t", ":31: forces.wind.torque", "a bracket is not closed"),
    "function without brackets": ("3*sin(t)", "3*sin t", ":31: forces.wind.torque", "did you mean 'sin(t)'?"),
    "no sign of a product with a name": ("3*sin(t)", "sin(2pi*t)", ":31: forces.wind.torque", "did you mean '2*pi'?"),
    "dot of a product": ("3*sin(t)", "3·sin(t)", ":31: forces.wind.torque", "a product is written with *"),
    "decimal comma in a formula": ("3*sin(t)", "3,5*sin(t)", ":31: forces.wind.torque", "did you mean 3.5,"),
    "then": ("3*sin(t)", "if t > 1 then 3", ":31: forces.wind.torque", "a choice is written A if CONDITION else B"),
    "angle of a body": ("3*sin(t)", "3*boom.angle", ":31: forces.wind.torque", "did you mean 'boom.theta'?"),
    "coordinate without its body": ("3*sin(t)", "3*theta", ":31: forces.wind.torque", "did you mean 'boom.theta'?"),
    "driver of a body": (
        "[forces.wind]",
        '[joints.motor]\ntype = "driver"\njoint = "boom"\nvalue = "t"\n[forces.wind]',
        ":30: joints.motor.joint: expected the name of a joint",
        "known: base, hook",
    ),
    "driver along what a joint lacks": (
        "[forces.wind]",
        '[joints.motor]\ntype = "driver"\njoint = "hook"\ncoordinate = "displacement"\nvalue = "t"\n[forces.wind]',
        ":31: joints.motor.coordinate: expected a coordinate of joint 'hook'",
        "known: angle",
    ),
    "name twice": ("[forces.wind]", "[forces.boom]", ":28: forces.boom: expected a name used once", "a body already"),
    "end of the run": ("[mechanism]", "[run]\nend = 5\n[mechanism]", ":2: run: got the unknown key", "mean 'until'?"),
    "gravity in space": ("[0.0, -9.81]", "[0, 0, -9.81]", ":3: mechanism.gravity", "has space = 'spatial'"),
    "gravity": ("[0.0, -9.81]", "9.81", ":3: mechanism.gravity: expected two numbers", "got 9.81"),
}
COMMANDS = {
    "run four-bar --until 5s": "'--until': expected a number, got '5s'; numbers of options are in SI units: 5",
    "run four-bar --step 2ms": "'--step': expected a number, got '2ms'; numbers of options are in SI units: 0.002",
    "run four-bar --until 1,5": "'--until': expected a number, got '1,5'; a number has a decimal point: 1.5",
}
#: Further commands, and what their sentences say.
MISTYPED = {
    "rum four-bar": "there is no command 'rum'; did you mean 'run'?",
    "four-bar": "there is no command 'four-bar'; did you mean 'symgen run four-bar'?",
    "run four-bra": "got 'four-bra'; did you mean 'four-bar'?",
    "run four-bar --untl 5": "there is no option '--untl'; did you mean '--until'? (symgen run --help)",
    "run four-bar --set crank_mass:2": "expected NAME=VALUE, got 'crank_mass:2'; did you mean crank_mass=2?",
    "run four-bar --set crank_mass=2,5": "expected a finite number, got '2,5'; a number has a decimal point: 2.5",
    "run four-bar --set crank_mas=2": "got none of that name; did you mean 'crank_mass'?",
    "sweep four-bar --vary crank_mass=1,2,3": "got '1,2,3'; did you mean values(1, 2, 3)?",
    "kinematics four-bar": "expected a driver for every freedom, got none for A.angle; symgen run needs no drivers",
    "import none.urdf": "none.urdf: expected a file that can be read, got no such file or folder",
}


@pytest.mark.parametrize("name", SLIPS)
def test_the_sentence_on_a_slip_names_its_line_and_what_was_meant(name, tmp_path):
    old, new, *parts = SLIPS[name]
    assert CRANE.count(old) >= 1
    file = tmp_path / "crane.toml"
    file.write_text(CRANE.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InputError) as error:
        load(file)
    sentence = sentence_with_line(error.value)
    assert sentence.startswith("crane.toml") and "\n" not in sentence
    for part in parts:
        assert part in sentence, sentence


def test_an_angle_of_many_turns_is_asked_about(tmp_path):
    file = tmp_path / "crane.toml"
    file.write_text(CRANE.replace('angle = "0 deg"', "angle = 30"))
    (warning,) = load(file).mechanism.remarks
    assert warning == 'bodies.boom.angle: 30 rad are 4.77 turns; an angle in degrees is written "30 deg"'
    file.write_text(CRANE.replace('angle = "0 deg"', "angle = 6.2"))
    assert not load(file).mechanism.remarks


def test_a_loop_that_cannot_close_says_where_it_stays_open(tmp_path):
    file = tmp_path / "crane.toml"
    tie = '[joints.tie]\ntype = "distance"\nbetween = ["ground", "weight"]\nat = [[5.0, 0.0], "eye"]\nlength = 1.0\n'
    file.write_text(CRANE + tie)  # the tip is 2 m from the origin, and the tie reaches to 4 m
    with pytest.raises(AssemblyError, match=r"joint 'tie' stays open by \S+ m; check its points"):
        load(file).simulate(until=0.1)


@pytest.mark.parametrize("command", MISTYPED)
def test_a_mistyped_command_is_answered_in_one_sentence(command, cli):
    code, out, err = cli(*command.split())
    assert (code, out) == (2, "") and err.startswith("symgen: ") and err.count("\n") == 1
    assert MISTYPED[command] in err


@pytest.mark.parametrize("command", COMMANDS)
def test_a_number_with_a_unit_on_the_command_line(command):
    done = subprocess.run([sys.executable, "-m", "symgen", *command.split()], capture_output=True, text=True)
    assert done.returncode == 2 and done.stdout == ""
    assert COMMANDS[command] in done.stderr
