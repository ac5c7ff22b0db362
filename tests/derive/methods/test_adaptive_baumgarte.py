"""Rules that take Baumgarte's gains from the step: stable, and of order 2 at most."""

import math

import numpy as np
import pytest
from support.convergence import compared, orders
from support.laws_at import LawAt, on_rails

from symgen.api import load
from symgen.run.integrators import INTEGRATORS

MODEL, UNTIL = "four-bar", 2.0
UNWATCHED = {"max_violation": 1e-1, "max_energy_error": 1.0}


def grown(z):
    """The stability function of the classical scheme, of a matrix."""
    one = np.eye(len(z))
    return one + z @ (one + z @ (one + z @ (one + z / 4) / 3) / 2)


@pytest.mark.parametrize(
    ("rule", "root"), [("taylor", -1.0 + 1.0j), ("pole-placed", -1.729444231067705 + 0.8889743761218646j)]
)
def test_a_seeded_violation_decays_by_the_stability_function_where_constraints_are_linear(rule, root):
    one, h = LawAt(on_rails(), "adaptive-baumgarte", {"rule": rule}), 0.01
    states = [np.array([[0.01, -0.02], [0.3, 0.1]])]  # Phi and Phi' of both rows
    matrix = h * np.array([[0.0, 1.0], [-(abs(root) ** 2) / h**2, 2.0 * root.real / h]])
    q, v = [0.01, 0.3, -0.02], [0.3, 0.7, 0.1]
    for _ in range(4):
        q, v = one.moved(q, v, h, 1)
        states.append(grown(matrix) @ states[-1])
        np.testing.assert_allclose(
            [q[[0, 2]], v[[0, 2]]], states[-1], rtol=0.0, atol=1e-8 if rule != "taylor" else 1e-13
        )
    shrunk = max(abs(np.linalg.eigvals(grown(matrix))))
    assert shrunk == pytest.approx(0.3727, abs=1e-4) if rule == "taylor" else shrunk < 1e-4


def test_the_zero_of_a_stability_function():
    zeros = {name: getattr(INTEGRATORS.get(name), "zero", None) for name in INTEGRATORS.names}
    assert zeros["euler"] == pytest.approx(-1.0) and zeros["heun"] == pytest.approx(-1.0 + 1.0j)
    z = zeros["rk4"]
    assert abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24) < 1e-12 and z.imag > 0.0
    assert all(abs(zeros[name]) < INTEGRATORS.get(name).real_boundary for name in ("rk4", "dopri5", "dop853"))
    assert zeros["abm4"] is zeros["radau5"] is zeros["picard"] is None


@pytest.mark.parametrize("rule", ["taylor", "pole-placed"])
def test_gains_from_the_step_leave_order_two(rule):
    options = {"method.rule": rule}
    settings = {"method": "adaptive-baumgarte", "integrator": "rk4", "options": options, **UNWATCHED}
    _, errors = compared(load(MODEL), UNTIL, **settings)
    np.testing.assert_allclose(orders(errors), 2.0, atol=0.1)
    assert errors[1] > 1e-6  # where a run without stabilisation is off by 5e-8


def test_the_pole_follows_the_integrator():
    """With Euler's scheme alpha = beta = 1 / h: what the other rule gives for a gain that never binds."""
    model, keys = load(MODEL), {"integrator": "euler", "step": 1e-4, "until": 0.05, **UNWATCHED}
    placed = model.simulate(method="adaptive-baumgarte", options={"method.rule": "pole-placed"}, **keys)
    capped = model.simulate(method="adaptive-baumgarte", options={"method.gain": 1e9}, **keys)
    np.testing.assert_allclose(np.asarray(placed.q), np.asarray(capped.q), rtol=0.0, atol=1e-13)
    assert math.isclose(INTEGRATORS.get("euler").zero.real, -1.0)


def test_poles_are_placed_for_explicit_runge_kutta_schemes_only(cli):
    for integrator in ("abm4", "radau5"):
        code, _, said = cli(
            *("run", MODEL, "--method", "adaptive-baumgarte", "--integrator", integrator),
            *("--option", "method.rule=pole-placed"),
        )
        assert code == 2 and "expected an explicit Runge-Kutta scheme" in said, said
