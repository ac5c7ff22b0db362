"""Stops: the key ``stop`` of joints and the section ``stops``, with the events of their modes.

A stop has a gap, and a row that is in force where the stop is closed (`symgen.base.ir.program.MODES`): its force
pushes. The gap of an open stop is watched, and so is the force of a closed one. A stop that other rows keep closed has
no force; the number ``limit`` of its row is 1 then, and nothing of it is watched.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Number, call
from symgen.base.vocabulary.measures import Effort, FormulaMeasure, Sum
from symgen.describe.bounds.friction import (
    LOWER,
    MODE,
    UPPER,
    by_coordinate,
    effort_at_rest,
    number_of,
    outputs_without,
    rate_of,
    refuse_friction,
    stops_along,
)
from symgen.describe.formulas.readings import is_angle
from symgen.describe.mechanism import EndStop, Event, Friction, Joint, Mechanism, Output
from symgen.describe.parts.fields import Scalar, StateFunction, read_table
from symgen.describe.parts.scope import Scope

#: Last words of the names of events: an impact, a stop closes, a stop opens.
HIT, REST, LEAVE = "hit", "rest", "leave"


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


class GapSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A gap that does not become negative: of a rope, of a follower on its cam, of a body over a floor.

    Parameters
    ----------
    gap : str
        An expression of t, parameters, inputs, smooth tables, coordinates of bodies, points and axes of them and
        coordinates of joints, such as ``"2.0 - sqrt(load.x**2 + load.y**2)"``. The force, which only pushes, is along
        its derivatives by the coordinates.
    restitution : scalar
        Rate of the gap after an impact over that before, from 0 to 1; 0 by default.
    """

    gap: StateFunction
    restitution: Scalar = 0.0


def read_gap(scope: Scope, raw: object) -> EndStop:
    """Return the stop that a table of the section ``stops`` describes.

    Parameters
    ----------
    scope : Scope
        The table's place.
    raw : object
        The table.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    section = read_table(GapSection, raw, scope.where(""))
    of = scope.of_row("gap", section.gap, speeds=False, inputs=True)
    restitution = _restitution(scope, "restitution", section.restitution)
    return EndStop(scope.name, scope.name, FormulaMeasure(of), ZERO, "rad" if is_angle(of) else "m", restitution)


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
        restitution = _restitution(scope, f"{key}.restitution", section.restitution)
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


def _restitution(scope: Scope, key: str, value: float | str) -> Expr:
    expression = scope.constant(key, value)
    if not 0.0 <= (size := scope.value(expression, key)) <= 1.0:
        raise scope.error(key, "a value from 0 to 1", repr(size))
    return expression


def check_stops(mechanism: Mechanism, source: str) -> None:
    """Refuse stops beside friction by reactions.

    Raises
    ------
    InputError
        With the first such friction.
    """
    pressed = next((friction for friction in mechanism.frictions if friction.pressed), None)
    if mechanism.stops and pressed is not None:
        where = f"{source}: joints.{pressed.joint}.friction"
        expected = "friction of constant bound beside stops, as that has no impulse at an impact"
        raise InputError(where, expected, "friction by the reaction of the joint")


# -- modes -------------------------------------------------------------------------------------------------------------


def gap_of(stop: EndStop) -> Expr:
    """Return the gap."""
    measure = rate_of(stop, 0)
    return measure if stop.value == ZERO else call("sub", measure, stop.value)


def probing_effort(stop: EndStop) -> Effort:
    """Return the effort by which transitions probe accelerations: the sign of the row, which is 0 in runs."""
    return Effort("stop", stop.measure, number_of(stop, "sign"))


def stop_events(mechanism: Mechanism) -> tuple[Event, ...]:
    """Return the events at which stops close or open.

    A function of another mode is 1: it sleeps. The number ``limit`` of a row in force is the bound of the dry friction
    whose force it carries: before the stop opens, that holds it too. The velocity that an impact sets is the rate of
    the gap: 0 where the sign of the row is not 0, and where impacts do not come to rest, the rate that restitution
    leaves.
    """
    events = list[Event]()
    for stop in mechanism.stops:
        held, sign, limit = (number_of(stop, number) for number in ("held", "sign", "limit"))
        pulling = call("add", effort_at_rest(stop), limit)
        closed, rate = call("add", held, call("mul", call("sub", ONE, held), limit)), rate_of(stop)
        open_gap = call("add", call("mul", call("sub", ONE, closed), gap_of(stop)), closed)
        pushing = call("add", call("mul", held, pulling), call("sub", ONE, held))
        rebound = call("mul", call("mul", Number(0.5), stop.restitution), call("sub", call("abs", rate), rate))
        after = call("mul", call("sub", ONE, call("mul", sign, sign)), rebound)
        events.append(Event(f"{stop.name}.{HIT}", open_gap, "falling", MODE, ((rate, after),), "gap 0"))
        events.append(Event(f"{stop.name}.{LEAVE}", pushing, "falling", MODE, (), "force of a closed stop 0"))
    return tuple(events)


def stop_outputs(stops: Sequence[EndStop], frictions: Sequence[Friction]) -> Iterator[Output]:
    """Yield mode (1 closed, 0 open) and force of each stop, which pushes."""
    shared = {stop.name for friction in frictions for stop in stops_along(friction, stops)}
    for stop in stops:
        held, limit = number_of(stop, "held"), number_of(stop, "limit")
        closed = call("add", held, call("mul", call("sub", ONE, held), limit))
        force: Expr = effort_at_rest(stop)
        if stop.name in shared:
            force = call("mul", Number(0.5), call("add", force, call("abs", force)))
        yield Output(f"{stop.name}.mode", closed, "")
        yield Output(f"{stop.name}.force", force, "N m" if stop.unit == "rad" else "N")


def with_stop_outputs(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism that reports modes and forces of its stops."""
    if not mechanism.stops:
        return mechanism
    return msgspec.structs.replace(
        mechanism, outputs=(*mechanism.outputs, *stop_outputs(mechanism.stops, mechanism.frictions))
    )


def without_stops(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism without its stops and what it reports of them."""
    if not mechanism.stops:
        return mechanism
    outputs = outputs_without(mechanism, stop_outputs(mechanism.stops, mechanism.frictions))
    return msgspec.structs.replace(mechanism, stops=(), outputs=outputs)


def refuse_bounds(where: str, mechanism: Mechanism) -> None:
    """Refuse a mechanism with dry friction or stops where nothing chooses their modes.

    Raises
    ------
    InputError
        If it has any.
    """
    refuse_friction(where, mechanism)
    if mechanism.stops:
        names = ", ".join(stop.name for stop in mechanism.stops)
        raise InputError(where, "a mechanism without stops", names, "runs and sweeps have them")
