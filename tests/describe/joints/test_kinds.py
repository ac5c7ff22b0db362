"""Every joint and force type: rows, signs, labels and reported coordinates, checked against poses done by hand."""

import math

import numpy as np
import pytest

from describe.measured import Posed
from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import ZERO, Name, Number
from symgen.base.vocabulary.measures import Angle, Component, Distance, Nonholonomic
from symgen.describe import MechanismBuilder
from symgen.describe.files.json_schema import key_texts
from symgen.describe.forces import FORCES
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.joints import JOINTS

OUT_OF_THE_WAY = {"mass": 1.0, "inertia": 1.0}


def two_bodies() -> MechanismBuilder:
    return (
        MechanismBuilder("pair")
        .parameter("p", 2.0)
        .body("a", mass=1.0, inertia=1.0, points={"P": [0.5, 0.2]}, position=[1.0, 2.0], angle=0.3)
        .body("b", mass=1.0, inertia=1.0, centre_of_mass=[0.1, 0.0], points={"Q": [-0.4, 0.1]}, position=[3.0, 1.0])
        .body("dot", type="point", mass=1.0, position=[0.0, 3.0])
    )


def joint(type, **keys):
    mechanism = two_bodies().joint("J", type, **keys).build()
    return Posed(mechanism), mechanism.joints[0]


def rotation(angle):
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


P = np.array([1.0, 2.0]) + rotation(0.3) @ [0.5, 0.2]
Q = np.array([3.0 - 0.4, 1.0 + 0.1])


def test_revolute():
    posed, found = joint("revolute", between=["a", "b"], at=["P", "Q"])
    assert (found.name, found.kind, found.bodies) == ("J", "revolute", ("a", "b"))
    assert [row.label for row in found.rows] == ["x", "y"]
    np.testing.assert_allclose([posed.residual(row) for row in found.rows], Q - P, rtol=1e-15)
    # force on the first body is -D^T lambda: along +x for the row x
    np.testing.assert_allclose(-posed.gradient(found.rows[0].measure, "a")[:2], [1.0, 0.0])
    assert found.coordinates == (("angle", Angle("a", "b")),)


def test_revolute_with_a_point_mass_reports_no_angle():
    _, found = joint("revolute", between=["a", "dot"], at=["P", "centre"])
    assert found.coordinates == ()


def test_translational_and_its_alias():
    axis = [3.0, 4.0]
    posed, found = joint("translational", between=["a", "b"], at=["P", "Q"], axis=axis, angle="p/4")
    assert [row.label for row in found.rows] == ["normal", "angle"]
    along = rotation(0.3) @ [0.6, 0.8]
    normal = rotation(0.3) @ [-0.8, 0.6]
    assert posed.residual(found.rows[0]) == pytest.approx(normal @ (Q - P))
    assert posed.residual(found.rows[1]) == pytest.approx(-0.3 - 0.5)
    assert found.rows[1].unit == "rad"
    np.testing.assert_allclose(-posed.gradient(found.rows[0].measure, "a")[:2], normal)
    assert posed.measure(dict(found.coordinates)["displacement"]) == pytest.approx(along @ (Q - P))
    _, same = joint("prismatic", between=["a", "b"], at=["P", "Q"], axis=axis, angle="p/4")
    assert same == found


def test_an_axis_of_parameters_has_length_one():
    posed, found = joint("translational", between=["a", "b"], at=["P", "Q"], axis=["3*p", "4*p"])
    along = rotation(0.3) @ [0.6, 0.8]
    assert posed.measure(found.coordinates[0][1]) == pytest.approx(along @ (Q - P))


def test_rigid():
    posed, found = joint("rigid", between=["b", "a"], at=["Q", "P"], angle=0.3)
    assert [row.label for row in found.rows] == ["x", "y", "angle"]
    np.testing.assert_allclose([posed.residual(row) for row in found.rows], [*(P - Q), 0.0], atol=1e-15)


