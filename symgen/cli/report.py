"""Write the report of one machine."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from symgen.base.errors import InputError, quote
from symgen.base.settings import Settings
from symgen.cli import FAILURE, OK, write_complaint, write_files
from symgen.cli._report import command_line_again, paper_option
from symgen.cli._shared_options import examples_in_help, setting_options, write_note


@click.command(
    "report",
    epilog=examples_in_help(
        "symgen report four-bar -o four-bar.html", "symgen report driven-four-bar --over crank.theta -o motor.html"
    ),
)
@click.argument("model")
@setting_options(
    *("method", "integrator", "step", "rtol", "atol", "until", "output_step", "parameters", "inputs", "start"),
    *("options", "coordinates"),
)
@click.option("--over", metavar="NAME", default="t", help="Draw curves over NAME, such as crank.theta.  [default: t]")
@paper_option
@click.option("--number", metavar="TEXT", default="", help="Number of the report, below its title.")
@click.option("--logo", metavar="FILE", help="A mark at the top right: a picture, PNG or SVG.")
@click.option(
    "--sign",
    metavar="WHO",
    multiple=True,
    help="A page that WHO signs, such as Customer; several times for several.",
)
@click.option(
    "-o", "--output", metavar="FILE", help="The report: .html, .md, or .pdf by a browser or matplotlib.  [MODEL.html]"
)
@click.option(
    "--page", metavar="FILE", help="A page that plays the motion (.html), beside the report, which links to it."
)
def command(
    model: str,
    over: str,
    paper: str,
    number: str,
    logo: str | None,
    sign: tuple[str, ...],
    output: str | None,
    page: str | None,
    **values: Any,
) -> int:
    """Write one document of MODEL: drawing, motion, largest loads with their times, curves, frequencies at rest.

    It ends with how far the run can be trusted and the command that makes it again.
    """
    from symgen.api import load
    from symgen.cli._progress import Bar
    from symgen.study.report.browser_pdf import printer_in_words
    from symgen.study.report.letterhead import letterhead_of_options
    from symgen.study.report.machine_report import machine_report
    from symgen.study.report.write import check_report, write

    settings, letterhead = Settings(**values), letterhead_of_options(number, logo, sign, paper)
    loaded = load(model)
    path = Path(output or f"{loaded.name}.html")
    check_report("--output", path)
    player = None if page is None else page_file_beside(path, page)
    with Bar(loaded.name, settings.until or loaded.mechanism.defaults.until) as bar:
        result = loaded.simulate(settings, progress=bar)
    write_note((*result.notes, *(f"warning: {w}" for w in result.warnings)))
    document = machine_report(loaded, result, command_line_again(), over, player.name if player else "", letterhead)
    code = write_complaint(f"failed: {result.reason}", FAILURE) if result.status == "failed" else OK
    by = f", {printer_in_words()}" if path.suffix.lower() == ".pdf" else ""
    files: dict[Path | None, Callable[[Path], object]] = {path: lambda file: write(document, file)}
    if player is not None:
        files[player] = result.view().save
    return write_files(code, files, lambda file: click.echo(f"written: {file}{by if file == path else ''}"))


def page_file_beside(report: Path, page: str) -> Path:
    """Return the file of ``--page``, which is in the folder of the report, so that both can be moved together.

    Raises
    ------
    InputError
        If it is elsewhere, is no page, or is the report itself.
    """
    path = Path(page)
    if path.suffix.lower() != ".html" or path.name == report.name:
        raise InputError("--page", "another file than the report that ends in .html", quote(page))
    if path.parent.resolve() != report.parent.resolve():
        raise InputError("--page", f"a file in the folder of the report, '{report.parent}'", quote(page))
    return path
