"""Directions that shall coincide and start on opposite sides: nothing is turned over or held the wrong way round."""

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import AssemblyError

MASS, ARM, G = 2.0, 0.4, 9.81


def hung(joint: dict, **body) -> dict:
    return {
        "mechanism": {"name": "hung", "space": "spatial", "gravity": [0.0, 0.0, -G]},
        "parameters": {"lean": 0.0},
        "bodies": {
            "a": {
                "mass": MASS,
                "inertia": [0.3, 0.5, 0.4],
                "centre_of_mass": [ARM, 0.0, 0.0],
                "velocity": [0.0] * 3,
                "angular_velocity": [0.0] * 3,
            }
            | body
        },
        "joints": {"pin": {"between": ["ground", "a"], "at": [[0.0] * 3, [0.0] * 3]} | joint},
    }


def run(raw: dict, coordinates: str, **changes):
    return symgen.simulate(
        mechanism_of(raw),
        method="direct-correction",
        step=5e-3,
        until=0.4,
        coordinates=coordinates,
        **changes,
    )


def sweep(raw: dict, coordinates: str, leans, **changes):
    asked = {"method": "lagrange", "integrator": "rk4", "step": 5e-3, "until": 0.05} | changes
    return symgen.sweep(mechanism_of(raw), {"lean": leans}, coordinates=coordinates, **asked)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["revolute", "cylindrical"])
def test_axes_that_point_opposite_ways_are_one_line_and_said(kind):
    raw = hung({"type": kind, "axis": [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]], "reference": [[1.0, 0.0, 0.0]] * 2})
    result = run(raw, "absolute")
    assert result.status == "ok"
    assert any("the axes of joint 'pin' point opposite ways" in warning for warning in result.warnings)
    # a compound pendulum that falls from the horizontal: m g (-z) = J omega^2 / 2, and it turns about +y
    fallen, spin = -result.q["a.z"][-1], result.v["a.wy"][-1]
    assert fallen > 0.2
    np.testing.assert_allclose(spin, np.sqrt(2 * MASS * G * fallen / (0.5 + MASS * ARM**2)), rtol=1e-6)
    np.testing.assert_allclose(result.joint_coordinates["pin.angle"][-1], np.arcsin(fallen / ARM), rtol=1e-6)
    model = symgen.load(mechanism_of(raw))
    for analysis in (lambda **joint: run(raw, "joint"), model.equilibrium, model.linearise, model.modes):
        with pytest.raises(AssemblyError, match="'a' would start turned over"):
            analysis(coordinates="joint")
    assert model.equilibrium().stability in ("stable", "indifferent")


@pytest.mark.parametrize(
    "joint",
    [
        {"type": "rigid", "axis": [[0.0, 0.0, 1.0]] * 2, "reference": [[1.0, 0.0, 0.0], [-1.0, 0.1, 0.0]]},
        {"type": "translational", "axis": [1.0, 0.0, 0.0], "reference": [[0.0, 0.0, 1.0], [0.0, 0.1, -1.0]]},
        {"type": "constant-velocity", "axis": [[0.0, 0.0, 1.0]] * 2, "reference": [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]},
    ],
)
def test_directions_that_are_held_together_and_start_apart_are_refused(joint):
    for coordinates in ("absolute", "joint"):
        with pytest.raises(AssemblyError, match="joint 'pin' closes half a turn from where its directions coincide"):
            run(hung(joint), coordinates)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("further", [{}, {"stop_when": "a.z < -9"}])
def test_rows_that_close_half_a_turn_off_fail(coordinates, further):
    joint = {"type": "rigid", "axis": [[0.0, 0.0, 1.0]] * 2, "reference": [[1.0, 0.0, 0.0]] * 2}
    raw = hung(joint, orientation={"rotation_vector": [0.0, 0.0, "lean"]})
    found = sweep(raw, coordinates, [0.0, 3.1, 0.1], **further)
    assert found.status.tolist() == ["ok", "failed", "ok"]
    assert "joint 'pin' closes half a turn from where its directions coincide" in found.reason[1]


@pytest.mark.slow_cases("further0")
@pytest.mark.parametrize("further", [{}, {"stop_when": "a.z < -9"}])
def test_rows_that_joint_coordinates_would_turn_over_fail(further):
    raw = hung(
        {"type": "revolute", "axis": [[0.0, 1.0, 0.0]] * 2, "reference": [[1.0, 0.0, 0.0]] * 2},
        orientation={"rotation_vector": ["lean", 0.0, 0.0]},
    )
    assert sweep(raw, "absolute", [3.1], **further).counts["ok"] == 1
    found = sweep(raw, "joint", [0.0, 3.1, 0.1], **further)
    assert found.status.tolist() == ["ok", "failed", "ok"]
    assert "'a' would start turned over" in found.reason[1]


def test_shafts_of_a_homokinetic_joint_may_lean_by_more_than_a_right_angle():
    shafts = {"type": "constant-velocity", "axis": [[0.0, 0.0, 1.0]] * 2, "reference": [[1.0, 0.0, 0.0]] * 2}
    result = run(hung(shafts, orientation={"rotation_vector": [2.2, 0.0, 0.0]}), "absolute")
    np.testing.assert_allclose(result.q["a.e0"][0], np.cos(1.1), atol=1e-12)


def test_joint_coordinates_turn_no_body_over():
    raw = hung(
        {"type": "revolute", "axis": [[0.0, 1.0, 0.0]] * 2, "reference": [[1.0, 0.0, 0.0]] * 2},
        orientation={"rotation_vector": ["lean", 0.0, 0.0]},
    )
    assert run(raw, "joint", parameters={"lean": 0.1}).status == "ok"
    assert run(raw, "joint", parameters={"lean": 0.0}).warnings == ()
    assert run(raw, "absolute", parameters={"lean": 3.1}).status == "ok"
    with pytest.raises(AssemblyError, match="'a' would start turned over"):
        run(raw, "joint", parameters={"lean": 3.1})
