"""One table of settings: what commands, Python and the pages say of them is what it says."""

import inspect
import re
from dataclasses import fields
from pathlib import Path

import click
import pytest

import symgen
from symgen.base import settings
from symgen.base.errors import InputError
from symgen.cli import group, main
from symgen.cli.generate import command as generate
from symgen.run.loops.run_spec import RunSpec
from symgen.study.stress.study import stress as stress_study

PAGES = Path(__file__).resolve().parents[2] / "docs"
COMMANDS = {name: group.get_command(click.Context(group), name) for name in ("run", "compare", "stress", "sweep")}
#: Settings of runs that look for events.
EVENTS = ("stop_when", "record_when", "events")
#: Settings that a command goes without, since it has a list of them, or no use for them.
WITHOUT = {
    "run": {"times", "events"},
    "compare": {
        *("method", "integrator", "step", "rtol", "atol", "times", "strict", "verify", "inputs", "coordinates"),
        *EVENTS,
    },
    "stress": {*settings.setting_names()}
    - {"max_violation", "max_energy_error", "max_step", "max_attempts", "coordinates"},
    "sweep": {"verify", "repeat", "shape", "events"},
}
#: Defaults of commands that are not those of a single run.
OTHER = {("compare", "repeat"): 5}


def options(command):
    return {p.name: p for p in command.params if isinstance(p, click.Option)}


def sections():
    """Return the text of each section of the page, with the commands that its heading names."""
    page = (PAGES / "command-line.md").read_text(encoding="utf-8")
    for part in page.split("\n## ")[1:]:
        heading, _, text = part.partition("\n")
        if names := re.findall(r"`([a-z]+)`", heading):
            yield names, text


def helped(name):
    """Return what help says of the options of a command, in one line each."""
    command = COMMANDS[name]
    records = [p.get_help_record(click.Context(command)) for p in command.params if isinstance(p, click.Option)]
    return {flag: said for flags, said in filter(None, records) for flag in re.findall(r"--[\w-]+", flags)}


@pytest.mark.parametrize("name", COMMANDS)
def test_every_setting_is_an_option_of_every_command_that_runs(name):
    found = options(COMMANDS[name])
    assert {n for n in settings.setting_names() if n not in found} == WITHOUT[name]
    for setting in set(settings.setting_names()) - WITHOUT[name]:
        option = found[setting]
        assert settings.command_flag(setting) in option.opts
        if settings.setting_description(setting).kind is not dict:
            usual = OTHER.get((name, setting), settings.default_of_setting(setting))
            assert option.get_default(click.Context(COMMANDS[name])) == usual or usual is False
        assert option.help and option.help[0].isupper() and option.help.endswith(".")
        unit = settings.setting_description(setting).unit
        assert not unit or f"[{unit}]" in option.help


@pytest.mark.parametrize(("names", "text"), tuple(sections()), ids=lambda x: "-".join(x) if isinstance(x, list) else "")
def test_options_that_the_page_names_are_those_of_its_commands(names, text):
    commands = [group.get_command(click.Context(group), name) for name in (*names, "run")]
    flags = {
        flag for command in commands for option in command.params for flag in (*option.opts, *option.secondary_opts)
    }
    assert not set(re.findall(r"(?<![\w-])--[a-z][\w-]*", text)) - flags - {"--help", "--version"}


def test_defaults_in_help_are_those_of_the_table():
    for setting in set(settings.setting_names()) - WITHOUT["run"]:
        about, usual = settings.setting_description(setting), settings.default_of_setting(setting)
        found = re.search(r"\[default: (.*)\]", helped("run")[settings.command_flag(setting)])
        if isinstance(usual, str | int | float) and not isinstance(usual, bool):
            assert found, setting
            assert found[1] == str(usual), setting
        elif about.otherwise and about.kind is float:
            assert found, setting
            assert about.otherwise in found[1], setting


def test_tolerances_that_the_table_names_are_those_of_a_run():
    spec = inspect.signature(RunSpec).parameters
    for name in ("rtol", "atol"):
        assert float(settings.setting_description(name).otherwise) == spec[name].default
    for name in ("max_violation", "max_energy_error"):
        assert settings.default_of_setting(name) == spec[name].default


def test_python_says_every_setting():
    text = inspect.getdoc(symgen.Model.simulate)
    page = (PAGES / "python.md").read_text(encoding="utf-8")
    for name in settings.setting_names():
        assert f"\n{name} : " in text and f"`{name}`" in page, name
        assert settings.setting_description(name).help in text, name
    assert settings.setting_names() == tuple(f.name for f in fields(symgen.Settings))


def test_generate_has_the_options_of_the_table():
    assert options(generate)["options"].opts == ["--option"]


@pytest.mark.slow_cases("--max-violation-max_violation")
@pytest.mark.parametrize(("limit", "reason"), [("--max-violation", "max_violation"), ("--max-energy-error", "energy")])
def test_limits_can_be_set_for_a_run(capsys, limit, reason):
    words = [
        "run",
        "four-bar",
        "--method",
        "lagrange",
        "--integrator",
        "rk4",
        "--step",
        "0.01",
        "--until",
        "1",
        "--json",
    ]
    assert main(words) == 0
    assert main([*words, limit, "1e-13"]) == 1
    assert reason in capsys.readouterr().err
    assert main([*words, limit, "0"]) == 2
    assert f"{limit}: expected a finite number above 0, got 0" in capsys.readouterr().err


