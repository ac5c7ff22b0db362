"""Kinks of a mechanism that are known beforehand: those of formulas and tables of the time."""

from __future__ import annotations

from typing import Any

import msgspec

from symgen.describe.inputs import MOST_KNOTS, Jump
from symgen.describe.mechanism import Mechanism
from symgen.vocabulary.expressions import Call, call, names, table_of

#: What is written where a formula has a kink.
_WORDS = (b"abs", b"min", b"max", b"table:")


def kinks_of(mechanism: Mechanism) -> tuple[Jump, ...]:
    """Return where formulas of joints and forces have kinks in time, as jumps that need no switch.

    `abs`, `min` and `max` have them where two values are equal, and tables at their points, whatever their pieces are:
    of a cubic one the third derivative jumps. Arguments are formulas of t and parameters; those of state pass such
    points at times that nobody knows before.
    """
    text = msgspec.msgpack.encode((mechanism.joints, mechanism.forces))
    if not any(word in text for word in _WORDS):  # most have none, and walking through large ones takes a while
        return ()
    tables = {table.name: table for table in mechanism.tables}
    timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
    found = dict[Jump, None]()
    for e in _calls(mechanism.joints, mechanism.forces):
        jump = None
        if e.function in ("abs", "min", "max"):
            jump = Jump(e.arguments[0] if e.function == "abs" else call("sub", *e.arguments))
        elif (table := tables.get(table_of(e.function) or "")) is not None and len(table.x) <= MOST_KNOTS:
            jump = Jump(e.arguments[0], table.x, period=table.x[-1] - table.x[0] if table.periodic else 0.0)
        if jump is not None and "t" in (used := set(names(jump.argument))) and used <= timely:
            found[jump] = None
    return tuple(found)


def _calls(*parts: Any) -> list[Call]:
    """Return every function that is called in the formulas of parts of a mechanism."""
    found, waiting = list[Call](), list(parts)
    while waiting:  # in a loop: large mechanisms have tens of thousands of nodes
        value = waiting.pop()
        if isinstance(value, Call):
            found.append(value)
            waiting += value.arguments
        elif isinstance(value, tuple):
            waiting += value
        elif isinstance(value, msgspec.Struct):
            waiting += [getattr(value, field) for field in value.__struct_fields__]
    return found
