"""Find dimensions by an aim, within limits."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.base import arguments
from symgen.base.errors import InputError, quote
from symgen.base.settings import Settings
from symgen.base.units import read_amount
from symgen.cli import FAILURE, INTERRUPTED, OK, write_complaint, write_files, write_json
from symgen.cli._report import command_line_again, paper_of_report, paper_option
from symgen.cli._shared_options import (
    check_output_file,
    examples_in_help,
    json_option,
    numbers_in_si,
    read_pairs,
    refuse_same_file,
    setting_options,
    write_note,
)

if TYPE_CHECKING:
    from symgen.study.design.found import Design


@click.command(
    "design",
    epilog=examples_in_help(
        'symgen design jansen-leg --vary b=0.40:0.43 --vary c=0.38:0.41 --aim "peak(motor.effort)"',
        'symgen design press.toml --vary a=0.2:0.4 --aim "peak(motor.effort)" --keep "min(ram.y) <= -598 mm"',
    ),
)
@click.argument("model")
@click.option(
    "--vary",
    "varied",
    multiple=True,
    required=True,
    metavar="NAME=LOW:HIGH",
    help="A number that varies, with its bounds: a parameter, the place of a pin such as A.x, or the path of a number "
    "such as bodies.crank.mass.",
)
@click.option(
    "--aim",
    required=True,
    metavar="AIM",
    help="What becomes best: peak(Q), rms(Q) or max(Q) small, min(Q) large; Q at the end; or a file of columns over t.",
)
@click.option(
    "--keep",
    multiple=True,
    metavar="LIMIT",
    help="A limit beside those of MODEL: min(ram.y) <= -598 mm, or -0.75 <= mu <= 0.75, which holds at every time.",
)
@click.option("--starts", type=int, default=1, show_default=True, help="Searches: from MODEL, and from candidates.")
@click.option("--seed", type=int, default=0, show_default=True, help="Of the candidates.")
@setting_options(
    *("until", "parameters", "inputs", "start", "method", "integrator", "rtol", "atol", "options", "coordinates"),
)
@click.option("-o", "--output", metavar="FILE", help="Write MODEL with the new numbers to FILE (.toml).")
@click.option("--report", metavar="FILE", help="Write a report before and after: .html, .md, .pdf or .tex.")
@paper_option
@json_option
def command(
    model: str,
    varied: tuple[str, ...],
    aim: str,
    keep: tuple[str, ...],
    starts: int,
    seed: int,
    output: str | None,
    report: str | None,
    paper: str,
    as_json: bool,
    **values: Any,
) -> int:
    """Find numbers of MODEL, within bounds and limits, with which an aim is smallest.

    MODEL has limits, smallest and largest, and --keep adds more. The answer keeps all of them, or the command
    says which ones contradict each other.
    """
    bounds, settings = _bounds_by_name(varied, model), Settings(**values)
    path, report_path = check_output_file("--output", output), check_output_file("--report", report)
    if path is not None:
        arguments.toml_file("--output", path)
    refuse_same_file({"--output": path, "--report": report_path})
    if report_path is not None:
        from symgen.study.report.write import check_report

        check_report("--report", report_path)
    size = paper_of_report(paper, report_path, "--report")

    from symgen import load
    from symgen.cli._progress import Bar
    from symgen.study.design.designing import design

    loaded = load(model)
    with Bar(f"{loaded.name}, {aim}", float(max(starts, 1))) as bar:
        found = design(loaded, bounds, aim, keep, starts, seed, settings, lambda done, of: bar(float(done)))
    write_note(found.notes)
    if as_json:
        write_json(found.to_json())
    else:
        _show(found)
    code = OK
    if found.reason is not None:
        code = write_complaint(found.reason, INTERRUPTED if found.interrupted else FAILURE)
    again = command_line_again()
    files: dict[Path | None, Callable[[Path], object]] = {path if _is_usable(found) else None: found.save}
    files[report_path] = lambda file: _write_report(found, file, again, size)
    return write_files(code, files, None if as_json else lambda file: click.echo(f"written: {file}"))


def _is_usable(found: Design) -> bool:
    """Whether the numbers keep all limits, so that they are worth a file."""
    return all(limit.is_met for limit in found.limits)


def _write_report(found: Design, path: Path, again: str, paper: str) -> None:
    from symgen.study.design.design_report import design_report
    from symgen.study.report.letterhead import put_on_paper
    from symgen.study.report.write import write

    write(put_on_paper(design_report(found, again), paper), path)


def _bounds_by_name(words: tuple[str, ...], model: str) -> Mapping[str, tuple[float, float]]:
    """Return the bounds by name in SI units; as typed, bounds of parameters are in the unit of the file."""
    from symgen.describe.facts.typed_units import Typed

    form = "NAME=LOW:HIGH, such as a=0.2:0.4"
    ends: tuple[dict[str, float], dict[str, float]] = {}, {}
    for name, text in read_pairs("--vary", words, form).items():
        pair = text.split(":")
        if len(pair) != 2:
            raise InputError(f"--vary {name}", "LOW:HIGH, such as 0.2:0.4", quote(text))
        for side, word in zip(ends, pair, strict=True):
            amount = read_amount(word.strip())
            if amount is None or not math.isfinite(amount.number):
                raise InputError(f"--vary {name}", "two finite numbers, such as 0.2:0.4", quote(text))
            side[name] = Typed.from_amount(amount)
    low, high = (numbers_in_si("--vary", side, (model,)) for side in ends)
    return {name: (float(low[name]), float(high[name])) for name in low}


def _show(found: Design) -> None:
    from symgen.cli._tables import make_console, show_rows
    from symgen.study.design import tables

    click.echo(tables.sentence_of_aim(found))
    out = make_console()
    shown = [tables.table_of_values(found)]
    shown += [tables.table_of_limits(found)] if found.limits else []
    shown += [tables.table_of_starts(found)] if len(found.starts) > 1 else []
    shown += [tables.table_of_failures(found)] if found.failed else []
    for table in shown:
        show_rows(out, table.headings, table.rows, table.left)