@pytest.mark.slow_cases("max_violation", "max_energy_error")
@pytest.mark.parametrize("limit", ["max_violation", "max_energy_error"])
def test_limits_can_be_set_for_studies_and_sweeps(limit):
    found = symgen.compare("four-bar", "lagrange", "rk4", 1e-2, until=1.0, repeat=1, **{limit: 1e-13})
    assert found.rows[0].status == "failed" and ("max_violation" in found.rows[0].reason) == (limit == "max_violation")
    constant = {"method": "lagrange", "integrator": "rk4", "step": 1e-2}
    many = symgen.sweep("four-bar", {"crank_mass": [1.0]}, **constant, until=1.0, **{limit: 1e-13})
    assert many.counts["failed"] == 1
    with pytest.raises(InputError, match=f"{limit}: expected a finite number above 0"):
        symgen.compare("four-bar", "lagrange", "rk4", 1e-2, until=1.0, repeat=1, **{limit: -1.0})


@pytest.mark.slow
def test_steps_are_bounded_by_every_command_that_runs(capsys):
    for words in (
        ["run", "four-bar", "--integrator", "dopri5"],
        ["sweep", "four-bar", "--vary", "crank_mass=values(1)", "--integrator", "dopri5"],
        ["compare", "four-bar", "--methods", "lagrange", "--integrators", "dopri5", "--rtols", "1e-6", "--repeat", "1"],
    ):
        assert main([*words, "--until", "1", "--max-attempts", "5"]) == 1, words
        said = capsys.readouterr()
        assert "max_attempts" in said.out + said.err, words
    assert (
        main(["run", "four-bar", "--integrator", "rk4", "--step", "0.01", "--until", "1", "--max-attempts", "5"]) == 2
    )
    assert "step: expected at most max_attempts = 5 steps, got 100" in capsys.readouterr().err


@pytest.mark.slow
def test_adaptive_steps_are_no_longer_than_max_step(tmp_path):
    """By a setting, by the file; constant steps are what they were."""
    text = '[mechanism]\nname = "free"\n[run]\nuntil = 2.0\nmax_step = 0.05\n'
    text += '[bodies.a]\ntype = "point"\nmass = 1.0\nposition = [0.0, 0.0]\nvelocity = [0.1, 0.0]\n'
    (tmp_path / "free.toml").write_text(text, encoding="utf-8")
    free, asked = symgen.load(tmp_path / "free.toml"), {"method": "lagrange", "times": [2.0]}
    assert symgen.load("pendulum").mechanism.defaults.max_step is None
    for scheme in ("dop853", "dopri5", "picard", "abm", "radau5", "sdirk"):
        steps = [free.simulate(integrator=scheme, **asked, **more).steps for more in ({}, {"max_step": 0.01})]
        assert 40 <= steps[0] < 60 and 200 <= steps[1] < 260, scheme
    run = free.start(method="lagrange", integrator="dop853", max_step=0.01)
    run.run(2.0)
    assert run.steps >= 200
    many = symgen.sweep(free, {"a.vx": [0.1, 0.2]}, method="lagrange", integrator="dop853", max_step=0.01)
    assert many["steps"].min() >= 200
    rows = symgen.compare(free, "lagrange", "dopri5", rtols=[1e-6], repeat=1, max_step=0.01).rows
    assert rows[0].evaluations >= 1200
    swinging = symgen.compare("pendulum", "lagrange", "dopri5", rtols=[1e-6], until=0.5, repeat=1, max_step=0.01)
    assert "Jacobi" in swinging.how  # a formula is what it was
    assert free.simulate(method="lagrange", integrator="rk4", step=0.1, max_step=0.01).steps == 20
    with pytest.raises(InputError, match="max_step: expected a finite number above 0"):
        free.simulate(max_step=0.0)


def test_the_old_name_of_attempts_is_refused(capsys):
    assert main(["run", "pendulum", "--max-steps", "5"]) == 2
    assert "--max-step" in capsys.readouterr().err
    with pytest.raises(InputError, match="max_step"):
        symgen.load("pendulum").simulate(max_steps=5)


def test_cases_of_stress_studies_have_the_largest_step(monkeypatch):
    from symgen.study.stress import study

    seen = []
    monkeypatch.setattr(study, "run_cells", lambda cells, *_: (seen.extend(cells), ({}, True))[1])
    stress_study(["pendulum"], ["gravity"], ["lagrange"], quick=True, max_step=0.01)
    assert seen and all(cell.task.level.mechanism.defaults.max_step == 0.01 for cell in seen)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_steps_are_bounded_in_stress_studies():
    found = stress_study(["pendulum"], ["gravity"], ["lagrange"], quick=True, max_attempts=5.0)
    assert found.rows and all(row.outcome == "refused" and "max_attempts" in row.reason for row in found.rows)


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
