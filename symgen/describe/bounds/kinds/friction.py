"""The key ``friction`` of joints: dry friction along their coordinates."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from symgen.base.vocabulary.expressions import Expr, call
from symgen.base.vocabulary.measures import Measure
from symgen.describe.bounds.by_reaction import directions_across, reacting_rows
from symgen.describe.bounds.dry_friction import FRICTION, Friction
from symgen.describe.bounds.keys import KeyOfJoints, by_coordinate
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Scalar, read_table, words_of
from symgen.describe.parts.scope import Scope

FrictionTable = Annotated[
    dict[str, float | str | dict[str, float | str]],
    Meta(description="a table of bounds such as { sliding = 4.0 }, or one for each coordinate"),
]


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
        across=directions_across(measure, pressed),
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
    rows = reacting_rows(scope, joint, f"{key}.coefficient")
    turns = joint.unit(label) == "rad"
    if turns and section.radius is None:
        raise scope.error(f"{key}.radius", "the radius of the pin, as its reaction acts there", "no such key")
    if not turns and section.radius is not None:
        raise scope.error(f"{key}.radius", "no radius, as the coordinate is a displacement", f"{section.radius}")
    return rows


KIND = KeyOfJoints("friction", FRICTION, FrictionTable, read_friction)
