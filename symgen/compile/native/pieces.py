"""Functions of the runtime in LLVM's language, such as arithmetic in vectors.

A loop calls a `Piece` like any function. In machine code LLVM copies a function into its caller, written with
llvmlite when a loop is compiled; plain Python and CUDA have the plain form.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Callable
from typing import Any, TypeVar, cast

from symgen.compile.native import types

_Function = TypeVar("_Function", bound=Callable[..., Any])


class Piece:
    """A function in two forms.

    Parameters
    ----------
    name : str
        Name of the function.
    plain : function
        The plain form.
    result : NumberType
        Type of the result.
    writers : str
        Module with a function of the same name that takes a builder and the arguments, arrays as addresses, and
        writes the instructions; empty where readers of loops handle the piece themselves.
    """

    def __init__(
        self, name: str, plain: Callable[..., Any], result: types.NumberType = types.void, writers: str = ""
    ) -> None:
        self.name, self.plain, self.result, self.writers = name, plain, result, writers

    def __call__(self, *arguments: object) -> Any:
        """Call the plain form."""
        return self.plain(*arguments)

    @property
    def _numba_type_(self) -> Any:
        """Type of the plain form where code compiled by Numba names it."""
        return importlib.import_module("symgen.compile.store.numba_route").type_of_plain(self.plain)


def piece_of(name: str, plain: _Function, result: types.NumberType = types.void, writers: str = "") -> _Function:
    """Return a `Piece` as a function with the types of its plain form; parameters as there."""
    made: Any = Piece(name, plain, result, writers)
    return cast("_Function", made)


@functools.cache
def piece_text(piece: Piece, kinds: tuple[types.NumberType | types.ArrayType, ...]) -> tuple[str, str]:
    """Return name and text in LLVM's language of a piece on numbers and arrays of some types, these as addresses."""
    from llvmlite import ir

    numbers = {types.float64: ir.DoubleType(), types.int64: ir.IntType(64), types.boolean: ir.IntType(1)}
    parameters = [numbers[k.dtype].as_pointer() if isinstance(k, types.ArrayType) else numbers[k] for k in kinds]
    symbol = f"symgen.{piece.name}." + "".join("a" * isinstance(k, types.ArrayType) + repr(k)[0] for k in kinds)
    module = ir.Module(symbol)
    nothing = piece.result is types.void
    returned = ir.VoidType() if nothing else numbers[piece.result]
    function = ir.Function(module, ir.FunctionType(returned, parameters), symbol)
    function.linkage = "internal"
    function.attributes.add("alwaysinline")
    builder = ir.IRBuilder(function.append_basic_block())
    value = getattr(importlib.import_module(piece.writers), piece.name)(builder, *function.args)
    if nothing:
        builder.ret_void()
    else:
        builder.ret(value)
    lines = str(module).splitlines()
    return symbol, "\n".join(line for line in lines if not line.startswith((";", "target ")))
