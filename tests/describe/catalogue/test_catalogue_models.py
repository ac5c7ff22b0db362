"""The catalogue and the examples: complete, assembled, and with the data their sources state."""

import importlib.util
import math
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

from describe.measured import Posed
from symgen.base.errors import InputError
from symgen.describe import catalogue
from symgen.describe.edits.template import new_file_text
from symgen.describe.files.builder import to_toml
from symgen.describe.files.load import load_mechanism, read_raw
from symgen.describe.files.validate import validate
from symgen.describe.forces import FORCES
from symgen.describe.joints import JOINTS

EXAMPLES = Path(__file__).parents[3] / "examples"
FILES = sorted(EXAMPLES.glob("*.toml"))
PLANAR = [path for path in FILES if 'space = "spatial"' not in path.read_text(encoding="utf-8")]
SIZES = {"pendulum": (1, 1), "four-bar": (3, 8), "slider-crank": (3, 8), "andrews": (7, 20), "driven-four-bar": (3, 9)}

#: Spatial entries: their sizes and data are checked in tests/space.
SPATIAL = (
    *("bricard", "flyball-governor", "free-rigid-body", "front-suspension", "heavy-top", "rolling-disc"),
    *("spatial-slider-crank", "spherical-double-pendulum", "stewart-platform"),
)
SIZED = ["chain", "n-four-bar"]


def rows(mechanism):
    return [row for joint in mechanism.joints for row in joint.rows]


def test_the_catalogue_lists_what_it_holds():
    entries = catalogue.entries()
    assert [entry.name for entry in entries] == list(catalogue.names()) == sorted({*SIZES, *SPATIAL, *SIZED})
    assert all(entry.title and entry.source for entry in entries)
    assert [entry.name for entry in entries if entry.sized] == SIZED


@pytest.mark.parametrize("name", catalogue.all_names())
def test_every_entry_says_how_it_runs(name):
    section = read_raw(name)[0]["run"]
    assert {"until", "step", "output_step"} <= set(section)
    assert load_mechanism(name).defaults.source


@pytest.mark.parametrize("name", SIZES)
def test_names_and_sizes(name):
    mechanism = load_mechanism(name)
    assert mechanism.name == name
    assert (len(mechanism.bodies), len(rows(mechanism))) == SIZES[name]


@pytest.mark.parametrize("model", [*sorted(SIZES), "n-four-bar", "n-four-bar:7", *PLANAR], ids=str)
def test_every_start_closes_the_joints(model):
    residuals = Posed(load_mechanism(model)).residuals()
    assert max(map(abs, residuals.values()), default=0.0) < 2e-15


def test_four_bar_data():
    posed = Posed(load_mechanism("four-bar"))
    joints = {joint.name: joint for joint in posed.mechanism.joints}
    pins = {name: posed.point(joint.rows[0].measure.a) for name, joint in joints.items()}
    np.testing.assert_allclose(pins["A"], [0.0, 0.0])
    np.testing.assert_allclose(pins["B"], [1.0, math.sqrt(3.0)], rtol=1e-15)
    np.testing.assert_allclose(pins["C"], [8.412459, 4.741278], atol=5e-7)
    np.testing.assert_allclose(pins["D"], [10.0, 0.0])
    for body, length in (("crank", 2.0), ("coupler", 8.0), ("rocker", 5.0)):
        found = posed.mechanism.body(body)
        assert posed.number(found.mass) == length
        assert posed.number(found.inertia) == pytest.approx(length * length**2 / 12)


@pytest.mark.parametrize("size", [1, 2, 5])
def test_n_four_bar_data(size):
    mechanism = load_mechanism(f"n-four-bar:{size}")
    names = {f"vertical{i}" for i in range(size + 1)} | {f"coupler{i}" for i in range(size)}
    assert {body.name for body in mechanism.bodies} == names
    assert len(rows(mechanism)) == 2 * (3 * size + 1)
    posed = Posed(mechanism)
    for body in mechanism.bodies:
        assert (posed.number(body.mass), posed.number(body.inertia)) == (1.0, pytest.approx(1 / 12))
        # velocities are those of the parallelogram turning clockwise at 1 rad/s
        _, y, _ = posed.frames[body.name]
        assert tuple(map(posed.number, body.velocity)) == (y, 0.0)
        assert posed.number(body.angular_velocity) == (0.0 if body.name.startswith("coupler") else -1.0)
    top = posed.point(next(j for j in mechanism.joints if j.name == "B0").rows[0].measure.a)
    np.testing.assert_allclose(top, [0.0, 1.0], atol=1e-15)


