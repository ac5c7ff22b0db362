"""Arithmetic on whole states in vectors of eight numbers.

Arrays have lengths of `symgen.compile.loopcode.padding`, filled with zeros, so no loop has a remainder. Vectors are
explicit, because compilers that vectorise loops check at run time whether arrays overlap, which takes as long as the
work on a small state. Processors with shorter vectors process a block in several parts.

This module has the plain loops, which Numba and CUDA devices use too; `symgen.compile.loopcode.vector_code` writes the
vectors.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Integers
from symgen.compile.native.compiler import is_interpreted
from symgen.compile.native.pieces import piece_of

_Function = TypeVar("_Function", bound=Callable[..., Any])

# -- plain loops -------------------------------------------------------------------------------------------------------


def _combine(
    width: int, h: float, first: int, last: int, column: Integers, value: Array, rows: Array, base: Array, out: Array
) -> None:
    """Set out = base + h sum of value times row, over the entries from `first` to `last` of a packed table.

    Parameters
    ----------
    width : int
        Length of `base`, `out` and each row: a multiple of `BLOCK`.
    h : float
        Factor of the sum.
    column, value : Array
        Row and coefficient of each entry.
    rows : Array
        One row after the other.
    base, out : Array, shape (width,)
        May be the same.
    """
    for i in range(width):
        out[i] = base[i]
    for k in range(first, last):
        factor, at = h * value[k], column[k] * width
        for i in range(width):
            out[i] += factor * rows[at + i]


def _total(
    width: int, h: float, first: int, last: int, column: Integers, value: Array, rows: Array, out: Array
) -> None:
    """Set out = h sum of value times row; as `_combine`."""
    for i in range(width):
        out[i] = 0.0
    for k in range(first, last):
        factor, at = h * value[k], column[k] * width
        for i in range(width):
            out[i] += factor * rows[at + i]


def _copied(width: int, array: Array, out: Array) -> None:
    """Set `out` to an array."""
    for i in range(width):
        out[i] = array[i]


def _weigh(width: int, error: Array, share: Array, y: Array, new: Array, rtol: float, atol: float) -> float:
    """Return the sum of the squares of share times error over ``atol + rtol share max(|y|, |new|)``; 0 / 0 counts 0.

    After the shares are the places that `y` and `new` are measured from.
    """
    total = 0.0
    for i in range(width):
        allowed = atol + rtol * (share[i] * max(abs(y[i] - share[width + i]), abs(new[i] - share[width + i])))
        if share[i] * error[i] != 0.0:
            total += (share[i] * error[i] / allowed) ** 2
    return total


def _largest(width: int, array: Array, weights: Array, first: int, last: int) -> float:
    """Return the largest weighted magnitude of the elements from `first` to `last`, at least 0; nan is ignored.

    After the weights are the places that the elements are measured from.
    """
    largest = 0.0
    for i in range(first, last):
        size = abs(array[i] - weights[width + i]) * weights[i]
        if size > largest:
            largest = size
    return largest


def _finite(width: int, array: Array) -> bool:
    """Return whether all elements are finite."""
    total = 0.0
    for i in range(width):
        total += array[i] - array[i]
    return total == 0.0


PLAIN: dict[str, Callable[..., Any]] = {
    "combine": _combine,
    "follow": _combine,
    "total": _total,
    "copied": _copied,
    "received": _copied,
    "weigh": _weigh,
    "largest": _largest,
    "finite": _finite,
}
_RESULTS = {"weigh": types.float64, "largest": types.float64, "finite": types.boolean}


def _vector(name: str, plain: _Function) -> _Function:
    """Return one of these functions in the form for the compiler in use."""
    if is_interpreted():
        return plain
    return piece_of(name, plain, _RESULTS.get(name, types.void), "symgen.compile.loopcode.vector_code")


combine, follow, total = _vector("combine", _combine), _vector("follow", _combine), _vector("total", _total)
copied, received = _vector("copied", _copied), _vector("received", _copied)
weigh, largest, finite = _vector("weigh", _weigh), _vector("largest", _largest), _vector("finite", _finite)
