"""The key ``stop`` of joints: stops at the ends of their coordinates."""

from __future__ import annotations

from typing import Annotated

import msgspec
from msgspec import Meta

from symgen.base.vocabulary.expressions import Expr, Number, call
from symgen.base.vocabulary.measures import Sum
from symgen.describe.bounds.end_stop import LOWER, STOPS, UPPER, EndStop
from symgen.describe.bounds.keys import KeyOfJoints, by_coordinate
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Scalar, read_table
from symgen.describe.parts.scope import Scope

StopTable = Annotated[
    dict[str, float | str | dict[str, float | str]],
    Meta(description="a table of limits such as { lower = -1.0, upper = 2.0 }, or one for each coordinate"),
]


class LimitSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Stops at the ends of a coordinate of a joint.

    Parameters
    ----------
    lower, upper : scalar
        Least and largest value of the coordinate [m or rad]; one of them may be left out.
    restitution : scalar
        Rate after an impact over that before, from 0 to 1; 0 by default.
    """

    lower: Scalar | None = None
    upper: Scalar | None = None
    restitution: Scalar = 0.0


def read_limits(scope: Scope, joint: Joint, raw: object) -> tuple[EndStop, ...]:
    """Return the stops of a joint from its key.

    Parameters
    ----------
    scope : Scope
        The place of the joint.
    joint : Joint
        The joint.
    raw : object
        Limits of its only coordinate, or a table of such limits for some of its coordinates.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    stops = list[EndStop]()
    labels = dict(joint.coordinates)
    for label, table in by_coordinate(scope, joint, "stop", raw, "{ lower = -1.0, upper = 2.0 }").items():
        single = len(labels) == 1
        key = "stop" if single else f"stop.{label}"
        section = read_table(LimitSection, table, scope.where(key))
        if section.lower is None and section.upper is None:
            raise scope.error(key, "the key lower, the key upper or both", "neither")
        restitution = read_restitution(scope, f"{key}.restitution", section.restitution)
        limits = [
            (word, sign, scope.constant(f"{key}.{word}", value))
            for word, sign, value in ((LOWER, 1.0, section.lower), (UPPER, -1.0, section.upper))
            if value is not None
        ]
        if len(limits) == 2:
            low, high = (scope.value(limit, f"{key}.{word}") for word, _, limit in limits)
            if low >= high:
                raise scope.error(f"{key}.upper", f"a value above that of lower ({low!r})", repr(high))
        name = joint.name if single else f"{joint.name}.{label}"
        for word, sign, limit in limits:
            measure = labels[label] if sign > 0.0 else Sum(((Number(-1.0), labels[label]),))
            value = limit if sign > 0.0 else call("neg", limit)
            stops.append(EndStop(f"{name}.{word}", joint.name, measure, value, joint.unit(label), restitution))
    return tuple(stops)


def read_restitution(scope: Scope, key: str, value: float | str) -> Expr:
    """Return a restitution; raises `InputError` where it is not one."""
    expression = scope.constant(key, value)
    if not 0.0 <= (size := scope.value(expression, key)) <= 1.0:
        raise scope.error(key, "a value from 0 to 1", repr(size))
    return expression


KIND = KeyOfJoints("stop", STOPS, StopTable, read_limits)
