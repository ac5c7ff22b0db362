"""Formulas that read points and joint coordinates, against the same formulas written out in coordinates of bodies."""

import numpy as np
import pytest
from support.emitted import Emitted, mechanism_of

from symgen.base.errors import InputError

PLANAR = {
    "mechanism": {"name": "reader", "gravity": [0.0, -9.81]},
    "parameters": {"reach": 0.7, "k": 3.0},
    "bodies": {
        "arm": {
            "mass": 1.0,
            "inertia": 0.1,
            "centre_of_mass": [0.1, 0.02],
            "points": {"foot": [-0.4, 0.0], "tip": ["reach", 0.2]},
        },
        "rod": {"mass": 0.6, "inertia": 0.05, "points": {"end": [0.3, 0.0]}},
        "dot": {"type": "point", "mass": 0.3},
    },
    "joints": {
        "pin": {"type": "revolute", "between": ["ground", "arm"], "at": [[0.1, 0.2], "foot"]},
        "knee": {"type": "revolute", "between": ["arm", "rod"], "at": ["tip", "end"]},
        "motor": {"type": "driver", "body": "dot", "coordinate": "x", "value": "sin(t)"},
    },
}
#: A point relative to the centre of mass of the arm.
TIP = "(reach - 0.1)", "(0.2 - 0.02)"
X = f"(arm.x + cos(arm.theta)*{TIP[0]} - sin(arm.theta)*{TIP[1]})"
Y = f"(arm.y + sin(arm.theta)*{TIP[0]} + cos(arm.theta)*{TIP[1]})"
VX = f"(arm.vx - arm.omega*(sin(arm.theta)*{TIP[0]} + cos(arm.theta)*{TIP[1]}))"
VY = f"(arm.vy + arm.omega*(cos(arm.theta)*{TIP[0]} - sin(arm.theta)*{TIP[1]}))"
PAIRS = [
    ("arm.tip.x*arm.tip.vy", f"{X}*{VY}"),
    ("k*arm.tip.y - arm.tip.vx**2", f"k*{Y} - {VX}**2"),
    ("sin(knee.angle)*knee.rate", "sin(rod.theta - arm.theta)*(rod.omega - arm.omega)"),
    ("pin.angle.rate - knee.angle", "arm.omega - (rod.theta - arm.theta)"),
    ("motor.displacement*motor.rate", "dot.x*dot.vx"),
    ("where_free(pin.angle)", "where_free(arm.theta)"),
]


def accelerations(force: str, q, v):
    raw = PLANAR | {
        "tables": {"where_free": {"x": [-2.0, 0.0, 2.0], "y": [1.0, 0.0, 5.0]}},
        "forces": {"push": {"type": "force", "body": "rod", "at": [0.0, 0.1], "force": ["t", force]}},
    }
    emitted = Emitted(mechanism_of(raw))
    values = {p.name: p.value for p in mechanism_of(raw).parameters}
    return emitted.at(0.4, q, v, emitted.parameters(values)).acceleration


@pytest.mark.parametrize(("read", "written"), PAIRS)
def test_a_planar_reading_is_its_formula(read, written):
    rng = np.random.default_rng(4)
    q, v = rng.standard_normal(8), rng.standard_normal(8)
    expected, found = accelerations(written, q, v), accelerations(read, q, v)
    # two orders of a few sums of numbers of order 10
    assert np.allclose(found, expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())
    assert np.abs(found - accelerations("0", q, v)).max() > 1e-3


SPATIAL = {
    "mechanism": {"name": "reader", "space": "spatial", "gravity": [0.0, 0.0, -9.81]},
    "bodies": {
        "arm": {
            "mass": 1.0,
            "inertia": [0.1, 0.2, 0.15],
            "centre_of_mass": [0.1, 0.02, -0.1],
            "points": {"tip": [0.7, 0.2, 0.3]},
        },
        "dot": {"type": "point", "mass": 0.3},
    },
    "joints": {
        "hinge": {
            "type": "revolute",
            "between": ["ground", "arm"],
            "at": [[0.0, 0.0, 0.0], "centre"],
            "axis": [0.0, 0.0, 1.0],
            "reference": [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
        }
    },
}


def spatial(force: str, q, v):
    raw = SPATIAL | {"forces": {"push": {"type": "force", "body": "dot", "force": [force, 0.0, 0.0]}}}
    emitted = Emitted(mechanism_of(raw))
    return emitted.at(0.4, q, v, emitted.parameters({})).acceleration[6]


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_point_in_space_is_where_its_body_carries_it(axis):
    rng = np.random.default_rng(8)
    e = rng.standard_normal(4)
    e /= np.linalg.norm(e)
    q, v = np.array([*rng.standard_normal(3), *e, 0.1, 0.2, 0.3]), rng.standard_normal(9)
    a, b, c, d = e
    turned = np.array(
        [
            [1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c)],
        ]
    )
    offset = np.array([0.7, 0.2, 0.3]) - np.array([0.1, 0.02, -0.1])
    letter = "xyz"[axis]
    place, speed = q[:3] + turned @ offset, v[:3] + turned @ np.cross(v[3:6], offset)
    assert spatial(f"0.3*arm.tip.{letter}", q, v) == pytest.approx(place[axis], rel=1e-12, abs=1e-13)
    assert spatial(f"0.3*arm.tip.v{letter}", q, v) == pytest.approx(speed[axis], rel=1e-12, abs=1e-13)


def test_an_angle_in_space_is_the_one_that_the_joint_reports():
    angle = 0.8
    q = np.array([0.0, 0.0, 0.0, np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2), 0.1, 0.2, 0.3])
    v = np.zeros(9)
    v[5] = 2.0
    assert spatial("0.3*hinge.angle", q, v) == pytest.approx(angle, rel=1e-14)
    assert spatial("0.3*hinge.rate", q, v) == pytest.approx(2.0, rel=1e-14)


REFUSED = [
    ("arm.tpi.x", "got 'tpi.x', which body 'arm' does not have; it has x, y, theta, vx, vy, omega, foot.x"),
    ("arm.tip.ax", "got 'arm.tip.ax', which follows from all forces"),
    ("arm.tip", "got 'tip', which body 'arm' does not have"),
    ("arm.tip.z", "got 'tip.z', which body 'arm' does not have"),
    ("pni.angle", "got the unknown body or joint 'pni'; did you mean 'pin'?"),
    ("pin.angel", "got 'angel', which 'pin' does not have; it has angle, angle.rate, rate"),
    ("pin.angle.rate.rate", "got 'angle.rate.rate', which 'pin' does not have"),
    ("ground.tip.x", "got the unknown body or joint 'ground'"),
]


@pytest.mark.parametrize(("text", "sentence"), REFUSED)
def test_what_cannot_be_read_is_refused_with_one_sentence(text, sentence):
    with pytest.raises(InputError) as error:
        accelerations(text, np.zeros(8), np.zeros(8))
    assert sentence in str(error.value)
    assert "\n" not in str(error.value)


def test_drivers_read_no_state():
    raw = PLANAR | {"joints": PLANAR["joints"] | {"turn": {"type": "driver", "joint": "knee", "value": "pin.angle"}}}
    with pytest.raises(InputError, match="has no meaning here"):
        mechanism_of(raw)
