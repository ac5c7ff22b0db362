"""What ``symgen inspect`` writes as LaTeX, and as a page."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click
import msgspec

from symgen.report.words import counted

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Mechanism
    from symgen.running.prepare import Prepared
    from symgen.settings import Settings


def at_start(model: Model, settings: Settings) -> tuple[Prepared, Mechanism, MethodChoice]:
    """Return a model at its start, as a run has it; raises as `symgen.api.Model.start` does.

    Returns
    -------
    Prepared
        Without outputs, whose integrals are the runtime's.
    Mechanism
        With its tree where coordinates are those of joints.
    MethodChoice
        The method as it is compiled: with the solver that the start asks for.
    """
    from symgen.running.plan import Purpose
    from symgen.running.prepare import prepare

    run = prepare(msgspec.structs.replace(model.mechanism, outputs=()), settings, Purpose.STATE)
    choice, solver = run.plan.choice, str(run.compiled.law.options.get("solver", ""))
    if solver and solver != choice.options["solver"]:  # bodies are light
        choice = choice.given(solver=solver)
    return run, model.mechanism if run.tree is None else run.mechanism, choice


def latex_of(name: str, settings: Settings, select: str | None, symbols: bool, whole: bool) -> str:
    """Return the equations as LaTeX: a document, or a part of one."""
    from symgen.api import Model
    from symgen.compiling.choices import choose_coordinates
    from symgen.describe.load import read_raw
    from symgen.describe.validate import validate
    from symgen.reading.latex_document import document
    from symgen.reading.law import law
    from symgen.reading.lengths import with_symbols

    raw, source = read_raw(name)
    model = Model(validate(with_symbols(raw) if symbols else raw, source))
    values = model.parameters(settings.parameters)
    equations = model.equations_in(choose_coordinates(model.mechanism, settings.coordinates, "straight").name)
    wanted = tuple(item.strip() for item in (select or "").split(",") if item.strip())
    choice = method_of(settings)
    steps = law(choice.method.name, choice.options, equations.derived.driving is not None)
    return document(equations.mechanism, equations.derived, steps, values, wanted, whole)


def method_of(settings: Settings) -> MethodChoice:
    """Return the method with its options, before anything is compiled."""
    from symgen.compiling.pipeline import choose_method

    own = {name.removeprefix("method."): str(value) for name, value in settings.options.items()}
    return choose_method(settings.method, own)


def write_page(name: str, settings: Settings, output: str) -> None:
    """Write the page of a mechanism."""
    from symgen.api import load
    from symgen.errors import AssemblyError
    from symgen.files import check_path, write_whole
    from symgen.player.motion_page import PAGES
    from symgen.reading.listing import text_of
    from symgen.reading.page import MOST_STRAIGHT, EquationPage, check_size

    path = check_path("inspect: -o", Path(output), PAGES, "plot")
    model = load(name)
    check_size(model.mechanism)
    speeds = sum(len(body.speeds) for body in model.mechanism.bodies)
    if settings.shape == "auto" and speeds <= MOST_STRAIGHT:  # whatever a run would take
        settings = replace(settings, shape="straight")
    mechanism, choice, run = model.mechanism, method_of(settings), None
    try:
        run, mechanism, choice = at_start(model, settings)
        degrees = counted(run.compiled.info.nv - run.start.rank, "degree")
        facts = [f"At the start D has rank {run.start.rank}: {degrees} of freedom.", *run.start.notes]
        if run.start.redundant_rows:
            facts.append(f"Redundant at the start: {', '.join(run.start.redundant_rows)}.")
        if settings.coordinates == "auto":
            facts.append(f"Coordinates: {run.plan.coordinates_reason}.")
    except AssemblyError as error:
        facts = [f"It does not close, and is drawn as described: {error}"]
    values = model.parameters(settings.parameters)
    page = EquationPage(model.mechanism, mechanism, choice, values, facts, text_of(name), run)
    written = write_whole(path, page.html())
    click.echo(f"{written}  {written.stat().st_size} bytes")
