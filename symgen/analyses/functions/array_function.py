"""A compiled function of the state as people call it: arrays in, an array out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.result.stepping.named import Named
from symgen.run.loops import projection

if TYPE_CHECKING:
    from symgen.compile.native.array_entry import EntrySlots
    from symgen.run.compiling.functions import StateFunction

Array = NDArray[np.float64]
#: Names of arguments in messages.
_NAMES = {"q": "q", "v": "v", "a": "a", "e": "effort", "p": "p"}
#: What was expected and what was found, by what a function returns.
_FAULTS = {
    projection.LIGHT: ("a position where every velocity has inertia", "one where bodies are too light: M is singular"),
    projection.SINGULAR: (
        "a position where the rows have the rank that they have at the start",
        "a singular one, where it is smaller, or bodies that are too light beside others",
    ),
    projection.MISSING: ("accelerations that the actuators can make", "others"),
    projection.UNDEFINED: ("numbers for which every formula is finite", "others"),
}


class ArrayFunction:
    """A function of arrays: of coordinates `q`, and of `v`, `a` or `effort` where it takes them, then of `p`.

    A call takes one state, or many with one a row; `p` may be left out, be an array, or a mapping of changed numbers. A
    last array takes the result.
    """

    __slots__ = ("__call__", "arguments", "lengths", "name", "shape")

    def __init__(self, function: StateFunction, default: Array, values: Callable[..., Array]) -> None:
        self.name, self.shape, self.lengths = function.name, function.shape, function.lengths
        #: Names of the arguments; the last one may be left out.
        self.arguments = tuple(_NAMES[x] for x in function.arguments)
        slow = _Converted(function, default, values)
        slow.block = function.block(default, slow, Named)
        entry = slow if slow.block is None else function.entry(slow.block)
        object.__setattr__(self, "__call__", entry)  # a slot: a call costs no method of Python

    if TYPE_CHECKING:

        def __call__(self, *arrays: object, p: object = None, out: Array | None = None) -> Any:
            """Evaluate."""

    def __repr__(self) -> str:
        sizes = ", ".join(f"{name}[{n}]" for name, n in zip(self.arguments, self.lengths, strict=True))
        return f"<{self.name}({sizes}) -> {self.shape or 'number'}>"


class _Converted:
    """The same for arguments of other kinds: it converts them, evaluates many states, and says what is wrong."""

    def __init__(self, function: StateFunction, default: Array, values: Callable[..., Array]) -> None:
        self.function, self.default, self.values = function, default, values
        self.block: EntrySlots | None = None

    def __call__(self, *given: object, **named: object) -> Any:
        function = self.function
        names = [_NAMES[x] for x in function.arguments]
        numbers, out = self._bind_arguments(names, given, named)
        arrays = [self._as_array(name, x, n) for name, x, n in zip(names, numbers, function.lengths, strict=True)]
        counts = {len(a) for a in arrays if a.ndim == 2}
        if len(counts) > 1:
            raise InputError(function.name, "as many states in each argument", " and ".join(map(str, sorted(counts))))
        many = bool(counts)
        results = np.empty((counts.pop() if many else 1, *function.shape))
        wrong, code = function.rows(self.block, arrays, results)
        if wrong >= 0:
            raise self._error_of_state(arrays, wrong, code, many)
        result = results if many else results[0]
        if out is not None:
            return self._put_result(out, result)
        return result if many or function.shape else float(result)

    def _bind_arguments(self, names: list[str], given: tuple[Any, ...], named: dict[str, Any]) -> tuple[list[Any], Any]:
        """Return the arguments in their order and the array for the result."""
        rest = dict(zip((*names, "out"), given, strict=False)) | named
        unknown = [name for name in rest if name not in (*names, "out")]
        missing = [name for name in names[:-1] if name not in rest]
        if len(given) > len(names) + 1 or unknown or missing or len(rest) < len(given) + len(named):
            got = f"{len(given)} of them" + "".join(f" and '{name}'" for name in named)
            raise InputError(self.function.name, f"arguments {', '.join(names)} and out, the last two optional", got)
        numbers = rest.get("p")
        if numbers is None:
            numbers = self.default
        elif isinstance(numbers, Mapping):
            numbers = self.values(numbers)
        return [*(rest[name] for name in names[:-1]), numbers], rest.get("out")

    def _as_array(self, name: str, value: Any, length: int) -> Array:
        """Return an argument as numbers side by side."""
        where = f"{self.function.name}: {name}"
        expected = f"an array of shape ({length},) or (k, {length})"
        try:
            array = np.ascontiguousarray(value, dtype=np.float64)
        except (TypeError, ValueError):
            raise InputError(where, expected, arguments.kind_of_value(value)) from None
        if np.ndim(value) not in (1, 2) or array.shape[-1] != length:
            got = f"one of shape {np.shape(value)}" if np.ndim(value) else arguments.kind_of_value(value)
            raise InputError(where, expected, got)
        return array

    def _put_result(self, out: Any, result: Any) -> Any:
        """Put a result into the caller's array."""
        shape = np.shape(result)
        if not isinstance(out, np.ndarray) or out.shape != shape or out.dtype != np.float64 or not out.flags.writeable:
            expected = f"a writeable array of shape {shape} of 64-bit numbers"
            raise InputError(f"{self.function.name}: out", expected, arguments.kind_of_value(out))
        out[...] = result
        return out

    def _error_of_state(self, arrays: list[Array], wrong: int, code: int, many: bool) -> InputError:
        """Return the error of a state for which a function has no value."""
        where = self.function.name + (f": state {wrong}" if many else "")
        for name, array in zip(self.function.arguments, arrays, strict=True):
            if not np.isfinite(array if array.ndim == 1 else array[wrong]).all():
                return InputError(f"{where}: {_NAMES[name]}", "finite numbers", "some that are not")
        return InputError(where, *_FAULTS[code])
