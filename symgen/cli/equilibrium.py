"""``symgen equilibrium MODEL``: where a mechanism rests, and whether it stays there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from symgen.cli import OK, write_json
from symgen.cli._options import examples, json_option, setting_options, tell
from symgen.errors import InputError
from symgen.settings import Settings

if TYPE_CHECKING:
    from symgen.analyses.equilibrium import Equilibrium


@click.command(
    "equilibrium",
    short_help="Find where a mechanism rests, and whether it stays there.",
    epilog=examples(
        "symgen equilibrium four-bar", 'symgen equilibrium four-bar --scan "crank.theta=lin(0,6.28,25)" --json'
    ),
)
@click.argument("model")
@click.option("--scan", metavar="NAME=lin(A,B,N)", help="Find all equilibria over a range of a coordinate.")
@click.option("--steady", is_flag=True, help="Find the steady motion that the start leads to instead of a rest.")
@setting_options("parameters", "start", "coordinates", "shape")
@json_option
def command(model: str, scan: str | None, steady: bool, as_json: bool, **asked: Any) -> int:
    """Find the equilibrium that the start of MODEL leads to.

    The equilibrium near the start is found whatever its stability; from further away a stable one. With --scan the
    coordinate is held at one value after the other, and equilibria are where the force that this takes changes its
    sign. Drivers hold what they drive where it is at the time 0. With --steady cyclic coordinates turn on at their
    speed at the start.
    """
    from symgen.api import load
    from symgen.cli._analyses import axis

    settings = Settings(**asked)
    if scan is not None and steady:
        raise InputError("--scan", "an equilibrium at rest", "--steady as well")
    loaded = load(model)
    if scan is not None:
        found = loaded.equilibria(axis("--scan", scan), settings)
    else:
        found = (loaded.steady(settings) if steady else loaded.equilibrium(settings),)
    tell(dict.fromkeys(note for equilibrium in found for note in equilibrium.notes))
    if as_json:
        write_json({"mechanism": loaded.name, "equilibria": [e.to_dict() for e in found]})
        return OK
    for equilibrium in found:
        _show(equilibrium)
    return OK


def _show(found: Equilibrium, most: int = 40) -> None:
    from rich.table import Table

    from symgen.cli._tables import console

    squares = ", ".join(f"{x:.6g}" for x in found.omega_squared[:8]) + (", ..." if len(found.omega_squared) > 8 else "")
    click.echo(f"{found.stability}; omega^2 [1/s^2]: {squares or 'nothing can move'}")
    click.echo(f"  {found.iterations} steps, largest force that is not balanced {found.residual:.3g}")
    if found.not_unique:
        click.echo(f"  reactions are not unique at {', '.join(found.not_unique)}")
    for title, values in (("coordinate", found.q), ("multiplier", found.multipliers)):
        table = Table(box=None, header_style="dim", pad_edge=False)
        table.add_column(title)
        table.add_column("value", justify="right")
        for name, value in list(values.items())[:most]:
            table.add_row(name, f"{value:.9g}")
        if values:
            console().print(table)
        if len(values) > most:
            click.echo(f"... and {len(values) - most} more; --json has all")
