"""Inputs of a run: numbers, formulas and data in place of the names that a mechanism declares.

A formula of t, or a table of data, takes the place of the name before equations are derived, so that every stage of a
step sees it at its place. Conditions on t in it become numbers of their own, *switches*, that a run sets between
pieces: inside a piece nothing jumps.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

import msgspec

from symgen.base import arguments
from symgen.base.errors import InputError, suggest
from symgen.base.units import read_amount
from symgen.base.vocabulary.expressions import (
    BENT,
    ZERO,
    Call,
    Expr,
    Name,
    Number,
    call,
    names_in_expression,
    readings_in,
    table_of,
)
from symgen.base.vocabulary.measures import FormulaMeasure
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.formulas.readings import Readings
from symgen.describe.mechanism import Mechanism, Parameter
from symgen.describe.parts.context import Context
from symgen.describe.parts.input_data import Data, read_data

T = TypeVar("T")
#: Parts of a mechanism whose formulas may read inputs.
_READING = ("forces", "states", "outputs", "events")
_COMPARISONS = ("lt", "le", "gt", "ge")
#: Maximum number of points of a table at which a run halts; a longer one is evaluated as it is.
MOST_KNOTS = 100_000


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
        With formulas and data in the place of names; slots of all inputs stay, switches follow them.
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
        parts = {part: put_formulas(getattr(self.declared, part), beside) for part in _READING}
        return msgspec.structs.replace(self.mechanism, **parts)


def apply_inputs(mechanism: Mechanism, sources: Mapping[str, Any]) -> DrivenMechanism:
    """Return a mechanism with the inputs of a run.

    Parameters
    ----------
    mechanism : Mechanism
        Declares inputs.
    sources : mapping
        By name: a number; a text, which is a number, a formula of t, parameters and state, or
        ``FILE.csv:COLUMN[:INTERPOLATION]``; a pair of times and values; or a mapping of one of these, see
        `symgen.describe.parts.input_data.read_data`.

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
            hint = suggest(name, inputs) if inputs else "it declares none, in a section [inputs]"
            raise InputError(where, f"an input of {mechanism.name}", "none of that name", hint)
        own = declared[name].own_unit
        data = read_data(where, value, own)
        if data is None and not isinstance(value, str):
            numbers[name] = words[name] = arguments.number(where, value)
        elif data is None:
            number = _number_in_si(value, where, declared[name])
            if number is None:
                formulas[name], words[name] = parse(value, _names_for_inputs(mechanism), where), value
            else:
                numbers[name] = words[name] = arguments.number(where, number)
        else:
            words[name] = data.words
            if data.interpolation == "hold":
                samples[name] = data
            else:
                table = data.as_table(where, name)
                if data.interpolation != "linear":
                    curves[name] = data
                tables.append(table)
                formulas[name] = Call(table.function, (Name("t"),))
    _check_gaps(mechanism, samples, formulas)
    with_tables = msgspec.structs.replace(mechanism, tables=tuple(tables))
    changed = {name: _Switching(with_tables, name, jumps).without_jumps(e) for name, e in formulas.items()}
    switches = tuple(Parameter(j.switch, 0.0, input=True) for j in jumps if j.switch)
    if not changed:
        return DrivenMechanism(mechanism, numbers, samples, curves, (), words, mechanism)
    parts = {part: put_formulas(getattr(with_tables, part), changed) for part in _READING}
    parts["bounded"] = put_formulas(with_tables.bounded, formulas)  # what jumps in them is found there
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
        if any(readings_in(formula)) or not set(names_in_expression(formula)) <= timely:
            raise InputError(f"input '{name}'", expected, "a formula of the state", hint)


def inputs_of_gaps(mechanism: Mechanism) -> dict[str, str]:
    """Return the inputs that gaps read, each with what such a row is."""
    found = dict[str, str]()
    for row in mechanism.bounded:
        if isinstance(row.measure, FormulaMeasure):
            found |= {name: row.family.one for name in names_in_expression(row.measure.of) if name in mechanism.inputs}
    return found


