"""Mistakes in spatial joints and forces: one sentence each, as for every file."""

import copy

import pytest

from symgen.base.errors import InputError
from symgen.describe.files.validate import collect_errors, validate

RIGID = {"mass": 1.0, "inertia": [1.0, 1.0, 1.0], "points": {"P": [0.1, 0.0, 0.0]}}
GOOD = {
    "mechanism": {"name": "thing", "space": "spatial"},
    "parameters": {"lean": 0.3},
    "bodies": {
        "a": RIGID,
        "b": RIGID | {"orientation": {"rotation_vector": [0.0, 0.0, "lean"]}},
        "dot": {"type": "point", "mass": 1.0},
    },
    "joints": {},
    "forces": {},
}
AB = {"between": ["a", "b"], "at": ["P", "P"]}
GA = {"between": ["ground", "a"], "at": [[0.0, 0.0, 0.0], "P"]}
Z = [0.0, 0.0, 1.0]
PIN = {"pin": {"type": "revolute", **GA, "axis": Z}, "weld": {"type": "rigid", **GA}}
SLEEVE = {
    "sleeve": {"type": "cylindrical", **GA, "axis": Z},
    "cross": {"type": "universal", **GA, "axes": [Z, [1.0, 0, 0]]},
}

JOINTS = [
    ({"type": "rolling", "between": ["a", "ground"]}, "type: expected a type for spatial mechanisms, got 'rolling'"),
    ({"type": "revolute", **GA}, "axis: expected an axis, as a revolute joint in space has one, got no such key"),
    ({"type": "translational", **GA, "axis": [1.0, 0.0]}, "axis: expected a direction [x, y, z] in the first body's"),
    ({"type": "translational", **GA, "axis": Z, "angle": 0.1}, "angle: expected no such key in space, got 0.1"),
    ({"type": "translational", **AB, "axis": Z}, "axis: expected two directions, one in the frame of each body"),
    ({"type": "translational", **AB, "axis": [Z, Z]}, "reference: expected two directions that coincide"),
    ({"type": "translational", **GA, "axis": [0.0, 0.0, 0.0]}, "axis: expected a direction, got a vector of length 0"),
    ({"type": "revolute", **GA, "axis": Z, "reference": [Z, Z]}, "reference: expected a direction across the axis"),
    ({"type": "revolute", **GA, "axis": ["lean", 0.0, 1.0]}, "axis: expected numbers, no expressions of parameters"),
    ({"type": "universal", **GA, "axes": [Z, Z]}, "axes: expected two axes that cross, got two that start parallel"),
    ({"type": "rigid", **AB}, "axis: expected two directions, one in the frame of each body"),
    ({"type": "rigid", "between": ["a", "dot"], "at": ["P", "centre"]}, "expected a body with an angle for 'rigid'"),
    ({"type": "pin-in-slot", **GA, "axis": [Z, Z]}, "axis: expected a direction [x, y] or [x, y, z] in the body's"),
    ({"type": "screw", **GA, "axis": Z}, "pitch: expected a number or an expression of parameters, got no such key"),
    ({"type": "gear", "between": ["a", "b"], "ratio": 2.0}, "joints: expected a value, as 'gear' needs it in space"),
    ({"type": "gear", "joints": ["pin", "pin"], "ratio": 2.0}, "joints: expected two different coordinates"),
    ({"type": "gear", "joints": ["pin", "weld"], "ratio": 2.0}, "joints: expected a joint that has a coordinate"),
    ({"type": "gear", "joints": ["pin", "sleeve"], "ratio": 2.0}, "coordinates: expected one of displacement, angle"),
    ({"type": "gear", "joints": ["pin", "sleeve"], "radii": [1.0, 1.0], "ratio": 1.0}, "either the key radii or"),
    ({"type": "rack-and-pinion", "pinion": "pin", "rack": "pin", "radius": 1.0}, "rack: expected a joint that has"),
    ({"type": "driver", "body": "a", "coordinate": "theta", "value": 0.0}, "coordinate: expected 'x' or 'y' or 'z'"),
    (
        {"type": "driver", "joint": "cross", "coordinate": "angle", "value": 0.0},
        "coordinate: expected a coordinate of joint 'cross', got 'angle'; did you mean 'angle",
    ),
    ({"type": "knife-edge", "body": "a", "axis": Z}, "normal: expected a value, as 'knife-edge' needs it in space"),
    ({"type": "rolling-disc", "body": "dot", "radius": 1.0, "axis": Z, "normal": Z}, "body: expected a body with"),
    ({"type": "rolling-sphere", "body": "a", "radius": 0.0, "normal": Z}, "radius: expected a value above 0, got 0.0"),
    ({"type": "rolling-sphere", "body": "a", "radius": 1.0, "normal": Z, "on": "P"}, "on: expected coordinates"),
]
FORCES = [
    ({"type": "force", "body": "a", "force": [1.0, 0.0]}, "force: expected 3 components, got [1.0, 0.0]"),
    ({"type": "force", "body": "dot", "force": [1.0, 0.0, 0.0], "frame": "body"}, "body: expected a body with"),
    ({"type": "torque", "torque": [1.0, 0.0, 0.0]}, "expected either the key body or the key joint, got neither"),
    ({"type": "torque", "body": "a", "torque": 1.0}, "torque: expected three numbers or expressions [x, y, z]"),
    ({"type": "torque", "body": "a", "torque": [1.0, 0.0]}, "torque: expected three numbers or expressions [x, y, z]"),
    ({"type": "torque", "body": "a"}, "torque: expected three numbers or expressions [x, y, z], got no such key"),
    ({"type": "torque", "body": "a", "torque": [0.0, 0.0, 1.0], "potential": "angle"}, "potential: expected"),
    ({"type": "torque", "joint": "pin", "torque": [0.0, 0.0, 1.0]}, "torque: expected one number or expression"),
    (
        {"type": "torque", "joint": "pin", "frame": "body", "torque": 1.0},
        "frame: expected no such key together with joint",
    ),
    ({"type": "torque", "joint": "weld", "torque": 1.0}, "joint: expected a joint that has an angle, got 'weld'"),
    ({"type": "torsional-spring-damper"}, "joint: expected a value, as 'torsional-spring-damper' needs it in space"),
    ({"type": "bushing", **GA, "stiffness": [1.0, 2.0]}, "stiffness: expected six numbers or expressions"),
    ({"type": "bushing", **GA, "stiffness": [1, 2, 3, 4, 5, [6.0]]}, "stiffness: expected six numbers or six rows"),
    (
        {"type": "bushing", **GA, "damping": [[float(j < i) for j in range(6)] for i in range(6)]},
        "damping: expected a symmetric matrix, got different entries 21 and 12",
    ),
]


