"""Limits of a file: read in their units, compared with what a run reaches, and with the room to a dead centre."""

import math
import tomllib

import numpy as np
import pytest
from support.rotation import of_turn

import symgen
from symgen.analyses.prescribed.dead_centre_room import room_to_dead_centre
from symgen.analyses.reached_limits import ReachedLimit, reached_limits
from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import Number
from symgen.describe.facts.digest import mechanism_digest
from symgen.describe.files.validate import validate
from symgen.study.report.machine_report import machine_report

#: A rocker of 1.5 m, 2.5 m from the pivot of a crank of 1 m, with a coupler of 2 m.
ROCKER = """
[mechanism]
name = "rocker"
[parameters]
crank_length = 1.0
width = { value = 30, unit = "mm", largest = 40 }
swing = { value = 0.1, smallest = 0.05, largest = "0.002*width/1e-3" }
[bodies.crank]
mass = 1.0
inertia = 0.1
points = { a = [0.0, 0.0], b = ["crank_length", 0.0] }
angle = 1.66
[bodies.rod]
mass = 1.0
inertia = 0.1
points = { a = [0.0, 0.0], b = [2.0, 0.0] }
position = [-0.09, 0.996]
angle = 0.185
[bodies.rocker]
mass = 1.0
inertia = 0.1
points = { a = [0.0, 0.0], b = [1.5, 0.0] }
position = [2.5, 0.0]
angle = 2.0
[joints.A]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], "a"]
[joints.B]
type = "revolute"
between = ["crank", "rod"]
at = ["b", "a"]
[joints.C]
type = "revolute"
between = ["rod", "rocker"]
at = ["b", "b"]
[joints.D]
type = "revolute"
between = ["ground", "rocker"]
at = [[2.5, 0.0], "a"]
[joints.motor]
type = "driver"
joint = "D"
value = "2.0 + swing*sin(6*t)"
[outputs]
reach = { value = "rod.b.x", unit = "m", largest = "2700 mm", smallest = 1.8 }
[run]
until = 1.5
"""


@pytest.fixture(scope="module")
def swung():
    model = symgen.Model(validate(tomllib.loads(ROCKER), "rocker.toml"))
    return model, model.simulate(output_step=0.01)


def test_limits_are_compared_in_the_unit_of_values(swung):
    model, result = swung
    width, least, most, low, high = reached_limits(model.mechanism, result)
    assert width == ReachedLimit("width", "m", "largest", 0.04, 0.03, None) and width.is_met
    assert (least.limit, least.is_met) == (0.05, True)
    assert most.limit == pytest.approx(0.06) and not most.is_met
    reach = result["reach"]
    assert (low.limit, low.reached, low.is_met) == (1.8, reach.min(), False)
    assert (high.limit, high.reached, high.is_met) == (2.7, reach.max(), True)
    assert low.t == result.t[np.argmin(reach)]
    assert not ReachedLimit("a", "m", "smallest", 0.0, math.nan, 0.0).is_met


def test_nothing_is_computed_with_limits(swung):
    model, _ = swung
    without = tomllib.loads(ROCKER)
    del without["outputs"]["reach"]["largest"], without["parameters"]["width"]["largest"]
    assert mechanism_digest(validate(without, "rocker.toml")) == mechanism_digest(model.mechanism)


@pytest.mark.slow
def test_a_report_names_what_is_exceeded_and_the_room(swung):
    document = machine_report(*swung)
    (limits,) = (section for section in document.sections if section.title == "Limits")
    assert document.verdict.text.startswith("2 of 5 limits are exceeded: swing (")
    assert " and reach (" in document.verdict.text
    moods = [row[-1].mood for row in limits.tables[0].rows]
    assert moods == ["good", "good", "bad", "bad", "good"]
    glance = {row[0]: row[1:] for row in document.sections[0].tables[0].rows}
    assert glance["room to the dead centre"] == ("22.7 deg", "below the travel of motor")


@pytest.mark.slow
def test_the_room_ends_where_the_links_are_in_line(swung):
    model, result = swung
    below, above = room_to_dead_centre(model.mechanism, result.t, result.parameters)
    # crank and coupler are in line where the rocker's end is 3 m from the crank's pivot
    angle = math.acos((3.0**2 - 2.5**2 - 1.5**2) / (2.0 * 2.5 * 1.5))
    travel = 2.0 + 0.1 * np.sin(6.0 * result.t)
    assert below.way == pytest.approx(travel.min() - angle, abs=1e-6)
    assert above.way == pytest.approx(2.0 * math.pi - angle - travel.max(), abs=1e-6)


@pytest.mark.parametrize(
    ("section", "key", "value", "words"),
    [
        ("outputs", "largest", "2 kg", "outputs.reach.largest"),
        ("outputs", "smallest", "3 m", "outputs.reach.largest: expected at least the smallest, 3 m"),
        ("outputs", "largest", "wide", "outputs.reach.largest"),
        ("outputs", "most", 1.0, "outputs.reach"),
        ("parameters", "largest", [1], "parameters.width"),
    ],
)
def test_what_is_no_limit(section, key, value, words):
    raw = tomllib.loads(ROCKER)
    raw[section]["reach" if section == "outputs" else "width"][key] = value
    with pytest.raises(InputError) as error:
        validate(raw, "rocker.toml")
    assert words in str(error.value)


def test_a_formula_of_numbers_is_in_the_unit_of_its_parameter():
    raw = tomllib.loads(ROCKER)
    raw["parameters"]["width"] |= {"smallest": "2*10", "largest": "3 cm"}
    (width, *_) = validate(raw, "rocker.toml").limits
    assert (width.smallest, width.largest) == (Number(0.02), Number(0.03))


@pytest.mark.by_turns(5)
@pytest.mark.slow
def test_the_room_changes_smoothly_with_a_length(swung):
    """Over 300 lengths of the crank, beside the closed form: crank and coupler are in line."""
    model, result = swung
    travel = 2.0 + 0.1 * np.sin(6.0 * result.t)
    for crank in of_turn(np.linspace(0.9, 1.2, 300).tolist(), 6):
        below, _ = room_to_dead_centre(model.mechanism, result.t, {**result.parameters, "crank_length": crank})
        angle = math.acos(((crank + 2.0) ** 2 - 2.5**2 - 1.5**2) / (2.0 * 2.5 * 1.5))
        assert below.way == pytest.approx(travel.min() - angle, abs=1e-6), crank