def test_distance():
    length = float(np.linalg.norm(Q - P))
    posed, found = joint("distance", between=["a", "b"], at=["P", "Q"], length=length)
    assert [row.label for row in found.rows] == ["distance"]
    assert posed.residual(found.rows[0]) == pytest.approx(0.0, abs=1e-15)
    # a positive multiplier pulls the first body towards the second
    np.testing.assert_allclose(-posed.gradient(found.rows[0].measure, "a")[:2], (Q - P) / length)


def test_pin_in_slot():
    posed, found = joint("pin-in-slot", between=["b", "a"], at=["Q", "P"], axis=[0.0, 2.0])
    along, normal = rotation(0.3) @ [0.0, 1.0], rotation(0.3) @ [-1.0, 0.0]
    assert [row.label for row in found.rows] == ["normal"]
    assert posed.residual(found.rows[0]) == pytest.approx(normal @ (P - Q))
    np.testing.assert_allclose(-posed.gradient(found.rows[0].measure, "b")[:2], normal, atol=1e-15)
    assert [name for name, _ in found.coordinates] == ["displacement", "angle"]
    assert posed.measure(found.coordinates[0][1]) == pytest.approx(along @ (Q - P))


@pytest.mark.parametrize(("mesh", "sign"), [("external", 1.0), ("internal", -1.0)])
def test_gear_with_radii_and_carrier(mesh, sign):
    built = two_bodies().body("carrier", **OUT_OF_THE_WAY, angle=0.7)
    mechanism = built.joint(
        "J", "gear", between=["a", "b"], carrier="carrier", radii=["p", 0.5], mesh=mesh, offset=0.1
    ).build()
    posed, found = Posed(mechanism), mechanism.joints[0]
    assert found.bodies == ("a", "b", "carrier")
    (row,) = found.rows
    assert (row.label, row.unit) == ("mesh", "m")
    wanted = 2.0 * (0.3 - 0.7) + sign * 0.5 * (0.0 - 0.7) - 0.1
    assert posed.residual(row) == pytest.approx(-wanted)
    turns = [posed.gradient(row.measure, body)[2] for body in ("a", "b", "carrier")]
    np.testing.assert_allclose(turns, [-2.0, -sign * 0.5, 2.0 + sign * 0.5])


def test_gear_with_ratio():
    posed, found = joint("gear", between=["a", "b"], ratio=3.0)
    (row,) = found.rows
    assert (row.unit, found.bodies) == ("rad", ("a", "b"))
    assert posed.residual(row) == pytest.approx(-(0.3 + 3.0 * 0.0))
    assert -posed.gradient(row.measure, "a")[2] == 1.0  # a positive multiplier turns the first wheel forward


def test_rolling_keeps_height_and_contact_at_rest():
    posed, found = joint("rolling", between=["b", "ground"], radius=0.4, axis=[1.0, 0.0], on=[0.5, 0.6], offset=0.2)
    assert [row.label for row in found.rows] == ["normal", "roll"]
    centre = np.array([3.1, 1.0])  # the centre of mass
    normal, roll = found.rows
    assert posed.residual(normal) == pytest.approx(-(centre[1] - 0.6) + 0.4)
    assert posed.residual(roll) == pytest.approx(-(centre[0] - 0.5) + 0.2)
    # rolling to the right at speed v turns the disc by -v / r; the centre of mass lies 0.1 from the frame's origin
    speed = 1.5
    frame = np.array([speed, 0.1 * speed / 0.4, -speed / 0.4])
    assert posed.gradient(roll.measure, "b") @ frame == pytest.approx(0.0)
    assert posed.gradient(normal.measure, "b") @ frame == pytest.approx(0.0)
    np.testing.assert_allclose(-posed.gradient(normal.measure, "b")[:2], [0.0, 1.0])
    np.testing.assert_allclose(-posed.gradient(roll.measure, "b")[:2], [1.0, 0.0])
    assert posed.measure(dict(found.coordinates)["displacement"]) == pytest.approx(2.6)


