"""Functions that give the same bits compiled and as plain Python: no operation is contracted, none reordered.

A single start of a small mechanism is done sooner by plain Python than compiled code is loaded, and it has to be the
start that a row of a sweep has.
"""

from __future__ import annotations

import types
from collections.abc import Callable
from functools import cached_property
from typing import Any

from numba import config
from numba.core.types import Dispatcher

from symgen.runtime import bare
from symgen.store.jit import jit
from symgen.store.loops import from_its_source


class Exact:
    """A function in both forms, each made when it is first asked for: a dispatcher alone takes a millisecond.

    Attributes
    ----------
    py_func : function
        Its source. What it calls may be such functions as well.
    """

    def __init__(self, function: Callable[..., Any], signatures: tuple[Any, ...], once: bool) -> None:
        self.py_func, self._signatures, self._once = function, signatures, once

    @cached_property
    def compiled(self) -> Any:
        """The compiled function; one without signatures is for calls from compiled code, and has no wrappers."""
        if self._signatures:
            return from_its_source(*self._signatures, once=self._once, fastmath=False)(self.py_func)
        wrappers = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True, "forceinline": True}
        return jit(fastmath=False, **wrappers)(self.py_func)

    @cached_property
    def plain(self) -> Any:
        """The function as plain Python, with all that it calls; functions that it is given are called as they are."""
        names = {**self.py_func.__globals__, "part": bare.plain_part, "bare": bare.plain_bare}
        names |= {name: plain_form(names[name]) for name in self.py_func.__code__.co_names if name in names}
        return types.FunctionType(self.py_func.__code__, names, self.py_func.__name__)

    @property
    def _numba_type_(self) -> Any:
        """What compiled code takes it for."""
        return Dispatcher(self.compiled)


def exact(*signatures: Any, once: bool = False) -> Callable[[Callable[..., Any]], Any]:
    """Return a decorator that makes a function `Exact`; plain Python where nothing is compiled.

    One that is called `once` a run is compiled in less time; its bits are the same.
    """
    return lambda function: function if config.DISABLE_JIT else Exact(function, signatures, once)


def plain_form(function: Any) -> Any:
    """Return an exact function as plain Python, any other one as it is."""
    return function.plain if isinstance(function, Exact) else function


def compiled_form(function: Any) -> Any:
    """Return an exact function compiled, any other one as it is."""
    return function.compiled if isinstance(function, Exact) else function
