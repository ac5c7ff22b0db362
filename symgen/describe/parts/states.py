"""States of a file's own: a table of ``[states]`` in, its start and its rate out."""

from __future__ import annotations

from symgen.base.errors import quote
from symgen.base.units import unit_of
from symgen.describe.mechanism import StateVariable
from symgen.describe.parts.fields import read_table
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.sections import StateSection


def read_state(scope: Scope, name: str, raw: object) -> StateVariable:
    """Return the state called `name`.

    Raises
    ------
    InputError
        If its start, rate or unit is wrong.
    """
    section = read_table(StateSection, raw, scope.where(""))
    unit = unit_of(section.unit, scope.where("unit"))
    if not unit.is_si:
        hint = f'a start may have one of its own: "5 {unit.text}"'
        raise scope.error("unit", f"an SI unit such as {unit.si}, as formulas are", quote(unit.text), hint)
    scope.coordinates = {name: unit.si}
    start, rate = scope.constant("start", section.start), scope.of_motion("rate", section.rate, integrals=False)
    return StateVariable(name, start, rate, unit.text)
