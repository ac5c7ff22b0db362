"""Shapes of bodies, for pictures: what a body looks like, which its motion does not depend on."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING

from symgen.describe.fields import found, read
from symgen.describe.mechanism import Shape
from symgen.describe.sections import ShapeSection
from symgen.errors import quoted
from symgen.vocabulary.expressions import ONE, ZERO

if TYPE_CHECKING:
    from symgen.describe.scope import Scope

#: Type of a shape -> the keys it needs, and those it may have, beside `type` and `colour`.
KEYS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "polyline": (("points",), ("closed",)),
    "box": (("size",), ("at",)),
    "cylinder": (("radius",), ("at", "length", "axis")),
    "sphere": (("radius",), ("at",)),
}
#: Shapes of one body at most, and points of a polyline.
MOST, MOST_POINTS = 100, 2000

_COLOUR = re.compile(r"#[0-9a-fA-F]{6}")


def shapes_of(scope: Scope, raw: object) -> tuple[Shape, ...]:
    """Return the shapes of the body that a scope names: those of the key ``shape`` of its table, one or a list."""
    given = raw.get("shape", ()) if isinstance(raw, Mapping) else ()
    several = isinstance(given, list | tuple)
    tables = given if several else (given,)
    if len(tables) > MOST:
        raise scope.error("shape", f"at most {MOST} shapes", str(len(tables)))
    return tuple(_shape(scope, table, f"shape[{i}]" if several else "shape") for i, table in enumerate(tables))


def _shape(scope: Scope, raw: object, key: str) -> Shape:
    section = read(ShapeSection, raw, scope.where(key))
    needed, allowed = KEYS[section.type]
    given = set(raw) - {"type", "colour"} if isinstance(raw, Mapping) else set()
    if not scope.spatial and section.type == "cylinder":
        allowed = ("at",)
    if scope.spatial and section.type == "cylinder":
        needed, allowed = (*needed, "length"), ("at", "axis")
    for name in needed:
        if name not in given:
            raise scope.error(f"{key}.{name}", f"a value, as a {section.type} needs it", "no such key")
    for name in sorted(given - {*needed, *allowed}):
        raise scope.error(f"{key}.{name}", f"no such key for a {section.type} here", found(getattr(section, name)))
    if section.colour and not _COLOUR.fullmatch(section.colour):
        raise scope.error(f"{key}.colour", "a colour such as '#3a7bd5'", quoted(section.colour))
    points = section.points or ()
    if section.type == "polyline" and not 2 <= len(points) <= MOST_POINTS:
        raise scope.error(f"{key}.points", f"2 to {MOST_POINTS} points", str(len(points)))
    sizes = section.size or ()
    if section.size is not None and len(sizes) != scope.dimension:
        raise scope.error(f"{key}.size", f"{scope.dimension} lengths", found(section.size))
    numbers = [*(("size", e) for e in sizes), ("radius", section.radius), ("length", section.length)]
    up = (ZERO,) * (scope.dimension - 1) + (ONE,)
    return Shape(
        section.type,
        points=tuple(scope.vector(f"{key}.points", point) for point in points),
        closed=section.closed,
        at=scope.marker(f"{key}.at", scope.name, section.at).point,
        sizes=tuple(scope.constant(f"{key}.{name}", e, positive=True) for name, e in numbers if e is not None),
        axis=up if section.axis is None else scope.direction(f"{key}.axis", scope.name, section.axis).vector,
        colour=section.colour.lower(),
    )
