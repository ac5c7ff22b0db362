"""Formulas as codes: their values are those of the formulas one by one, to the last bit."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import FUNCTIONS, Call, Expr, Name, Number
from symgen.compile.loopcode.loop_instances import compiled_loop
from symgen.compile.native.annotations import Array, signature_from
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.table_functions import Table
from symgen.run.breaks.coded_formulas import Formula, code_formula, coded_value_at


def _over(formula: Formula, times: Array, out: Array) -> int:
    for i in range(times.shape[0]):
        out[i] = coded_value_at(formula, times[i])
    return 0


_over_loop = compiled_loop(__name__, "_over_loop", _over, signature_from(_over), contracted=False)
TIMES = np.concatenate([np.linspace(-3.0, 4.0, 141), np.random.default_rng(3).uniform(-900.0, 900.0, 20)])
VALUES = {"at": 0.7, "w": -31.0}
X, Y = (-1.0, 0.25, 1.1, 2.0, 3.5), (0.3, -2.0, 1.0, 4.0, 0.3)
TABLES = {
    "lines": Table("lines", X, Y),
    "curve": Table("curve", X, Y, "cubic"),
    "steps": Table("steps", X, Y, "pchip"),
    "teeth": Table("teeth", X, Y, "pchip", True),
    "wave": Table("wave", X, Y, "cubic", True),
}


def assert_same_bits(e: Expr) -> None:
    """Check a formula at all times against its evaluation, nan where that raises."""

    def at(t: float) -> float:
        try:
            return evaluate_formula(e, {**VALUES, "t": t}, tables=TABLES)
        except InputError:
            return math.nan

    found = np.zeros(len(TIMES))
    _over_loop(code_formula(e, TABLES).of(VALUES), TIMES, found)
    expected = np.array([at(t) for t in TIMES.tolist()])
    np.testing.assert_array_equal(found.view(np.int64)[~np.isnan(found)], expected.view(np.int64)[~np.isnan(expected)])
    np.testing.assert_array_equal(np.isnan(found), np.isnan(expected))


@pytest.mark.parametrize("function", FUNCTIONS)
def test_each_function_has_its_value(function: str) -> None:
    """Of numbers on both sides of 0 and 1, equal ones among them, and of undefined ones."""
    t, w = Name("t"), Call("sub", (Call("mul", (Name("t"), Name("at"))), Number(0.35)))
    root, count = Call("sqrt", (Call("sub", (t, Number(0.5))),)), FUNCTIONS[function][0]
    for operands in itertools.product((t, w, root, Number(0.0), Number(2.0)), repeat=count):
        assert_same_bits(Call(function, operands))


@pytest.mark.parametrize("table", TABLES)
def test_tables_have_their_values(table: str) -> None:
    """At points, between and beyond them; of an undefined argument as well, and of several tables together."""
    argument = Call("sub", (Name("t"), Name("at")))
    of_others = Call("add", (Call("table:lines", (argument,)), Call(f"table:~{table}", (Call("sqrt", (argument,)),))))
    for e in (
        Call(f"table:{table}", (Name("t"),)),
        Call(f"table:{table}", (Call("mul", (Name("w"), argument)),)),
        of_others,
    ):
        assert_same_bits(e)


@pytest.mark.parametrize(
    "text",
    [
        "sqrt(t)", "1/(t*t - t)", "sin(30*t)*exp(-t)", "log(t) if t > 1/2 else at", "t if t > 1 or log(t) > 0 else 0",
        "1 if not (t > at and log(t) < 1) else w**t", "exp(t*t) - exp(t*t)", "-(t + at)**3/(1 + w*t)", "at",
    ],
)  # fmt: skip
def test_values_are_those_one_by_one(text: str) -> None:
    """Also where parts of a formula are undefined, and conditions discard them."""
    assert_same_bits(parse(text, FormulaNames("a formula", {name: name for name in ("t", "at", "w")}, {}, {}), "here"))
