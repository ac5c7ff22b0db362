"""Options of commands, made from the table of settings, and conversion of their words to values."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import click

from symgen.analyses.kinds import check_over
from symgen.base import arguments
from symgen.base.errors import InputError, quoted
from symgen.base.settings import about, default, flag
from symgen.cli import in_options

F = TypeVar("F", bound=Callable[..., Any])

#: Largest number of processes or threads.
MOST_JOBS = 4096


def examples(*lines: str) -> str:
    """Return the examples at the end of a command's help: lines that can be typed as they stand."""
    return "\n".join(["\b", "Examples:", *(f"  {line}" for line in lines)])


def setting_options(
    *names: str, text: Mapping[str, str] | None = None, otherwise: Mapping[str, Any] | None = None
) -> Callable[[F], F]:
    """Return a decorator that gives a command the options of some settings.

    Values arrive under the settings' names, checked.

    Parameters
    ----------
    *names : str
        Names of settings, in the order of the help.
    text : mapping, optional
        Help of settings that have a special meaning in this command.
    otherwise : mapping, optional
        Defaults that differ in this command: a value, or, in brackets, words about the behaviour.
    """

    def decorate(function: F) -> F:
        for name in reversed(names):
            function = _option(name, (text or {}).get(name), (otherwise or {}).get(name))(function)
        return function

    return decorate


def _option(name: str, text: str | None, otherwise: Any) -> Callable[[F], F]:
    setting, usual = about(name), default(name)
    words = otherwise if isinstance(otherwise, str) and otherwise.startswith("(") else setting.otherwise
    value = usual if otherwise is None or words is otherwise else otherwise
    extra: dict[str, Any] = {"help": text or setting.help, "callback": lambda c, p, v: _checked(name, v)}
    if setting.kind is bool:
        named = flag(name)
        if value is None:  # neither on nor off
            named += f"/--no-{named[2:]}"
            extra |= {"default": None, "show_default": words.strip("()")}
        return click.option(named, name, is_flag=True, **extra)
    if setting.kind in (dict, list):
        extra |= {"multiple": True, "metavar": setting.metavar} | ({"default": value} if setting.kind is list else {})
    else:
        extra |= {"type": str if setting.kind is tuple else setting.kind, "default": value}
        extra |= {"metavar": setting.metavar or None, "show_default": words.strip("()") if words else value is not None}
    return click.option(flag(name), name, **extra)


def _checked(name: str, value: Any) -> Any:
    setting, where = about(name), flag(name)
    if value is None:
        return None
    if name in ("parameters", "start"):
        return assignments(where, value)
    if name == "options":
        return {**pairs("--option", value)}
    if name == "inputs":
        return pairs(where, value)
    return setting.check(where, time_list(where, value) if setting.kind is tuple else value)


def jobs_option(text: str) -> Callable[[F], F]:
    """Return the option for the number of processes or threads."""

    def check(context: click.Context, parameter: click.Parameter, value: int | None) -> int | None:
        return None if value is None else arguments.whole("--jobs", value, 1, MOST_JOBS)

    return click.option("--jobs", type=int, callback=check, show_default="one for every core", help=text)


def target_option(text: str) -> Callable[[F], F]:
    """Return the option ``--target``; `text` is its help."""
    from symgen.ir.program import TARGETS

    return click.option("--target", type=click.Choice(TARGETS), default="cpu", show_default=True, help=text)


def quantity_options(shown: str, drawn: str, over: str = "[default: t]") -> Callable[[F], F]:
    """Return a decorator that gives a command ``--quantity``, ``--plot`` and ``--over``.

    Parameters
    ----------
    shown, drawn : str
        What the help says of ``--quantity``, and what ``--plot`` draws.
    over : str
        Default of the horizontal axis in the help.
    """
    options = (
        click.option(
            *("--quantity", "quantities"),
            multiple=True,
            metavar="NAME,NAME",
            help=shown,
            callback=lambda context, parameter, value: column_names("--quantity", value),
        ),
        click.option("--plot", metavar="FILE", help=f"Draw {drawn} into FILE: .png, .svg or .pdf."),
        click.option("--over", metavar="NAME", help=f"Draw over NAME, such as crank.theta.  {over}"),
    )

    def decorate(function: F) -> F:
        for option in reversed(options):
            function = option(function)
        return function

    return decorate


