"""Dry friction of joints: the key ``friction`` of a file, its force as an effort, and the events of its modes.

A coordinate with dry friction has a row that is in force at rest (`symgen.base.ir.program.MODES`), and an effort of a
given sign in motion. The numbers of the row are names of formulas: ``NAME.friction.held``, ``.sign`` and ``.limit``.
Where the bounds depend on the joint's reaction, laws solve for the effort in motion (`symgen.derive.lower.drag`), and
``NAME.friction.jamming`` is the square of the part of the reaction that its own friction brings about.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Literal

import msgspec

from symgen.base.errors import InputError
from symgen.base.ir.program import JAMMING, MODE_NUMBERS, MODES
from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Name, Number, Reading, call, dot, readings
from symgen.base.vocabulary.measures import (
    GROUND,
    Dot,
    Driven,
    Effort,
    Exerted,
    Holonomic,
    Integral,
    Measure,
    Sum,
    Turn,
    axes,
)
from symgen.describe.mechanism import EndStop, Event, Friction, Joint, Mechanism, Output
from symgen.describe.parts.fields import Scalar, read_table, words_of
from symgen.describe.parts.scope import Scope

#: Kinds of joints, in the plane and in space, whose rows of forces are the components of a reaction.
REACTING = ("revolute", "translational", "pin-in-slot")
REACTING_IN_SPACE = ("revolute", "translational", "cylindrical")
#: Action of events at which modes are chosen anew.
MODE = "mode"
#: Last words of their names: rest ends, a rate passes zero, rest begins.
SLIP, REVERSE, STICK = "slip", "reverse", "stick"
#: Last words of the names of the stops of a coordinate.
LOWER, UPPER = "lower", "upper"
#: Last word of the event at which friction by a reaction would bring about all of the reaction itself.
JAM = "jam"


class FrictionSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Dry friction along a coordinate of a joint.

    Parameters
    ----------
    sliding : scalar
        Force or torque in motion [N or N m].
    coefficient : scalar
        In place of `sliding`, force in motion over the size of the joint's reaction, in space across its axis.
    static_coefficient : scalar
        The same at rest; `coefficient` by default.
    radius : scalar
        Of a pin, the arm of this force [m].
    static : scalar
        Largest force or torque at rest; `sliding` by default.
    viscous : scalar
        Force over rate [N s/m or N m s]; 0 by default.
    stribeck_speed : scalar
        Rate [m/s or rad/s] over which the bound falls from `static` to `sliding`; without it the bound is `sliding` as
        soon as the coordinate moves.
    law : {"exact", "tanh"}
        Friction that sticks, or a smooth force in its place: the bound times tanh(rate / `speed`), which creeps.
    speed : scalar
        Rate of `law` = "tanh" [m/s or rad/s].
    """

    sliding: Scalar | None = None
    static: Scalar | None = None
    coefficient: Scalar | None = None
    static_coefficient: Scalar | None = None
    radius: Scalar | None = None
    viscous: Scalar = 0.0
    stribeck_speed: Scalar | None = None
    law: Literal["exact", "tanh"] = "exact"
    speed: Scalar | None = None


