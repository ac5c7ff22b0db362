"""Find where methods stop being stable: stiff and extreme cases."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.base import arguments
from symgen.cli import FAILURE, OK, write_complaint, write_files, write_json
from symgen.cli._report import StudyFiles, command_line_again, report_interruption, sketches_at_start, study_files
from symgen.cli._shared_options import examples_in_help, jobs_option, json_option, read_comma_list, setting_options

if TYPE_CHECKING:
    from symgen.study.runner import Status
    from symgen.study.stress.stress_rows import Stress


@click.command(
    "stress",
    epilog=examples_in_help(
        "symgen stress four-bar --quick", "symgen stress --cases mass-ratio,stiffness -o stress.html"
    ),
)
@click.argument("models", metavar="[MODEL...]", nargs=-1)
@click.option(
    "--cases",
    metavar="A,B",
    help="Families of cases, such as stiffness,mass-ratio; by default all, with --quick no mechanisms of their own.",
)
@click.option("--methods", metavar="A,B", help="Methods, auto among them; all and auto by default.")
@click.option("--quick", is_flag=True, help="A short look: fewer cases, one integrator a method.")
@click.option("--catalogue", is_flag=True, help="Include every studied model of the catalogue.")
@click.option("--compilation", type=float, metavar="SECONDS", help="Omit pairs that would take longer to compile.")
@study_files("cell")
@setting_options("max_violation", "max_energy_error", "max_step", "max_attempts", "coordinates")
@jobs_option("Processes.")
@json_option
def command(
    models: tuple[str, ...],
    cases: str | None,
    methods: str | None,
    quick: bool,
    catalogue: bool,
    compilation: float | None,
    files: StudyFiles,
    jobs: int | None,
    as_json: bool,
    **limits: Any,
) -> int:
    """Run every method on stiff and extreme cases derived from each MODEL (four-bar by default).

    Each cell is compared with an independent reference, and its own status is listed as well. Ctrl-C shows the finished
    cells; with --resume the same command continues after them. Exit code 1 if auto reports success with an error above
    1e-3 of the mechanism's length.
    """
    if compilation is not None:
        arguments.number("--compilation", compilation, positive=True)
    case_list, method_list = read_comma_list("--cases", cases), read_comma_list("--methods", methods)

    from symgen.base.memory import processor_count
    from symgen.cli._progress import Lines
    from symgen.describe.catalogue import names
    from symgen.study.journal import Journal
    from symgen.study.runner import one_thread_each

    with ExitStack() as stack:
        stack.enter_context(one_thread_each())
        from symgen.study.stress.stress_rows import save_stress_csv  # with numerical libraries
        from symgen.study.stress.study import stress

        journal = None if files.journal is None else stack.enter_context(Journal(files.journal))
        lines = stack.enter_context(Lines())

        def show_progress(what: str, status: Status) -> None:
            lines.show_task(f"{what}: {status.done} of {status.total} cells", status.share)

        requested = dict.fromkeys((*models, *(names() if catalogue else ())))
        work = journal, jobs or processor_count(), show_progress, compilation
        study = stress(tuple(requested), case_list, method_list, quick, *work, **limits)
    if as_json:
        write_json(study.to_json())
    else:
        show_stress(study)

    def write_report(file: Path) -> None:
        from symgen.api import load
        from symgen.study.report.kinds.stress_report import stress_report
        from symgen.study.report.letterhead import put_on_paper
        from symgen.study.report.write import write

        mechanisms = [load(name) for name in dict.fromkeys(models)]
        document = stress_report(study, command_line_again(), sketches_at_start(mechanisms))
        write(put_on_paper(document, files.paper), file)
        click.echo(f"symgen: wrote {file}", err=True)

    report = files.report if study.rows else None
    written = {files.csv: lambda file: save_stress_csv(study, file, files.units), report: write_report}
    return write_files(_exit_code(study, files.journal is not None), written)


def _exit_code(study: Stress, stored: bool) -> int:
    from symgen.run.planning.automatic import AUTO

    if study.interrupted:
        return report_interruption("cell", stored)
    wrong = sum(row.method == AUTO for row in study.false_successes)
    if wrong:
        cells = "1 cell" if wrong == 1 else f"{wrong} cells"
        return write_complaint(f"auto reports success with an error above 1e-3 of the length in {cells}", FAILURE)
    return OK


def show_stress(study: Stress) -> None:
    """Print a stress study."""
    from symgen.base.errors import plural
    from symgen.cli._tables import make_console, show_rows
    from symgen.study.stress.beside import beside_yardstick, cells_beside, extremes_beside, families_beside
    from symgen.study.stress.findings import findings_of_study
    from symgen.study.stress.stress_rows import LEGEND, Map

    out = make_console()
    out.print(f"{', '.join(study.models)}: {plural(len(study.rows), 'cell')}")
    shown = Map.of_study(study)
    if shown.rows:
        headings = ("method", "integrator", *(family.replace("-", " ") for family in shown.families))
        rows = [(*line, *(shown.entry(line, family).text for family in shown.families)) for line in shown.lines]
        show_rows(out, headings, rows, headings, first=2)
        out.print(f"accurate cells of those judged; {LEGEND}", style="dim")
    lines = beside_yardstick(study)
    if len(lines) > 1:
        (families, searched), extremes = families_beside(lines), extremes_beside(lines)
        headings = (
            *("methods", "integrator", *(family.replace("-", " ") for family in families)),
            *(f"step, {family}" for family in searched),
            *(f"up to, {family}" for family in extremes),
        )
        cells = [(", ".join(x.methods), x.integrator, *cells_beside(x, families, searched, extremes)) for x in lines]
        title = (
            "error of lagrange with the same integrator over the error: medians; largest steps that follow [s]; "
            "extreme values up to which runs are accurate"
        )
        show_rows(out, headings, cells, headings[:2], title, first=2)
    if study.limits:
        out.print(
            "largest constant step [s] that follows the motion, and with an error below 1e-3 of the length; >= a bound"
        )
        words = [(x.model, f"{x.family} {x.case}", x.method, x.integrator) for x in study.limits]
        headings = ("model", "case", "method", "integrator", "stable", "accurate")
        show_rows(
            out, headings, [(*a, *x.words) for a, x in zip(words, study.limits, strict=True)], headings[:4], first=4
        )
    for sentence in findings_of_study(study):
        out.print(sentence)
