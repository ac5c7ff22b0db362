"""Units of numbers that people type for a mechanism, as in ``--set`` and ``--start``.

A number for a parameter or an input is in the unit of the file, one for a coordinate or velocity in its SI unit, unless
a unit is typed after it.
"""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.units import Amount, known_unit
from symgen.describe.edits.handles import PINS
from symgen.describe.facts.pins import AXES
from symgen.describe.formulas.readings import STATE, readings_of_joint
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.topology import unit_of_column


class Typed(float):
    """A number as typed, with the unit after it, if any; its value is in that unit."""

    unit: str = ""

    @classmethod
    def from_amount(cls, amount: Amount) -> Typed:
        """Return the number of an amount."""
        typed = cls(amount.number)
        typed.unit = amount.unit
        return typed


def units_of_number(mechanism: Mechanism, name: str) -> tuple[str, str]:
    """Return the SI unit of a named number, empty if it is not known, and the unit in which people type it.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    name : str
        A parameter, an input, a state, a coordinate or velocity of a body or joint, or the place of a pin.
    """
    for parameter in mechanism.parameters:
        if parameter.name == name:
            return parameter.unit, parameter.shown or parameter.unit
    for state in mechanism.states:
        if state.name == name:
            return state.unit, state.unit
    owner, _, label = name.rpartition(".")
    if any(body.name == owner for body in mechanism.bodies):
        unit = unit_of_column(label)
        return unit, unit
    if label in AXES and any(joint.name == owner and joint.kind in PINS for joint in mechanism.joints):
        return "m", "m"
    owner, _, label = name.partition(".")
    units = {
        of: unit
        for joint in mechanism.joints
        if joint.name == owner
        for of, (_, unit) in readings_of_joint(joint, STATE).items()
    }
    unit = units.get(label, "")
    return unit, unit


def notes_on_units(mechanism: Mechanism, values: Mapping[str, float]) -> list[str]:
    """Return a sentence for each number typed without a unit that counts in another than the SI unit."""
    notes = []
    for name, value in values.items():
        si, usual = units_of_number(mechanism, name)
        if isinstance(value, Typed) and not value.unit and not known_unit(usual).is_si:
            number = f"{float(value):g}"
            notes.append(f"{name}={number} is {number} {usual}, the unit of the file; {name}={number}{si} is in {si}")
    return notes


def typed_numbers_in_si(mechanism: Mechanism, values: Mapping[str, float], where: str) -> dict[str, float]:
    """Return numbers by their names in SI units; those that nobody typed are in them already.

    Parameters
    ----------
    mechanism, values : Mechanism, mapping of str to float
        The mechanism, and values of which some are `Typed`.
    where : str
        The option, for messages.

    Raises
    ------
    InputError
        If a unit is none, or none of the quantity.
    """
    return {
        name: Amount(float(value), value.unit).in_si(f"{where} {name}", *units_of_number(mechanism, name))
        if isinstance(value, Typed)
        else value
        for name, value in values.items()
    }