def read_friction(scope: Scope, joint: Joint, raw: object) -> tuple[Friction, ...]:
    """Return the dry friction of a joint from its key.

    Parameters
    ----------
    scope : Scope
        The place of the joint.
    joint : Joint
        The joint.
    raw : object
        Keys of its only coordinate, or a table of such keys for some of its coordinates.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    labels = dict(joint.coordinates)
    tables = by_coordinate(scope, joint, "friction", raw, "{ sliding = 4.0 }")
    return tuple(_along(scope, joint, label, labels[label], table, len(labels) == 1) for label, table in tables.items())


def by_coordinate(scope: Scope, joint: Joint, key: str, raw: object, example: str) -> Mapping[str, object]:
    """Return the table that a key of a joint holds for each of its coordinates.

    Parameters
    ----------
    scope : Scope
        The place of the joint.
    joint : Joint
        The joint.
    key : str
        The key.
    raw : object
        A table for its only coordinate, or a table of such tables.
    example : str
        A table for a coordinate.

    Raises
    ------
    InputError
        If it is no table, or the joint has no such coordinates.
    """
    if not isinstance(raw, Mapping):
        raise scope.error(key, f"a table such as {example}", words_of(raw))
    labels = dict(joint.coordinates)
    if not labels:
        raise scope.error(key, "a joint with a coordinate", f"a {joint.kind} joint, which reports none")
    if joint.kind == "driver":
        raise scope.error(key, "a joint whose coordinate is free", "a driver")
    if len(labels) == 1 and not set(raw) & set(labels):
        return {next(iter(labels)): raw}
    if not raw or not set(raw) <= set(labels):
        other = next((repr(label) for label in raw if label not in labels), "none")
        raise scope.error(key, f"coordinates of the joint ({', '.join(labels)})", other)
    return raw


def _along(scope: Scope, joint: Joint, label: str, measure: Measure, raw: object, single: bool) -> Friction:
    key = "friction" if single else f"friction.{label}"
    section = read_table(FrictionSection, raw, scope.where(key))

    def bound(name: str, value: float | str) -> Expr:
        expression = scope.constant(f"{key}.{name}", value)
        if (size := scope.value(expression, f"{key}.{name}")) < 0.0:
            raise scope.error(f"{key}.{name}", "a value of at least 0", repr(size))
        return expression

    pressed = _pressed(scope, joint, label, key, section)
    names = ("coefficient", "static_coefficient") if pressed else ("sliding", "static")
    least, most = (getattr(section, name) for name in names)
    sliding = bound(names[0], least)
    static = sliding if most is None else bound(names[1], most)
    low, high = (scope.value(x, f"{key}.{name}") for x, name in zip((sliding, static), names, strict=True))
    if high < low:
        raise scope.error(f"{key}.{names[1]}", f"a bound of at least that in motion ({low!r})", repr(high))
    if low == 0.0 < high:
        raise scope.error(f"{key}.{names[0]}", "a value above 0, as that at rest is above 0", "0.0")
    if section.radius is not None:
        radius = scope.constant(f"{key}.radius", section.radius, positive=True)
        sliding, static = call("mul", sliding, radius), call("mul", static, radius)
    speed, smooth = section.stribeck_speed, section.law == "tanh"
    if smooth != (section.speed is not None):
        got = "no such key" if smooth else words_of(section.speed)
        raise scope.error(
            f"{key}.speed", 'a rate beside law = "tanh"' if smooth else 'no such key without law = "tanh"', got
        )
    if smooth and (pressed or (speed is None and section.static is not None)):
        got = "coefficient" if pressed else "static without stribeck_speed"
        raise scope.error(f"{key}.law", 'a constant bound in motion beside "tanh"', f"the key {got}")
    return Friction(
        name=joint.name if single else f"{joint.name}.{label}",
        joint=joint.name,
        measure=measure,
        unit=joint.unit(label),
        sliding=sliding,
        static=static,
        viscous=bound("viscous", section.viscous),
        stribeck_speed=None if speed is None else scope.constant(f"{key}.stribeck_speed", speed, positive=True),
        pressed=pressed,
        across=_across(measure, pressed),
        speed=scope.constant(f"{key}.speed", section.speed, positive=True) if section.speed is not None else None,
    )


def _pressed(scope: Scope, joint: Joint, label: str, key: str, section: FrictionSection) -> tuple[str, ...]:
    """Return the rows whose forces are the reaction that bounds depend on; none where they are constant."""
    by_reaction = ("coefficient", "static_coefficient", "radius")
    of_reaction = [name for name in by_reaction if getattr(section, name) is not None]
    constant = [name for name in ("sliding", "static") if getattr(section, name) is not None]
    if constant and of_reaction:
        got = f"{getattr(section, of_reaction[0])}"
        raise scope.error(f"{key}.{of_reaction[0]}", f"no such key beside {constant[0]}", got)
    first = "coefficient" if of_reaction else "sliding"
    if getattr(section, first) is None:
        got = " and ".join(of_reaction or constant) or "neither"
        expected = (
            "the key coefficient" if of_reaction else "the key sliding, or coefficient for friction by the reaction"
        )
        raise scope.error(key, expected, got)
    if not of_reaction:
        return ()
    kinds = REACTING_IN_SPACE if scope.spatial else REACTING
    rows = tuple(f"{joint.name}.{row.label}" for row in joint.rows if isinstance(row, Holonomic) and row.unit == "m")
    if not rows or joint.kind not in kinds:
        expected = f"friction by the reaction of a joint among {', '.join(kinds)}"
        raise scope.error(f"{key}.coefficient", expected, f"a {joint.kind} joint")
    turns = joint.unit(label) == "rad"
    if turns and section.radius is None:
        raise scope.error(f"{key}.radius", "the radius of the pin, as its reaction acts there", "no such key")
    if not turns and section.radius is not None:
        raise scope.error(f"{key}.radius", "no radius, as the coordinate is a displacement", f"{section.radius}")
    return rows


def _across(measure: Measure, pressed: Sequence[str]) -> tuple[tuple[Measure, ...], ...]:
    """Return the cosines of the axes of ground with two directions across the axis of a hinge in space."""
    if len(pressed) < 3:
        return ()
    assert isinstance(measure, Turn), "a joint with three forces turns about an axis"
    return tuple(tuple(Dot(e, axis) for axis in axes(GROUND, 3)) for e in (measure.zero, measure.quarter))


def check_frictions(mechanism: Mechanism, source: str) -> None:
    """Refuse dry friction along coordinates that drivers prescribe.

    Raises
    ------
    InputError
        With the joint.
    """
    driven: dict[Measure, str] = {}
    for joint in mechanism.joints:
        for row in joint.rows if joint.kind == "driver" else ():
            if isinstance(row, Holonomic):
                driven[_upright(row.measure)] = joint.name
    for friction in mechanism.frictions:
        driver = driven.get(_upright(friction.measure))
        if driver is not None:
            where = f"{source}: joints.{friction.joint}.friction"
            raise InputError(where, "a coordinate that no driver prescribes", f"one that '{driver}' prescribes")


def _upright(measure: Measure) -> Measure:
    """Return a measure, or the one that it is the negative of."""
    if isinstance(measure, Sum) and len(measure.terms) == 1 and measure.terms[0][0] == Number(-1.0):
        return measure.terms[0][1]
    return measure


# -- modes -------------------------------------------------------------------------------------------------------------


def first_modes(mechanism: Mechanism) -> Iterator[tuple[str, int]]:
    """Yield joints whose rows may be off, then rows with bounds, with the place of their first number of modes."""
    first = 0
    for joint in mechanism.joints:
        if joint.name in mechanism.switchable:
            yield joint.name, first
            first += MODE_NUMBERS * len(joint.rows)
    for bounded in mechanism.bounded:
        yield bounded.row, first
        first += MODE_NUMBERS


def mode_names(mechanism: Mechanism) -> dict[str, int]:
    """Return the names of the numbers of rows with bounds, with their places in the section ``modes``."""
    places = dict(first_modes(mechanism)) if mechanism.bounded else {}
    return {
        f"{bounded.row}.{number}": places[bounded.row] + i
        for bounded in mechanism.bounded
        for i, number in enumerate(MODES)
    }


def jamming_names(mechanism: Mechanism) -> dict[str, int]:
    """Return the names of jamming numbers, with their places in the section ``jamming``."""
    pressed = (friction for friction in mechanism.frictions if friction.pressed)
    return {f"{friction.row}.{JAMMING}": i for i, friction in enumerate(pressed)}


def number_of(bounded: Friction | EndStop, number: str) -> Name:
    """Return the name of a number of a row with bounds."""
    return Name(f"{bounded.row}.{number}")


def bound_in_motion(friction: Friction, rate: Expr = ZERO) -> Expr:
    """Return the bound at a rate, by default at the beginning of a motion."""
    if friction.stribeck_speed is None:
        return friction.sliding
    ratio = call("div", rate, friction.stribeck_speed)
    fall = call("exp", call("neg", call("mul", ratio, ratio)))
    return call("add", friction.sliding, call("mul", call("sub", friction.static, friction.sliding), fall))


def sign_of_rate(friction: Friction) -> Name:
    """Return the sign of the rate in motion, 0 at rest."""
    return number_of(friction, "sign")


def coefficient_of(friction: Friction) -> Expr:
    """Return the bound in motion over the size of the reaction, a formula of ``rate``."""
    return bound_in_motion(friction, Name("rate"))


def effort_in_motion(friction: Friction) -> Effort:
    """Return the effort of a coordinate that moves; its sign is a number of the row, 0 at rest.

    The number ``effort`` is that of friction at rest which shares its hold with other rows, 0 in motion. Of friction by
    a reaction only this and the viscous part are here.
    """
    rate = Name("rate")
    against: Expr = number_of(friction, "effort")
    if not friction.pressed:
        against = call("add", against, call("mul", sign_of_rate(friction), bound_in_motion(friction, rate)))
    return Effort("friction", friction.measure, call("neg", call("add", against, call("mul", friction.viscous, rate))))


def effort_at_rest(bounded: Friction | EndStop) -> Reading:
    """Return the effort of the row, 0 where it is off."""
    return Reading(bounded.row, Driven(bounded.row, bounded.measure))


def components(friction: Friction) -> tuple[Expr, ...]:
    """Return the components of the reaction that bounds depend on."""
    forces = [Reading(row, Driven(row, friction.measure)) for row in friction.pressed]
    if not friction.across:
        return tuple(forces)
    return tuple(
        dot(
            forces,
            [Reading(f"{friction.name}.across{k}{axis}", cosine) for axis, cosine in zip("xyz", line, strict=True)],
        )
        for k, line in enumerate(friction.across)
    )


def reaction_of(friction: Friction) -> Expr:
    """Return the factor of the bounds: the size of the reaction, or 1."""
    parts = components(friction)
    if not parts:
        return ONE
    if len(parts) == 1:
        return call("abs", parts[0])
    squares = [call("mul", part, part) for part in parts]
    return call("sqrt", call("add", *squares))


def rate_of(bounded: Friction | EndStop, order: int = 1) -> Reading:
    """Return a derivative of the coordinate, or of the gap."""
    return Reading(f"{bounded.name}{'.rate' * order}", bounded.measure, order)


def mode_events(mechanism: Mechanism) -> tuple[Event, ...]:
    """Return the events at which modes of dry friction are chosen anew.

    A function of another mode is 1: it sleeps.
    """
    events = list[Event]()
    for friction in mechanism.frictions:
        held, sign, limit = (number_of(friction, number) for number in ("held", "sign", "limit"))
        if friction.pressed:
            limit_at_rest: Expr = call("add", call("mul", friction.static, reaction_of(friction)), limit)
        else:
            limit_at_rest = limit
        left = call("sub", limit_at_rest, call("abs", effort_at_rest(friction)))
        resting = call("add", call("mul", held, left), call("sub", ONE, held))
        moving = call("add", call("mul", sign, rate_of(friction)), call("sub", ONE, call("mul", sign, sign)))
        events.append(Event(f"{friction.name}.{SLIP}", resting, "falling", MODE, (), "effort at rest at its bound"))
        events.append(Event(f"{friction.name}.{REVERSE}", moving, "falling", MODE, (), "rate of sliding 0"))
        if friction.pressed:
            free = call("sub", ONE, number_of(friction, JAMMING))
            events.append(Event(f"{friction.name}.{JAM}", free, "falling", MODE, (), "jamming number 1"))
    return tuple(events)


def with_friction_outputs(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism that reports modes and forces of its dry friction."""
    if not mechanism.frictions:
        return mechanism
    reports = friction_outputs(mechanism.frictions, mechanism.stops)
    return msgspec.structs.replace(mechanism, outputs=(*mechanism.outputs, *reports))


