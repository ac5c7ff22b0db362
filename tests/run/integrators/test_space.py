"""Integrators in space: orders on a body on a ball joint with another one hinged to it, exponentials, turn lengths.

The motion they are measured against is taken from another formulation: both bodies' orientations as rotation matrices
with their nine entries as unknowns, minimum-norm accelerations by LAPACK, SciPy's DOP853.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from symgen.api import load
from symgen.describe.files.builder import MechanismBuilder
from symgen.result.points import Points, rotation_matrices

GRAVITY = np.array([0.0, 0.0, -9.81])
MASSES = (1.0, 0.5)
INERTIAS = (
    np.array([[0.02, 0.001, 0.002], [0.001, 0.03, 0.0], [0.002, 0.0, 0.01]]),
    np.diag([0.02, 0.01, 0.03]),
)
HINGE = np.array([1.0, 0.0, 0.0])
START = (np.array([0.0, 0.5, 0.0]), np.array([0.0, 1.5, 0.0]))
SPINS = ([1.0, 2.0, 4.0], [3.0, 2.0, 4.0])
TIMES = np.linspace(0.0, 0.5, 6)


def mechanism():
    builder = MechanismBuilder("top-with-lever", space="spatial", gravity=GRAVITY)
    for name, mass, inertia, at, spin in zip("ab", MASSES, INERTIAS, START, SPINS, strict=True):
        builder.body(
            *(name,),
            **{"mass": mass, "inertia": inertia, "position": at, "angular_velocity": spin},
            points={"O": [0.0, -0.5, 0.0], "P": [0.0, 0.5, 0.0]},
        )
    builder.joint("ball", "spherical", between=["ground", "a"], at=[[0.0, 0.0, 0.0], "O"])
    builder.joint("hinge", "revolute", between=["a", "b"], at=["P", "O"], axis=HINGE)
    return builder.build()


def hat(w):
    return np.array([[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]])


def rates(_, state):
    """Rates of (r, A, v, omega) of both bodies, angular velocities in body axes."""
    _, a, v, w = (
        state[:6].reshape(2, 3),
        state[6:24].reshape(2, 3, 3),
        state[24:30].reshape(2, 3),
        state[30:].reshape(2, 3),
    )
    low, high = np.array([0.0, -0.5, 0.0]), np.array([0.0, 0.5, 0.0])
    d, gamma = np.zeros((8, 12)), np.zeros(8)
    d[0:3, 0:3], d[0:3, 6:9] = np.eye(3), -a[0] @ hat(low)
    gamma[0:3] = -a[0] @ np.cross(w[0], np.cross(w[0], low))
    d[3:6, 0:3], d[3:6, 3:6] = -np.eye(3), np.eye(3)
    d[3:6, 6:9], d[3:6, 9:12] = a[0] @ hat(high), -a[1] @ hat(low)
    gamma[3:6] = a[0] @ np.cross(w[0], np.cross(w[0], high)) - a[1] @ np.cross(w[1], np.cross(w[1], low))
    x = a[1] @ HINGE
    for k, axis in enumerate(np.eye(3)[1:]):  # the hinge axis of b stays across y and z of a
        y = a[0] @ axis
        row = np.cross(x, y)
        d[6 + k, 6:9], d[6 + k, 9:12] = -(row @ a[0]), row @ a[1]
        wa, wb = a[0] @ w[0], a[1] @ w[1]
        bias = np.cross(wa, np.cross(wa, y)) @ x + np.cross(wb, np.cross(wb, x)) @ y
        gamma[6 + k] = -bias - 2.0 * np.cross(wa, y) @ np.cross(wb, x)
    m = np.zeros((12, 12))
    f = np.zeros(12)
    for i in range(2):
        m[3 * i : 3 * i + 3, 3 * i : 3 * i + 3] = MASSES[i] * np.eye(3)
        m[6 + 3 * i : 9 + 3 * i, 6 + 3 * i : 9 + 3 * i] = INERTIAS[i]
        f[3 * i : 3 * i + 3] = MASSES[i] * GRAVITY
        f[6 + 3 * i : 9 + 3 * i] = -np.cross(w[i], INERTIAS[i] @ w[i])
    full = np.block([[m, d.T], [d, np.zeros((8, 8))]])
    acceleration = np.linalg.solve(full, np.concatenate([f, gamma]))[:12]
    turned = np.stack([a[i] @ hat(w[i]) for i in range(2)])
    return np.concatenate([v.ravel(), turned.ravel(), acceleration])


@cache
def reference() -> np.ndarray:
    """Return centres of mass and rotation matrices at the output times."""
    a = np.stack([np.eye(3), np.eye(3)])
    w = np.array(SPINS)
    v0 = np.cross(w[0], [0.0, 0.5, 0.0])
    v1 = np.cross(w[0], [0.0, 1.0, 0.0]) + np.cross(w[1], [0.0, 0.5, 0.0])
    start = np.concatenate([*START, a.ravel(), v0, v1, w.ravel()])
    options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}
    return solve_ivp(rates, (0.0, TIMES[-1]), start, t_eval=TIMES, **options).y.T[:, :24]


def distance(outcome) -> float:
    """Return the largest distance of centres of mass and tips of axes, 0.5 m out, from the reference's."""
    worst = 0.0
    axes = Points(((0, 0.5), (7, 0.5)), 3)
    for k, (i, _) in enumerate(axes.bodies):
        q = outcome.states[:, i : i + 7]
        worst = max(worst, np.abs(q[:, :3] - reference()[:, 3 * k : 3 * k + 3]).max())
        turned = rotation_matrices(q[:, 3:])
        worst = max(worst, 0.5 * np.abs(turned - reference()[:, 6 + 9 * k : 15 + 9 * k].reshape(-1, 3, 3)).max())
    return float(worst)


