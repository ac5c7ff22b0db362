"""``symgen run MODEL``: simulate a mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from symgen.cli import FAILURE, INTERRUPTED, OK, complain, write_files, write_json
from symgen.cli._options import json_option, output_file, setting_options
from symgen.settings import Settings

if TYPE_CHECKING:
    from symgen.result.result import Result


@click.command("run", short_help="Simulate a mechanism.")
@click.argument("model")
@setting_options(
    *("method", "integrator", "step", "rtol", "atol", "until", "output_step", "parameters", "options", "strict"),
    *("stop_when", "record_when", "verify", "max_violation", "max_energy_error", "max_steps", "repeat", "shape"),
)
@click.option("--save", metavar="FILE", help="Write the result to FILE: .nc, .parquet or .csv.")
@click.option("--plot", metavar="FILE", help="Draw the result into FILE: .png, .svg or .pdf.")
@json_option
def command(model: str, save: str | None, plot: str | None, as_json: bool, **asked: Any) -> int:
    """Simulate MODEL and say how it went.

    Outputs are every step with a constant step and 1001 equidistant times with an adaptive integrator, unless the
    mechanism or --output-step says otherwise.
    """
    # before anything expensive: what is wrong with the words of the command
    settings = Settings(**asked)
    save_path = output_file("--save", save, "data")
    plot_path = output_file("--plot", plot, "plot")

    from symgen.api import load
    from symgen.cli._progress import Bar

    loaded = load(model)
    if save_path is not None:
        from symgen.plan import check_saving

        check_saving(loaded.mechanism, settings)
    solver = settings.method + (f", {settings.integrator}" if settings.integrator else "")
    with Bar(f"{loaded.name}, {solver}", settings.until or loaded.mechanism.defaults.until) as bar:
        result = loaded.simulate(settings, progress=bar)
    for sentence in (*result.notes, *(f"warning: {w}" for w in result.warnings)):
        click.echo(f"symgen: {sentence}", err=True)
    if as_json:
        write_json(result.to_json())
    else:
        from symgen.cli._tables import show_result

        show_result(result)
    files = {save_path: result.save, plot_path: result.plot}
    return write_files(_exit_code(result), files, None if as_json else lambda path: click.echo(f"written: {path}"))


def _exit_code(result: Result) -> int:
    if result.interrupted:
        return complain(INTERRUPTED_AT.format(result.t[-1] if len(result.t) else 0.0), INTERRUPTED)
    if result.status == "failed":
        return complain(f"failed: {result.reason}", FAILURE)
    if result.status == "unverified":
        return complain(f"warning: unverified: {result.reason}", OK)
    return OK


INTERRUPTED_AT = "interrupted; outputs up to t = {:g} s were kept"
