"""Laws whose bounds depend on no force, against bounded least squares."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from symgen.compile.loopcode.exact import compiled_form, plain_form
from symgen.compile.loopcode.loop_instances import exact_instance
from symgen.run.laws.motions import find_forces
from symgen.run.laws.problem import BALL, PUSH, new_laws

FIND = exact_instance(find_forces, {"LOADS": False})
SOLVE = compiled_form(FIND)


def solved(
    matrix: np.ndarray, offset: np.ndarray, bounds: np.ndarray, lower: np.ndarray, solve=SOLVE
) -> tuple[np.ndarray, np.ndarray]:
    """Return the forces, and the accelerations that they leave."""
    k, pushes = len(offset), np.isinf(lower)
    laws = new_laws(k)
    laws.matrix[:], laws.offset[:], laws.presser[:] = matrix.ravel(), offset, -1
    laws.law[:] = np.where(pushes, PUSH, BALL)
    laws.beta[:] = np.where(pushes, 0.0, bounds)
    assert solve(k, laws, 1)
    near = 1e-12 * (1.0 + np.abs(laws.forces).max())
    assert (laws.forces <= bounds + near).all() and (laws.forces >= lower - near).all()
    return laws.forces.copy(), laws.left.copy()


def left(
    matrix: np.ndarray, offset: np.ndarray, bounds: np.ndarray, lower: np.ndarray | None = None, solve=SOLVE
) -> np.ndarray:
    """Return the accelerations that the forces leave."""
    return solved(matrix, offset, bounds, -bounds if lower is None else lower, solve)[1]


def random_problem(numbers: np.random.Generator, stops: bool) -> tuple[np.ndarray, ...]:
    """Return rows, a right side and bounds; ranks from 1 to k, every fifth problem with two parallel columns.

    With `stops` every third force only pushes.
    """
    k = int(numbers.integers(1, 7))
    rows = numbers.normal(size=(int(numbers.integers(1, k + 1)), k))
    if k > 1 and numbers.integers(5) == 0:
        rows[:, 1] = rows[:, 0] * numbers.normal()
    right, bounds = numbers.normal(size=len(rows)), numbers.uniform(size=k)
    pushes = stops & (numbers.integers(3, size=k) == 0)
    return rows, right, np.where(pushes, 0.0, bounds), np.where(pushes, -np.inf, -bounds)


def compare(count: int, stops: bool) -> None:
    numbers = np.random.default_rng(52)
    for _ in range(count):
        rows, right, bounds, lower = random_problem(numbers, stops)
        best = lsq_linear(rows, right, (lower, bounds), method="bvls", tol=1e-15, max_iter=100).x
        here = left(rows.T @ rows, rows.T @ right, bounds, lower)
        np.testing.assert_allclose(here, rows.T @ (right - rows @ best), rtol=0, atol=1e-10)


@pytest.mark.slow_cases("False", "True")
@pytest.mark.parametrize("stops", [False, True])
def test_accelerations_are_those_of_bounded_least_squares(stops: bool) -> None:
    compare(500, stops)


def test_what_forces_cannot_reach_drives_them_to_a_bound() -> None:
    """Of rates that depend on each other and cannot rest together, as at a dead centre: optimality of each force."""
    numbers = np.random.default_rng(239)
    driven = 0
    for _ in range(500):
        k = int(numbers.integers(2, 7))
        rows = numbers.normal(size=(int(numbers.integers(1, k)), k))
        offset, bounds = numbers.normal(size=k), numbers.uniform(0.1, 2.0, size=k)
        c, _ = solved(rows.T @ rows, offset, bounds, -bounds)
        a = offset - rows.T @ (rows @ c)
        upper, lower = c >= (1.0 - 1e-12) * bounds, c <= -(1.0 - 1e-12) * bounds
        assert (a[upper] >= -1e-10).all() and (a[lower] <= 1e-10).all()
        np.testing.assert_allclose(a[~(upper | lower)], 0.0, rtol=0.0, atol=1e-10)
        driven += bool((np.abs(a) > 1e-6).any())
    assert driven > 400


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_many_accelerations_are_those_of_bounded_least_squares() -> None:
    compare(10_000, False)


def test_plain_python_has_the_same_bits() -> None:
    numbers = np.random.default_rng(7)
    for _ in range(50):
        rows, right, *bounds = random_problem(numbers, True)
        problem = rows.T @ rows, rows.T @ right, *bounds
        np.testing.assert_array_equal(left(*problem), left(*problem, solve=plain_form(FIND)))


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


def test_rounding_of_mobilities_is_no_contradiction() -> None:
    """A stop and friction on one coordinate near a dead centre: their mobilities differ by 4e-11."""
    matrix = np.array([[1.0390314519674118, -1.0390314519271537], [-1.0390314519271537, 1.0390314518868957]])
    offset, bounds, lower = (
        np.array([5.540439820828781, -5.540439820828781]),
        np.array([0.54691, 0.0]),
        (-0.54691, -np.inf),
    )
    forces, accelerations = solved(matrix, offset, bounds, np.array(lower))
    np.testing.assert_allclose(accelerations, 0.0, rtol=0.0, atol=1e-9)
    assert forces[0] - forces[1] == pytest.approx(5.3323119, rel=1e-7)
