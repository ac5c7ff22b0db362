"""Values of expressions with numbers for their names: for starts, sizes and checks, not for run time."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Mapping
from graphlib import CycleError, TopologicalSorter

from symgen.base import arguments
from symgen.base.errors import InputError, suggest
from symgen.base.settings import setting_names
from symgen.base.vocabulary.expressions import (
    FUNCTIONS,
    Call,
    Expr,
    Name,
    Number,
    Reading,
    names_in_expression,
    table_of,
)
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.formulas.start import Scalars
from symgen.describe.mechanism import Mechanism, Parameter
from symgen.describe.table_functions import Table

#: Exception of an evaluation -> description of the error.
_FAULTS: dict[type[Exception], str] = {ZeroDivisionError: "divides by zero", OverflowError: "is too large"}


def evaluate_formula(
    expression: Expr, values: Mapping[str, float], where: str = "expression", tables: Mapping[str, Table] | None = None
) -> float:
    """Return the value of `expression`.

    Parameters
    ----------
    expression : Expr
        The tree.
    values : mapping of str to float
        A number for every name in it.
    where : str
        File and key, for the message.
    tables : mapping of str to Table, optional
        The tables it may call.

    Raises
    ------
    InputError
        If a name has no value or the result is not a finite number.
    """
    if isinstance(expression, Number):
        return expression.value
    if isinstance(expression, Name | Reading):
        if expression.name not in values:
            hint = suggest(expression.name, values)
            raise InputError(where, "a value for every name", f"none for '{expression.name}'", hint)
        return float(values[expression.name])
    if expression.function == "where":
        # Only the chosen branch: the other one may be undefined here, which is why a choice was written.
        condition, yes, no = expression.arguments
        return evaluate_formula(
            yes if evaluate_formula(condition, values, where, tables) else no, values, where, tables
        )
    if expression.function in ("and", "or"):
        return _join_conditions(expression, values, where, tables)
    operands = [evaluate_formula(argument, values, where, tables) for argument in expression.arguments]
    try:
        if (table := table_of(expression.function)) is not None:
            value = (tables or {})[table].interpolated.value(operands[0])
        else:
            value = FUNCTIONS[expression.function][1](*operands)
    except (ArithmeticError, ValueError) as error:
        raise _undefined_error(expression, operands, where, _FAULTS.get(type(error), "is not defined")) from None
    if isinstance(value, complex) or not math.isfinite(value):
        raise _undefined_error(expression, operands, where, "is not a finite real number")
    return float(value)


def scalar_values(values: Mapping[str, float]) -> Scalars:
    """Return the numbers of one run with these values of the parameters."""
    return Scalars(lambda expression, where: evaluate_formula(expression, values, where))


def hint_on_number(mechanism: Mechanism, name: str, known: Iterable[str]) -> str:
    """Return the hint on a name that is no number of a run: of the place of a pin, who varies it."""
    joint, _, axis = name.rpartition(".")
    if axis in ("x", "y") and any(joint == each.name for each in mechanism.joints):
        return "symgen design alone varies the places of pins"
    return suggest(name, known)


def _hint_on_parameter(mechanism: Mechanism, name: str, known: Iterable[str]) -> str:
    """Return the hint on a name that is no parameter: the nearest one, or how the number of a table becomes one."""
    hint = hint_on_number(mechanism, name, known)
    if hint and not hint.startswith("known"):
        return hint
    if name in setting_names():
        return f"it is no parameter: did you mean `{name}`?"
    owner, _, key = name.rpartition(".")
    if not key.isidentifier():
        return hint
    bodies = [body.name for body in mechanism.bodies]
    body = owner if owner in bodies else next(iter(bodies), "")
    reader = (
        f'{key} = "{key}" in [bodies.{body}] reads it' if key in ("mass", "inertia") and body else "formulas read it"
    )
    return f"'{key} = VALUE' in [parameters] makes one, and {reader}{'; ' if hint else ''}{hint}"


def parameter_values(mechanism: Mechanism, changed: Mapping[str, float] | None = None) -> dict[str, float]:
    """Return all parameter values of a mechanism, `changed` ones replaced, dependent ones computed.

    Raises
    ------
    InputError
        If a name is not a parameter or a value is not finite.
    """
    values = {p.name: p.value for p in mechanism.parameters}
    for name, value in arguments.mapping("parameters", changed, "numbers by the names of parameters").items():
        if name not in values:
            expected, hint = f"a parameter of {mechanism.name}", _hint_on_parameter(mechanism, name, values)
            raise InputError(f"parameter '{name}'", expected, "none of that name", hint)
        values[name] = arguments.number(f"parameter '{name}'", value)
    if changed:
        for name, formula in dependent_parameters(mechanism.parameters, changed):
            values[name] = evaluate_formula(formula, values, f"parameter '{name}'")
    return values


def independent_values(mechanism: Mechanism, values: Mapping[str, float]) -> dict[str, float]:
    """Return the parameter values from which the others follow: of formulas only those that are set."""
    following = {
        name
        for name, formula in dependent_parameters(mechanism.parameters)
        if evaluate_formula(formula, values) == values[name]
    }
    return {name: value for name, value in values.items() if name not in following}


def _join_conditions(
    expression: Call, values: Mapping[str, float], where: str, tables: Mapping[str, Table] | None
) -> float:
    """Return 1 where both, or one, of two conditions hold, else 0; one may be undefined if the other decides."""
    deciding, undefined = expression.function == "or", None
    for argument in expression.arguments:
        try:
            if bool(evaluate_formula(argument, values, where, tables)) == deciding:
                return float(deciding)
        except InputError as error:
            undefined = undefined or error
    if undefined is not None:
        raise undefined
    return float(not deciding)


def _undefined_error(expression: Call, operands: list[float], where: str, why: str) -> InputError:
    at = Call(expression.function, tuple(Number(a) for a in operands))
    text, shown = to_text(expression), to_text(at)
    got = f"'{text}', which {why}" if text == shown else f"'{text}' = {shown}, which {why}"
    return InputError(where, "a finite number", got)


#: Maximum number of parameters in a message about a cycle.
_LISTED = 8


def evaluation_order(formulas: Mapping[str, Expr | None], where: str) -> list[str]:
    """Return names, each after those that its formula depends on, else in their own order.

    Parameters
    ----------
    formulas : mapping of str to Expr or None
        The formula of each, None for numbers; formulas may have further names.
    where : str
        File and section, for the message.

    Raises
    ------
    InputError
        If formulas form a cycle, which the message lists.
    """
    needs = {
        name: ()
        if formula is None
        else [need for need in dict.fromkeys(names_in_expression(formula)) if need in formulas]
        for name, formula in formulas.items()
    }
    try:
        TopologicalSorter(needs).prepare()
    except CycleError as error:
        circle: list[str] = error.args[1][:0:-1]  # each leads to the next one
        first = circle.index(min(circle, key=list(formulas).index))
        circle = [*circle[first:], *circle[: first + 1]]
        way = circle if len(circle) <= _LISTED else [*circle[: _LISTED - 1], "...", circle[0]]
        expected = "a formula that does not lead back to its own parameter"
        raise InputError(f"{where}.{circle[0]}", expected, " -> ".join(way)) from None
    ordered = dict.fromkeys(name for name, formula in formulas.items() if formula is None)
    waiting = list(formulas)[::-1]
    while waiting:
        name = next((need for need in needs[waiting[-1]] if need not in ordered), None)
        if name is None:
            ordered.setdefault(waiting.pop())
        else:
            waiting.append(name)
    return list(ordered)


def dependent_parameters(parameters: Iterable[Parameter], values: Container[str] = ()) -> list[tuple[str, Expr]]:
    """Return name and formula of dependent parameters, each after those it depends on.

    Parameters
    ----------
    parameters : iterable of Parameter
        Of a mechanism.
    values : container of str
        Those that have numbers in place of their formulas.
    """
    formulas = {p.name: None if p.name in values else p.formula for p in parameters}
    ordered = evaluation_order(formulas, "parameters") if any(formulas.values()) else []
    return [(name, formula) for name in ordered if (formula := formulas[name]) is not None]
