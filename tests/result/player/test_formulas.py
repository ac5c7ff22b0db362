"""Formulas of a file as JavaScript: lines that say the same as the formula."""

import math

import pytest

from symgen.compile.native.formula_lines import FormulaLines, NotInLines
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.parser import FormulaNames, parse


@pytest.mark.parametrize(
    "text",
    ["2*a + b/3", "-a**2", "sqrt(a*a + b*b)", "sin(a)*cos(b) - tan(a/4)", "atan2(b, a)", "min(a, b) + max(a, -b)",
     "abs(-b) + sign(a)", "a if a > b else b*2", "(1 if a < b and b > 0 else 3)*a", "exp(-a) + log(b)", "3.5"],
)  # fmt: skip
def test_lines_say_what_the_formula_says(text: str) -> None:
    expression = parse(text, FormulaNames("a formula", {"a": "a", "b": "b"}), "here")
    lines = FormulaLines({"a": "p[0]", "b": "p[1]"})
    result = lines.result(lines.value(expression, "here"))
    # the lines are read as Python here: choices and names of functions are all that differs
    known = {"p": [0.7, 1.9], "Math": math_of_pages(), "NaN": math.nan}
    for line in lines.lines:
        name, _, value = line.removeprefix("const ").removesuffix(";").partition(" = ")
        test, choice, rest = value.partition(" ? ")
        if choice:
            yes, _, no = rest.partition(" : ")
            value = f"({yes}) if ({test}) else ({no})"
        known[name] = eval(value.replace("&&", "and").replace("||", "or"), {}, known)
    assert eval(result, {}, known) == pytest.approx(evaluate_formula(expression, {"a": 0.7, "b": 1.9}), rel=1e-15)


def math_of_pages() -> object:
    class Functions:
        abs, min, max, pow = abs, min, max, pow
        sign = staticmethod(lambda x: (x > 0) - (x < 0))

    for name in ("sin", "cos", "tan", "sqrt", "exp", "log", "atan2"):
        setattr(Functions, name, staticmethod(getattr(math, name)))
    Functions.abs, Functions.min, Functions.max, Functions.pow = map(staticmethod, (abs, min, max, pow))  # type: ignore[assignment]
    return Functions


def test_tables_are_not_for_pages() -> None:
    with pytest.raises(NotInLines):
        FormulaLines({}).apply_function("table:lift", 1.0)
