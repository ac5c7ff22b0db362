"""One table of settings: what commands, Python and the pages say of them is what it says."""

import inspect
import re
from dataclasses import fields
from pathlib import Path

import click
import pytest

import symgen
from symgen import settings
from symgen.cli import main
from symgen.cli.compare import command as compare
from symgen.cli.generate import command as generate
from symgen.cli.run import command as run
from symgen.cli.stress import command as stress
from symgen.cli.sweep import command as sweep
from symgen.errors import InputError
from symgen.runtime.run import RunSpec
from symgen.study.stress.study import stress as stress_study

PAGES = Path(__file__).resolve().parents[2] / "docs"
COMMANDS = {"run": run, "compare": compare, "stress": stress, "sweep": sweep}
#: Settings of runs that look for events.
EVENTS = ("stop_when", "record_when", "events")
#: Settings that a command goes without, since it has a list of them, or no use for them.
WITHOUT = {
    "run": {"times", "events"},
    "compare": {
        *("method", "integrator", "step", "rtol", "atol", "times", "strict", "verify", "inputs", "coordinates"),
        *EVENTS,
    },
    "stress": {*settings.names()} - {"max_violation", "max_energy_error", "max_steps", "coordinates"},
    "sweep": {"verify", "repeat", "shape", "events"},
}
#: Defaults of commands that are not those of a single run.
OTHER = {("compare", "repeat"): 3}


def options(command):
    return {p.name: p for p in command.params if isinstance(p, click.Option)}


def rows(name):
    """Return meaning and default by flag, from the table of a command in the page."""
    page = (PAGES / "command-line.md").read_text(encoding="utf-8")
    section = page.partition(f"## `{name}`\n")[2].partition("\n## ")[0]
    found = {}
    for line in section.splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if len(cells) == 3 and cells[0].startswith("`-"):
            for flag in re.findall(r"`(--[\w-]+)", cells[0]):
                found[flag] = cells[1:]
    return found


@pytest.mark.parametrize("name", COMMANDS)
def test_every_setting_is_an_option_of_every_command_that_runs(name):
    found = options(COMMANDS[name])
    assert {n for n in settings.names() if n not in found} == WITHOUT[name]
    for setting in set(settings.names()) - WITHOUT[name]:
        option = found[setting]
        assert settings.flag(setting) in option.opts
        if settings.about(setting).kind is not dict:
            usual = OTHER.get((name, setting), settings.default(setting))
            assert option.get_default(click.Context(COMMANDS[name])) == usual or usual is False
        assert option.help and option.help[0].isupper() and option.help.endswith(".")
        unit = settings.about(setting).unit
        assert not unit or f"[{unit}]" in option.help


@pytest.mark.parametrize("name", COMMANDS)
def test_the_page_has_a_row_for_every_option_and_no_other(name):
    flags = {flag for option in options(COMMANDS[name]).values() for flag in option.opts if flag.startswith("--")}
    assert set(rows(name)) == flags


def test_defaults_in_the_page_are_those_of_the_table():
    for setting in set(settings.names()) - WITHOUT["run"]:
        about, usual = settings.about(setting), settings.default(setting)
        said = rows("run")[settings.flag(setting)][1].replace("`", "")
        if isinstance(usual, float):
            assert float(said) == usual, setting
        elif isinstance(usual, str | int) and not isinstance(usual, bool):
            assert said == str(usual), setting
        elif about.otherwise and about.kind is float and "mechanism" not in about.otherwise:
            assert about.otherwise in said, setting


def test_tolerances_that_the_table_names_are_those_of_a_run():
    spec = inspect.signature(RunSpec).parameters
    for name in ("rtol", "atol"):
        assert float(settings.about(name).otherwise) == spec[name].default
    for name in ("max_violation", "max_energy_error"):
        assert settings.default(name) == spec[name].default


def test_python_says_every_setting():
    text = inspect.getdoc(symgen.Model.simulate)
    page = (PAGES / "python.md").read_text(encoding="utf-8")
    for name in settings.names():
        assert f"``{name}``" in text and f"`{name}`" in page, name
        unit = settings.about(name).unit
        assert not unit or f"``{name}`` [{unit}]" in text, name
    assert settings.names() == tuple(f.name for f in fields(symgen.Settings))