def put_formulas(value: T, formulas: Mapping[str, Expr]) -> T:
    """Return a part of a mechanism with formulas in the place of inputs."""
    return replace_names(value, lambda e: formulas.get(e.name, e)) if formulas else value


def replace_names(value: T, by: Callable[[Name], Expr]) -> T:
    """Return a part of a mechanism with names replaced in all of its formulas."""
    if isinstance(value, Name):
        return by(value)  # type: ignore[return-value]  # an expression for an expression
    if isinstance(value, Call):
        return Call(value.function, tuple(replace_names(a, by) for a in value.arguments))  # type: ignore[return-value]
    if isinstance(value, tuple):
        return tuple(replace_names(item, by) for item in value)  # type: ignore[return-value]
    if isinstance(value, msgspec.Struct):
        return type(value)(**{field: replace_names(getattr(value, field), by) for field in value.__struct_fields__})
    return value


def _number_in_si(text: str, where: str, parameter: Parameter) -> float | None:
    """Return the number of a text in SI units; without a unit it has the unit of the file; None for a formula."""
    amount = read_amount(text)
    if amount is not None:
        return amount.in_si(where, parameter.unit, parameter.shown)
    try:
        return float(text)
    except ValueError:
        return None


def _names_for_inputs(mechanism: Mechanism) -> FormulaNames:
    """Return the names that the formula of an input may use."""
    plain = {p.name: p.name for p in mechanism.parameters if not p.input} | {"t": "t"}
    plain |= {x.name: x.name for x in mechanism.states}
    bodies = {body.name: body.coordinates + body.speeds for body in mechanism.bodies}
    what = "a number or an expression of t, parameters and body coordinates"
    hints = dict.fromkeys(mechanism.inputs, "an input does not depend on others")
    tables = {table.name: table.function for table in mechanism.tables}
    readings = Readings(Context.of_mechanism(mechanism))
    return FormulaNames(what, plain, bodies, tables, frozenset(mechanism.inputs), readings=readings, hints=hints)


def compared_with_zero(e: Call) -> Expr:
    """Return the expression that a comparison, `sign`, `abs`, `min` or `max` compares with zero."""
    return e.arguments[0] if len(e.arguments) == 1 else call("sub", *e.arguments)


class _Switching:
    """Removes the jumps from one formula, and records them and its kinks."""

    def __init__(self, mechanism: Mechanism, name: str, jumps: list[Jump]) -> None:
        self.tables = {table.name: table for table in mechanism.tables}
        self.timely = frozenset(p.name for p in mechanism.parameters if not p.input) | {"t"}
        self.name, self.jumps, self.switches = name, jumps, dict[Expr, Expr]()

    def without_jumps(self, e: Expr) -> Expr:
        """Return a formula in which nothing jumps within a piece."""
        if not isinstance(e, Call):
            return e
        arguments = tuple(self.without_jumps(a) for a in e.arguments)
        if "t" in (used := set(names_in_expression(e))) and used <= self.timely:
            if e.function in (*_COMPARISONS, "sign"):
                return self.replace_by_switch(e)
            table = self.tables.get(table_of(e.function) or "")
            if e.function in BENT:
                self.record_jump(Jump(compared_with_zero(e)))
            elif table is not None and table.interpolation != "cubic" and len(table.x) <= MOST_KNOTS:
                self.record_jump(Jump(e.arguments[0], table.x))
        return Call(e.function, arguments)

    def record_jump(self, jump: Jump) -> None:
        """Record a kink, where it depends on t."""
        if "t" in set(names_in_expression(jump.argument)):
            self.jumps.append(jump)

    def replace_by_switch(self, e: Call) -> Expr:
        """Return the replacement of a condition or a sign: a number that the run sets."""
        if e not in self.switches:
            name = f"{self.name}~{sum(1 for j in self.jumps if j.switch) + 1}"  # no name of a file
            self.jumps.append(Jump(compared_with_zero(e), switch=name, value=e))
            number = Name(name)
            self.switches[e] = number if e.function == "sign" else Call("gt", (number, Number(0.5)))
        return self.switches[e]
