"""Compare methods and integrators: error against run time."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.cli import FAILURE, OK, write_complaint, write_files, write_json
from symgen.cli._report import StudyFiles, command_line_again, report_interruption, sketches_at_start, study_files
from symgen.cli._shared_options import (
    examples_in_help,
    jobs_option,
    json_option,
    quantity_options,
    read_comma_list,
    read_number_list,
    read_plot_file,
    setting_options,
)

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.study.comparison.combinations import Combinations
    from symgen.study.comparison.compare_models import Study


@click.command(
    "compare",
    epilog=examples_in_help(
        "symgen compare four-bar",
        "symgen compare four-bar --methods lagrange,baumgarte --steps 1e-3,1e-4 -o report.html",
        "symgen compare --benchmark iftomm",
    ),
)
@click.argument("models", metavar="[MODEL...]", nargs=-1)
@click.option(
    "--benchmark",
    metavar="NAME",
    help="In place of MODEL: the problems of a library beside errors and run times that were published: iftomm.",
)
@click.option(
    "--methods",
    metavar="A,B",
    help="Methods, or all; by default the six of the source. With options, a line each: baumgarte:alpha=5:beta=5.",
)
@click.option("--integrators", metavar="A,B", help="Integrators, or all; rk4, dopri5 and dop853 by default.")
@click.option("--steps", metavar="H,H", help="Constant steps [s]; multiples of the mechanism's own by default.")
@click.option("--rtols", metavar="R,R", help="Relative tolerances of adaptive integrators.")
@click.option(
    *("--at", "error_at"),
    metavar="E,E",
    help="Errors [m] at which run times are interpolated between settings; all lines are timed in turn.",
)
@click.option("--laws", metavar="A,B", help="Laws of dry friction: exact, tanh:speed=1e-3; the exact one by default.")
@click.option(
    "--gradient",
    metavar="A,B",
    help="Parameters by which motions are differentiated: columns gradient_error and gradient_seconds.",
)
@setting_options(
    *("until", "output_step", "parameters", "start", "options", "max_violation", "max_energy_error", "max_step"),
    *("max_attempts", "repeat", "shape"),
    text={
        "output_step": "Time between the outputs that are compared [s].",
        "options": "Option, such as baumgarte.alpha=10.",
        "repeat": "Rounds a row, in which it and its yardstick run in turn.",
    },
    otherwise={
        "until": "(of the mechanism, while it is predictable)",
        "output_step": "(of the mechanism)",
        "repeat": 5,
    },
)
@click.option(
    *("--coordinates", "states"),
    metavar="A,B",
    help="Coordinates of the state: absolute, joint, auto, or several; absolute by default.",
)
@click.option(
    "--reference",
    "reference_by",
    metavar="HOW",
    default="auto",
    show_default=True,
    help="Where the reference comes from: scipy-dop853, scipy-radau, scipy-bdf or scipy-lsoda.",
)
@quantity_options(
    "Columns of rows, such as error,evaluations: what --plot draws.  [default: error]",
    "error against run time, or other columns,",
    "[default: run_seconds]",
)
@click.option("--plot-width", type=float, metavar="MM", help="Fit --plot into a column of a printed page, so wide.")
@study_files("row")
@jobs_option("Processes for what is not timed.")
@json_option
def command(
    models: tuple[str, ...],
    benchmark: str | None,
    methods: str | None,
    integrators: str | None,
    steps: str | None,
    rtols: str | None,
    error_at: str | None,
    laws: str | None,
    gradient: str | None,
    states: str | None,
    reference_by: str,
    quantities: tuple[str, ...],
    plot: str | None,
    over: str | None,
    plot_width: float | None,
    files: StudyFiles,
    jobs: int | None,
    as_json: bool,
    **values: Any,
) -> int:
    """Run every MODEL with every method, integrator, step and tolerance; show error against run time.

    The error is the largest distance [m] to a reference motion, over bodies, output times and points (centre of mass,
    and tips of the axes at the body's own length). The run time is processor time of the loop, and its ratio to
    lagrange is taken within rounds. Integrators with an error estimate run at --rtols, the others at --steps. Ctrl-C
    shows the finished rows; with --resume the same command continues after them.
    """
    if benchmark is not None:
        return _compare_with_published(benchmark, values["repeat"], as_json)
    if not models:
        raise InputError("MODEL", "the mechanisms to compare, or --benchmark NAME", "neither")
    step_list, rtol_list = read_number_list("--steps", steps), read_number_list("--rtols", rtols)
    errors = read_number_list("--at", error_at)
    method_list, integrator_list = read_comma_list("--methods", methods), read_comma_list("--integrators", integrators)
    plot_path = read_plot_file(plot, over)
    if plot_width is not None:
        if plot_path is None:
            raise InputError("--plot-width", "--plot FILE, which has the width", "no --plot")
        from symgen.result.plot import check_width

        check_width("--plot-width", plot_width)
    if quantities and plot_path is None:
        raise InputError("--quantity", "--plot FILE, which draws it", "no --plot")

    from symgen.api import load
    from symgen.base.memory import processor_count
    from symgen.cli._progress import Lines
    from symgen.study.comparison.across import across_mechanisms
    from symgen.study.comparison.combinations import Combinations
    from symgen.study.comparison.compare_models import compare_all, save_csv
    from symgen.study.comparison.comparison_study import check_columns_of_rows, plot_rows
    from symgen.study.journal import Journal

    what, along = quantities or ("error",), over or "run_seconds"
    check_columns_of_rows(what, along)

    loaded = [load(model) for model in models]
    with ExitStack() as stack:
        journal = None if files.journal is None else stack.enter_context(Journal(files.journal))
        lines = stack.enter_context(Lines())

        def show_progress(what: str, reached: float, total: float) -> None:
            name = "" if len(loaded) > 1 or what.startswith("preparing") else f"{loaded[0].name}: "
            lines.show_task(f"{name}{what}", reached / total)

        runs = Combinations(
            *(method_list, integrator_list, step_list, rtol_list),
            *(read_comma_list("--coordinates", states), errors, read_comma_list("--laws", laws)),
            read_comma_list("--gradient", gradient),
        )
        settings = Settings(**values)
        studies = compare_all(loaded, settings, runs, reference_by, show_progress, jobs or processor_count(), journal)
    rows = [row for study in studies for row in study.rows]
    used = {"--steps": any(r.step is not None for r in rows), "--rtols": any(r.rtol is not None for r in rows)}
    unused = [o for o, asked in (("--steps", step_list), ("--rtols", rtol_list)) if asked and rows and not used[o]]
    _note_left_out(unused, runs, loaded)
    if as_json:
        tables = [study.to_json() for study in studies]
        across = [asdict(line) for line in across_mechanisms(studies)]
        write_json(tables[0] if len(models) == 1 else {"studies": tables, "across": across})
    else:
        from symgen.cli._comparison_tables import show_across, show_study

        for study in studies:
            show_study(study)
        show_across(across_mechanisms(studies))

    def write_report(file: Path) -> None:
        from symgen.study.report.kinds.comparison_report import comparison_report
        from symgen.study.report.letterhead import put_on_paper
        from symgen.study.report.write import write

        sketches = sketches_at_start(loaded, values["parameters"], values["start"])
        texts = [text for option, text in _label_ranges(step_list, rtol_list, bool(errors)).items() if used[option]]
        document = comparison_report(studies, command_line_again(), texts, sketches)
        write(put_on_paper(document, files.paper), file)
        click.echo(f"symgen: wrote {file}", err=True)

    report = files.report if any(study.rows for study in studies) else None
    written = {
        files.csv: lambda file: save_csv(studies, file, files.units),
        plot_path: lambda file: plot_rows(studies, file, what, along, plot_width),
        report: write_report,
    }
    return write_files(_exit_code_of_studies(studies, files.journal is not None), written)


def _compare_with_published(name: str, repeat: int, as_json: bool) -> int:
    """Run the problems of a library, and show them beside what was published."""
    context = click.get_current_context()
    own = {"benchmark", "repeat", "as_json"}
    for parameter in context.command.params:
        source = context.get_parameter_source(str(parameter.name))
        if source is ParameterSource.COMMANDLINE and parameter.name not in own:
            got = "MODEL" if parameter.param_type_name == "argument" else parameter.opts[0]
            raise InputError("--benchmark", "only --repeat and --json beside it: its settings are its own", got)

    from symgen.study.comparison.published import benchmark_json, run_benchmark

    benchmark, rows = run_benchmark(name, repeat)
    if as_json:
        write_json(benchmark_json(benchmark, rows))
    else:
        from symgen.cli._comparison_tables import show_published

        show_published(benchmark, rows)
    return OK if all(row.status == "ok" for row in rows) else FAILURE


def _note_left_out(unused: Sequence[str], runs: Combinations, models: Sequence[Model]) -> None:
    """Say which options counted for nothing, and which methods no integrator solves, or rows with bounds rule out."""
    for option in unused:
        click.echo(f"symgen: {option} counted for nothing: no run of these integrators has such steps", err=True)
    if runs.left_out:
        names = ", ".join(runs.left_out)
        click.echo(f"symgen: left out, as these integrators solve no form of them: {names}", err=True)
    for model in models:
        if methods := runs.without_modes(model.mechanism):
            rows = next((row.family.noun for row in model.mechanism.bounded), "joints that hold for a while")
            names = ", ".join(methods)
            click.echo(f"symgen: left out, as {model.name} has {rows}, which they cannot take: {names}", err=True)


def _label_ranges(steps: tuple[float, ...], rtols: tuple[float, ...], at: bool) -> dict[str, tuple[str, str]]:
    """Return the settings of --steps and --rtols: a label and words."""
    from symgen.study.comparison.combinations import ATOL_SHARE, RTOLS, RTOLS_AT, STEP_FACTORS, STEP_FACTORS_AT
    from symgen.study.report.words import chosen_number

    own = f"{', '.join(f'{x:g}' for x in (STEP_FACTORS_AT if at else STEP_FACTORS))} times the mechanism's own"
    relative = ", ".join(chosen_number(x) for x in rtols or (RTOLS_AT if at else RTOLS))
    return {
        "--steps": ("Steps", ", ".join(f"{chosen_number(x)} s" for x in steps) or own),
        "--rtols": ("Tolerances", f"relative {relative}; absolute {ATOL_SHARE:g} of them"),
    }


def _exit_code_of_studies(studies: list[Study], stored: bool) -> int:
    if studies[-1].interrupted:
        return report_interruption("row", stored)
    for study in studies:
        if study.failed:
            return write_complaint(f"{study.mechanism}: every run failed", FAILURE)
        if study.how == "none":
            return write_complaint(f"{study.mechanism}: {study.note}", FAILURE)
    return OK
