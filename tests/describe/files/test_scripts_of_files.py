"""The Python script of a mechanism file describes the same mechanism."""

from typing import Any

import pytest

from symgen.describe import catalogue
from symgen.describe.files.load import parse_toml
from symgen.describe.files.script import script_of_mechanism
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

FILES = sorted(name for name in catalogue.names() if catalogue.file_of_entry(name) is not None)


def built(text: str) -> Mechanism:
    scope: dict[str, Any] = {}
    exec(text.split("\nresult = ")[0], scope)  # a script that this test has had written
    mechanism: Mechanism = scope["builder"].build()
    return mechanism


@pytest.mark.parametrize("name", FILES)
def test_a_script_builds_the_mechanism_of_its_file(name: str) -> None:
    path = catalogue.file_of_entry(name)
    assert path is not None
    raw = parse_toml(path.read_text(encoding="utf-8"), name)
    assert built(script_of_mechanism(raw)) == validate(raw, name)


HOSTILE = r"""
[mechanism]
name = "bar"
title = "\"\"\" ' ); raise SystemExit('title') # \n \\"
gravity = [0.0, -9.81]
[parameters]
m = { value = 1.0, unit = "kg", note = "'); raise SystemExit('note')" }
w = { value = 2.0 }
[bodies.rod]
mass = "m"
inertia = 0.1
points = { A = [0.0, 0.5] }
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "A"]
[stops.floor]
gap = "rod.y + w"
[outputs]
height = { value = "rod.y + 1", unit = "m" }
"""


def test_texts_of_a_file_are_literals_and_stops_have_a_call() -> None:
    raw = parse_toml(HOSTILE, "bar")
    assert built(script_of_mechanism(raw)) == validate(raw, "bar")
