"""Linear systems by parameters: against complex steps through closed forms, and differences of whole answers."""

import cmath

import pytest
from numpy.testing import assert_allclose

from analyses import rods
from symgen.base.errors import InputError

STEP = 1e-40


def swing(doubled=False):
    """A point mass on a link whose length follows from another one, swinging through its start."""
    link = rods.pin("ground", "bob", rods.GROUND2, "centre", "distance", length="long")
    joints = {"link": link}
    if doubled:
        joints["again"] = {**link, "between": ["bob", "ground"], "at": ["centre", [0.0, 0.0]], "length": 1.0}
    body = {"type": "point", "mass": 2.0, "position": [0.6, -0.8], "velocity": [0.4, 0.3]}
    push = {"type": "force", "body": "bob", "force": ["-drag*bob.vx", 0.0]}
    return rods.model(
        {"bob": body},
        joints,
        parameters={"short": 0.5, "long": "2*short", "drag": 0.3},
        forces={"drag": push},
        outputs={"high": "bob.y"},
    )


def falls(x, vx, long, drag):
    """x'' of the swinging point, by the angle from the vertical."""
    angle = cmath.asin(x / long)
    rate = vx / (long * cmath.cos(angle))
    along = -9.81 * cmath.sin(angle) - drag / 2.0 * vx * cmath.cos(angle)
    return along * cmath.cos(angle) - long * rate**2 * cmath.sin(angle)


def test_what_a_parameter_moves_is_held_where_the_states_are():
    """x and x' stay as the link gets longer: what it does to x'' is told by a complex step."""
    system = swing().linearise(at="start", states=("bob.x",), instantaneous=True, by=("short", "long", "drag"))
    assert system.inputs == system.parameters == ("short", "long", "drag") and system.outputs == ("high",)
    at, row = (0.6, 0.4, 1.0, 0.3), []
    for k in (2, 3):
        moved = [complex(x) for x in at]
        moved[k] += 1j * STEP
        row.append(falls(*moved).imag / STEP)
    assert_allclose(system.B, [[0.0, 0.0, 0.0], [2.0 * row[0], row[0], row[1]]], rtol=1e-12, atol=1e-13)
    assert_allclose(system.D, [[-2.0 / 0.8, -1.0 / 0.8, 0.0]], rtol=1e-13)  # y = -sqrt(l^2 - x^2)


def test_a_parameter_with_a_number_of_its_own_follows_no_formula():
    asked = {"at": "start", "states": ("bob.x",), "instantaneous": True, "by": ("short", "long")}
    system = swing().linearise(parameters={"long": 1.0}, **asked)
    assert not system.B[:, 0].any() and system.B[1, 1] != 0.0


def test_masses_of_a_four_bar():
    """Differences of accelerations at other masses have two thirds of the digits."""
    import symgen

    model, names = symgen.load("four-bar"), ("crank_mass", "coupler_mass", "rocker_mass")
    asked = {"start": {"crank.theta": 0.7, "crank.omega": 2.0}}
    states = {"at": "start", "states": ("crank.theta",), "instantaneous": True}
    system = model.linearise(by=names, **states, **asked)
    base = model.parameters()
    for k, name in enumerate(names):
        ends = []
        for sign in (1.0, -1.0):
            run = model.simulate(parameters={name: base[name] + sign * 1e-4}, until=1e-3, step=1e-3, **asked)
            ends.append(run.a["crank.alpha"][0])
        assert system.B[1, k] == pytest.approx((ends[0] - ends[1]) / 2e-4, rel=1e-6)


def test_an_equilibrium_by_its_parameters():
    system = rods.mass_spring_damper().linearise(by=("k",), parameters={"k": 4000.0}, start={"body.x": 0.3})
    assert_allclose(system.B, [[0.0, 0.0], [1 / 1.6, 0.0]], atol=1e-12)  # at rest the spring is slack
    assert system.parameters == ("k",) and system.to_dict()["parameters"] == ["k"]


def test_parameters_that_mean_nothing_are_refused():
    with pytest.raises(InputError, match=r"by 'lang': expected a parameter of rods, got none of that name.*'long'"):
        swing().linearise(by=("lang",))


def test_what_redundant_joints_do_not_allow_is_refused():
    with pytest.raises(InputError, match="by 'long': expected a parameter that redundant joints allow to change"):
        swing(doubled=True).linearise(at="start", states=("bob.x",), instantaneous=True, by=("long",))
