"""Dry friction of joints: the key ``friction`` of a file, its force as an effort, and the events of its modes.

A coordinate with dry friction has a row that is in force at rest (`symgen.ir.program.MODES`), and an effort of a given
sign in motion. The numbers of the row are names of formulas: ``NAME.friction.held``, ``.sign`` and ``.limit``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec

from symgen.base.errors import InputError
from symgen.describe.fields import Scalar, read_table, words_of
from symgen.describe.mechanism import EndStop, Event, Friction, Joint, Mechanism, Output
from symgen.describe.scope import Scope
from symgen.ir.program import MODE_NUMBERS, MODES
from symgen.vocabulary.expressions import ONE, ZERO, Expr, Name, Number, Reading, call
from symgen.vocabulary.measures import Driven, Effort, Exerted, Holonomic, Measure, Sum

#: Action of events at which modes are chosen anew.
MODE = "mode"
#: Last words of their names: rest ends, a rate passes zero, rest begins.
SLIP, REVERSE, STICK = "slip", "reverse", "stick"


class FrictionSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Dry friction along a coordinate of a joint.

    Parameters
    ----------
    sliding : scalar
        Force or torque in motion [N or N m].
    static : scalar
        Largest force or torque at rest; `sliding` by default.
    viscous : scalar
        Force over rate [N s/m or N m s]; 0 by default.
    stribeck_speed : scalar
        Rate [m/s or rad/s] over which the bound falls from `static` to `sliding`; without it the bound is `sliding` as
        soon as the coordinate moves.
    """

    sliding: Scalar
    static: Scalar | None = None
    viscous: Scalar = 0.0
    stribeck_speed: Scalar | None = None


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
    """Return what a key of a joint has for each of its coordinates.

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

    sliding = bound("sliding", section.sliding)
    static = sliding if section.static is None else bound("static", section.static)
    low, high = scope.value(sliding, f"{key}.sliding"), scope.value(static, f"{key}.static")
    if high < low:
        raise scope.error(f"{key}.static", f"a bound of at least that in motion ({low!r})", repr(high))
    if low == 0.0 < high:
        raise scope.error(f"{key}.sliding", "a value above 0, as that at rest is above 0", "0.0")
    speed = section.stribeck_speed
    return Friction(
        name=joint.name if single else f"{joint.name}.{label}",
        joint=joint.name,
        measure=measure,
        unit=joint.unit(label),
        sliding=sliding,
        static=static,
        viscous=bound("viscous", section.viscous),
        stribeck_speed=None if speed is None else scope.constant(f"{key}.stribeck_speed", speed, positive=True),
    )


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


def effort_in_motion(friction: Friction) -> Effort:
    """Return the effort of a coordinate that moves; its sign is a number of the row, 0 at rest."""
    rate = Name("rate")
    against = call("mul", number_of(friction, "sign"), bound_in_motion(friction, rate))
    return Effort("friction", friction.measure, call("neg", call("add", against, call("mul", friction.viscous, rate))))


def effort_at_rest(bounded: Friction | EndStop) -> Reading:
    """Return the effort of the row, 0 where it is off."""
    return Reading(bounded.row, Driven(bounded.row, bounded.measure))


def rate_of(bounded: Friction | EndStop, order: int = 1) -> Reading:
    """Return a derivative of the coordinate, or of the gap."""
    return Reading(f"{bounded.name}, derivative {order}", bounded.measure, order)


def mode_events(mechanism: Mechanism) -> tuple[Event, ...]:
    """Return the events at which modes of dry friction are chosen anew.

    A function of another mode is 1: it sleeps.
    """
    events = list[Event]()
    for friction in mechanism.frictions:
        held, sign, limit = (number_of(friction, number) for number in ("held", "sign", "limit"))
        left = call("sub", limit, call("abs", effort_at_rest(friction)))
        resting = call("add", call("mul", held, left), call("sub", ONE, held))
        moving = call("add", call("mul", sign, rate_of(friction)), call("sub", ONE, call("mul", sign, sign)))
        events.append(Event(f"{friction.name}.{SLIP}", resting, "falling", MODE, (), "effort at rest at its bound"))
        events.append(Event(f"{friction.name}.{REVERSE}", moving, "falling", MODE, (), "rate of sliding 0"))
    return tuple(events)


def with_friction_outputs(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism that reports modes and forces of its dry friction."""
    if not mechanism.frictions:
        return mechanism
    return msgspec.structs.replace(mechanism, outputs=(*mechanism.outputs, *friction_outputs(mechanism.frictions)))


def friction_outputs(frictions: Sequence[Friction]) -> Iterator[Output]:
    """Yield mode (0 at rest, else the sign of the rate) and force of each dry friction."""
    for friction in frictions:
        force = Reading(f"{friction.name}.force", Exerted((effort_in_motion(friction),)))
        unit = "N m" if friction.unit == "rad" else "N"
        yield Output(f"{friction.name}.mode", number_of(friction, "sign"), "")
        yield Output(f"{friction.name}.force", call("add", force, effort_at_rest(friction)), unit)


def without_friction(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism without its dry friction and what it reports of that."""
    if not mechanism.frictions:
        return mechanism
    reported = {output.name for output in friction_outputs(mechanism.frictions)}
    outputs = tuple(output for output in mechanism.outputs if output.name not in reported)
    return msgspec.structs.replace(mechanism, frictions=(), outputs=outputs)


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
