"""Commands of analyses, made from the declarations in their files: options and output."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import click

from symgen.analyses.kinds import ANALYSES, AnalysisTable, Option
from symgen.base.errors import InputError, quote
from symgen.base.settings import Settings
from symgen.cli import FAILURE, OK, write_complaint, write_files, write_json
from symgen.cli._shared_options import (
    check_output_file,
    examples_in_help,
    json_option,
    numbers_in_si,
    read_assignments,
    read_column_names,
    read_comma_list,
    read_time_list,
    refuse_same_file,
    setting_options,
    write_note,
)

#: Kinds of options that are files to write.
FILES = ("plot", "tables")
#: Kind of an option -> its arguments for click; others are one text.
OF_KIND: dict[str, dict[str, Any]] = {
    "switch": {"is_flag": True},
    "whole": {"type": int},
    "texts": {"multiple": True},
    "columns": {"multiple": True},
    "numbers": {"multiple": True},
}


def command_of_analysis(name: str) -> click.Command:
    """Return the command of the analysis called `name`."""
    analysis = ANALYSES.get(name)

    def run_analysis(model: str, as_json: bool, **values: Any) -> int:
        from symgen.api import load

        values = {name: _in_si(name, value, model) for name, value in values.items()}
        settings = Settings(**{o.name: values.pop(o.name) for o in analysis.options if o.is_setting})
        refuse_same_file({o.name: values[o.argument] for o in analysis.options if o.kind in FILES})
        output = analysis.command(lambda: load(model), settings, **values)
        write_note(output.notes)
        if as_json:
            write_json(output.json)
        else:
            for item in output.shown:
                _show_item(item)
        code = write_complaint(output.ended, FAILURE) if output.ended else OK
        return write_files(code, output.files, None if as_json else lambda path: click.echo(f"written: {path}"))

    command: Callable[..., int] = json_option(run_analysis)
    for option in reversed(analysis.options):
        command = _make_option(option)(command)
    decorate = click.command(name, help=analysis.command.__doc__, epilog=examples_in_help(*analysis.examples))
    return decorate(click.argument("model")(command))


def _make_option(option: Option) -> Callable[[Callable[..., int]], Callable[..., int]]:
    if option.is_setting:
        return setting_options(option.name, text={option.name: option.help} if option.help else None)
    further = OF_KIND.get(option.kind, {})
    if option.default is not None:
        further = {"default": option.default, "show_default": True}
    return click.option(
        *(option.name, option.argument),
        help=option.help,
        metavar=option.metavar or None,
        callback=lambda context, parameter, value: _read_option(option, value),
        **further,
    )


def _read_option(option: Option, value: Any) -> Any:
    """Return the value of an option for an analysis, from its text."""
    flag, kind = option.name, option.kind
    if kind == "words":
        return read_comma_list(flag, value)
    if kind == "columns":
        return read_column_names(flag, value)
    if kind == "numbers":
        return read_assignments(flag, value)
    if kind == "place":
        return read_assignments(flag, value.split(",")) if "=" in value else value
    if kind in FILES:
        return check_output_file(flag, value, kind)
    if value is not None and kind in ("times", "range"):
        return read_time_list(flag, value) if kind == "times" else _read_range(flag, value)
    return value


@dataclass(frozen=True)
class _Range:
    """Values of something that varies, as typed: option, name and text."""

    flag: str
    name: str
    text: str


def _in_si(name: str, value: object, model: str) -> Any:
    """Return the value of an option with its numbers in SI units."""
    if not isinstance(value, _Range):
        return numbers_in_si(f"--{name}", value, (model,))
    from symgen.describe.facts.typed_units import units_of_number
    from symgen.describe.files.load import load_mechanism
    from symgen.study.ensemble.axes import axis_values

    units = units_of_number(load_mechanism(model), value.name)
    return value.name, axis_values(value.text, f"{value.flag} {value.name}", units)


def _read_range(flag: str, text: str) -> _Range:
    """Return name and values of a word such as ``crank.theta=lin(0,6.28,25)``.

    Raises
    ------
    InputError
        If it has another form.
    """
    from symgen.study.ensemble.axes import check_axis

    name, equals, values = text.partition("=")
    if not equals or not name.strip() or not values.strip():
        raise InputError(flag, "NAME=VALUES, such as crank.theta=lin(0,6.28,25)", quote(text))
    check_axis(values.strip(), f"{flag} {name.strip()}")
    return _Range(flag, name.strip(), values.strip())


def _show_item(item: str | AnalysisTable | Mapping[str, Mapping[str, Any]]) -> None:
    from symgen.cli._tables import make_console, show_quantities, show_rows

    if isinstance(item, str):
        click.echo(item)
    elif isinstance(item, AnalysisTable):
        show_rows(make_console(), item.headings, item.rows, item.left)
    else:
        show_quantities(item)
