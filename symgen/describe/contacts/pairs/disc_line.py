"""A disc over a line, which belongs to the ground or to a body."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import ONE, call
from symgen.base.vocabulary.measures import Component, Direction, Marker
from symgen.describe.contacts.outlines import Outline
from symgen.describe.contacts.surfaces import Disc, Pair, Touch, slip_with_turns
from symgen.describe.parts.fields import Point, TimeFunction, Vector
from symgen.describe.parts.scope import Scope


class LineTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A line without ends.

    Parameters
    ----------
    line : str
        Its body, or ``"ground"``.
    on : point
        A point on it; the origin by default.
    normal : vector
        Its direction towards what it meets; the second axis by default.
    surface_speed : scalar
        Speed with which its surface moves along it, as a belt does, the free side on the left [m/s]: a number or a
        formula of t.
    """

    line: str
    on: Point = (0.0, 0.0)
    normal: Vector = (0.0, 1.0)
    surface_speed: TimeFunction | None = None


def read_line(scope: Scope, key: str, table: LineTable, disc: Disc) -> Touch:
    """Return the height over the line less the radius, and the way along the line plus what the disc has turned."""
    return touch_of_line(scope, *line_of_table(scope, key, table), disc)


def line_of_table(scope: Scope, key: str, table: LineTable) -> tuple[Marker, Direction]:
    """Return a point on a line and its direction towards what it meets."""
    body = scope.body(f"{key}.line", table.line)
    return scope.marker(f"{key}.on", body, table.on), scope.direction(f"{key}.normal", body, table.normal)


def touch_of_line(scope: Scope, on: Marker, normal: Direction, disc: Disc) -> Touch:
    """Return gap and slip of a disc over the line through a point, with a direction towards the disc."""
    x, y = normal.vector
    along = Component(on, disc.centre, Direction(on.body, (y, call("neg", x))))
    slip = slip_with_turns(scope, ((ONE, along),), disc.radius, (on.body, disc.body))
    outlines = disc.outline, Outline((on,), normal=normal)
    return Touch(Component(on, disc.centre, normal), disc.radius, slip, None, outlines)


KIND = Pair("line", LineTable, read_line, lambda table: str(table.line))
