"""Functions with the same bits compiled and as plain Python: no operation is contracted or reordered.

Plain Python finishes a single start of a small mechanism before compiled code is loaded, and the start must equal that
of a row of a sweep.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from types import FunctionType
from typing import Any, TypeVar, cast

from symgen.compile.native.annotations import Array
from symgen.compile.native.compiler import is_interpreted
from symgen.compile.native.pieces import Piece
from symgen.compile.store.jit import RuntimeFunction

_Function = TypeVar("_Function", bound=Callable[..., Any])


class Exact:
    """A function in both forms, each made at its first use.

    Attributes
    ----------
    py_func : function
        The source; its callees may be `Exact` as well.
    """

    def __init__(self, function: FunctionType, entry: bool, once: bool) -> None:
        self.py_func, self._entry, self._once = function, entry, once

    def like(self, function: FunctionType) -> Exact:
        """Return another function of the same kind."""
        return Exact(function, self._entry, self._once)

    @cached_property
    def compiled(self) -> RuntimeFunction:
        """The compiled function; other than an entry, it is for calls from compiled code."""
        return RuntimeFunction(
            self.py_func, inlined=not self._entry, contracted=False, entry=self._entry, once=self._once
        )

    @property
    def _numba_type_(self) -> Any:
        """Type of the compiled function where code compiled by Numba names it."""
        return self.compiled._numba_type_

    @cached_property
    def plain(self) -> Any:
        """The function and its callees as plain Python; functions passed as arguments stay as they are."""
        names = dict(self.py_func.__globals__)
        names |= {name: plain_form(names[name]) for name in self.py_func.__code__.co_names if name in names}
        return FunctionType(self.py_func.__code__, names, self.py_func.__name__)


def exact(*, entry: bool = False, once: bool = False) -> Callable[[_Function], _Function]:
    """Return a decorator that makes a function `Exact`; without compilation, it stays plain Python.

    Parameters
    ----------
    entry : bool
        Whether it is called from Python, or by its address, with arguments of the annotated types.
    once : bool
        Whether it is called about once a run: it is compiled in less time; its bits are the same.
    """
    if is_interpreted():
        return lambda function: function

    def decorate(function: _Function) -> _Function:
        made: Any = Exact(cast("FunctionType", function), entry, once)
        return cast("_Function", made)

    return decorate


def plain_form(function: object) -> Any:
    """Return an exact function, or one in LLVM's language, as plain Python, any other unchanged."""
    return function.plain if isinstance(function, Exact | Piece) else function


def compiled_form(function: object) -> Any:
    """Return an exact function compiled, any other unchanged."""
    return function.compiled if isinstance(function, Exact) else function


@exact()
def copy_numbers(source: Array, copy: Array, count: int) -> None:
    """Copy the first numbers of an array."""
    for i in range(count):
        copy[i] = source[i]
