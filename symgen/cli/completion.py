"""Print the shell's completion script."""

from __future__ import annotations

import click

from symgen.cli import OK, group
from symgen.cli._shared_options import examples_in_help

_HOW = {
    "bash": '# put into ~/.bashrc:  eval "$(symgen completion bash)"',
    "zsh": '# put into ~/.zshrc:  eval "$(symgen completion zsh)"',
    "fish": "# save as ~/.config/fish/completions/symgen.fish",
}
#: Shell -> lines of click's script -> lines that add no blank after a word that goes on: ``mass=``, ``models/``.
_OPEN = {
    "bash": {
        "            COMPREPLY+=($value)\n": "            COMPREPLY+=($value)\n"
        "            [[ $value == *[=/] ]] && compopt -o nospace\n"
    },
    "zsh": {
        "        compadd -U -V unsorted -a completions\n": "        local -a open=(${(M)completions:#*[=/]})\n"
        "        completions=(${completions:#*[=/]})\n"
        "        compadd -U -V unsorted -a completions\n"
        "        compadd -U -S '' -V open -a open\n"
    },
    # words of a list contain commas
    "fish": {'(string split "," $completion)': '(string split -m 1 "," $completion)'},
}


@click.command(
    "completion",
    epilog=examples_in_help("symgen completion bash >> ~/.bashrc"),
)
@click.argument("shell", type=click.Choice(list(_HOW)))
def command(shell: str) -> int:
    """Print the completion script of bash, zsh or fish."""
    from click.shell_completion import get_completion_class

    kind = get_completion_class(shell)
    assert kind is not None, "click completes these shells"
    # not source(), which checks the version of the local bash: the script may be for another machine
    script = kind.source_template % kind(group, {}, "symgen", "_SYMGEN_COMPLETE").source_vars()
    for line, further in _OPEN.get(shell, {}).items():
        script = script.replace(line, further)
    click.echo(f"{_HOW[shell]}\n{script}")
    return OK
