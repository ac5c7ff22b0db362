"""Functions with the same bits compiled and as plain Python: no operation is contracted or reordered.

Plain Python finishes a single start of a small mechanism before compiled code is loaded, and the start must equal that
of a row of a sweep.
"""

from __future__ import annotations

import types
from collections.abc import Callable
from functools import cached_property
from typing import Any

from symgen.compile.native.compiler import interpreted
from symgen.compile.native.pieces import Piece
from symgen.compile.native.types import Signature
from symgen.compile.store.jit import RuntimeFunction


class Exact:
    """A function in both forms, each made at its first use.

    Attributes
    ----------
    py_func : function
        The source; its callees may be `Exact` as well.
    """

    def __init__(self, function: Callable[..., Any], signature: Signature | None, once: bool) -> None:
        self.py_func, self._signature, self._once = function, signature, once

    @cached_property
    def compiled(self) -> Any:
        """The compiled function; without a signature, it is for calls from compiled code."""
        return RuntimeFunction(
            self.py_func,
            inlined=self._signature is None,
            contracted=False,
            signature=self._signature,
            once=self._once,
        )

    @cached_property
    def plain(self) -> Any:
        """The function and its callees as plain Python; functions passed as arguments stay as they are."""
        names = dict(self.py_func.__globals__)
        names |= {name: plain_form(names[name]) for name in self.py_func.__code__.co_names if name in names}
        return types.FunctionType(self.py_func.__code__, names, self.py_func.__name__)


def exact(signature: Signature | None = None, once: bool = False) -> Callable[[Callable[..., Any]], Any]:
    """Return a decorator that makes a function `Exact`; without compilation, it stays plain Python.

    A function called `once` a run is compiled in less time; its bits are the same.
    """
    return lambda function: function if interpreted() else Exact(function, signature, once)


def plain_form(function: Any) -> Any:
    """Return an exact function, or one in LLVM's language, as plain Python, any other unchanged."""
    return function.plain if isinstance(function, Exact | Piece) else function


def compiled_form(function: Any) -> Any:
    """Return an exact function compiled, any other unchanged."""
    return function.compiled if isinstance(function, Exact) else function


@exact()
def copy_numbers(source: Any, copy: Any, count: int) -> None:
    """Copy the first numbers of an array."""
    for i in range(count):
        copy[i] = source[i]