def column_names(option: str, texts: Sequence[str]) -> tuple[str, ...]:
    """Return the names of comma-separated lists; commas in brackets are part of a name, as in ``C(B, D)``."""
    names = [part.strip() for text in texts for part in re.split(r",(?![^(]*\))", text)]
    if not all(names):
        raise InputError(option, "names separated by commas", quoted(",".join(texts)))
    return tuple(names)


def plotted(plot: str | None, over: str | None) -> Path | None:
    """Return the file of ``--plot``; ``--over`` alone is refused."""
    path = output_file("--plot", plot, "plot")
    check_over(over, path)
    return path


def units_option(function: F) -> F:
    """Give a command the option ``--units``."""
    return click.option("--units", is_flag=True, help="Write units into the header of a CSV file: error [m].")(function)


def json_option(function: F) -> F:
    """Give a command the option ``--json``."""
    return click.option("--json", "as_json", is_flag=True, help="Write JSON to standard output, and nothing else.")(
        function
    )


def pairs(option: str, texts: Sequence[str], form: str = "NAME=VALUE") -> dict[str, str]:
    """Return the values of ``NAME=VALUE`` words by name; names may not repeat."""
    values = dict[str, str]()
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not equals or not name or not value:
            raise InputError(option, form, quoted(text))
        if name in values:
            raise InputError(f"{option} {name}", "each name once", "it twice")
        values[name] = value
    return values


def assignments(option: str, texts: Sequence[str]) -> dict[str, float]:
    """Return the numbers of ``NAME=VALUE`` words by name.

    Raises
    ------
    InputError
        If a word has another form, a name repeats or a value is not a finite number.
    """
    texts_by_name = pairs(option, texts)
    return {name: _number(f"{option} {name}", "a finite number", value) for name, value in texts_by_name.items()}


def _number(where: str, expected: str, text: str, above: float = -math.inf) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > above):
        raise InputError(where, expected, quoted(text))
    return value


def comma_list(option: str, text: str | None) -> tuple[str, ...]:
    """Return the words of a comma-separated list, empty without one."""
    if text is None:
        return ()
    parts = tuple(part.strip() for part in text.split(","))
    if not all(parts):
        raise InputError(option, "words separated by commas", quoted(text))
    return parts


def number_list(option: str, text: str | None) -> tuple[float, ...]:
    """Return the numbers of a comma-separated list, each finite and above 0."""
    expected = "finite numbers above 0, separated by commas"
    return tuple(_number(option, expected, word, 0.0) for word in comma_list(option, text))


def output_file(option: str, text: str | None, kind: str = "") -> Path | None:
    """Return the path of a file, after checking that it can be written.

    Parameters
    ----------
    option, text : str
        The option and its value; None gives None.
    kind : str
        ``"data"`` of runs, ``"tables"`` of analyses, ``"plot"``, or nothing for any ending.

    Raises
    ------
    InputError
        If the ending is not known, the library for it is missing, or the folder cannot be written.
    """
    if text is None:
        return None
    from symgen.base.files import check_path, check_writable
    from symgen.result.export import COLUMNS, PLOTTED, SAVED

    path = Path(text)
    if kind:
        endings = {"data": SAVED, "tables": COLUMNS, "plot": PLOTTED}[kind]
        check_path(option, path, endings, "plot" if kind == "plot" else "data")
    else:
        check_writable(option, path)
    return path


def differ(files: Mapping[str, Path | None]) -> None:
    """Refuse one file for two outputs, as the second would overwrite the first.

    Parameters
    ----------
    files : mapping
        Options and their files, None without a file.
    """
    owners = dict[str, str]()
    for option, path in files.items():
        if path is None:
            continue
        real = os.path.realpath(path)
        if real in owners:
            raise InputError(option, f"another file than {owners[real]} has", f"'{path}' for both")
        owners[real] = option


def tell(notes: Iterable[str]) -> None:
    """Write a remark on the results to standard error."""
    for sentence in notes:
        click.echo(f"symgen: {in_options(sentence)}", err=True)


def time_list(option: str, text: str) -> tuple[float, ...]:
    """Return the times of ``lin(0, 1, 101)`` or of a comma-separated list, of any sign.

    Raises
    ------
    InputError
        If it is neither.
    """
    if "(" in text:
        from symgen.ensemble.axes import axis_values

        return tuple(axis_values(text, option).tolist())
    return tuple(
        _number(option, "finite times, separated by commas, or lin(first, last, count)", w)
        for w in comma_list(option, text)
    )
