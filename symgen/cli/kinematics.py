"""``symgen kinematics MODEL``: positions, velocities, accelerations and reactions of a driven mechanism."""

from __future__ import annotations

from typing import Any

import click

from symgen.cli import FAILURE, OK, complain, write_files, write_json
from symgen.cli._analyses import motion_options, table_options
from symgen.cli._options import differ, examples, json_option, output_file, tell, time_list
from symgen.settings import Settings


@click.command(
    "kinematics",
    short_help="Move a driven mechanism without integrating.",
    epilog=examples(
        'symgen kinematics driven-four-bar --times "lin(0,1,101)"',
        "symgen kinematics driven-four-bar --transmission C --plot motion.svg",
    ),
)
@click.argument("model")
@click.option(
    "--times",
    metavar="TIMES",
    help="When [s]: lin(0, 1, 101) or 0,0.25,0.5.  [default: outputs of a run of MODEL]",
)
@click.option(
    *("--transmission", "pins"),
    multiple=True,
    metavar="PIN",
    help="A pin whose transmission angle is wanted; C(B, D) where its bodies have several further joints.",
)
@motion_options(start="Value of a coordinate: of several ways to close MODEL the nearest is taken.")
@table_options("What to show, save and plot: a column, a body, a joint or a table, such as points.", "quantities")
@click.option("--curves", metavar="FILE", help="Draw the paths of points into FILE: .png, .svg or .pdf.")
@json_option
def command(
    model: str,
    times: str | None,
    pins: tuple[str, ...],
    quantities: tuple[str, ...],
    save: str | None,
    plot: str | None,
    curves: str | None,
    as_json: bool,
    **asked: Any,
) -> int:
    """Move MODEL, whose freedom is all driven, through any times without integrating.

    For example: symgen kinematics driven-four-bar --times "lin(0, 1, 361)" --transmission C --save motion.csv
    """
    settings = Settings(**asked)
    chosen = None if times is None else time_list("--times", times)
    save_path = output_file("--save", save, "tables")
    plot_path, curve_path = output_file("--plot", plot, "plot"), output_file("--curves", curves, "plot")
    differ({"--plot": plot_path, "--curves": curve_path})

    from symgen.api import load
    from symgen.result.select import extremes

    result = load(model).kinematics(chosen, settings, pins)
    tell(result.notes)
    shown = extremes(result.select(quantities or ("q",))) if len(result.t) else {}
    if as_json:
        write_json(result.to_json() | ({"quantities": shown} if quantities else {}))
    else:
        from symgen.cli._tables import show_quantities

        click.echo(f"{result.mechanism}: {len(result.t)} times, {result.steps} steps")
        show_quantities(shown)
    code = complain(result.ended, FAILURE) if result.ended else OK
    files: dict[Any, Any] = {
        save_path: lambda path: result.save(path, quantities),
        plot_path: lambda path: result.plot(path, quantities),
        curve_path: lambda path: result.plot_curves(path),
    }
    return write_files(code, files, None if as_json else lambda path: click.echo(f"written: {path}"))
