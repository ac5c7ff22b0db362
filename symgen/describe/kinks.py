"""Kinks of a mechanism that are known beforehand: points of tables whose argument is a formula of the time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import msgspec

from symgen.describe.inputs import MOST_KNOTS, Jump
from symgen.describe.mechanism import Mechanism
from symgen.vocabulary.expressions import Call, names, table_of


def kinks_of(mechanism: Mechanism) -> tuple[Jump, ...]:
    """Return where joints and forces pass the points of tables, as jumps that need no switch.

    Arguments are formulas of t and parameters; those of state are passed at times that nobody knows before. At a point
    of a table something has a kink, whatever its pieces are: of a cubic one the third derivative.
    """
    if not mechanism.tables:
        return ()
    tables = {table.name: table for table in mechanism.tables}
    timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
    found = dict[Jump, None]()
    for call in (*_calls(mechanism.joints), *_calls(mechanism.forces)):
        table = tables.get(table_of(call.function) or "")
        if table is not None and len(table.x) <= MOST_KNOTS:
            argument = call.arguments[0]
            if "t" in (used := set(names(argument))) and used <= timely:
                found[Jump(argument, table.x, period=table.x[-1] - table.x[0] if table.periodic else 0.0)] = None
    return tuple(found)


def _calls(value: Any) -> Iterator[Call]:
    """Yield every function that is called in the formulas of a part of a mechanism."""
    if isinstance(value, Call):
        yield value
        yield from _calls(value.arguments)
    elif isinstance(value, tuple):
        for item in value:
            yield from _calls(item)
    elif isinstance(value, msgspec.Struct):
        for field in value.__struct_fields__:
            yield from _calls(getattr(value, field))
