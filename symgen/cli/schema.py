"""Print the JSON schema of mechanism files."""

from __future__ import annotations

import click

from symgen.cli import OK
from symgen.cli._options import examples


@click.command(
    "schema",
    epilog=examples("symgen schema > symgen.schema.json"),
)
def command() -> int:
    """Print the JSON schema (draft 2020-12) of mechanism files; editors complete and check files with it."""
    import json

    from symgen.describe.files.schema import schema

    click.echo(json.dumps(schema(), indent=2))
    return OK
