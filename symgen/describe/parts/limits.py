"""Limits that a file sets for its outputs and parameters: what a machine must not exceed."""

from __future__ import annotations

from typing import Protocol

from symgen.base.errors import InputError, quote
from symgen.base.units import Unit, read_amount, unit_of
from symgen.base.vocabulary.expressions import Expr, Number
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.mechanism import OperatingLimit
from symgen.describe.parts.fields import Scalar
from symgen.describe.parts.own_units import parameter_value


class LimitedSection(Protocol):
    """A section with limits."""

    @property
    def smallest(self) -> Scalar | None:
        """The lower limit."""

    @property
    def largest(self) -> Scalar | None:
        """The upper limit."""


def read_limits_of_entry(
    name: str, section: LimitedSection, unit: Unit, allowed: FormulaNames, where: str, *, si: bool
) -> tuple[OperatingLimit, ...]:
    """Return the limits of an entry; none where it has no such key.

    Parameters
    ----------
    name : str
        Of the output or parameter.
    section : section
        Has the keys ``smallest`` and ``largest``.
    unit : Unit
        Of the entry; numbers without a unit are in it.
    allowed : FormulaNames
        The parameters, which formulas may use.
    where : str
        File and entry, for messages.
    si : bool
        Whether values of the entry are kept in SI units, as those of parameters are.
    """
    ends = [
        None if value is None else _read_end(value, unit, allowed, f"{where}.{key}", si)
        for key, value in (("smallest", section.smallest), ("largest", section.largest))
    ]
    if ends == [None, None]:
        return ()
    low, high = ends
    if isinstance(low, Number) and isinstance(high, Number) and low.value > high.value:
        raise InputError(f"{where}.largest", f"at least the smallest, {section.smallest}", str(section.largest))
    return (OperatingLimit(name, low, high),)


def _read_end(value: float | str, unit: Unit, allowed: FormulaNames, where: str, si: bool) -> Expr:
    if si:
        number, formula, _ = parameter_value(value, unit.text, allowed, where)
        return Number(number) if formula is None else formula
    if not isinstance(value, str):
        return Number(float(value))
    amount = read_amount(value)
    if amount is None or not amount.unit or amount.unit in allowed.plain:
        return parse(value, allowed, where)
    own = unit_of(amount.unit, where, quantity=unit.si if unit.text else "")
    if not unit.text and not own.is_si:
        raise InputError(
            where, f"a number, or one in SI units such as {own.si}, as the entry has no unit", quote(value)
        )
    return Number(unit.from_si(own.to_si(amount.number)))
