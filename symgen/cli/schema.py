"""Print the JSON schema of mechanism files."""

from __future__ import annotations

import click

from symgen.cli import OK
from symgen.cli._shared_options import examples_in_help


@click.command(
    "schema",
    epilog=examples_in_help("symgen schema > symgen.schema.json"),
)
def command() -> int:
    """Print the JSON schema (draft 2020-12) of mechanism files; editors complete and check files with it."""
    import json

    from symgen.describe.files.json_schema import file_schema

    click.echo(json.dumps(file_schema(), indent=2))
    return OK
