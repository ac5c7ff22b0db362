"""Drift is closed within a few steps, at the price of the integrator's order."""

import numpy as np
from support.laws_at import LawAt, described

from benchmarks import all_orders
from symgen.api import load


def test_a_start_that_is_off_closes_by_the_stability_function_at_minus_one():
    one, h = LawAt(described("four-bar"), "braun-goldfarb"), 1e-3
    off = np.random.default_rng(2).standard_normal(one.nq)
    q, v = one.q + 1e-2 * off / np.linalg.norm(one.equations(one.q, one.v).d @ off), np.zeros(one.nv)
    sizes = [np.linalg.norm(one.equations(q, v).phi)]
    for _ in range(8):
        q, v = one.moved(q, v, h, 1)
        sizes.append(np.linalg.norm(one.equations(q, v).phi))
    np.testing.assert_allclose(np.divide(sizes[1:], sizes[:-1]), 0.375, rtol=0.05)  # 1 - 1 + 1/2 - 1/6 + 1/24
    assert sizes[8] < 1e-3 * sizes[0]


def test_the_order_of_rk4_is_lost():
    order = all_orders.observe("braun-goldfarb", "rk4")
    assert order.slope is not None and 1.8 < order.slope < 3.0, order


def test_adaptive_runs_begin_before_there_is_a_step():
    result = load("four-bar").simulate(method="braun-goldfarb", integrator="dop853", until=1.0)
    assert result.status == "ok", result.reason
    usual = load("four-bar").simulate(integrator="dop853", until=1.0)
    np.testing.assert_allclose(np.asarray(result.q), np.asarray(usual.q), rtol=0.0, atol=1e-6)
