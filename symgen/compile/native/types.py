"""Types of arguments and results of compiled functions.

`float64`, `int64`, `uint32` and `boolean` are numbers, and `void` is the result of a function without one.
``float64[::1]`` is a contiguous array of one dimension, ``float64[:, ::1]`` one of two; ``int64(float64, int64)`` is a
signature. The spelling is Numba's, so that emitted modules, which name these types, mean the same with both compilers.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

#: Number of nodes of a step evaluated at once, as a vector: all points of the step but its start.
NODES = 8


@dataclass(frozen=True)
class NumberType:
    """A number, or nothing."""

    name: str

    def __getitem__(self, axes: slice | tuple[slice, ...]) -> ArrayType:
        return ArrayType(self, len(axes) if isinstance(axes, tuple) else 1)

    def __call__(self, *arguments: Kind) -> Signature:
        """Return the signature of a function with this result."""
        return Signature(self, arguments)

    def __repr__(self) -> str:
        return self.name


@dataclass(frozen=True)
class ArrayType:
    """A contiguous array of numbers."""

    dtype: NumberType
    ndim: int

    def __repr__(self) -> str:
        return f"{self.dtype}[{':, ' * (self.ndim - 1)}::1]"


@dataclass(frozen=True)
class Signature:
    """Types of a function's result and arguments."""

    result: NumberType
    arguments: tuple[Kind, ...]

    def __repr__(self) -> str:
        return f"{self.result}({', '.join(map(repr, self.arguments))})"


@dataclass(frozen=True)
class FunctionType:
    """A compiled function as an argument, by its address."""

    signature: Signature

    def __repr__(self) -> str:
        return f"&{self.signature}"


@dataclass(frozen=True)
class RecordType:
    """A tuple, with its class if it is a named tuple."""

    parts: tuple[Kind, ...]
    constructor: Any = tuple

    @property
    def fields(self) -> tuple[str, ...]:
        """Names of its parts, or empty."""
        return getattr(self.constructor, "_fields", ())

    @functools.cached_property
    def whole(self) -> bool:
        """Whether all parts are integers of eight bytes."""
        return all(part is int64 for part in self.parts)

    def __iter__(self) -> Iterator[Kind]:
        return iter(self.parts)

    def __len__(self) -> int:
        return len(self.parts)

    def __repr__(self) -> str:
        return f"{self.constructor.__name__}{self.parts!r}"


Kind = NumberType | ArrayType | FunctionType | RecordType

float64, int64, uint32, boolean, void = (NumberType(name) for name in ("float64", "int64", "uint32", "boolean", "void"))
