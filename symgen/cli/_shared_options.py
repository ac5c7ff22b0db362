"""Options of commands, made from the table of settings, and conversion of their words to values."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import wraps
from pathlib import Path
from typing import Any, TypeVar

import click

from symgen.analyses.kinds import check_over
from symgen.base import arguments
from symgen.base.errors import InputError, quote
from symgen.base.settings import command_flag, default_of_setting, setting_description
from symgen.base.units import read_amount
from symgen.cli import in_terms_of_options

F = TypeVar("F", bound=Callable[..., Any])

#: Largest number of processes or threads.
MOST_JOBS = 4096


def examples_in_help(*lines: str) -> str:
    """Return the examples at the end of a command's help: lines that can be typed as they are."""
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
        if not TYPED.isdisjoint(names):
            function = _in_units_of_file(function)
        for name in reversed(names):
            function = _make_option(name, (text or {}).get(name), (otherwise or {}).get(name))(function)
        return function

    return decorate


#: Settings whose numbers are typed in the units of the file.
TYPED = frozenset({"parameters", "start"})


def _in_units_of_file(function: F) -> F:
    """Return a command that has its typed numbers in SI units."""

    @wraps(function)
    def command(*args: object, **values: object) -> Any:
        for name in sorted(TYPED & values.keys()):
            values[name] = numbers_in_si(command_flag(name), values[name], _models_of_command(values))
        return function(*args, **values)

    return command  # type: ignore[return-value]  # takes and returns the same


