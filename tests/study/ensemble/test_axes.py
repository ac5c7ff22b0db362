"""What varies: text to values, and the grid of all combinations."""

import itertools

import numpy as np
import pytest

from symgen.base.errors import InputError
from symgen.study.ensemble.axes import Grid, axis_values, make_grid


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("lin(1, 3, 5)", [1.0, 1.5, 2.0, 2.5, 3.0]),
        (" lin( -1e0,+.5, 4 ) ", [-1.0, -0.5, 0.0, 0.5]),
        ("lin(2,7,1)", [2.0]),
        ("log(0.01, 100, 5)", [0.01, 0.1, 1.0, 10.0, 100.0]),
        ("values(3)", [3.0]),
        ("values(3, 1, 2.5)", [3.0, 1.0, 2.5]),
    ],
)
def test_text_stands_for_values(text, expected):
    np.testing.assert_allclose(axis_values(text, "x"), expected, rtol=1e-14)


def test_ends_are_exact():
    for text in ("lin(0.1, 0.7, 7)", "log(0.1, 0.7, 7)"):
        found = axis_values(text, "x")
        assert (found[0], found[-1]) == (0.1, 0.7)


def test_uniform_draws_the_same_values_for_the_same_seed():
    first, again, other = (axis_values(f"uniform(-2, 3, 20000, {seed})", "x") for seed in (7, 7, 0))
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)
    assert first.min() >= -2.0 and first.max() < 3.0
    # mean and variance of an even distribution, within five standard deviations
    assert abs(first.mean() - 0.5) < 5 * 5 / np.sqrt(12 * 20000)
    assert abs(first.var() - 25 / 12) < 5 * 25 / np.sqrt(180 * 20000)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("1:3:21", r"x: got '1:3:21'; did you mean lin\(1, 3, 21\)\? \(expected lin\(a, b, n\), "),
        ("", "got ''"),
        ("linn(1, 2, 3)", r"got 'linn'; did you mean 'lin'\?"),
        ("lin(1, 2)", r"expected lin\(first, last, count\), got 2 numbers"),
        ("lin(1, 2, 2.5)", r"a whole number of values .*, got 2.5"),
        ("lin(1, 2, 0)", "a whole number of values from 1"),
        ("lin(1, 2, 1e300)", "a whole number of values from 1"),
        ("log(-1, 2, 3)", "two ends above 0, got -1 and 2"),
        ("uniform(2, 1, 3, 1)", "a first end below the second"),
        ("uniform(1, 2, 3, -1)", "a whole number from 0 on as its seed"),
        ("values()", "finite numbers between the brackets, got ''"),
        ("values(1, nan)", "finite numbers between the brackets, got 'nan'"),
        ("values(1, 1e999)", "finite numbers between the brackets"),
        ("values(__import__('os'))", "expected lin"),
        ("values(2**3)", r"got '2\*\*3'"),
        ("values(1)(2)", "expected lin"),
    ],
)
def test_other_text_is_refused_in_one_sentence(text, said):
    with pytest.raises(InputError, match=said) as caught:
        axis_values(text, "x")
    assert "\n" not in str(caught.value)


def test_a_grid_holds_every_combination_once_in_the_order_of_nested_loops():
    grid = make_grid({"a": "values(1, 2)", "b": [10.0, 20.0, 30.0]}, {"c": [5.0, 6.0], "d": "values(7, 8)"}, ("b",))
    assert [axis.dimension for axis in grid.axes] == ["run", "a", "b(0)"]
    assert grid.shape == (2, 2, 3) and len(grid) == 12
    found = grid.values(0, 12)
    rows = list(zip(found["c"], found["d"], found["a"], found["b"], strict=True))
    assert rows == [(c, d, a, b) for (c, d), a, b in itertools.product([(5, 7), (6, 8)], [1, 2], [10, 20, 30])]
    part = grid.values(5, 9)
    for name, values in found.items():
        np.testing.assert_array_equal(part[name], values[5:9])


@pytest.mark.parametrize(
    ("vary", "runs", "said"),
    [
        ({}, {}, "sweep: expected something that varies, got nothing"),
        ({}, {"a": [1.0], "b": [1.0, 2.0]}, "as many values for every name, got 1 for a, 2 for b"),
        ({"a": [1.0]}, {"a": [1.0]}, "a: expected one way of varying it, got two"),
        ({"a": [[1.0]]}, {}, r"a list of at least one number, got an array of shape \(1, 1\)"),
        ({"a": []}, {}, "a list of at least one number"),
        ({"a": [1.0, np.inf]}, {}, "a: expected finite numbers"),
        ({"a": ["x"]}, {}, "a: expected numbers, got a list of 1"),
        ({"a": [True, False]}, {}, "a: expected numbers, got a list of 2"),
        ({"a": {1.0, 2.0}}, {}, "a: expected numbers, got a set of 2"),
        ({"a": "lin(0,1,100000)", "b": "lin(0,1,100000)"}, {}, r"at most 1e\+09 runs, got 1e\+10"),
    ],
)
def test_what_is_no_grid_is_refused(vary, runs, said):
    with pytest.raises(InputError, match=said):
        make_grid(vary, runs)


def test_a_grid_without_axes_has_one_run():
    assert len(Grid(())) == 1
