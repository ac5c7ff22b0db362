"""Parameters and described starts of many runs against those of single ones."""

import numpy as np
import pytest
from support.checks import assert_same_motion
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import FUNCTIONS, Call, Name
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.study.ensemble.chunks import Columns, make_rows

A = np.array([-1.7, -0.4, 0.0, 0.3, 0.9, 1.0, 2.5])
B = np.array([0.6, -2.0, 0.0, 0.0, 0.9, -1.0, 3.0])
C = np.array([1.0, 0.0, -3.0, 0.5, 0.0, 1.0, 2.0])


@pytest.mark.parametrize("function", list(FUNCTIONS))
def test_functions_are_those_of_single_runs(function):
    names = [Name(x) for x in "abc"[: FUNCTIONS[function][0]]]
    formula = Call("add", (Call(function, tuple(names)), Name("a")))
    found = np.broadcast_to(Columns({"a": A, "b": B, "c": C}).value(formula), A.shape)
    for i in range(len(A)):
        try:
            expected = evaluate_formula(formula, {"a": A[i], "b": B[i], "c": C[i]})
        except InputError:
            expected = np.nan
        np.testing.assert_array_equal(found[i], expected, err_msg=f"{function} of {A[i]}, {B[i]}, {C[i]}")


def test_what_is_undefined_inside_stays_undefined_unless_it_is_left_aside():
    inverse = Call("div", (Name("b"), Name("a")))
    columns = Columns({"a": np.array([0.0, 2.0]), "b": np.array([1.0, 1.0]), "zero": 0.0})
    one = Columns({"a": 0.0, "b": 1.0, "zero": 0.0})
    for formula in (Call("atan", (inverse,)), Call("lt", (inverse, Name("b"))), Call("pow", (inverse, Name("zero")))):
        assert np.isnan(columns.value(formula)[0]) and np.isfinite(columns.value(formula)[1])
        assert np.isnan(one.value(formula))
    chosen = Call("where", (Call("gt", (Name("a"), Name("zero"))), inverse, Name("b")))
    np.testing.assert_array_equal(columns.value(chosen), [1.0, 0.5])
    assert one.value(chosen) == 1.0
    assert np.isnan(one.value(Call("where", (inverse, Name("b"), Name("b")))))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 if a > 0 and sqrt(a) > 1 else 0", [0.0, 0.0, 1.0]),
        ("1 if sqrt(a) > 1 and a > 0 else 0", [0.0, 0.0, 1.0]),
        ("2 if a < 0 or sqrt(a) > 1 else 3", [2.0, 3.0, 2.0]),
        ("2 if sqrt(a) > 1 or a < 0 else 3", [2.0, 3.0, 2.0]),
        ("2 if sqrt(a) > 1 or a > 1 else 3", [np.nan, 3.0, 2.0]),
        ("2 if sqrt(a) > 1 and a < 1 else 3", [np.nan, 3.0, 3.0]),
    ],
)
def test_an_undefined_condition_counts_for_nothing_where_the_other_one_decides(text, expected):
    values = np.array([-1.0, 0.25, 4.0])
    formula = parse(text, FormulaNames("a formula", {"a": "a"}), "b")
    np.testing.assert_array_equal(Columns({"a": values}).value(formula), expected)
    for a, x in zip(values, expected, strict=True):
        np.testing.assert_array_equal(Columns({"a": float(a)}).value(formula), x)
        if np.isfinite(x):
            assert evaluate_formula(formula, {"a": a}) == x
        else:
            with pytest.raises(InputError, match="which is not defined"):
                evaluate_formula(formula, {"a": a})


ORIENTATIONS = {
    "a": {"rotation_vector": ["0.3*k", "k - 1", 0.2]},
    "b": {"euler_angles": ["k", "0.5*k", -1.0], "convention": "zxz"},
    "c": {"x_axis": ["k - 2", 0.4, 0.1], "y_axis": [0.0, "k", 1.0]},
    "d": {"start": [0.0, "k", 0.0], "end": [1.0, 0.0, "0.3*k"], "y_axis": [0.0, 1.0, 0.3]},
    "e": {"quaternion": [1.0, 2.0, -1.0, 0.5]},
    "f": {"rotation_vector": ["k - 1", 0.0, 0.0]},
}
SPACE = {
    "mechanism": {"name": "free", "space": "spatial"},
    "parameters": {"k": 1.0},
    "bodies": {
        name: {
            "mass": 1.0,
            "inertia": [1.0, 2.0, 2.5],
            "position": ["k", 0.0, f"{i}*k"],
            "centre_of_mass": [0.1, "0.2*k", 0.3],
            "orientation": orientation,
            "angular_velocity": ["k", 0.0, 1.0],
        }
        for i, (name, orientation) in enumerate(ORIENTATIONS.items())
    },
}
PLANE = {
    "mechanism": {"name": "plane"},
    "parameters": {"k": 1.0, "unused": 2.0},
    "bodies": {
        "arm": {
            "mass": 1.0,
            "inertia": 1.0,
            "position": ["k", 2.0],
            "angle": "sin(k)",
            "centre_of_mass": [0.3, "k/4"],
            "angular_velocity": "k",
        },
        "dot": {"type": "point", "mass": 1.0, "position": ["sqrt(k)", 0.0], "velocity": [0.0, "3*k"]},
        "rod": {"mass": 1.0, "inertia": 1.0},
    },
}


@pytest.mark.parametrize("description", [SPACE, PLANE], ids=["space", "plane"])
def test_rows_are_the_described_starts_of_single_runs(description):
    model = symgen.load(mechanism_of(description))
    values = np.array([0.2, 1.0, 1.7, 2.9])
    rows = make_rows(model.mechanism, model.parameters(), {"k": values}, (), {})
    for i, k in enumerate(values):
        q, v = model.initial_state(model.parameters({"k": k}))
        assert_same_motion(rows.q[i], q)
        assert_same_motion(rows.v[i], [np.nan if x is None else x for x in v])
        assert rows.parameters[i, 0] == k


def test_undefined_rows_are_nan_and_alone():
    model = symgen.load(mechanism_of(PLANE))
    rows = make_rows(model.mechanism, model.parameters(), {"k": np.array([1.0, -1.0])}, (), {})
    assert np.all(np.isfinite(rows.q[0])) and not np.all(np.isfinite(rows.q[1]))