@pytest.mark.parametrize(
    ("section", "table", "sentence"), [("joints", *c) for c in JOINTS] + [("forces", *c) for c in FORCES]
)
def test_one_sentence(section, table, sentence):
    raw = copy.deepcopy(GOOD)
    raw["joints"] |= PIN | SLEEVE
    raw[section]["it"] = table
    with pytest.raises(InputError) as error:
        validate(raw, "thing.toml")
    message = str(error.value)
    assert message.startswith(f"thing.toml: {section}.it") and sentence in message
    assert "\n" not in message and len(message) < 400
    assert [str(each) for each in collect_errors(raw, "thing.toml")] == [message]


@pytest.mark.parametrize(
    ("section", "table", "sentence"),
    [
        ("joints", {"type": "spherical", **GA}, "type: expected a type for planar mechanisms, got 'spherical'"),
        ("joints", {"type": "gear", "joints": ["a", "b"], "ratio": 1.0}, "between: expected a value, as 'gear'"),
        ("joints", {"type": "knife-edge", "body": "a", "axis": [1.0, 0.0], "normal": Z}, "normal: expected"),
        ("forces", {"type": "torque", "joint": "pin", "torque": 1.0}, "body: expected a value, as 'torque' needs it"),
        ("forces", {"type": "torque", "body": "a", "torque": [1.0, 0.0]}, "torque: expected one number or expression"),
        ("forces", {"type": "force", "body": "a", "force": [1.0, 0.0, 0.0]}, "force: expected 2 components"),
        (
            "joints",
            {
                "type": "translational",
                "between": ["ground", "a"],
                "at": [[0.0, 0.0], "centre"],
                "axis": [[1.0, 0.0], [1.0, 0.0]],
            },
            "axis: expected one direction [x, y]",
        ),
    ],
)
def test_keys_of_space_mean_nothing_in_the_plane(section, table, sentence):
    raw = {"mechanism": {"name": "thing"}, "bodies": {"a": {"mass": 1.0, "inertia": 1.0}}, section: {"it": table}}
    with pytest.raises(InputError, match=r"^thing.toml: \w+.it") as error:
        validate(raw, "thing.toml")
    assert sentence in str(error.value)


def _with_inertia(inertia: object) -> dict:
    return {"mechanism": {"name": "thing", "space": "spatial"}, "bodies": {"a": {"mass": 1.0, "inertia": inertia}}}


def test_a_tensor_in_rows_is_symmetric_up_to_rounding():
    rows = [[1.0, 0.1, 0.0], [0.1 * (1.0 + 2e-15), 2.0, 1e-17], [0.0, -1e-17, 1.5]]
    tensor = validate(_with_inertia(rows), "thing.toml").bodies[0].inertia
    assert [getattr(e, "value", e) for e in tensor] == [1.0, 2.0, 1.5, 0.1, 0.0, 1e-17]
    rows[1][0] = 0.1 + 1e-9
    with pytest.raises(InputError, match="expected a symmetric matrix, got different entries 21 and 12"):
        validate(_with_inertia(rows), "thing.toml")


def test_the_sentence_about_an_inertia_of_zero_shows_how_to_write_it():
    with pytest.raises(InputError, match=r"\[0, 0, 0\] for no inertia.*got 0$"):
        validate(_with_inertia(0), "thing.toml")
    assert validate(_with_inertia([0, 0, 0]), "thing.toml").bodies[0].name == "a"
