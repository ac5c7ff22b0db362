"""The command line: one module a command, imported at its first use, and what commands share.

Exit codes: 0 done, 1 a simulation or study failed, 2 bad input, 130 interrupted. Results go to standard output, and
with ``--json`` nothing but JSON does; everything else goes to standard error. SIGTERM interrupts as Ctrl-C does.

In: arguments of the command line.
Out: text, JSON and files, an exit code.
Imports: click, msgspec, NumPy; rich for tables; all rooms.
"""

from __future__ import annotations

import atexit
import gc
import os
import re
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import click

from symgen.analyses.kinds import ANALYSES
from symgen.base.errors import InputError, SymgenError
from symgen.base.escapes import printable
from symgen.base.locales import choose_locale
from symgen.base.plugins import failure_of_plugin, load_plugins
from symgen.base.registry import Registry
from symgen.base.settings import command_flag, setting_names
from symgen.base.units import read_amount, read_unit
from symgen.base.version import __version__
from symgen.cli._meant import hint_on_choice, hint_on_command, hint_on_extra, hint_on_option

OK, FAILURE, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130
#: Number of new objects before the first garbage collection; imports create about as many.
FIRST = 100_000

#: Commands in the order of the help; others come last.
ORDER = (
    *("list", "new", "edit", "import", "check", "draw", "view", "inspect", "generate", "run"),
    *("equilibrium", "modes", "linearise", "kinematics", "inverse", "identify", "design", "synthesize"),
    *("report", "compare", "stress", "sweep", "schema", "cache", "completion"),
)

#: Arguments of studies and sweeps that are options, beside the settings.
LISTS = {
    **{name: f"--{name}" for name in ("methods", "integrators", "steps", "rtols", "cases", "scheduler")},
    "reference_by": "--reference",
}
_ARGUMENT = re.compile("`([a-z][a-z_]*)`")
#: Commands that use no kinds of joints, forces, methods or integrators.
WITHOUT_PLUGINS = ("cache", "completion")
#: Commands beside the analyses that write numbers for readers.
LOCALISED = ("view", "run", "design", "synthesize", "report", "compare", "stress", "sweep")

#: Commands that are files of this folder; every analysis is one as well.
OWN: Registry[click.Command] = Registry(__name__, "command", attribute="command")
COMMANDS = tuple(sorted((*OWN, *ANALYSES), key=lambda name: (ORDER.index(name) if name in ORDER else len(ORDER), name)))


class LazyGroup(click.Group):
    """A group that imports a command when it is used and reads one line about each without doing so."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return all names in the order of the help."""
        return [*COMMANDS]  # the built-in `list` is hidden by the command of that name once it is imported

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import and return a command, None if no command has that name."""
        if cmd_name not in COMMANDS:
            return None
        if cmd_name in OWN:
            command = OWN.get(cmd_name)
        else:
            from symgen.cli._analyses import command_of_analysis

            command = command_of_analysis(cmd_name)
        command.short_help = summary_of_command(cmd_name)
        if cmd_name not in WITHOUT_PLUGINS and not any(p.name == "plugin" for p in command.params):
            command.params.append(_plugin_option())
        if (cmd_name in LOCALISED or cmd_name in ANALYSES) and not any(p.name == "locale" for p in command.params):
            command.params.append(_locale_option())
        if ctx.resilient_parsing:  # the shell completes a line
            from symgen.cli._completing import complete_with

            for parameter in command.params:
                complete_with(parameter)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command, or suggest the nearest name."""
        if args and args[0] not in COMMANDS and not args[0].startswith("-") and not ctx.resilient_parsing:
            hint = hint_on_command(args[0], COMMANDS)
            if not hint.startswith("did") and _is_model(args[0]):
                hint = f"did you mean 'symgen run {args[0]}'?"
            raise click.UsageError(f"there is no command '{args[0]}'; {hint}", ctx)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the table without importing anything."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, summary_of_command(name)) for name in COMMANDS])


def _plugin_option() -> click.Option:
    """Return the option that loads plugin files before the rest of a command is read."""
    return click.Option(
        ["--plugin"],
        multiple=True,
        metavar="FILE.py",
        is_eager=True,
        expose_value=False,
        # a key press that completes a line runs no file
        callback=lambda context, parameter, paths: None if context.resilient_parsing else load_plugins(paths),
        help="Run a Python file that registers methods, integrators, joints or forces of your own.",
    )


