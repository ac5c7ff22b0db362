"""Inputs of a run: numbers, formulas and data in place of the names that a mechanism declares.

A formula of t, or a table of data, takes the place of the name before equations are derived, so that every stage of a
step sees it where it stands. Conditions on t in it become numbers of their own, *switches*, that a run sets between
pieces: inside a piece nothing jumps.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from symgen.base import arguments
from symgen.base.errors import InputError, nearest, quoted
from symgen.base.files import check_rows
from symgen.base.units import SI, Unit, read_amount, unit_of
from symgen.base.vocabulary.expressions import BENT, ZERO, Call, Expr, Name, Number, call, names_in, readings, table_of
from symgen.base.vocabulary.measures import FormulaMeasure
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.formulas.readings import Readings
from symgen.describe.mechanism import Mechanism, Parameter
from symgen.describe.parts.scope import Context
from symgen.describe.tables import Table

T = TypeVar("T")
#: Parts of a mechanism whose formulas may read inputs.
_READING = ("forces", "states", "outputs", "events")
_COMPARISONS = ("lt", "le", "gt", "ge")


@dataclass(frozen=True)
class Jump:
    """Where a formula of t changes: where `argument` passes a level.

    Attributes
    ----------
    argument : Expr
        Of t and parameters.
    levels : tuple of float
        Values at which it changes.
    switch : str
        The parameter that selects the side; empty where both sides are equal there, as at a kink.
    value : Expr
        Value of the switch.
    period : float
        Period of the levels, 0 without one.
    derivative : int
        The lowest derivative that may jump there: that of a piecewise polynomial; else 0, whatever it is.
    """

    argument: Expr
    levels: tuple[float, ...] = (0.0,)
    switch: str = ""
    value: Expr = ZERO
    period: float = 0.0
    derivative: int = 0


@dataclass(frozen=True)
class DrivenMechanism:
    """A mechanism with the inputs of a run.

    Attributes
    ----------
    mechanism : Mechanism
        With formulas and data in the place of names; slots of all inputs stay, switches stand behind them.
    numbers : mapping of str to float
        Inputs that are held.
    samples : mapping of str to Data
        Inputs that are held from one sample to the next.
    curves : mapping of str to Data
        Inputs that are smooth between samples, and nothing beyond them.
    jumps : tuple of Jump
        Of all formulas.
    descriptions : mapping of str to str or float
        Every input of the mechanism in words, or its number.
    declared : Mechanism
        With the names of inputs where these are read.
    """

    mechanism: Mechanism
    numbers: Mapping[str, float]
    samples: Mapping[str, Data]
    curves: Mapping[str, Data]
    jumps: tuple[Jump, ...]
    descriptions: Mapping[str, str | float]
    declared: Mechanism

    @property
    def varied(self) -> Mechanism:
        """The mechanism whose inputs are their formulas and data plus the values in their slots."""
        beside = {name: call("add", e, Name(name)) for name, e in self.mechanism.input_formulas}
        parts = {part: with_formulas(getattr(self.declared, part), beside) for part in _READING}
        return msgspec.structs.replace(self.mechanism, **parts)


def driven(mechanism: Mechanism, sources: Mapping[str, Any]) -> DrivenMechanism:
    """Return a mechanism with the inputs of a run.

    Parameters
    ----------
    mechanism : Mechanism
        Declares inputs.
    sources : mapping
        By name: a number; a text, which is a number, a formula of t, parameters and state, or
        ``FILE.csv:COLUMN[:INTERPOLATION]``; a pair of times and values; or a mapping of one of these, see
        `symgen.describe.parts.inputs.data_of`.

    Raises
    ------
    InputError
        If a name is not an input, or its value has none of these forms.
    """
    declared = {p.name: p for p in mechanism.parameters if p.input}
    inputs = {name: p.value for name, p in declared.items()}
    numbers, samples, curves, formulas = dict[str, float](), dict[str, Data](), dict[str, Data](), dict[str, Expr]()
    words: dict[str, str | float] = dict(inputs)
    tables, jumps = list(mechanism.tables), list[Jump]()
    for name, value in sources.items():
        where = f"input '{name}'"
        if name not in inputs:
            hint = nearest(name, inputs) if inputs else "it declares none, in a section [inputs]"
            raise InputError(where, f"an input of {mechanism.name}", "none of that name", hint)
        own = declared[name].own_unit
        data = data_of(where, value, own)
        if data is None and not isinstance(value, str):
            numbers[name] = words[name] = arguments.number(where, value)
        elif data is None:
            number = _number(value, where, declared[name])
            if number is None:
                formula, words[name] = parse(value, _names(mechanism), where), value
                formulas[name] = formula if own.is_si else call("mul", Number(float(own.factor)), formula)
            else:
                numbers[name] = words[name] = arguments.number(where, number)
        else:
            words[name] = data.words
            if data.interpolation == "hold":
                samples[name] = data
            else:
                table = data.table(where, name)
                if data.interpolation != "linear":
                    curves[name] = data
                tables.append(table)
                formulas[name] = Call(table.function, (Name("t"),))
    _check_gaps(mechanism, samples, formulas)
    with_tables = msgspec.structs.replace(mechanism, tables=tuple(tables))
    changed = {name: _Switching(with_tables, name, jumps).expression(e) for name, e in formulas.items()}
    switches = tuple(Parameter(j.switch, 0.0, input=True) for j in jumps if j.switch)
    if not changed:
        return DrivenMechanism(mechanism, numbers, samples, curves, (), words, mechanism)
    parts = {part: with_formulas(getattr(with_tables, part), changed) for part in _READING}
    parts["bounded"] = with_formulas(with_tables.bounded, formulas)  # what jumps in them is found there
    parameters, put_in = (*with_tables.parameters, *switches), tuple(changed.items())
    whole = msgspec.structs.replace(with_tables, **parts, parameters=parameters, input_formulas=put_in)
    return DrivenMechanism(whole, numbers, samples, curves, tuple(jumps), words, with_tables)


def _check_gaps(mechanism: Mechanism, samples: Mapping[str, Data], formulas: Mapping[str, Expr]) -> None:
    """Refuse inputs by which gaps would jump, or depend on more than the time.

    Raises
    ------
    InputError
        With the first of them.
    """
    for name in sorted(inputs_of_gaps(mechanism)):
        expected, hint = f"a number, a formula of t or data between samples, as gaps read {name}", ""
        if name in samples:
            raise InputError(f"input '{name}'", expected, "data that are held", "interpolation linear, pchip or cubic")
        formula = formulas.get(name, ZERO)
        timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
        if any(readings(formula)) or not set(names_in(formula)) <= timely:
            raise InputError(f"input '{name}'", expected, "a formula of the state", hint)


def inputs_of_gaps(mechanism: Mechanism) -> dict[str, str]:
    """Return the inputs that gaps read, each with what such a row is."""
    found = dict[str, str]()
    for row in mechanism.bounded:
        if isinstance(row.measure, FormulaMeasure):
            found |= {name: row.family.one for name in names_in(row.measure.of) if name in mechanism.inputs}
    return found


def with_formulas(value: T, formulas: Mapping[str, Expr]) -> T:
    """Return a part of a mechanism with formulas in the place of inputs."""
    return replaced(value, lambda e: formulas.get(e.name, e)) if formulas else value


def replaced(value: T, by: Callable[[Name], Expr]) -> T:
    """Return a part of a mechanism with names replaced in all of its formulas."""
    if isinstance(value, Name):
        return by(value)  # type: ignore[return-value]  # an expression for an expression
    if isinstance(value, Call):
        return Call(value.function, tuple(replaced(a, by) for a in value.arguments))  # type: ignore[return-value]
    if isinstance(value, tuple):
        return tuple(replaced(item, by) for item in value)  # type: ignore[return-value]
    if isinstance(value, msgspec.Struct):
        return type(value)(**{field: replaced(getattr(value, field), by) for field in value.__struct_fields__})
    return value


def _number(text: str, where: str, parameter: Parameter) -> float | None:
    """Return the number of a text in SI units; without a unit it has the unit of the file; None for a formula."""
    amount = read_amount(text)
    if amount is not None:
        return amount.in_si(where, parameter.unit, parameter.shown)
    try:
        return float(text)
    except ValueError:
        return None


def _names(mechanism: Mechanism) -> FormulaNames:
    """Return the names that the formula of an input may use."""
    plain = {p.name: p.name for p in mechanism.parameters if not p.input} | {"t": "t"}
    plain |= {x.name: x.name for x in mechanism.states}
    bodies = {body.name: body.coordinates + body.speeds for body in mechanism.bodies}
    what = "a number or an expression of t, parameters and body coordinates"
    hints = dict.fromkeys(mechanism.inputs, "an input does not depend on others")
    tables = {table.name: table.function for table in mechanism.tables}
    readings = Readings(Context.of(mechanism))
    return FormulaNames(what, plain, bodies, tables, frozenset(mechanism.inputs), readings=readings, hints=hints)


def compared(e: Call) -> Expr:
    """Return the expression that a comparison, `sign`, `abs`, `min` or `max` compares with zero."""
    return e.arguments[0] if len(e.arguments) == 1 else call("sub", *e.arguments)


class _Switching:
    """Removes the jumps from one formula, and records them and its kinks."""

    def __init__(self, mechanism: Mechanism, name: str, jumps: list[Jump]) -> None:
        self.tables = {table.name: table for table in mechanism.tables}
        self.timely = frozenset(p.name for p in mechanism.parameters if not p.input) | {"t"}
        self.name, self.jumps, self.switches = name, jumps, dict[Expr, Expr]()

    def expression(self, e: Expr) -> Expr:
        """Return a formula in which nothing jumps within a piece."""
        if not isinstance(e, Call):
            return e
        arguments = tuple(self.expression(a) for a in e.arguments)
        if "t" in (used := set(names_in(e))) and used <= self.timely:
            if e.function in (*_COMPARISONS, "sign"):
                return self.switch(e)
            table = self.tables.get(table_of(e.function) or "")
            if e.function in BENT:
                self.note(Jump(compared(e)))
            elif table is not None and table.interpolation != "cubic" and len(table.x) <= MOST_KNOTS:
                self.note(Jump(e.arguments[0], table.x))
        return Call(e.function, arguments)

    def note(self, jump: Jump) -> None:
        """Record a kink, where it depends on t."""
        if "t" in set(names_in(jump.argument)):
            self.jumps.append(jump)

    def switch(self, e: Call) -> Expr:
        """Return the replacement of a condition or a sign: a number that the run sets."""
        if e not in self.switches:
            name = f"{self.name}~{sum(1 for j in self.jumps if j.switch) + 1}"  # no name of a file
            self.jumps.append(Jump(compared(e), switch=name, value=e))
            number = Name(name)
            self.switches[e] = number if e.function == "sign" else Call("gt", (number, Number(0.5)))
        return self.switches[e]


#: Maximum number of points of a table at which a run halts; a longer one is evaluated as it is.
MOST_KNOTS = 100_000


INTERPOLATIONS = ("hold", "linear", "cubic", "pchip")
#: Maximum bytes of a data file.
LARGEST_FILE = 50_000_000
_FILE = re.compile(r"(?P<file>.+\.csv):(?P<column>[^:]+)(?::(?P<how>[^:]*))?", re.IGNORECASE)
_WORDS = re.compile(rf".* \(({'|'.join(INTERPOLATIONS)})\)", re.DOTALL)
_HEADING = re.compile(r"\s*(?P<name>.*?)\s*(?:\[(?P<unit>[^\]]*)\]\s*)?")


@dataclass(frozen=True)
class Data:
    """Samples of an input.

    Attributes
    ----------
    t, u : tuple of float
        Times, increasing [s], and values.
    interpolation : str
        ``hold``: each value until the next one; else see `symgen.describe.tables.Table`.
    words : str
        Description for people.
    """

    t: tuple[float, ...]
    u: tuple[float, ...]
    interpolation: str
    words: str

    def table(self, where: str, name: str) -> Table:
        """Return the data as a table of t."""
        if self.interpolation == "cubic" and len(self.t) < 4:
            raise InputError(where, "four samples or more for interpolation 'cubic'", f"{len(self.t)}")
        return Table(name, self.t, self.u, self.interpolation)

    def at(self, time: float) -> float:
        """Return the sample that is held at a time."""
        from bisect import bisect_right

        return self.u[max(0, bisect_right(self.t, time) - 1)]


def data_of(where: str, value: object, unit: Unit = SI) -> Data | None:
    """Return the data of an input in SI units, None where it is a number or a formula.

    Parameters
    ----------
    where : str
        The input, for the message.
    unit : Unit
        Unit of a column of a file whose heading has none; times and values of Python are in SI units.
    value : object
        ``"FILE.csv:COLUMN"`` or ``"FILE.csv:COLUMN:INTERPOLATION"``; a pair of times and values; or a mapping with the
        keys ``t`` and ``u``, or ``file`` and ``column``, and with ``interpolation``, which is linear by default.

    Raises
    ------
    InputError
        If the data are missing or invalid.
    """
    if isinstance(value, str):
        match = _FILE.fullmatch(value.strip())
        return None if match is None else _read(where, match["file"], match["column"].strip(), match["how"], unit)
    if isinstance(value, Mapping):
        return _of_mapping(where, value, unit)
    if isinstance(value, list | tuple) or len(getattr(value, "shape", "")) > 0:
        pair = [*value]  # type: ignore[misc]  # an array of dimensions can be walked through
        if len(pair) != 2:
            raise InputError(where, "a pair of times and values", arguments.shown(value))
        return _checked(where, pair[0], pair[1], "linear", "")
    return None


def _of_mapping(where: str, value: Mapping[Any, Any], unit: Unit) -> Data:
    keys = ("t", "u", "file", "column", "interpolation")
    entries = arguments.mapping(where, value, "t and u, or file and column, and interpolation")
    for key in entries:
        if key not in keys:
            raise InputError(where, f"the keys {', '.join(keys)}", f"the unknown key {quoted(key)}", nearest(key, keys))
    how = arguments.one_of(f"{where} interpolation", entries.get("interpolation", "linear"), INTERPOLATIONS)
    pairs = [pair for pair in (("t", "u"), ("file", "column")) if any(key in entries for key in pair)]
    if len(pairs) != 1 or not all(key in entries for key in pairs[0]):
        raise InputError(where, "either t and u or file and column", ", ".join(entries) or "no keys")
    if "t" in entries:
        return _checked(where, entries["t"], entries["u"], how, "")
    file = arguments.path(f"{where} file", entries["file"])
    return _read(where, str(file), arguments.text(f"{where} column", entries["column"]), how, unit)


def _read(where: str, file: str, column: str, how: str | None, unit: Unit) -> Data:
    """Return a column of a file, over its column ``t`` or ``time``, or its first one, in SI units."""
    how = arguments.one_of(f"{where} interpolation", how or "linear", INTERPOLATIONS)
    path = Path(file)
    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "an error"
        raise InputError(f"{where}: {file}", "a file that can be read", reason) from None
    if len(content) > LARGEST_FILE:
        raise InputError(f"{where}: {path.name}", f"a file of at most {LARGEST_FILE} bytes", "a larger one")
    try:
        rows = [row for row in csv.reader(content.decode("utf-8-sig").splitlines()) if any(map(str.strip, row))]
    except (UnicodeDecodeError, csv.Error):
        raise InputError(f"{where}: {path.name}", "a CSV file in UTF-8", "something else") from None
    matches = [_HEADING.fullmatch(cell) for cell in rows[0]] if rows else []
    headings = [match["name"] if match else cell for match, cell in zip(matches, rows[0] if rows else (), strict=True)]
    if column not in headings:
        raise InputError(f"{where}: {path.name}", "a column of the file", quoted(column), nearest(column, headings))
    check_rows(f"{where}: {path.name}", headings, rows[1:])
    times = next((headings.index(name) for name in ("t", "time") if name in headings), 0)
    place = headings.index(column)
    if place == times:
        raise InputError(f"{where}: {path.name}", "a column beside that of the times", quoted(column))
    t, u = ([_cell(f"{where}: {path.name}", row, i, k) for k, row in enumerate(rows[1:], 2)] for i in (times, place))
    units = [(m["unit"] or "").strip() if (m := matches[i]) else "" for i in (times, place)]
    of_time = unit_of(units[0], f"{where}: {path.name}", quantity="s") if units[0] else SI
    own = unit_of(units[1], f"{where}: {path.name}", quantity=unit.si) if units[1] and unit.si else unit
    return _checked(where, [*map(of_time.to_si, t)], [*map(own.to_si, u)], how, f"{file}:{column}")


def _cell(where: str, row: list[str], index: int, line: int) -> float:
    text = row[index] if index < len(row) else ""
    try:
        return float(text)
    except ValueError:
        raise InputError(where, "a number in every row", f"{quoted(text)} in row {line}") from None


def _checked(where: str, t: object, u: object, how: str, source: str) -> Data:
    times, values = arguments.numbers(f"{where} times", t), arguments.numbers(f"{where} values", u)
    if len(times) != len(values):
        raise InputError(where, "as many values as times", f"{len(values)} for {len(times)}")
    if len(times) < 2:
        raise InputError(where, "two samples or more", f"{len(times)}")
    for before, after in pairwise(times):
        if not before < after:
            raise InputError(f"{where} times", "increasing times", f"{after!r} after {before!r}")
    return Data(times, values, how, f"{source or f'{len(times)} samples'} ({how})")


def are_words_of_data(text: str | float) -> bool:
    """Return whether the description of an input names data rather than a formula."""
    return isinstance(text, str) and _WORDS.fullmatch(text) is not None
