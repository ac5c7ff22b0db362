"""Arrays without ownership, and parts of them.

In Numba, an array has an owner whose references are counted; the compiled functions of `symgen.compile.store.jit` have
only addresses and lengths. Their readers recognise these two functions by name.
"""

from __future__ import annotations

from typing import TypeVar

from symgen.compile.native.annotations import Array, Integers
from symgen.compile.native.compiler import is_interpreted
from symgen.compile.native.pieces import piece_of

_Value = TypeVar("_Value")
_Array = TypeVar("_Array", Array, Integers)


def _bare(value: _Value) -> _Value:
    """Return the same array, or record of arrays and numbers; the caller owns its memory."""
    return value


def _part(array: _Array, first: int, size: int) -> _Array:
    """Return `size` elements of a one-dimensional array from index `first` on, unchecked."""
    return array[first : first + size]


bare = _bare if is_interpreted() else piece_of("bare", _bare)
part = _part if is_interpreted() else piece_of("part", _part)
