"""Route to machine code, selected by environment variables."""

from __future__ import annotations

import functools
import os

from symgen.base.errors import InputError, suggest

#: Environment variable: "source", the default, for machine code from the source by symgen's own route; "explain" for
#: the same with a line on standard error for each function that is compiled; "libm" for the same with sines of the C
#: library, one by one; "numba" for Numba's compiler.
COMPILER = "SYMGEN_COMPILER"
_COMPILERS = ("source", "explain", "libm", "numba")


def selected_compiler() -> str:
    """Return the route to machine code that the environment selects.

    Raises
    ------
    InputError
        If the name is unknown.
    """
    name = os.environ.get(COMPILER) or _COMPILERS[0]
    if name not in _COMPILERS:
        raise InputError(COMPILER, "one of " + ", ".join(_COMPILERS), f"'{name}'", suggest(name, _COMPILERS))
    return name


@functools.cache
def is_by_numba() -> bool:
    """Whether Numba compiles everything, read once a process."""
    return selected_compiler() == "numba" and not is_interpreted()


@functools.cache
def is_interpreted() -> bool:
    """Whether nothing is compiled: ``NUMBA_DISABLE_JIT=1``, read once a process as Numba does."""
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")
