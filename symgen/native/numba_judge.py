"""Functions of the runtime compiled by Numba, where ``SYMGEN_COMPILER=numba`` asks for it."""

from __future__ import annotations

import functools
from typing import Any

import numba
from numba.experimental.function_type import _get_jit_address

from symgen.native import types

_NUMBERS = {
    types.float64: numba.float64,
    types.int64: numba.int64,
    types.uint32: numba.uint32,
    types.boolean: numba.boolean,
    types.void: numba.void,
}


def signature_of(signature: types.Signature) -> Any:
    """Return a signature in Numba's types."""
    return _NUMBERS[signature.result](*map(type_of, signature.arguments))


def type_of(kind: types.Kind) -> Any:
    """Return a type as Numba's."""
    if isinstance(kind, types.NumberType):
        return _NUMBERS[kind]
    if isinstance(kind, types.ArrayType):
        return numba.types.Array(_NUMBERS[kind.dtype], kind.ndim, "C")
    if isinstance(kind, types.FunctionType):
        return numba.types.FunctionType(signature_of(kind.signature))
    parts = tuple(map(type_of, kind))
    return numba.types.BaseTuple.from_types(parts, kind.made if kind.fields else None)


@functools.cache
def dispatcher(function: Any, inlined: bool, contracted: bool = True, *signatures: types.Signature) -> Any:
    """Return Numba's form of a plain function."""
    return numba.njit(
        *([signature_of(s) for s in signatures],) * bool(signatures),
        nogil=True,
        error_model="numpy",
        fastmath={"contract"} if contracted else False,
        forceinline=inlined,
    )(function)


def given(value: Any) -> Any:
    """Return an argument as Numba's functions take it: functions, also those in records, as Numba's own."""
    if isinstance(value, tuple):
        parts = tuple(map(given, value))
        return type(value)(*parts) if hasattr(value, "_fields") else parts
    return getattr(value, "by_numba", value)


def address(function: Any, signature: types.Signature) -> int:
    """Return the address of an emitted function that Numba has compiled."""
    return int(_get_jit_address(function, signature_of(signature)))