def _models_of_command(values: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the models of a command: its argument, several arguments, or the model of a saved result."""
    named = values.get("described") or values.get("model") or values.get("what")
    return tuple(values["models"]) if "models" in values else (named,) if isinstance(named, str) else ()


def numbers_in_si(option: str, numbers: object, models: Sequence[str]) -> Any:
    """Return numbers by name in SI units: as typed, parameters are in the unit of the file.

    Parameters
    ----------
    option, numbers : str, mapping
        The option and its numbers; anything else than typed numbers is returned as it is.
    models : sequence of str
        Models as typed; a name means the same unit in all that have it.

    Raises
    ------
    InputError
        If a unit is none, or none of the quantity, or models have different ones for a name.
    """
    from symgen.describe.facts.typed_units import Typed, notes_on_units, typed_numbers_in_si

    if not isinstance(numbers, Mapping) or not any(isinstance(x, Typed) for x in numbers.values()):
        return numbers
    from symgen.describe.files.load import load_mechanism

    mechanisms = [load_mechanism(model) for model in models if not model.lower().endswith(".nc")]
    found = [typed_numbers_in_si(mechanism, numbers, option) for mechanism in mechanisms]
    for other in found[1:]:
        name = next((name for name, x in other.items() if x != found[0][name]), None)
        if name is not None:
            raise InputError(f"{option} {name}", "one unit in all files", "several", "type the unit behind the number")
    write_note(f"{option} {sentence}" for sentence in (notes_on_units(mechanisms[0], numbers) if found else ()))
    return found[0] if found else {name: float(x) for name, x in numbers.items()}


def _make_option(name: str, text: str | None, otherwise: object) -> Callable[[F], F]:
    setting, usual = setting_description(name), default_of_setting(name)
    words = otherwise if isinstance(otherwise, str) and otherwise.startswith("(") else setting.otherwise
    value = usual if otherwise is None or words is otherwise else otherwise
    extra: dict[str, Any] = {"help": text or setting.help, "callback": lambda c, p, v: _check_value(name, v)}
    if setting.kind is bool:
        named = command_flag(name)
        if value is None:  # neither on nor off
            named += f"/--no-{named[2:]}"
            extra |= {"default": None, "show_default": words.strip("()")}
        return click.option(named, name, is_flag=True, **extra)
    if setting.kind in (dict, list):
        extra |= {"multiple": True, "metavar": setting.metavar} | ({"default": value} if setting.kind is list else {})
    else:
        extra |= {"type": str if setting.kind is tuple else setting.kind, "default": value}
        extra |= {"metavar": setting.metavar or None, "show_default": words.strip("()") if words else value is not None}
    return click.option(command_flag(name), name, **extra)


def _check_value(name: str, value: Any) -> Any:
    setting, where = setting_description(name), command_flag(name)
    if value is None:
        return None
    if name in ("parameters", "start"):
        return read_assignments(where, value)
    if name == "options":
        return {**read_pairs("--option", value)}
    if name == "inputs":
        return read_pairs(where, value)
    return setting.check(where, read_time_list(where, value) if setting.kind is tuple else value)


def jobs_option(text: str) -> Callable[[F], F]:
    """Return the option for the number of processes or threads."""

    def check_jobs(context: click.Context, parameter: click.Parameter, value: int | None) -> int | None:
        return None if value is None else arguments.whole_number("--jobs", value, 1, MOST_JOBS)

    return click.option("--jobs", type=int, callback=check_jobs, show_default="one for every core", help=text)


def target_option(text: str) -> Callable[[F], F]:
    """Return the option ``--target``; `text` is its help."""
    from symgen.base.ir.program import TARGETS

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
            callback=lambda context, parameter, value: read_column_names("--quantity", value),
        ),
        click.option("--plot", metavar="FILE", help=f"Draw {drawn} into FILE: .png, .svg, .pdf or .pgf."),
        click.option("--over", metavar="NAME", help=f"Draw over NAME, such as crank.theta.  {over}"),
    )

    def decorate(function: F) -> F:
        for option in reversed(options):
            function = option(function)
        return function

    return decorate


def read_column_names(option: str, texts: Sequence[str]) -> tuple[str, ...]:
    """Return the names of comma-separated lists; commas in brackets are part of a name, as in ``C(B, D)``."""
    names = [part.strip() for text in texts for part in re.split(r",(?![^(]*\))", text)]
    if not all(names):
        raise InputError(option, "names separated by commas", quote(",".join(texts)))
    return tuple(names)


def read_plot_file(plot: str | None, over: str | None) -> Path | None:
    """Return the file of ``--plot``; ``--over`` alone is refused."""
    path = check_output_file("--plot", plot, "plot")
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


def read_pairs(option: str, texts: Sequence[str], form: str = "NAME=VALUE") -> dict[str, str]:
    """Return the values of ``NAME=VALUE`` words by name; names may not repeat."""
    values = dict[str, str]()
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not equals or not name or not value:
            colon = re.fullmatch(r"([\w.]+)\s*:\s*(\S+)", text)
            hint = f"did you mean {colon[1]}={colon[2]}?" if colon and form == "NAME=VALUE" else ""
            raise InputError(option, form, quote(text), hint)
        if form == "NAME=VALUE" and "=" in value:
            raise InputError(option, f"{form} once", quote(text), _hint_on_pairs(option, name, value))
        if name in values:
            raise InputError(f"{option} {name}", "each name once", "it twice")
        values[name] = value
    return values


def _hint_on_pairs(option: str, name: str, value: str) -> str:
    """Return what a word with several signs ``=`` means: one too many, or several assignments in one word."""
    if value.startswith("="):
        return f"did you mean {name}={value.lstrip('= ')}?"
    pairs = [part.strip() for part in re.split(r"[;,]", f"{name}={value}")]
    separate = all(re.fullmatch(r"[\w.]+\s*=[^=]+", pair) for pair in pairs)
    return f"did you mean {' '.join(f'{option} {pair}' for pair in pairs)}?" if separate else ""


def read_assignments(option: str, texts: Sequence[str]) -> dict[str, float]:
    """Return the numbers of ``NAME=VALUE`` words by name, as typed, see `numbers_in_si`.

    Raises
    ------
    InputError
        If a word has another form, a name repeats or a value is not a finite number.
    """
    texts_by_name = read_pairs(option, texts)
    return {name: _typed_number(f"{option} {name}", value) for name, value in texts_by_name.items()}


def _typed_number(where: str, text: str) -> float:
    """Return a finite number that may have a unit."""
    from symgen.describe.facts.typed_units import Typed

    amount = read_amount(text)
    if amount is None or not math.isfinite(amount.number):
        return _number_above(where, "a finite number", text)
    return Typed.from_amount(amount)


def _number_above(where: str, expected: str, text: str, above: float = -math.inf) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > above):
        comma = re.fullmatch(r"\s*([-+]?\d+),(\d+)\s*", text)
        hint = f"a number has a decimal point: {comma[1]}.{comma[2]}" if comma else ""
        raise InputError(where, expected, quote(text), hint)
    return value


def read_comma_list(option: str, text: str | None) -> tuple[str, ...]:
    """Return the words of a comma-separated list, empty without one."""
    if text is None:
        return ()
    parts = tuple(part.strip() for part in text.split(","))
    if not all(parts) or (";" in text and "," not in text):
        hint = f"did you mean {','.join(part.strip() for part in text.split(';'))}?" if ";" in text else ""
        raise InputError(option, "words separated by commas", quote(text), hint)
    return parts


def read_number_list(option: str, text: str | None) -> tuple[float, ...]:
    """Return the numbers of a comma-separated list, each finite and above 0."""
    expected = "finite numbers above 0, separated by commas"
    return tuple(_number_above(option, expected, word, 0.0) for word in read_comma_list(option, text))


def check_output_file(option: str, text: str | None, kind: str = "") -> Path | None:
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


def refuse_same_file(files: Mapping[str, Path | None]) -> None:
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


def write_note(notes: Iterable[str]) -> None:
    """Write a remark on the results to standard error."""
    for sentence in notes:
        click.echo(f"symgen: {in_terms_of_options(sentence)}", err=True)


def read_time_list(option: str, text: str) -> tuple[float, ...]:
    """Return the times of ``lin(0, 1, 101)`` or of a comma-separated list, of any sign.

    Raises
    ------
    InputError
        If it is neither.
    """
    if "(" in text:
        from symgen.study.ensemble.axes import axis_values

        return tuple(axis_values(text, option, ("s", "s")).tolist())
    expected = "finite times, separated by commas, or lin(first, last, count)"
    if ":" in text:
        from symgen.study.ensemble.axes import meant_axis

        raise InputError(option, expected, quote(text), meant_axis(text))
    return tuple(_number_above(option, expected, w) for w in read_comma_list(option, text))
