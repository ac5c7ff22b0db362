"""The digest holds what the equations depend on, and nothing else."""

import builtins
import copy
import functools
import math
import operator
import subprocess
import sys
import tomllib

import pytest

from symgen.describe import catalogue
from symgen.describe.facts.digest import canonical_text, digest
from symgen.describe.files.load import load_mechanism
from symgen.describe.files.validate import validate

TEXT = """
[mechanism]
name = "rod"
gravity = [0.0, -9.81]
[run]
until = 1.0
[parameters]
k = { value = 1.0, unit = "N/m", note = "soft" }
m = 2.0
[tables.f]
x = [0.0, 1.0]
y = [0.0, 1.0]
[tables.g]
x = [0.0, 1.0]
y = [0.0, 2.0]
[bodies.a]
mass = "m"
inertia = 1.0
points = { P = [0.0, 1.0], Q = [0.0, 2.0] }
[bodies.b]
mass = 1.0
inertia = 1.0
[joints.J]
type = "revolute"
between = ["a", "b"]
at = ["P", "centre"]
[joints.K]
type = "revolute"
between = ["ground", "b"]
at = [[0.0, 0.0], [0.0, 1.0]]
[forces.S]
type = "spring-damper"
between = ["ground", "a"]
at = [[0.0, 0.0], "Q"]
stiffness = "k"
actuator = "f(t)"
"""


def changed(path, value):
    raw = copy.deepcopy(tomllib.loads(TEXT))
    table = raw
    *keys, last = path.split(".")
    for key in keys:
        table = table.setdefault(key, {})
    table[last] = value
    return validate(raw, "rod.toml")


SAME = [
    ("mechanism.title", "Another"),
    ("mechanism.source", "Elsewhere"),
    ("run.until", 2.0),
    ("run.step", 1e-4),
    ("parameters.k", {"value": 5.0, "unit": "N/m", "note": "stiff"}),
    ("parameters.m", 3.0),
    ("bodies.a.position", [1.0, 2.0]),
    ("bodies.a.angle", 1.0),
    ("bodies.a.velocity", [1.0, 0.0]),
    ("bodies.a.angular_velocity", 3.0),
    ("bodies.a.points", {"Q": [0.0, 2.0], "P": [0.0, 1.0]}),
    ("bodies.a.inertia", "2/2"),
    ("joints.K.at", [[-0.0, 0.0], [0.0, 1.0]]),
    ("tables", {"g": {"x": [0.0, 1.0], "y": [0.0, 2.0]}, "f": {"x": [0.0, 1.0], "y": [0.0, 1.0]}}),
]
OTHER = [
    ("mechanism.name", "rod-two"),
    ("mechanism.gravity", [0.0, -9.8]),
    ("parameters.k", {"value": 1.0, "unit": "kg/s^2", "note": "soft"}),
    ("parameters.n", 1.0),
    ("parameters", {"m": 2.0, "k": {"value": 1.0, "unit": "N/m"}}),
    ("tables.f.y", [0.0, 1.5]),
    ("bodies.a.mass", 2.0),
    ("bodies.a.inertia", 1.0000000000000002),
    ("bodies.a.centre_of_mass", [0.0, 1.0]),
    ("bodies.a.points", {"P": [0.0, 1.0], "Q": [0.0, 2.5]}),
    ("bodies.c", {"type": "point", "mass": 1.0}),
    ("joints.J.at", ["Q", "centre"]),
    ("joints.J", {"type": "revolute", "between": ["b", "a"], "at": ["centre", "P"]}),
    ("joints.J.type", "rigid"),
    ("forces.S.damping", 0.1),
    ("forces.S.actuator", "g(t)"),
]


@pytest.mark.parametrize(("path", "value"), SAME, ids=[path for path, _ in SAME])
def test_what_needs_no_new_code_keeps_the_digest(path, value):
    assert digest(changed(path, value)) == digest(validate(tomllib.loads(TEXT), "rod.toml"))


@pytest.mark.parametrize(("path", "value"), OTHER, ids=[path for path, _ in OTHER])
def test_what_changes_the_code_changes_the_digest(path, value):
    assert digest(changed(path, value)) != digest(validate(tomllib.loads(TEXT), "rod.toml"))


def test_the_order_of_bodies_and_joints_counts():
    raw = tomllib.loads(TEXT)
    for section in ("bodies", "joints"):
        other = raw | {section: dict(reversed(raw[section].items()))}
        assert digest(validate(other, "rod.toml")) != digest(validate(raw, "rod.toml"))


def test_all_models_differ():
    digests = {digest(load_mechanism(name)) for name in (*catalogue.names(), "n-four-bar:3")}
    assert len(digests) == len(catalogue.names()) + 1


def test_the_canonical_text_has_floats_to_the_last_digit():
    assert "0.1 " in canonical_text(changed("bodies.a.centre_of_mass", [0.1, 0.0])).replace(")", " ")
    assert "-0.0" not in canonical_text(changed("bodies.a.centre_of_mass", [-0.0, 0.0]))


def exactly(terms, start=0):
    """Sum floats as exactly as Python 3.12 and newer do, anything else as always."""
    terms = list(terms)
    if start == 0 and terms and all(type(term) is float for term in terms):
        return math.fsum(terms)
    return functools.reduce(operator.add, terms, start)


def one_after_the_other(terms, start=0):
    """Sum as Python 3.11 does."""
    return functools.reduce(operator.add, terms, start)


@pytest.mark.parametrize("name", ["chain:4", "stewart-platform", "front-suspension"])
def test_no_python_adds_the_digits_of_a_description_in_another_way(name, monkeypatch):
    found = set()
    for way in (exactly, one_after_the_other):
        monkeypatch.setattr(builtins, "sum", way)
        found.add(digest(load_mechanism(name)))
    assert len(found) == 1


@pytest.mark.slow
def test_the_same_in_every_process():
    code = (
        "from symgen.describe import load; "
        "from symgen.describe.facts.digest import digest; print(digest(load('andrews')))"
    )
    found = set()
    for seed in ("1", "2"):
        result = subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, check=True, env={"PYTHONHASHSEED": seed}
        )
        found.add(result.stdout.strip())
    assert found == {digest(load_mechanism("andrews"))}
