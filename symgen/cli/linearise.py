"""``symgen linearise MODEL``: a linear system about a state."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from symgen.cli import OK, write_json
from symgen.cli._analyses import place_options
from symgen.cli._options import examples, json_option, tell, words
from symgen.settings import Settings

if TYPE_CHECKING:
    from symgen.analyses.linearise import LinearSystem


@click.command(
    "linearise",
    short_help="Find the linear system x' = A x + B u, y = C x + D u about a state.",
    epilog=examples("symgen linearise pendulum", "symgen linearise bicycle --at start --states lean,steer --json"),
)
@click.argument("model")
@place_options
@click.option("--instantaneous", is_flag=True, help="Give the system of the instant where a motion is not steady.")
@click.option("--by", metavar="NAME,NAME", help="Parameters that are inputs as well: constants, changed once.")
@json_option
def command(
    model: str,
    place: dict[str, Any],
    instantaneous: bool,
    by: str | None,
    as_json: bool,
    **asked: Any,
) -> int:
    """Find the linear system of MODEL about a state of rest or of steady motion.

    Inputs are those of the file, outputs its formulas. A motion in which states change is refused. With --by, columns
    of B and D are derivatives by parameters as well, the states held.
    """
    from symgen.api import load

    loaded = load(model)
    found = loaded.linearise(Settings(**asked), **place, instantaneous=instantaneous, by=words("--by", by))
    tell(found.notes)
    if as_json:
        write_json({"mechanism": loaded.name, **found.to_dict()})
    else:
        _show(found)
    return OK


def _show(found: LinearSystem) -> None:
    from rich.table import Table

    from symgen.cli._tables import console

    matrices = (
        ("x' = A x", found.states, found.states, found.A),
        ("+ B u", found.states, found.inputs, found.B),
        ("y = C x", found.outputs, found.states, found.C),
        ("+ D u", found.outputs, found.inputs, found.D),
    )
    for title, rows, columns, values in matrices:
        if not values.size:
            continue
        table = Table(box=None, header_style="dim", pad_edge=False)
        table.add_column(title)
        for name in columns:
            table.add_column(name, justify="right")
        for name, row in zip(rows, values, strict=True):
            table.add_row(name, *(f"{x:.6g}" for x in row))
        console().print(table)
    if found.left_out:
        click.echo(f"outputs left out, as they depend on more than the states: {', '.join(found.left_out)}")
