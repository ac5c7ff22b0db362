"""Implicit constraint enforcement with the symplectic Euler scheme: one Newton step of SHAKE, and order 1."""

import numpy as np
import pytest
from support.convergence import compared, orders
from support.textbook import Textbook, first_step

from symgen.api import load


@pytest.mark.slow_cases("four-bar-1.0")
@pytest.mark.parametrize("erp", [1.0, 0.3])
@pytest.mark.parametrize("name", ["four-bar", "driven-four-bar", "slider-crank"])
def test_a_step_is_one_newton_step_of_shake(name, erp):
    """From no multipliers, on the linearised Phi(q0 + h v1) = (1 - e) Phi(q0), a hundred steps behind the start."""
    h, book, model = 5e-3, Textbook(name), load(name)
    keys = {"method": "implicit-constraint", "options": {"method.erp": erp}, "max_violation": 1.0}
    t = 100 * h
    result = model.simulate(step=h, until=t + h, times=[t, t + h], max_energy_error=1e6, **keys)
    (q, v), (q1, v1) = ((np.asarray(result.q)[i], np.asarray(result.v)[i]) for i in range(2))
    phi, d, nu = book.rows(t, q, v)
    assert np.abs(phi).max() > 1e-7
    free = v + h * np.linalg.solve(book.mass, book.force(t, q, v))
    compliance = d @ np.linalg.solve(book.mass, d.T)
    multipliers = np.linalg.solve(h**2 * compliance, erp * phi + h * (d @ free - nu))
    expected = free - h * np.linalg.solve(book.mass, d.T @ multipliers)
    np.testing.assert_allclose(v1, expected, rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(q1, q + h * expected, rtol=0.0, atol=1e-12)


def test_symplectic_euler_moves_positions_by_the_new_velocities():
    (q0, _), (q1, v1) = first_step(load("four-bar"), 1e-2, method="lagrange", integrator="symplectic-euler")
    np.testing.assert_allclose(q1, q0 + 1e-2 * v1, rtol=0.0, atol=1e-15)


@pytest.mark.slow_cases("four-bar-keys2")
@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("four-bar", {}),
        ("four-bar", {"coordinates": "joint"}),
        ("four-bar", {"shape": "looped"}),
        ("rolling-disc", {}),
    ],
)
def test_order_one(name, keys):
    settings = {"method": "implicit-constraint", "max_violation": 1e-1, **keys}
    _, errors = compared(load(name), 0.5, (1e-3, 5e-4, 2.5e-4), **settings)
    np.testing.assert_allclose(orders(errors), 1.0, atol=0.15)


def test_violations_are_judged_as_those_of_every_method():
    result = load("four-bar").simulate(method="implicit-constraint", step=1e-3, until=0.5)
    assert result.status == "failed" and "max_violation" in result.reason
