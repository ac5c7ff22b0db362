"""Values in the source of loops other than numbers: arrays, functions by their address, and records.

Records exist only while the source is read and leave names of arrays, numbers and addresses.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from symgen.compile.native import language as lang
from symgen.compile.native import types
from symgen.compile.native.read_values import Foreign, as_type

SCALARS: dict[Any, lang.Scalar] = {types.float64: "float", types.int64: "int", types.boolean: "bool"}
NUMBERS: dict[Any, Any] = {kind: number_type for number_type, kind in SCALARS.items()}
EXPRESSIONS = (
    lang.Constant,
    lang.Variable,
    lang.ArrayElement,
    lang.ScalarOperation,
    lang.Logic,
    lang.Choice,
    lang.FunctionCall,
    lang.ArrayLength,
    lang.Invoke,
    lang.Insert,
)


class Array(NamedTuple):
    """An array, by its name in the function."""

    name: str
    type: lang.Scalar
    rank: int = 1


class Address(NamedTuple):
    """A function by its address: its name in the calling function, and its signature."""

    name: str
    signature: Any


class RecordValue(NamedTuple):
    """A tuple, with the names of its fields if any."""

    values: tuple[Any, ...]
    fields: tuple[str, ...] = ()


#: Value of a name: a number, an array, a function, or a record of such.
Value = Any
#: Result of a copied function without a result.
NOTHING = RecordValue(())


def argument_value(name: str, kind: object) -> tuple[Value, list[lang.FunctionParameter]]:
    """Return the value of an argument, and its parameters.

    Parameters
    ----------
    name : str
        Of the argument.
    kind : Number, Array, FunctionType or Record
        Its type.

    Raises
    ------
    Foreign
        If it is not one of the types of loops.
    """
    if kind in SCALARS:
        return lang.Variable(SCALARS[kind], name), [lang.FunctionParameter(name, SCALARS[kind])]
    if isinstance(kind, types.FunctionType):
        return Address(name, kind.signature), [lang.FunctionParameter(name, "int", address=True)]
    if isinstance(kind, types.ArrayType) and kind.ndim <= 3 and kind.dtype in SCALARS:
        array = Array(name, SCALARS[kind.dtype], kind.ndim)
        return array, [lang.FunctionParameter(name, array.type, True, kind.ndim)]
    if isinstance(kind, types.RecordType):
        names = kind.fields or tuple(str(i) for i in range(len(kind)))
        parts = [argument_value(f"{name}.{field}", part) for field, part in zip(names, kind, strict=True)]
        return RecordValue(tuple(v for v, _ in parts), kind.fields), [p for _, ps in parts for p in ps]
    raise Foreign(f"an argument of type {kind}")


def leaves_of_value(value: Value) -> Iterator[Value]:
    """Yield numbers, arrays and functions of a value in their order."""
    if isinstance(value, RecordValue):
        for part in value.values:
            yield from leaves_of_value(part)
    else:
        yield value


def pass_values(kinds: Sequence[Any], values: Sequence[Value]) -> tuple[lang.Expression | str, ...]:
    """Return the passed form of values of some types."""
    if len(kinds) != len(values):
        raise Foreign("a function with other arguments")
    return tuple(x for kind, value in zip(kinds, values, strict=True) for x in pass_value(kind, value))


def pass_value(kind: object, value: Value) -> Iterator[lang.Expression | str]:
    """Yield the passed form of a value of a type: numbers, and names of arrays and functions.

    Raises
    ------
    Foreign
        If it is not of the type.
    """
    if isinstance(value, RecordValue) and isinstance(kind, types.RecordType) and len(kind) == len(value.values):
        for part, item in zip(kind, value.values, strict=True):
            yield from pass_value(part, item)
    elif isinstance(value, Array) and isinstance(kind, types.ArrayType):
        if SCALARS.get(kind.dtype) != value.type or kind.ndim != value.rank:
            raise Foreign("an array of another kind")
        yield value.name
    elif isinstance(value, Address) and isinstance(kind, types.FunctionType) and kind.signature == value.signature:
        yield value.name
    elif kind in SCALARS and is_number(value):
        yield as_type(SCALARS[kind], value)
    else:
        raise Foreign(f"an argument that is no {kind}")


def value_in_callee(name: str, value: Value) -> tuple[Value, list[lang.FunctionParameter]]:
    """Return a value in the callee that takes it, and its parameters."""
    if isinstance(value, RecordValue):
        parts = [value_in_callee(f"{name}.{i}", part) for i, part in enumerate(value.values)]
        return RecordValue(tuple(v for v, _ in parts), value.fields), [p for _, ps in parts for p in ps]
    if isinstance(value, Array):
        return Array(name, value.type, value.rank), [lang.FunctionParameter(name, value.type, True, value.rank)]
    if isinstance(value, Address):
        return Address(name, value.signature), [lang.FunctionParameter(name, "int", address=True)]
    return lang.Variable(value.type, name), [lang.FunctionParameter(name, value.type)]


def is_number(value: Value) -> bool:
    """Whether a value is a number."""
    return isinstance(value, EXPRESSIONS) and not (isinstance(value, lang.Insert) and value.nothing)
