"""Write the report of one machine."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from symgen.base.settings import Settings
from symgen.cli import FAILURE, OK, complain, write_files
from symgen.cli._options import examples, setting_options, tell
from symgen.cli._report import command_again


@click.command(
    "report",
    epilog=examples(
        "symgen report four-bar -o four-bar.html", "symgen report driven-four-bar --over crank.theta -o motor.html"
    ),
)
@click.argument("model")
@setting_options(
    *("method", "integrator", "step", "rtol", "atol", "until", "output_step", "parameters", "inputs", "start"),
    *("options", "coordinates"),
)
@click.option("--over", metavar="NAME", default="t", help="Draw curves over NAME, such as crank.theta.  [default: t]")
@click.option(
    "-o", "--output", metavar="FILE", help="The report: .html, .md, or .pdf by a browser or matplotlib.  [MODEL.html]"
)
def command(model: str, over: str, output: str | None, **values: Any) -> int:
    """Write one document of MODEL: drawing, motion, largest loads with their times, curves, frequencies at rest.

    It ends with how far the run can be trusted and the command that makes it again.
    """
    from symgen.api import load
    from symgen.cli._progress import Bar
    from symgen.study.report.machine import machine
    from symgen.study.report.paper import printer
    from symgen.study.report.write import check_report, write

    settings = Settings(**values)
    loaded = load(model)
    path = Path(output or f"{loaded.name}.html")
    check_report("--output", path)
    with Bar(loaded.name, settings.until or loaded.mechanism.defaults.until) as bar:
        result = loaded.simulate(settings, progress=bar)
    tell((*result.notes, *(f"warning: {w}" for w in result.warnings)))
    document = machine(loaded, result, command_again(), over)
    code = complain(f"failed: {result.reason}", FAILURE) if result.status == "failed" else OK
    by = f", {printer()}" if path.suffix.lower() == ".pdf" else ""
    return write_files(
        code, {path: lambda file: write(document, file)}, lambda file: click.echo(f"written: {file}{by}")
    )
