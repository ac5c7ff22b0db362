"""Rolling bodies and blades against closed forms of accelerations and contact forces; Hooke's formula."""

import math

import numpy as np
import pytest
from support.emitted import Emitted, mechanism_of
from support.space import rotation, unit

M, R, G, SLOPE = 1.7, 0.4, 9.81, 0.35
#: The ground's z axis is the normal of a plane that falls towards +x.
GRAVITY = [G * math.sin(SLOPE), 0.0, -G * math.cos(SLOPE)]


def evaluated(inertia, joint, q, v):
    """{row: multiplier}, acceleration and the emitted numbers of one body in one joint."""
    raw = {
        "mechanism": {"name": "contact", "space": "spatial", "gravity": GRAVITY},
        "bodies": {"b": {"mass": M, "inertia": inertia}},
        "joints": {"c": {"body": "b", "normal": [0.0, 0.0, 2.0], **joint}},
    }
    emitted = Emitted(mechanism_of(raw))
    found = emitted.at(0.0, q, v, emitted.parameters({}))
    names = [row.name.removeprefix("c.") for row in emitted.info.rows]
    return dict(zip(names, found.multipliers, strict=True)), found.acceleration, found


def test_a_sphere_rolls_down_with_five_sevenths():
    e = unit([0.3, -0.5, 0.7, 0.2])
    inertia = 0.4 * M * R * R
    q, matrix = [1.0, 2.0, R, *e], rotation(e)
    spin = matrix.T @ np.array([-0.6 / R, 0.8 / R, 1.3])  # rolls along (0.8, 0.6), and spins about the normal
    joint = {"type": "rolling-sphere", "radius": R, "reference": [1.0, 0.0, 0.0]}
    forces, acceleration, found = evaluated([inertia] * 3, joint, q, [0.8, 0.6, 0.0, *spin])
    np.testing.assert_allclose([*found.phi, *found.drift], 0.0, atol=1e-14)
    pull = G * math.sin(SLOPE)
    np.testing.assert_allclose(acceleration[:3], [5.0 / 7.0 * pull, 0.0, 0.0], atol=1e-13)
    np.testing.assert_allclose(matrix @ acceleration[3:], [0.0, 5.0 / 7.0 * pull / R, 0.0], atol=1e-12)
    assert forces["normal"] == pytest.approx(M * G * math.cos(SLOPE))
    assert forces["slip1"] == pytest.approx(-2.0 / 7.0 * M * pull)  # friction holds it back
    assert forces["slip2"] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("heading", [0.0, 0.7, 2.0])
def test_an_upright_disc_rolls_down_with_two_thirds(heading):
    """An upright disc that heads across the slope by an angle: 2/3 of the pull along its heading, friction across."""
    e = np.array([math.cos(heading / 2), 0.0, 0.0, math.sin(heading / 2)])
    along, across = np.array([math.cos(heading), math.sin(heading)]), np.array([-math.sin(heading), math.cos(heading)])
    pull = G * math.sin(SLOPE) * along[0]
    speed = 1.2
    joint = {"type": "rolling-disc", "radius": R, "axis": [0.0, 3.0, 0.0], "reference": [1.0, 0.0, 0.0]}
    inertia = [0.25 * M * R * R, 0.5 * M * R * R, 0.25 * M * R * R]
    q, v = [0.0, 0.0, R, *e], [*(speed * along), 0.0, 0.0, speed / R, 0.0]
    forces, acceleration, found = evaluated(inertia, joint, q, v)
    np.testing.assert_allclose([*found.phi, *found.drift], 0.0, atol=1e-14)
    friction = np.array([forces["slip1"], forces["slip2"]])
    assert along @ friction == pytest.approx(-M * pull / 3.0, abs=1e-12)
    assert acceleration[4] == pytest.approx(2.0 / 3.0 * pull / R, abs=1e-12)
    # an upright disc is pushed at its rim: friction across makes it lean, so it is not the whole pull across
    sideways = G * math.sin(SLOPE) * -math.sin(heading)
    arm = inertia[0] / (inertia[0] + M * R * R)  # leaning about the point of contact takes the rest
    assert across @ friction == pytest.approx(-M * sideways * arm, abs=1e-12)
    assert forces["normal"] == pytest.approx(M * G * math.cos(SLOPE))


@pytest.mark.parametrize(("yaw", "pitch", "lean"), [(0.4, 0.0, 0.0), (0.4, 0.3, 0.0), (-1.0, 0.2, 0.5)])
def test_a_blade_moves_along_its_trace_however_the_body_leans(yaw, pitch, lean):
    turn = [(yaw, 3), (pitch, 2), (lean, 1)]
    matrix = np.eye(3)
    e = np.array([1.0, 0.0, 0.0, 0.0])
    for angle, axis in turn:
        part = np.zeros(4)
        part[0], part[axis] = math.cos(angle / 2), math.sin(angle / 2)
        matrix = matrix @ rotation(part)
        e = np.array(
            [e[0] * part[0] - e[1:] @ part[1:], *(e[0] * part[1:] + part[0] * e[1:] + np.cross(e[1:], part[1:]))]
        )
    trace = np.array([math.cos(yaw), math.sin(yaw), 0.0])
    joint = {"type": "knife-edge", "axis": [1.0, 0.0, 0.0]}
    _, _, found = evaluated([0.3, 0.2, 0.1], joint, [0.0, 0.0, 0.0, *e], [*(1.5 * trace), 0.0, 0.0, 0.0])
    np.testing.assert_allclose([*found.phi, *found.drift], 0.0, atol=1e-14)
    left = np.array([-math.sin(yaw), math.cos(yaw), 0.0])
    np.testing.assert_allclose(-found.d[1, :3], left, atol=1e-14)  # the force of a multiplier of 1
    # at rest at its centre of mass, the blade takes the pull across
    forces, acceleration, _ = evaluated([0.3, 0.2, 0.1], joint, [0.0, 0.0, 0.0, *e], np.zeros(6))
    assert forces["side"] == pytest.approx(-M * GRAVITY[0] * left[0], abs=1e-12)
    assert acceleration[:3] @ left == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("bend", [0.0, 0.4, 1.1])
@pytest.mark.parametrize("turned", [0.0, 0.6, 2.2])
def test_hookes_formula(bend, turned):
    """Shafts in bearings, bent by beta: omega2 / omega1 = cos beta / (1 - sin^2 beta cos^2 theta)."""
    shafts = np.array([0.0, 0.0, 1.0]), np.array([math.sin(bend), 0.0, math.cos(bend)])
    first = np.array([math.cos(turned), math.sin(turned), 0.0])  # the cross's axis in the first shaft's fork
    second = unit(np.cross(shafts[1], first))
    raw = {
        "mechanism": {"name": "shafts", "space": "spatial"},
        "bodies": {n: {"mass": 1.0, "inertia": [1.0, 1.0, 1.0]} for n in "ab"},
        "joints": {
            "u": {
                "type": "universal",
                "between": ["a", "b"],
                "at": ["centre", "centre"],
                "axes": [first.tolist(), second.tolist()],
            }
        },
    }
    emitted = Emitted(mechanism_of(raw))
    upright = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]
    ratio = math.cos(bend) / (1.0 - math.sin(bend) ** 2 * math.cos(turned) ** 2)
    v = [0.0, 0.0, 0.0, *shafts[0], 0.0, 0.0, 0.0, *(ratio * shafts[1])]
    found = emitted.at(0.0, upright * 2, v, emitted.parameters({}), law=False)
    np.testing.assert_allclose([*found.phi, *found.drift], 0.0, atol=1e-14)
