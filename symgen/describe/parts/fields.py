"""The types a file's keys may have, and the one function that reads a table into a Struct of such fields.

The description on each type is what an error message says was expected and what the JSON schema publishes.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from typing import Annotated, Any, Literal, TypeVar, cast, get_args, get_origin

import msgspec
from msgspec import Meta

from symgen.base.errors import InputError, quote
from symgen.base.units import si_hint
from symgen.describe.parts.meant_words import hint_on_key, hint_on_list

Text = Annotated[str, Meta(description="a text")]
Scalar = Annotated[float | str, Meta(description="a number or an expression of parameters")]
TimeFunction = Annotated[float | str, Meta(description="a number or an expression of t and parameters")]
CurveFunction = Annotated[float | str, Meta(description="a number or an expression of phi and smooth tables")]
TimeVector = Annotated[
    tuple[float | str, float | str, float | str],
    Meta(description="three numbers or expressions of t and parameters [x, y, z]"),
]
StateFunction = Annotated[
    float | str,
    Meta(description="a number or an expression of t, parameters and body coordinates such as crank.theta"),
]
OutputFunction = Annotated[
    float | str,
    Meta(description="a number or an expression of t, parameters and what is known of the motion, such as arm.tip.x"),
]
StateBound = Annotated[
    float | str | dict[str, float | str],
    Meta(
        description="a number or an expression of t, parameters, inputs and state, "
        "or a table of two, { forwards = ..., backwards = ... }"
    ),
]
Potential = Annotated[float | str, Meta(description="an expression of parameters and the element's own coordinate")]
Efficiency = Annotated[
    float | str | tuple[float | str, float | str],
    Meta(description="a number or a formula of parameters and the motion, or two of parameters, [forwards, backwards]"),
]
Pair = Annotated[tuple[float | str, float | str], Meta(description="two numbers or expressions of parameters")]
#: Two or three of them, as published in the schema; the `Scope` of a mechanism decides between the two.
_Components = Annotated[tuple[float | str, ...], Meta(extra_json_schema={"minItems": 2, "maxItems": 3})]
Vector = Annotated[
    _Components,
    Meta(description="two numbers or expressions of parameters [x, y], in space three [x, y, z]"),
]
Vertices = Annotated[tuple[Vector, ...], Meta(description="a list of points, two or more", min_length=2)]
OutlinePoints = Annotated[
    tuple[_Components | dict[str, Any], ...],
    Meta(description="a list of points [x, y] and tables such as { to = [x, y], radius = R }", min_length=2),
]
Sides = Annotated[
    tuple[float | str | _Components, ...],
    Meta(description="a direction [x, y, z] in the ground frame, or of a line one for each segment"),
]
Counts = Annotated[
    int | tuple[int, ...],
    Meta(description="a number of elements, or of a line a list of numbers, one for each segment"),
]
PotentialVector = Annotated[
    _Components, Meta(description="expressions [x, y] or [x, y, z], each of its own coordinate")
]
Axis = Annotated[_Components, Meta(description="a direction [x, y] or [x, y, z] in the body's frame")]
StateVector = Annotated[
    _Components,
    Meta(description="numbers or expressions [x, y] or [x, y, z] of t, parameters and state"),
]
StateTorque = Annotated[
    float | str | tuple[float | str, ...],
    Meta(description="a number or an expression of t, parameters and state; for a body in space three [x, y, z]"),
]
TextPair = Annotated[tuple[str, str], Meta(description="two names")]
_AnyPoint = str | _Components
Point = Annotated[
    _AnyPoint, Meta(description="a point of the body: its name, 'centre' or coordinates [x, y] or [x, y, z]")
]
BodyName = Annotated[str, Meta(description="the name of a body or 'ground'")]
BodyPair = Annotated[tuple[str, str], Meta(description="the names of two bodies, one of which may be 'ground'")]
PointPair = Annotated[
    tuple[_AnyPoint, _AnyPoint],
    Meta(description="two points, one of each body: a name, 'centre' or coordinates [x, y] or [x, y, z]"),
]
AxisPair = Annotated[
    tuple[float | str | _Components, ...],
    Meta(description="a direction [x, y], in space [x, y, z] or two such, one in the frame of each body"),
]
Across = Annotated[
    float | str | tuple[float | str, ...],
    Meta(description="a number or an expression of parameters, in space also a list, one for each axis of the section"),
]
DirectionPair = Annotated[
    tuple[_Components, _Components], Meta(description="two directions, one in the frame of each body")
]
Tensor = Annotated[
    tuple[float | str | tuple[float | str, ...], ...],
    Meta(
        description="[Ixx, Iyy, Izz] ([0, 0, 0] for no inertia), [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] or three rows of three",
        min_length=3,
        max_length=6,
    ),
]
SquareMatrix = Annotated[
    tuple[float | str | tuple[float | str, ...], ...],
    Meta(
        description="six numbers or expressions of parameters, or six rows of six; in the plane three",
        min_length=3,
        max_length=6,
    ),
]
Points = Annotated[
    dict[str, Vector], Meta(description="a table of points, name = [x, y] or [x, y, z] in the body's frame")
]
Flag = Annotated[bool, Meta(description="true or false")]
Numbers = Annotated[tuple[float, ...], Meta(description="a list of numbers")]
#: The words are checked where they are resolved, with a message that names the nearest one.
Held = Annotated[
    bool | str | tuple[str, ...], Meta(description="true, or which of 'position', 'angle' and 'velocity' are kept")
]
JointStart = Annotated[
    dict[str, float | str], Meta(description="a table of the joint's coordinates at the start, such as { angle = 0.5 }")
]
ModeStart = Annotated[
    dict[str, float | str], Meta(description="a table of modes at the start, such as { m1 = 0.002, vm1 = 0.1 }")
]
Condition = Annotated[
    str, Meta(description="a condition such as 'ball.y < 0.1', or an expression that passes through zero")
]
NewValues = Annotated[
    dict[str, StateFunction],
    Meta(description='a table of new velocities or states, such as "ball.vy" = "-0.7*ball.vy"'),
]
Rows = Annotated[
    tuple[dict[str, float | str], ...],
    Meta(description="a list of rows, { position = EXPRESSION } or { velocity = EXPRESSION }", min_length=1),
]
Weights = Annotated[
    dict[str, float | str],
    Meta(description="a table of factors of joint coordinates, such as { left = 1.0, right = -1.0 }", min_length=1),
]
Scalars = Annotated[
    tuple[float | str, ...], Meta(description="a list of numbers or expressions of parameters", min_length=2)
]
BodyNames = Annotated[tuple[str, ...], Meta(description="names of bodies", min_length=1)]
#: A condition, or a table of conditions (`symgen.describe.parts.holding_keys.HoldsSection`).
Holds = Annotated[
    str | dict[str, str | bool],
    Meta(description="a condition such as 't < 0.3', or a table such as { releases = 'hook.F > 500' }"),
]
HoldsAt = Annotated[
    Literal["described", "present"], Meta(description="'described' or 'present', the positions that a catch keeps")
]
Duration = Annotated[float | str, Meta(description="a number of seconds above 0, or one with its unit")]

#: Keys, with their types, that joints of any kind may have besides their own and those of rows with bounds.
OF_ANY_JOINT: Mapping[str, Any] = {
    **{"start": JointStart, "cut": Flag, "rotor_inertia": Scalar, "gear_ratio": Scalar},
    **{"holds": Holds, "holds_at": HoldsAt},
}

T = TypeVar("T")

_AT = re.compile(r" - at `\$(.*)`$")


def value_in_words(value: object) -> str:
    """Return a short text of a file's value for a message."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "a table" if value else "an empty table"
    if isinstance(value, list | tuple):
        text = "[" + ", ".join(value_in_words(item) for item in value[:30]) + "]"
        return text if len(text) <= 60 else f"a list of {len(value)}"
    if isinstance(value, str):
        return quote(value)
    if isinstance(value, int) and abs(value) > 1e18:
        return "an integer beyond 1e18"
    if isinstance(value, int | float):
        return repr(value)
    return "nothing" if value is None else f"a {type(value).__name__}"


