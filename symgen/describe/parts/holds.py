"""Quantities that a start keeps: from keys of bodies and joints in a file, and from names and values of a run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.expressions import Number
from symgen.base.vocabulary.measures import GROUND, Angle
from symgen.describe.formulas.formula_slips import meant_coordinate
from symgen.describe.mechanism import AnyBody, Hold, Joint, Mechanism, SpatialBody
from symgen.describe.remembered import compute_once

if TYPE_CHECKING:
    from symgen.describe.parts.scope import Scope

#: Word of the key ``hold`` -> the keys it refers to, in the plane and in space.
_WORDS = {
    "position": ("position",),
    "angle": ("angle", "orientation"),
    "velocity": ("velocity", "angular_velocity"),
}
#: Name of the orientation of a body in space, which is not one of its coordinates.
ORIENTATION = "orientation"
_EULER = ("e0", "e1", "e2", "e3")


def body_holds(scope: Scope, raw: Mapping[str, Any], body: AnyBody) -> tuple[Hold, ...]:
    """Return the quantities that the key ``hold`` of a body's table keeps.

    Raises
    ------
    InputError
        If a word is unknown, or refers to a key that the table lacks.
    """
    value = raw.get("hold", False)
    described = [word for word, keys in _WORDS.items() if any(key in raw for key in keys)]
    words = [value] if isinstance(value, str) else described if value is True else list(value or ())
    for word in words:
        if word not in _WORDS:
            raise scope.error("hold", "true, or 'position', 'angle', 'velocity'", quote(word), suggest(word, _WORDS))
        if word not in described:
            keys = " or ".join(key for key in _WORDS[word] if key != ("angle" if scope.spatial else ORIENTATION))
            raise scope.error("hold", f"something that the body describes ({keys})", f"'{word}' without such a key")
    if value is True and not words:
        raise scope.error("hold", "a position, angle or velocity to keep", "a body that describes none")
    dimension, names = scope.dimension, list[str]()
    if "position" in words:
        names += body.coordinates[:dimension]
    if "angle" in words:
        names.append(ORIENTATION if isinstance(body, SpatialBody) else "theta")
    if "velocity" in words:
        names += [
            name
            for key, part in zip(_WORDS["velocity"], _velocity_names(body), strict=True)
            if key in raw
            for name in part
        ]
    return tuple(Hold(f"{body.name}.{name}") for name in names)


def _velocity_names(body: AnyBody) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the names of the velocities of the centre of mass, and of the angular ones."""
    moving = tuple(name for name in body.speeds if name in ("vx", "vy", "vz"))
    return moving, tuple(name for name in body.speeds if name[0] in "ow")


def joint_holds(scope: Scope, values: Mapping[str, float | str], joint: Joint) -> tuple[Hold, ...]:
    """Return the values in the key ``start`` of a joint's table: coordinates and their rates, which are kept.

    Raises
    ------
    InputError
        If a key is not a coordinate of the joint.
    """
    coordinates = {name.partition(".")[2]: whole for name, whole in _joint_quantity_names(joint).items()}
    if not coordinates:
        raise scope.error("start", "a joint that has coordinates", f"a {joint.kind} joint, which has none")
    for key in values:
        if key not in coordinates:
            raise scope.error(
                "start", f"coordinates of the joint ({', '.join(coordinates)})", quote(key), suggest(key, coordinates)
            )
    return tuple(Hold(coordinates[key], scope.constant(f"start.{key}", value)) for key, value in values.items())


def _joint_quantity_names(joint: Joint) -> dict[str, str]:
    """Return the full and short names of a joint's coordinates and rates, each with its full name."""
    names = [f"{joint.name}.{label}" for label, _ in joint.coordinates]
    whole_names = {whole: whole for name in names for whole in (name, f"{name}.rate")}
    return whole_names | ({f"{joint.name}.rate": f"{names[0]}.rate"} if len(names) == 1 else {})