def test_n_four_bar_has_a_default_size():
    assert load_mechanism("n-four-bar") == load_mechanism("n-four-bar:2")


def test_pendulum_data():
    mechanism = load_mechanism("pendulum")
    (bob,) = mechanism.bodies
    posed = Posed(mechanism)
    assert (bob.name, bob.is_point, bob.coordinates) == ("bob", True, ("x", "y"))
    assert (posed.number(bob.mass), posed.frames["bob"][:2]) == (1.0, (-1.0, 0.0))
    assert tuple(map(posed.number, mechanism.gravity)) == (0.0, -9.81)


def test_driven_four_bar_is_the_four_bar_with_a_motor():
    free, driven = load_mechanism("four-bar"), load_mechanism("driven-four-bar")
    assert driven.joints[:-1] == free.joints
    assert [body.mass for body in driven.bodies] == [body.mass for body in free.bodies]
    (row,) = driven.joints[-1].rows
    posed = Posed(driven)
    assert posed.number(row.value, 1.0) - posed.number(row.value, 0.0) == pytest.approx(2 * math.pi)


# Examples and template ------------------------------------------------------------------------------------------


def test_there_are_examples_beyond_the_catalogue():
    names = {load_mechanism(path).name for path in FILES}
    assert len(names) == len(FILES) >= 3
    assert not names & set(catalogue.all_names())


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_example_files_state_their_source_and_carry_their_name(path):
    mechanism = load_mechanism(path)
    assert mechanism.name == path.stem
    assert mechanism.defaults.source


def test_the_script_writes_a_file_that_describes_a_closed_chain(tmp_path):
    script = EXAMPLES / "hanging_chain.py"
    output = subprocess.run([sys.executable, script, "9"], capture_output=True, text=True, check=True).stdout
    path = tmp_path / "chain.toml"
    path.write_text(output)
    mechanism = load_mechanism(path)
    assert (len(mechanism.bodies), len(rows(mechanism)), len(mechanism.forces)) == (9, 20, 8)
    assert max(map(abs, Posed(mechanism).residuals().values())) < 1e-12
    spec = importlib.util.spec_from_file_location("hanging_chain", script)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.chain(9).build() == mechanism


@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_the_template_is_a_mechanism_with_every_key_explained(space):
    text = new_file_text("my-crane", space)
    raw = tomllib.loads(text)
    mechanism = validate(raw, "my-crane.toml")
    assert (mechanism.name, mechanism.space) == ("my-crane", space)
    uncommented = "\n".join(line.removeprefix("# ") if " = " in line else line for line in text.splitlines())
    full = uncommented.replace("# [", "[")
    assert {"bob"} <= set(tomllib.loads(full)["bodies"])
    assert validate(tomllib.loads(full), "full.toml").tables[0].name == "profile"
    kinds = [k for registry in (JOINTS, FORCES) for k, kind in registry.items() if space in kind.SPACES]
    for word in (*kinds, "predictable_until", "centre_of_mass"):
        assert word in text
    others = [k for registry in (JOINTS, FORCES) for k, kind in registry.items() if space not in kind.SPACES]
    assert not [k for k in others if f" {k}," in text]
    with pytest.raises(InputError, match="lower-case words joined by dashes"):
        new_file_text("My crane")


@pytest.mark.parametrize("model", [*catalogue.all_names(), *FILES], ids=str)
def test_every_description_survives_being_written_and_read(model):
    raw, source = read_raw(model)
    assert tomllib.loads(to_toml(raw)) == raw
    assert validate(tomllib.loads(to_toml(raw)), source) == load_mechanism(model)
