"""Commands of analyses: keys of their JSON, tables, words of refusals and exit codes."""

import json
import subprocess
import sys

import pytest


def facts(cli, *words):
    code, out, err = cli(*words, "--json")
    assert code == 0, err
    return json.loads(out)


KEYS = {"q", "stability", "omega_squared", "residual", "iterations", "multipliers", "not_unique"}


@pytest.mark.slow
def test_equilibria_as_programs_read_them(cli):
    found = facts(cli, "equilibrium", "four-bar", "--scan", "crank.theta=lin(0,6.28,13)")["equilibria"]
    assert [e["stability"] for e in found] == ["unstable", "stable"] and all(set(e) >= KEYS for e in found)
    assert set(found[0]["multipliers"]) == {f"{j}.{c}" for j in "ABCD" for c in "xy"}
    assert {"crank.theta", "rocker.x", "A.angle"} <= set(found[0]["q"])
    (again,) = facts(cli, "equilibrium", "four-bar", "--start", "crank.theta=4.0", "--coordinates", "joint")[
        "equilibria"
    ]
    assert again["q"]["crank.theta"] == pytest.approx(found[1]["q"]["crank.theta"], rel=1e-12)
    assert set(again["q"]) >= set(found[0]["q"]) and set(again["multipliers"]) == set(found[0]["multipliers"])


@pytest.mark.slow
def test_modes_and_systems_as_programs_read_them(cli):
    modes = facts(cli, "modes", "four-bar", "--start", "crank.theta=4.0")
    (square,) = modes["omega_squared"]
    assert modes["degrees_of_freedom"] == 1 and modes["eigenvalues"][0] == [0.0, pytest.approx(square**0.5)]
    assert modes["eigenvalues"][1] == [0.0, pytest.approx(-(square**0.5))]
    found = facts(cli, "linearise", "bicycle", "--at", "start", "--states", "lean,steer")
    assert set(found) >= {"A", "B", "C", "D", "states", "inputs", "outputs"}
    assert found["states"] == ["lean", "steer", "lean.rate", "steer.rate"] and found["inputs"] == ["steer_torque"]
    assert found["outputs"] == ["lean", "steer"] and found["C"][0] == pytest.approx([1, 0, 0, 0], abs=1e-12)


@pytest.mark.parametrize("at", ["equilibrium", "start"])
def test_one_sentence_where_all_freedom_is_driven(cli, at):
    code, out, err = cli("modes", "driven-four-bar", "--at", at)
    assert (code, out.strip(), err) == (0, "no degree of freedom is left: there are no modes", "")
    code, out, err = cli("linearise", "driven-four-bar", "--at", at)
    assert (code, out.strip(), err) == (0, "no degree of freedom is left: there is nothing to linearise", "")


@pytest.mark.slow
def test_tables_are_readable(cli, tmp_path):
    code, out, _ = cli("equilibrium", "four-bar", "--start", "crank.theta=4.0")
    assert code == 0 and out.startswith("stable; omega^2 [1/s^2]: 8.35") and "crank.theta" in out
    code, out, _ = cli("modes", "four-bar", "--start", "crank.theta=4.0")
    assert code == 0 and "1 degree of freedom;" in out and "coupler" in out and "%" in out
    code, out, _ = cli("linearise", "bicycle", "--at", "start", "--states", "lean,steer")
    assert code == 0 and "x' = A x" in out and "+ B u" in out and "steer.rate" in out
    picture = tmp_path / "locus.svg"
    words = ("modes", "four-bar", "--start", "crank.theta=4.0", "--over", "rocker_mass=lin(4,6,3)", "--plot", picture)
    code, out, _ = cli(*words)
    assert code == 0 and "rocker_mass" in out and picture.exists()
    code, out, _ = cli("equilibrium", "flyball-governor", "--steady")
    assert code == 0 and "hinge1.angle" in out


