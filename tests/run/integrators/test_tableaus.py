"""Coefficients of the integrators: order conditions of every tree, error estimates, dense output, stability."""

import numpy as np
import pytest
from support.trees import density, largest_defect, stage_weights, trees

from symgen.run.integrators import INTEGRATORS
from symgen.run.integrators._tableau import Tableau

NAMES = [n for n, i in INTEGRATORS.items() if isinstance(i, Tableau)]


def whole(tableau) -> np.ndarray:
    """A of all stages: the scheme's, the one at the end of the step, and those of dense output."""
    s, extra = tableau.stages, len(tableau.extra_c)
    a = np.zeros((s + 1 + extra, s + 1 + extra))
    a[:s, :s] = tableau.a
    a[s, :s] = tableau.b
    if extra:
        a[s + 1 :, : tableau.extra_a.shape[1]] = tableau.extra_a
    return a


def test_the_number_of_trees_is_the_known_one():
    assert [len(trees(n)) for n in range(1, 9)] == [1, 1, 2, 4, 9, 20, 48, 115]
    assert density((((),), ())) == 8


@pytest.mark.parametrize("name", NAMES)
def test_order_is_reached_and_not_passed(name):
    tableau = INTEGRATORS.get(name)
    for order in range(1, tableau.order + 1):
        assert largest_defect(tableau.a, tableau.b, order) < 2e-14, f"order {order}"
    assert largest_defect(tableau.a, tableau.b, tableau.order + 1) > 1e-6


@pytest.mark.parametrize(("name", "orders"), [("dopri5", (4,)), ("dop853", (5, 3))])
def test_error_estimates_have_their_orders(name, orders):
    """Weights of an estimate give zero on every tree up to the lower order, and not on the next."""
    tableau = INTEGRATORS.get(name)
    a = whole(tableau)[: tableau.stages + 1, : tableau.stages + 1]
    for weights, reached in zip(tableau.errors, orders, strict=True):
        for order in range(1, reached + 1):
            assert largest_defect(a, weights, order, scale=0.0) < 2e-14, f"order {order}"
        assert largest_defect(a, weights, reached + 1, scale=0.0) > 1e-6


@pytest.mark.parametrize(("name", "reached"), [("dopri5", 4), ("dop853", 7)])
def test_dense_output_has_its_order_everywhere_in_the_step(name, reached):
    tableau = INTEGRATORS.get(name)
    a = whole(tableau)
    for x in (0.0, 0.13, 0.5, 0.77, 1.0):
        weights = tableau.dense @ x ** np.arange(1, tableau.dense.shape[1] + 1)
        for order in range(1, reached + 1):
            assert largest_defect(a, weights, order, x) < 1e-13, f"order {order} at {x}"
    middle = tableau.dense @ 0.5 ** np.arange(1, tableau.dense.shape[1] + 1)
    assert largest_defect(a, middle, reached + 1, 0.5) > 1e-7


@pytest.mark.parametrize("name", ["dopri5", "dop853"])
def test_dense_output_joins_smoothly(name):
    """Slopes at both ends are those of the stages there."""
    tableau = INTEGRATORS.get(name)
    powers = np.arange(1, tableau.dense.shape[1] + 1)
    start, end = tableau.dense @ (powers == 1), tableau.dense @ powers
    unit = np.eye(len(tableau.dense))
    np.testing.assert_allclose(start, unit[0], atol=1e-13)
    np.testing.assert_allclose(end, unit[tableau.stages], atol=2e-12)


@pytest.mark.parametrize("name", NAMES)
def test_stability_ends_where_it_is_said(name):
    """|R(z)| <= 1 on the negative real axis up to the boundary, and not beyond."""
    tableau = INTEGRATORS.get(name)

    def growth(z):
        s = tableau.stages
        return abs(1 + z * tableau.b @ np.linalg.solve(np.eye(s) - z * tableau.a, np.ones(s)))

    inside = np.linspace(1e-3, tableau.real_boundary, 500)
    assert max(growth(-z) for z in inside) <= 1.0 + 1e-9
    assert growth(-tableau.real_boundary * 1.002) > 1.0


@pytest.mark.parametrize("name", NAMES)
def test_packed_coefficients_are_the_same_scheme(name):
    tableau = INTEGRATORS.get(name)
    start, column, value, nodes = tableau.packed()
    a, rows = whole(tableau), len(start) - 1
    found = np.zeros((rows, len(a)))
    for r in range(rows):
        found[r, column[start[r] : start[r + 1]]] = value[start[r] : start[r + 1]]
    np.testing.assert_array_equal(found[: len(a)], a)
    assert len(found) == len(a) + len(tableau.errors)
    for row, weights in zip(found[len(a) :], tableau.errors, strict=True):
        np.testing.assert_array_equal(row[: len(weights)], weights)
        assert not row[len(weights) :].any()
    np.testing.assert_allclose(nodes, a.sum(axis=1), atol=1e-13)
    np.testing.assert_allclose(stage_weights(((),), a), nodes, atol=1e-13)


def test_wrong_coefficients_are_refused():
    from dataclasses import replace

    good = INTEGRATORS.get("dopri5")
    for change in (
        {"b": good.b * 1.01},
        {"c": good.c + 0.1},
        {"a": good.a.T},
        {"errors": (good.errors[0] + 0.1,)},
        {"dense": good.dense * 1.1},
    ):
        with pytest.raises(ValueError, match="tableau dopri5"):
            replace(good, **change)
