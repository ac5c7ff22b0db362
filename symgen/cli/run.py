"""``symgen run MODEL``: simulate a mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from symgen.cli import FAILURE, INTERRUPTED, OK, complain, write_json
from symgen.cli._options import assignments, numbers, option_pairs, output_file

if TYPE_CHECKING:
    from symgen.result.result import Result


@click.command("run", short_help="Simulate a mechanism.")
@click.argument("model")
@click.option("--method", default="direct-correction", show_default=True, help="Constraint stabilisation method.")
@click.option("--integrator", default=None, help="Integrator; by default the method's own.")
@click.option("--step", type=float, help="Step [s]: constant, or the first one of an adaptive integrator.")
@click.option("--rtol", type=float, help="Relative tolerance of an adaptive integrator.")
@click.option("--atol", type=float, help="Absolute tolerance of an adaptive integrator.")
@click.option("--until", type=float, help="End time [s].")
@click.option("--output-step", type=float, help="Time between outputs [s].")
@click.option("--set", "changed", multiple=True, metavar="NAME=VALUE", help="Value of a parameter of the mechanism.")
@click.option("--option", "options", multiple=True, metavar="KEY=VALUE", help="Option, such as method.alpha=5.")
@click.option("--strict", is_flag=True, help="Refuse a start that is not consistent.")
@click.option("--verify", is_flag=True, help="Settle doubts at singular positions by a rerun at another step.")
@click.option("--save", metavar="FILE", help="Write the result to FILE: .nc, .parquet or .csv.")
@click.option("--plot", metavar="FILE", help="Draw the result into FILE: .png, .svg or .pdf.")
@click.option("--repeat", type=int, default=1, show_default=True, help="Warm up and time that many runs.")
@click.option("--shape", default="auto", show_default=True, help="Shape of the code: auto, straight or looped.")
@click.option("--json", "as_json", is_flag=True, help="Write JSON to standard output, and nothing else.")
@click.pass_context
def command(
    context: click.Context,
    model: str,
    method: str,
    integrator: str | None,
    step: float | None,
    rtol: float | None,
    atol: float | None,
    until: float | None,
    output_step: float | None,
    changed: tuple[str, ...],
    options: tuple[str, ...],
    strict: bool,
    verify: bool,
    save: str | None,
    plot: str | None,
    repeat: int,
    shape: str,
    as_json: bool,
) -> int:
    """Simulate MODEL and say how it went.

    Outputs are every step with a constant step and 1001 equidistant times with an adaptive integrator, unless the
    mechanism or --output-step says otherwise.
    """
    # before anything expensive: what is wrong with the words of the command
    parameters = assignments("--set", changed)
    chosen = option_pairs(options)
    numbers(step=step, rtol=rtol, atol=atol, until=until, output_step=output_step)
    save_path = output_file("--save", save, "data")
    plot_path = output_file("--plot", plot, "plot")

    from symgen.api import load
    from symgen.cli._progress import Bar
    from symgen.plan import Settings

    loaded = load(model)
    settings = Settings(
        method=method,
        integrator=integrator,
        step=step,
        rtol=rtol,
        atol=atol,
        until=until,
        output_step=output_step,
        parameters=parameters,
        options=chosen,
        strict=strict,
        verify=verify,
        repeat=repeat,
        shape=shape,
    )
    with Bar(
        f"{loaded.name}, {method}" + (f", {integrator}" if integrator else ""), until or loaded.mechanism.defaults.until
    ) as bar:
        result = loaded.simulate(settings, progress=bar)
    for sentence in (*result.notes, *(f"warning: {w}" for w in result.warnings)):
        click.echo(f"symgen: {sentence}", err=True)
    if as_json:
        write_json(result.to_json())
    if save_path is not None:
        result.save(save_path)
    if plot_path is not None:
        result.plot(plot_path)
    if not as_json:
        from symgen.cli._tables import show_result

        show_result(result, [p for p in (save_path, plot_path) if p is not None])
    return _exit_code(result)


def _exit_code(result: Result) -> int:
    if result.interrupted:
        return complain(INTERRUPTED_AT.format(result.t[-1] if len(result.t) else 0.0), INTERRUPTED)
    if result.status == "failed":
        return complain(f"failed: {result.reason}", FAILURE)
    if result.status == "unverified":
        return complain(f"warning: unverified: {result.reason}", OK)
    return OK


INTERRUPTED_AT = "interrupted; outputs up to t = {:g} s were kept"
