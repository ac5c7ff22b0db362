"""Run a mechanism for many parameters and starts."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.cli import FAILURE, INTERRUPTED, OK, write_complaint, write_files, write_json
from symgen.cli._shared_options import (
    examples_in_help,
    jobs_option,
    json_option,
    quantity_options,
    read_pairs,
    read_plot_file,
    setting_options,
    target_option,
    write_note,
)

if TYPE_CHECKING:
    from symgen.study.ensemble.sweep_study import Sweep


@click.command(
    "sweep",
    epilog=examples_in_help(
        'symgen sweep pendulum --vary "bob_mass=lin(1,2,11)" --until 1',
        'symgen sweep four-bar --vary "crank.omega=uniform(0,5,100,1)" -o sweep',
    ),
)
@click.argument("model")
@click.option(
    "--vary",
    "varied",
    multiple=True,
    required=True,
    metavar="NAME=VALUES",
    help="What varies: lin(a,b,n), log(a,b,n), values(a,b,...) or uniform(a,b,n,seed).",
)
@click.option("--zip", "together", is_flag=True, help="Vary all names together instead of in all combinations.")
@setting_options(
    *("method", "integrator", "step", "rtol", "atol", "until", "output_step", "times", "parameters", "inputs"),
    *("start", "options", "stop_when", "record_when", "strict", "max_violation", "max_energy_error", "max_step"),
    *("max_attempts", "coordinates"),
    text={
        "parameters": "Value of a parameter that does not vary.",
        "strict": "Let runs fail whose start is not consistent.",
    },
    otherwise={"output_step": "(only the end is kept)"},
)
@quantity_options(
    "What to keep: columns, bodies, joints or forces, such as crank.theta,knee.F.  [default: q,v]",
    "what is kept",
    "[default: t, or what varies where only the end is kept]",
)
@click.option(
    "-o", "--output", metavar="PATH", help="Write results to a NetCDF file (.nc), a CSV file with units, or a folder."
)
@click.option("--resume", is_flag=True, help="Continue the sweep at --output.")
@jobs_option("Threads.")
@click.option("--scheduler", metavar="ADDRESS", help="Run on the workers of a Dask scheduler.")
@target_option("What runs them: all cores, eight runs at once on each, or a CUDA device.")
@json_option
def command(
    model: str,
    varied: tuple[str, ...],
    together: bool,
    quantities: tuple[str, ...],
    plot: str | None,
    over: str | None,
    output: str | None,
    resume: bool,
    jobs: int | None,
    scheduler: str | None,
    target: str,
    as_json: bool,
    **values: Any,
) -> int:
    """Run MODEL for every combination of what varies, on all cores or a CUDA device.

    NAME is a parameter of the mechanism, or a coordinate or velocity of a body or joint at the start (crank.theta,
    crank.omega, motor.angle).
    Failed runs are rows with their reasons. With --output, finished runs survive Ctrl-C and kills, and --resume
    continues from there.
    """
    # before anything expensive: what is wrong with the words of the command
    axes = _values_by_name(varied)
    settings = Settings(**values)
    if settings.times is not None and settings.output_step is not None:
        raise InputError("--times", "one way of choosing outputs", "--output-step as well")
    if resume and output is None:
        raise InputError("--resume", "the output that was begun", "no --output")
    if jobs is not None and scheduler is not None:
        raise InputError("--jobs", "threads of this machine", "--scheduler as well", "the cluster has its own")
    path, plot_path = None if output is None else Path(output), read_plot_file(plot, over)
    drawn = [name for name in quantities if name.partition(".")[0] != "event"]
    if over not in (None, "t", *axes):  # what is drawn over is kept as well
        quantities = (*(quantities or ("q", "v")), str(over))

    from symgen.study.ensemble.device_runs import check_target
    from symgen.study.ensemble.parameter_sweep import output_folder

    check_target(target, scheduler)

    if path is not None:
        output_folder(path, resume)

    from symgen.api import load
    from symgen.cli._progress import Bar
    from symgen.study.ensemble.parameter_sweep import sweep

    loaded = load(model)
    with Bar(f"{loaded.name}, {', '.join(axes)}", 1.0) as bar:

        def show_progress(done: float, total: int) -> None:
            bar(done / total)

        study = sweep(
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
            progress=show_progress,
        )
    write_note(study.ensemble.notes)
    write_note(f"warning: in {count} of {len(study)} runs: {sentence}" for sentence, count in study.common_warnings())
    if as_json:
        write_json({**study.to_json(), "output": output})
    else:
        from symgen.cli._tables import show_sweep

        show_sweep(study, path)
    draw = {plot_path: lambda file: study.plot(file, drawn, over or "")}
    return write_files(_exit_code(study, path), draw, None if as_json else lambda file: click.echo(f"written: {file}"))


def _values_by_name(words: tuple[str, ...]) -> dict[str, str]:
    """Return the text of the values by name; names may not repeat."""
    from symgen.study.ensemble.axes import check_axis

    form = "NAME=VALUES, such as crank_mass=lin(1,3,21)"
    axes = read_pairs("--vary", [word.replace("(0)=", "=", 1) for word in words], form)
    for name, text in axes.items():
        check_axis(text, f"--vary {name}")
    return axes


def _exit_code(study: Sweep, path: Path | None) -> int:
    counts = study.counts
    if study.interrupted:
        done = len(study) - counts["not run"]
        progress = f"{done} of {len(study)} runs are done"
        hint = " and kept; --resume goes on from there" if path is not None else ""
        return write_complaint(f"interrupted; {progress}{hint}", INTERRUPTED)
    if counts["failed"] == len(study):
        return write_complaint(f"all {len(study)} runs failed: {study.reasons(1)[0][0]}", FAILURE)
    if counts["failed"]:
        write_complaint(f"warning: {counts['failed']} of {len(study)} runs failed", OK)
    return OK
