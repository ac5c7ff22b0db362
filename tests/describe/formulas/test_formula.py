"""Parser, printer and evaluation of formulas."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from support.texts import texts

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import FUNCTIONS, Call, Name, Number
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.formulas.identifiers import CALLABLE
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.table_functions import Table

NAMES = FormulaNames(
    "a formula",
    {"t": "t", "a": "a", "b": "b", "length": "s"},
    {"crank": ("x", "y", "theta", "vx", "vy", "omega")},
    {"profile": "table:profile"},
    frozenset({"u"}),
)
VALUES = {"t": 0.5, "a": 2.0, "b": -3.0, "s": 7.0, "crank.x": 0.25, "crank.omega": 4.0}


def read(text):
    return parse(text, NAMES, "file.toml: key")


def value(text):
    return evaluate_formula(read(text), VALUES, tables={"profile": Table("profile", (0.0, 1.0, 3.0), (1.0, 2.0, 0.0))})


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1", 1.0),
        ("-2", -2.0),
        (" 1.5e-3 ", 1.5e-3),
        (".5", 0.5),
        ("2.", 2.0),
        ("2*pi", 2 * math.pi),
        ("a + b*t", 0.5),
        ("a - b - t", 4.5),
        ("-a**2", -4.0),
        ("a**-1", 0.5),
        ("2**a**a", 16.0),
        ("a/b/t", -4 / 3),
        ("+a", 2.0),
        ("length", 7.0),
        ("crank.x*crank.omega", 1.0),
        ("sqrt(a + 7)", 3.0),
        ("atan2(a, b)", math.atan2(2, -3)),
        ("min(a, b, t)", -3.0),
        ("max(a, b, t)", 2.0),
        ("abs(b) + sign(b)", 2.0),
        ("1 if a > 1 else 2", 1.0),
        ("1 if a > 1 and b > 1 else 2", 2.0),
        ("1 if a > 1 or b > 1 else 2", 1.0),
        ("1 if not a > 1 else 2", 2.0),
        ("1 if 0 < t <= 0.5 < a else 2", 1.0),
        ("1 if 0 < t < 0.5 else 2", 2.0),
        ("piecewise(t < 0, 10, t < 1, 20, 30)", 20.0),
        ("a if 1 < 2 else 1/(t - 0.5)", 2.0),
        ("1/(t - 0.5) if t > 0.5 else 3", 3.0),
        ("profile(t)", 1.5),
        ("profile(2*t + 1)", 1.0),
        ("profile(-5) + profile(9)", 1.0),
        ("a\n  + b", -1.0),
    ],
)
def test_value(text, expected):
    assert value(text) == pytest.approx(expected, rel=1e-15)


def test_constants_are_folded_and_names_kept():
    assert read("2*3 + 1") == Number(7.0)
    assert read("a*(2 + 3)") == Call("mul", (Name("a"), Number(5.0)))
    assert read("length") == Name("s")
    assert read("profile(a)") == Call("table:profile", (Name("a"),))
    assert read("a if 1 < 2 else b") == Name("a")
    assert read("1 if a < 1 and 1 < 2 else 0").arguments[0] == Call("lt", (Name("a"), Number(1.0)))
    assert read("1 if a < 1 or 1 < 2 else 0") == Number(1.0)


REFUSED = [
    ("", "expected a formula, got an empty text"),
    ("  ", "expected a formula, got an empty text"),
    ("a +", "expected a formula, got 'a +', which is incomplete or has a syntax error"),
    ("a b", "expected a formula, got 'a b', which is incomplete or has a syntax error"),
    ("2^3", "expected a formula, got the character '^' at column 2; a power is written **"),
    ("7 % 3", "expected a formula, got the character '%' at column 3; there is no remainder"),
    ("7//3", "expected a formula, got '//' at column 2; a division is written /"),
    ("a == b", "got the character '=' at column 3; conditions are written with <, <=, > and >="),
    ("a != b", "got the character '!' at column 3; conditions are written with <, <=, > and >=, and 'not'"),
    ("1 if a < 1 & b < 1 else 2", "got the character '&' at column 12; write 'and'"),
    ('x"]; import os', "got the character '\"' at column 2; a formula has no text in it"),
    ("a; import os", "got the character ';' at column 2"),
    ("__import__('os')", "got the character '_' at column 1"),
    ("crank.__class__", "got the character '_' at column 7"),
    ("().__class__", "got the character '_' at column 4"),
    ("lambda: 1", "got the word 'lambda' at column 1"),
    ("[a for a in b]", "got the character '[' at column 1; a formula has no lists"),
    ("a[0]", "got the character '[' at column 2; a formula has no lists"),
    ("{a}", "got the character '{' at column 1"),
    ("'a'*9999999999", 'got the character "\'" at column 1; a formula has no text in it'),
    ("(a := 1)", "got the character ':' at column 4"),
    ("a @ b", "got the character '@' at column 3"),
    ("~a", "got the character '~' at column 1"),
    ("a # b", "got the character '#' at column 3"),
    ("a\x00b", "got the character '\\x00' at column 2"),
    ("²", "got the character '²' at column 1"),
    ("ａ", "got the character 'ａ' at column 1"),  # full-width, which Python's grammar would read as 'a'
    ("eval(a)", "got the unknown function 'eval'"),
    ("open(a)", "got the unknown function 'open'"),
    ("True", "got the word 'True' at column 1"),
    ("None", "got the word 'None' at column 1"),
    ("await a", "got the word 'await' at column 1"),
    ("yield", "got the word 'yield' at column 1"),
    ("...", "got '...', which is no formula"),
    ("1, 2", "got '(1, 2)', which is no formula"),
    ("()", "got '()', which is no formula"),
    ("sin(*a)", "got '*a', which is no formula"),
    ("sin(a)(b)", "got 'sin(a)(b)', which is no formula"),
    ("crank.x.y", "got 'x.y', which body 'crank' does not have; it has x, y, theta"),
    ("crank.x()", "got 'crank.x()', which is no formula"),
    ("1j", "got '1j', which is not a number, at column 1"),
    ("0x10", "got '0x10', which is not a number, at column 1"),
    ("1_000", "got '1_000', which is not a number, at column 1"),
    ("1if a<1else 2", "got '1if', which is not a number, at column 1"),
    ("1e999", "got a number beyond 1.8e308"),
    ("9" * 400, "got a number beyond 1.8e308"),
    ("9" * 5000, "got a number beyond 1.8e308"),
    ("9**9**9", "expected an exponent between -64 and 64, got 387420489.0"),
    ("a**-65", "expected an exponent between -64 and 64, got -65.0"),
    ("a + 1/0", "got '1.0/0.0', which has no finite value"),
    ("sqrt(-1)", "got 'sqrt(-1.0)', which has no finite value"),
    ("exp(1000)", "got 'exp(1000.0)', which has no finite value"),
    ("c", "got the unknown name 'c'; known: a, b, length, pi, t"),
    ("lenght", "got the unknown name 'lenght'; did you mean 'length'?"),
    ("s", "got the unknown name 's'; known: a, b, length, pi, t"),
    ("u", "got 'u', which has no meaning here"),
    ("crnk.x", "got the unknown body 'crnk'; did you mean 'crank'?"),
    ("crank.z", "got 'z', which body 'crank' does not have; it has x, y, theta, vx, vy, omega"),
    ("crank", "got the body 'crank' in place of a number; it has crank.x, crank.y, crank.theta,"),
    ("sin", "got the function 'sin' without its argument; write sin(...)"),
    ("profile", "got the function 'profile' without its argument; write profile(...)"),
    ("sinn(a)", "got the unknown function 'sinn'; did you mean 'sin'?"),
    ("profil(a)", "got the unknown function 'profil'; did you mean 'profile'?"),
    ("sin()", "expected one argument, got sin() with 0"),
    ("atan2(a)", "expected 2 arguments, got atan2() with 1"),
    ("profile(a, b)", "expected one argument, got profile() with 2"),
    ("min(a)", "expected two arguments or more, got min() with 1"),
    ("piecewise(a < 1, 2)", "expected piecewise(condition, value, ..., value otherwise), got 2 arguments"),
    ("a < b", "got the condition 'a < b' in place of a number; write '1 if ... else 0'"),
    ("2*(1 < 2)", "got the condition '1 < 2' in place of a number; write '1 if ... else 0'"),
    ("a and b", "got the condition 'a and b' in place of a number"),
    ("1 if a else 2", "got 'a' in place of a condition; a condition has <, <=, > or >="),
    ("1 if a and b < 1 else 2", "got 'a' in place of a condition"),
    ("(a < b) < 1 if a < 1 else 2", "got the condition '(a < b) < 1' in place of a number"),
    ("x" * 10_000_000, "expected a formula of at most 10000 characters, got 10000000 characters"),
    ("(" * 4000 + "a" + ")" * 4000, "expected a formula nested at most 100 levels deep, got deeper nesting"),
    ("sin(" * 101 + "a" + ")" * 101, "got deeper nesting"),
    ("-" * 9000 + "a", "expected a formula nested at most 100 levels deep, got deeper nesting"),
    ("+".join("a" * 300), "got deeper nesting; long sums nest as well: group their terms in brackets"),
    ("a**" * 3000 + "a", "expected a formula nested at most 100 levels deep, got deeper nesting"),
    ("max(" + ",".join("a" * 3000) + ")", "got deeper nesting"),
]


@pytest.mark.parametrize(("text", "sentence"), REFUSED, ids=[text[:20] or "empty" for text, _ in REFUSED])
def test_refused_with_one_sentence(text, sentence):
    with pytest.raises(InputError) as error:
        read(text)
    message = str(error.value)
    assert message.startswith("file.toml: key: expected ")
    assert sentence in message
    assert "\n" not in message
    assert len(message) < 400


def test_a_sum_of_many_bracketed_terms_is_read():
    part = "(" + " + ".join("a" * 60) + ")"
    assert value(" + ".join([part] * 20)) == 2400.0
    assert value("sin(" * 90 + "0*a" + ")" * 90) == 0.0


# Round trip ----------------------------------------------------------------------------------------------------

ATOMS = st.floats(allow_nan=False, allow_infinity=False).map(Number) | st.sampled_from(
    [Name("t"), Name("a"), Name("b"), Name("crank.theta"), Name("crank.vx")]
)
UNARY = ["neg", "sqrt", "exp", "log", "sin", "cos", "tan", "atan", "tanh", "abs", "sign", "table:profile"]
BINARY = ["add", "sub", "mul", "div", "atan2", "min", "max", "pow"]


@st.composite
def conditions(draw, depth):
    if depth <= 0 or draw(st.booleans()):
        return named(draw, draw(st.sampled_from(["lt", "le", "gt", "ge"])), [draw(trees(depth - 1)) for _ in range(2)])
    function = draw(st.sampled_from(["and", "or", "not"]))
    return Call(function, tuple(draw(conditions(depth - 1)) for _ in range(FUNCTIONS[function][0])))


@st.composite
def trees(draw, depth=5):
    """A tree as the parser makes them: no call has literal arguments only, no literal exponent is beyond the bound."""
    if depth <= 0 or draw(st.integers(0, 3)) == 0:
        return draw(ATOMS)
    function = draw(st.sampled_from([*UNARY, *BINARY, "where"]))
    if function == "where":
        return Call("where", (draw(conditions(depth - 1)), draw(trees(depth - 1)), draw(trees(depth - 1))))
    arguments = [draw(trees(depth - 1)) for _ in range(1 if function in UNARY else 2)]
    if function == "pow" and isinstance(arguments[1], Number):
        arguments[1] = Number(draw(st.sampled_from([2.0, -1.0, 0.5, 64.0])))
    return named(draw, function, arguments)


def named(draw, function, arguments):
    if all(isinstance(argument, Number) for argument in arguments):
        arguments[0] = draw(st.sampled_from([Name("t"), Name("crank.omega")]))
    return Call(function, tuple(arguments))


@given(trees())
def test_printed_formula_is_read_back_as_the_same_tree(expression):
    assert read(to_text(expression)) == expression


@given(st.text(st.sampled_from("ab t.12()+-*/<>,e \n\"'_[]sinif"), max_size=40))
def test_any_text_is_read_or_refused_with_an_input_error(text):
    try:
        result = read(text)
    except InputError as error:
        assert "\n" not in str(error)
    else:
        assert read(to_text(result)) == result


@given(texts(30))
def test_any_unicode_is_read_or_refused(text):
    try:
        read(text)
    except InputError:
        assume(True)


# Evaluation ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("1/(a - 2)", "expected a finite number, got '1.0/(a - 2.0)' = 1.0/0.0, which divides by zero"),
        ("a**b/0.0**t*0", "expected a finite number, got"),
        ("sqrt(b)", "expected a finite number, got 'sqrt(b)' = sqrt(-3.0), which is not defined"),
        ("exp(a*1000)", "expected a finite number, got 'exp(a*1000.0)' = exp(2000.0), which is too large"),
        ("b**t", "expected a finite number, got 'b**t' = (-3.0)**0.5, which is not a finite real number"),
        ("1e308*10**a", "expected a finite number, got '1e+308*10.0**a' = 1e+308*100.0, which is not a finite real"),
        ("crank.y", "expected a value for every name, got none for 'crank.y'; did you mean 'crank.x'?"),
    ],
)
def test_undefined_values_are_explained(text, sentence):
    with pytest.raises(InputError, match=r"^where: ") as error:
        evaluate_formula(read(text), VALUES, "where")
    assert sentence in str(error.value)


def test_every_callable_function_is_known_to_the_tree():
    assert CALLABLE - {"piecewise"} <= set(FUNCTIONS)
