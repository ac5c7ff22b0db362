"""What ``symgen inspect`` writes whole: a LaTeX document, and a page."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import click
import msgspec

from symgen.errors import InputError

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Mechanism
    from symgen.running.plan import Plan
    from symgen.runtime.assembly import Start
    from symgen.runtime.compiled import CompiledModel


@dataclass(frozen=True)
class Asked:
    """By which method a mechanism is looked at, and how.

    Attributes
    ----------
    method : str or None
        None: the usual one.
    options : mapping
        Of the method.
    parameters : dict
        Values of parameters that differ from the described ones.
    shape, coordinates : str
        As for runs.
    """

    method: str | None
    options: Mapping[str, str]
    parameters: dict[str, float]
    shape: str
    coordinates: str

    @property
    def named(self) -> str:
        """Name of the method."""
        return self.method or "direct-correction"

    def chosen(self) -> MethodChoice:
        """Return the method as it is compiled."""
        from symgen.compiling.pipeline import choose_method

        return choose_method(self.named, self.options)


@dataclass(frozen=True)
class Started:
    """A model at its start, as a run of a method would have it.

    Attributes
    ----------
    plan, choice : Plan, MethodChoice
        What was decided, and the method as it is compiled: with the solver that the start asks for.
    mechanism : Mechanism
        With its tree where coordinates are those of joints.
    compiled : CompiledModel
        The emitted functions; integrals of outputs are the runtime's.
    start : Start
        The consistent start.
    bodies : tuple of float
        Coordinates of bodies there.
    """

    plan: Plan
    choice: MethodChoice
    mechanism: Mechanism
    compiled: CompiledModel
    start: Start
    bodies: tuple[float, ...]

    @classmethod
    def of(cls, model: Model, asked: Asked) -> Started:
        """Return a model at its start; raises as `symgen.api.Model.start` does."""
        from symgen.running.plan import Purpose
        from symgen.running.prepare import make_plan, prepare
        from symgen.settings import Settings

        choice, mechanism = asked.chosen(), model.mechanism
        settings = Settings(
            choice.method.name,
            options={f"method.{k}": v for k, v in asked.options.items()},
            shape=asked.shape,
            coordinates=asked.coordinates,
            parameters=asked.parameters,
        )
        plan = make_plan(mechanism, settings, Purpose.STATE)
        absolute = plan.coordinates == "absolute"
        run = prepare(
            msgspec.structs.replace(mechanism, outputs=()) if absolute else mechanism, settings, Purpose.STATE
        )
        bodies, of_bodies = run.assembled.of_bodies
        q = of_bodies.y[: bodies.info.nq]
        solver = str(run.compiled.law.options.get("solver", ""))
        choice = replace(choice, shape=plan.choice.shape, options=plan.choice.options)
        if solver and solver != choice.options["solver"]:  # bodies are light
            choice = choice.given(solver=solver)
        mechanism = mechanism if absolute else run.mechanism
        return cls(plan, choice, mechanism, run.compiled, run.start, tuple(map(float, q)))


def refuse(wanted: bool, shape: str) -> None:
    """Refuse options that mean nothing together."""
    if not wanted:
        expected = "--format latex --document, with which alone --select and --symbols mean something"
        raise InputError("inspect", expected, "other options")
    if shape == "looped":
        raise InputError("--shape", "straight code, as a document shows the equations of one mechanism", "looped")


def write_document(name: str, asked: Asked, select: str | None, symbols: bool) -> str:
    """Return the equations as a LaTeX document."""
    from symgen.api import Model
    from symgen.compiling.choose_coordinates import choose_coordinates
    from symgen.describe.load import read_raw
    from symgen.describe.validate import validate
    from symgen.reading.document import document
    from symgen.reading.law import law
    from symgen.reading.lengths import with_symbols

    raw, source = read_raw(name)
    model = Model(validate(with_symbols(raw) if symbols else raw, source))
    values = model.parameters(asked.parameters)
    found = model.equations_in(choose_coordinates(model.mechanism, asked.coordinates, "straight").name)
    wanted = tuple(item.strip() for item in (select or "").split(",") if item.strip())
    steps = law(asked.named, asked.options, found.derived.driving is not None)
    return document(found.mechanism, found.derived, steps, values, wanted)


def write_page(name: str, asked: Asked, output: str) -> None:
    """Write the page of a mechanism."""
    from symgen.api import load
    from symgen.errors import AssemblyError
    from symgen.files import check_writable, write_whole
    from symgen.formulate.formulate import formulate
    from symgen.reading.law import law
    from symgen.reading.page import MOST_STRAIGHT, Subject, check_size, page
    from symgen.reading.source import text_of

    path = Path(output)
    if path.suffix.lower() not in (".html", ".htm"):
        raise InputError("inspect: -o", "a name that ends in .html", f"'{path.name}'")
    check_writable("inspect: -o", path)
    model = load(name)
    check_size(model.mechanism)
    speeds = sum(len(body.speeds) for body in model.mechanism.bodies)
    if asked.shape == "auto" and speeds <= MOST_STRAIGHT:  # whatever a run would take
        asked = replace(asked, shape="straight")
    mechanism, choice, q = model.mechanism, asked.chosen(), None
    compiled, begins = None, None
    try:
        started = Started.of(model, asked)
        mechanism, choice, start, q = started.mechanism, started.choice, started.start, started.bodies
        compiled, begins = started.compiled, start
        free = started.compiled.info.nv - start.rank
        degrees = f"{free} degree{'' if free == 1 else 's'} of freedom"
        facts = [f"At the start D has rank {start.rank}: {degrees}.", *start.notes]
        if start.redundant_rows:
            facts.append(f"Redundant at the start: {', '.join(start.redundant_rows)}.")
        if asked.coordinates == "auto":
            facts.append(f"Coordinates: {started.plan.coordinates_reason}.")
    except AssemblyError as error:
        facts = [f"It does not close, and is drawn as described: {error}"]
    equations = formulate(mechanism)
    subject = Subject(
        whole=model.mechanism,
        mechanism=mechanism,
        equations=equations,
        choice=choice,
        law=law(choice.method.name, choice.options, equations.driving is not None),
        values=model.parameters(asked.parameters),
        q=q,
        facts=facts,
        text=text_of(name),
        compiled=compiled,
        start=begins,
    )
    written = write_whole(path, page(subject))
    click.echo(f"{written}  {written.stat().st_size} bytes")
