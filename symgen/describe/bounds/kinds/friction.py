"""The key ``friction`` of joints: dry friction along their coordinates."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from symgen.base.vocabulary.expressions import ZERO, Expr, call
from symgen.base.vocabulary.measures import Measure
from symgen.describe.bounds.by_reaction import directions_across, reacting_rows
from symgen.describe.bounds.changing import is_constant, read_bound
from symgen.describe.bounds.dry_friction import FRICTION, Friction, bound_at_rate, mean_of
from symgen.describe.bounds.keys import KeyOfJoints, tables_by_coordinate
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Scalar, StateBound, StateFunction, read_table, value_in_words
from symgen.describe.parts.scope import Scope

FrictionTable = Annotated[
    dict[str, float | str | dict[str, float | str | dict[str, float | str]]],
    Meta(description="a table of bounds such as { sliding = 4.0 }, or one for each coordinate"),
]


class FrictionSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Dry friction along a coordinate of a joint.

    Bounds are numbers or formulas of t, parameters, inputs and state; a formula below 0 counts as 0.

    Parameters
    ----------
    sliding : scalar or table
        Force or torque in motion [N or N m], a formula also of `rate`, the size of the rate; ``{ forwards = ...,
        backwards = ... }`` where it differs in the two directions.
    coefficient : scalar
        In place of `sliding`, force in motion over the size of the joint's reaction, in space across its axis.
    static_coefficient : scalar
        The same at rest; `coefficient` by default.
    radius : scalar
        Of a pin, the arm of this force [m].
    static : scalar or table
        Largest force or torque at rest; by default `sliding` where `rate` is 0. Beside a table in `sliding` one number
        holds both ways, or a table has one for each.
    viscous : scalar
        Force over rate [N s/m or N m s]; 0 by default.
    stribeck_speed : scalar
        Rate [m/s or rad/s] over which the bound falls from `static` to `sliding`; without it the bound is `sliding` as
        soon as the coordinate moves.
    stribeck_exponent : scalar
        Exponent of this fall, exp(-(rate/stribeck_speed)^exponent), at least 1; 2 by default.
    law : {"exact", "tanh"}
        Friction that sticks, or a smooth force in its place: the bound times tanh(rate / `speed`), which creeps.
    speed : scalar
        Rate of `law` = "tanh" [m/s or rad/s].
    """

    sliding: StateBound | None = None
    static: StateBound | None = None
    coefficient: StateFunction | None = None
    static_coefficient: StateFunction | None = None
    radius: Scalar | None = None
    viscous: StateFunction = 0.0
    stribeck_speed: Scalar | None = None
    stribeck_exponent: Scalar | None = None
    law: Literal["exact", "tanh"] = "exact"
    speed: Scalar | None = None