def friction_outputs(frictions: Sequence[Friction], stops: Sequence[EndStop]) -> Iterator[Output]:
    """Yield mode (0 at rest, else the sign of the rate) and force of each dry friction.

    A closed stop carries the friction of its own coordinate: where its effort pulls, that is friction.
    """
    for friction in frictions:
        total = total_effort(friction)
        for stop in stops_along(friction, stops):
            effort = effort_at_rest(stop)
            pulls = call("mul", Number(0.5), call("sub", effort, call("abs", effort)))
            total = call("sub" if stop.name == f"{friction.name}.{UPPER}" else "add", total, pulls)
        yield Output(f"{friction.name}.mode", sign_of_rate(friction), "")
        yield Output(f"{friction.name}.force", total, unit_of_effort(friction))


def stops_along(friction: Friction, stops: Sequence[EndStop]) -> tuple[EndStop, ...]:
    """Return the stops of the coordinate of a dry friction."""
    names = {f"{friction.name}.{end}" for end in (LOWER, UPPER)}
    return tuple(stop for stop in stops if stop.owner == friction.joint and stop.name in names)


def total_effort(friction: Friction) -> Expr:
    """Return the effort of dry friction at rest and in motion, a formula of outputs."""
    force = Reading(f"{friction.name}.force", Exerted((effort_in_motion(friction),)))
    total = call("add", force, effort_at_rest(friction))
    if not friction.pressed:
        return total
    against = call("mul", bound_in_motion(friction, rate_of(friction)), reaction_of(friction))
    return call("sub", total, call("mul", sign_of_rate(friction), against))


