"""Pieces of Numba's compiler that loops call, such as arithmetic in vectors, as functions in LLVM's language.

What such a piece puts into a function is written with llvmlite; here it is put into a function of its own that LLVM
copies into its caller, so that it is the same for both compilers. Numba's own context takes a third of a second to be
made ready, and of it such pieces need next to nothing: an address of an array's elements.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, NamedTuple

from llvmlite import ir
from numba.core import types

_KINDS: dict[Any, tuple[str, Any]] = {
    types.float64: ("f", ir.DoubleType()),
    types.int64: ("i", ir.IntType(64)),
    types.boolean: ("b", ir.IntType(1)),
}


class Inserted(NamedTuple):
    """A function in LLVM's language: its name, its text, and its signature in Numba's types."""

    symbol: str
    text: str
    signature: Any


class _Array(NamedTuple):
    """What there is of an array."""

    data: Any


class _Context:
    """What pieces of a compiler may ask for."""

    def make_array(self, kind: Any) -> Callable[..., _Array]:
        """Return what takes an array apart."""
        return lambda context, builder, value: value

    def get_dummy_value(self) -> None:
        """Return the value of what gives nothing."""


@functools.cache
def inserted(intrinsic: Any, kinds: tuple[Any, ...]) -> Inserted | None:
    """Return the function that does what a piece of the compiler does; None where it needs more than there is here.

    Parameters
    ----------
    intrinsic : Intrinsic
        From ``numba.extending.intrinsic``.
    kinds : tuple of Numba types
        Of its arguments: numbers, and arrays of one dimension, which the function takes as addresses.
    """
    try:
        signature, generate = intrinsic._defn(None, *kinds)
        symbol = f"symgen.{intrinsic._name}." + "".join(_letter(kind) for kind in signature.args)
        module = ir.Module(symbol)
        nothing = signature.return_type is types.void
        returned = ir.VoidType() if nothing else _KINDS[signature.return_type][1]
        parameters = [_parameter(kind) for kind in signature.args]
        function = ir.Function(module, ir.FunctionType(returned, parameters), symbol)
        function.linkage = "internal"
        function.attributes.add("alwaysinline")
        builder = ir.IRBuilder(function.append_basic_block())
        given = zip(signature.args, function.args, strict=True)
        arguments = [_Array(value) if isinstance(kind, types.Array) else value for kind, value in given]
        value = generate(_Context(), builder, signature, arguments)
    except (AttributeError, KeyError, TypeError):
        return None
    if nothing:
        builder.ret_void()
    else:
        builder.ret(value)
    lines = str(module).splitlines()
    return Inserted(symbol, "\n".join(line for line in lines if not line.startswith((";", "target "))), signature)


def _letter(kind: Any) -> str:
    return f"a{_letter(kind.dtype)}" if isinstance(kind, types.Array) else _KINDS[kind][0]


def _parameter(kind: Any) -> Any:
    """Return LLVM's type of what a number or an array is handed on as."""
    return _KINDS[kind.dtype][1].as_pointer() if isinstance(kind, types.Array) else _KINDS[kind][1]
