"""Addresses of compiled kernels, which generic code of the looped shape calls through tables."""

from __future__ import annotations

from types import ModuleType
from typing import Any

from symgen.compile.native import types
from symgen.compile.native.compiler import is_interpreted

_A = types.float64[::1]
_T, _I = types.uint32[::1], types.int64
#: kernel(t, y, p, w, T, at, out).
KERNEL = types.int64(types.float64, _A, _A, _A, _T, types.uint32, _A)
#: Generic code (T, p, w, i, j, k, value).
GENERIC = types.int64(_T, _A, _A, _I, _I, _I, types.float64)


def address(function: Any, machine: ModuleType, signature: types.Signature = KERNEL) -> int:
    """Return the address of a function, first compiled or read from the cache if needed.

    Parameters
    ----------
    function : EmittedFunction
        A function of an emitted kernel, or generic code.
    machine : module
        Generic code that calls it.
    signature : Signature
        `KERNEL` or `GENERIC`.
    """
    if is_interpreted():
        machine.KERNELS.append(function)
        return len(machine.KERNELS) - 1
    place: int = function.address(signature)
    return place
