"""Every command in-process: what it prints where, and its exit code."""

import json
import re
from importlib import import_module

import numpy as np
import pytest

import symgen
from symgen.analyses.kinds import ANALYSES
from symgen.cli import COMMANDS


def test_help_names_every_command(cli):
    code, out, err = cli("--help")
    assert code == 0 and err == ""
    for name in COMMANDS:
        folder = "symgen.analyses.kinds" if name in ANALYSES else "symgen.cli"
        line = import_module(f"{folder}.{name}").__doc__.splitlines()[0]
        assert line.endswith(".") and re.search(rf"^  {name} +{re.escape(line)}$", out, re.MULTILINE), name


@pytest.mark.parametrize("name", list(COMMANDS))
def test_help_of_every_command(cli, name):
    code, out, _ = cli(name, "--help")
    assert code == 0 and out.startswith(f"Usage: symgen {name}")


def test_no_command_at_all_shows_the_help_and_is_wrong(cli):
    code, out, err = cli()
    assert code == 2 and out == "" and "Commands:" in err


def test_version(cli):
    assert cli("--version") == (0, f"symgen {symgen.__version__}\n", "")


# -- list, new, check, schema, cache, completion -----------------------------------------------------------------------


def test_list(cli):
    code, out, _ = cli("list")
    assert code == 0 and "four-bar" in out and "IFToMM" in out and "until [s]" in out
    found = {row["name"]: row for row in json.loads(cli("list", "--json")[1])["mechanisms"]}
    assert found["n-four-bar"]["sized"] and found["n-four-bar"]["default_size"] == 2
    assert found["four-bar"]["until"] == 10.0 and found["four-bar"]["step"] == 1e-3


