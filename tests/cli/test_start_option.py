"""Starts on the command line: ``--start`` of runs, checks and comparisons."""

import json
from pathlib import Path

import pytest

from symgen.cli import main

WIPER = str(Path(__file__).resolve().parents[1] / "data" / "defects" / "wiper.toml")


@pytest.mark.slow
def test_starts_on_the_command_line(capsys):
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
        (("--start", "crank.theta=0.5", "--start", "arm.theta=1"), "arm.theta = 1 rad held: joint '"),
    ):
        assert main(["run", WIPER, *words]) == 2
        said = capsys.readouterr().err
        assert told in said and said.count("\n") == 1
