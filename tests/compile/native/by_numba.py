"""Short runs in which Numba compiles everything, as judge of symgen's own compiler; run apart.

python -m compile.native.by_numba straight pendulum lagrange rk4 four-bar ggl radau5
"""

import builtins
import functools
import sys
from typing import Any

import numba
from numba.core.types import Dispatcher
from numba.experimental.function_type import _get_jit_address

from symgen.compile.loopcode import entry, exact
from symgen.compile.native import types
from symgen.compile.native.pieces import Piece
from symgen.compile.store import emitted
from symgen.compile.store.jit import RuntimeFunction
from symgen.run.layout import kernel_addresses


def signature_of(signature: types.Signature) -> Any:
    """Return a signature in Numba's types."""
    return type_of(signature.result)(*map(type_of, signature.arguments))


def type_of(kind: types.Kind) -> Any:
    """Return a type as Numba's."""
    if isinstance(kind, types.NumberType):
        return getattr(numba.types, kind.name)
    if isinstance(kind, types.ArrayType):
        return numba.types.Array(type_of(kind.dtype), kind.ndim, "C")
    if isinstance(kind, types.FunctionType):
        return numba.types.FunctionType(signature_of(kind.signature))
    return numba.types.BaseTuple.from_types(tuple(map(type_of, kind)), kind.constructor if kind.fields else None)


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


def of_runtime(function: RuntimeFunction) -> Any:
    """Return Numba's form of a function of the runtime."""
    own = () if function.signature is None else (function.signature,)
    return dispatcher(function.py_func, function.inlined, function.contracted, *own)


def argument(value: Any) -> Any:
    """Return an argument as Numba's functions take it: functions, also those in records, as Numba's own."""
    if isinstance(value, tuple):
        parts = tuple(map(argument, value))
        return type(value)(*parts) if hasattr(value, "_fields") else parts
    return of_runtime(value) if isinstance(value, RuntimeFunction) else value


def install() -> None:
    """Put Numba into the place of the compiler, before modules are imported whose functions it compiles."""
    emitted.import_library = builtins.__import__
    emitted.plain = numba.njit(error_model="numpy", fastmath={"contract"})
    kernel_addresses.address = lambda function, _, signature=kernel_addresses.KERNEL: int(
        _get_jit_address(function, signature_of(signature))
    )
    entry.ArgumentBlock.of = classmethod(lambda *_: None)
    RuntimeFunction.__call__ = lambda self, *values: of_runtime(self)(*map(argument, values))
    RuntimeFunction._numba_type_ = property(lambda self: Dispatcher(of_runtime(self)))
    Piece._numba_type_ = property(lambda self: Dispatcher(dispatcher(self.plain, True)))
    exact.Exact._numba_type_ = property(lambda self: self.compiled._numba_type_)


if __name__ == "__main__":
    install()
    from .loops import main

    main(sys.argv[1:])
