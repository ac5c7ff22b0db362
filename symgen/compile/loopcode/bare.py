"""Arrays without ownership, and parts of them.

In Numba, an array has an owner whose references are counted; the compiled functions of `symgen.compile.store.jit` have
only addresses and lengths. Their readers recognise these two functions by name.
"""

from __future__ import annotations

from typing import Any

from symgen.compile.native.compiler import interpreted
from symgen.compile.native.pieces import Piece


def _bare(value: Any) -> Any:
    """Return the same array, or record of arrays and numbers; the caller owns its memory."""
    return value


def _part(array: Any, first: int, size: int) -> Any:
    """Return `size` elements of a one-dimensional array from index `first` on, unchecked."""
    return array[first : first + size]


bare: Any = _bare if interpreted() else Piece("bare", _bare)
part: Any = _part if interpreted() else Piece("part", _part)
