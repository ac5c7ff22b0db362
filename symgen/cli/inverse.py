"""``symgen inverse MODEL``: the efforts that a motion needs."""

from __future__ import annotations

from typing import Any

import click

from symgen.cli import FAILURE, OK, complain, write_files, write_json
from symgen.cli._analyses import motion_options, table_options
from symgen.cli._options import assignments, examples, json_option, output_file, tell, time_list, words
from symgen.errors import InputError
from symgen.settings import Settings, flag, is_given


@click.command(
    "inverse",
    short_help="Find the efforts that a motion needs.",
    epilog=examples("symgen inverse driven-four-bar", 'symgen inverse driven-four-bar --times "lin(0,1,101)" --json'),
)
@click.argument("model")
@click.option(
    "--from",
    "whence",
    metavar="FILE",
    help="A recorded motion: .nc, .parquet or .csv that a result was saved to.  [default: what the drivers prescribe]",
)
@click.option(
    "--times",
    metavar="TIMES",
    help="When, of drivers' motion [s]: lin(0, 1, 101) or 0,0.25,0.5.  [default: outputs of a run of MODEL]",
)
@click.option(
    "--actuators",
    metavar="NAME,...",
    help="What exerts the motion: drivers, joints, forces, inputs.  [default: all drivers]",
)
@click.option(
    "--weight",
    "weights",
    multiple=True,
    metavar="NAME=VALUE",
    help="Weight of an actuator where efforts are not unique: the sum of (weight effort)^2 is smallest.",
)
@motion_options(start="Of drivers' motion: of several ways to close MODEL that nearest to this coordinate is taken.")
@table_options(
    shown="What to save and plot beside efforts: a column, a joint or a table, such as power or reactions.",
    drawn="efforts and power",
)
@json_option
def command(
    model: str,
    whence: str | None,
    times: str | None,
    actuators: str | None,
    weights: tuple[str, ...],
    quantities: tuple[str, ...],
    save: str | None,
    plot: str | None,
    as_json: bool,
    **asked: Any,
) -> int:
    """Find the efforts that a motion of MODEL needs: motor torques, forces of actuators.

    For example: symgen inverse driven-four-bar --times "lin(0, 1, 361)" --plot torque.svg, or of a recorded run:
    symgen inverse andrews --from run.nc --actuators drive
    """
    settings = Settings(**asked)
    if whence is not None:
        from symgen.analyses.model import OF_DRIVEN

        for name in OF_DRIVEN:
            if is_given(settings, name):
                raise InputError(flag(name), "settings of a recorded motion", "one of drivers' motion")
    chosen = None if times is None else time_list("--times", times)
    named, weighed = words("--actuators", actuators), assignments("--weight", weights)
    save_path, plot_path = output_file("--save", save, "tables"), output_file("--plot", plot, "plot")
    if quantities and save_path is None and plot_path is None:
        raise InputError("--quantity", "--save or --plot, where quantities go", "neither")

    from symgen.api import load

    result = load(model).inverse(whence, settings, chosen, named, weighed)
    result.select(quantities)  # names that are wrong are told before anything is shown
    tell(result.notes)
    if as_json:
        write_json(result.to_json())
    else:
        from symgen.cli._tables import show_summary

        click.echo(f"{result.mechanism}: efforts at {len(result.t)} times")
        show_summary(result.summary())
        if few := result.too_few():
            click.echo(f"symgen: {few}", err=True)
    code = complain(result.ended, FAILURE) if result.ended else OK
    files: dict[Any, Any] = {
        save_path: lambda path: result.save(path, ("efforts", *quantities) if quantities else ()),
        plot_path: lambda path: result.plot(path, ("efforts", "power", *quantities)),
    }
    return write_files(code, files, None if as_json else lambda path: click.echo(f"written: {path}"))
