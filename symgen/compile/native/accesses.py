"""What functions read of arrays, and what they store."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symgen.compile.native import language as lang
from symgen.compile.native.read_values import Foreign

#: An element of an array.
Place = tuple[str, int]


def whole_index(e: lang.Expression, counters: Mapping[str, int]) -> int:
    """Return an index, which has to be known."""
    if isinstance(e, lang.Constant):
        return int(e.value)
    if isinstance(e, lang.Variable) and e.name in counters:
        return counters[e.name]
    if isinstance(e, lang.ScalarOperation) and e.name in ("add", "sub", "mul"):
        a, b = (whole_index(argument, counters) for argument in e.arguments)
        return {"add": a + b, "sub": a - b, "mul": a * b}[e.name]
    raise Foreign("an index that changes in a function with an adjoint")


@dataclass(frozen=True)
class Accesses:
    """What a function and those that it calls read before they store it, and what they store.

    Attributes
    ----------
    read, stored : frozenset of (str, int)
        Elements by array and index; index -1 means any.
    """

    read: frozenset[Place]
    stored: frozenset[Place]


def array_accesses(body: tuple[lang.Statement, ...]) -> Accesses:
    """Return what statements read and store of arrays, which callees have under the same names."""
    read, stored = set[Place](), set[Place]()

    def known_index(e: lang.Expression) -> int:
        try:
            return whole_index(e, {})
        except Foreign:
            return -1

    def collect_accesses(part: object) -> None:
        if isinstance(part, lang.Store):
            collect_accesses(part.value)
            stored.add((part.array, known_index(part.index)))
        elif isinstance(part, lang.ArrayElement):
            place = part.array, known_index(part.index)
            if place not in stored:
                read.add(place)
        elif isinstance(part, lang.FunctionCall):
            for argument in part.arguments:
                collect_accesses(argument)
            collect_accesses(part.function.body)
        elif isinstance(part, tuple):
            for each in part:
                collect_accesses(each)
        elif isinstance(part, lang.Statement | lang.Expression):
            for name in part.__struct_fields__:
                collect_accesses(getattr(part, name))

    collect_accesses(body)
    return Accesses(frozenset(read), frozenset(stored))
