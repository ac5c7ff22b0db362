"""Signs of multipliers by statics done by hand: what each joint's documentation says its multipliers are."""

import numpy as np
import pytest
from support.emitted import Emitted, mechanism_of

G = 9.81
BODY = {"mass": 2.0, "inertia": 0.3}
GROUND_AT = [0.0, 0.0]

#: name -> (joints, forces, angle of the body, position of its centre of mass, expected multipliers)
CASES = {
    # a rod held at its left end, its centre of mass 0.5 m to the right: the weld carries weight and moment
    "weld": (
        {"J": {"type": "rigid", "between": ["ground", "b"], "at": [GROUND_AT, [-0.5, 0.0]]}},
        {},
        (0.5, 0.0, 0.0),
        {"J.x": 0.0, "J.y": -2 * G, "J.angle": -0.5 * 2 * G},
    ),
    # hanging at rest: the pin pulls the ground down
    "hanging": (
        {"J": {"type": "revolute", "between": ["ground", "b"], "at": [GROUND_AT, [0.0, 0.4]]}},
        {},
        (0.0, -0.4, 0.0),
        {"J.x": 0.0, "J.y": -2 * G},
    ),
    # the same with the body first: the pin holds the body up
    "body-first": (
        {"J": {"type": "revolute", "between": ["b", "ground"], "at": [[0.0, 0.4], GROUND_AT]}},
        {},
        (0.0, -0.4, 0.0),
        {"J.x": 0.0, "J.y": 2 * G},
    ),
    # a link in tension pulls: positive
    "link": (
        {"J": {"type": "distance", "between": ["ground", "b"], "at": [GROUND_AT, "centre"], "length": 1.5}},
        {},
        (0.0, -1.5, 0.0),
        {"J.distance": 2 * G},
    ),
    # a slide on the ground, loaded 0.2 m to the right of its centre of mass by 3 N downwards
    "slide": (
        {"J": {"type": "translational", "between": ["ground", "b"], "at": [GROUND_AT, "centre"], "axis": [1.0, 0.0]}},
        {"F": {"type": "force", "body": "b", "at": [0.2, 0.0], "force": [0.0, -3.0]}},
        (0.7, 0.0, 0.0),
        {"J.normal": -2 * G - 3.0, "J.angle": -0.2 * 3.0},
    ),
    # a pin in a slot along x: the slot holds the pin up
    "slot": (
        {"J": {"type": "pin-in-slot", "between": ["b", "ground"], "at": ["centre", GROUND_AT], "axis": [1.0, 0.0]}},
        {},
        (0.7, 0.0, 0.0),
        {"J.normal": 2 * G},
    ),
    # a disc on the ground pulled by 4 N at its centre: m a = 4 + f, I a / r = -f r
    "disc": (
        {"J": {"type": "rolling", "between": ["b", "ground"], "radius": 0.5, "axis": [1.0, 0.0], "on": GROUND_AT}},
        {"F": {"type": "force", "body": "b", "force": [4.0, 0.0]}},
        (0.0, 0.5, 0.0),
        {"J.normal": 2 * G, "J.roll": -4.0 * (0.3 / 0.25) / (2.0 + 0.3 / 0.25)},
    ),
    # a motor that holds a horizontal rod: the rod gets + 0.5 m g, the ground the opposite
    "motor": (
        {
            "J": {"type": "revolute", "between": ["ground", "b"], "at": [GROUND_AT, [-0.5, 0.0]]},
            "D": {"type": "driver", "joint": "J", "value": 0.0},
        },
        {},
        (0.5, 0.0, 0.0),
        {"J.x": 0.0, "J.y": -2 * G, "D.driver": -0.5 * 2 * G},
    ),
    # a skate pushed to its right by 3 N: the blade pushes it to the left
    "blade": (
        {"J": {"type": "knife-edge", "body": "b", "axis": [0.0, 1.0]}},
        {"F": {"type": "force", "body": "b", "force": [3.0, 2 * G]}},
        (0.0, 0.0, 0.0),
        {"J.normal": 3.0},
    ),
}


def solve(description, q):
    emitted = Emitted(mechanism_of(description))
    found = emitted.at(0.0, q, [0.0] * len(q), emitted.parameters({}))
    return found, dict(zip((r.name for r in emitted.info.rows), found.multipliers, strict=True))


@pytest.mark.parametrize("case", CASES)
def test_statics(case):
    joints, forces, q, expected = CASES[case]
    description = {
        "mechanism": {"name": case, "gravity": [0.0, -G]},
        "bodies": {"b": BODY},
        "joints": joints,
        "forces": forces,
    }
    found, multipliers = solve(description, list(q))
    assert multipliers == pytest.approx(expected, abs=1e-12)
    np.testing.assert_allclose(found.phi, 0.0, atol=1e-15)


@pytest.mark.parametrize(("mesh", "held"), [("external", 1.0), ("internal", -1.0)])
def test_gear_passes_torque_on_by_its_radii(mesh, held):
    """Wheel a is turned by 2 N m against wheel b, which a motor holds: the tooth force is -2 / r_a."""
    wheel = {"mass": 1.0, "inertia": 0.1}
    description = {
        "mechanism": {"name": "gear"},
        "bodies": {"a": wheel, "b": wheel},
        "joints": {
            "A": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], "centre"]},
            "B": {"type": "revolute", "between": ["ground", "b"], "at": [[1.0, 0.0], "centre"]},
            "mesh": {"type": "gear", "between": ["a", "b"], "radii": [0.25, 0.75], "mesh": mesh},
            "hold": {"type": "driver", "joint": "B", "value": 0.0},
        },
        "forces": {"drive": {"type": "torque", "body": "a", "torque": 2.0}},
    }
    _, multipliers = solve(description, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0])
    assert multipliers["mesh.mesh"] == pytest.approx(-2.0 / 0.25)
    # on b the mesh exerts -2 r_b / r_a (external); the motor gives the opposite to b, its multiplier acts on the ground
    assert multipliers["hold.driver"] == pytest.approx(-held * 2.0 * 0.75 / 0.25)