class BothWays(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Bounds that differ in the two directions.

    Parameters
    ----------
    forwards, backwards : scalar
        Force or torque [N or N m] where the rate of the coordinate is above 0, and where it is below.
    """

    forwards: StateFunction
    backwards: StateFunction


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
    tables = tables_by_coordinate(scope, joint, "friction", raw, "{ sliding = 4.0 }")
    return tuple(
        _friction_along_coordinate(scope, joint, label, labels[label], table, len(labels) == 1)
        for label, table in tables.items()
    )


def _friction_along_coordinate(
    scope: Scope, joint: Joint, label: str, measure: Measure, raw: object, single: bool
) -> Friction:
    key = "friction" if single else f"friction.{label}"
    section = read_table(FrictionSection, raw, scope.where(key))
    pressed = _reaction_rows(scope, joint, label, key, section)
    bounds = _read_bounds(
        scope, key, section, ("coefficient", "static_coefficient") if pressed else ("sliding", "static")
    )
    sliding, static, backwards, resting, changing = bounds
    if section.radius is not None:
        radius = scope.constant(f"{key}.radius", section.radius, positive=True)
        sliding, static = call("mul", sliding, radius), call("mul", static, radius)
    speed, smooth = section.stribeck_speed, section.law == "tanh"
    if smooth != (section.speed is not None):
        got = "no such key" if smooth else value_in_words(section.speed)
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
        viscous=read_bound(scope, f"{key}.viscous", section.viscous),
        stribeck_speed=None if speed is None else scope.constant(f"{key}.stribeck_speed", speed, positive=True),
        exponent=_stribeck_exponent(scope, key, section),
        backwards=backwards,
        resting=resting,
        changing=changing,
        pressed=pressed,
        across=directions_across(joint, measure, pressed),
        speed=scope.constant(f"{key}.speed", section.speed, positive=True) if section.speed is not None else None,
    )


def _read_bounds(
    scope: Scope, key: str, section: FrictionSection, names: tuple[str, str]
) -> tuple[Expr, Expr, Expr | None, tuple[Expr, ...], bool]:
    """Return the bounds of friction.

    Returns
    -------
    sliding, static : Expr
        In motion and at rest; of bounds of two directions forwards, and the mean.
    backwards : Expr or None
        In motion backwards, where that differs.
    resting : tuple of Expr
        At rest forwards and backwards, where a file has these.
    changing : bool
        Whether any is more than a number.
    """
    least, most = (getattr(section, name) for name in names)
    if isinstance(least, dict):
        return _read_bounds_of_both_ways(scope, key, section, least, most)
    if isinstance(most, dict):
        raise scope.error(f"{key}.{names[1]}", f"one bound, as {names[0]} has one", value_in_words(most))
    sliding = read_bound(scope, f"{key}.{names[0]}", least, ("rate",))
    static = bound_at_rate(sliding, ZERO) if most is None else read_bound(scope, f"{key}.{names[1]}", most)
    changing = _is_changing(scope, sliding, static)
    if not changing:
        _refuse_less_at_rest(scope, (f"{key}.{names[0]}", sliding), (f"{key}.{names[1]}", static))
        _refuse_rest_alone(scope, f"{key}.{names[0]}", sliding, static)
    return sliding, static, None, (), changing


def _read_bounds_of_both_ways(
    scope: Scope, key: str, section: FrictionSection, least: Mapping[str, object], most: StateBound | None
) -> tuple[Expr, Expr, Expr | None, tuple[Expr, ...], bool]:
    """Return the bounds of friction whose two directions have one each; see `_read_bounds`."""
    if section.stribeck_speed is not None:
        expected = "no such key beside bounds of two directions, which may be formulas of rate"
        raise scope.error(f"{key}.stribeck_speed", expected, value_in_words(section.stribeck_speed))
    moving = _bounds_by_direction(scope, f"{key}.sliding", least, ("rate",))
    if isinstance(most, dict):
        resting = _bounds_by_direction(scope, f"{key}.static", most)
    elif most is not None:
        resting = [(f"{key}.static", read_bound(scope, f"{key}.static", most))] * 2
    else:
        resting = [(at, bound_at_rate(bound, ZERO)) for at, bound in moving]
    begins, held = (tuple(bound_at_rate(bound, ZERO) for _, bound in each) for each in (moving, resting))
    changing = _is_changing(scope, *begins, *held)
    if not changing:
        for slides, holds in zip(moving, resting, strict=True):
            _refuse_less_at_rest(scope, slides, holds)
        _refuse_rest_alone(scope, f"{key}.sliding", mean_of(*begins), mean_of(*held))
    own = () if most is None else held
    return moving[0][1], mean_of(*held), moving[1][1], own, changing


def _is_changing(scope: Scope, *bounds: Expr) -> bool:
    """Return whether any of some bounds is more than a number where the rate is 0."""
    return not all(is_constant(scope, bound_at_rate(bound, ZERO)) for bound in bounds)


def _refuse_less_at_rest(scope: Scope, moving: tuple[str, Expr], resting: tuple[str, Expr]) -> None:
    """Refuse a constant bound at rest below that in motion, each with its key."""
    low, high = (scope.value(bound_at_rate(bound, ZERO), key) for key, bound in (moving, resting))
    if high < low:
        raise scope.error(resting[0], f"a bound of at least that in motion ({low!r})", repr(high))


def _refuse_rest_alone(scope: Scope, key: str, moving: Expr, resting: Expr) -> None:
    """Refuse a constant bound in motion of 0 beside one at rest above 0."""
    if scope.value(bound_at_rate(moving, ZERO), key) == 0.0 < scope.value(resting, key):
        raise scope.error(key, "a value above 0, as that at rest is above 0", "0.0")


def _bounds_by_direction(
    scope: Scope, key: str, raw: Mapping[str, object], names: tuple[str, ...] = ()
) -> list[tuple[str, Expr]]:
    """Return the bounds of motions forwards and backwards, each with its key."""
    ways = read_table(BothWays, raw, scope.where(key))
    return [
        (f"{key}.{way}", read_bound(scope, f"{key}.{way}", getattr(ways, way), names))
        for way in ("forwards", "backwards")
    ]


def _stribeck_exponent(scope: Scope, key: str, section: FrictionSection) -> Expr | None:
    """Return the exponent of the fall over the rate; None for 2."""
    if section.stribeck_exponent is None:
        return None
    if section.stribeck_speed is None:
        got = value_in_words(section.stribeck_exponent)
        raise scope.error(f"{key}.stribeck_exponent", "the key stribeck_speed beside it", got)
    exponent = scope.constant(f"{key}.stribeck_exponent", section.stribeck_exponent)
    if not (value := scope.value(exponent, f"{key}.stribeck_exponent")) >= 1.0:
        raise scope.error(f"{key}.stribeck_exponent", "a value of at least 1", repr(value))
    return exponent


def _reaction_rows(scope: Scope, joint: Joint, label: str, key: str, section: FrictionSection) -> tuple[str, ...]:
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
    rows = reacting_rows(scope, joint, f"{key}.coefficient")
    turns = joint.unit(label) == "rad"
    if turns and section.radius is None:
        raise scope.error(f"{key}.radius", "the radius of the pin, as its reaction acts there", "no such key")
    if not turns and section.radius is not None:
        raise scope.error(f"{key}.radius", "no radius, as the coordinate is a displacement", f"{section.radius}")
    return rows


KIND = KeyOfJoints("friction", FRICTION, FrictionTable, read_friction)
