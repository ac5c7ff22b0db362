"""Functions that give the same bits compiled and as plain Python: no operation is contracted, none reordered.

A single start of a small mechanism is done sooner by plain Python than compiled code is loaded, and it has to be the
start that a row of a sweep has.
"""

from __future__ import annotations

import types
from collections.abc import Callable
from functools import cached_property
from typing import Any

from symgen.native.compiler import interpreted
from symgen.native.pieces import Piece
from symgen.native.types import Signature
from symgen.store.jit import RuntimeFunction


class Exact:
    """A function in both forms, each made when it is first wanted.

    Attributes
    ----------
    py_func : function
        Its source. What it calls may be such functions as well.
    """

    def __init__(self, function: Callable[..., Any], signature: Signature | None, once: bool) -> None:
        self.py_func, self._signature, self._once = function, signature, once

    @cached_property
    def compiled(self) -> Any:
        """The compiled function; one without signature is for calls from compiled code."""
        return RuntimeFunction(
            self.py_func,
            inlined=self._signature is None,
            contracted=False,
            signature=self._signature,
            once=self._once,
        )

    @cached_property
    def plain(self) -> Any:
        """The function as plain Python, with all that it calls; functions that it is given are called as they are."""
        names = dict(self.py_func.__globals__)
        names |= {name: plain_form(names[name]) for name in self.py_func.__code__.co_names if name in names}
        return types.FunctionType(self.py_func.__code__, names, self.py_func.__name__)


def exact(signature: Signature | None = None, once: bool = False) -> Callable[[Callable[..., Any]], Any]:
    """Return a decorator that makes a function `Exact`; plain Python where nothing is compiled.

    One that is called `once` a run is compiled in less time; its bits are the same.
    """
    return lambda function: function if interpreted() else Exact(function, signature, once)


def plain_form(function: Any) -> Any:
    """Return an exact function, or one in LLVM's language, as plain Python, any other one as it is."""
    return function.plain if isinstance(function, Exact | Piece) else function


def compiled_form(function: Any) -> Any:
    """Return an exact function compiled, any other one as it is."""
    return function.compiled if isinstance(function, Exact) else function
