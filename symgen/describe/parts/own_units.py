"""Units that a file gives to its parameters, inputs and outputs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from symgen.base.errors import InputError, quote
from symgen.base.units import Unit, known_unit, read_amount, read_unit, unit_of
from symgen.base.vocabulary.expressions import Call, Expr, Name, Number, Reading, call, names_in_expression
from symgen.base.vocabulary.quantities import Quantity
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.formulas.readings import OUTPUT, Readings
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.topology import unit_of_column

if TYPE_CHECKING:
    from symgen.describe.parts.scope import Scope


def parameter_value(
    value: float | str, text: str, allowed: FormulaNames, where: str
) -> tuple[float, Expr | None, Unit]:
    """Return the value of a parameter or an input in SI units, its formula of others, if any, and its unit.

    A formula of others has no value yet. Names in it stand for values in SI units, and so does what it gives.

    Parameters
    ----------
    value, text : float or str, str
        The number, formula or number with a unit, and the unit beside it, as written.
    allowed, where : FormulaNames, str
        Names that a formula may use; file and key, for messages.
    """
    unit = unit_of(text, f"{where}.unit")
    amount = read_amount(value) if isinstance(value, str) else None
    if amount is not None and amount.unit and amount.unit not in allowed.plain:
        own = unit_of(amount.unit, where, quantity=unit.si if text else "")
        number = own.to_si(amount.number)
        unit = unit if text else own
    elif isinstance(value, str):
        expression = parse(value, allowed, where)
        if any(names_in_expression(expression)):
            if not unit.is_si and (literal := _added_number(expression)) is not None:
                hint = f"make {literal!r} a parameter with its unit"
                raise InputError(where, "a formula of values in SI units, as names stand for these", quote(value), hint)
            return 0.0, expression, unit
        number = unit.to_si(evaluate_formula(expression, {}, where))
    else:
        number = unit.to_si(float(value))
    if not math.isfinite(number):
        raise InputError(where, "a finite number", str(number if isinstance(value, str) else value))
    return number, None, unit


def _added_number(e: Expr) -> float | None:
    """Return a number that a formula adds to something, which then has the unit of its value; None without one."""
    if not isinstance(e, Call) or e.function not in ("add", "sub"):
        return None
    for argument in e.arguments:
        if isinstance(argument, Number):
            return argument.value
        if (inner := _added_number(argument)) is not None:
            return inner
    return None


def entry_in_si(entry: object, value: float) -> object:
    """Return the entry of a parameter in a description with another value, in SI units."""
    table = entry if isinstance(entry, Mapping) else {"value": entry}
    text, before = table.get("unit", ""), table.get("value")
    if not text and isinstance(before, str) and (amount := read_amount(before)) is not None:
        text = amount.unit
    unit = read_unit(text) if isinstance(text, str) and text else None
    if not isinstance(unit, Unit) or unit.is_si or not isinstance(value, int | float) or not math.isfinite(value):
        return {**entry, "value": value} if isinstance(entry, Mapping) else value
    return {**table, "value": f"{float(value)!r} {unit.si}", "unit": text}


def as_written(mechanism: Mechanism, quantity: Quantity, values: Mapping[str, float]) -> tuple[float, str]:
    """Return the value of a parameter, of `values` in SI units, in the unit of the file, and that unit."""
    value = values[quantity.name]
    parameter = next((p for p in mechanism.parameters if p.name == quantity.name), None)
    return (value, quantity.unit) if parameter is None else parameter.as_written(value)


def in_own_unit(scope: Scope, value: Expr, unit: Unit) -> Expr:
    """Return the formula of an output in its unit: of one quantity of the motion it is converted.

    Parameters
    ----------
    scope : Scope
        The place of the output.
    value, unit : Expr, Unit
        Its formula and its unit; an empty one is none.

    Raises
    ------
    InputError
        If the output is one quantity, and the unit is one of another.
    """
    own = unit_of_quantity(scope, value) if unit.text else ""
    if not own or not isinstance(value, Name | Reading):
        return value
    if not unit.fits(known_unit(own)):
        raise scope.error("unit", f"{own}, the unit of {value.name}", quote(unit.text))
    return value if unit.is_si else call("mul", Number(unit.from_si(1.0)), value)


def unit_of_quantity(scope: Scope, value: Expr) -> str:
    """Return the unit of a quantity of the motion; empty for formulas and where it is not known."""
    if isinstance(value, Name):
        owner, _, label = value.name.rpartition(".")
        return unit_of_column(label) if owner in scope.context.bodies else ""
    if isinstance(value, Reading):
        entry = Readings(scope.context, OUTPUT).meaning_with_unit(tuple(value.name.split(".")), scope.where(""))
        return "" if entry is None else entry[1]
    return ""
