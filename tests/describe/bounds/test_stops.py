"""The key ``stop`` of joints and the section ``stops``: what they mean, and one sentence for what has no meaning."""

import copy

import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.bounds.bounded_modes import mode_events, without_bounds
from symgen.describe.facts.digest import canonical_text, mechanism_digest
from symgen.describe.files.load import read_raw
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism


def four_bar(stop: object = None, gap: object = None, **more: object) -> Mechanism:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    if stop is not None:
        raw["joints"]["A"]["stop"] = stop
    if gap is not None:
        raw["stops"] = {"rope": gap}
    for name, keys in more.items():
        raw["bodies"][name] |= keys
    return validate(raw, source)


def test_a_stop_has_rows_events_and_outputs() -> None:
    mechanism = four_bar({"lower": -1.0, "upper": 2.0, "restitution": 0.5}, {"gap": "2.0 - C.angle"})
    assert [stop.name for stop in mechanism.bounded] == ["A.lower", "A.upper", "rope"]
    assert [stop.row for stop in mechanism.bounded] == ["A.lower.stop", "A.upper.stop", "rope.stop"]
    assert [stop.unit for stop in mechanism.bounded] == ["rad"] * 3
    names = [event.name for event in mode_events(mechanism)]
    assert names == [f"{name}.{word}" for name in ("A.lower", "A.upper", "rope") for word in ("hit", "leave")]
    assert [output.name for output in mechanism.outputs][-2:] == ["rope.mode", "rope.force"]


def test_a_file_without_stops_is_the_same_as_before() -> None:
    plain = four_bar()
    assert without_bounds(four_bar({"lower": -1.0})) == plain
    assert without_bounds(plain) is plain
    assert "stops" not in canonical_text(plain)
    assert mechanism_digest(plain) != mechanism_digest(four_bar({"lower": -1.0}))
    assert canonical_text(four_bar({"lower": -1.0})) != canonical_text(four_bar({"lower": -1.1}))


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({"stop": {"lower": 1.0, "upper": -1.0}}, "joints.A.stop.upper: expected a value above that of lower"),
        ({"stop": {"restitution": 0.5}}, "joints.A.stop: expected the key lower, the key upper or both, got neither"),
        ({"stop": {"lower": -1.0, "restitution": 1.5}}, "joints.A.stop.restitution: expected a value from 0 to 1"),
        ({"stop": {"lower": -1.0, "restitution": -0.1}}, "joints.A.stop.restitution: expected a value from 0 to 1"),
        ({"stop": {"lower": float("nan")}}, "joints.A.stop.lower: expected a finite number"),
        ({"stop": {"least": -1.0}}, "joints.A.stop"),
        ({"stop": 1.0}, "joints.A.stop: expected a table such as { lower = -1.0, upper = 2.0 }, got 1.0"),
        ({"gap": {"gap": "2.0"}}, "stops.rope.gap: expected .*, got one in which nothing moves"),
        ({"gap": {"gap": "crank.omega"}}, "stops.rope.gap: expected .* positions, got 'crank.omega', a velocity"),
        ({"gap": {"gap": "crank.spin"}}, "got 'spin', which body 'crank' does not have; it has x, y, theta"),
        ({"gap": {"gap": "crank.y", "restitution": 2.0}}, "stops.rope.restitution: expected a value from 0 to 1"),
        ({"gap": {}}, "stops.rope"),
    ],
)
def test_wrong_stops(keys: dict[str, object], sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        four_bar(**keys)  # type: ignore[arg-type]  # wrong ones on purpose


def test_a_driver_has_no_stops() -> None:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["joints"]["motor"] = {"type": "driver", "joint": "A", "value": "t", "stop": {"lower": 0.0}}
    with pytest.raises(InputError, match=r"joints\.motor\.stop: expected a joint with a coordinate"):
        validate(raw, source)


def test_what_chooses_no_modes_refuses_stops() -> None:
    model = symgen.load(four_bar({"lower": -1.0}))
    sentence = "expected a mechanism without stops, got A.lower"
    with pytest.raises(InputError, match=sentence):
        model.generate(target="cuda")


@pytest.mark.parametrize("method", ["auto", "lagrange"])
def test_friction_by_a_reaction_names_a_body_without_inertia(method: str) -> None:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["bodies"]["rocker"]["inertia"] = 0.0
    raw["joints"]["B"]["friction"] = {"coefficient": 0.1, "radius": 0.02}
    with pytest.raises(InputError, match=r"bodies.rocker: expected a mass and moments of inertia above 0") as refused:
        symgen.simulate(validate(raw, source), method=method, until=0.1)
    assert "lagrange" not in str(refused.value)


def test_friction_by_a_reaction_beside_a_stop_is_read() -> None:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["joints"]["A"]["stop"] = {"upper": 9.0}
    raw["joints"]["B"]["friction"] = {"coefficient": 0.1, "radius": 0.02}
    assert {row.one_sided for row in validate(raw, source).bounded} == {False, True}
