"""Which compiler makes machine code, as environment variables name it."""

from __future__ import annotations

import functools
import os

from symgen.errors import InputError, nearest

#: Environment variable: "source", the default, for machine code from the source by symgen's own route; "explain" for
#: the same with a line on standard error for each function that is compiled; "libm" for the same with sines of the C
#: library, one by one; "numba" for everything by Numba, without a cache: for judging the other one, and for loops that
#: are outside its language.
COMPILER = "SYMGEN_COMPILER"
_COMPILERS = ("source", "explain", "libm", "numba")


def compiler() -> str:
    """Return the compiler that the environment names.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    name = os.environ.get(COMPILER) or _COMPILERS[0]
    if name not in _COMPILERS:
        raise InputError(COMPILER, "one of " + ", ".join(_COMPILERS), f"'{name}'", nearest(name, _COMPILERS))
    return name


def by_numba() -> bool:
    """Whether Numba compiles everything."""
    return compiler() == "numba"


@functools.cache
def interpreted() -> bool:
    """Whether nothing is compiled: ``NUMBA_DISABLE_JIT=1``, read once a process as Numba does."""
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")
