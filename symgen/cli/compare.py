"""``symgen compare MODEL``: error against run time."""

from __future__ import annotations

import math
import time
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click

from symgen.cli import FAILURE, INTERRUPTED, OK, complain, write_json
from symgen.cli._options import assignments, number_list, numbers, option_pairs, output_file, words
from symgen.cli._report import command_again, report_file

if TYPE_CHECKING:
    from symgen.study.compare import Study


@click.command("compare", short_help="Compare methods and integrators: error against run time.")
@click.argument("models", metavar="MODEL...", nargs=-1, required=True)
@click.option("--methods", metavar="A,B", help="Methods, or all; unless given, the six of the source.")
@click.option("--integrators", metavar="A,B", help="Integrators, or all; rk4, dopri5 and dop853 unless given.")
@click.option("--steps", metavar="H,H", help="Constant steps [s]; multiples of the mechanism's own unless given.")
@click.option("--rtols", metavar="R,R", help="Relative tolerances of adaptive integrators.")
@click.option("--until", type=float, help="End time [s].")
@click.option("--output-step", type=float, help="Time between the outputs that are compared [s].")
@click.option("--set", "changed", multiple=True, metavar="NAME=VALUE", help="Value of a parameter of the mechanism.")
@click.option("--option", "options", multiple=True, metavar="KEY=VALUE", help="Option, such as baumgarte.alpha=10.")
@click.option("--repeat", type=int, default=3, show_default=True, help="Timed runs a row; the shortest counts.")
@click.option(
    "--reference",
    "reference_by",
    metavar="HOW",
    default="auto",
    show_default=True,
    help="Where the reference comes from: scipy-dop853, scipy-radau, scipy-bdf or scipy-lsoda.",
)
@click.option("-o", "--output", metavar="FILE", help="Write a report with pictures: .html or .md.")
@click.option("--csv", "csv_file", metavar="FILE", help="Write the rows to a CSV file.")
@click.option("--resume", "--journal", metavar="FILE", help="Keep every finished row there, and skip those it has.")
@click.option("--jobs", type=int, help="Processes for what is not timed; as many as there are cores unless given.")
@click.option("--shape", default="auto", show_default=True, help="Shape of the code: auto, straight or looped.")
@click.option("--json", "as_json", is_flag=True, help="Write JSON to standard output, and nothing else.")
def command(
    models: tuple[str, ...],
    methods: str | None,
    integrators: str | None,
    steps: str | None,
    rtols: str | None,
    until: float | None,
    output_step: float | None,
    changed: tuple[str, ...],
    options: tuple[str, ...],
    repeat: int,
    reference_by: str,
    output: str | None,
    csv_file: str | None,
    resume: str | None,
    jobs: int | None,
    shape: str,
    as_json: bool,
) -> int:
    """Run every MODEL with every method, integrator, step and tolerance; show error against run time.

    The error is the largest distance [m] to a reference motion, over bodies, output times and points (centre of mass,
    and tips of the axes at the body's own length). Integrators with an error estimate run at --rtols, the others at
    --steps. Ctrl-C keeps the rows that are done; with --resume the same command goes on behind them.
    """
    numbers(until=until, output_step=output_step, jobs=jobs)
    step_list, rtol_list = number_list("--steps", steps), number_list("--rtols", rtols)
    method_list, integrator_list = words("--methods", methods), words("--integrators", integrators)
    parameters, chosen = assignments("--set", changed), option_pairs(options)
    path, report = output_file("--csv", csv_file), report_file(output)

    from symgen.api import load
    from symgen.cli._progress import Lines
    from symgen.study.compare import compare_all, save_csv
    from symgen.study.journal import Journal
    from symgen.study.machine import cores

    loaded = [load(model) for model in models]
    with ExitStack() as stack:
        journal = stack.enter_context(Journal(Path(resume))) if resume is not None else None
        lines = stack.enter_context(Lines())
        began = time.monotonic()

        def progress(what: str, reached: float, total: float) -> None:
            share = reached / total
            left = (time.monotonic() - began) * (1.0 - share) / share if share > 0.02 else None
            name = "" if len(loaded) > 1 or what.startswith("preparing") else f"{loaded[0].name}: "
            lines.say(f"{math.floor(100.0 * share)} %, {name}{what}", share, left)

        studies = compare_all(
            loaded,
            method_list,
            integrator_list,
            step_list,
            rtol_list,
            until,
            repeat,
            output_step,
            parameters,
            chosen,
            progress,
            jobs or cores(),
            journal,
            reference_by,
            shape,
        )
    if as_json:
        found = [study.to_json() for study in studies]
        write_json(found[0] if len(models) == 1 else {"studies": found})
    else:
        from symgen.cli._tables import show_study

        for study in studies:
            show_study(study)
    if path is not None:
        save_csv(studies, path)
    if report is not None and any(study.rows for study in studies):
        from symgen.report.comparison import comparison
        from symgen.report.write import write

        write(comparison(studies, command_again(), _asked(step_list, rtol_list)), report)
        click.echo(f"symgen: wrote {report}", err=True)
    return _exit_code(studies, resume)


def _asked(steps: tuple[float, ...], rtols: tuple[float, ...]) -> list[tuple[str, str]]:
    """Return what was asked for in words, by label."""
    from symgen.report.words import exact
    from symgen.study.compare import ATOL_SHARE, RTOLS, STEP_FACTORS

    own = f"{', '.join(f'{x:g}' for x in STEP_FACTORS)} times the mechanism's own"
    constant = ", ".join(f"{exact(x)} s" for x in steps) or own
    relative = ", ".join(exact(x) for x in rtols or RTOLS)
    return [("Steps", constant), ("Tolerances", f"relative {relative}; absolute {ATOL_SHARE:g} of them")]


def _exit_code(studies: list[Study], kept: str | None) -> int:
    if studies[-1].interrupted:
        how = "the same command goes on behind them" if kept else "--resume FILE would have kept them for another time"
        return complain(f"interrupted; the rows that were done are shown; {how}", INTERRUPTED)
    for study in studies:
        if study.failed:
            return complain(f"{study.mechanism}: every run failed", FAILURE)
        if study.how == "none":
            return complain(f"{study.mechanism}: {study.note}", FAILURE)
    return OK
