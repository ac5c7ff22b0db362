"""Loops as instances of a source: plain Python whose global names are given a meaning, and compiled as one function.

The frame of all loops (`symgen.runtime.frame`) calls its scheme's step, and everything that depends on where it runs,
by global names. `Instances` copies a function with other meanings of such names, and with it every function that it
calls and that would see the difference. Plain functions are parts: the compiler copies their code into their callers,
so that nothing is paid for a call or for records as arguments, but those that are marked `called`. Functions made by
`symgen.store.jit` are compiled by themselves, as elsewhere.
"""

from __future__ import annotations

import types as python
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from symgen.native import types
from symgen.native.compiler import interpreted
from symgen.native.pieces import Piece
from symgen.store.jit import RuntimeFunction, jit

Function = TypeVar("Function", bound=Callable[..., Any])
#: Makes a compiled function of a copy; the original, a plain or a compiled function, says what kind it was.
Compile = Callable[[python.FunctionType, Any], Any]


def called(function: Function) -> Function:
    """Mark a part that is called: a long one that stands in several places, or that is seldom reached."""
    function.called = True  # type: ignore[attr-defined]  # a mark of our own, read by `part`
    return function


def viewing(function: Function) -> Function:
    """Mark a part that returns arrays: devices have it copied into its callers before types are inferred."""
    function.viewing = True  # type: ignore[attr-defined]  # a mark of our own
    return function


def part(copy: python.FunctionType, original: Any) -> Any:
    """Return a part of a loop, compiled for processors."""
    return copy if interpreted() else RuntimeFunction(copy, inlined=not hasattr(original, "called"))


def loop(module: str, name: str, function: Any, signature: Any, once: bool = False, **meanings: Any) -> Any:
    """Return a compiled loop: an instance of `function` for given types, kept in the cache of machine code.

    Parameters
    ----------
    module, name : str
        The module variable that holds it: a second process finds it there, and the cache tells loops apart by it.
    function : plain function
        The source.
    signature : Signature
        Its types.
    once : bool
        As for `symgen.store.jit.jit`.
    **meanings
        See `Instances`.
    """
    copy = Instances(meanings).copy(function)
    copy.__module__, copy.__name__, copy.__qualname__ = module, name, name
    return jit(signature, once=once)(copy)


def signature_of(loop: Any) -> Any:
    """Return the types of a compiled loop; none where nothing is compiled."""
    return getattr(loop, "signature", types.int64())


class Instances:
    """Copies of functions of the runtime, and of what they call, with other meanings of global names.

    Parameters
    ----------
    meanings : mapping
        What names mean: plain functions, which are copied as well, compiled functions, or constants.
    compiled : callable
        What is made of a copy.
    everything : bool
        Whether compiled functions are copied too where they would see no difference.
    """

    def __init__(self, meanings: Mapping[str, Any], compiled: Compile = part, everything: bool = False) -> None:
        self.meanings, self.compiled, self.everything = meanings, compiled, everything
        self.instances: dict[Any, Any] = {}

    def of(self, function: Any) -> Any:
        """Return the instance of a plain or compiled function, of which the Python source counts; each is made once."""
        plain = getattr(function, "py_func", function)
        if plain not in self.instances:
            self.instances[plain] = self.compiled(self.copy(plain), function)
        return self.instances[plain]

    def copy(self, function: Any) -> python.FunctionType:
        """Return a copy of a plain function in which names mean what they shall.

        Raises
        ------
        ValueError
            If it calls what is made for processors only.
        """
        names = {name: self.meaning(name, function) for name in function.__code__.co_names}
        meanings = {**function.__globals__, **{name: value for name, value in names.items() if value is not None}}
        result = python.FunctionType(function.__code__, meanings, function.__name__, function.__defaults__)
        result.__module__, result.__qualname__ = function.__module__, function.__qualname__
        return result

    def meaning(self, name: str, function: Any) -> Any:
        """Return the value of a global name of a function in its copy, None where it does not matter."""
        replaced = name in self.meanings
        value = self.meanings[name] if replaced else function.__globals__.get(name)
        plain = getattr(value, "py_func", None)
        if self.everything and not replaced and isinstance(value, Piece):
            raise ValueError(f"{function.__name__} needs '{name}' as a device function")
        if isinstance(value, python.FunctionType):
            return self.of(value)
        if plain is not None and not replaced and (self.everything or self.changes(value, set())):
            return self.of(value)
        return value

    def changes(self, value: Any, visited: set[Any]) -> bool:
        """Whether a compiled function, or one that it calls, would see a difference."""
        plain = getattr(value, "py_func", None)
        if plain is None or plain in visited:
            return False
        visited.add(plain)
        names = plain.__code__.co_names
        return any(n in self.meanings or self.changes(plain.__globals__.get(n), visited) for n in names)
