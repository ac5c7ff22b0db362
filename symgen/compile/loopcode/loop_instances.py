"""Loops as instances of a source: plain Python whose global names are replaced, compiled as one function.

The frame of all loops (`symgen.run.loops.frame`) calls the step of its scheme and all functions that depend on the
target by global names. `Instances` copies a function with other meanings of such names, and every callee that these
meanings affect. Plain functions are parts: the compiler copies their code into their callers, so that calls and records
as arguments cost nothing; parts marked `called` are excepted. Functions made by `symgen.compile.store.jit` are compiled
separately, as elsewhere.
"""

from __future__ import annotations

import functools
import types as python
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from symgen.compile.loopcode.exact import Exact
from symgen.compile.native import types
from symgen.compile.native.compiler import is_interpreted
from symgen.compile.native.pieces import Piece
from symgen.compile.store.jit import RuntimeFunction, jit

Function = TypeVar("Function", bound=Callable[..., Any])
#: Makes a compiled function of a copy; the original, a plain or a compiled function, determines the kind.
Compile = Callable[[python.FunctionType, Any], Any]


def called(function: Function) -> Function:
    """Mark a part that is called: a long one with several callers, or one seldom reached."""
    function.called = True  # type: ignore[attr-defined]  # an own mark, read by `part`
    return function


def viewing(function: Function) -> Function:
    """Mark a part that returns arrays: on devices it is copied into its callers before type inference."""
    function.viewing = True  # type: ignore[attr-defined]  # a mark of our own
    return function


class Meanings(dict[str, Any]):
    """Meanings of global names for `Instances`, and when they hold.

    ``docs/development/late-names.md`` lists all of them.

    Parameters
    ----------
    when : str
        The runs that have these meanings, in words.
    **names
        Functions and constants by the names that they replace.
    """

    def __init__(self, when: str, **names: Any) -> None:
        super().__init__(names)
        self.when = when


def part(copy: python.FunctionType, original: object, contracted: bool = True) -> Any:
    """Return a part of a loop, compiled for processors."""
    if is_interpreted():
        return copy
    return RuntimeFunction(copy, inlined=not hasattr(original, "called"), contracted=contracted)


def compiled_loop(
    module: str, name: str, function: Any, signature: Any, once: bool = False, contracted: bool = True, **meanings: Any
) -> Any:
    """Return a compiled loop: an instance of `function` for given types, kept in the cache of machine code.

    Parameters
    ----------
    module, name : str
        Module variable of the loop: another process loads it from there, and it identifies the loop in the cache.
    function : plain function
        The source.
    signature : Signature
        Its types.
    once, contracted : bool
        As for `symgen.compile.store.jit.jit`.
    **meanings
        See `Instances`.
    """
    copy = Instances(meanings, functools.partial(part, contracted=contracted)).copy(function)
    copy.__module__, copy.__name__, copy.__qualname__ = module, name, name
    return jit(signature, once=once, contracted=contracted)(copy)


def exact_instance(function: Function, meanings: Mapping[str, Any]) -> Function:
    """Return an exact function with other meanings of names in it and in its callees; see `Instances`.

    Functions with the same meanings share callees, which are compiled once.
    """
    made: Function = _exact_instances(tuple(sorted(meanings.items()))).of(function)
    return made


@functools.cache
def _exact_instances(meanings: tuple[tuple[str, Any], ...]) -> Instances:
    def same_kind(copy: python.FunctionType, original: object) -> Any:
        return original.like(copy) if isinstance(original, Exact) else copy

    return Instances(dict(meanings), same_kind)


def signature_of(loop: object) -> Any:
    """Return the types of a compiled loop; empty without compilation."""
    return getattr(loop, "signature", types.int64())


class Instances:
    """Copies of runtime functions and their callees with other meanings of global names.

    Parameters
    ----------
    meanings : mapping
        Meanings of names: plain functions, which are copied as well, compiled functions, or constants.
    compiled : callable
        Makes a function of a copy.
    everything : bool
        Whether compiled functions that no meaning affects are copied too.
    """

    def __init__(self, meanings: Mapping[str, Any], compiled: Compile = part, everything: bool = False) -> None:
        self.meanings, self.compiled, self.everything = meanings, compiled, everything
        self.instances: dict[Any, Any] = {}

    def of(self, function: object) -> Any:
        """Return the instance of a plain or compiled function, made once from its Python source."""
        plain = getattr(function, "py_func", function)
        if plain not in self.instances:
            self.instances[plain] = self.compiled(self.copy(plain), function)
        return self.instances[plain]

    def copy(self, function: Any) -> python.FunctionType:
        """Return a copy of a plain function with the new meanings of names.

        Raises
        ------
        ValueError
            If it calls a function for processors only.
        """
        names = {name: self.meaning(name, function) for name in function.__code__.co_names}
        meanings = {**function.__globals__, **{name: value for name, value in names.items() if value is not None}}
        result = python.FunctionType(function.__code__, meanings, function.__name__, function.__defaults__)
        result.__module__, result.__qualname__ = function.__module__, function.__qualname__
        result.__dict__.update(function.__dict__)  # marks
        result.__annotations__ = function.__annotations__  # of an entry, its types
        return result

    def meaning(self, name: str, function: Any) -> Any:
        """Return the value of a global name in the copy of a function, or None if undefined."""
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

    def changes(self, value: object, visited: set[Any]) -> bool:
        """Whether the meanings affect a compiled function or one of its callees."""
        plain = getattr(value, "py_func", None)
        if plain is None or plain in visited:
            return False
        visited.add(plain)
        names = plain.__code__.co_names
        return any(n in self.meanings or self.changes(plain.__globals__.get(n), visited) for n in names)
