"""Orientations that follow functions of time, beside SciPy's rotations, and arms whose hand follows a pose."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import symgen
from symgen.base.errors import InputError

VECTOR = ("0.8*sin(2*t)", "0.5*t", "0.3*sin(t)**2")
ANGLES = ("t", "0.3*sin(t) + 0.2", "0.5*t**2")
#: Keys of a joint -> the rotation of the second body against the first at a time.
WAYS = {
    "vector": (
        {"rotation_vector": VECTOR},
        lambda t: Rotation.from_rotvec([0.8 * np.sin(2 * t), 0.5 * t, 0.3 * np.sin(t) ** 2]),
    ),
    "zyx": (
        {"euler_angles": ANGLES, "convention": "zyx"},
        lambda t: Rotation.from_euler("ZYX", [t, 0.3 * np.sin(t) + 0.2, 0.5 * t**2]),
    ),
    "zxz": (
        {"euler_angles": ANGLES, "convention": "zxz"},
        lambda t: Rotation.from_euler("ZXZ", [t, 0.3 * np.sin(t) + 0.2, 0.5 * t**2]),
    ),
}


def gimbal(**keys):
    """A body on a turning base, whose orientation against the base is given."""
    builder = symgen.MechanismBuilder("gimbal", space="spatial", gravity=(0.0, 0.0, -9.81)).run(until=2.0)
    builder.body("base", mass=2.0, inertia=(0.3, 0.4, 0.5), position=(0.0, 0.0, 0.0))
    builder.body("hand", mass=1.0, inertia=(0.02, 0.03, 0.04), position=(0.3, 0.0, 0.0))
    builder.joint("foot", "revolute", between=("ground", "base"), at=((0, 0, 0), "centre"), axis=(0, 0, 1))
    builder.joint("ball", "spherical", between=("base", "hand"), at=((0.2, 0.0, 0.0), (-0.1, 0.0, 0.0)))
    builder.joint("turn", "orientation", between=("base", "hand"), **keys)
    return symgen.load(builder.build())


def turned(result, body, i):
    return Rotation.from_quat([result[f"{body}.e{k}"][i] for k in (1, 2, 3, 0)])


@pytest.mark.by_turns(6)
@pytest.mark.slow_cases(
    "joint-zyx",
    "looped-zyx",
    "joint-zxz",
    "looped-zxz",
    "joint-vector",
    "looped-vector",
    "plain-vector",
    "plain-zxz",
    "plain-zyx",
)
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    "settings", [{}, {"coordinates": "joint"}, {"shape": "looped"}], ids=["plain", "joint", "looped"]
)
def test_a_body_turns_as_a_function_of_time_says(way, settings):
    """Axes, rates and the balance of energy, which counts what the joint brings in."""
    keys, rotation = WAYS[way]
    result = gimbal(**keys).simulate(rtol=1e-10, output_step=0.05, **settings)
    assert result.ok
    for i, t in enumerate(result.t):
        own = turned(result, "base", i).inv() * turned(result, "hand", i)
        assert (own * rotation(t).inv()).magnitude() < 1e-11
        spin = turned(result, "base", i).inv().apply(
            turned(result, "hand", i).apply([result[f"hand.w{x}"][i] for x in "xyz"])
        ) - [0.0, 0.0, result["base.wz"][i]]
        h = 1e-4
        expected = (rotation(t + h) * rotation(t - h).inv()).as_rotvec() / (2.0 * h)
        np.testing.assert_allclose(spin, expected, atol=1e-6)
    assert np.abs(result.energy_error).max() < 1e-11


#: An arm of six hinges: origin of each link in the one before, and axis, in the frame of either as all angles are 0.
LINKS = (
    ((0.0, 0.0, 0.0), (0, 0, 1)),
    ((0.0, 0.1, 0.3), (0, 1, 0)),
    ((0.4, 0.0, 0.0), (0, 1, 0)),
    ((0.35, -0.05, 0.0), (0, 1, 0)),
    ((0.1, 0.0, 0.0), (0, 0, 1)),
    ((0.0, 0.0, -0.1), (1, 0, 0)),
)
TOOL = np.array([0.08, 0.0, 0.0])
START = (0.2, -0.7, 1.1, -0.3, 0.4, 0.1)


def pose_of(angles):
    """Place and rotation of the tool, link by link."""
    at, rotation = np.zeros(3), Rotation.identity()
    for (origin, axis), angle in zip(LINKS, angles, strict=True):
        at = at + rotation.apply(origin)
        rotation = rotation * Rotation.from_rotvec(np.multiply(axis, angle))
    return at + rotation.apply(TOOL), rotation


@pytest.mark.slow
def test_inverse_kinematics_of_an_arm_whose_hand_follows_a_pose():
    """Angles that the kinematics find put the tool where the path says, by an own chain of rotations."""
    begin, rotation = pose_of(START)
    along = rotation.as_rotvec()
    builder = symgen.MechanismBuilder("arm", space="spatial", gravity=(0.0, 0.0, -9.81))
    before, at, turn = "ground", np.zeros(3), Rotation.identity()
    for i, ((origin, axis), angle) in enumerate(zip(LINKS, START, strict=True)):
        at = at + turn.apply(origin)
        turn = turn * Rotation.from_rotvec(np.multiply(axis, angle))
        where = {"position": tuple(at), "orientation": {"rotation_vector": tuple(turn.as_rotvec())}}
        builder.body(f"link{i}", mass=1.0, inertia=(0.01, 0.01, 0.01), **where)
        reference = {"reference": ((0, 1, 0), (0, 1, 0))} if axis[1] == 0 else {"reference": ((1, 0, 0), (1, 0, 0))}
        builder.joint(
            f"joint{i}",
            "revolute",
            between=(before, f"link{i}"),
            at=(origin, (0.0, 0.0, 0.0)),
            axis=(axis, axis),
            start={"angle": angle},
            **reference,
        )
        before = f"link{i}"
    for k, (letter, change) in enumerate(zip("xyz", ("0.05*sin(t)", "-0.08*t", "0.06*(1 - cos(2*t))"), strict=True)):
        path = f"{float(begin[k])!r} + {change}"
        builder.joint(f"tool_{letter}", "driver", body="link5", point=tuple(TOOL), coordinate=letter, value=path)
    changes = ("0.3*sin(t)", "0.2*t", "-0.25*t")
    vector = tuple(f"{float(x)!r} + {change}" for x, change in zip(along, changes, strict=True))
    builder.joint("tool_turn", "orientation", between=("ground", "link5"), rotation_vector=vector)
    moved = symgen.load(builder.build()).kinematics(np.linspace(0.0, 2.0, 41))
    for i, t in enumerate(moved.t):
        found, turned_by = pose_of([moved[f"joint{k}.angle"][i] for k in range(6)])
        place = begin + np.array([0.05 * np.sin(t), -0.08 * t, 0.06 * (1.0 - np.cos(2.0 * t))])
        expected = Rotation.from_rotvec(along + np.array([0.3 * np.sin(t), 0.2 * t, -0.25 * t]))
        np.testing.assert_allclose(found, place, atol=1e-9)
        assert (turned_by * expected.inv()).magnitude() < 1e-9
    np.testing.assert_allclose([moved[f"joint{k}.angle"][0] for k in range(6)], START, atol=1e-9)


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        (
            {"rotation_vector": VECTOR, "euler_angles": ANGLES, "convention": "zyx"},
            "joints.turn: expected either the key rotation_vector or the key euler_angles, got both",
        ),
        ({"euler_angles": ANGLES}, "joints.turn.convention: expected three axes such as 'zyx', got no such key"),
        (
            {"euler_angles": ANGLES, "convention": "zyq"},
            "joints.turn.convention: expected three axes such as 'zyx', got 'zyq'",
        ),
        (
            {"rotation_vector": VECTOR, "axis": (0, 0, 1)},
            "joints.turn.axis: expected no such key beside an orientation of time, got [0.0, 0.0, 1.0]",
        ),
        (
            {"rotation_vector": ("hand.x", 0, 0)},
            "joints.turn.rotation_vector[0]: expected a number or an expression of t and parameters, got 'hand.x'",
        ),
        (
            {"rotation_vector": ("t", "t")},
            "joints.turn.rotation_vector: expected three numbers or expressions of t and parameters [x, y, z], got",
        ),
    ],
)
def test_what_is_wrong_is_named(keys, sentence):
    with pytest.raises(InputError) as error:
        gimbal(**keys)
    assert sentence in str(error.value)
