"""``symgen sweep MODEL``: many runs over parameters and starts."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from symgen.cli import FAILURE, INTERRUPTED, OK, complain, write_json
from symgen.cli._options import assignments, number_list, numbers, option_pairs
from symgen.errors import InputError
from symgen.ir.program import TARGETS

if TYPE_CHECKING:
    from symgen.ensemble.study import Sweep


@click.command("sweep", short_help="Run a mechanism for many parameters and starts.")
@click.argument("model")
@click.option(
    "--vary",
    "varied",
    multiple=True,
    required=True,
    metavar="NAME=VALUES",
    help="What varies: lin(a,b,n), log(a,b,n), values(a,b,...) or uniform(a,b,n,seed).",
)
@click.option("--zip", "together", is_flag=True, help="Let all names vary together instead of in all combinations.")
@click.option("--method", default="direct-correction", show_default=True, help="Constraint stabilisation method.")
@click.option("--integrator", default=None, help="Integrator; by default the method's own.")
@click.option("--step", type=float, help="Step [s]: constant, or the first one of an adaptive integrator.")
@click.option("--rtol", type=float, help="Relative tolerance of an adaptive integrator.")
@click.option("--atol", type=float, help="Absolute tolerance of an adaptive integrator.")
@click.option("--until", type=float, help="End time [s].")
@click.option("--quantity", "quantities", multiple=True, metavar="NAME", help="What to keep, such as crank.theta or q.")
@click.option("--output-step", type=float, help="Time between outputs [s]; by default only the end is kept.")
@click.option("--times", metavar="T,T,...", help="Output times [s].")
@click.option("--set", "changed", multiple=True, metavar="NAME=VALUE", help="Value of a parameter that does not vary.")
@click.option("--option", "options", multiple=True, metavar="KEY=VALUE", help="Option, such as method.alpha=5.")
@click.option("--strict", is_flag=True, help="Let runs fail whose start is not consistent.")
@click.option("-o", "--output", metavar="PATH", help="Write results to a NetCDF file (.nc) or a folder.")
@click.option("--resume", is_flag=True, help="Continue what was begun at --output.")
@click.option("--jobs", type=int, help="Threads; by default one for every core.")
@click.option("--scheduler", metavar="ADDRESS", help="Run on the workers of a Dask scheduler.")
@click.option(
    "--target",
    type=click.Choice(TARGETS),
    default="cpu",
    show_default=True,
    help="What runs them: all cores, eight runs at once on each, or a CUDA device.",
)
@click.option("--json", "as_json", is_flag=True, help="Write JSON to standard output, and nothing else.")
def command(
    model: str,
    varied: tuple[str, ...],
    together: bool,
    method: str,
    integrator: str | None,
    step: float | None,
    rtol: float | None,
    atol: float | None,
    until: float | None,
    quantities: tuple[str, ...],
    output_step: float | None,
    times: str | None,
    changed: tuple[str, ...],
    options: tuple[str, ...],
    strict: bool,
    output: str | None,
    resume: bool,
    jobs: int | None,
    scheduler: str | None,
    target: str,
    as_json: bool,
) -> int:
    """Run MODEL for every combination of what varies, on all cores or a CUDA device.

    NAME is a parameter of the mechanism, or a coordinate or velocity of a body at the start (crank.theta, crank.omega).
    Runs that fail are rows with their reasons. With --output, finished runs survive Ctrl-C and kills, and --resume
    goes on from there.
    """
    # before anything expensive: what is wrong with the words of the command
    axes = _axes(varied)
    parameters = assignments("--set", changed)
    chosen = option_pairs(options)
    numbers(step=step, rtol=rtol, atol=atol, until=until, output_step=output_step)
    if times is not None and output_step is not None:
        raise InputError("--times", "one way of choosing outputs", "--output-step as well")
    moments = None if times is None else number_list("--times", times)
    if jobs is not None and not 1 <= jobs <= 4096:
        raise InputError("--jobs", "a whole number from 1 to 4096", f"{jobs}")
    if resume and output is None:
        raise InputError("--resume", "the output that was begun", "no --output")
    if jobs is not None and scheduler is not None:
        raise InputError("--jobs", "threads of this machine", "--scheduler as well", "the cluster has its own")
    path = None if output is None else Path(output)

    from symgen.ensemble.device import check_target
    from symgen.ensemble.sweep import folder_of

    check_target(target, scheduler)

    if path is not None:
        folder_of(path, resume)

    from symgen.api import load
    from symgen.cli._progress import Bar
    from symgen.ensemble.sweep import sweep
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
        times=moments,
        parameters=parameters,
        options=chosen,
        strict=strict,
    )
    with Bar(f"{loaded.name}, {', '.join(axes)}", 1.0) as bar:

        def progress(done: float, total: int) -> None:
            bar(done / total)

        found = sweep(
            loaded,
            {} if together else axes,
            runs=axes if together else {},
            quantities=quantities or None,
            output=path,
            resume=resume,
            jobs=jobs,
            scheduler=scheduler,
            target=target,
            settings=settings,
            progress=progress,
        )
    for note in found.ensemble.notes:
        click.echo(f"symgen: {note}", err=True)
    if as_json:
        write_json({**found.to_json(), "output": output})
    else:
        from symgen.cli._sweep_table import show_sweep

        show_sweep(found, path)
    return _exit_code(found, path)


def _axes(words: tuple[str, ...]) -> dict[str, str]:
    """Return the text of the values by name; names may not repeat."""
    axes: dict[str, str] = {}
    for word in words:
        name, equals, text = word.partition("=")
        name = name.strip().removesuffix("(0)")
        if not equals or not name or not text.strip():
            raise InputError("--vary", "NAME=VALUES, such as crank_mass=lin(1,3,21)", f"'{word[:60]}'")
        if name in axes:
            raise InputError(f"--vary {name}", "each name once", "it twice")
        axes[name] = text.strip()
    from symgen.ensemble.axes import parse

    for name, text in axes.items():
        parse(text, f"--vary {name}")
    return axes


def _exit_code(found: Sweep, path: Path | None) -> int:
    counts = found.counts
    if found.interrupted:
        done = len(found) - counts["not run"]
        kept = f"{done} of {len(found)} runs are done"
        hint = " and kept; --resume goes on from there" if path is not None else ""
        return complain(f"interrupted; {kept}{hint}", INTERRUPTED)
    if counts["failed"] == len(found):
        return complain(f"all {len(found)} runs failed: {found.reasons(1)[0][0]}", FAILURE)
    if counts["failed"]:
        complain(f"warning: {counts['failed']} of {len(found)} runs failed", OK)
    return OK
