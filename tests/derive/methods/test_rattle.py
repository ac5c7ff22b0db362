"""RATTLE: a step by NumPy, order, both constraints to rounding, the way back, and energy over a long run."""

from dataclasses import replace

import numpy as np
import pytest
from support.convergence import MOTIONS, compared, orders, redundant
from support.textbook import Textbook, first_step

from symgen.api import load
from symgen.base.settings import Settings
from symgen.run.planning.prepare import prepare
from symgen.run.single.run import integrate


@pytest.mark.parametrize("name", ["four-bar", "driven-four-bar", "slider-crank"])
def test_a_step_meets_the_equations_of_the_scheme(name):
    """Both ends of a step in equations from an independent derivation, which have one solution."""
    h, book = 5e-3, Textbook(name)
    (q0, v0), (q1, v1) = first_step(load(name), h, method="rattle")
    v = (q1 - q0) / h

    def is_along(d, rest):
        multipliers = np.linalg.lstsq(d.T, rest, rcond=None)[0]
        np.testing.assert_allclose(d.T @ multipliers, rest, rtol=0.0, atol=1e-9 * max(1.0, np.abs(rest).max()))

    phi, d, nu = book.rows(h, q1, v1)
    is_along(book.rows(0.0, q0, v0)[1], book.force(0.0, q0, v) - book.mass @ (v - v0) * 2.0 / h)
    is_along(d, book.force(h, q1, v) - book.mass @ (v1 - v) * 2.0 / h)
    np.testing.assert_allclose(phi, 0.0, atol=1e-14)
    np.testing.assert_allclose(d @ v1, nu, rtol=0.0, atol=1e-13)


@pytest.mark.parametrize(("name", "until", "keys"), MOTIONS)
def test_order_two_with_both_constraints_to_rounding(name, until, keys):
    results, errors = compared(load(name), until, method="rattle", **keys)
    assert max(max(r.position_violation_max, r.velocity_violation_max) for r in results) < 1e-13
    np.testing.assert_allclose(orders(errors), 2.0, atol=0.1)


@pytest.mark.parametrize("name", ["four-bar", "spatial-slider-crank", "rolling-disc"])
def test_the_way_back_ends_at_the_start(name):
    """Velocities turned round after 100 steps, and 100 steps more: no scheme that is not its own adjoint does it."""
    run = prepare(load(name).mechanism, Settings(method="rattle", step=2e-3, until=0.2))
    info = run.compiled.info

    def end(y):
        outcome = integrate(run.compiled, run.plan.integrator, replace(run.start, y=y), run.spec)
        return np.array(outcome.states[-1][: info.nq + info.nv])

    start = np.array(run.start.y)
    there = np.array(start)
    there[: info.nq + info.nv] = end(start)
    assert np.abs(there - start).max() > 1e-3
    there[info.nq : info.nq + info.nv] *= -1.0
    there[info.nq + info.nv :] = 0.0
    back = end(there)
    back[info.nq :] *= -1.0
    np.testing.assert_allclose(back, start[: info.nq + info.nv], rtol=0.0, atol=1e-10)


def energies(method, integrator, periods):
    """Largest energy errors of the pendulum in the first and the second half of a run."""
    until = 2.0 * periods
    keys = {"until": until, "output_step": 0.1, "max_energy_error": 1e3, "max_violation": 1.0}
    result = load("pendulum").simulate(method=method, integrator=integrator, step=1e-2, **keys)
    assert result.status == "ok", result.reason
    error = np.abs(np.asarray(result.energy)[:, result.energy.names.index("error")])
    return error[: len(error) // 2].max(), error[len(error) // 2 :].max()


def test_the_error_of_energy_is_bounded_over_1000_swings():
    first, second = energies("rattle", "rattle", 1000)
    assert second < 1.05 * first
    first, second = energies("velocity-projection", "rk4", 1000)
    assert second > 1.5 * first  # the same test sees the drift of a scheme that has one


def test_redundant_rows_are_left_out():
    assert redundant("rattle")[1] < 1e-5
