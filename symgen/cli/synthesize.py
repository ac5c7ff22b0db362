"""Find linkages for three positions or a path."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from symgen.base import arguments
from symgen.cli import FAILURE, OK, write_complaint, write_files, write_json
from symgen.cli._shared_options import check_output_file, examples_in_help, json_option

if TYPE_CHECKING:
    from symgen.study.synthesis.synthesizing import Synthesis


@click.command(
    "synthesize",
    epilog=examples_in_help(
        "symgen synthesize positions.csv -o linkage.toml",
        "symgen synthesize path.csv --starts 20 --transmission 40 -o linkage.toml",
    ),
)
@click.argument("task")
@click.option("--starts", type=int, default=6, show_default=True, help="Searches.")
@click.option("--room", type=float, default=1.5, show_default=True, help="Pins are within so many sizes of TASK.")
@click.option("--transmission", type=float, default=30.0, show_default=True, help="Least transmission angle [deg].")
@click.option("--seed", type=int, default=0, show_default=True, help="Of the candidates.")
@click.option("--take", type=int, default=1, show_default=True, help="Which linkage of the list --output writes.")
@click.option("-o", "--output", metavar="FILE", help="Write the linkage to FILE (.toml).")
@json_option
def command(
    task: str, starts: int, room: float, transmission: float, seed: int, take: int, output: str | None, as_json: bool
) -> int:
    """Find four-bar linkages that pass three positions of a body, or a path.

    TASK is a CSV file with the columns x, y and, for three positions, angle: x [mm], angle [deg]. Each linkage has
    moved through TASK in a run of its own.
    """
    path = check_output_file("--output", output)
    if path is not None:
        arguments.toml_file("--output", path)

    from symgen.cli._progress import Bar
    from symgen.study.synthesis.synthesizing import synthesize

    with Bar(f"{task}: linkages", 1.0):
        found = synthesize(task, starts, room, math.radians(transmission), seed)
    if as_json:
        write_json(found.to_json())
    elif found.ok:
        _show(found)
    if found.reason is not None:
        return write_complaint(found.reason, FAILURE)
    shown = None if as_json else lambda file: click.echo(f"written: {file}")
    return write_files(OK, {path: lambda file: found.save(file, take)}, shown)


def _show(found: Synthesis) -> None:
    from symgen.cli._tables import make_console, show_rows

    headings = ("", "linkage", "transmission [deg]", "deviation [m]", "turn [deg]")
    rows = [
        (str(k), x.kind, f"{math.degrees(x.transmission):.4g}", f"{x.deviation:.3g}", f"{math.degrees(x.turn):.4g}")
        for k, x in enumerate(found.linkages, 1)
    ]
    show_rows(make_console(), headings, rows, ("linkage",))
