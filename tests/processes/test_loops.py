"""A machine with a geared crank and a slide that rubs by its normal force, by command in both shapes of its code."""

import json

import pytest

from tests.processes.programs import shell

MACHINE = """
[mechanism]
name = "geared-slider"
gravity = [0.0, -9.81]

[bodies]
crank = { mass = 1.0, inertia = 0.01, position = [0.1, 0.0], points = { a = [-0.1, 0.0], b = [0.1, 0.0] } }
rod = { mass = 1.0, inertia = 0.02, position = [0.45, 0.0], points = { b = [-0.25, 0.0], c = [0.25, 0.0] } }
block = { mass = 0.5, inertia = 1.0, position = [0.7, 0.0] }

[joints.A]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], "a"]
rotor_inertia = 1e-5
gear_ratio = 20.0
start = { rate = 9.0 }

[joints.B]
type = "revolute"
between = ["crank", "rod"]
at = ["b", "b"]

[joints.C]
type = "revolute"
between = ["rod", "block"]
at = ["c", "centre"]

[joints.slide]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
friction = { coefficient = 0.3 }
"""


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_both_shapes_run_alike(tmp_path):
    (tmp_path / "machine.toml").write_text(MACHINE)
    runs = {}
    for shape in ("straight", "looped"):
        command = (
            f"symgen run machine.toml --method lagrange --integrator rk4 --step 5e-4 --until 1 --shape {shape} --json"
        )
        runs[shape] = json.loads(shell(command, tmp_path)[0])
    straight, looped = runs["straight"], runs["looped"]
    assert looped["shape"] == "looped" and looped["rank"] == straight["rank"]
    assert [e["name"] for e in looped["events"]] == [e["name"] for e in straight["events"]] == ["slide.reverse"] * 3
    for one, other in zip(straight["events"], looped["events"], strict=True):
        assert abs(one["t"] - other["t"]) < 1e-10
    for name, number in straight["final"]["q"].items():
        assert abs(looped["final"]["q"][name] - number) < 1e-9
