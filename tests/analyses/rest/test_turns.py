"""Analyses of angles that count turns: both shapes of code remember the same angle, in orders of their own."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from analyses import rods
from symgen.analyses.state.subject import make_subject
from symgen.base.settings import Settings

#: Of the spring on the second hinge [N m/rad].
STIFFNESS = 3.0


def hinged():
    """Two discs on hinges of their own along z, of which the second is held by a torsion spring; no gravity.

    The first one's angle is reported and used by nothing.
    """
    disc = {"mass": 1.0, "inertia": [0.1, 0.1, 0.2]}
    hinge = {"axis": [0.0, 0.0, 1.0]}
    return rods.model(
        {"first": disc, "second": disc},
        {
            "A": rods.pin("ground", "first", rods.GROUND3, "centre", **hinge),
            "B": rods.pin("ground", "second", rods.GROUND3, "centre", **hinge),
        },
        "spatial",
        gravity=[0.0, 0.0, 0.0],
        forces={"spring": {"type": "torsional-spring-damper", "joint": "B", "stiffness": STIFFNESS}},
    )


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize("turned", [0.4, 5.0, -7.5])
def test_what_a_wound_spring_exerts(shape, turned):
    """The balance at the start is what the spring exerts, k times an angle beyond half a turn."""
    model = hinged()
    subject = make_subject(model.mechanism, Settings(shape=shape, start={"B.angle": turned}))
    found = subject.form.at(0.0, subject.y, np.zeros(12), subject.p, subject.w)
    assert abs(turned) < math.pi or subject.compiled.info.windings == 2
    assert_allclose(found.value("balance")[-1], STIFFNESS * turned, rtol=1e-12)


def wound(torque=10.0, gravity=0.0):
    """A rod on a hinge across its end with a torsion spring of 2 N m/rad, which a torque winds; 0 is down."""
    return rods.model(
        {
            "rod": {
                **rods.ROD3,
                "position": [0.0, 0.0, -0.5],
                "orientation": {"x_axis": [0, 0, -1], "y_axis": [0, 1, 0]},
            }
        },
        {"pin": rods.pin("ground", "rod", rods.GROUND3, "A", axis=[0.0, 1.0, 0.0])},
        "spatial",
        gravity=[0.0, 0.0, -gravity],
        forces={
            "spring": {"type": "torsional-spring-damper", "joint": "pin", "stiffness": 2.0},
            "motor": {"type": "torque", "body": "rod", "torque": [0.0, torque, 0.0]},
        },
    )


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("gravity", [0.0, 0.2])
def test_an_equilibrium_more_than_half_a_turn_away(coordinates, gravity):
    """2 a + m g l sin a = 10 N m, 2 kg and 0.5 m: the spring is wound on the way, and so it stays for what is told."""
    angle = 5.0
    for _ in range(30):
        angle -= (2.0 * angle + gravity * math.sin(angle) - 10.0) / (2.0 + gravity * math.cos(angle))
    model, asked = wound(gravity=gravity), {"coordinates": coordinates}
    found = model.equilibrium(**asked)
    assert_allclose(found.q["pin.angle"], angle, rtol=1e-12)
    assert_allclose(found.multipliers["pin.x"], 0.0, atol=1e-11)
    assert_allclose(np.linalg.norm(list(found.multipliers.values())[:3]), 2.0 * gravity, rtol=1e-11, atol=1e-12)
    inertia = rods.ROD3["inertia"][1]
    square = (2.0 + gravity * math.cos(angle)) / (2.0 * 0.25 + eval(inertia))
    assert_allclose(found.omega_squared, [square], rtol=1e-11)
    assert_allclose(model.modes(**asked).omega_squared, [square], rtol=1e-11)
    (again,) = model.equilibria(("pin.angle", [3.5, 4.5, 5.5]), **asked)
    assert_allclose(again.q["pin.angle"], angle, rtol=1e-12)


@pytest.mark.slow_cases("absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_scan_goes_round(coordinates):
    """Beyond half a turn a hinge in space was said to have no such angles, and what rests there was left out."""
    found = wound(0.0, 30.0).equilibria(("pin.angle", np.linspace(-1.0, 7.0, 9)), coordinates=coordinates)
    angles = [0.0, *(brentq(lambda a: 2.0 * a + 30.0 * math.sin(a), *ends, xtol=1e-14) for ends in ((3, 4), (5, 6)))]
    assert_allclose([x.q["pin.angle"] for x in found], angles, atol=1e-11)
    assert [x.stability for x in found] == ["stable", "unstable", "stable"]
