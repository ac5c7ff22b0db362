"""The reference's reader of formulas against Python's own, and its derivatives against differences."""

import math
import random
from pathlib import Path

import pytest

from benchmarks.mechanisms.loads import KINKED, OF_ANGLE, OF_LENGTH, PLANE, POTENTIALS, SMOOTH, SPACE
from benchmarks.plain.formulas import Lines, parsed, value
from benchmarks.plain.series import UNARY, Series, lift

PYTHON = {name: getattr(math, name) for name in dir(math) if not name.startswith("_")}
PYTHON |= {"abs": abs, "min": min, "max": max, "sign": lambda x: (x > 0) - (x < 0)}
TEXTS = (
    "1 + 2*3",
    "-2**2",
    "2**-1",
    "2**3**2",
    "(1 + 2)*-3",
    "1 - 2 - 3",
    "8/4/2",
    "1 if 2 < 1 else 3 if 1 < 2 else 4",
    "1 if 0 < x < 1 and not y > 3 or x > 5 else -1",
    "min(3, x, y)*max(x, -y)",
    "sqrt(x) + exp(y) - log(x)*atan2(y, x)",
    "sin(x)**2 + cos(x)**2",
    ".5e1 + 1.e-1 + 1E2",
    "+x - -y",
    "abs(-x)*sign(y)",
    "pi*x",
)


@pytest.mark.parametrize("text", TEXTS)
def test_values_are_those_of_python(text: str) -> None:
    names = {"x": 0.7, "y": 1.3}
    expected = eval(text, {"__builtins__": {}}, PYTHON | names)  # a test's own text
    assert value(parsed(text), names) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize("text", ["1 +", "(1", "1 2", "a b", "f(", "1 if 2", "a..b", "", "1 = 2", "[1]"])
def test_what_is_no_formula_is_refused(text: str) -> None:
    with pytest.raises(ValueError):
        parsed(text)


def test_choices_and_tables() -> None:
    tables = {"tab": Lines((0.0, 1.0, 3.0), (1.0, 3.0, -1.0))}
    for x, expected in ((-5.0, 1.0), (0.5, 2.0), (2.0, 1.0), (9.0, -1.0)):
        assert value(parsed("tab(x)"), {"x": x}, tables) == expected
    text = "piecewise(x < 0, 1, x < 1, 2, 3)"
    assert [value(parsed(text), {"x": x}) for x in (-1.0, 0.5, 2.0)] == [1.0, 2.0, 3.0]


@pytest.mark.parametrize("text", ["max(1, x)", "min(x, 1)", "1 if x > 0 else 2", "sign(x)", "piecewise(x < 1, 2, 3)"])
def test_what_is_no_number_stays_none(text: str) -> None:
    assert math.isnan(value(parsed(text), {"x": math.nan}))


def test_functions_have_their_derivatives() -> None:
    h = 1e-4
    for name, function in UNARY.items():
        for x in (1.3, 1.7) if name == "acosh" else (0.3, 0.7):
            f, slope, bend = function(x)
            up, down = function(x + h)[0], function(x - h)[0]
            assert slope == pytest.approx((up - down) / (2 * h), abs=1e-6), name
            assert bend == pytest.approx((up - 2 * f + down) / h**2, abs=1e-5), name


@pytest.mark.parametrize("text", ["x**3 - 2/x", "x**x", "exp(sin(x))*x", "atan2(x, 2 - x)", "sqrt(1 + x**2)/(1 + x)"])
def test_formulas_have_their_derivatives(text: str) -> None:
    h, x, tree = 1e-4, 0.8, parsed(text)
    found = lift(value(tree, {"x": Series(x, 1.0)}))
    up, here, down = (float(value(tree, {"x": x + k * h})) for k in (1, 0, -1))
    assert found.value == here
    assert found.first == pytest.approx((up - down) / (2 * h), abs=1e-6)
    assert found.second == pytest.approx((up - 2 * here + down) / h**2, abs=1e-5)


def test_every_formula_that_is_drawn_can_be_read() -> None:
    rng = random.Random(1)
    for text in (*SMOOTH, *KINKED, *PLANE, *SPACE, *OF_ANGLE, *OF_LENGTH, *POTENTIALS):
        parsed(text.format(a=f"({rng.random()})", b="(-2.5)", A="1.5", s="length"))


@pytest.mark.parametrize("folder", ["plain", "mechanisms"])
def test_the_reference_shares_nothing_with_symgen(folder: str) -> None:
    sources = list((Path(__file__).resolve().parents[2] / "benchmarks" / folder).glob("*.py"))
    assert sources
    for source in sources:
        text = source.read_text(encoding="utf-8")
        assert "import symgen" not in text and "from symgen" not in text, source.name
