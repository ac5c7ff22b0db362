"""Machine code of Numba, kept between processes.

References are compiled by Numba, not by the compiler of the runs that they judge, and Numba takes seconds for what all
mechanisms share. Numba's own cache is beside the sources and knows neither functions without a file nor a change
in another file.
"""

from __future__ import annotations

import functools
import pickle
from collections.abc import Callable
from typing import Any

import numba
from numba.core.compiler import CompileResult
from numba.core.registry import cpu_target

from symgen.compile.native.machine import processor_features
from symgen.compile.store.entries import get_or_make_data
from symgen.compile.store.sources import reached_digest
from symgen.compile.store.upkeep import NATIVE

#: What the machine code of references follows from, beside the text of equations.
SOURCES = ("study/references/motion.py", "study/references/numba_code.py")


def machine_code(name: str, signature: object, identity: str, make: Callable[[], Any]) -> Any:
    """Return the result of a compilation by Numba, from the cache or made anew.

    Parameters
    ----------
    name : str
        Name of the function, for the cache.
    signature : signature
        Types of its arguments.
    identity : str
        What its machine code depends on beside `SOURCES`.
    make : callable
        Returns the function compiled by `numba.njit` for this signature.

    Returns
    -------
    CompileResult
        Its ``entry_point`` can be called.
    """
    fresh = list[Any]()

    def compile_and_pickle() -> bytes:
        (result,) = make().overloads.values()
        fresh.append(result)
        return pickle.dumps(result._reduce())

    code = get_or_make_data(
        f"{NATIVE}/references",
        name,
        "\n".join((name, repr(signature), identity, _numba_environment())),
        compile_and_pickle,
    )
    if fresh:
        return fresh[0]
    context = cpu_target.target_context
    context.refresh()  # what machine code calls has to be there
    return CompileResult._rebuild(context, *pickle.loads(code))


@functools.cache
def _numba_environment() -> str:
    return "\n".join((numba.__version__, processor_features(), reached_digest(*SOURCES)))
