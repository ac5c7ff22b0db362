"""Write the report of one machine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.base.errors import InputError, quote
from symgen.base.settings import Settings
from symgen.cli import FAILURE, OK, write_complaint, write_files
from symgen.cli._report import command_line_again, paper_option
from symgen.cli._shared_options import (
    examples_in_help,
    numbers_in_si,
    read_assignments,
    read_pairs,
    setting_options,
    write_note,
)

if TYPE_CHECKING:
    from symgen.result.result import Result


@click.command(
    "report",
    epilog=examples_in_help(
        "symgen report four-bar -o four-bar.html",
        "symgen report driven-four-bar --over crank.theta -o motor.html",
        "symgen report driven-four-bar --vary crank_speed=3,6,9 -o speeds.pdf",
    ),
)
@click.argument("model")
@setting_options(
    *("method", "integrator", "step", "rtol", "atol", "until", "output_step", "parameters", "inputs", "start"),
    *("options", "coordinates"),
)
@click.option(
    "--vary",
    metavar="NAME=A,B,...",
    help="One report of several values of a parameter: verdicts, numbers, limits and curves side by side.",
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
    vary: str | None,
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
    from symgen.study.report.variants_report import variants_report
    from symgen.study.report.write import check_report, write

    settings, letterhead = Settings(**values), letterhead_of_options(number, logo, sign, paper)
    loaded = load(model)
    path = Path(output or f"{loaded.name}.html")
    check_report("--output", path)
    player = None if page is None else page_file_beside(path, page)
    varied, variants = ("", ({},)) if vary is None else parameters_of_variants(model, vary)
    if varied and page is not None:
        raise InputError("--page", "the page of one run", "several, by --vary")
    results: list[Result] = []
    for own in variants:
        each = replace(settings, parameters={**settings.parameters, **own})
        with Bar(loaded.name, settings.until or loaded.mechanism.defaults.until) as bar:
            results.append(loaded.simulate(each, progress=bar))
    result, again = results[0], command_line_again()
    write_note(dict.fromkeys(x for r in results for x in (*r.notes, *(f"warning: {w}" for w in r.warnings))))
    if varied:
        document = variants_report(loaded, results, varied, again, over, letterhead)
    else:
        document = machine_report(loaded, result, again, over, player.name if player else "", letterhead)
    code = OK
    for failed in (r for r in results if r.status == "failed"):
        value = f"{varied} = {failed.parameters[varied]:g}, " if varied else ""
        code = write_complaint(f"{value}failed: {failed.reason}", FAILURE)
    by = f", {printer_in_words()}" if path.suffix.lower() == ".pdf" else ""
    files: dict[Path | None, Callable[[Path], object]] = {path: lambda file: write(document, file)}
    if player is not None:
        files[player] = result.view().save
    return write_files(code, files, lambda file: click.echo(f"written: {file}{by if file == path else ''}"))


def parameters_of_variants(model: str, text: str) -> tuple[str, list[dict[str, float]]]:
    """Return the parameter of ``--vary NAME=A,B,...``, and each of its values by that name [SI].

    Raises
    ------
    InputError
        If the word has another form, there are not two to eight different values, or a value is no number of a unit
        of the parameter.
    """
    from symgen.study.report.variants_report import MOST_VARIANTS

    ((name, values),) = read_pairs("--vary", [text], "NAME=VALUE,VALUE").items()
    if "(" in values or ";" in values:
        listed = values.replace(";", ",")
        hint = "symgen sweep takes ranges" if "(" in values else f"did you mean {name}={listed}?"
        raise InputError("--vary", "NAME=VALUE,VALUE", quote(text), hint)
    texts = [*dict.fromkeys(values.split(","))]
    if not 2 <= len(texts) <= MOST_VARIANTS:
        expected = f"two to {MOST_VARIANTS} different values with commas between them"
        raise InputError("--vary", expected, quote(values), "symgen sweep takes ranges and many values")
    typed = [read_assignments("--vary", [f"{name}={value}"]) for value in texts]
    return name, [numbers_in_si("--vary", each, (model,)) for each in typed]


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
