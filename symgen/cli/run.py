"""Simulate a mechanism."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.cli import FAILURE, INTERRUPTED, OK, write_complaint, write_files, write_json
from symgen.cli._shared_options import (
    check_output_file,
    examples_in_help,
    json_option,
    quantity_options,
    read_column_names,
    read_plot_file,
    setting_options,
    units_option,
    write_note,
)

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.result.result import Result


@click.command(
    "run",
    epilog=examples_in_help(
        "symgen run four-bar",
        "symgen run slider-crank --method baumgarte --step 1e-3 --until 5 --save a.nc --plot a.svg",
        "symgen run pendulum --set bob_mass=2 --start bob.vx=0.5 --json",
    ),
)
@click.argument("model")
@setting_options(
    *("method", "integrator", "step", "rtol", "atol", "until", "output_step", "parameters", "inputs", "start"),
    *("options", "stop_when", "record_when", "strict", "verify", "max_violation", "max_energy_error"),
    *("max_step", "max_attempts", "repeat", "shape", "coordinates"),
)
@click.option(
    "--from",
    "whence",
    metavar="FILE",
    help="Continue from the last state of a saved result: .nc, or .parquet or .csv for its coordinates and velocities.",
)
@click.option("--save", metavar="FILE", help="Write the result to FILE: .nc, .parquet or .csv.")
@quantity_options(
    "Columns, bodies, joints or forces, such as motor.effort,knee.F: shown, drawn, and all that --save FILE.csv holds.",
    "these quantities, or an overview,",
)
@click.option(
    "--sensitivity",
    "sensitivities",
    multiple=True,
    metavar="NAME,NAME",
    help="Differentiate the motion by parameters, by values of the start, such as crank.omega, and by method.NAME.",
    callback=lambda context, parameter, value: read_column_names("--sensitivity", value),
)
@units_option
@json_option
def command(
    model: str,
    whence: str | None,
    save: str | None,
    quantities: tuple[str, ...],
    sensitivities: tuple[str, ...],
    units: bool,
    plot: str | None,
    over: str | None,
    as_json: bool,
    **values: Any,
) -> int:
    """Simulate MODEL and show the result.

    Outputs are every step with a constant step and 1001 equidistant times with an adaptive integrator, unless the
    mechanism or --output-step sets others. With --from, times continue where the saved run ended, and --until is the
    end on the same time axis.
    """
    # before anything expensive: what is wrong with the words of the command
    settings = Settings(**values)
    if whence is not None and settings.start:
        raise InputError("--from", "one way of saying where a run begins", "--start as well")
    save_path = check_output_file("--save", save, "data")
    plot_path = read_plot_file(plot, over)
    if units and (save_path is None or save_path.suffix.lower() != ".csv"):
        raise InputError("--units", "--save FILE.csv, whose headings carry them", save or "no --save")

    from symgen.api import load
    from symgen.cli._progress import Bar
    from symgen.result.summary import extreme_values

    loaded = load(model)
    if whence is not None:
        from symgen.result.saved import read_last_state

        settings = replace(settings, start=read_last_state("--from", Path(whence)))  # type: ignore[arg-type]  # one of two
    if save_path is not None:
        from symgen.run.planning.outputs import check_saving

        check_saving(loaded.mechanism, settings)
    _refuse_unknown_quantities(loaded, settings, quantities, over or "t")
    solver = settings.method + (f", {settings.integrator}" if settings.integrator else "")
    with Bar(f"{loaded.name}, {solver}", settings.until or loaded.mechanism.defaults.until) as bar:
        result = loaded.simulate(settings, bar, sensitivities)
    write_note((*result.notes, *(f"warning: {w}" for w in result.warnings)))
    chosen = extreme_values(result.select(quantities)) if quantities else {}
    if as_json:
        write_json(
            result.to_json() | {"proposals": list(result.proposals)} | ({"quantities": chosen} if quantities else {})
        )
    else:
        from symgen.cli._tables import show_result, show_sensitivities

        show_result(result, quantities)
        if sensitivities:
            show_sensitivities(result, quantities)
    files = {
        save_path: lambda path: result.save(path, quantities, units),
        plot_path: lambda path: result.plot(path, quantities, over or "t"),
    }
    return write_files(_exit_code(result), files, None if as_json else lambda path: click.echo(f"written: {path}"))


def _refuse_unknown_quantities(model: Model, settings: Settings, quantities: tuple[str, ...], over: str) -> None:
    """Refuse quantities that no result will have."""
    if not quantities and over == "t":
        return
    from symgen.result.signals import check_single, choose_columns, signals_of_run
    from symgen.run.planning.plan import Purpose
    from symgen.run.planning.prepare import make_plan
    from symgen.run.planning.starts import compiled_for

    plan = make_plan(model.mechanism, settings, Purpose.ROWS)
    tables = signals_of_run(plan.mechanism, compiled_for(plan.mechanism, plan.choice).info)
    columns = {s.name: table for table, signals in tables.items() for s in signals}
    choose_columns(columns, quantities, model.name, (*tables,))
    if over != "t":
        check_single(over, choose_columns(columns, [over], model.name, (*tables,)))


def _exit_code(result: Result) -> int:
    if result.interrupted:
        return write_complaint(INTERRUPTED_AT.format(result.t[-1] if len(result.t) else 0.0), INTERRUPTED)
    if result.status == "failed":
        return write_complaint(f"failed: {result.reason}", FAILURE)
    if result.status == "unverified":
        return write_complaint(f"warning: unverified: {result.reason}", OK)
    return OK


INTERRUPTED_AT = "interrupted; outputs up to t = {:g} s were kept"
