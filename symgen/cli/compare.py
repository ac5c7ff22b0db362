"""``symgen compare MODEL``: error against run time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from symgen.cli import FAILURE, INTERRUPTED, OK, complain, write_json
from symgen.cli._options import assignments, number_list, numbers, option_pairs, output_file, words

if TYPE_CHECKING:
    from symgen.study.compare import Study


@click.command("compare", short_help="Compare methods and integrators: error against run time.")
@click.argument("models", metavar="MODEL...", nargs=-1, required=True)
@click.option("--methods", metavar="A,B", help="Methods; all unless given.")
@click.option("--integrators", metavar="A,B", help="Integrators; all unless given.")
@click.option("--steps", metavar="H,H", help="Constant steps [s]; multiples of the mechanism's own unless given.")
@click.option("--rtols", metavar="R,R", help="Relative tolerances of adaptive integrators.")
@click.option("--until", type=float, help="End time [s].")
@click.option("--output-step", type=float, help="Time between the outputs that are compared [s].")
@click.option("--set", "changed", multiple=True, metavar="NAME=VALUE", help="Value of a parameter of the mechanism.")
@click.option("--option", "options", multiple=True, metavar="KEY=VALUE", help="Option, such as baumgarte.alpha=10.")
@click.option("--repeat", type=int, default=3, show_default=True, help="Timed runs a row; the shortest counts.")
@click.option("--csv", "csv_file", metavar="FILE", help="Write the rows to a CSV file.")
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
    csv_file: str | None,
    as_json: bool,
) -> int:
    """Run every MODEL with every method, integrator, step and tolerance; show error against run time.

    The error is the largest distance [m] to a reference motion, over bodies, output times and points (centre of mass,
    and tips of the axes at the body's own length). Integrators with an error estimate run at --rtols, the others at
    --steps.
    """
    numbers(until=until, output_step=output_step)
    step_list, rtol_list = number_list("--steps", steps), number_list("--rtols", rtols)
    method_list, integrator_list = words("--methods", methods), words("--integrators", integrators)
    parameters, chosen = assignments("--set", changed), option_pairs(options)
    path = output_file("--csv", csv_file)

    from symgen.api import load
    from symgen.cli._progress import Bar
    from symgen.study.compare import compare, save_csv

    loaded = [load(model) for model in models]
    studies: list[Study] = []
    for model in loaded:
        with Bar(model.name, 1.0) as bar:

            def progress(what: str, reached: float, total: float, bar: Bar = bar, name: str = model.name) -> None:
                bar.title = f"{name}: {what}"
                bar(reached / total)

            studies.append(
                compare(
                    model,
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
                )
            )
        if studies[-1].interrupted:
            break
    if as_json:
        found = [study.to_json() for study in studies]
        write_json(found[0] if len(models) == 1 else {"studies": found})
    else:
        from symgen.cli._tables import show_study

        for study in studies:
            show_study(study)
    if path is not None:
        save_csv(studies, path)
    return _exit_code(studies)


def _exit_code(studies: list[Study]) -> int:
    if studies[-1].interrupted:
        return complain("interrupted; the rows that were done are kept", INTERRUPTED)
    for study in studies:
        if study.failed:
            return complain(f"{study.mechanism}: every run failed", FAILURE)
    return OK
