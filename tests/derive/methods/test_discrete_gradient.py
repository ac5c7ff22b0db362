"""The discrete gradient: a step by NumPy, order, energy to rounding in the plane and in space, momenta of points."""

import numpy as np
import pytest
from support.convergence import MOTIONS, compared, orders
from support.emitted import mechanism_of
from support.textbook import Textbook, first_step

import symgen
from symgen import load

#: Three points on two rods, free in space.
POINTS = {
    "mechanism": {"name": "points", "space": "spatial", "gravity": [0.0, 0.0, 0.0]},
    "bodies": {
        "a": {"type": "point", "mass": 1.0, "position": [0.0, 0.0, 0.0], "velocity": [0.0, 0.5, 0.0]},
        "b": {"type": "point", "mass": 2.0, "position": [1.0, 0.0, 0.0], "velocity": [0.0, -0.5, 0.8]},
        "c": {"type": "point", "mass": 0.5, "position": [1.0, 1.0, 0.0], "velocity": [0.3, -0.5, 0.2]},
    },
    "joints": {
        name: {"type": "distance", "between": list(name), "at": ["centre", "centre"], "length": 1.0}
        for name in ("ab", "bc")
    },
}
WEIGHTS, NODES = (x / 2.0 for x in np.polynomial.legendre.leggauss(12)[::-1])


def energy_errors(result):
    return np.abs(result.energy.values[:, result.energy.names.index("error")])


@pytest.mark.slow_cases("four-bar")
@pytest.mark.parametrize("name", ["four-bar", "slider-crank"])
def test_a_step_meets_the_equations_of_the_scheme(name):
    """Means by twelve nodes in equations from an independent derivation, which have one solution."""
    h, book = 5e-3, Textbook(name)
    (q0, v0), (q1, v1) = first_step(load(name), h, method="discrete-gradient")
    v = 0.5 * (v0 + v1)
    np.testing.assert_allclose(q1 - q0, h * v, rtol=0.0, atol=1e-15)
    path = [(w, (0.5 + x) * h, q0 + (0.5 + x) * h * v) for w, x in zip(WEIGHTS, NODES, strict=True)]
    d = sum(w * book.rows(t, q, v)[1] for w, t, q in path)
    rest = sum(w * book.force(t, q, v) for w, t, q in path) - book.mass @ (v1 - v0) / h
    multipliers = np.linalg.lstsq(d.T, rest, rcond=None)[0]
    np.testing.assert_allclose(d.T @ multipliers, rest, rtol=0.0, atol=1e-9 * np.abs(rest).max())
    np.testing.assert_allclose(book.rows(h, q1, v1)[0], 0.0, atol=1e-14)


@pytest.mark.slow_cases("spatial-slider-crank-0.5-keys2", "spatial-slider-crank-0.5-keys3", "four-bar-2.0-keys5")
@pytest.mark.parametrize(("name", "until", "keys"), MOTIONS)
def test_order_two_with_positions_on_their_constraints(name, until, keys):
    results, errors = compared(load(name), until, method="discrete-gradient", max_violation=1e-2, **keys)
    assert max(r.position_violation_max for r in results) < 1e-13
    np.testing.assert_allclose(orders(errors), 2.0, atol=0.1)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "step"), [("four-bar", 5e-3), ("bricard", 1e-2), ("spherical-double-pendulum", 5e-3), ("heavy-top", 2e-3)]
)
def test_energy_changes_by_rounding_alone(name, step):
    loose = {"until": 5.0, "step": step, "max_energy_error": 1e9, "max_violation": 1.0}
    kept, other = (energy_errors(load(name).simulate(method=m, **loose)) for m in ("discrete-gradient", "rattle"))
    scale = np.abs(load(name).simulate(method="rattle", **loose).energy.values).max()
    assert kept.max() < 1e-12 * scale < 1e-8 * scale < other.max()


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_energy_changes_by_rounding_alone_in_ten_thousand_swings():
    """10^6 steps: less than one rounding of the energy in each, and many orders below what the scheme is off by."""
    swings = {"until": 2e4, "step": 2e-2, "output_step": 5.0, "max_energy_error": 1e9}
    result = load("pendulum").simulate(method="discrete-gradient", **swings)
    assert result.steps == 1_000_000
    assert (
        energy_errors(result).max()
        < 1e-9
        < 1e-3
        < energy_errors(
            load("pendulum").simulate(method="rattle", **swings | {"until": 20.0, "output_step": 0.02})
        ).max()
    )


def test_momenta_of_points_are_kept_to_rounding():
    result = symgen.load(mechanism_of(POINTS)).simulate(method="discrete-gradient", step=1e-2, until=100.0)
    q, v = (np.asarray(x).reshape(len(result.t), 3, 3) for x in (result.q, result.v))
    momenta = np.array([1.0, 2.0, 0.5])[:, np.newaxis] * v
    linear, angular = momenta.sum(axis=1), np.cross(q, momenta).sum(axis=1)
    assert np.abs(q[-1] - q[0]).max() > 1.0
    assert np.abs(linear - linear[0]).max() < 1e-12
    assert np.abs(angular - angular[0]).max() < 1e-12 * np.abs(q).max() * np.abs(momenta).max()
    assert energy_errors(result).max() < 1e-12


@pytest.mark.slow
def test_power_of_dampers_is_part_of_the_balance():
    """Damped motion: what the energy loses is the work of the damper, which is integrated with the same means."""
    result = load("flyball-governor").simulate(method="discrete-gradient", step=1e-4, until=0.1)
    lost = result.energy.values[:, result.energy.names.index("total")]
    assert np.abs(lost[-1] - lost[0]) > 1e-3
    assert energy_errors(result).max() < 1e-10 * np.abs(lost).max()
