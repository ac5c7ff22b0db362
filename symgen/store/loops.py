"""Loops of the runtime put into machine code without Numba's front end, where they are plain enough.

A loop is entered and cached as one that Numba compiles; what makes its machine code is `symgen.native.loops`, in a
tenth of the time, with the operations that Numba would put. Where something in it is not in that language, or Numba is
not as expected, Numba compiles it. `symgen.store.emitted.COMPILER` says which of the two is wanted.
"""

from __future__ import annotations

import ast
import functools
import marshal
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numba.core import event, sigutils, types

from symgen.native.library import Library, result
from symgen.native.machine import codegen, compiled, load
from symgen.store import private
from symgen.store.emitted import FromSource, compiler, explain, syntax_tree
from symgen.store.identity import NotDescribable, digest, file_digest, sources_digest
from symgen.store.jit import LazySignatures, jit
from symgen.store.machine_code import Loading, MachineCode
from symgen.store.objects import made
from symgen.store.paths import cache_location
from symgen.store.stats import counters

if TYPE_CHECKING:
    from symgen.native.language import Function, Scalar

#: How parts of loops are compiled; with other options the loop is Numba's to compile.
_OPTIONS = {"error_model": ("numpy",), "fastmath": ({"contract"}, False, None)}


def from_source(loop: Any, once: bool = False) -> Any:
    """Have a compiled loop made from its source, where that can be; return it.

    Parameters
    ----------
    loop : Dispatcher
        Made by ``symgen.store.jit.jit`` with signatures; the plain function where nothing is compiled.
    once : bool
        Whether it is called about once a run: then it is compiled in less time, without operations in vectors.
    """
    eager = getattr(loop, "_eager", None)
    if eager is not None and isinstance(eager._cache, MachineCode):
        eager._cache = LoopCode(eager, once)
        loop.__class__, eager.__class__ = _Loop, FromSource
    return loop


def from_its_source(*signatures: Any, once: bool = False, **options: Any) -> Callable[[Any], Any]:
    """Return a decorator as `symgen.store.jit.jit` does, for functions of the runtime with records and functions."""
    return lambda function: from_source(jit(*signatures, **options)(function), once)


class _Loop(FromSource, LazySignatures):
    """A loop, which is entered by its address."""

    def __call__(self, *arguments: Any) -> Any:
        """Call the function from Python."""
        self.open()
        made = list(self.overloads.values())
        if len(made) == 1 and isinstance(made[0].library, Library):
            return made[0].entry_point(*arguments)
        return super().__call__(*arguments)


class LoopCode(MachineCode):
    """The cache of a loop, which makes what it does not hold.

    Parameters
    ----------
    dispatcher : Dispatcher
        With a cache for what Numba compiles.
    once : bool
        Whether it is called about once a run.
    """

    def __init__(self, dispatcher: Any, once: bool = False) -> None:
        self.__dict__.update(dispatcher._cache.__dict__)
        self._once = once
        self._dispatcher = dispatcher
        self._read: dict[Any, Function | None] = {}
        self._by_numba = compiler() == "numba"
        if self._by_numba:  # what judges the other never takes its place
            self._identity = digest(self._identity, "by Numba")

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return what the cache holds, or what was made from the source; None where the loop is Numba's to compile."""
        found = None if self._by_numba else self._direct(sig, target_context)
        return found if found is not None else super().load_overload(sig, target_context)

    def has(self, sig: Any, target_context: Any) -> bool:
        """Whether there is an entry for a signature, be it one that turns out to be spoilt."""
        if not self._by_numba:
            try:
                if self._own(sig)[1].exists():
                    return True
            except NotDescribable:
                return False
        return super().has(sig, target_context)

    def _own(self, sig: Any) -> tuple[str, Path]:
        """Return the key of machine code made from the source, and where it is kept."""
        return self._place(sig, codegen(), "from the source", sources_digest("native"))

    def _direct(self, sig: Any, target_context: Any) -> Any:
        """Return machine code made from the source, None where there is none."""
        try:
            key, path = self._own(sig)
        except NotDescribable:
            return None
        symbol = f"_ZN6symgen{32 + len(self._stem)}{self._stem}{digest(key)[:32]}E"
        persistent = cache_location().persistent
        with Loading() as clock:
            data = private.read(path, key) if persistent else None
            if data is not None:
                clock.loaded = True
                counters["hits"] += 1
                return self._result(sig, symbol, marshal.loads(data))
        if persistent and super().has(sig, target_context):
            return None  # as it turned out to be in another process
        with event.trigger_event("numba:compile", data={"dispatcher": self._dispatcher, "args": sig}):
            code = self._made(sig, symbol)
            if code is None:
                counters["foreign"] += 1
                return None
            if persistent:
                private.write(path, key, marshal.dumps(code))
            counters["misses"] += 1
            counters["translated"] += 1
            return self._result(sig, symbol, code)

    def _function(self, sig: Any) -> Function | None:
        """Return the loop in the language of `symgen.native`, None if it is not in the language."""
        from symgen.native import internals
        from symgen.native.loops import read_loop
        from symgen.native.read import Foreign

        if sig not in self._read:
            try:
                if not internals.usable():
                    raise Foreign("Numba is not as expected, or asked to check or to debug")
                self._read[sig] = read_loop(self._dispatcher, _arguments(sig), definition)
            except Foreign as foreign:
                self._read[sig] = None
                explain(self._name, str(foreign))
        return self._read[sig]

    def _made(self, sig: Any, symbol: str) -> bytes | None:
        """Return an object file, None where the loop is Numba's to compile."""
        from symgen.native.loops_llvm import loop_module

        function = self._function(sig)
        if function is None:
            return None
        try:
            return compiled(loop_module(function, symbol, _arguments(sig)), symbol, vectors=not self._once)
        except RuntimeError as error:  # an LLVM that does not know the language any more
            explain(self._name, str(error))
            return None

    def _result(self, sig: Any, symbol: str, code: bytes) -> Any:
        """Put machine code into memory."""
        library = Library(load(code, (symbol, f"cfunc.{symbol}")), lambda: self._linkable(sig, symbol), made)
        returned = sigutils.normalize_signature(sig)[1]
        kind: Scalar = "float" if returned is types.float64 else "int"
        return result(self._dispatcher.py_func, _arguments(sig), kind, symbol, library, lambda f: None, known=True)

    def _linkable(self, sig: Any, symbol: str) -> str:
        """Return the text of a module that holds the function and all it calls."""
        from symgen.native.loops_llvm import loop_module

        function = self._function(sig)
        assert function is not None, "it was made from its source"
        return loop_module(function, symbol, _arguments(sig))


def _arguments(sig: Any) -> tuple[Any, ...]:
    return tuple(sigutils.normalize_signature(sig)[0])


def definition(function: Any) -> ast.FunctionDef | None:
    """Return the syntax tree of a function of the runtime, None where its source cannot be had."""
    options = function.targetoptions
    if any(options.get(name) not in values for name, values in _OPTIONS.items()):
        return None
    try:
        return syntax_tree(_lines(function.py_func.__code__.co_filename), function.py_func)
    except (OSError, ValueError):
        return None


@functools.lru_cache(maxsize=64)
def _lines(file: str) -> tuple[str, ...]:
    """Return the lines of a file, none of one that has been edited since what stands in it was loaded."""
    content = Path(file).read_bytes()
    return tuple(content.decode().split("\n")) if digest(content) == file_digest(file) else ()