def test_generate_has_the_options_of_the_table():
    assert options(generate)["options"].opts == ["--option"]


@pytest.mark.parametrize(("limit", "reason"), [("--max-violation", "max_violation"), ("--max-energy-error", "energy")])
def test_limits_can_be_set_for_a_run(capsys, limit, reason):
    words = ["run", "four-bar", "--method", "lagrange", "--step", "0.01", "--until", "1", "--json"]
    assert main(words) == 0
    assert main([*words, limit, "1e-13"]) == 1
    assert reason in capsys.readouterr().err
    assert main([*words, limit, "0"]) == 2
    assert f"{limit}: expected a finite number above 0, got 0" in capsys.readouterr().err


@pytest.mark.parametrize("limit", ["max_violation", "max_energy_error"])
def test_limits_can_be_set_for_studies_and_sweeps(limit):
    found = symgen.compare("four-bar", "lagrange", "rk4", 1e-2, until=1.0, repeat=1, **{limit: 1e-13})
    assert found.rows[0].status == "failed" and ("max_violation" in found.rows[0].reason) == (limit == "max_violation")
    many = symgen.sweep("four-bar", {"crank_mass": [1.0]}, method="lagrange", step=1e-2, until=1.0, **{limit: 1e-13})
    assert many.counts["failed"] == 1
    with pytest.raises(InputError, match=f"{limit}: expected a finite number above 0"):
        symgen.compare("four-bar", "lagrange", "rk4", 1e-2, until=1.0, repeat=1, **{limit: -1.0})


def test_steps_are_bounded_by_every_command_that_runs(capsys):
    for words in (
        ["run", "four-bar", "--integrator", "dopri5"],
        ["sweep", "four-bar", "--vary", "crank_mass=values(1)", "--integrator", "dopri5"],
        ["compare", "four-bar", "--methods", "lagrange", "--integrators", "dopri5", "--rtols", "1e-6", "--repeat", "1"],
    ):
        assert main([*words, "--until", "1", "--max-steps", "5"]) == 1, words
        said = capsys.readouterr()
        assert "max_steps" in said.out + said.err, words
    assert main(["run", "four-bar", "--step", "0.01", "--until", "1", "--max-steps", "5"]) == 2
    assert "step: expected at most max_steps = 5 steps, got 100" in capsys.readouterr().err


@pytest.mark.slow
def test_steps_are_bounded_in_stress_studies():
    found = stress_study(["pendulum"], ["gravity"], ["lagrange"], quick=True, max_steps=5.0)
    assert found.rows and all(row.outcome == "refused" and "max_steps" in row.reason for row in found.rows)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["run", "pendulum", "--set", "bob_mass=1", "--set", "bob_mass=2"], "--set bob_mass: expected each name once"),
        (["run", "pendulum", "--start", "bob.vx=1", "--start", "bob.vx=1"], "--start bob.vx: expected each name once"),
        (["run", "cart-pole", "--input", "force=1", "--input", "force=t"], "--input force: expected each name once"),
        (
            ["run", "cart-pole", "--set", "force=1", "--input", "force=t"],
            "input 'force': expected one way of giving it",
        ),
        (
            ["sweep", "cart-pole", "--vary", "cart.x=lin(0,1,2)", "--set", "force=1", "--input", "force=t"],
            "'force': expected one",
        ),
        (["run", "pendulum", *["--option", "method.weight=mass"] * 2], "--option method.weight: expected each name"),
        (
            ["sweep", "pendulum", "--vary", "bob_mass=lin(1,2,2)", "--set", "bob_mass=3"],
            "vary 'bob_mass': expected one",
        ),
        (
            ["sweep", "pendulum", "--vary", "bob.vx=lin(1,2,2)", "--start", "bob.vx=3"],
            "vary 'bob.vx': expected one way",
        ),
    ],
)
def test_nothing_is_given_two_values(words, said, capsys):
    """The last one would be taken in silence."""
    assert main([*words, "--until", "0.1"]) == 2
    assert said in capsys.readouterr().err
