"""The half-explicit scheme: its steps by NumPy, its order, velocities to rounding, and that gamma is not used."""

import numpy as np
import pytest
from support.convergence import MOTIONS, compared, orders, redundant
from support.textbook import Textbook, first_step

from symgen.api import load
from symgen.derive.lower.record_form import record_form
from symgen.derive.methods import METHODS
from symgen.derive.methods._tape import needed_operations

A = ((1 / 3,), (-1.0, 2.0), (0.0, 3 / 4, 1 / 4))
C = (0.0, 1 / 3, 1.0, 1.0)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "driven-four-bar", "slider-crank"])
def test_a_step_is_the_textbooks(name):
    """Stage by stage with dense matrices from an independent derivation; drivers have a nu."""
    h, book = 5e-3, Textbook(name)
    (q0, v0), (q1, v1) = first_step(load(name), h, method="half-explicit")
    q, v = q0, v0
    rates, turning = [], []
    for i, row in enumerate(A):
        d, f = book.rows(C[i] * h, q, v)[1], book.force(C[i] * h, q, v)
        turning.append(v)
        q = q0 + h * sum(a * x for a, x in zip(row, turning, strict=True))
        _, ahead, nu = book.rows(C[i + 1] * h, q, v)
        reached = v0 + h * sum((a * x for a, x in zip(row, rates, strict=False)), np.zeros(len(v0)))
        rates.append(book.saddle(d, ahead, f, (nu - ahead @ reached) / (h * row[-1]))[0])
        v = reached + h * row[-1] * rates[-1]
    np.testing.assert_allclose(q1, q, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(v1, v, rtol=0.0, atol=1e-11)


@pytest.mark.slow_cases("spatial-slider-crank-0.5-keys2", "spatial-slider-crank-0.5-keys3", "four-bar-2.0-keys5")
@pytest.mark.parametrize(("name", "until", "keys"), MOTIONS)
def test_order_three_with_velocities_to_rounding(name, until, keys):
    results, errors = compared(load(name), until, method="half-explicit", max_violation=1e-4, **keys)
    assert max(result.velocity_violation_max for result in results) < 1e-13
    np.testing.assert_allclose(orders(errors), 3.0, atol=0.1)


def test_gamma_enters_nothing_that_moves():
    method = METHODS.get("half-explicit")
    form = record_form(method, method.complete_options({}))
    (part,) = form.parts
    reached = needed_operations((i for _, i in part.outputs), lambda i: form.operations[i].operands)
    names = {form.operations[i].payload for i in reached if form.operations[i].kind == "quantity"}
    assert ("nu",) in names and ("gamma",) not in names


@pytest.mark.slow
def test_redundant_rows_are_left_out():
    result, error = redundant("half-explicit")
    assert error < 1e-6
    assert result.velocity_violation_max < 1e-7  # of the row that is left out, by the drift of positions
