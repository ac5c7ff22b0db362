"""Emitted functions for calls from Python, with the machine code that loops of all models take."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

from symgen.runtime import abi

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel

#: Functions that have machine code, each for some signatures: asking for it again costs more than most calls.
_made: WeakKeyDictionary[Any, set[int]] = WeakKeyDictionary()


class Ready:
    """An emitted function, compiled or taken from the cache when it is first called.

    Parameters
    ----------
    function : Dispatcher or function
        What is called; plain Python where nothing is compiled.
    kind : FunctionType
        Its type, of `symgen.runtime.abi`: machine code is cached under the signature that loops ask for.
    """

    def __init__(self, function: Any, kind: Any) -> None:
        self._function, self._kind = function, kind

    def __call__(self, *arguments: Any) -> Any:
        """Call it."""
        if self._kind is not None and hasattr(self._function, "compile"):
            made = _made.setdefault(self._function, set())
            if id(self._kind) not in made:  # types are constants of a module
                self._function.compile(self._kind.signature)
                made.add(id(self._kind))
        self._kind = None
        return self._function(*arguments)


def rate_function(compiled: CompiledModel) -> Callable[..., None]:
    """Return the function (t, y, p, w, iw, rate) that sets `rate` to q' and v' at a state, and the multipliers in w.

    A law that integrates something else than v has a function of its own for that; where a pivot is suspicious, rates
    are those behind a closer look.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    """
    law = compiled.law_module
    function = getattr(law, "rates", law.rhs)
    rates, confirm = Ready(function, abi.RHS), Ready(getattr(law, "confirm", function), abi.RHS)

    def evaluate(*arguments: Any) -> None:
        if rates(*arguments) != 0:
            confirm(*arguments)

    return evaluate
