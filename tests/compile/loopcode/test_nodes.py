"""States inside a step of collocation, by NumPy's integrals of the polynomials that the rates are."""

from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial, legendre

from symgen.compile.loopcode import nodes
from symgen.compile.loopcode.nodes import POINTS, TERMS
from symgen.compile.native.types import NODES
from symgen.compile.store.jit import jit
from symgen.run.integrators.picard import coefficients, lobatto

#: Unknown rates: two of velocities, and one between them that is the rate of no coordinate.
ROWS = np.array([3, 2, 3, 4, 0, -1, 1], dtype=np.int64)
WIDTH = 8


@jit()
def expanded(table: Any, rows: Any, weights: Any, first: Any, rates: Any, out: Any, squares: Any) -> None:
    nodes.expand(rows, weights, first, rates, table, out, squares)


@jit()
def refined(rows: Any, table: Any, series: Any, more: Any, out: Any) -> None:
    nodes.refine(rows, table, series, more, out)


@jit()
def placed(terms: int, h: float, x: Any, rows: Any, y: Any, series: Any, once: Any, twice: Any, out: Any) -> None:
    nodes.integrate_legendre(terms, x, once, twice)
    nodes.sum_up(h, terms, x, rows, y, series, once, twice, out)


def plain(function: Any) -> Any:
    """Return the plain Python of a compiled function, whose pieces have their plain forms."""
    return getattr(function, "py_func", function)


@pytest.mark.parametrize("form", [lambda function: function, plain], ids=["compiled", "plain"])
@pytest.mark.parametrize("degree", [NODES, TERMS - 1])
def test_states_inside_a_step_are_integrals_of_its_rates(form: Any, degree: int) -> None:
    """Nine rates determine a polynomial of degree 8, those between them one of degree 15."""
    c, rng, h = coefficients(), np.random.default_rng(degree), 0.3
    polynomials = {int(i): Polynomial(rng.standard_normal(degree + 1)) for i in ROWS[1:4]}
    points, between = 0.5 * (1.0 + lobatto(NODES)[0]), c.middle[-NODES:]
    y, first, rates, more = rng.standard_normal(WIDTH), np.zeros(WIDTH), *np.zeros((2, WIDTH, NODES))
    for i, polynomial in polynomials.items():
        first[i], rates[i], more[i] = polynomial(0.0), polynomial(points[1:]), polynomial(between)
    series, better = np.full((2, WIDTH * TERMS), np.nan)
    form(expanded)(c.legendre, ROWS, np.ones(WIDTH), first, rates.ravel(), series, np.zeros(2 * NODES))
    terms = POINTS
    if degree > NODES:
        terms = TERMS
        form(refined)(ROWS, c.dense, series, more.ravel(), better)
        series = better
    for i, polynomial in polynomials.items():
        values = legendre.legval(2.0 * points - 1.0, series.reshape(WIDTH, TERMS)[i])
        np.testing.assert_allclose(values, polynomial(points), atol=1e-11)
    x, out = rng.uniform(0.0, 1.0, NODES), np.full(WIDTH * NODES, np.nan)
    once, twice = np.full((2, TERMS * NODES), np.nan)
    form(placed)(terms, h, x, ROWS, y, series, once, twice, out)
    expected = np.full((WIDTH, NODES), np.nan)
    for i, q in zip(ROWS[1:4], ROWS[4:], strict=True):
        expected[i] = y[i] + h * polynomials[i].integ()(x)
        if q >= 0:
            expected[q] = y[q] + h * x * y[i] + h * h * polynomials[i].integ(2)(x)
    np.testing.assert_allclose(out.reshape(WIDTH, NODES), expected, atol=1e-12)
