"""Validate and assemble a mechanism; show its degrees of freedom."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from symgen.base.errors import counted
from symgen.cli import OK, write_json
from symgen.cli._options import examples, json_option, setting_options


@click.command(
    "check",
    epilog=examples("symgen check four-bar", "symgen check crane.toml --set length=2 --draw crane.svg"),
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

    --draw also draws a mechanism that does not close: the picture shows its last position and the open joints.
    """
    if picture is not None:
        from symgen.api import load
        from symgen.base.files import check_path
        from symgen.drawing.drawing import PICTURES

        file = check_path("--draw", Path(picture), PICTURES, "plot")
        load(model).draw(parameters, start).save(file)
        if not as_json:
            click.echo(f"written: {file}", err=True)
    facts = _facts(model, parameters, start, strict)
    if as_json:
        write_json(facts)
        return OK
    sizes = facts["sizes"]
    click.echo(f"{facts['mechanism']}: valid, and it closes")
    parts = (("bodies", "body", "bodies"), ("joints", "joint", ""), ("forces", "force", ""))
    click.echo("  " + ", ".join(counted(sizes[of], one, many) for of, one, many in parts))
    click.echo(
        f"  {counted(sizes['coordinates'], 'coordinate')}, "
        f"{counted(sizes['rows'], 'constraint row')} of rank {facts['rank']}"
    )
    click.echo(f"  {counted(facts['degrees_of_freedom'], 'degree')} of freedom at the start")
    for label, rows in (("redundant at the start", facts["redundant_rows"]), ("repeated", facts["dropped_rows"])):
        if rows:
            click.echo(f"  rows {label}: {', '.join(rows)}")
    for note in facts["notes"]:
        click.echo(f"  note: {note}")
    for warning in facts["warnings"]:
        click.echo(f"  warning: {warning}")
    return OK


def _facts(model: str, parameters: dict[str, float], held: dict[str, float], strict: bool) -> dict[str, Any]:
    """Return the facts of an assembled mechanism: sizes, rank, degrees of freedom, redundant rows and notes."""
    from symgen.api import load

    loaded = load(model)
    compiled = loaded.compile()
    start = loaded.assemble(compiled, parameters, strict=strict, held=held)
    info, mechanism = compiled.info, loaded.mechanism
    q, v = info.parts(start.y)
    return {
        "mechanism": loaded.name,
        "title": mechanism.title,
        "sizes": {
            "bodies": len(mechanism.bodies),
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
        "redundant_rows": list(start.redundant_rows),
        "dropped_rows": list(info.dropped_rows),
        "notes": list(start.notes),
        "warnings": list(start.warnings),
        "start": {
            "q": {each.name: float(x) for each, x in zip(info.coordinates, q, strict=True)},
            "v": {each.name: float(x) for each, x in zip(info.velocities, v, strict=True)},
        },
    }
