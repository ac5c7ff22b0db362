"""Quantities of a motion by name or formula, as outputs read them, with their units."""

from __future__ import annotations

from typing import NamedTuple

import msgspec

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import Expr, Name, Reading, call
from symgen.base.vocabulary.measures import Driven, Holonomic
from symgen.describe.formulas.readings import OUTPUT, Readings
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.context import Context
from symgen.describe.parts.driven_mechanism import put_formulas
from symgen.describe.parts.own_units import unit_of_quantity
from symgen.describe.parts.scope import Scope

#: What names of multipliers begin with.
_MULTIPLIER = "multiplier."


class MotionQuantity(NamedTuple):
    """A quantity of a motion.

    Attributes
    ----------
    text : str
        As it is written.
    formula : Expr
        As a formula of outputs.
    unit : str
        Its unit, empty for formulas.
    """

    text: str
    formula: Expr
    unit: str


class QuantityNames:
    """Reads quantities of the motions of a mechanism: columns, outputs, and formulas of both.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self._mechanism, context = mechanism, Context.of_mechanism(mechanism)
        self._outputs = {output.name: output for output in mechanism.outputs}
        self._context = msgspec.structs.replace(context, state_names=(*context.state_names, *self._outputs))
        self._units = {p.name: p.unit for p in mechanism.parameters} | {x.name: x.unit for x in mechanism.states}
        self._units |= {output.name: output.unit for output in mechanism.outputs}

    def read(self, where: str, text: str) -> MotionQuantity:
        """Return a quantity.

        Parameters
        ----------
        where : str
            The argument, for messages.
        text : str
            A column of results, an output, or a formula.

        Raises
        ------
        InputError
            If it is none of these.
        """
        if (multiplier := self._multiplier(text)) is not None:
            return multiplier
        try:
            formula = Scope(self._context, where).of_motion("", text)
        except InputError as error:
            raise InputError(where, error.expected, error.got, error.hint) from None
        return self.of_formula(text, formula, self._unit(text, formula))

    def of_formula(self, text: str, formula: Expr, unit: str) -> MotionQuantity:
        """Return a formula of the mechanism as a quantity: formulas of outputs and inputs take the place of names."""
        outputs = {name: output.value for name, output in self._outputs.items()}
        formula = put_formulas(put_formulas(formula, outputs), dict(self._mechanism.input_formulas))
        return MotionQuantity(text, formula, unit)

    def _unit(self, text: str, formula: Expr) -> str:
        """Return the unit of a quantity that is a column, empty where it is a formula."""
        if text in self._units:
            return self._units[text]
        if isinstance(formula, Name | Reading):
            return unit_of_quantity(Scope(self._context, text), formula)
        path = tuple(text.split("."))
        entry = None
        if len(path) > 1 and all(part.isidentifier() for part in path):
            entry = Readings(self._context, OUTPUT).meaning_with_unit(path, text)
        return "" if entry is None else entry[1]

    def _multiplier(self, text: str) -> MotionQuantity | None:
        """Return the multiplier of a row, None where the text names none."""
        name, dotted, label = text.removeprefix(_MULTIPLIER).partition(".")
        if not text.startswith(_MULTIPLIER) or not dotted:
            return None
        for joint in self._mechanism.joints:
            for row in joint.rows if joint.name == name else ():
                if isinstance(row, Holonomic) and row.label == label:
                    unit = "N m" if row.unit == "rad" else "N"
                    effort = Reading(f"{name}.{label}", Driven(f"{name}.{label}", row.measure))
                    return MotionQuantity(text, call("neg", effort), unit)
        return None
