"""Analyses at a singular position note it, with its rank and that of positions nearby; elsewhere they do not."""

import json

import pytest
from support.emitted import mechanism_of
from support.models import parallelogram

import symgen
from symgen.cli import main

NOTE = (
    "the position is singular: its constraint rows have rank 4, those of positions nearby 5; degrees of freedom "
    "counted here are not those of the motion"
)
FOLDED = """
[mechanism]
name = "folded"
gravity = [9.81, 0.0]
[bodies.a]
mass = 1.0
inertia = 0.1
position = [0.0, 1.0]
angle = "pi/2"
[bodies.b]
mass = 2.0
inertia = 0.2
position = [2.0, 1.0]
angle = "pi/2"
[joints.A]
type = "revolute"
between = ["ground", "a"]
at = [[0.0, 0.0], [-1.0, 0.0]]
[joints.B]
type = "revolute"
between = ["ground", "b"]
at = [[2.0, 0.0], [-1.0, 0.0]]
[joints.bar]
type = "distance"
between = ["a", "b"]
at = ["centre", "centre"]
length = 2.0
"""


@pytest.mark.slow_cases("joint", "absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_the_note_is_there_at_the_singular_position_alone(coordinates):
    """Weight along the ground line folds three parallel links flat, weight across it does not."""
    for gravity, freedom in (([0.0, -9.81], 1), ([9.81, 0.0], 2)):
        raw = parallelogram()
        raw["mechanism"]["gravity"] = gravity
        model = symgen.load(mechanism_of(raw))
        modes = model.modes(coordinates=coordinates)
        assert modes.degrees_of_freedom == freedom
        for analysis in (modes, model.equilibrium(coordinates=coordinates), model.linearise(coordinates=coordinates)):
            assert any("position is singular" in note for note in analysis.notes) == (freedom == 2), analysis.notes


@pytest.mark.slow_cases("equilibrium", "modes")
@pytest.mark.parametrize("command", ["equilibrium", "modes", "linearise"])
def test_the_note_is_on_standard_error_and_in_json(command, tmp_path, capsys):
    file = tmp_path / "folded.toml"
    file.write_text(FOLDED)
    assert main([command, str(file)]) == 0
    assert NOTE in capsys.readouterr().err
    assert main([command, str(file), "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert NOTE in data.get("equilibria", [data])[0]["notes"]
