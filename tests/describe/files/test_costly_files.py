"""Files that would cost far more than they can mean are refused, or read in a time that grows with their size."""

import sys
import tomllib

import pytest
from support.emitted import mechanism_of

from symgen.base.errors import LONGEST_PART, InputError, quote, suggest
from symgen.base.escapes import printable
from symgen.derive.formulate.formulate import formulate
from symgen.describe.files.load import LONGEST_KEY, load_mechanism, parse_toml
from symgen.describe.files.validate import validate

HEAD = '[mechanism]\nname = "x"\n'
BODY = "[bodies.b]\nmass = 1.0\ninertia = 1.0\n"


def read(text):
    return validate(parse_toml(text, "x.toml"), "x.toml")


def torque(formula):
    return f'{HEAD}{BODY}[forces.f]\ntype = "torque"\nbody = "b"\ntorque = "{formula}"\n'


def compared(levels):
    """A formula in which every level stands in two comparisons, so that its tree has 2**levels leaves."""
    formula = "t"
    for _ in range(levels):
        formula = f"(1 if 0 < {formula} < 2 else 0)"
    return formula


REFUSED = {
    "a long dotted key": (".".join("a" * 20_000) + " = 1", "keys of at most 8 parts joined by dots, got a longer one"),
    "with spaces": (" . ".join("a" * 9) + " = 1", "keys of at most 8 parts"),
    "in quotes": (".".join(["'a'"] * 9) + " = 1", "keys of at most 8 parts"),
    "in a header": ("[" + ".".join("a" * 9) + "]", "keys of at most 8 parts"),
    "in a table in a line": ("x = { " + ".".join("a" * 9) + " = 1 }", "keys of at most 8 parts"),
    "many long keys": (
        "".join(f"[a{i}.b.c.d.e.f.g.h]\n" for i in range(9_000)),
        "at most 50000 tables inside tables, by dotted keys, got more",
    ),
    "deep lists": ("x = " + "[" * 100_000, "tables nested at most 20 levels deep"),
    "deep tables": ("x = " + "{ a = " * 100_000, "tables nested at most 20 levels deep"),
    "comparisons of comparisons": (torque(compared(40)), "a formula of at most 5000 terms, got more"),
    "many long formulas": (
        HEAD
        + BODY
        + "".join(f'[forces.f{i}]\ntype = "torque"\nbody = "b"\ntorque = "{"t+" * 3_000}t"\n' for i in range(20)),
        "formulas of at most 50000 operators together, got 60000",
    ),
    "many parameters": (
        HEAD + "[parameters]\n" + "".join(f"p{i} = 1\n" for i in range(10_001)) + BODY,
        "x.toml: parameters: expected at most 10000 parameters, got 10001",
    ),
    "joints that lead to joints": (
        f'{HEAD}space = "spatial"\n[bodies.b]\nmass = 1.0\ninertia = [1, 1, 1]\n'
        + "".join(f'[joints.g{i}]\ntype = "gear"\njoints = ["g{i + 1}", "r"]\nratio = 2\n' for i in range(3_000)),
        "joints that refer to each other in at most 20 steps, got more",
    ),
}


@pytest.mark.parametrize(("text", "sentence"), REFUSED.values(), ids=REFUSED)
def test_what_is_refused(text, sentence):
    with pytest.raises(InputError) as error:
        read(text)
    assert sentence in str(error.value)


ALLOWED = {
    "dots in comments": "# " + "a." * 100 + "\n",
    "dots in texts": f'x = "{"a." * 100}"\n',
    "dots in long texts": 'x = """\n' + "a.b.c.d.e.f.g.h.i.j\n" * 10 + '"" """\n',
    "dots in plain texts": "x = '''\n" + "a.b.c.d.e.f.g.h.i.j\n" * 10 + "'' '''\n",
    "brackets in texts": f"x = \"{'[' * 100}\"\ny = '{'{' * 100}'\n",
    "numbers": "x = [" + ", ".join(["1.5", "-2.5e3", "+.1e1".replace("+.", "+0.")] * 1000) + "]\n",
    "escaped quotes": 'x = "\\"' + "[" * 50 + '\\\\"\n',
    "eight parts": ".".join("abcdefgh") + " = 1\n",
    "twenty levels": "x = " + "[" * 19 + "]" * 19 + "\n",
}


@pytest.mark.parametrize("text", ALLOWED.values(), ids=ALLOWED)
def test_the_look_at_the_text_refuses_nothing_else(text):
    assert parse_toml(text, "x.toml") == tomllib.loads(text)


@pytest.mark.slow
def test_the_catalogue_is_far_within_the_bounds():
    for size in ("four-bar", "n-four-bar:300", "chain:200"):
        load_mechanism(size)
    assert LONGEST_KEY >= 2 * len("bodies.rod.points.tip".split("."))


def opcodes(work):
    """Return how many operations of Python code some work takes: a measure that no other process disturbs."""
    count = 0

    def trace(frame, event, argument):
        nonlocal count
        frame.f_trace_opcodes = True
        count += event == "opcode"
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        work()
    finally:
        sys.settrace(before)
    return count


