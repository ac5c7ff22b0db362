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
    import numpy as np
    from numpy.typing import NDArray

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


def _show_contributions(study: Sweep) -> None:
    """Print what each varied number contributes to the variance of the kept quantities, where enough runs have them."""
    from symgen.cli._tables import make_console, show_rows

    names = list(study.ensemble.grid.names)[:8]
    rows = list[tuple[str, ...]]()
    for q in study.ensemble.recipe.kept[:24]:
        try:
            shares = study.contributions(q.name)
        except InputError:  # too few runs
            continue
        if any(shares.values()):
            rows.append(
                (q.name, *(f"{100.0 * shares[name]:.1f}" for name in names), f"{100 * sum(shares.values()):.1f}")
            )
    if rows:
        headings = ("quantity", *names, "together")
        show_rows(make_console(), headings, rows, headings[:1], "share of the variance [%], by straight lines")


def show_sweep(study: Sweep, written: Path | None) -> None:
    """Print the results of an ensemble: axes, statuses, reasons, and final values of the kept quantities."""
    import numpy as np

    from symgen.base.digits import format_column, scale_of
    from symgen.base.errors import plural
    from symgen.cli._tables import make_console, show_facts, show_rows
    from symgen.study.ensemble.samples import PERCENTILES, has_samples

    facts, ensemble = study.to_json(), study.ensemble
    steps = f"step {facts['step']:g} s" if facts["rtol"] is None else f"rtol {facts['rtol']:g}"
    rate = f", {len(study) / study.seconds:.3g} runs a second" if study.seconds > 0.0 and not study.interrupted else ""
    grid, units = study.as_written()
    axes = [item for axis in grid.axes for item in axis.values.items()]

    def range_of_values(name: str, x: NDArray[np.float64]) -> str:
        return f"{x.min():.6g} to {x.max():.6g} {units[name]}".strip()

    lines = [
        ("mechanism", facts["mechanism"]),
        ("method", f"{facts['method']}, {facts['integrator']}, {steps}, until {facts['until']:g} s"),
        *(("varies", f"{name}: {plural(len(x), 'value')} from {range_of_values(name, x)}") for name, x in axes),
        ("runs", f"{len(study)} in {study.seconds:.3g} s{rate}"),
        *(("status", f"{status}: {count}") for status, count in study.counts.items() if count),
        *(("reason", f"{count} x {reason}") for reason, count in study.reasons()),
        ("error", "not estimated: symgen run --verify does so for a single run"),
        *([("written", str(written))] if written is not None and not study.interrupted else []),
    ]
    out = make_console()
    show_facts(out, lines)
    rows, sampled, scales = list[tuple[str, ...]](), has_samples(ensemble.grid), dict[str, float]()
    for i, q in enumerate(ensemble.recipe.kept):  # a column may be rounding throughout beside others of its unit
        sizes = np.abs(study.values[:, i, -1])
        largest = float(sizes[np.isfinite(sizes)].max(initial=0.0))
        scales[q.unit] = max(scales.get(q.unit, 0.0), scale_of([largest], q.unit))
    for i, q in enumerate(ensemble.recipe.kept[:24]):
        last = study.values[:, i, -1]
        last = last[np.isfinite(last)]
        if len(last):
            middle = np.percentile(last, PERCENTILES) if sampled else [last.mean()]
            cells = format_column([last.min(), *middle, last.max()], q.unit, least=scales[q.unit])
            rows.append((q.name, q.unit, *cells))
    if rows:
        between = [f"{share:g} %" for share in PERCENTILES] if sampled else ["mean"]
        headings = ("quantity", "unit", "least", *between, "largest")
        show_rows(out, headings, rows, headings[:2], "at the last output")
    if sampled:
        _show_contributions(study)
