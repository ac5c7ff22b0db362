"""Write a commented mechanism file to start from."""

from __future__ import annotations

from pathlib import Path

import click

from symgen.cli import OK
from symgen.cli._shared_options import examples_in_help


@click.command(
    "new",
    epilog=examples_in_help("symgen new crane", "symgen new robot --space spatial"),
)
@click.argument("name")
@click.option("-o", "--output", metavar="FILE", help="File to write; NAME.toml by default, - for standard output.")
@click.option(
    "--space",
    type=click.Choice(["planar", "spatial"]),
    default="planar",
    help="Planar, or in space.  [default: planar]",
)
def command(name: str, output: str | None, space: str) -> int:
    """Write a commented mechanism file that runs without changes and shows every key. Never overwrites a file."""
    from symgen.base.files import check_writable, write_whole
    from symgen.describe.edits.template import new_file_text

    text = new_file_text(name, space)
    if output == "-":
        click.echo(text, nl=False)
        return OK
    path = Path(f"{name}.toml" if output is None else output)
    check_writable("-o", path)
    write_whole(path, text, replace=False)
    click.echo(f"wrote {path}; try: symgen run {_typed_path(path)}")
    return OK


def _typed_path(path: Path) -> str:
    """Return a path as it can be typed: in quotes where a shell would part it, and never like an option."""
    import shlex

    return shlex.quote(f"./{path}" if str(path).startswith("-") else str(path))
