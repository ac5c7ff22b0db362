"""Validate and assemble a mechanism; show its degrees of freedom."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.base.errors import InputError, fit_lines, plural
from symgen.base.escapes import printable
from symgen.cli import BAD_INPUT, OK, write_json
from symgen.cli._shared_options import examples_in_help, json_option, setting_options
from symgen.describe.bounds.bounded_modes import one_sided_rows
from symgen.describe.bounds.by_reaction import pressed_rows
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.modal_body import MANY_MODES

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.describe.files.problems import Problem
    from symgen.describe.mechanism import Mechanism

#: Problems of a file that are written to standard error at most; JSON has all.
MOST_SHOWN = 100


@click.command(
    "check",
    epilog=examples_in_help("symgen check four-bar", "symgen check crane.toml --set length=2 --draw crane.svg"),
)
@click.argument("model")
@setting_options("parameters", "start", "strict")
@click.option("--draw", "picture", metavar="FILE", help="Also draw the mechanism into FILE: .svg, .png or .pdf.")
@json_option
def command(
    model: str,
    parameters: dict[str, float],
    start: dict[str, float],
    strict: bool,
    picture: str | None,
    as_json: bool,
) -> int:
    """Validate MODEL, assemble it, and show its degrees of freedom, rank and redundant rows.

    All errors of a mechanism file are written to standard error, each with its line.

    --draw also draws a mechanism that does not close: the picture shows its last position and the open joints.
    """
    from symgen.api import load

    try:
        loaded = load(model)
    except InputError as error:
        if error.file is not None and (found := _problems_of_file(error.file)):
            return _write_problems(model, found, as_json)
        raise
    if picture is not None:
        from symgen.base.files import check_path
        from symgen.describe.drawing.drawing import PICTURES

        file = check_path("--draw", Path(picture), PICTURES, "plot")
        loaded.draw(parameters, start).save(file)
        if not as_json:
            click.echo(f"written: {file}", err=True)
    facts = _facts_of_assembly(loaded, parameters, start, strict)
    if as_json:
        write_json(facts)
        return OK
    sizes = facts["sizes"]
    click.echo(f"{facts['mechanism']}: valid, and it closes")
    parts = (("bodies", "body", "bodies"), ("joints", "joint", ""), ("forces", "force", ""))
    click.echo("  " + ", ".join(plural(sizes[of], one, many) for of, one, many in parts))
    click.echo(
        f"  {plural(sizes['coordinates'], 'coordinate')}, "
        f"{plural(sizes['rows'], 'constraint row')} of rank {facts['rank']}"
    )
    click.echo(f"  {plural(facts['degrees_of_freedom'], 'degree')} of freedom at the start")
    if facts["contacts"]:
        click.echo(f"  {plural(len(facts['contacts']), 'contact')}: {', '.join(facts['contacts'])}")
    for body, modes in facts.get("modal_bodies", {}).items():
        click.echo(f"  {body}: {_modes_in_words(modes)}")
    for label, rows in (("redundant at the start", facts["redundant_rows"]), ("repeated", facts["dropped_rows"])):
        if rows:
            click.echo(f"  rows {label}: {', '.join(rows)}")
    for note in facts["notes"]:
        click.echo(f"  note: {note}")
    for warning in facts["warnings"]:
        click.echo(f"  warning: {warning}")
    return OK


def _modes_in_words(modes: Mapping[str, Any]) -> str:
    """Return the modes of a body, where they come from, and the frequencies of the free body."""
    inner, faces = modes["inner"], len(modes["interfaces"])
    count = len(modes["frequencies"])
    what = f"{inner} of the free body"
    if faces:
        each = (count - inner) // (faces - 1) if faces > 1 else 0
        of_interfaces = f"{count - inner} of {plural(faces, 'interface')}"
        what = f"{of_interfaces}{f', {each} ({faces} - 1)' if each else ''}, and {inner} inside"
    hertz = ", ".join(f"{x:.4g}" for x in modes["frequencies"][:6]) + (", ..." if count > 6 else "")
    names = f" ({', '.join(modes['interfaces'])})" if faces else ""
    centre = ", ".join(f"{x:.4g}" for x in modes["centre_of_mass"])
    many = f"; more than {MANY_MODES} modes make each evaluation slow" if count > MANY_MODES else ""
    return (
        f"{plural(count, 'mode')}, {what}{names}; free at {hertz} Hz; {modes['mass']:.6g} kg about [{centre}] m{many}"
    )


def _problems_of_file(file: Path) -> Sequence[Problem]:
    """Return what is wrong in a file; nothing if it was changed into a valid one in the meantime."""
    from symgen.describe.files.load import read_text
    from symgen.describe.files.origins import Source
    from symgen.describe.files.problems import problems_of_text

    return problems_of_text(read_text(file), Source.of_file(file))


def _write_problems(file: str, found: Sequence[Problem], as_json: bool) -> int:
    """Write the problems of a file, to standard error and, on request, as JSON; return the exit code."""
    shown = fit_lines(len(found), MOST_SHOWN)
    for problem in found[:shown]:
        click.echo(printable(f"{file}:{problem.line}: {problem}"), err=True)
    if len(found) > shown:
        click.echo(f"{file}: {len(found) - shown} more", err=True)
    if as_json:
        keys = ("line", "where", "expected", "got", "hint")
        write_json({"errors": [{key: getattr(problem, key) for key in keys} for problem in found]})
    return BAD_INPUT


def _facts_of_assembly(
    loaded: Model, parameters: dict[str, float], held: dict[str, float], strict: bool
) -> dict[str, Any]:
    """Return the facts of an assembled mechanism: sizes, rank, degrees of freedom, redundant rows and notes."""
    compiled = loaded.compile()
    start = loaded.assemble(compiled, parameters, strict=strict, held=held)
    info, mechanism = compiled.info, loaded.mechanism
    q, v = info.parts(start.y)
    return {
        "mechanism": loaded.name,
        "title": mechanism.title,
        "sizes": {
            "bodies": sum(body.carried is None for body in mechanism.bodies),
            "joints": len(mechanism.joints),
            "forces": len(mechanism.forces),
            "parameters": len(mechanism.parameters) - len(mechanism.inputs),
            "inputs": len(mechanism.inputs),
            "coordinates": info.nq,
            "velocities": info.nv,
            "rows": info.m,
        },
        "rank": start.rank,
        "degrees_of_freedom": info.nv - start.rank,
        **({"modal_bodies": _facts_of_modes(mechanism)} if mechanism.has_modal_bodies else {}),
        "contacts": list(dict.fromkeys(row.name for row in one_sided_rows(mechanism) if row.in_contact)),
        "redundant_rows": list(start.redundant_rows),
        "dropped_rows": list(info.dropped_rows),
        "notes": list(start.notes),
        "warnings": [*mechanism.remarks, *start.warnings, *_shared_losses(mechanism, start.redundant_rows)],
        "start": {
            "q": {each.name: float(x) for each, x in zip(info.coordinates, q, strict=True)},
            "v": {each.name: float(x) for each, x in zip(info.velocities, v, strict=True)},
        },
    }


def _shared_losses(mechanism: Mechanism, redundant: Sequence[str]) -> Iterator[str]:
    """Yield a sentence on each loss by the reaction of a joint whose rows other joints repeat, as runs refuse it."""
    for row in pressed_rows(mechanism):
        joint = row.row.partition(".")[0]
        if shared := [name for name in redundant if name.startswith(f"{joint}.")]:
            yield (
                f"runs refuse {row.family.one} of {joint}, as other joints share its reaction: {', '.join(shared)} are "
                "redundant; a joint with fewer rows determines it, such as 'perpendicular' in place of 'prismatic'"
            )


def _facts_of_modes(mechanism: Mechanism) -> dict[str, Any]:
    """Return what the files of modal bodies have, by body."""
    return {
        body.name: {
            "inner": body.modal.inner,
            "interfaces": [x.name for x in mechanism.bodies if x.carried is not None and x.carried.host == body.name],
            "frequencies": [math.sqrt(k / body.modal.mass) / math.tau for k in body.modal.stiffness],
            "mass": body.modal.mass,
            "centre_of_mass": [evaluate_formula(e, {}) for e in body.centre_of_mass],
        }
        for body in mechanism.bodies
        if body.modal is not None
    }
