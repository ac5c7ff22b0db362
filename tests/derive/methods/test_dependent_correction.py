"""Dependent coordinates are corrected, independent ones keep every bit."""

import numpy as np
import pytest
from support.checks import close
from support.laws_at import LawAt, described

from symgen.api import load


@pytest.mark.slow_cases("andrews")
@pytest.mark.parametrize("name", ["four-bar", "andrews"])
def test_independent_coordinates_keep_every_bit(name):
    one = LawAt(described(name), "dependent-correction")
    one.accepted(one.q, one.v)  # the first accepted state chooses the partition
    rng = np.random.default_rng(1)
    size = 1e-3 * np.abs(one.q).max()
    q, v = one.q + size * rng.standard_normal(one.nq), rng.standard_normal(one.nv)
    e, (closed, after) = one.equations(q, v), one.accepted(q, v)
    dependent = after != v
    assert dependent.sum() == len(one.rows) < one.nv
    np.testing.assert_array_equal(closed[~dependent], q[~dependent])
    assert np.abs(closed[dependent] - q[dependent]).max() > 0.1 * np.linalg.norm(e.phi) > 0.0
    e = one.equations(closed, v)
    assert np.abs(e.phi).max() < 1e-12
    columns = e.d[:, dependent]
    expected = v.copy()
    expected[dependent] -= np.linalg.solve(columns, e.drift)
    close(after, expected, "v", 1e-9)


def test_what_closing_stages_buys_beside_closing_steps():
    """Near the motion of `coordinate-partitioning`, whose stages are closed as well; the law is that of `lagrange`."""
    model, times = load("four-bar"), np.linspace(0.0, 2.0, 11)
    exact = model.simulate(integrator="dop853", rtol=1e-12, atol=1e-13, until=2.0, times=times)
    errors = {}
    for method in ("dependent-correction", "coordinate-partitioning", "lagrange"):
        result = model.simulate(method=method, integrator="rk4", step=4e-3, until=2.0, times=times, max_violation=1e-3)
        errors[method] = np.abs(np.asarray(result.q) - np.asarray(exact.q)).max()
    assert errors["dependent-correction"] < 0.5 * errors["lagrange"]
    assert errors["dependent-correction"] < 4.0 * errors["coordinate-partitioning"]


def test_a_partition_that_becomes_poor_is_replaced():
    """The crank goes round, so its angle determines the mechanism; the rocker's does not where it turns back."""
    result = load("four-bar").simulate(method="dependent-correction", integrator="rk4", step=1e-3, until=10.0)
    assert result.status == "ok" and result.position_violation_max < 1e-11


def test_it_is_refused_where_partitions_are(cli):
    code, _, said = cli("run", "four-bar", "--method", "dependent-correction", "--shape", "looped")
    assert code == 2 and "which chooses its partition on a dense matrix" in said