@pytest.mark.slow
def test_new_gives_a_file_that_runs_and_never_overwrites(cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, _ = cli("new", "my-crane")
    assert code == 0 and out == "wrote my-crane.toml; try: symgen run my-crane.toml\n"
    before = (tmp_path / "my-crane.toml").read_bytes()
    code, out, err = cli("new", "my-crane")
    assert code == 2 and out == "" and "a file that does not exist yet" in err
    assert (tmp_path / "my-crane.toml").read_bytes() == before
    assert cli("new", "my-crane", "-o", "-")[1].encode() == before
    assert cli("run", "my-crane.toml", "--until", "0.05", "--json")[0] == 0
    assert cli("new", "my-robot", "--space", "spatial")[0] == 0
    found = json.loads(cli("check", "my-robot.toml", "--json")[1])
    assert found["degrees_of_freedom"] == 2 and found["rank"] == 10


@pytest.mark.slow
def test_check(cli):
    code, out, _ = cli("check", "four-bar")
    assert code == 0 and "1 degree of freedom" in out and "8 constraint rows of rank 8" in out
    found = json.loads(cli("check", "n-four-bar:3", "--json")[1])
    assert found["rank"] == 20 and found["degrees_of_freedom"] == 1 and found["sizes"]["coordinates"] == 21


def test_check_says_which_joint_stays_open(cli, tmp_path):
    path = tmp_path / "open.toml"
    path.write_text(
        '[mechanism]\nname = "open"\n[bodies.rod]\nmass = 1.0\ninertia = 0.1\nposition = [0.5, 0.0]\n'
        '[joints.a]\ntype = "revolute"\nbetween = ["ground", "rod"]\nat = [[0.0, 0.0], [-0.5, 0.0]]\n'
        '[joints.b]\ntype = "revolute"\nbetween = ["ground", "rod"]\nat = [[9.0, 0.0], [0.5, 0.0]]\n'
    )
    code, out, err = cli("check", path)
    assert code == 2 and out == ""
    assert re.search(r"open: the mechanism cannot be assembled from this start: joint '[ab]' stays open by", err)


def test_schema_is_json(cli):
    assert json.loads(cli("schema")[1])["title"] == "symgen mechanism"


def test_cache(cli, tmp_path, monkeypatch):
    monkeypatch.setenv("SYMGEN_CACHE_DIR", str(tmp_path / "cache"))
    found = json.loads(cli("cache", "info", "--json")[1])
    assert found["path"] == str(tmp_path / "cache") and found["persistent"] and found["entries"] == 0
    code, out, _ = cli("cache", "clear")
    assert code == 0 and out.startswith("cleared; ")


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion(cli, shell):
    code, out, _ = cli("completion", shell)
    assert code == 0 and "_SYMGEN_COMPLETE" in out


# -- generate ----------------------------------------------------------------------------------------------------------


def test_generate_writes_one_method_unless_more_are_asked_for(cli, tmp_path):
    folder = tmp_path / "out"
    code, out, err = cli("generate", "four-bar", "-o", folder)
    names = {"model.py", "direct_correction.py", "model.json", "README.md", "simulate.py"}
    assert code == 0 and err == "" and {p.name for p in folder.iterdir()} == names
    assert len(out.splitlines()) == len(names)


def test_generate_takes_structural_options(cli, tmp_path):
    code, out, _ = cli(
        *("generate", "pendulum", "--method", "direct-correction", "--option", "method.weight=mass"),
        *("-o", tmp_path / "out", "--json"),
    )
    assert code == 0
    assert any(f["path"].endswith("direct_correction.py") for f in json.loads(out)["files"])
    about = json.loads((tmp_path / "out" / "model.json").read_text())
    assert about["methods"]["direct_correction"]["options"]["weight"] == "mass"


def test_generate_refuses_what_is_wrong_and_writes_nothing(cli, tmp_path):
    for arguments in (("--method", "nope"), ("--option", "nope.weight=mass"), ("--option", "weight")):
        code, out, err = cli("generate", "pendulum", *arguments, "-o", tmp_path / "out")
        assert code == 2 and out == "" and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


# -- run ---------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_sensitivities_of_a_run(cli):
    words = ("run", "four-bar", "--integrator", "rk4", "--step", "1e-2", "--until", "0.2")
    code, out, _ = cli(*words, "--sensitivity", "crank_mass,coupler_mass", "--quantity", "crank.theta")
    assert code == 0
    shown = [line.split() for line in out.splitlines() if line.startswith("crank.theta ") and "_mass" in line]
    found = json.loads(cli(*words, "--sensitivity", "crank_mass,coupler_mass", "--json")[1])["sensitivities"]
    assert [(row[1], row[3]) for row in shown] == [("crank_mass", "rad/kg"), ("coupler_mass", "rad/kg")]
    assert [float(row[2]) for row in shown] == pytest.approx([*found["final"]["crank.theta"].values()], rel=1e-4)
    code, _, err = cli(*words, "--sensitivity", "crank_mas")
    assert code == 2
    assert "did you mean 'crank_mass'?" in err


def test_run_json_is_alone_on_standard_output(cli):
    code, out, err = cli("run", "four-bar", "--integrator", "rk4", "--until", "0.2", "--json")
    assert code == 0 and err == ""
    found = json.loads(out)
    assert found["status"] == "ok" and found["steps"] == 200 and found["evaluations"] == 800


def test_run_defaults(cli):
    found = json.loads(cli("run", "pendulum", "--until", "0.1", "--json")[1])
    assert (found["method"], found["integrator"], found["rtol"]) == ("direct-correction", "picard", 1e-8)
    assert found["step"] is None and found["proposals"] == []


@pytest.mark.slow
def test_run_takes_everything(cli, tmp_path):
    code, out, _ = cli(
        *("run", "four-bar", "--method", "baumgarte", "--integrator", "dopri5", "--rtol", "1e-7", "--atol", "1e-9"),
        *("--until", "0.3", "--output-step", "0.1", "--set", "crank_mass=3", "--option", "method.alpha=8"),
        *("--option", "baumgarte.beta=8", "--step", "1e-4", "--repeat", "2", "--strict", "--verify", "--json"),
        *("--save", tmp_path / "a.csv", "--plot", tmp_path / "a.png"),
    )
    assert code == 0
    found = json.loads(out)
    assert found["parameters"]["crank_mass"] == 3.0 and found["rtol"] == 1e-7 and found["step"] == 1e-4
    assert {p.name for p in tmp_path.iterdir()} == {"a.csv", "a.png"}
    assert len((tmp_path / "a.csv").read_text().splitlines()) == 5


def test_quantities_are_checked_before_the_run(cli, tmp_path, monkeypatch):
    def simulate(*arguments, **settings):
        raise AssertionError("the run has begun")

    monkeypatch.setattr("symgen.api.Model.simulate", simulate)
    monkeypatch.chdir(tmp_path)
    words = ("--quantity", "crank.omga", "--save", "x.csv")
    code, out, err = cli("run", "four-bar", *words)
    assert code == 2 and out == "" and not list(tmp_path.iterdir())
    (said,) = err.splitlines()
    assert "quantity 'crank.omga': expected a quantity of four-bar" in said and "'crank.omega'" in said


def test_run_shows_a_table(cli):
    code, out, _ = cli("run", "four-bar", "--until", "0.1")
    assert code == 0
    assert re.search(r"^status +ok$", out.replace(" \n", "\n"), re.MULTILINE) or "status" in out
    lines = {line.split()[0]: line.split() for line in out.splitlines() if line.strip()}
    assert lines["quantity"] == "quantity smallest at t [s] largest at t [s] at the end unit".split()
    table = symgen.load("four-bar").simulate(until=0.1)
    force, angle = table["D.F"], table["A.angle"]
    for name, column, unit in (("D.F", force, "N"), ("A.angle", angle, "rad")):
        low, high = int(np.argmin(column)), int(np.argmax(column))
        shown = [float(x) for x in lines[name][1:6]]
        expected = [column[low], table.t[low], column[high], table.t[high], column[-1]]
        assert shown == pytest.approx(expected, rel=1e-4, abs=1e-6)
        assert lines[name][6] == unit


def test_a_driver_shows_its_effort_and_not_the_size_of_it_again(cli):
    code, out, _ = cli("run", "driven-four-bar", "--until", "0.2")
    assert code == 0 and "motor.effort" in out and "motor.F" not in out


def test_a_failed_run_shows_no_loads(cli):
    drifting = ("--method", "lagrange", "--integrator", "rk4", "--step", "2e-2", "--until", "3")
    code, out, _ = cli("run", "four-bar", *drifting)
    assert code == 1 and "A.angle" in out and "A.F" not in out


def test_a_failed_run_exits_1_and_still_gives_its_result(cli, tmp_path):
    drifting = ("--method", "lagrange", "--integrator", "rk4", "--step", "2e-2", "--until", "3")
    code, out, err = cli("run", "four-bar", *drifting, "--json", "--save", tmp_path / "a.csv")
    assert code == 1
    found = json.loads(out)
    assert found["status"] == "failed" and found["final"]["t"] > 0.0
    assert err.splitlines()[-1] == f"symgen: failed: {found['reason']}"
    assert (tmp_path / "a.csv").exists()


def test_an_unverified_run_exits_0_with_a_warning(cli, monkeypatch):
    from dataclasses import replace

    from symgen.api import Model

    real = Model.simulate

    def doubtful(self, *a, **k):
        return replace(real(self, *a, **k), status="unverified", reason="nobody knows")

    monkeypatch.setattr(Model, "simulate", doubtful)
    code, out, err = cli("run", "pendulum", "--until", "0.1", "--json")
    assert code == 0 and json.loads(out)["status"] == "unverified"
    assert err == "symgen: warning: unverified: nobody knows\n"


# -- compare -----------------------------------------------------------------------------------------------------------

COMPARE = ("--methods", "lagrange,direct-correction", "--integrators", "rk4", "--steps", "0.01,0.005", "--until", "0.5")


def test_compare_table_json_and_csv(cli, tmp_path):
    code, out, _ = cli("compare", "pendulum", *COMPARE, "--repeat", "1")
    assert code == 0 and "Jacobi's elliptic functions" in out and "error [m]" in out
    code, out, err = cli("compare", "pendulum", *COMPARE, "--repeat", "1", "--json", "--csv", tmp_path / "rows.csv")
    found = json.loads(out)
    assert code == 0 and err == "" and len(found["rows"]) == 4
    assert len((tmp_path / "rows.csv").read_text().splitlines()) == 5


def test_compare_against_another_reference(cli):
    code, out, _ = cli("compare", "pendulum", *COMPARE, "--repeat", "1", "--reference", "scipy-lsoda", "--json")
    usual = cli("compare", "pendulum", *COMPARE, "--repeat", "1", "--json")[1]
    assert code == 0 and "SciPy LSODA at 1e-12" in json.loads(out)["reference"]["how"]
    for found, expected in zip(json.loads(out)["rows"], json.loads(usual)["rows"], strict=True):
        assert found["error"] == pytest.approx(expected["error"], rel=1e-2, abs=1e-10)


@pytest.mark.slow
def test_compare_several_models(cli):
    code, out, _ = cli("compare", "pendulum", "four-bar", *COMPARE, "--repeat", "1", "--json")
    assert code == 0
    assert [s["mechanism"] for s in json.loads(out)["studies"]] == ["pendulum", "four-bar"]


@pytest.mark.slow
def test_a_study_in_which_everything_failed_exits_1(cli):
    code, out, err = cli(
        *("compare", "four-bar", "--methods", "lagrange", "--integrators", "rk4", "--steps", "0.6"),
        *("--until", "3", "--repeat", "1", "--json"),
    )
    assert code == 1 and err == "symgen: four-bar: every run failed\n"
    assert json.loads(out)["rows"][0]["status"] == "failed"


# -- what is wrong -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ['x"]; import os', "__import__('os')", "lambda: 0", "a.__class__", "../../etc/passwd"])
@pytest.mark.parametrize("command", ["run", "check", "inspect", "generate", "compare"])
def test_hostile_names_are_only_names(cli, tmp_path, monkeypatch, command, name):
    monkeypatch.chdir(tmp_path)
    code, out, err = cli(command, name)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
