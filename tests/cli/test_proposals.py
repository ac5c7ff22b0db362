"""What a run that failed proposes: taken literally, added to the same command, it works."""

from __future__ import annotations

import json
import shlex
from pathlib import Path

import pytest

from symgen.cli import main

WIPER = str(Path(__file__).resolve().parents[1] / "data" / "defects" / "wiper.toml")
SPRING = """
[mechanism]
name = "stiff-spring"
[run]
until = 0.5
step = 1e-2
[bodies.mass]
type = "point"
mass = 1.0
position = [1.01, 0.0]
[forces.coil]
type = "spring-damper"
between = ["ground", "mass"]
at = [[0.0, 0.0], "centre"]
stiffness = STIFFNESS
damping = DAMPING
free_length = 1.0
"""
GRID = ("--option", "integrator.adaptive=false")
#: Commands that fail, and what their proposal is about.
CASES = {
    "defaults of a wiper": ((WIPER,), "--step"),
    "a stiff spring": (("spring.toml", "--integrator", "rk4"), "--step"),
    "a stiff damper": (("damper.toml", "--integrator", "rk4"), "--step"),
    "a step that is too large": (("four-bar", "--step", "0.2"), "--step"),
    "Euler's method from rest": (("four-bar", "--method", "lagrange", "--integrator", "euler"), "--integrator"),
    "drift": (("four-bar", "--method", "lagrange", "--step", "2e-2", "--until", "3"), "--method"),
    "velocities that follow": (("slider-crank", "--method", "generalized-alpha", "--step", "1e-2"), "--method"),
    "an implicit scheme": (("four-bar", "--integrator", "radau5", *GRID, "--step", "0.3"), "--step"),
    "a narrow limit": (("four-bar", "--method", "lagrange", "--until", "1", "--max-violation", "1e-13"), "--method"),
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    for name, stiffness, damping in (("spring", "1e6", "0.0"), ("damper", "1e4", "1e4")):
        text = SPRING.replace("STIFFNESS", stiffness).replace("DAMPING", damping)
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(
    "case",
    [pytest.param(c, marks=pytest.mark.slow if c.startswith(("velocities", "an implicit")) else ()) for c in CASES],
)
def test_what_is_proposed_works(case, folder, capsys):
    words, about = CASES[case]
    assert main(["run", *words, "--json"]) == 1
    streams = capsys.readouterr()
    (proposed,) = json.loads(streams.out)["proposals"]
    assert streams.err.splitlines()[-1].endswith(f"; it ends as ok with {proposed}")
    assert proposed.startswith(about)
    assert main(["run", *words, *shlex.split(proposed), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["status"] == "ok" and found["proposals"] == []


def test_a_run_that_goes_on_is_tried_from_where_it_began(folder, capsys, tmp_path):
    assert main(["run", WIPER, "--start", "crank.theta=0.5", "--step", "1e-4", "--until", "0.3", "--save", "a.nc"]) == 0
    words = (WIPER, "--from", "a.nc", "--step", "2e-3")
    assert main(["run", *words]) == 1
    proposed = capsys.readouterr().err.splitlines()[-1].partition("it ends as ok with ")[2]
    assert main(["run", *words, *shlex.split(proposed)]) == 0


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_what_a_run_gives_an_input_is_tried_as_well(folder, capsys, coordinates):
    """The search knew no inputs: it ended the command with code 2, and nothing was shown of the run."""
    text = "[inputs]\npush = 0.0\n" + SPRING.replace("STIFFNESS", "1e6").replace("DAMPING", "0.0")
    text += '\n[forces.thrust]\ntype = "force"\nbody = "mass"\nforce = ["push", 0.0]\n'
    Path("pushed.toml").write_text(text, encoding="utf-8")
    words = ("run", "pushed.toml", "--input", "push=sin(20*t)", "--integrator", "rk4", "--json")
    words += ("--coordinates", coordinates)
    assert main([*words]) == 1
    (proposed,) = json.loads(capsys.readouterr().out)["proposals"]
    assert main([*words, *shlex.split(proposed)]) == 0


def test_where_nothing_is_found_nothing_is_proposed(folder, capsys):
    """A force that has no value from some time on, whatever the step."""
    text = SPRING.replace("STIFFNESS", "1.0").replace("DAMPING", "0.0")
    text += '\n[forces.lost]\ntype = "force"\nbody = "mass"\nforce = ["sqrt(0.2 - t)", 0.0]\n'
    Path("lost.toml").write_text(text, encoding="utf-8")
    assert main(["run", "lost.toml", "--json"]) == 1
    streams = capsys.readouterr()
    assert json.loads(streams.out)["proposals"] == []
    assert "ends as ok" not in streams.err


def test_starts_on_the_command_line(folder, capsys):
    words = ("--start", "crank.theta=0.5", "--start", "motor.rate=2")
    assert main(["run", WIPER, *words, "--until", "0.01", "--step", "1e-4", "--json"]) == 0
    start = json.loads(capsys.readouterr().out)["start"]
    assert start["q"]["crank.theta"] == 0.5 and start["v"]["crank.omega"] == 2.0
    assert main(["check", WIPER, *words, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["start"]["q"] == start["q"]
    words = ("--methods", "lagrange", "--integrators", "rk4", "--steps", "1e-4", "--until", "0.01", "--repeat", "1")
    assert main(["compare", WIPER, "--start", "crank.theta=0.5", *words, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["rows"][0]["error"] < 1e-6
    for words, told in (
        (("--start", "crank.teta=0.5"), "did you mean 'crank.theta'"),
        (("--start", "crank.theta"), "expected NAME=VALUE"),
        (("--start", "crank.theta=x"), "expected a finite number"),
        (("--start", "crank.theta=0.5", "--start", "arm.theta=1"), "0.5 rad, arm.theta = 1 rad held"),
    ):
        assert main(["run", WIPER, *words]) == 2
        said = capsys.readouterr().err
        assert told in said and said.count("\n") == 1
