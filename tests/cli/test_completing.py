"""Completion of values by the shell: what a key press offers at ten places, and what it never does."""

import subprocess
import sys

import pytest
from click.shell_completion import BashComplete

import symgen
from symgen.cli import group
from symgen.derive.methods import METHODS
from symgen.describe import catalogue
from symgen.run.integrators import INTEGRATORS

MECHANISM = """
[mechanism]
name = "own"
gravity = [0.0, -9.81]
[parameters]
mass = 2.0
"$(touch here)" = 1.0
[inputs]
torque = { unit = "N*m" }
[bodies.bob]
mass = "mass"
[joints.pin]
"""


def offered(*words):
    """Values of completions of the last word."""
    return [item.value for item in BashComplete(group, {}, "symgen", "_").get_completions([*words[:-1]], words[-1])]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "own.toml").write_text(MECHANISM)
    (tmp_path / "notes.txt").write_text("")
    (tmp_path / "models").mkdir()
    (tmp_path / "two words.toml").write_text("")
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(
    ("line", "values"),
    [
        ("run four", ["four-bar"]),
        ("run four-bar --method di", ["direct-correction", "discrete-gradient"]),
        ("compare four-bar --methods rattle,baum", ["rattle,baumgarte"]),
        ("run four-bar --integrator dop", ["dop853", "dopri5"]),
        ("view four-bar --coordinates j", ["joint"]),
        ("run four-bar --set c", ["coupler_mass=", "crank_mass="]),
        ("run four-bar --start crank.v", ["crank.vx=", "crank.vy="]),
        ("run heavy-top --start top.w", ["top.wx=", "top.wy=", "top.wz="]),
        ("run four-bar --quantity crank,c", ["crank,coupler", "crank,crank"]),
        ("run four-bar --quantity crank.a", ["crank.ax", "crank.ay", "crank.alpha"]),
        ("run four-bar --over B.F", ["B.F", "B.Fx", "B.Fy"]),
        ("run wiper --quantity arm.tip.a", ["arm.tip.ax", "arm.tip.ay"]),
        ("sweep n-four-bar:2 --integrator pi", ["picard"]),
        ("run own", ["own.toml"]),
        ("run m", ["models/"]),
        ("run own.toml --input ", ["torque="]),
        ("run own.toml --set ", ["mass="]),
        ("run missing.toml --set ", []),
        ("run two", []),
        ("list me", ["mechanisms", "methods"]),
        ("modes own.toml --over m", ["mass="]),
    ],
)
def test_a_key_press_offers_names(folder, line, values):
    assert offered(*line.split(" ")) == values


def test_every_model_method_and_integrator_is_offered(folder):
    assert set(catalogue.all_names()) <= {*offered("run", "")}
    assert {*offered("run", "four-bar", "--method", "")} == {"auto", *METHODS.names}
    assert {*offered("run", "four-bar", "--integrator", "")} == {"auto", *INTEGRATORS.names}


@pytest.mark.by_turns(6)
@pytest.mark.fast("pendulum", "rolling-disc")
@pytest.mark.parametrize(
    "name", ["toggle-press", "scissor-lift", "wiper", "pendulum", "front-suspension", "rolling-disc"]
)
def test_every_quantity_that_is_offered_is_one_of_a_result(name):
    """Names are read from the file, not from a result: each is taken by it, and nearly all of bodies are offered."""
    heads = offered("run", name, "--quantity", "")
    below = [x for head in heads for x in offered("run", name, "--quantity", f"{head}.")]
    deeper = [x for head in below for x in offered("run", name, "--quantity", f"{head}.")]
    result = symgen.load(name).simulate(until=1e-3, verify=False)
    for quantity in (*heads, *below, *deeper):
        assert result.select([quantity]).names, quantity
    columns = {*below, *deeper}
    assert {
        *result.q.names,
        *result.v.names,
        *result.a.names,
        *result.points.names,
        *result.magnitudes.names,
    } <= columns


def test_files_are_left_to_the_shell(folder):
    (item,) = BashComplete(group, {}, "symgen", "_").get_completions(["run", "four-bar", "--save"], "a")
    assert item.type == "file"


def test_a_key_press_runs_no_plugin(folder, tmp_path):
    (tmp_path / "own.py").write_text("open('trace', 'w').close()\n")
    assert offered("run", "four-bar", "--plugin", "own.py", "--method", "lagr") == ["lagrange"]
    assert not (tmp_path / "trace").exists()


def test_a_key_press_imports_no_numpy(folder):
    script = (
        "import sys; from click.shell_completion import BashComplete; from symgen.cli import group;"
        "assert BashComplete(group, {}, 'symgen', '_').get_completions(['run', 'four-bar', '--start'], 'crank.');"
        "assert BashComplete(group, {}, 'symgen', '_').get_completions(['run', 'four-bar', '--method'], 'r');"
        "print(sorted({'numpy', 'sympy', 'scipy', 'numba', 'jinja2'} & {*sys.modules}))"
    )
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert ended.stdout.strip() == "[]"


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_words_that_go_on_get_no_blank(cli, shell):
    script = cli("completion", shell)[1]
    mark = {"bash": "compopt -o nospace", "zsh": "compadd -U -S ''", "fish": "split -m 1"}[shell]
    assert mark in script