def _locale_option() -> click.Option:
    """Return the option that chooses how numbers for readers are written."""
    return click.Option(
        ["--locale"],
        metavar="NAME",
        is_eager=True,
        expose_value=False,
        callback=lambda context, parameter, name: None if context.resilient_parsing else choose_locale(name),
        help="Write decimal marks, thousands and dates for readers as in NAME, such as de; data files stay.",
    )


def summary_of_command(name: str) -> str:
    """Return the line of a command in ``symgen --help``: the first one of its file."""
    return (OWN if name in OWN else ANALYSES).summary(name)


@click.group(
    cls=LazyGroup,
    context_settings={"help_option_names": ["-h", "--help"]},
    no_args_is_help=True,
    epilog="\b\nExamples:\n  symgen run four-bar\n  symgen view four-bar -o four-bar.html\n  symgen new crane",
)
@click.version_option(__version__, message="symgen %(version)s")
def group() -> None:
    """Compile constrained multibody mechanisms into code and run them.

    MODEL is a name of the catalogue (symgen list), with a size where it has one (n-four-bar:40), or the path of a
    mechanism file.
    """


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        Words after ``symgen``; by default those of this process.
    """
    if arguments is None:  # this process does nothing else
        spare_collections()
        _open_streams()
        # what libraries announce to their callers fails no run, whatever PYTHONWARNINGS says
        warnings.filterwarnings("ignore", category=DeprecationWarning)
        warnings.filterwarnings("ignore", category=FutureWarning)
    # a terminated run keeps its results, as with Ctrl-C; only the main thread may set handlers
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        code = group.main(args=arguments, prog_name="symgen", standalone_mode=False)
        sys.stdout.flush()
        return code if isinstance(code, int) else OK
    except click.exceptions.NoArgsIsHelpError as error:
        error.show()
        return BAD_INPUT
    except click.ClickException as error:
        return write_complaint(_sentence_of_error(error), BAD_INPUT)
    except InputError as error:
        from symgen.describe.files.problems import sentence_with_line

        return write_complaint(sentence_with_line(error), error.exit_code)
    except SymgenError as error:
        return write_complaint(str(error), error.exit_code)
    except (click.Abort, KeyboardInterrupt):
        return write_complaint("interrupted", INTERRUPTED)
    except MemoryError:
        return write_complaint("there is not enough memory for that", FAILURE)
    except (BrokenPipeError, SystemExit) as error:  # click makes the second of the first
        if (failure := failure_of_plugin(error)) is not None:
            return write_complaint(str(failure), failure.exit_code)
        # the reader of our output is gone: nothing more can be written, and Python must not try at exit
        _forget_stdout()
        return OK
    except OSError as error:
        if error.filename is not None:  # no failure of our own output, and of no file that has a sentence of its own
            raise
        _forget_stdout()
        return write_complaint(f"standard output cannot be written ({error.strerror})", FAILURE)
    except Exception as error:
        if (failure := failure_of_plugin(error)) is None:
            raise
        return write_complaint(str(failure), failure.exit_code)


def write_complaint(sentence: str, code: int) -> int:
    """Write one sentence to standard error; return `code`."""
    with suppress(OSError):  # standard error may be closed, or full
        click.echo(f"symgen: {printable(in_terms_of_options(sentence))}", err=True)
    return code


def in_terms_of_options(sentence: str) -> str:
    """Return a message of the package in terms of the command line.

    Names of arguments are written as options: `verify` as ``--verify``, and so is the place that a sentence begins
    with where it is a setting or one of `LISTS`.
    """
    place, colon, rest = sentence.partition(": ")
    if colon and (place in setting_names() or place in LISTS):
        sentence = f"{_option_name(place)}: {rest}"
    return _ARGUMENT.sub(lambda match: _option_name(match[1]), sentence)


def _option_name(argument: str) -> str:
    return (
        command_flag(argument)
        if argument in setting_names()
        else LISTS.get(argument) or f"--{argument.replace('_', '-')}"
    )


def write_files(
    code: int, files: Mapping[Path | None, Callable[[Path], object]], say: Callable[[Path], None] | None = None
) -> int:
    """Write files at the end of a command, each independent of the others, and report failures.

    Parameters
    ----------
    code : int
        Exit code of the command so far.
    files : mapping
        Path -> function that writes it; None is a file that was not requested.
    say : callable, optional
        Called with each file that was written.

    Returns
    -------
    int
        The exit code.
    """
    failed = 0
    for path, write in files.items():
        if path is not None:
            try:
                write(path)
                if say is not None:
                    say(path)
            except SymgenError as error:
                failed = write_complaint(str(error), error.exit_code)
    return code or failed


def _sentence_of_error(error: click.ClickException) -> str:
    text = " ".join(error.format_message().split())
    context = getattr(error, "ctx", None)
    if isinstance(error, click.NoSuchOption):
        options = [o for p in context.command.params for o in p.opts] if context is not None else []
        hint = hint_on_option(error.option_name, [o for o in options if o.startswith("--")])
        text = f"there is no option '{error.option_name}'" + (f"; {hint}" if hint else "")
    elif isinstance(error, click.BadParameter) and (number := _NOT_A_NUMBER.search(text)):
        text = text[: number.start()].rstrip() + f" expected a number, got '{number[1]}'{_hint_on_number(number[1])}"
    elif isinstance(error, click.BadParameter) and (choice := _NOT_A_CHOICE.search(text)):
        text = text.rstrip(".") + hint_on_choice(choice[1], re.findall(r"'([^']*)'", choice[2]))
    elif extra := _EXTRA.search(text):
        text = text.rstrip(".") + hint_on_extra(extra[1])
    elif context is not None and isinstance(context.command, click.Group) and (unknown := _NO_COMMAND.search(text)):
        text = (
            f"there is no command '{unknown[1]}'; {hint_on_command(unknown[1], context.command.list_commands(context))}"
        )
    help_at = f" (symgen {context.info_name} --help)" if context is not None and context.parent is not None else ""
    return text[:1].lower() + text[1:].rstrip(".") + help_at


def _is_model(word: str) -> bool:
    """Return whether a word is a file of a mechanism or a name of the catalogue."""
    from symgen.describe.catalogue import all_names

    return word.endswith(".toml") or word in all_names()


def _hint_on_number(word: str) -> str:
    """Return the number that a word with a unit or a decimal comma means."""
    comma = re.fullmatch(r"([-+]?\d+),(\d+)", word)
    amount = None if comma else read_amount(word)
    if comma:
        return f"; a number has a decimal point: {comma[1]}.{comma[2]}"
    if amount is None or not amount.unit:
        return ""
    unit = read_unit(amount.unit)
    return "" if isinstance(unit, str) else f"; numbers of options are in SI units: {unit.to_si(amount.number):g}"


#: What click says of a word that is no number, and of one that is none of a few.
_NOT_A_NUMBER = re.compile(r"'([^']*)' is not a valid (?:float|integer)(?: range)?\.?$")
_NOT_A_CHOICE = re.compile(r"'([^']*)' is not one of (.*)$")
#: What it says of a word too many, and of an unknown command of a command.
_EXTRA = re.compile(r"unexpected extra arguments? \(([^ )]*)")
_NO_COMMAND = re.compile(r"No such command '([^']*)'")


def spare_collections() -> None:
    """Exclude imported objects from garbage collection, and all objects when the process ends.

    Modules, classes and functions live as long as the process. Python looks through them some hundred and eighty times
    while they are imported, and twice more before it ends, which took a third of a short run.
    """
    usual = gc.get_threshold()

    def after_first_collection(phase: str, info: dict[str, Any]) -> None:
        gc.callbacks.remove(after_first_collection)
        gc.freeze()
        gc.set_threshold(*usual)

    gc.callbacks.append(after_first_collection)
    gc.set_threshold(FIRST, *usual[1:])
    atexit.register(gc.freeze)


def _open_streams() -> None:
    """Open the standard streams of a process that was started with closed ones."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # open until the process ends


def _forget_stdout() -> None:
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def write_json(value: object) -> None:
    """Write a value as JSON to standard output; nan and infinity are refused."""
    import json

    click.echo(json.dumps(value, allow_nan=False))
