"""Points that slide along beams and curves: what a table becomes, and what is wrong with one."""

import numpy as np
import pytest
from support.emitted import mechanism_of

from symgen.base.errors import InputError
from symgen.describe.table_functions import PLACE_SHAPES, SLOPE_SHAPES

CABLE = {"start": [0.0, 0.0], "end": [3.0, 0.0], "elements": 3, "cable": True, "axial": 1e3, "mass": 0.5}
ON = {"type": "slides-on", "body": "bead", "beam": "line"}


def described(joint=(), cable=(), **sections):
    beam = {key: value for key, value in {**CABLE, **dict(cable)}.items() if value is not None}
    table = {key: value for key, value in {**ON, **dict(joint)}.items() if value is not None}
    bead = {"type": "point", "mass": 1.0, "position": [1.25, 0.1]}
    raw = {"mechanism": {"name": "x"}, "beams": {"line": beam}, "bodies": {"bead": bead}, "joints": {"on": table}}
    return mechanism_of({**raw, **sections})


def test_a_joint_on_a_beam_has_a_slider_near_its_point_and_stops_at_the_ends():
    mechanism = described()
    slider, joint = mechanism.bodies[-1], mechanism.joints[0]
    assert (slider.name, slider.weightless, [x.value for x in slider.position]) == ("on.slider", True, [1.25, 0.0])
    assert joint.bodies == ("bead", "line.start", "line.1", "line.2", "line.end", "on.slider")
    assert [row.label for row in joint.rows] == ["x", "y", "across"]
    assert [(row.name, row.value.value) for row in mechanism.bounded] == [("on.lower", 0.0), ("on.upper", -3.0)]
    assert [row.name for row in described({"stop": {"upper": 2.0}}).bounded] == ["on.upper"]


def test_a_cable_is_point_masses_and_elements_that_only_pull():
    mechanism = described(cable={"length": 3.3, "damping": 1e-3})
    nodes = [body for body in mechanism.bodies if body.name.startswith("line.")]
    assert all(body.is_point for body in nodes)
    assert abs(sum(body.mass.value for body in nodes) - 0.5 * 3.3) < 1e-15
    assert [force.kind for force in mechanism.forces] == ["spring-damper"] * 3


@pytest.mark.parametrize("shapes", [PLACE_SHAPES, SLOPE_SHAPES])
def test_shape_functions_go_on_straight_beyond_the_ends(shapes):
    first, inner, last = (shapes[where].interpolated for where in ("first", "inner", "last"))
    slope = float(shapes is SLOPE_SHAPES)
    for x in np.linspace(0.0, 1.0, 7):
        assert abs(first.value(x) - inner.value(x)) < 1e-15 and abs(last.value(-x) - inner.value(-x)) < 1e-15
        assert first.value(-x) == (1.0 - slope) - slope * x and last.value(x) == (1.0 - slope) + slope * x
        assert abs(inner.value(-x) - (1.0 - 2.0 * slope) * inner.value(x)) < 1e-15
        assert first.value(1.0 + x) == inner.value(1.0 + x) == inner.value(-1.0 - x) == 0.0


STATIONS = [{"at": [0.0, 0.0]}, {"at": [1.0, 0.0]}]
WRONG = [
    ({"beam": "lien"}, {}, "joints.on.beam: expected the name of a beam, got the unknown beam 'lien'; did you mean"),
    ({"beam": None}, {}, "joints.on.beam: expected the name of a beam, or the keys along and step, got no such key"),
    ({"body": "ground"}, {}, "joints.on.body: expected a body that moves, got 'ground'"),
    (
        {},
        {"line": [[0, 0], [1, 0], [1, 1]], "start": None, "end": None},
        "joints.on.beam: expected a beam without corners, at which the velocity would jump, got 'line', a line of 2",
    ),
    ({}, {"bending": 1.0}, "beams.line.bending: expected no such key beside cable = true, got 1.0"),
    ({}, {"cable": None, "length": 3.1}, "beams.line.length: expected no such key without cable = true, got 3.1"),
    ({}, {"damping": {"axial": 0.1}}, "beams.line.damping: expected one time, as a cable has one strain, got a table"),
    ({}, {"mass": None}, "beams.line.mass: expected a value, or the tables section and material, got no such key"),
    ({"beam": None, "along": STATIONS[:1], "step": 1.0}, {}, "joints.on.along: expected two points or more, got 1"),
    (
        {"beam": None, "along": [STATIONS[0]] * 2, "step": 1.0},
        {},
        "joints.on.along: expected points apart from each other, got two at one place",
    ),
    (
        {"beam": None, "along": [STATIONS[0], {**STATIONS[1], "axis": [1, 0]}], "step": 1.0},
        {},
        "joints.on.along[1].axis: expected a direction at all points or at none, got one of both",
    ),
    ({"beam": None, "along": STATIONS, "step": -1.0}, {}, "joints.on.step: expected a value above 0, got -1.0"),
]


@pytest.mark.parametrize(("joint", "cable", "sentence"), WRONG)
def test_what_is_wrong_is_named(joint, cable, sentence):
    with pytest.raises(InputError) as error:
        described(joint, cable)
    assert sentence in str(error.value)
