"""``symgen list``: the mechanisms that come with symgen."""

from __future__ import annotations

import click

from symgen.cli import OK, write_json
from symgen.cli._options import json_option


@click.command("list", short_help="Show the mechanisms that come with symgen.")
@json_option
def command(as_json: bool) -> int:
    """Show the mechanisms that come with symgen, with their sources and what a run of them uses by default."""
    from symgen import catalogue

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

    from symgen.cli._tables import console

    table = Table(box=None, header_style="dim", pad_edge=False)
    for heading in ("name", "what", "until [s]", "step [s]", "source"):
        table.add_column(heading, justify="right" if heading.endswith("[s]") else "left")
    for row in rows:
        name = f"{row['name']}:{row['default_size']}" if row["sized"] else row["name"]
        table.add_row(name, row["title"], f"{row['until']:g}", f"{row['step']:g}", row["source"])
    console().print(table)
    return OK