def _joint_quantities_of_bodies(joint: Joint) -> dict[str, str]:
    """Return those joint coordinates and rates that are coordinates and velocities of bodies."""
    same = dict[str, str]()
    for label, measure in joint.coordinates:
        if isinstance(measure, Angle) and measure.a == GROUND:
            name = f"{joint.name}.{label}"
            same |= {name: f"{measure.b}.theta", f"{name}.rate": f"{measure.b}.omega"}
    return same


def joint_quantity_names(mechanism: Mechanism) -> dict[str, str]:
    """Return the names of joint coordinates and their rates, each with its canonical name.

    Short names map to full ones, and those of coordinates or velocities of a body to the body's names.
    """
    canonical = dict[str, str]()
    for joint in mechanism.joints:
        same = _joint_quantities_of_bodies(joint)
        canonical |= {name: same.get(whole, whole) for name, whole in _joint_quantity_names(joint).items()}
    return canonical


@compute_once
def _holdable_names(mechanism: Mechanism) -> tuple[dict[str, str], dict[str, str], dict[str, str]]:
    """Return the full names that a start may hold, names of bodies alone, and joint coordinates that bodies have."""
    bodies = {f"{b.name}.{n}": f"{b.name}.{n}" for b in mechanism.bodies for n in (*b.coordinates, *b.speeds)}
    joints, same = dict[str, str](), dict[str, str]()
    for joint in mechanism.joints:
        joints |= _joint_quantity_names(joint)
        same |= _joint_quantities_of_bodies(joint)
    own = (x.name for x in mechanism.states if "." not in x.name)  # those of joints that hold for a while are 0
    return bodies | joints | {name: name for name in own}, bodies, same


def canonical_hold_name(mechanism: Mechanism, name: str) -> str:
    """Return the one name under which `read_holds` keeps a quantity."""
    coordinates, _, same = _holdable_names(mechanism)
    return same.get(coordinates[name], coordinates[name])


def read_holds(
    mechanism: Mechanism, where: str = "start", values: Mapping[str, float] | None = None
) -> tuple[Hold, ...]:
    """Return all quantities that a start keeps, each under one name.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism; quantities held in its file are kept unless `values` replaces them.
    where : str
        Origin of the values, for messages.
    values : mapping of str to float, optional
        Values by names of coordinates and velocities of bodies and joints [m, rad, m/s, rad/s].

    Raises
    ------
    InputError
        If a name is unknown (the message names the nearest one), or two names mean one quantity.
    """
    coordinates, bodies, same = _holdable_names(mechanism)

    def holds_by_name(pairs: Iterable[tuple[str, Hold]]) -> dict[str, Hold]:
        unique: dict[str, tuple[str, Hold]] = {}
        for name, hold in pairs:
            one = same.get(hold.name, hold.name)
            if one in unique:
                raise InputError(where, "each thing held once", f"{unique[one][0]} and {name}, which are the same")
            unique[one] = name, Hold(one, hold.value)
        return {one: hold for one, (_, hold) in unique.items()}

    for name in values or {}:
        if name not in coordinates:
            state = ", or a state," if mechanism.states else ""
            expected = f"a coordinate or velocity of a body or joint{state} of {mechanism.name}"
            owner, _, label = name.rpartition(".")
            labels = [each.removeprefix(f"{owner}.") for each in coordinates if each.startswith(f"{owner}.")]
            hint = meant_coordinate(owner, label, labels) or suggest(name, coordinates)
            raise InputError(f"{where} '{name}'", expected, "none of that name", hint)
        if name in bodies and name.rpartition(".")[2] in _EULER:
            raise InputError(
                f"{where} '{name}'",
                "a coordinate that can change by itself",
                "an Euler parameter",
                "give the coordinate of a joint, or hold the orientation that the file describes",
            )
    own = holds_by_name((hold.name, hold) for hold in mechanism.holds)
    return tuple(
        (own | holds_by_name((n, Hold(coordinates[n], Number(float(x)))) for n, x in (values or {}).items())).values()
    )
