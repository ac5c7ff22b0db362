"""The key ``friction`` of joints: what it means, and one sentence for what has no meaning."""

import copy

import msgspec
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.bounds.bounded_modes import mode_events, without_bounds
from symgen.describe.facts.digest import canonical_text, digest, mechanism_digest
from symgen.describe.files.load import read_raw
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

GONE = object()


def four_bar(friction: object, joint: str = "A", **more: object) -> Mechanism:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    if friction is not GONE:
        raw["joints"][joint]["friction"] = friction
    for name, entry in more.items():
        raw["joints"][name] = entry
    return validate(raw, source)


def quill(friction: object) -> Mechanism:
    raw = {
        "mechanism": {"name": "quill", "space": "spatial"},
        "bodies": {"quill": {"mass": 1.0, "inertia": [1.0, 1.0, 1.0]}},
        "joints": {
            "bearing": {
                "type": "cylindrical",
                "between": ["ground", "quill"],
                "at": [[0.0, 0.0, 0.0], "centre"],
                "axis": [0.0, 0.0, 1.0],
                "friction": friction,
            }
        },
    }
    return validate(raw, "quill.toml")


def test_a_joint_has_bounds_of_its_only_coordinate() -> None:
    (friction,) = four_bar({"sliding": 4.0}).bounded
    assert (friction.name, friction.joint, friction.row, friction.unit) == ("A", "A", "A.friction", "rad")
    assert friction.static == friction.sliding
    assert [event.name for event in mode_events(four_bar({"sliding": 4.0}))] == ["A.slip", "A.slip", "A.reverse"]


def test_a_joint_has_bounds_of_each_coordinate() -> None:
    names = [f.name for f in quill({"angle": {"sliding": 0.2}, "displacement": {"sliding": 3.0}}).bounded]
    assert names == ["bearing.angle", "bearing.displacement"]
    assert [f.unit for f in quill({"displacement": {"sliding": 3.0}}).bounded] == ["m"]


def test_a_file_without_friction_is_the_same_as_before() -> None:
    plain, dry = four_bar(GONE), four_bar({"sliding": 4.0})
    assert without_bounds(dry) == plain
    assert without_bounds(plain) is plain
    assert "friction" not in canonical_text(plain)
    assert digest(dry) != digest(plain)
    assert mechanism_digest(dry) != mechanism_digest(plain)
    more = msgspec.structs.replace(plain, bounded=())
    assert mechanism_digest(more) == mechanism_digest(plain)


@pytest.mark.parametrize(
    ("friction", "sentence"),
    [
        ({"sliding": -1.0}, "joints.A.friction.sliding: expected a value of at least 0, got -1.0"),
        ({"sliding": float("nan")}, "joints.A.friction.sliding: expected a finite number, got nan"),
        ({"sliding": "log(-crank_mass)"}, "joints.A.friction.sliding: expected"),
        (
            {"sliding": 4.0, "static": 3.0},
            "joints.A.friction.static: expected a bound of at least that in motion (4.0), got 3.0",
        ),
        ({"sliding": 0.0, "static": 3.0}, "joints.A.friction.sliding: expected a value above 0"),
        ({"sliding": 4.0, "viscous": -0.1}, "joints.A.friction.viscous: expected a value of at least 0, got -0.1"),
        ({"sliding": 4.0, "stribeck_speed": 0.0}, "joints.A.friction.stribeck_speed: expected a value above 0"),
        ({"sliding": 4.0, "radius": 0.1}, "joints.A.friction.radius: expected no such key beside sliding, got 0.1"),
        ({"sliding": 4.0, "coefficient": 0.1}, "friction.coefficient: expected no such key beside sliding, got 0.1"),
        ({"radius": 0.1}, "joints.A.friction: expected the key coefficient, got radius"),
        ({"coefficient": 0.1}, "joints.A.friction.radius: expected the radius of the pin"),
        ({"coefficient": 0.1, "radius": 0.0}, "joints.A.friction.radius: expected a value above 0, got 0.0"),
        (
            {"coefficient": 0.3, "static_coefficient": 0.2, "radius": 0.1},
            "joints.A.friction.static_coefficient: expected a bound of at least that in motion (0.3), got 0.2",
        ),
        ({"static": 4.0}, "joints.A.friction"),
        (4.0, "joints.A.friction: expected a table such as { sliding = 4.0 }, got 4.0"),
        ({}, "joints.A.friction"),
    ],
)
def test_wrong_bounds(friction: object, sentence: str) -> None:
    with pytest.raises(InputError) as error:
        four_bar(friction)
    assert sentence in str(error.value)


def test_wrong_joints() -> None:
    with pytest.raises(InputError, match="a joint with a coordinate, got a distance joint"):
        four_bar(GONE, rope={"type": "distance", "between": ["ground", "crank"], "at": [[0.0, 0.0], "B"], "length": 2.0,
                             "friction": {"sliding": 1.0}})  # fmt: skip
    driver = {"type": "driver", "joint": "A", "value": "pi/3 + t"}
    with pytest.raises(InputError, match="a coordinate that no driver prescribes, got one that 'motor' prescribes"):
        four_bar({"sliding": 1.0}, motor=driver)
    with pytest.raises(InputError, match="coordinates of the joint"):
        quill({"sliding": 1.0})
    with pytest.raises(InputError, match="coordinates of the joint"):
        quill({"angle": {"sliding": 1.0}, "turn": {"sliding": 1.0}})


def test_a_joint_without_a_reaction_has_none_to_rub_by() -> None:
    with pytest.raises(InputError, match=r"friction\.angle\.radius: expected the radius of the pin"):
        quill({"angle": {"coefficient": 0.2}})
    wheel = {"type": "rolling", "between": ["rocker", "ground"], "radius": 2.5, "axis": [1.0, 0.0],
             "on": [10.0, -2.5], "centre": "D", "friction": {"coefficient": 0.1}}  # fmt: skip
    with pytest.raises(InputError, match="expected friction by the reaction of a joint among revolute, translational"):
        four_bar(GONE, wheel=wheel)


@pytest.mark.slow
def test_bounds_of_parameters_are_checked_in_runs() -> None:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["parameters"]["torque"] = 4.0
    raw["joints"]["A"]["friction"] = {"sliding": "torque", "static": 4.0}
    model = symgen.load(validate(raw, source))
    with pytest.raises(InputError, match="friction of A: expected bounds of at least 0, at rest"):
        model.simulate(until=0.1, parameters={"torque": 5.0})


def test_what_chooses_no_modes_refuses_friction() -> None:
    model = symgen.load(four_bar({"sliding": 4.0}))
    sentence = "a mechanism without dry friction, got that of A"
    for target in ("cuda", "lanes"):
        with pytest.raises(InputError, match=sentence):
            model.generate(target=target)
    with pytest.raises(InputError, match=sentence):
        model.sweep({"crank_mass": [1.0, 2.0]}, target="lanes", integrator="rk4", until=0.1)


@pytest.mark.parametrize("method", ["half-explicit", "rattle"])
def test_methods_that_read_all_rows_refuse_friction(method: str) -> None:
    with pytest.raises(InputError, match="where rows may be off"):
        symgen.load(four_bar({"sliding": 4.0})).simulate(method=method, until=0.1)


def test_analyses_leave_friction_out() -> None:
    dry, plain = symgen.load(four_bar({"sliding": 4.0})), symgen.load(four_bar(GONE))
    assert dry.equilibrium().q == plain.equilibrium().q
    assert dry.modes().frequencies.tolist() == plain.modes().frequencies.tolist()
