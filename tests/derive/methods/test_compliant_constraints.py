"""Joints that give way: closed forms at rest, regular at singular positions."""

import numpy as np
import pytest
import scipy.optimize
from support.laws_at import LawAt, described
from support.models import parallelogram

from symgen.api import Model
from symgen.base.errors import InputError
from symgen.describe.files.validate import validate

OMEGA, GRAVITY = 10.0, 9.81


def at_rest(compliance):
    """Place and force of a weight that hangs at rest, by Phi = e lambda / omega^2 with the plain description's Phi."""
    plain = LawAt(described("pendulum"), "lagrange")

    def force(y):
        e = plain.equations([0.0, y], np.zeros(2))
        return e.phi[0], -e.mass[1, 1] * GRAVITY / e.d[0, 1]

    def unbalanced(y):
        phi, multiplier = force(y)
        return phi - compliance * multiplier / OMEGA**2

    length = np.linalg.norm(plain.q)
    y = scipy.optimize.brentq(unbalanced, -1.1 * length, -0.9 * length, xtol=1e-15)
    return y, force(y)[1]


@pytest.mark.parametrize("method", ["compliant-constraints", "penalty"])
@pytest.mark.parametrize("compliance", [1e-3, 1e-6])
def test_at_rest_the_violation_is_the_force_over_a_stiffness(method, compliance):
    """The stiffness is omega^2 / e; a penalty a gives the same with a = 1 / e."""
    name, value = ("penalty", 1.0 / compliance) if method == "penalty" else ("compliance", compliance)
    one = LawAt(described("pendulum"), method, {}, {name: value, "omega": OMEGA})
    y, multiplier = at_rest(compliance)
    _, acceleration, multipliers = one.rates([0.0, y], np.zeros(2))
    assert np.abs(acceleration).max() < 1e-9 and multipliers[0] == pytest.approx(multiplier, rel=1e-9)
    stretch = y + np.linalg.norm(one.q)
    _, acceleration, _ = one.rates([0.0, y - 0.1 * stretch], np.zeros(2))
    assert acceleration[1] == pytest.approx(0.1 * OMEGA**2 * stretch, rel=0.02)


def test_a_run_settles_there():
    model = Model(validate(described("pendulum"), "test"))
    start = {"bob.x": 0.0, "bob.y": -1.0, "bob.vx": 0.0}
    keys = {
        "until": 4.0,
        "integrator": "rk4",
        "step": 1e-3,
        "start": start,
        "max_violation": 1.0,
        "max_energy_error": 1.0,
    }
    result = model.simulate(method="compliant-constraints", options={"method.compliance": 1e-2}, **keys)
    assert result["bob.y"][-1] == pytest.approx(at_rest(1e-2)[0], abs=1e-9) and result["bob.y"][-1] < -1.0009


def test_singular_positions_need_no_decision_on_rank():
    """All links of a parallelogram along the ground: two rows fewer count, and no evaluation asks for a second one."""
    raw = parallelogram()
    one = LawAt(raw, "compliant-constraints", {}, {"compliance": 1e-6})
    one.section("mask")[:] = 0.0
    flat = one.q.copy()
    for i in range(3):
        flat[3 * i : 3 * i + 3] = [i + 0.5, 0.0, 0.0]
    flat[9:] = [2.0, 0.0, 0.0]
    e = one.equations(flat, np.zeros(12))
    assert np.linalg.norm(e.phi) < 1e-15 and np.linalg.matrix_rank(e.d) < 11
    right = e.d @ np.linalg.solve(e.mass, e.f) - e.gamma
    expected = np.linalg.solve(e.schur() + 1e-6 * np.diag(1.0 / one.row_masses()), right)
    law, rate = one.compiled.law_module, np.zeros_like(one.start.y)
    assert law.rhs(0.0, one.state(flat, np.zeros(12)), one.start.p, one.w, one.iw, rate) == 0
    np.testing.assert_allclose(e.mass @ rate[12:24], e.f - e.d.T @ expected, rtol=0.0, atol=1e-7)


def test_a_massless_body_is_refused():
    raw = described("four-bar")
    raw = raw | {"bodies": raw["bodies"] | {"coupler": raw["bodies"]["coupler"] | {"mass": 0.0, "inertia": 0.0}}}
    with pytest.raises(InputError, match="massless bodies"):
        Model(validate(raw, "test")).simulate(method="compliant-constraints", until=0.01)
