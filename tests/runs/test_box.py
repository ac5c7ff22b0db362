"""The box problem against bounded least squares."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from symgen.loopcode.exact import compiled_form, plain_form
from symgen.runs.box import new_box, solve_box

SOLVE = compiled_form(solve_box)


def left(matrix: np.ndarray, offset: np.ndarray, bounds: np.ndarray, solve=SOLVE) -> np.ndarray:
    """Return the accelerations that the forces leave."""
    k = len(offset)
    box = new_box(k)
    box.matrix[:], box.offset[:], box.bounds[:] = matrix.ravel(), offset, bounds
    assert solve(k, box) == 0
    assert (np.abs(box.forces) <= bounds).all()
    return box.left.copy()


def random_problem(numbers: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return rows, a right side and bounds; ranks from 1 to k, every fifth problem with two parallel columns."""
    k = int(numbers.integers(1, 7))
    rows = numbers.normal(size=(int(numbers.integers(1, k + 1)), k))
    if k > 1 and numbers.integers(5) == 0:
        rows[:, 1] = rows[:, 0] * numbers.normal()
    return rows, numbers.normal(size=len(rows)), numbers.uniform(size=k)


def compare(count: int) -> None:
    numbers = np.random.default_rng(52)
    for _ in range(count):
        rows, right, bounds = random_problem(numbers)
        best = lsq_linear(rows, right, (-bounds, bounds), method="bvls", tol=1e-15, max_iter=100).x
        here = left(rows.T @ rows, rows.T @ right, bounds)
        np.testing.assert_allclose(here, rows.T @ (right - rows @ best), rtol=0, atol=1e-10)


def test_accelerations_are_those_of_bounded_least_squares() -> None:
    compare(500)


@pytest.mark.slow
def test_many_accelerations_are_those_of_bounded_least_squares() -> None:
    compare(10_000)


def test_plain_python_has_the_same_bits() -> None:
    numbers = np.random.default_rng(7)
    for _ in range(50):
        rows, right, bounds = random_problem(numbers)
        problem = rows.T @ rows, rows.T @ right, bounds
        np.testing.assert_array_equal(left(*problem), left(*problem, solve=plain_form(solve_box)))


def test_rows_of_one_direction_share_a_force() -> None:
    """Four pins of a linkage with one freedom: 10 holds against 24.1, 4 does not."""
    rates = np.array([1.0, -1.1876413166885658, 0.4338609156373124, 0.24621959894874657])
    matrix, offset = np.outer(rates, rates), -24.12530546484223 * rates
    np.testing.assert_allclose(left(matrix, offset, np.full(4, 10.0)), 0.0, rtol=0, atol=1e-13)
    rest = -24.12530546484223 + 4.0 * np.abs(rates).sum()
    np.testing.assert_allclose(left(matrix, offset, np.full(4, 4.0)), rest * rates, rtol=1e-14)


def test_forces_without_effect_or_bound_are_zero() -> None:
    matrix = np.diag([1.0, 0.0, 2.0])
    here = left(matrix, np.array([0.5, 3.0, 1.0]), np.array([1.0, 1.0, 0.0]))
    np.testing.assert_array_equal(here, [0.0, 3.0, 1.0])
