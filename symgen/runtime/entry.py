"""A loop entered by the shortest way: its arguments taken apart once, and one call with their address."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numba import config, types
from numba.experimental.function_type import _get_jit_address, _get_wrapper_address

from symgen.errors import SimulationError
from symgen.native import internals
from symgen.native.trampoline import BYTES, COPY, FIRST, FUNCTION, RESULT, SOURCE, slots, trampoline

#: Places of two of a loop's arguments.
_SCHEME, _SPAN = 6, 8


class Entry:
    """A compiled loop with all that it is entered with, in one block of memory.

    Arrays are referred to by their addresses, so they have to stay where they are; they are kept alive.

    Parameters
    ----------
    result : result of a compilation
        The loop.
    arguments : tuple
        Functions of the model, scheme, sizes, span, state, outputs.
    call : callable
        The trampoline for the signature.
    """

    def __init__(self, result: Any, arguments: tuple[Any, ...], call: Any) -> None:
        self._result, self._arguments, self._call = result, list(arguments), call
        self._kinds = result.signature.args
        places = np.cumsum([FIRST, *(sum(1 for _ in slots(kind)) for kind in self._kinds)])
        self._places = [int(place) for place in places]
        block = np.zeros(self._places[-1], dtype=np.int64)
        self._block, self._address = block, block.ctypes.data
        self._ints, self._floats = memoryview(block), memoryview(block.view(np.float64))
        block[FUNCTION] = result.library.get_pointer_to_function(result.fndesc.llvm_func_name)
        for which in range(len(arguments)):
            self._fill(which)
        self._scheme, self._span = arguments[_SCHEME], arguments[_SPAN]
        fields = arguments[_SPAN]._fields
        self._until, self._pause = (self._places[_SPAN] + fields.index(name) for name in ("until", "pause"))

    @classmethod
    def of(cls, loop: Any, arguments: tuple[Any, ...]) -> Entry | None:
        """Return the entry of a loop, None where it has to be called as every compiled function.

        Parameters
        ----------
        loop : compiled function
            An instance of `symgen.runtime.frame.integrate`.
        arguments : tuple
            What it takes: functions of the model, scheme, sizes, span, state, outputs.
        """
        if config.DISABLE_JIT or not internals.usable():
            return None
        if hasattr(loop, "open"):
            loop.open()
        compiled = list(getattr(loop, "overloads", {}).values())
        if len(compiled) != 1 or len(compiled[0].signature.args) != len(arguments):
            return None
        call = trampoline(compiled[0].signature.return_type, compiled[0].signature.args)
        try:
            return None if call is None else cls(compiled[0], arguments, call)
        except (NotImplementedError, TypeError, ValueError):  # a function, or a record, of a kind of its own
            return None

    def has(self, scheme: Any, span: Any) -> bool:
        """Whether the block holds a scheme and a span."""
        return self._scheme is scheme and self._span is span

    def take(self, scheme: Any, span: Any) -> None:
        """Put another scheme, whose arrays may stand elsewhere, and another span into the block."""
        self._scheme, self._span = scheme, span
        for which, value in ((_SCHEME, scheme), (_SPAN, span)):
            self._arguments[which] = value
            self._fill(which)

    def copy_before(self, target: Any, source: Any) -> None:
        """Have one array copied into another of its size, at every entry."""
        self._block[[COPY, SOURCE, BYTES]] = target.ctypes.data, source.ctypes.data, source.nbytes

    def __call__(self, until: float, pause: float) -> int:
        """Enter the loop; return how it ended."""
        self._floats[self._until], self._floats[self._pause] = until, pause
        if self._call(self._address) != 0:
            raise SimulationError("a compiled loop has raised an exception")
        return self._ints[RESULT]

    def _fill(self, which: int) -> None:
        """Put an argument into its slots."""
        at = self._places[which]
        for value in _numbers(self._kinds[which], self._arguments[which]):
            if isinstance(value, float):
                self._floats[at] = value
            else:
                self._ints[at] = value
            at += 1


def _numbers(kind: Any, value: Any) -> Iterator[int | float]:
    """Yield what stands in the slots of an argument: integers, addresses among them, and floating-point numbers."""
    if isinstance(kind, types.BaseTuple):
        for part, item in zip(kind, value, strict=True):
            yield from _numbers(part, item)
    elif isinstance(kind, types.FunctionType):
        signature = kind.signature
        yield from (_get_wrapper_address(value, signature), id(value), _get_jit_address(value, signature))
    elif isinstance(kind, types.Array):
        if not (isinstance(value, np.ndarray) and value.flags.c_contiguous and value.ndim == kind.ndim):
            raise TypeError("an array of another kind")
        if value.dtype != np.dtype(str(kind.dtype)):
            raise TypeError("an array of other numbers")
        yield from (0, 0, value.size, value.itemsize, value.ctypes.data, *value.shape, *value.strides)
    else:
        yield float(value) if kind == types.float64 else int(value)
