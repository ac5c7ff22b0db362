"""What a terminal of 80 characters shows: whole numbers and names; and examples in every help."""

import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import click
import numpy as np
import pytest
from rich.console import Console

from symgen.api import load
from symgen.cli import COMMANDS, _comparison_tables, _tables, group, main
from symgen.cli import list as list_command
from symgen.study.comparison.comparison_rows import Row
from symgen.study.comparison.comparison_study import Study


@pytest.fixture
def narrow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make standard output a terminal of 80 characters."""
    for module in (_tables, _comparison_tables):
        monkeypatch.setattr(
            module,
            "make_console",
            lambda: Console(width=80, force_terminal=True, color_system=None, markup=False, highlight=False),
        )


def study() -> Study:
    rows = tuple(
        Row(
            *(method, integrator, 1.25e-3, None, "ok", None, 1.23456e-10 * k, False, 0.0123456 * k, 0.1, 123456789),
            *(1.234e-11, 2.345e-12, 3.456e-13),
        )
        for k, (method, integrator) in enumerate(
            [("lagrange", "rk4"), ("index1-augmented-lagrangian", "generalized-alpha"), ("udwadia-kalaba", "dop853")], 1
        )
    )
    return Study("four-bar", "a reference", 1e-12, 5.0, rows)


def test_a_comparison_has_whole_numbers(narrow: None, capsys: pytest.CaptureFixture[str]) -> None:
    _comparison_tables.show_study(study())
    lines = capsys.readouterr().out.splitlines()
    assert all(len(line) <= 80 for line in lines) and not any("…" in line for line in lines)
    text = "\n".join(lines)
    for k in (1, 2, 3):
        assert f"{1.23456e-10 * k:.2e}" in text and f"{12.3456 * k:.3f}" in text
    assert "index1-augmented-lagrangian" in text and "generalized-alpha" in text
    assert "left out for want of room" in text


def test_a_wide_terminal_has_all_columns(capsys: pytest.CaptureFixture[str]) -> None:
    _comparison_tables.show_study(study())
    text = capsys.readouterr().out
    assert "left out" not in text and "123456789" in text and "3.5e-13" in text


@pytest.mark.slow
def test_the_largest_values_of_a_mechanism_are_whole(narrow: None, capsys: pytest.CaptureFixture[str]) -> None:
    result = load("bricard").simulate(until=0.01, step=1e-3)
    _tables.show_result(result)
    text = capsys.readouterr().out
    assert all(len(line) <= 80 for line in text.splitlines())
    for name in ("P1.F", "P4.T"):
        shown = f"{float(np.max(result[name])):.6g}"
        assert re.search(rf"^{re.escape(name)} .*\s{re.escape(shown)}\s", text, re.M), name


def test_names_of_the_list_are_whole(narrow: None, capsys: pytest.CaptureFixture[str]) -> None:
    from symgen.describe import catalogue

    assert main(["list"]) == 0
    words = capsys.readouterr().out.split()
    for entry in (*catalogue.entries(), *catalogue.entries(catalogue.MACHINES)):
        assert entry.name in words or any(word.startswith(f"{entry.name}:") for word in words)
    assert list_command.WIDE > 80


@pytest.mark.parametrize("in_parts", [True, False])
def test_a_wide_table_comes_in_parts_or_names_what_is_left_out(
    in_parts: bool, narrow: None, capsys: pytest.CaptureFixture[str]
) -> None:
    headings, cells = [f"c{k}" for k in range(5)], ["x" * 20] * 5
    _tables.show_rows(_tables.make_console(), headings, [cells], in_parts=in_parts)
    text = capsys.readouterr().out
    shown = [line.split() for line in text.splitlines() if line.lstrip().startswith("c")]
    assert shown == ([["c0", "c1", "c2"], ["c0", "c3", "c4"]] if in_parts else [["c0", "c1", "c2"]])
    assert ("left out for want of room: c3, c4" in text) != in_parts


def commands(command: click.Command, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], click.Command]]:
    yield path, command
    if isinstance(command, click.Group):
        context = click.Context(command)
        for name in command.list_commands(context):
            inner = command.get_command(context, name)
            assert inner is not None
            yield from commands(inner, (*path, name))


def test_every_help_has_examples_that_can_be_typed() -> None:
    found = dict(commands(group))
    assert len(found) > len(COMMANDS)
    for path, command in found.items():
        text = command.get_help(click.Context(command, info_name="symgen"))
        examples = re.findall(r"^ +(symgen .*)$", text.partition("Examples:")[2], re.M)
        assert examples, path
        for line in (part.strip() for example in examples for part in re.split(r"&&|>+", example)):
            words = shlex.split(line)
            if words[0] == "symgen":
                check(found, words[1:])


def check(found: dict[tuple[str, ...], click.Command], words: list[str]) -> None:
    """Words are a command, its arguments and options that it has."""
    path = tuple(words[:2]) if tuple(words[:2]) in found else tuple(words[:1])
    command: Any = found[path]
    flags = {flag for parameter in command.params for flag in (*parameter.opts, *parameter.secondary_opts)}
    given = [word for word in words if word.startswith("-")]
    assert all(word in flags for word in given), words
    for word in words[len(path) :]:
        if word in ("four-bar", "slider-crank", "pendulum"):
            load(word)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "closing"),
    [("generate pendulum --method lagrange -o emitted", "| head -c 5"), ("list", ">&-"), ("list", ">&- 2>&-")],
)
def test_whoever_reads_nothing_is_no_failure(words, closing, tmp_path):
    """`generate` writes line by line: a pipe that is closed early is met by a write, not by the last flush."""
    script = "import sys; from symgen.cli import main; sys.exit(main())"
    command = f'set -o pipefail; "{sys.executable}" -c "{script}" {words} {closing}'
    done = subprocess.run(
        ["bash", "-c", command], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_chosen_quantities_take_the_place_of_the_first_ones(cli) -> None:
    """One table, with the times of extremes and the last value; the second one had neither."""
    code, out, _ = cli(
        "run", "pendulum", "--until", "0.5", "--integrator", "rk4", "--step", "0.01", "--quantity", "bob.x"
    )
    assert code == 0
    (heading,) = (line for line in out.splitlines() if line.startswith("quantity"))
    assert heading.split("  ")[0] == "quantity" and heading.rstrip().endswith("at the end  unit")
    assert [line.split()[0] for line in out[out.index(heading) :].splitlines()[1:]] == ["bob.x"]


def test_transmission_angles_have_their_row(cli) -> None:
    code, out, _ = cli("kinematics", "driven-four-bar", "--times", "lin(0, 1, 5)", "--transmission", "C")
    assert code == 0
    row = next(line.split() for line in out.splitlines() if line.startswith("transmission.C"))
    angle = load("driven-four-bar").kinematics(np.linspace(0.0, 1.0, 5), transmission=("C",)).transmission.values[:, 0]
    assert [float(x) for x in row[1:4]] == pytest.approx([angle[-1], angle.min(), angle.max()], rel=1e-5)
    assert row[-1] == "rad"
