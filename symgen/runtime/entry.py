"""Compiled functions called by the shortest way: arguments taken apart once, and one call with their address."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Self

import numpy as np
from numba import types
from numpy.typing import NDArray

from symgen.errors import SimulationError
from symgen.native import trampoline as ways
from symgen.native.trampoline import BYTES, COPY, FIRST, FUNCTION, RESULT, SOURCE, numbers, slots
from symgen.store.objects import made

Array = NDArray[np.float64]
#: A trampoline.
Call = Callable[[int], int]
#: Two of a loop's arguments, of the model, scheme, span, state and outputs.
_SCHEME, _SPAN = -4, -3


class Block:
    """A compiled function with its arguments in one block of memory.

    Arrays are referred to by their addresses, so they have to stay where they are; they are kept alive.

    Parameters
    ----------
    result : result of a compilation
        The function.
    arguments : tuple
        What it takes.
    call : callable
        The trampoline for its signature.
    """

    def __init__(self, result: Any, arguments: tuple[Any, ...], call: Call) -> None:
        self._result, self._arguments, self._call = result, list(arguments), call
        self._kinds, self._places = _layout(result)[1:]
        block: Any = np.zeros(self._places[-1], dtype=np.int64)
        self._block, self._address = block, block.ctypes.data
        self._ints: Any = memoryview(block)  # read and written faster than arrays are
        self._floats: Any = memoryview(block.view(np.float64))
        block[FUNCTION] = result.library.get_pointer_to_function(result.fndesc.llvm_func_name)
        for which in range(len(arguments)):
            self._fill(which)

    @classmethod
    def of(cls, compiled: Any, arguments: tuple[Any, ...]) -> Self | None:
        """Return the block of a function, None where it has to be called as every compiled function.

        Parameters
        ----------
        compiled : result of a compilation
            The function.
        arguments : tuple
            What it takes.
        """
        signature = compiled.signature
        if len(signature.args) != len(arguments):
            return None
        call = _layout(compiled)[0] if ways.usable() else None
        try:
            return None if call is None else cls(compiled, arguments, call)
        except (NotImplementedError, TypeError, ValueError):  # a function, or a record, of a kind of its own
            return None

    def enter(self) -> int:
        """Call the function; return its result, a whole number."""
        if self._call(self._address) != 0:
            raise SimulationError("compiled code has raised an exception")
        return int(self._ints[RESULT])

    def _fill(self, which: int) -> None:
        """Put an argument into its slots."""
        at = self._places[which]
        for value in numbers(self._kinds[which], self._arguments[which]):
            if isinstance(value, float):
                self._floats[at] = value
            else:
                self._ints[at] = value
            at += 1


class Entry(Block):
    """A compiled loop, an instance of `symgen.runtime.frame.integrate`, with all that it is entered with."""

    def __init__(self, result: Any, arguments: tuple[Any, ...], call: Call) -> None:
        super().__init__(result, arguments, call)
        self._scheme, self._span = arguments[_SCHEME], arguments[_SPAN]
        self._which_scheme, self._which_span = len(arguments) + _SCHEME, len(arguments) + _SPAN
        first, names = self._places[self._which_span], self._span._fields
        self._until, self._pause, self._most = (first + names.index(name) for name in ("until", "pause", "most"))

    def copy_before(self, target: Array, source: Array) -> None:
        """Have one array copied into another of its size, at every entry."""
        self._block[[COPY, SOURCE, BYTES]] = target.ctypes.data, source.ctypes.data, source.nbytes

    def has(self, scheme: Any, span: Any) -> bool:
        """Whether the block holds a scheme and a span."""
        return self._scheme is scheme and self._span is span

    def take(self, scheme: Any, span: Any) -> None:
        """Put another scheme, whose arrays may stand elsewhere, and another span into the block."""
        if self._scheme is not scheme:
            self._scheme = self._arguments[self._which_scheme] = scheme
            self._fill(self._which_scheme)
        self._span = self._arguments[self._which_span] = span
        self._fill(self._which_span)

    def __call__(self, until: float, pause: float, most: float) -> int:
        """Enter the loop; return how it ended."""
        floats = self._floats
        floats[self._until], floats[self._pause], floats[self._most] = until, pause, most
        if self._call(self._address) != 0:
            raise SimulationError("a compiled loop has raised an exception")
        return int(self._ints[RESULT])


def entry_of(loop: Any, arguments: tuple[Any, ...]) -> Entry | None:
    """Return the entry of a loop, None where it has to be called as every compiled function.

    Parameters
    ----------
    loop : compiled function
        With a single signature.
    arguments : tuple
        Model, scheme, span, state, outputs.
    """
    if hasattr(loop, "open"):
        loop.open()
    compiled = list(getattr(loop, "overloads", {}).values())  # none where nothing is compiled
    return Entry.of(compiled[0], arguments) if len(compiled) == 1 else None


def direct(function: Any, kind: types.FunctionType, *arguments: Any) -> Callable[..., Any]:
    """Return a function on given arguments; what it is called with takes the place of the first ones, if numbers.

    Parameters
    ----------
    function : Dispatcher or function
        An emitted function; plain Python where nothing is compiled.
    kind : FunctionType
        Its type, of `symgen.runtime.abi`.
    *arguments
        Arrays and numbers.
    """
    compiled = function.get_compile_result(kind.signature) if hasattr(function, "get_compile_result") else None
    block = None if compiled is None else Block.of(compiled, arguments)
    if block is None:
        return lambda *first: function(*first, *arguments[len(first) :])

    def call(*first: float) -> int:
        for which, value in enumerate(first):
            block._floats[FIRST + which] = value
        return block.enter()

    return call


#: Of functions that were entered: themselves, so that they stay where they are, and what `_layout` returns.
_KNOWN: dict[int, tuple[Any, tuple[Call | None, tuple[Any, ...], list[int]]]] = {}


def _layout(result: Any) -> tuple[Call | None, tuple[Any, ...], list[int]]:
    """Return the trampoline of a compiled function, the kinds of its arguments, and where their slots begin."""
    if id(result) not in _KNOWN:
        returned, kinds = result.signature.return_type, result.signature.args
        call = ways.trampoline(returned, kinds, made)
        sizes = () if call is None else tuple(sum(1 for _ in slots(kind)) for kind in kinds)
        _KNOWN[id(result)] = result, (call, kinds, np.cumsum([FIRST, *sizes]).tolist())
    return _KNOWN[id(result)][1]
