"""``symgen new NAME``: a commented mechanism file to start from."""

from __future__ import annotations

from pathlib import Path

import click

from symgen.cli import OK
from symgen.errors import InputError


@click.command("new", short_help="Write a commented mechanism file to start from.")
@click.argument("name")
@click.option("-o", "--output", metavar="FILE", help="File to write; NAME.toml unless given, - for standard output.")
@click.option(
    "--space",
    type=click.Choice(["planar", "spatial"]),
    default="planar",
    help="Planar, or in space; planar if not given.",
)
def command(name: str, output: str | None, space: str) -> int:
    """Write a mechanism file that runs as it is and shows every key, with comments. Never overwrites a file."""
    from symgen.describe.template import template

    text = template(name, space)
    if output == "-":
        click.echo(text, nl=False)
        return OK
    path = Path(f"{name}.toml" if output is None else output)
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise InputError("-o", "the name of a file that does not exist yet", f"'{path}'") from None
    except OSError as error:
        raise InputError("-o", "a file that can be written", f"'{path}' ({error.strerror})") from None
    click.echo(f"wrote {path}; try: symgen run {path}")
    return OK
