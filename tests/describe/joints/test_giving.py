"""Keys of rolling that gives way: what is refused, and what a joint then has."""

import pytest
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError

WHEEL = {"mass": 1.0, "inertia": 0.02, "position": [0.0, 0.2]}
BALL = {"mass": 1.0, "inertia": [0.02, 0.02, 0.02], "position": [0.0, 0.0, 0.2]}
LAW = {"coefficient": 0.5, "speed": 0.01}
ROLLING = {"type": "rolling", "between": ["wheel", "ground"], "radius": 0.2, "axis": [1.0, 0.0], "on": [0.0, 0.0]}
DISC = {"type": "rolling-disc", "body": "ball", "radius": 0.2, "axis": [0, 1, 0], "normal": [0, 0, 1]}
SPHERE = {"type": "rolling-sphere", "body": "ball", "radius": 0.2, "normal": [0, 0, 1]}


def described(joint, **changes):
    table = {key: value for key, value in (joint | changes).items() if value is not None}
    head = {"name": "x", "space": "planar" if joint["type"] == "rolling" else "spatial"}
    bodies = {"wheel": WHEEL} if joint["type"] == "rolling" else {"ball": BALL, "plate": BALL}
    return mechanism_of({"mechanism": head, "bodies": bodies, "joints": {"road": table}})


@pytest.mark.parametrize(
    ("joint", "changes", "sentence"),
    [
        (ROLLING, {"stiffness": 0.0}, "joints.road.stiffness: expected a value above 0, got 0.0"),
        (ROLLING, {"damping": 3.0}, "joints.road.damping: expected the key stiffness beside it, got 3.0"),
        (DISC, {"damping": 3.0}, "joints.road.damping: expected the key stiffness beside it, got 3.0"),
        (ROLLING, {"stiffness": 1e4, "damping": -1.0}, "joints.road.damping: expected a value of at least 0, got -1.0"),
        (
            ROLLING,
            {"stiffness": 1e4, "offset": 0.1},
            "joints.road.offset: expected no such key beside stiffness, as the disc slips, got 0.1",
        ),
        (
            ROLLING,
            {"stiffness": 1e4, "friction": {"coefficient": 0.5}},
            "joints.road.friction.speed: expected a number or an expression of parameters, got no such key",
        ),
        (
            SPHERE,
            {"stiffness": 1e4, "friction": LAW | {"direction": 0.3}},
            "joints.road.friction: expected the keys coefficient, speed, got the unknown key 'direction'",
        ),
        (
            DISC,
            {"stiffness": 1e4, "friction": LAW | {"speed": 0.0}},
            "joints.road.friction.speed: expected a value above 0, got 0.0",
        ),
        (
            DISC,
            {"stiffness": 1e4, "friction": LAW | {"coefficient": -0.1}},
            "joints.road.friction.coefficient: expected a value of at least 0, got -0.1",
        ),
        (DISC, {"body": None}, "joints.road: expected either the key body or the key between, got neither"),
        (
            DISC,
            {"between": ["ball", "plate"]},
            "joints.road: expected either the key body or the key between, got both",
        ),
        (
            DISC,
            {"body": None, "between": ["ground", "plate"]},
            "joints.road.between: expected what rolls and then the body with the plane, got 'ground' first",
        ),
    ],
)
def test_what_is_wrong_is_named(joint, changes, sentence):
    with pytest.raises(InputError) as error:
        described(joint, **changes)
    assert sentence in str(error.value)


def test_friction_along_a_coordinate_stays_where_nothing_gives_way():
    assert len(described(ROLLING, friction={"sliding": 0.3}).bounded) == 1
    giving = described(ROLLING, friction=LAW, stiffness=1e4)
    assert (giving.bounded, [effort.label for effort in giving.forces[0].efforts]) == ((), ["normal", "roll"])


def test_a_contact_that_gives_way_has_a_gap_and_forces_and_no_rows():
    joint, force = described(DISC, stiffness=1e4, friction=LAW).joints[0], described(DISC, stiffness=1e4).forces[0]
    assert (joint.rows, [label for label, _ in joint.coordinates]) == ((), ["gap"])
    assert [effort.label for effort in force.efforts] == ["normal"], "without friction it is smooth"
    mechanism = described(SPHERE, stiffness=1e4, friction=LAW | {"speed": "1 mm/s"})
    names = symgen.load(mechanism).simulate(until=0.01).elements.names
    assert names == ("road.normal", "road.slip1", "road.slip2", "road.power")


def test_a_body_may_carry_the_plane_of_a_joint_without_slip():
    mechanism = described(DISC, body=None, between=["ball", "plate"])
    assert mechanism.joints[0].bodies == ("ball", "plate")
    assert [row.label for row in mechanism.joints[0].rows] == ["normal", "slip1", "slip2"]
