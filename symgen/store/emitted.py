"""Functions of emitted modules: put into machine code without Numba's front end where they are plain enough.

Most of the time that Numba takes for such a function goes into finding out what it says itself: its types. Where a
function is in the language of `symgen.native`, its machine code is made from its source, with the operations that Numba
would put, in the same order, so results are the same to the last bit (`tests/native/test_judge.py`). Any other function
is compiled by Numba, and so is every function where Numba is not as expected. The environment variable `COMPILER` says
which of the two is wanted.

Machine code is kept in the cache like that of Numba's functions (`symgen.store.jit`): an entry holds a function's own,
and names the functions it calls, which are loaded first.
"""

from __future__ import annotations

import ast
import contextlib
import functools
import gc
import marshal
import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from numba import njit
from numba.core import event, sigutils
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import CPUDispatcher

from symgen.errors import InputError, nearest
from symgen.native.library import Library, arguments_of, kinds_of, kinds_of_function, result
from symgen.native.machine import compiled, load, processor
from symgen.store import private
from symgen.store.identity import NotDescribable, digest, source_stamp, sources_digest
from symgen.store.jit import attach, unusable
from symgen.store.machine_code import Loading, MachineCode, environment, plain_name
from symgen.store.paths import cache_location
from symgen.store.stats import counters
from symgen.store.upkeep import NATIVE

if TYPE_CHECKING:
    from symgen.native.language import Function, Scalar
    from symgen.native.read import Kind

#: Environment variable: "source", the default, for machine code from the source where that can be; "explain" for the
#: same with a line on standard error for each function that is left to Numba; "libm" for the same with sines of the C
#: library, one by one, which are Numba's to the last bit; "numba" for all functions by Numba.
COMPILER = "SYMGEN_COMPILER"
_COMPILERS = ("source", "explain", "libm", "numba")
#: How emitted functions are decorated; with other options a function is Numba's to compile.
_OPTIONS = {"error_model": "numpy", "fastmath": {"contract"}, "nopython": True, "boundscheck": None}
_INLINED = {**_OPTIONS, "inline": "always"}
#: Functions of up to so many statements are copied into those that call them, if LLVM thinks that good.
_SHORT = 60


class Origin(NamedTuple):
    """Where a function comes from: digest of all sources it depends on, and the text of its file as it was loaded.

    What was loaded is what counts: whether its file is still there, or still the same, says how full a cache is.
    """

    stamp: str
    content: bytes


class _Entry(NamedTuple):
    """Machine code as it is kept: type of the result, functions called with the types of their arguments, object."""

    returned: Scalar
    called: tuple[tuple[str, tuple[Kind, ...]], ...]
    code: bytes


class FromSource(CPUDispatcher):  # type: ignore[misc]  # Numba has no types
    """A dispatcher of which some results come from the source."""

    def add_overload(self, result: Any) -> None:
        """Enter a result; calls from Python learn of one that comes from the source when the first of them is made."""
        if isinstance(result.library, Library):
            self.overloads[tuple(result.signature.args)] = result
        else:
            super().add_overload(result)


