"""Sets of contacts: each pair of some surfaces of different bodies, with a name of its own."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

import msgspec

from symgen.base.errors import quote, suggest
from symgen.describe.contacts.surfaces import OutlineTable, outline_named
from symgen.describe.parts.fields import value_in_words
from symgen.describe.parts.scope import Scope

#: Keys that name the body of a surface.
_BODIES = ("body", "line", "plane")


class PairOfSet(msgspec.Struct, frozen=True):
    """A contact of a set: its name, its two shapes, and their places in the set, counted from 0."""

    name: str
    between: tuple[Mapping[str, Any], Mapping[str, Any]]
    places: tuple[int, int]


def pairs_among(scope: Scope, key: str, surfaces: Sequence[Mapping[str, Any] | str]) -> Iterator[PairOfSet]:
    """Yield the pairs of surfaces whose bodies differ; they are called after the set and both surfaces.

    A surface has the name of its outline or body, with its number among several of one name.

    Raises
    ------
    InputError
        With the surface that is wrong, or if no two have different bodies.
    """
    tables = [{"outline": raw} if isinstance(raw, str) else raw for raw in surfaces]
    owners = [_name_and_body(scope, f"{key}[{i}]", table) for i, table in enumerate(tables)]
    count, names, seen = Counter(name for name, _ in owners), list[str](), Counter[str]()
    for name, _ in owners:
        seen[name] += 1
        names.append(f"{name}{seen[name]}" if count[name] > 1 else name)
    found = [(i, j) for i, j in combinations(range(len(tables)), 2) if owners[i][1] != owners[j][1]]
    if not found:
        raise scope.error(key, "surfaces of two bodies or more", value_in_words([name for name, _ in owners]))
    for i, j in found:
        yield PairOfSet(f"{scope.name}_{names[i]}_{names[j]}", (tables[i], tables[j]), (i, j))


def _name_and_body(scope: Scope, key: str, table: Mapping[str, Any]) -> tuple[str, str]:
    """Return how a surface is called, and its body."""
    if "outline" in table:
        name = table["outline"]
        if name not in scope.context.outlines and name in scope.context.bodies:
            expected = "a shape, or the name of an outline"
            raise scope.error(key, expected, f"the body {quote(name)}", f'{{ body = "{name}", disc = RADIUS }}')
        outline = outline_named(scope, key, OutlineTable(outline=str(name)))
        return outline.name, outline.body
    word = next((word for word in _BODIES if word in table), None)
    if word is None:
        hint = suggest(next(map(str, table), ""), [*_BODIES, "outline"])
        raise scope.error(
            key, f"a shape with one of the keys {', '.join(_BODIES)} and outline", value_in_words(table), hint
        )
    return str(table[word]), scope.body(f"{key}.{word}", str(table[word]))