def unit_of_effort(friction: Friction) -> str:
    """Return the unit of its force."""
    return "N m" if friction.unit == "rad" else "N"


def without_friction(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism without its dry friction and what it reports of that."""
    if not mechanism.frictions:
        return mechanism
    outputs = outputs_without(mechanism, friction_outputs(mechanism.frictions, mechanism.stops))
    return msgspec.structs.replace(mechanism, frictions=(), outputs=outputs)


def outputs_without(mechanism: Mechanism, reports: Iterable[Output]) -> tuple[Output, ...]:
    """Return the outputs of a mechanism without some reports, and without integrals of what they report."""
    reported = {output.name: None for output in reports}
    rows = {bounded.row for bounded in mechanism.bounded}

    def reads(value: Expr) -> bool:
        sources = [reading.source for reading in readings(value)]
        inner = [source.of for source in sources if isinstance(source, Integral)]
        return any(isinstance(s, Driven) and s.row in rows for s in sources) or any(map(reads, inner))

    return tuple(o for o in mechanism.outputs if o.name not in reported and not reads(o.value))


def refuse_friction(where: str, mechanism: Mechanism) -> None:
    """Refuse a mechanism with dry friction where nothing chooses its modes.

    Raises
    ------
    InputError
        If it has any.
    """
    if mechanism.frictions:
        names = ", ".join(friction.name for friction in mechanism.frictions)
        raise InputError(where, "a mechanism without dry friction", f"that of {names}", "runs and sweeps have it")