GROWING = {
    "parameters and bodies": lambda n: {
        "parameters": {f"a{i}": 1.0 for i in range(n)},
        "bodies": {f"b{i}": {"mass": "a1", "inertia": "a2"} for i in range(n)},
    },
    "bodies and torques": lambda n: {
        "bodies": {f"b{i}": {"mass": 1.0, "inertia": 1.0} for i in range(n)},
        "forces": {f"f{i}": {"type": "torque", "body": "b1", "torque": "t*b2.x"} for i in range(n)},
    },
    "points and joints": lambda n: {
        "bodies": {"b": {"mass": 1.0, "inertia": 1.0, "points": {f"p{i}": [0.0, 0.0] for i in range(n)}}},
        "joints": {
            f"j{i}": {"type": "revolute", "between": ["ground", "b"], "at": [[0.0, 0.0], "p1"]} for i in range(n)
        },
    },
}


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("build", GROWING.values(), ids=GROWING)
def test_reading_takes_work_in_proportion_to_the_size(build):
    small, large = ({"mechanism": {"name": "x"}} | build(n) for n in (60, 240))
    validate(small, "x")  # what is done once a process
    assert opcodes(lambda: validate(large, "x")) < 6 * opcodes(lambda: validate(small, "x"))


# -- texts of a file in messages and on terminals ----------------------------------------------------------------------


def test_what_a_message_repeats_is_short_and_printable():
    for key, value in (("type", "x" * 100_000), ("type", "\x1b[2J"), ("body", "\x07" * 99), ("torque", "(" * 5_000)):
        raw = tomllib.loads(torque("t"))
        raw["forces"]["f"][key] = value
        with pytest.raises(InputError) as error:
            validate(raw, "x.toml")
        assert len(str(error.value)) < 700 and str(error.value).isprintable()


def test_names_of_files_are_printable_too(tmp_path):
    path = tmp_path / "a\x1b[31m\nb.toml"
    path.write_text("[mechanism]\n")
    with pytest.raises(InputError) as error:
        load_mechanism(path)
    assert str(error.value).isprintable() and "a\\x1b[31m\\nb.toml: mechanism.name" in str(error.value)


def test_texts_for_people_are_one_printable_line():
    raw = tomllib.loads(torque("t"))
    raw["mechanism"] |= {"title": "a\x1b]0;owned\x07\n b", "source": "c\td"}
    raw["parameters"] = {"p": {"value": 1.0, "unit": "N", "note": "\x9b2J"}}
    found = validate(raw, "x.toml")
    assert found.title == "a\\x1b]0;owned\\x07 b" and found.defaults.source == "c d"
    assert (found.parameters[0].unit, found.parameters[0].note) == ("N", "\\x9b2J")


def test_words_of_messages():
    assert quote("a'b\n") == '"a\'b\\n"' and quote("x" * 99) == "'" + "x" * 55 + "...'"
    assert quote(3) == "'3'" and quote(b"\x00") == "'b'\\x00''"
    assert printable("a\u202eb") == "a\\u202eb" and printable("ä Δ") == "ä Δ"

    class Unspeakable:
        def __str__(self):
            raise RuntimeError

    assert quote(Unspeakable()) == "an object of type 'Unspeakable'"
    assert str(InputError("a", "b", "c" * 10_000)) == "a: expected b, got " + "c" * LONGEST_PART + "..."
    place = str(InputError("crane.toml: bodies." + "b" * 10_000 + ".mass", "b", "c"))
    assert len(place) < 300 and place.startswith("crane.toml: bodies.b") and "b.mass: expected b" in place
    assert suggest("q", [f"name{i}" for i in range(100)]).endswith(", name61, name62 and 40 more")
    assert suggest("name7x", [f"name{i}" for i in range(3000)]) == "did you mean 'name7'?"


def test_a_number_of_too_many_digits_is_refused_in_a_sentence_of_symgen():
    with pytest.raises(InputError, match=r"m\.toml: expected whole numbers of at most [0-9]+ digits, got a longer one"):
        parse_toml(f"[parameters]\nk = {'9' * 200_000}\n", "m.toml")


@pytest.mark.parametrize("count", [50, 51, 100])
def test_a_coupling_has_as_many_coefficients_as_can_be_derived(count):
    """A hundred ended in a RecursionError."""
    description = {
        "mechanism": {"name": "m"},
        "bodies": {"rod": {"mass": 2.0, "inertia": 0.5}},
        "joints": {
            "pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], [0.5, 0.0]]},
            "c": {"type": "coupling", "terms": {"pin": 1.0}, "of": "pin", "polynomial": [1e-3] * count},
        },
    }
    if count > 50:
        expected = f"polynomial: expected at most 50 coefficients, got {count}"
        with pytest.raises(InputError, match=expected):
            mechanism_of(description)
    else:
        assert formulate(mechanism_of(description)).rows[-1].name == "c.coupling"
