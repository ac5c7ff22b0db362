"""The key ``stop`` of joints: stops at the ends of their coordinates."""

from __future__ import annotations

from typing import Annotated, Protocol

import msgspec
from msgspec import Meta

from symgen.base.vocabulary.expressions import ZERO, Expr, Number, Reading, call
from symgen.base.vocabulary.measures import FormulaMeasure, Measure, Sum
from symgen.describe.bounds.changing import is_constant
from symgen.describe.bounds.dry_friction import bound_at_rate
from symgen.describe.bounds.elastic_stop import ElasticStop
from symgen.describe.bounds.end_stop import LOWER, STOPS, UPPER, EndStop
from symgen.describe.bounds.keys import KeyOfJoints, tables_by_coordinate
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Scalar, StateFunction, read_table, value_in_words
from symgen.describe.parts.scope import Scope

StopTable = Annotated[
    dict[str, float | str | dict[str, float | str]],
    Meta(description="a table of limits such as { lower = -1.0, upper = 2.0 }, or one for each coordinate"),
]


class HowItActs(Protocol):
    """Keys of a stop that say how it acts on what meets it."""

    @property
    def restitution(self) -> float | str | None:
        """Rate after an impact over that before."""
        ...

    @property
    def stiffness(self) -> float | str | None:
        """Force over depth."""
        ...

    @property
    def damping(self) -> float | str | None:
        """Force over the rate of the depth."""
        ...


class LimitSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Stops at the ends of a coordinate of a joint.

    Parameters
    ----------
    lower, upper : scalar
        Least and largest value of the coordinate [m or rad]; one of them may be left out. A formula of t, parameters,
        inputs and positions is a stop that moves.
    restitution : scalar
        Rate after an impact over that before, from 0 to 1; 0 by default.
    stiffness : scalar
        Of an elastic stop, force over the depth beyond it [N/m or N m/rad]; without it the stop is rigid.
    damping : scalar
        Of an elastic stop, force over the rate of the depth [N s/m or N m s/rad]; 0 by default. The force never pulls.
    """

    lower: StateFunction | None = None
    upper: StateFunction | None = None
    restitution: Scalar | None = None
    stiffness: Scalar | None = None
    damping: Scalar | None = None


def read_limits(scope: Scope, joint: Joint, raw: object) -> tuple[EndStop | ElasticStop, ...]:
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
    stops = list[EndStop | ElasticStop]()
    labels = dict(joint.coordinates)
    for label, table in tables_by_coordinate(scope, joint, "stop", raw, "{ lower = -1.0, upper = 2.0 }").items():
        single = len(labels) == 1
        key = "stop" if single else f"stop.{label}"
        section = read_table(LimitSection, table, scope.where(key))
        if section.lower is None and section.upper is None:
            raise scope.error(key, "the key lower, the key upper or both", "neither")
        limits = [
            (word, sign, read_limit(scope, f"{key}.{word}", value))
            for word, sign, value in ((LOWER, 1.0, section.lower), (UPPER, -1.0, section.upper))
            if value is not None
        ]
        if len(limits) == 2 and all(is_constant(scope, limit) for _, _, limit in limits):
            low, high = (scope.value(limit, f"{key}.{word}") for word, _, limit in limits)
            if low >= high:
                raise scope.error(f"{key}.upper", f"a value above that of lower ({low!r})", repr(high))
        name = joint.name if single else f"{joint.name}.{label}"
        for word, sign, limit in limits:
            gap = _gap_of_limit(scope, f"{joint.name}.{label}", labels[label], sign, limit)
            stops.append(read_stop(scope, key, f"{name}.{word}", joint.name, *gap, joint.unit(label), section))
    return tuple(stops)


def read_limit(scope: Scope, key: str, value: float | str) -> Expr:
    """Return the end of a coordinate: a number, or a formula that has two derivatives by the time."""
    return scope.of_row(key, value, speeds=False, inputs=True, moves=False)


def _gap_of_limit(scope: Scope, name: str, coordinate: Measure, sign: float, limit: Expr) -> tuple[Measure, Expr]:
    """Return the measure and the value whose difference is the gap; a limit that moves is part of the measure."""
    if not is_constant(scope, limit):
        ends = Reading(name, coordinate), limit
        return FormulaMeasure(call("sub", *(ends if sign > 0.0 else reversed(ends)))), ZERO
    if sign > 0.0:
        return coordinate, limit
    return Sum(((Number(-1.0), coordinate),)), call("neg", limit)


def read_stop(
    scope: Scope,
    key: str,
    name: str,
    owner: str,
    measure: Measure,
    value: Expr,
    unit: str,
    section: HowItActs,
) -> EndStop | ElasticStop:
    """Return a stop with a gap, rigid or elastic.

    Parameters
    ----------
    scope : Scope
        The place.
    key : str
        Key of its table; empty where the place is the table.
    name, owner, measure, value, unit
        As those of a stop.
    section : HowItActs
        How it acts on what meets it.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    within = f"{key}." if key else ""
    if section.stiffness is None:
        if section.damping is not None:
            raise scope.error(f"{within}damping", "the key stiffness beside it", value_in_words(section.damping))
        given = 0.0 if section.restitution is None else section.restitution
        restitution = read_restitution(scope, f"{within}restitution", given)
        return EndStop(name, owner, measure, value, unit, restitution)
    if section.restitution is not None:
        got = value_in_words(section.restitution)
        raise scope.error(f"{within}restitution", "no such key beside stiffness, as damping takes the energy", got)
    stiffness = scope.constant(f"{within}stiffness", section.stiffness, positive=True)
    damping = scope.constant(f"{within}damping", 0.0 if section.damping is None else section.damping)
    if (size := scope.value(damping, f"{within}damping")) < 0.0:
        raise scope.error(f"{within}damping", "a value of at least 0", repr(size))
    return ElasticStop(name, owner, measure, value, unit, stiffness, damping)


def read_restitution(scope: Scope, key: str, value: float | str) -> Expr:
    """Return a restitution, which may be a formula of ``rate``; raises `InputError` where it is not one at rest."""
    expression = scope.potential(key, value, {"rate": "rate"})
    if not 0.0 <= (size := scope.value(bound_at_rate(expression, ZERO), key)) <= 1.0:
        raise scope.error(key, "a value from 0 to 1", repr(size))
    return expression


KIND = KeyOfJoints("stop", STOPS, StopTable, read_limits)
