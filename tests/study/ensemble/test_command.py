"""``symgen sweep``: output, exit codes and sentences."""

import json

import pytest

from symgen.cli import main

BASE = ("sweep", "four-bar", "--until", "0.02", "--vary")


def test_json_is_the_contract_and_nothing_else(cli):
    code, out, err = cli(*BASE, "crank_mass=values(1,2,-3)", "--vary", "crank.omega=lin(0,1,2)", "--json")
    found = json.loads(out)
    assert code == 0 and "warning: 2 of 6 runs failed" in err
    assert found["runs"] == 6 and found["axes"] == {"crank_mass": 3, "crank.omega(0)": 2}
    assert found["status"] == {"ok": 4, "unverified": 0, "failed": 2, "not_run": 0}
    assert [row["runs"] for row in found["reasons"]] == [2] and found["times"] == 1 and found["output"] is None
    assert (found["method"], found["integrator"], found["step"], found["until"]) == (
        "direct-correction",
        "picard",
        None,
        0.02,
    )


def test_a_table_for_people(cli):
    code, out, _ = cli(*BASE, "crank_mass=lin(1,3,4)", "--quantity", "crank.theta", "--jobs", 2)
    assert code == 0
    for text in ("four-bar", "crank_mass: 4 values from 1 to 3", "ok: 4", "crank.theta", "runs a second"):
        assert text in out


def test_all_names_together(cli):
    words = ("--vary", "coupler_mass=uniform(1,2,5,3)", "--zip", "--json", "--times", "0.01,0.02")
    code, out, _ = cli(*BASE, "crank_mass=lin(1,3,5)", *words)
    assert code == 0 and json.loads(out)["axes"] == {"run": 5} and json.loads(out)["times"] == 2


def test_all_runs_failed(cli):
    code, _, err = cli(*BASE, "crank_mass=values(-1,-2)", "--json")
    assert code == 1 and "all 2 runs failed: parameters: mass or inertia of crank" in err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("crank_mass",), "--vary: expected NAME=VALUES, such as crank_mass=lin(1,3,21), got 'crank_mass'"),
        (("a=lin(0,1,2)", "--vary", "a=lin(0,1,2)"), "--vary a: expected each name once, got it twice"),
        (("crank_mass=values(1)", "--jobs", "0"), "--jobs: expected a whole number from 1 to 4096, got 0"),
        (("crank_mass=values(1)", "--resume"), "--resume: expected the output that was begun, got no --output"),
        (("crank_mass=values(1)", "-o", "x.txt"), "output: expected a file ending in .nc"),
        (("crank_mass=values(1)", "--times", "0.01", "--output-step", "0.01"), "expected one way of choosing outputs"),
        (("crank_mass=values(1)", "--scheduler", "here", "--jobs", "2"), "--jobs: expected threads of this machine"),
    ],
)
def test_bad_words_are_refused_in_one_sentence(cli, words, said):
    code, out, err = cli(*BASE, *words)
    assert code == 2 and out == "" and err.count("\n") == 1 and said in err


def test_velocities_that_the_joints_do_not_allow_are_told(tmp_path, monkeypatch, capsys):
    """The bob hangs sideways: it can only move up and down, so that what varies is 0 in every run but the first."""
    monkeypatch.chdir(tmp_path)
    words = ["sweep", "pendulum", "--vary", "bob.vx=values(0,0.3,0.5)", "--until", "0.002", "--quantity", "bob.vx"]
    assert main(words) == 0
    what = "given velocities contradicted the constraints and were projected; --strict lets such runs fail"
    told = f"warning: in 2 of 3 runs: {what}"
    assert told in capsys.readouterr().err
    assert main([*words[:3], "bob.vy=values(0,0.3)", *words[4:]]) == 0
    assert "projected" not in capsys.readouterr().err
