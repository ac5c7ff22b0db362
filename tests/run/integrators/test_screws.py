"""Runge-Kutta-Munthe-Kaas on SE(3): order 4, and lower pairs to the ground that hold to rounding uncorrected."""

import numpy as np
import pytest
from support.convergence import compared, orders

from symgen.api import load
from symgen.describe.files.builder import MechanismBuilder


@pytest.mark.slow_cases("heavy-top-keys2")
@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("heavy-top", {}),
        ("heavy-top", {"coordinates": "joint"}),
        ("heavy-top", {"shape": "looped"}),
        ("spatial-slider-crank", {}),
        ("spherical-double-pendulum", {}),
    ],
)
def test_order_four(name, keys):
    settings = {"method": "lagrange", "integrator": "rkmk4-screws", "max_violation": 1e-4, **keys}
    _, errors = compared(load(name), 0.5, **settings)
    np.testing.assert_allclose(orders(errors), 4.0, atol=0.15)


def swung(kind):
    """A body off the axis of a joint with the ground, in general motion under gravity."""
    inertia = [[0.02, 0.001, 0.002], [0.001, 0.03, 0.0], [0.002, 0.0, 0.01]]
    builder = MechanismBuilder(kind, space="spatial", gravity=[0.3, 0.4, -9.81])
    at, axis = [0.4, 0.3, -0.2], [1.0, 0.5, 0.3]
    spin = np.array(axis) / np.linalg.norm(axis) * 6.0 if kind != "spherical" else np.array([4.0, -3.0, 6.0])
    moves = {"angular_velocity": spin.tolist(), "velocity": np.cross(spin, at).tolist()}
    builder.body("a", mass=1.3, inertia=inertia, position=at, points={"O": [-x for x in at]}, **moves)
    more = {} if kind == "spherical" else {"axis": axis}
    builder.joint("pair", kind, between=["ground", "a"], at=[[0.0, 0.0, 0.0], "O"], **more)
    return load(builder.build())


@pytest.mark.parametrize("kind", ["spherical", "revolute", "cylindrical"])
def test_lower_pairs_to_the_ground_hold_without_correction(kind):
    keys = {"method": "lagrange", "step": 5e-3, "until": 2.0, "max_violation": 1.0}
    screws = swung(kind).simulate(integrator="rkmk4-screws", **keys)
    turned = swung(kind).simulate(integrator="rkmk4", **keys)
    assert screws.status == "ok", screws.reason
    assert screws.position_violation_max < 1e-12 < 1e-8 < turned.position_violation_max
    assert screws.velocity_violation_max < 1e-11


def test_the_plane_has_no_screws():
    keys = {"method": "lagrange", "step": 1e-3, "until": 0.2, "times": [0.2]}
    one, other = (load("four-bar").simulate(integrator=name, **keys) for name in ("rk4", "rkmk4-screws"))
    np.testing.assert_allclose(np.asarray(one.q), np.asarray(other.q), rtol=0.0, atol=1e-13)
