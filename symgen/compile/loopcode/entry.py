"""Direct calls of compiled functions: arguments are unpacked once, and a call passes only their address."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from symgen.compile.native import types
from symgen.compile.native.annotations import Record
from symgen.compile.native.calls import (
    BYTES,
    COPY,
    FIRST,
    FUNCTION,
    RESULT,
    SOURCE,
    Filler,
    Slots,
    filler_of,
    slot_types,
    trampoline,
)
from symgen.compile.native.compiler import is_by_numba
from symgen.compile.store.jit import MachineFunction, object_file

Array = NDArray[np.float64]
#: Positions in a loop's arguments: model, scheme, span, state and outputs.
_SCHEME, _SPAN, _STATE = -4, -3, -2


class ArgumentBlock:
    """A compiled function with its arguments in one block of memory.

    The block holds the addresses of arrays: they must not move, and are kept alive.

    Parameters
    ----------
    function : MachineFunction
        The function.
    signature : Signature
        Its types.
    arguments : tuple
        Its arguments.
    """

    def __init__(self, function: MachineFunction, signature: types.Signature, arguments: tuple[Any, ...]) -> None:
        self._function, self._arguments = function, list(arguments)
        self._call, self._places, self._fillers = _trampoline_of(signature)
        block: Any = np.zeros(self._places[-1], dtype=np.int64)
        self._block, self._address = block, block.ctypes.data
        self._ints: Any = memoryview(block)  # read and written faster than arrays are
        self._floats: Any = memoryview(block.view(np.float64))
        block[FUNCTION] = function.address(signature)
        for which in range(len(arguments)):
            self._fill(which)

    @classmethod
    def of(cls, function: object, signature: types.Signature | None, arguments: tuple[Any, ...]) -> Self | None:
        """Return the block of a function, or None if it is not compiled here or takes other arguments."""
        if not isinstance(function, MachineFunction) or signature is None or is_by_numba():
            return None
        if len(signature.arguments) != len(arguments):
            return None
        try:
            return cls(function, signature, arguments)
        except (AttributeError, TypeError, ValueError):  # a function, or a record, of a kind of its own
            return None

    def enter(self) -> int:
        """Call the function; return its integer result."""
        self._call(self._address)
        return int(self._ints[RESULT])

    def _fill(self, which: int) -> None:
        """Put an argument into its slots."""
        at, slots = self._places[which], Slots()
        self._fillers[which](self._arguments[which], slots)
        for value in slots:
            if isinstance(value, float):
                self._floats[at] = value
            else:
                self._ints[at] = value
            at += 1


class LoopEntry(ArgumentBlock):
    """A compiled loop, an instance of `symgen.run.loops.frame.integrate`, with its arguments."""

    def __init__(self, function: MachineFunction, signature: types.Signature, arguments: tuple[Any, ...]) -> None:
        super().__init__(function, signature, arguments)
        self._scheme, self._span = arguments[_SCHEME], arguments[_SPAN]
        self._which_scheme, self._which_span = len(arguments) + _SCHEME, len(arguments) + _SPAN
        first, names = self._places[self._which_span], self._span._fields
        self._until, self._pause, self._most = (first + names.index(name) for name in ("until", "pause", "most"))

    def copy_before(self, target: Array, source: Array) -> None:
        """Copy one array into another of its size at every entry."""
        self._block[[COPY, SOURCE, BYTES]] = target.ctypes.data, source.ctypes.data, source.nbytes

    def has(self, scheme: Record, span: Record) -> bool:
        """Whether the block holds a scheme and a span."""
        return self._scheme is scheme and self._span is span

    def take(self, scheme: Record, span: Record) -> None:
        """Put another scheme, whose arrays may be at other addresses, and another span into the block."""
        if self._scheme is not scheme:
            self._scheme = self._arguments[self._which_scheme] = scheme
            self._fill(self._which_scheme)
        self._span = self._arguments[self._which_span] = span
        self._fill(self._which_span)

    def take_state(self, state: Record) -> None:
        """Put another state into the block."""
        which = len(self._arguments) + _STATE
        self._arguments[which] = state
        self._fill(which)

    def __call__(self, until: float, pause: float, most: float) -> int:
        """Enter the loop; return the code of its end."""
        floats = self._floats
        floats[self._until], floats[self._pause], floats[self._most] = until, pause, most
        self._call(self._address)
        return int(self._ints[RESULT])


def loop_entry(loop: object, arguments: tuple[Any, ...]) -> LoopEntry | None:
    """Return the entry of a loop, or None if only an ordinary call is possible.

    Parameters
    ----------
    loop : RuntimeFunction
        With a signature; anything else has no entry.
    arguments : tuple
        Model, scheme, span, state, outputs.
    """
    return LoopEntry.of(loop, getattr(loop, "signature", None), arguments)


def bind_arguments(function: Any, kind: types.FunctionType, *arguments: Any) -> Callable[..., Any]:
    """Return a function bound to arguments; the numbers it is called with replace the first ones.

    Parameters
    ----------
    function : EmittedFunction or function
        An emitted function; plain Python where nothing is compiled.
    kind : FunctionType
        Its type, of `symgen.run.layout.abi`.
    *arguments
        Arrays and numbers.
    """
    block = ArgumentBlock.of(function, kind.signature, arguments)
    if block is None:
        return lambda *first: function(*first, *arguments[len(first) :])

    def call(*first: float) -> int:
        for which, value in enumerate(first):
            block._floats[FIRST + which] = value
        return block.enter()

    return call


@functools.cache
def _trampoline_of(signature: types.Signature) -> tuple[Callable[[int], Any], list[int], list[Filler]]:
    """Return the trampoline of functions of a signature, and the first slots and the fillers of their arguments."""
    sizes = (sum(1 for _ in slot_types(kind)) for kind in signature.arguments)
    places = list(itertools.accumulate(sizes, initial=FIRST))
    return trampoline(signature, object_file), places, list(map(filler_of, signature.arguments))
