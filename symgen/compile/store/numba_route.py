"""Numba in the place of symgen's own compiler: ``SYMGEN_COMPILER=numba``.

Emitted functions, loops and their parts stay the objects that they are; what Numba makes of them stands behind their
calls. Numba compiles in every process anew, as its cache does not know functions without a file.
"""

from __future__ import annotations

import functools
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numba
from numba.core.types import Dispatcher
from numba.experimental.function_type import _get_jit_address

from symgen.compile.native import types
from symgen.compile.store.stats import CompilationClock

if TYPE_CHECKING:
    from symgen.compile.store.jit import MachineFunction


def type_of(kind: types.Kind) -> Any:
    """Return a type as Numba's."""
    if isinstance(kind, types.NumberType):
        return getattr(numba.types, kind.name)
    if isinstance(kind, types.ArrayType):
        return numba.types.Array(type_of(kind.dtype), kind.ndim, "C")
    if isinstance(kind, types.FunctionType):
        return numba.types.FunctionType(signature_of(kind.signature))
    return numba.types.BaseTuple.from_types(tuple(map(type_of, kind)), kind.constructor if kind.fields else None)


def signature_of(signature: types.Signature) -> Any:
    """Return a signature in Numba's types."""
    return type_of(signature.result)(*map(type_of, signature.arguments))


@functools.cache
def dispatcher(function: Any, inlined: bool, contracted: bool = True, *signatures: types.Signature) -> Any:
    """Return Numba's form of a plain function; with a signature it is compiled at once."""
    with CompilationClock():
        return numba.njit(
            *([signature_of(s) for s in signatures],) * bool(signatures),
            nogil=True,
            error_model="numpy",
            fastmath={"contract"} if contracted else False,
            forceinline=inlined,
        )(function)


def form_of(function: MachineFunction) -> Any:
    """Return Numba's form of a function of the runtime or of an emitted module.

    A loop has the types of its signature, so that all models share its machine code, unless a record with names holds a
    function: Numba takes such a one by its own type only, and compiles the loop for each.
    """
    own = getattr(function, "signature", None)
    types_ = [] if own is None or any(map(_names_a_function, own.arguments)) else [own]
    return dispatcher(function.py_func, function.inlined, function.contracted, *types_)


def _names_a_function(kind: types.Kind) -> bool:
    parts = list(kind) if isinstance(kind, types.RecordType) and kind.fields else []
    return any(isinstance(part, types.FunctionType) or _names_a_function(part) for part in parts)


def argument(value: Any) -> Any:
    """Return an argument as Numba's functions take it: functions, also those in records, as Numba's own."""
    from symgen.compile.store.jit import MachineFunction

    if isinstance(value, tuple):
        parts = tuple(map(argument, value))
        return type(value)(*parts) if hasattr(value, "_fields") else parts
    # an argument is compiled for the type of its parameter, which one with a signature of its own does not allow
    passed = isinstance(value, MachineFunction)
    return dispatcher(value.py_func, value.inlined, value.contracted) if passed else value


def called(function: MachineFunction, *arguments: object) -> Any:
    """Call Numba's form of a function."""
    return form_of(function)(*map(argument, arguments))


def address(function: MachineFunction, signature: types.Signature) -> int:
    """Return the address of Numba's machine code, for calls from other code of Numba."""
    return int(_get_jit_address(form_of(function), signature_of(signature)))


def type_in_callers(function: MachineFunction) -> Any:
    """Return the type of a function where compiled code names it."""
    return Dispatcher(form_of(function))


def type_of_plain(function: Any) -> Any:
    """Return the type of a plain function where compiled code names it, copied into its callers."""
    return Dispatcher(dispatcher(function, True))


def library(module: Any, names: tuple[str, ...], decorator: Any) -> Any:
    """Return what an emitted module imports from Numba, with symgen's decorator in the place of ``njit``."""
    return SimpleNamespace(**{name: decorator if name == "njit" else getattr(module, name) for name in names})
