"""List mechanisms, methods, integrators, joints or forces."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import click

from symgen.base.registry import Registry
from symgen.cli import OK, write_json
from symgen.cli._shared_options import examples_in_help, json_option

#: Terminals of this width show sources in a further column.
WIDE = 120


#: Where the registries of kinds are.
_ROOMS = {"methods": "derive", "integrators": "run", "joints": "describe", "forces": "describe"}
KINDS = tuple(_ROOMS)


def registry_of_kinds(kinds: str) -> Registry[Any]:
    """Return the registry of a kind of kinds, such as ``methods``."""
    registry: Registry[Any] = getattr(import_module(f"symgen.{_ROOMS[kinds]}.{kinds}"), kinds.upper())
    return registry


@click.command(
    "list",
    epilog=examples_in_help("symgen list", "symgen list methods", "symgen list --json"),
)
@click.argument("what", type=click.Choice(("mechanisms", *KINDS)), default="mechanisms")
@json_option
def command(what: str, as_json: bool) -> int:
    """Show the mechanisms that come with symgen, with their sources and the default settings of a run.

    Or WHAT is methods, integrators, joints or forces: names with a line about each, those of plugins among them.
    """
    if what != "mechanisms":
        listing = registry_of_kinds(what).listing()
        if as_json:
            write_json({what: [{"name": name, "summary": line} for name, line in listing.items()]})
        else:
            click.echo(str(listing))
        return OK

    from symgen.describe import catalogue

    rows = []
    for entry in (*catalogue.entries(), *catalogue.entries(catalogue.MACHINES)):
        run = catalogue.raw(entry.name).get("run", {})
        rows.append(
            {
                "name": entry.name,
                "title": entry.title,
                "source": entry.source,
                "group": entry.group,
                "sized": entry.sized,
                "default_size": entry.default_size,
                "until": run.get("until"),
                "step": run.get("step"),
                "output_step": run.get("output_step"),
                "predictable_until": run.get("predictable_until"),
            }
        )
    if as_json:
        write_json({"mechanisms": rows})
        return OK
    from rich.table import Table

    from symgen.cli._tables import make_console

    out = make_console()
    names = [f"{row['name']}:{row['default_size']}" if row["sized"] else str(row["name"]) for row in rows]
    table = Table(box=None, header_style="dim", pad_edge=False)
    # names are typed by users: they stay whole, and sentences take the remaining width
    table.add_column("name", no_wrap=True, min_width=max(map(len, names)))
    table.add_column("what", ratio=1, overflow="fold")
    for heading in ("until [s]", "step [s]"):
        table.add_column(heading, justify="right", no_wrap=True, min_width=len(heading))
    wide = out.width >= WIDE
    if wide:
        table.add_column("source", ratio=1, overflow="fold")
    for name, row in zip(names, rows, strict=True):
        more = (row["source"],) if wide else ()
        table.add_row(name, row["title"], f"{row['until']:g}", f"{row['step']:g}", *more)
    out.print(table)
    return OK
