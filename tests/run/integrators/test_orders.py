"""Observed orders of every integrator on every method; the table is that of ``python -m benchmarks.orders``."""

from functools import cache

import numpy as np
import pytest
from support.kinds import CORRECTING, INTEGRATORS, METHODS

from benchmarks import orders
from symgen.api import load


@cache
def observed(model):
    return {(o.method, o.integrator): o for o in orders.observe(model, METHODS, INTEGRATORS)}


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("model", orders.MODELS)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_order(model, method, integrator):
    found = observed(model)[method, integrator]
    if found.slope is None:
        # no degree of freedom is left and positions are corrected: they do not depend on the step
        assert model == "driven-four-bar" and method in CORRECTING
        assert max(found.errors) <= 2e-12
    else:
        assert found.slope >= found.order - 0.2, f"floor {found.floor:.1e}, errors {found.errors}"


@pytest.mark.slow
def test_the_floor_is_at_rounding():
    assert max(o.floor for o in observed("four-bar").values()) <= 1e-12


def test_a_slope_needs_three_halvings_above_the_floor():
    counts = [10, 14, 20, 28, 40, 57, 80]
    errors = [float(n) ** -4 for n in counts]
    assert orders.fitted_slope(counts, errors, 1e-12) == pytest.approx(4.0)
    assert orders.fitted_slope(counts, errors, 40.0**-4 / 100) is None
    assert orders.fitted_slope(counts, [1e-15] * 7, 1e-14) is None


def test_the_closed_form_is_a_solution_of_the_driven_linkage():
    """The reference against the model's own constraints at its start."""
    q, _ = load("driven-four-bar").initial_state(load("driven-four-bar").parameters())
    np.testing.assert_allclose(orders.linkage(0.0), q, atol=1e-14)