class EmittedFunction(FromSource):
    """A dispatcher that makes machine code from the source of its function, or else as every dispatcher does."""

    _origin: Origin | None = None
    _together = True  # sines and cosines of several angles
    _keys: dict[tuple[Kind, ...], str]
    _foreign: set[tuple[Kind, ...]]

    @classmethod
    def of(cls, dispatcher: Any, origin: Origin) -> None:
        """Make a function of an emitted module one of these.

        Parameters
        ----------
        dispatcher : Dispatcher
            Made by ``numba.njit``; anything else, such as a plain function under ``NUMBA_DISABLE_JIT=1``, is left as
            it is.
        origin : Origin
            Where the function comes from.

        Raises
        ------
        InputError
            If the environment names no compiler.
        """
        if compiler() == "numba":
            attach(dispatcher, f"{origin.stamp} by Numba")  # what judges the other never takes its place in the cache
            return
        attach(dispatcher, origin.stamp)
        if type(dispatcher) is CPUDispatcher and not unusable():
            # An object of its own would take as long to make as all else that loading does with a function.
            dispatcher.__class__ = cls
            dispatcher._origin, dispatcher._keys, dispatcher._foreign = origin, {}, set()
            dispatcher._together = compiler() != "libm"

    def compile(self, sig: Any) -> Any:
        """Compile a signature, or load it from the cache."""
        if self._origin is not None:
            with global_compiler_lock:
                self._compile_directly(sig)
        return super().compile(sig)

    def is_direct(self, kinds: tuple[Kind, ...]) -> bool:
        """Compile, or load from the cache; return whether the machine code comes from the source."""
        arguments = arguments_of(kinds)
        self.compile(arguments)
        return isinstance(self.overloads[arguments].library, Library)

    def read(self, kinds: tuple[Kind, ...]) -> Function:
        """Return the function in the language of `symgen.native`.

        Raises
        ------
        Foreign
            If it is not in the language.
        """
        from symgen.native.read import read

        with _uncollected():
            return read(self, kinds, _definition)

    def symbol(self, kinds: tuple[Kind, ...]) -> str:
        """Return the name in machine code, which holds a digest of all that the machine code depends on."""
        name = f"{self.__name__}_{digest(self._key(kinds))[:32]}"
        return f"_ZN6symgen{len(name)}{name}E"  # as of a function in a namespace

    def _key(self, kinds: tuple[Kind, ...]) -> str:
        """Return all that the machine code depends on."""
        if kinds not in self._keys:
            self._keys[kinds] = self._made_key(kinds)
        return self._keys[kinds]

    def _made_key(self, kinds: tuple[Kind, ...]) -> str:
        assert self._origin is not None, "a function of an emitted module"
        parts = (self.__name__, self._origin.stamp, repr(kinds), processor(), environment())
        sines = () if self._together else ("sines one by one",)
        return "\n".join(("from the source", *parts, *sines, sources_digest("native")))

    def _compile_directly(self, sig: Any) -> None:
        """Enter a result for a signature, if the function is in the language."""
        arguments = tuple(sigutils.normalize_signature(sig)[0])
        kinds = kinds_of(arguments)
        if kinds is None or arguments in self.overloads or kinds in self._foreign:
            return
        location = cache_location()
        name = f"{self.__name__}-{digest(self._key(kinds))[:32]}{private.SUFFIX}"
        path = location.path / NATIVE / plain_name(self.__module__, 100) / name
        entry = self._kept(path, kinds) if location.persistent else None
        if entry is None and isinstance(self._cache, MachineCode) and self._cache.has(sig, self.targetctx):
            self._foreign.add(kinds)  # as it turned out to be in another process
            return
        if entry is None:
            details = {"dispatcher": self, "args": arguments, "return_type": None}
            with event.trigger_event("numba:compile", data=details):
                entry = self._made(kinds)
                if entry is not None and location.persistent:
                    private.write(path, self._key(kinds), marshal.dumps(tuple(entry)))
        if entry is None:
            self._foreign.add(kinds)
            counters["foreign"] += 1
        else:
            self.add_overload(self._result(arguments, kinds, entry))

    def _kept(self, path: Path, kinds: tuple[Kind, ...]) -> _Entry | None:
        """Return what the cache holds, with everything in memory that it calls."""
        with Loading() as clock:
            data = private.read(path, self._key(kinds))
            if data is None:
                return None
            entry = _Entry(*marshal.loads(data))
            if not all(self.py_func.__globals__[name].is_direct(called) for name, called in entry.called):
                return None
            clock.loaded = True
            counters["hits"] += 1
            return entry

    def _made(self, kinds: tuple[Kind, ...]) -> _Entry | None:
        """Return machine code made from the source, with everything in memory that it calls; None if it is foreign."""
        from symgen.native import internals
        from symgen.native.llvm import is_copied, module
        from symgen.native.read import Foreign

        if not internals.usable():
            return self._leave("Numba is not as expected, or asked to check or to debug")
        try:
            function = self.read(kinds)
        except Foreign as foreign:
            return self._leave(str(foreign))
        apart = [f for f in function.called if not is_copied(f)]
        for f in apart:
            if not _dispatcher(f).is_direct(kinds_of_function(f)):
                return self._leave(f"it calls '{f.name}', which is")
        names = {id(value): name for name, value in self.py_func.__globals__.items()}
        called = tuple((names[id(f.source)], kinds_of_function(f)) for f in apart)
        try:
            with _uncollected():
                code = compiled(module(function, _symbol, _is_short, self._together), _symbol(function))
        except RuntimeError as error:  # an LLVM that does not know the language any more
            return self._leave(str(error))
        counters["misses"] += 1
        counters["translated"] += 1
        return _Entry(function.returned, called, code)

    def _leave(self, why: str) -> _Entry | None:
        """Say, if that is wanted, why the function is left to Numba."""
        explain(f"{self.__module__}.{self.__name__}", why)
        return None

    def _result(self, arguments: tuple[Any, ...], kinds: tuple[Kind, ...], entry: _Entry) -> Any:
        """Put machine code into memory."""
        symbol = self.symbol(kinds)
        codes = [argument._code for argument in arguments]
        library = Library(load(entry.code, (symbol, f"cfunc.{symbol}")), lambda: self._linkable(kinds))
        return result(self.py_func, arguments, entry.returned, symbol, library, lambda f: self._insert(codes, f, False))

    def _linkable(self, kinds: tuple[Kind, ...]) -> str:
        """Return the text of a module that holds the function and all it calls."""
        from symgen.native.llvm import module

        return module(self.read(kinds), _symbol, lambda called: True, self._together, alone=True)