def test_knife_edge():
    _, found = joint("knife-edge", body="a", at="P", axis=[2.0, 0.0])
    (row,) = found.rows
    assert isinstance(row, Nonholonomic)
    assert (row.label, row.unit, found.bodies) == ("normal", "m/s", ("a",))
    assert tuple(map(to_text, row.speed.along.vector)) in {("0.0", "-1.0"), ("-0.0", "-1.0")}


def test_driver_of_a_joint_named_later():
    mechanism = (
        two_bodies()
        .joint("motor", "driver", joint="J", value="p*t")
        .joint("J", "revolute", between=["a", "b"], at=["P", "Q"])
        .build()
    )
    motor = mechanism.joints[0]
    assert (motor.name, motor.bodies) == ("motor", ("a", "b"))
    (row,) = motor.rows
    assert (row.label, row.measure, to_text(row.value), row.unit) == ("driver", Angle("a", "b"), "p*t", "rad")


def test_driver_of_one_of_two_coordinates():
    slot = {"between": ["b", "a"], "at": ["Q", "P"], "axis": [0.0, 2.0]}
    built = two_bodies().joint("J", "pin-in-slot", **slot)
    with pytest.raises(InputError, match=r"coordinate: expected one of displacement, angle, got no such key"):
        built.joint("one", "driver", joint="J", value="t").build()
    row = (
        two_bodies()
        .joint("J", "pin-in-slot", **slot)
        .joint("two", "driver", joint="J", coordinate="displacement", value=0.0)
    )
    assert row.build().joints[1].rows[0].unit == "m"


@pytest.mark.parametrize(
    ("keys", "expected", "unit"),
    [
        ({"body": "a", "coordinate": "theta"}, 0.3, "rad"),
        ({"body": "b", "coordinate": "x"}, 3.1, "m"),
        ({"body": "a", "point": "P", "coordinate": "y"}, P[1], "m"),
        ({"body": "dot", "coordinate": "y"}, 3.0, "m"),
    ],
)
def test_driver_of_a_body(keys, expected, unit):
    posed, found = joint("driver", value=0.0, **keys)
    assert posed.measure(found.rows[0].measure) == pytest.approx(expected)
    assert (found.rows[0].unit, found.bodies) == (unit, ("ground", keys["body"]))


# Forces ----------------------------------------------------------------------------------------------------


def force(type, **keys):
    mechanism = two_bodies().force("F", type, **keys).build()
    return Posed(mechanism), mechanism.forces[0]


def test_force_in_ground_axes():
    posed, found = force("force", body="a", at="P", force=["3*t", "p*a.vx"])
    assert [effort.label for effort in found.efforts] == ["x", "y"]
    assert [to_text(effort.magnitude) for effort in found.efforts] == ["3.0*t", "p*a.vx"]
    arm = P - np.array([1.0, 2.0])
    np.testing.assert_allclose(posed.gradient(found.efforts[0].measure, "a"), [1.0, 0.0, -arm[1]])
    np.testing.assert_allclose(posed.gradient(found.efforts[1].measure, "a"), [0.0, 1.0, arm[0]])


def test_force_in_body_axes_turns_with_the_body():
    posed, found = force("force", body="a", force=[1.0, "p"], frame="body")
    posed.values["a.theta"] = 0.3
    np.testing.assert_allclose([posed.number(e.magnitude) for e in found.efforts], rotation(0.3) @ [1.0, 2.0])


def test_force_with_a_potential():
    _, found = force("force", body="dot", potential=["p*x**2", 0.0])
    (effort,) = found.efforts
    assert (effort.label, effort.magnitude, to_text(effort.potential)) == ("x", ZERO, "p*s**2.0")