def read_table(kind: type[T], raw: object, where: str, further: tuple[str, ...] = ()) -> T:
    """Return the table `raw` as a `kind`, or raise `InputError` about the first key that is wrong; it has the others.

    Parameters
    ----------
    kind : type
        A Struct whose fields are the table's keys.
    raw : object
        The value in the file.
    where : str
        File and table, for the message.
    further : tuple of str, optional
        Further keys, read elsewhere, that the message should list.
    """
    if not isinstance(raw, Mapping):
        raise InputError(where, "a table", value_in_words(raw))
    fields = _fields_by_name(cast(type[msgspec.Struct], kind))
    wrong, names, values = list[InputError](), [*further, *fields], dict[str, Any]()
    meant = ""
    for key in raw:
        if key not in fields:
            hint = hint_on_key(str(key), names)
            meant += hint
            wrong.append(
                InputError(where, f"the keys {', '.join(names)}", f"the unknown key {quote(key)}", hint, str(key))
            )
    for key, field in fields.items():
        if field.required and key not in raw and f"'{key}'" not in meant:  # a slip of the pen is wrong once
            wrong.append(InputError(f"{where}.{key}", describe_type(field.type), "no such key"))
    for key, value in raw.items():
        if key in fields:
            try:
                values[key] = read_value(fields[key].type, value, f"{where}.{key}")
            except InputError as error:
                wrong += [error, *error.further]
    if wrong:
        wrong[0].further = tuple(wrong[1:])
        raise wrong[0]
    return kind(**values)


