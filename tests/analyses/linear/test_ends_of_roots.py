"""Forces whose slopes are products of 0 and infinity where mechanisms rest: contact as by Hertz, drag by speed."""

import math

import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from analyses import rods

STIFFNESS, GRAVITY = 1e5, rods.GRAVITY


def block(force, y):
    """A block of 1 kg on a vertical rail."""
    body = {"mass": 1.0, "inertia": 0.1, "position": [0.0, y]}
    rail = rods.pin("ground", "a", rods.GROUND2, rods.GROUND2, "translational", axis=[0.0, 1.0])
    push = {"type": "force", "body": "a", "at": [0.0, 0.0], "force": [0.0, force]}
    return rods.model({"a": body}, {"rail": rail}, forces={"push": push})


@pytest.mark.parametrize("exponent", [1.5, 2.5, 1.7])
def test_what_falls_on_a_sphere_comes_to_rest_there(exponent):
    """The search begins where nothing touches, and no slope of the contact was a number."""
    found = block(f"{STIFFNESS}*max(0, -a.y)**{exponent}", 0.3).equilibrium()
    deep = (GRAVITY / STIFFNESS) ** (1.0 / exponent)
    assert_allclose(found.q["a.y"], -deep, rtol=1e-12)
    assert_allclose(found.omega_squared, [exponent * STIFFNESS * deep ** (exponent - 1.0)], rtol=1e-10)


@pytest.mark.parametrize("drag", ["a.vy*sqrt(a.vx**2 + a.vy**2)", "a.vy*abs(a.vy)**0.5", "a.vy*abs(a.vy)**0.3"])
def test_drag_by_speed_does_not_damp_at_rest(drag):
    found = block(f"-100*a.y - 2*{drag}", 0.1).modes()
    assert_allclose(found.eigenvalues, [10j, -10j], rtol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["radau5", "sdirk"])
def test_implicit_steps_fall_where_nothing_touches(integrator):
    """Newton's matrices held what is no number, so that runs ended at their start."""
    model = block(f"{STIFFNESS}*max(0, -a.y)**1.5", 0.5)
    run = model.simulate(integrator=integrator, until=0.45, rtol=1e-9, atol=1e-9)
    assert run.status == "ok"
    assert_allclose(run.q["a.y"][-1], -whole_bounce(0.45), atol=1e-5)


def whole_bounce(t):
    """How deep a block that falls from 0.5 m is pressed in or below 0, by SciPy behind the fall."""
    touch = math.sqrt(2.0 * 0.5 / GRAVITY)

    def rate(_, z):
        return [z[1], GRAVITY - STIFFNESS * max(0.0, z[0]) ** 1.5]

    run = solve_ivp(rate, (touch, t), [0.0, GRAVITY * touch], "DOP853", rtol=1e-10, atol=1e-12)
    return run.y[0, -1]
