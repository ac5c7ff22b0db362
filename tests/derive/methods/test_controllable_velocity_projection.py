"""A part of the velocity projection takes the part of the energy that theta determines."""

import numpy as np
import pytest
from support.checks import close
from support.laws_at import LawAt, described


@pytest.mark.parametrize("theta", [0.0, 0.3, 1.0, 1.5])
def test_it_takes_the_energy_that_theta_says(theta):
    one = LawAt(described("four-bar"), "controllable-velocity-projection", {}, {"theta": theta})
    rng = np.random.default_rng(1)
    for _ in range(3):
        q, v = one.q + 0.1 * rng.standard_normal(one.nq), rng.standard_normal(one.nv)
        e, (same, after) = one.equations(q, v), one.accepted(q, v)
        whole = e.drift @ np.linalg.solve(e.schur(), e.drift)
        taken = 0.5 * (v @ e.mass @ v - after @ e.mass @ after)
        assert taken == pytest.approx((theta - theta**2 / 2) * whole, rel=1e-11, abs=1e-11 * whole)
        np.testing.assert_array_equal(same, q)


def test_all_of_it_is_the_velocity_projection_in_the_metric_of_mass():
    one = LawAt(described("four-bar"), "controllable-velocity-projection")
    other = LawAt(described("four-bar"), "velocity-projection", {"weight": "mass"})
    rng = np.random.default_rng(2)
    q, v = one.q + 0.1 * rng.standard_normal(one.nq), rng.standard_normal(one.nv)
    close(one.accepted(q, v)[1], other.accepted(q, v)[1], "v", 1e-12)


@pytest.mark.parametrize("a", [1e-2, 1.0, 1e3])
def test_a_finite_penalty_is_a_part_where_there_is_one_row(a):
    """(M + a D^T D) v = M v* + a D^T nu, theta = s / (s + 1 / a)."""
    plain = LawAt(described("pendulum"), "lagrange")
    rng = np.random.default_rng(3)
    q, v = plain.q + 0.1 * rng.standard_normal(plain.nq), rng.standard_normal(plain.nv)
    e = plain.equations(q, v)
    s = float(e.schur()[0, 0])
    one = LawAt(described("pendulum"), "controllable-velocity-projection", {}, {"theta": s / (s + 1.0 / a)})
    expected = np.linalg.solve(e.mass + a * e.d.T @ e.d, e.mass @ v + a * e.d.T @ e.nu)
    close(one.accepted(q, v)[1], expected, "v", 1e-12)