@cache  # one entry for each section and kind; msgspec evaluates every annotation
def _fields_by_name(kind: type[msgspec.Struct]) -> dict[str, msgspec.structs.FieldInfo]:
    return {field.name: field for field in msgspec.structs.fields(kind)}


@cache
def takes_one_point(kind: type[msgspec.Struct]) -> bool:
    """Whether a kind of joint or force has one point under `at` beside two bodies, each of which has a point there."""
    at = _fields_by_name(kind).get("at")
    if at is None or "between" not in _fields_by_name(kind):
        return False
    for one in ("name", [0.0, 0.0]):
        with suppress(msgspec.ValidationError):
            msgspec.convert(one, at.type)
            return True
    return False


def read_value(type_: object, value: object, where: str) -> Any:
    """Return `value` converted to the type, or raise `InputError` naming the part that is wrong."""
    try:
        return msgspec.convert(value, type_)
    except (msgspec.ValidationError, OverflowError) as error:
        items = _type_of_entries(type_)
        if items is not None and isinstance(value, Mapping):
            for key, item in value.items():
                read_value(items, item, f"{where}.{key}")
        if isinstance(value, Mapping) and (table := _table_in(type_)) is not None:
            read_table(table, value, where)  # whose sentence names the key
        path = _AT.search(str(error))
        part = _value_at_path(value, path.group(1) if path else "")
        raise InputError(
            where, describe_type(type_), value_in_words(part), si_hint(part) or hint_on_list(part)
        ) from None


def _type_of_entries(type_: object) -> Any:
    """Return the type of the entries where the type is a table of freely named entries, else None."""
    for part in (type_, *get_args(type_)):
        inner = getattr(part, "__origin__", part) if hasattr(part, "__metadata__") else part
        if get_origin(inner) is dict:
            return get_args(inner)[1]
    return None


def _table_in(type_: object) -> type[msgspec.Struct] | None:
    """Return the table among the types of a value that may be one, else None."""
    parts = (part for part in get_args(type_) if isinstance(part, type) and issubclass(part, msgspec.Struct))
    return next(parts, None)


def _value_at_path(value: object, path: str) -> object:
    """Return the part of `value` that a path such as ``[0][1]`` leads to, or `value` where it leads nowhere."""
    part: Any = value
    for index in re.findall(r"\[(\d+)\]", path):
        if not isinstance(part, list | tuple) or int(index) >= len(part):
            return value
        part = part[int(index)]
    return part


def describe_type(type_: object) -> str:
    """Return a description in words of a value of this type."""
    for note in getattr(type_, "__metadata__", ()):
        if isinstance(note, Meta) and note.description:
            return note.description
    if get_origin(type_) is Literal:
        return " or ".join(f"'{argument}'" for argument in get_args(type_))
    return next((describe_type(part) for part in get_args(type_) if part is not type(None)), "a valid value")
