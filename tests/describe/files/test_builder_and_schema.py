"""The builder says what a file says; the schema knows every key of it."""

import json
import tomllib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.texts import texts

from symgen.base.errors import InputError
from symgen.describe import MechanismBuilder, catalogue
from symgen.describe.files.builder import to_toml
from symgen.describe.files.json_schema import file_schema
from symgen.describe.files.load import load_mechanism, read_raw
from symgen.describe.files.validate import validate
from symgen.describe.forces import FORCES
from symgen.describe.joints import JOINTS

PENDULUM = """
[mechanism]
name = "rod-pendulum"
gravity = [0.0, -9.81]

[run]
until = 2.0

[parameters]
length = { value = 0.8, unit = "m" }
damping = 0.1

[tables.profile]
x = [0.0, 1.0]
y = [1.0, 0.0]

[bodies.rod]
mass = 1.2
inertia = "1.2*length**2/12"
points = { top = [0.0, "length/2"] }

[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "top"]

[forces.friction]
type = "torsional-spring-damper"
between = ["ground", "rod"]
damping = "damping"
actuator = "profile(t)"

[outputs]
lean = { value = "180/pi*rod.theta", unit = "deg" }
spent = "-integral(friction.power)"
"""


def test_builder_and_file_are_one():
    built = (
        MechanismBuilder("rod-pendulum", gravity=(0, np.float64(-9.81)))
        .run(until=2)
        .parameter("length", 0.8, unit="m")
        .parameter("damping", 0.1)
        .table("profile", np.array([0.0, 1.0]), [1, 0])
        .body("rod", mass=np.float64(1.2), inertia="1.2*length**2/12", points={"top": (0.0, "length/2")})
        .joint("pin", "revolute", between=("ground", "rod"), at=(np.array([0.0, 0.0]), "top"))
        .force(
            "friction", "torsional-spring-damper", between=("ground", "rod"), damping="damping", actuator="profile(t)"
        )
        .output("lean", "180/pi*rod.theta", unit="deg")
        .output("spent", "-integral(friction.power)")
    )
    assert built.build() == validate(tomllib.loads(PENDULUM), "rod.toml")
    assert validate(tomllib.loads(built.to_toml()), "rod.toml") == built.build()


def test_messages_name_the_builder():
    with pytest.raises(InputError, match=r"^builder 'x': bodies.rod.inertia: expected the inertia"):
        MechanismBuilder("x").body("rod", mass=1.0).build()
    with pytest.raises(InputError, match=r"^builder 'x': bodies.rod: expected a name used once, got 'rod' twice"):
        MechanismBuilder("x").body("rod", mass=1.0).body("rod", mass=1.0)
    with pytest.raises(InputError, match=r"got the unknown key 'masss'; did you mean 'mass'\?"):
        MechanismBuilder("x").body("rod", masss=1.0).build()


def test_raw_is_a_copy():
    builder = MechanismBuilder("x").body("rod", type="point", mass=1.0)
    builder.raw()["bodies"]["rod"]["mass"] = -1.0
    assert builder.build().bodies[0].mass.value == 1.0


values = st.recursive(
    st.booleans() | st.integers(-(2**60), 2**60) | st.floats(allow_nan=False) | texts(20),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(texts(10), inner, max_size=3),
    max_leaves=8,
)


@given(st.dictionaries(texts(10), values, max_size=5))
def test_whatever_is_written_is_read_back(content):
    assert tomllib.loads(to_toml({"mechanism": content, "bodies": {"a b": content}})) == {
        "mechanism": content,
        "bodies": {"a b": content},
    }


# Schema ----------------------------------------------------------------------------------------------------


def check(value, rule, path="$"):
    """A validator of the parts of JSON schema that are used."""
    if "anyOf" in rule or "oneOf" in rule:
        failures = []
        for option in rule.get("anyOf", rule.get("oneOf")):
            try:
                return check(value, option, path)
            except AssertionError as error:
                failures.append(str(error))
        raise AssertionError(f"{path}: {failures}")
    if "enum" in rule:
        assert value in rule["enum"], path
    if "type" in rule:
        kinds = {"object": dict, "array": list, "string": str, "number": (int, float), "null": type(None)}
        wanted = rule["type"] if isinstance(rule["type"], list) else [rule["type"]]
        assert any(isinstance(value, kinds[kind]) for kind in wanted), f"{path}: {value!r} is no {wanted}"
    if isinstance(value, dict):
        for key in rule.get("required", []):
            assert key in value, f"{path}: no {key}"
        for key, item in value.items():
            inner = rule.get("properties", {}).get(key, rule.get("additionalProperties", True))
            assert inner is not False, f"{path}: {key} is unknown"
            if isinstance(inner, dict):
                check(item, inner, f"{path}.{key}")
    if isinstance(value, list):
        for item, inner in zip(value, rule.get("prefixItems", []), strict=False):
            check(item, inner, path)
        assert rule.get("minItems", 0) <= len(value) <= rule.get("maxItems", len(value)), path
    return None


@pytest.mark.parametrize("name", catalogue.names())
def test_the_catalogue_fulfils_the_schema(name):
    check(read_raw(name)[0], file_schema())


def test_the_schema_refuses_what_the_validator_refuses():
    raw = tomllib.loads(PENDULUM)
    check(raw, file_schema())
    for section, key, value in (
        ("bodies", "masss", 1.0),
        ("joints", "type", "revolut"),
        ("joints", "between", ["rod"]),
        ("joints", "at", [[0.0], "top"]),
    ):
        name = next(iter(raw[section]))
        wrong = raw | {section: {name: raw[section][name] | {key: value}}}
        with pytest.raises(AssertionError):
            check(wrong, file_schema())
        with pytest.raises(InputError):
            validate(wrong, "rod.toml")


def test_the_schema_is_json_and_knows_every_kind():
    text = json.dumps(file_schema(), allow_nan=False)
    assert "$ref" not in text
    for name in (*JOINTS.names, *JOINTS.aliases, *FORCES.names):
        assert f'"{name}"' in text
    assert "counter-clockwise" in text


def test_load_takes_paths_and_names(tmp_path):
    path = tmp_path / "rod.toml"
    path.write_text(PENDULUM)
    assert load_mechanism(path) == load_mechanism(str(path))
    windows = tmp_path / "windows.toml"
    windows.write_bytes(PENDULUM.replace("\n", "\r\n").encode())
    assert load_mechanism(windows) == load_mechanism(path)


def test_load_takes_other_values_for_parameters():
    changed = load_mechanism("four-bar", {"crank_mass": 3})
    assert [p.value for p in changed.parameters] == [3.0, 8.0, 5.0]
    assert changed.parameters[0].unit == "kg"
    assert changed.bodies == load_mechanism("four-bar").bodies


@pytest.mark.parametrize(("until", "step"), [(10.0, 1e-3), (2e-3, 1e-3), (1e-3, 1e-3), (5e-4, 5e-6), (2e-9, 2e-11)])
def test_a_file_of_a_short_motion_need_not_say_its_step(until, step):
    raw = tomllib.loads(PENDULUM) | {"run": {"until": until}}
    assert validate(raw, "").defaults.step == pytest.approx(step, rel=1e-15)
    with pytest.raises(InputError, match=r"run\.step: expected at most until"):
        validate(raw | {"run": {"until": until, "step": 2.0 * until}}, "")