@pytest.mark.parametrize(
    ("words", "code", "says"),
    [
        (("equilibrium", "four-bar", "--scan", "crank.theta"), 2, "NAME=VALUES"),
        (("equilibrium", "four-bar", "--scan", "crank.theta=lin(0,6)"), 2, "lin(first, last, count)"),
        (("equilibrium", "four-bar", "--scan", "crank.theta=lin(2,3,3)"), 1, "no equilibrium was found"),
        (("equilibrium", "four-bar", "--scan", "rank.theta=lin(2,3,3)"), 2, "did you mean 'crank.theta'"),
        (("equilibrium", "four-bar", "--start", "crank.thet=1"), 2, "did you mean 'crank.theta'"),
        (("equilibrium", "four-bar", "--scan", "crank.theta=lin(2,3,3)", "--steady"), 2, "at rest"),
        (("modes", "four-bar", "--at", "start"), 2, "a state of rest"),
        (("modes", "four-bar", "--at", "begin"), 2, "equilibrium, start, steady, a time"),
        (("modes", "four-bar", "--plot", "x.svg"), 2, "--over"),
        (("modes", "four-bar", "--over", "mass=lin(1,2,3)"), 2, "mass"),
        (("linearise", "four-bar", "--states", "A.angel"), 2, "did you mean 'A.angle'"),
        (("linearise", "four-bar", "--states", ","), 2, "words separated by commas"),
    ],
)
def test_bad_use_ends_in_a_sentence(cli, words, code, says):
    got, out, err = cli(*words)
    assert got == code and not out and says in err and err.count("\n") == 1


# -- one file an analysis ----------------------------------------------------------------------------------------------

MASS = '''"""Find the mass of a mechanism."""

from symgen.analyses.kinds import Analysis, Option, AnalysisOutput, change_settings_checked


def mass(model, settings=None, **changes):
    """Return the mass of all bodies [kg]."""
    from symgen.describe.formulas.evaluate import parameter_values, scalar_values

    whole = change_settings_checked("mass", settings, changes, ("parameters",))
    value = scalar_values(parameter_values(model.mechanism, whole.parameters)).value
    return sum(value(body.mass, body.name) for body in model.mechanism.bodies)


def command(load, settings, grams):
    """Find the mass of all bodies of MODEL."""
    model = load()
    found = mass(model, settings) * (1e3 if grams else 1.0)
    return AnalysisOutput({"mechanism": model.mechanism.name, "mass": found}, (f"{found:.6g}",))


KIND = Analysis(
    methods=(mass,),
    command=command,
    options=(Option("parameters"), Option("--grams", "In grams.", "switch")),
    examples=("symgen mass four-bar",),
)
'''


@pytest.mark.slow
def test_an_analysis_with_its_command_is_one_file(tmp_path):
    (tmp_path / "mass.py").write_text(MASS, encoding="utf-8")
    found = "import sys, symgen.analyses.kinds as kinds; kinds.__path__.append(sys.argv.pop(1))\n"

    def python(code, *words):
        done = [sys.executable, "-c", found + code, str(tmp_path), *words]
        return subprocess.run(done, capture_output=True, text=True, check=True, timeout=600).stdout

    command = "from symgen.cli import main; assert main() == 0; print('numpy' in sys.modules)"
    shown = python(command, "--help")
    assert "\n  mass         Find the mass of a mechanism.\n" in shown and shown.endswith("False\n")
    shown = python(command, "mass", "--help")
    assert "  --grams" in shown and shown.endswith("False\n")
    line, _ = python(command, "mass", "pendulum", "--set", "bob_mass=2.5", "--grams", "--json").splitlines()
    assert json.loads(line) == {"mechanism": "pendulum", "mass": 2500.0}
    method = "import symgen; m = symgen.load('pendulum'); print(m.mass(parameters={'bob_mass': 2.5}), m.mass.__doc__)"
    assert python(method) == "2.5 Return the mass of all bodies [kg].\n"