def test_a_force_of_zero_leaves_nothing():
    assert force("force", body="dot", force=[0.0, 0.0])[1].efforts == ()


def test_torque_on_a_body_and_its_reaction():
    posed, found = force("torque", body="a", reaction="b", torque="p*angle + rate")
    (effort,) = found.efforts
    assert to_text(effort.magnitude) == "p*s + rate"
    assert (posed.gradient(effort.measure, "a")[2], posed.gradient(effort.measure, "b")[2]) == (1.0, -1.0)


def test_spring_damper():
    keys = {
        "stiffness": 10.0,
        "damping": 0.5,
        "free_length": 0.2,
        "actuator": "sin(t)*length + rate",
        "potential": "length",
    }
    posed, found = force("spring-damper", between=["a", "b"], at=["P", "Q"], **keys)
    (effort,) = found.efforts
    assert isinstance(effort.measure, Distance)
    assert posed.measure(effort.measure) == pytest.approx(np.linalg.norm(Q - P))
    values = posed.values | {"s": 0.7, "rate": 2.0, "t": 1.0}
    posed.values = values
    assert posed.number(effort.potential) == pytest.approx(10.0 / 2 * 0.5**2 + 0.7)
    posed.values["t"] = 0.0
    assert posed.number(effort.magnitude) == pytest.approx(2.0 - 0.5 * 2.0)


def test_torsional_spring_damper():
    posed, found = force("torsional-spring-damper", between=["a", "b"], stiffness="p", free_angle=0.1, damping=0.5)
    (effort,) = found.efforts
    assert effort.measure == Angle("a", "b")
    posed.values |= {"s": 0.4, "rate": 2.0}
    assert posed.number(effort.potential) == pytest.approx(0.3**2)
    assert posed.number(effort.magnitude) == pytest.approx(-1.0)


def test_what_is_not_given_leaves_no_term():
    _, found = force("spring-damper", between=["a", "b"], at=["P", "Q"], damping=2.0)
    assert (found.efforts[0].potential, to_text(found.efforts[0].magnitude)) == (ZERO, "-2.0*rate")
    _, found = force("torsional-spring-damper", between=["a", "b"], stiffness=2.0)
    assert (to_text(found.efforts[0].potential), found.efforts[0].magnitude) == ("s**2.0", ZERO) or (
        to_text(found.efforts[0].potential) == "1.0*s**2.0"
    )


# Points ----------------------------------------------------------------------------------------------------


def test_points_by_name_centre_and_coordinates():
    _, found = joint("revolute", between=["b", "a"], at=["centre", ["p", 0.5]])
    measure = found.rows[0].measure
    assert isinstance(measure, Component)
    assert measure.a.point == (Number(0.1), ZERO)
    assert measure.b.point == (Name("p"), Number(0.5))


def test_the_centre_of_a_point_mass():
    for point in ("centre", [0.0, 0.0]):
        _, found = joint("revolute", between=["dot", "a"], at=[point, "P"])
        assert found.rows[0].measure.a.point == (ZERO, ZERO)


@pytest.mark.parametrize("registry", [JOINTS, FORCES])
def test_every_kind_documents_its_keys(registry):
    for name, kind in registry.items():
        for key in kind.__struct_fields__:
            assert key in key_texts(kind), f"{name} says nothing about {key}"


def test_kinds_that_files_use_stay():
    assert set(JOINTS) >= {
        "constant-velocity", "coupling", "cylindrical", "distance", "driver", "gear", "knife-edge", "orientation",
        "parallel-axes", "perpendicular", "pin-in-slot", "place", "planar", "point-on-plane", "rack-and-pinion",
        "revolute", "revolute-spherical", "rigid", "rolling", "rolling-disc", "rolling-sphere", "rows", "screw",
        "spherical", "translational", "universal",
    }  # fmt: skip
    assert set(FORCES) >= {"beam", "bushing", "force", "spring-damper", "torque", "torsional-spring-damper"}
