"""Edit a mechanism file beside its moving picture."""

from __future__ import annotations

import click

from symgen.cli import OK
from symgen.cli._shared_options import examples_in_help


@click.command(
    "edit",
    epilog=examples_in_help("symgen edit crane.toml", "symgen edit --new crane", "symgen edit four-bar --no-browser"),
)
@click.argument("model", required=False)
@click.option("--new", metavar="NAME", help="Begin NAME.toml, with the text that symgen new writes.")
@click.option("--no-browser", is_flag=True, help="Print the address instead of opening it.")
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port of this computer.  [a free one]")
def command(model: str | None, new: str | None, no_browser: bool, port: int) -> int:
    """Edit the file MODEL beside its moving picture: every error at its line, points that can be dragged.

    A name of the catalogue begins a copy, NAME.toml, in this folder. The file is written on Save alone. The page is
    served to this computer alone, at an address with a secret; Ctrl-C ends it.
    """
    from symgen.base.errors import InputError
    from symgen.base.files import system_message
    from symgen.cli._editor.edited_file import Document
    from symgen.cli._editor.server import Editor

    document = Document.of_arguments(model, new)
    try:
        server = Editor(document, port)
    except OSError as error:
        raise InputError("--port", "a port that is free", f"{port} ({system_message(error)})") from None
    with server:
        click.echo(server.address)
        server.prepare()
        if not no_browser:
            import webbrowser

            webbrowser.open(server.address)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            click.echo("ended", err=True)
    return OK
