"""Emitted functions for calls from Python, with the machine code that loops of all models take."""

from __future__ import annotations

from typing import Any


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
        self._function, self._signature = function, kind.signature

    def __call__(self, *arguments: Any) -> Any:
        """Call it."""
        if self._signature is not None and hasattr(self._function, "compile"):
            self._function.compile(self._signature)
        self._signature = None
        return self._function(*arguments)
