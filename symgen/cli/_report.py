"""Code shared by the commands that write a report."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

import click

from symgen.base.errors import InputError
from symgen.base.locales import chosen_locale
from symgen.base.plugins import loaded_plugin_files
from symgen.cli import INTERRUPTED, write_complaint
from symgen.cli._shared_options import check_output_file, refuse_same_file, units_option

if TYPE_CHECKING:
    from symgen.api import Model

F = TypeVar("F", bound=Callable[..., Any])

#: Options for places and speed of work, without effect on results.
_WORKING = ("--resume", "--journal", "--jobs")
#: Options that name a file to write.
_WRITTEN = ("--output", "--csv", "--plot")


_PAPER = "a4"
#: The option for the paper of a report, as text.
paper_option = click.option(
    "--paper", metavar="SIZE", default=_PAPER, help="Size of the paper of the report: a4 or letter.  [default: a4]"
)


def paper_of_report(text: str, report: Path | None, option: str) -> str:
    """Return the size of the paper of a report; another one than A4 needs a report.

    Parameters
    ----------
    text : str
        What ``--paper`` names.
    report : Path or None
        The file of the report.
    option : str
        The option that names this file.
    """
    from symgen.study.report.letterhead import paper_of_option

    size = paper_of_option(text)
    if report is None and size != _PAPER:
        raise InputError("--paper", f"{option} FILE, the report that is printed", f"no {option}")
    return size


@dataclass(frozen=True)
class StudyFiles:
    """Files of a study; None: not written.

    Attributes
    ----------
    report, csv, journal : path or None
        Of the report, of the rows as CSV, and of the journal by which an interrupted study goes on.
    units : bool
        Whether the headings of the CSV file carry units.
    paper : str
        Size of the paper of the report.
    """

    report: Path | None
    csv: Path | None
    journal: Path | None
    units: bool
    paper: str


def study_files(row: str) -> Callable[[F], F]:
    """Return a decorator that gives a command the options for the files of a study.

    They arrive as one value, the `StudyFiles` called ``files``, after checking that all can be written.

    Parameters
    ----------
    row : str
        Noun for a row of the study in the help.
    """
    options = (
        click.option(
            *("-o", "--output"),
            metavar="FILE",
            help="Write a report: .html, .md, .pdf by a browser or matplotlib, or .tex, its tables.",
        ),
        paper_option,
        click.option("--csv", metavar="FILE", help=f"Write the {row}s to a CSV file."),
        units_option,
        click.option(
            "--resume",
            "--journal",
            metavar="FILE",
            help=f"Store every finished {row} in FILE, and skip the {row}s that it has.",
        ),
    )

    def decorate(function: F) -> F:
        @wraps(function)
        def command(
            *, output: str | None, paper: str, csv: str | None, units: bool, resume: str | None, **further: object
        ) -> Any:
            rows, report = check_output_file("--csv", csv), _check_report_file(output)
            if rows is not None and rows.suffix.lower() != ".csv":
                raise InputError("--csv", "a file ending in .csv", f"'{csv}'")
            if units and rows is None:
                raise InputError("--units", "--csv FILE, whose headings carry them", "no --csv")
            journal = None if resume is None else Path(resume)
            refuse_same_file({"--resume": journal, "--output": report, "--csv": rows})
            size = paper_of_report(paper, report, "--output")
            return function(files=StudyFiles(report, rows, journal, units, size), **further)

        for option in reversed(options):
            command = option(command)
        return cast("F", command)

    return decorate


def _check_report_file(text: str | None) -> Path | None:
    if text is None:
        return None
    from symgen.study.report.write import check_report

    check_report("--output", Path(text))
    return Path(text)


def command_line_again() -> str:
    """Return the command that makes the report again: this one without options for working files."""
    context = click.get_current_context()
    models = context.params["models"] if "models" in context.params else (context.params["model"],)
    parts = ["symgen", context.info_name or "", *models]
    for parameter in context.command.params:
        value = context.params.get(parameter.name or "")
        flag = max(parameter.opts, key=len)
        left_out = isinstance(parameter, click.Argument) or flag in _WORKING
        if left_out or value in (None, (), {}, False, parameter.default):
            continue
        if value is True:
            parts.append(flag)
            continue
        if isinstance(value, dict):
            value = tuple(f"{name}={str(item).removesuffix('.0')}" for name, item in value.items())
        for item in value if isinstance(value, tuple) else (value,):
            # the folder of the file is private
            parts += [
                flag,
                Path(item).name if flag in _WRITTEN else str(item).removesuffix(".0"),
            ]
    if locale := chosen_locale():
        parts += ["--locale", locale]
    here = Path.cwd()
    for plugin in map(Path, loaded_plugin_files()):  # with its folder only below this one: others are private
        parts += ["--plugin", str(plugin.relative_to(here)) if plugin.is_relative_to(here) else plugin.name]
    return shlex.join(parts)


def sketches_at_start(
    models: Sequence[Model], parameters: Mapping[str, float] | None = None, start: Mapping[str, float] | None = None
) -> dict[str, str]:
    """Return sketches of mechanisms at their starts for the head of a report, by name."""
    from symgen.study.report.picture import MOST_BODIES

    small = [model for model in models if len(model.mechanism.bodies) <= MOST_BODIES]
    return {model.name: model.draw(parameters, start).svg for model in small}


def report_interruption(row: str, stored: bool) -> int:
    """Report an interrupted study and whether a journal keeps its rows; return the exit code."""
    how = "the same command continues after them" if stored else "with --resume FILE they would have been stored"
    return write_complaint(f"interrupted; the {row}s that were done are shown; {how}", INTERRUPTED)