def plain(function: Any) -> Any:
    """Compile a function of symgen's own like emitted ones: on numbers and flat arrays whose types are plain to see.

    Parameters
    ----------
    function : plain function
        In the language of `symgen.native`, decorated by nothing else, its definition on one line; functions that it
        calls are of the same kind, in the same module.

    Returns
    -------
    EmittedFunction
        The plain function where nothing is compiled.
    """
    path = Path(function.__code__.co_filename)
    made = njit(error_model="numpy", fastmath={"contract"})(function)
    with contextlib.suppress(
        OSError, NotDescribable
    ):  # a program without sources: Numba's to compile, from the bytes of its code
        EmittedFunction.of(made, Origin(source_stamp(function), _content(path)))
    return made


@functools.lru_cache(maxsize=4)
def _content(path: Path) -> bytes:
    """Return what a file holds."""
    return path.read_bytes()


def compiler() -> str:
    """Return the compiler that the environment names."""
    name = os.environ.get(COMPILER) or _COMPILERS[0]
    if name not in _COMPILERS:
        raise InputError(COMPILER, "one of " + ", ".join(_COMPILERS), f"'{name}'", nearest(name, _COMPILERS))
    return name


def explain(name: str, why: str) -> None:
    """Say, if the environment asks for it, why a function is left to Numba."""
    if compiler() == "explain":
        print(f"{name} is left to Numba: {why}", file=sys.stderr)


@contextlib.contextmanager
def _uncollected() -> Iterator[None]:
    """Look for no garbage where many objects are made, of which none is garbage."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


def _dispatcher(function: Function) -> EmittedFunction:
    assert isinstance(function.source, EmittedFunction), "functions are read from dispatchers of this kind"
    return function.source


def _symbol(function: Function) -> str:
    return _dispatcher(function).symbol(kinds_of_function(function))


def _is_short(function: Function) -> bool:
    # of looped code there is machine code already: loops and starts call its functions
    return len(function.body) <= _SHORT and not any(p.sized for p in function.parameters)


def _definition(function: Any) -> ast.FunctionDef | None:
    """Return the syntax tree of an emitted function, None where its source cannot be had."""
    if (
        not isinstance(function, EmittedFunction)
        or function._origin is None
        or function.targetoptions not in (_OPTIONS, _INLINED)
    ):
        return None
    return syntax_tree(_lines(function._origin.content), function.py_func)


def syntax_tree(lines: Sequence[str], function: Any) -> ast.FunctionDef | None:
    """Return the syntax tree of a function that begins at a line's first column, None where there is none.

    Parameters
    ----------
    lines : sequence of str
        Of its file.
    function : function
        As it was loaded from there.
    """
    first = function.__code__.co_firstlineno - 1  # of its decorators, if there are some
    begin = next((i for i in range(first, len(lines)) if lines[i].startswith("def ")), len(lines))
    rest = range(begin + 1, len(lines))
    end = next((i for i in rest if lines[i][:1].strip() and not lines[i].startswith(")")), len(lines))
    try:
        found = ast.parse("\n".join(lines[first:end])).body
    except SyntaxError:
        return None
    return found[0] if len(found) == 1 and isinstance(found[0], ast.FunctionDef) else None


@functools.lru_cache(maxsize=4)
def _lines(content: bytes) -> tuple[str, ...]:
    """Return the lines of a file."""
    return tuple(content.decode().split("\n"))
