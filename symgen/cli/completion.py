"""Print the shell's completion script."""

from __future__ import annotations

import click

from symgen.cli import OK, group
from symgen.cli._options import examples

_HOW = {
    "bash": '# put into ~/.bashrc:  eval "$(symgen completion bash)"',
    "zsh": '# put into ~/.zshrc:  eval "$(symgen completion zsh)"',
    "fish": "# save as ~/.config/fish/completions/symgen.fish",
}


@click.command(
    "completion",
    epilog=examples("symgen completion bash >> ~/.bashrc"),
)
@click.argument("shell", type=click.Choice(list(_HOW)))
def command(shell: str) -> int:
    """Print the completion script of bash, zsh or fish."""
    from click.shell_completion import get_completion_class

    kind = get_completion_class(shell)
    assert kind is not None, "click completes these shells"
    # not source(), which checks the version of the local bash: the script may be for another machine
    script = kind.source_template % kind(group, {}, "symgen", "_SYMGEN_COMPLETE").source_vars()
    click.echo(f"{_HOW[shell]}\n{script}")
    return OK