def errors(method: str, integrator: str, step: float) -> list[float]:
    model, found = load(mechanism()), []
    for h in (step, step / 2.0):
        # violations of order two belong to the index-3 methods; what is judged here is the motion
        result = model.simulate(
            method=method, integrator=integrator, step=h, until=TIMES[-1], times=TIMES, max_violation=1e-2
        )
        assert result.status == "ok", result.reason
        states = result.outcome.states
        for i in (3, 10):
            np.testing.assert_allclose(np.linalg.norm(states[:, i : i + 4], axis=1), 1.0, atol=1e-14)
        found.append(distance(result.outcome))
    return found


@pytest.mark.slow
def test_explicit_exponentials_are_of_order_four():
    coarse, fine = errors("lagrange", "rkmk4", 0.005)
    assert 2.0**3.8 < coarse / fine < 2.0**4.5
    assert fine < 2e-8


@pytest.mark.slow
def test_euler_parameters_reach_the_same_motion():
    coarse, fine = errors("lagrange", "rk4", 0.005)
    assert 2.0**3.7 < coarse / fine < 2.0**4.5
    assert fine < 2e-8


@pytest.mark.slow
def test_generalised_alpha_turns_bodies_by_exponentials():
    coarse, fine = errors("generalized-alpha", "generalized-alpha", 0.002)
    assert 2.0**1.9 < coarse / fine < 2.0**2.1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "integrator", "step", "order"),
    [
        ("index3-augmented-lagrangian", "trapezoidal", 0.002, 2),
        ("lagrange", "newmark", 0.002, 2),
        ("generalized-alpha", "hht", 0.002, 2),
        ("lagrange", "trapezoidal", 0.002, 2),
    ],
)
def test_orders_of_implicit_schemes(method, integrator, step, order):
    coarse, fine = errors(method, integrator, step)
    assert 2.0 ** (order - 0.25) < coarse / fine < 2.0 ** (order + 0.6)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "integrator"), [("lagrange", "radau5"), ("ggl", "radau5"), ("lagrange", "sdirk"), ("lagrange", "rodas")]
)
def test_adaptive_implicit_schemes(method, integrator):
    result = load(mechanism()).simulate(
        method=method, integrator=integrator, rtol=1e-9, atol=1e-10, until=TIMES[-1], times=TIMES
    )
    assert result.status == "ok", result.reason
    assert distance(result.outcome) < 1e-8
