"""Emitted functions for calls from Python, with the machine code that loops of all models use."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.compile.native import types
from symgen.compile.store.jit import MachineFunction
from symgen.compile.store.loaded_modules import plain_function
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel


class Ready:
    """An emitted function, compiled or taken from the cache when it is first called.

    Parameters
    ----------
    function : EmittedFunction or function
        The function; plain Python where nothing is compiled.
    kind : FunctionType
        Its type, of `symgen.run.layout.abi`.
    """

    def __init__(self, function: Callable[..., Any], kind: types.FunctionType) -> None:
        self._function, self._kind = function, kind

    def __call__(self, *arguments: Any) -> Any:
        """Call it."""
        if isinstance(self._function, MachineFunction):
            self._function = self._function.caller(self._kind.signature.arguments)
        return self._function(*arguments)


class Few:
    """An emitted function that plain Python evaluates, as a few calls are not worth compiling it.

    Operations that raise in plain Python, such as the root of a negative number or a division by zero, are nan or
    infinite in compiled code; where one raises, the compiled function is called, so that results are the same.

    Parameters
    ----------
    function : EmittedFunction or function
        The function; it must not write a number that it has read.
    kind : FunctionType
        As for `Ready`.
    """

    def __init__(self, function: Any, kind: types.FunctionType) -> None:
        self._plain, self._ready = plain_function(function), Ready(function, kind)

    def __call__(self, *arguments: object) -> Any:
        """Call it."""
        with np.errstate(all="ignore"):
            try:
                return self._plain(*arguments)
            except (ArithmeticError, ValueError):
                return self._ready(*arguments)


def rate_functions(law: ModuleType) -> tuple[Any, Any]:
    """Return the functions of an emitted law that compute rates of v and multipliers, and confirm them."""
    rates = getattr(law, "rates", law.rhs)  # a law that does not integrate v has an extra function for its rates
    return rates, getattr(law, "confirm", rates)


def rate_function(compiled: CompiledModel) -> Callable[..., None]:
    """Return the function (t, y, p, w, iw, rate) that sets `rate` to q' and v' at a state, and the multipliers in w.

    A law that does not integrate v has an extra function for v'; where a pivot is suspicious, rates are confirmed.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    """
    rates, confirm = (Ready(function, abi.RHS) for function in rate_functions(compiled.law_module))

    def evaluate_rates(*arguments: object) -> None:
        if rates(*arguments) != 0:
            confirm(*arguments)

    return evaluate_rates
