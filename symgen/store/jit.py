"""Numba functions whose machine code outlives the process, in a cache that a crash or a stranger cannot spoil.

Numba's own disk cache keeps an index of pickles beside the source: a truncated index raises at import, a foreign one
runs code, an unwritable folder raises at decoration, and two processes can cross each other's entries. This one keeps
one self-checking file per compiled signature in the user's cache folder (see `symgen.store.private`). The key holds
everything that the machine code depends on: the sources, the code and what it closes over, signature, options,
processor, and the versions of Python, NumPy, llvmlite and Numba. Whatever is odd is a miss.

It stands on internals of Numba, which `internals_changed` lists and `tests/store/test_canary.py` watches.
"""

from __future__ import annotations

import functools
import inspect
import pickle
import re
import sys
import threading
import time
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar, TypeVar

import llvmlite
import numba
import numpy
from numba.core import config, event, sigutils
from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import CPUDispatcher
from numba.core.runtime import rtsys
from numba.core.serialize import dumps

from symgen.store import ahead, private
from symgen.store.identity import NotDescribable, describe, describe_function, digest, source_stamp, type_text
from symgen.store.paths import cache_location
from symgen.store.stats import cache_stats, counters
from symgen.store.upkeep import NATIVE

__all__ = ["attach", "cache_stats", "internals_changed", "jit"]


_FORMAT = "2"
# Settings of Numba that change the machine code although the source stays the same.
_SETTINGS = ("OPT", "BOUNDSCHECK", "DEBUGINFO_DEFAULT", "LOOP_VECTORIZE", "SLP_VECTORIZE", "DISABLE_INTEL_SVML")
_DEFAULTS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": {"contract"}}

_Function = TypeVar("_Function", bound=Callable[..., Any])


def jit(*signatures: Any, **options: Any) -> Callable[[_Function], _Function]:
    """Compile a function with Numba when it is first called, through the cache.

    With signatures, exactly these are compiled, all at the first call, and any other arguments are a TypeError; this is
    what a loop with first-class functions needs (a parameter of type ``FunctionType`` takes any compiled function of
    its signature). Without, each new combination of argument types is compiled when it occurs. Importing a module
    compiles nothing in either case.

    Parameters
    ----------
    *signatures : Signature or str
        As for `numba.njit`; none for compilation by the types of the arguments.
    **options : Any
        As for `numba.njit`; by default ``nogil=True, error_model="numpy", fastmath={"contract"}``, where contraction
        to fused multiply-add is the only liberty taken with floating-point arithmetic.

    Returns
    -------
    Callable
        A decorator; it returns a Numba dispatcher, or the plain function under ``NUMBA_DISABLE_JIT=1``.

    Examples
    --------
    >>> from symgen.store.jit import jit
    >>> @jit("float64(float64)")
    ... def double(x):
    ...     return 2.0 * x
    >>> double(2)
    4.0
    """

    def decorate(function: _Function) -> _Function:
        compiled: _Function = _decorate(function, signatures, options)
        return compiled

    return decorate


def attach(dispatcher: Any, stamp: str | None = None) -> None:
    """Give a Numba function the crash-safe cache; must happen before it is first compiled.

    Parameters
    ----------
    dispatcher : Dispatcher
        Made by ``numba.njit`` without ``cache=True``. Anything else, such as a plain function under
        ``NUMBA_DISABLE_JIT=1``, is left alone.
    stamp : str, optional
        Digest of all sources the function depends on; by default that of symgen's runtime and of the function's file.
    """
    if not isinstance(dispatcher, CPUDispatcher) or unusable():
        return
    function = dispatcher.py_func
    try:
        stamp = stamp or source_stamp(function)
        identity = digest(stamp, describe_function(function), describe(dict(dispatcher.targetoptions)))
    except (NotDescribable, OSError, ValueError):  # an empty closure cell is a ValueError
        return
    _name(function, identity)
    _listen()
    dispatcher._cache = MachineCode(function, stamp, identity)


def internals_changed() -> list[str]:
    """Return a sentence for each internal of Numba that is not as this module needs it; empty if all is well."""
    problems = []
    for owner, name, parameters in _INTERNALS:
        found = getattr(owner, name, None)
        if found is None:
            problems.append(f"{owner.__name__} has no '{name}' any more")
        elif parameters is not None and list(inspect.signature(found).parameters) != parameters:
            problems.append(
                f"{owner.__name__}.{name} should take ({', '.join(parameters)}), but takes {inspect.signature(found)}"
            )
    abstract: frozenset[str] = getattr(_Cache, "__abstractmethods__", frozenset())
    if abstract != (wanted := {"cache_path", "load_overload", "save_overload", "enable", "disable", "flush"}):
        problems.append(f"numba's _Cache should ask for {sorted(wanted)}, but asks for {sorted(abstract)}")
    return problems


# What is used of Numba beyond its documented interface: owner, name, parameters (None: only its presence matters).
_INTERNALS: tuple[tuple[Any, str, list[str] | None], ...] = (
    (CompileResult, "_reduce", ["self"]),
    (
        CompileResult,
        "_rebuild",
        [
            *("target_context", "libdata", "fndesc", "env", "signature", "objectmode"),
            *("lifted", "typeann", "reload_init", "referenced_envs"),
        ],
    ),
    (CompileResult, "codegen", None),
    (CPUDispatcher, "compile", ["self", "sig"]),
    (CPUDispatcher, "add_overload", ["self", "cres"]),
    (CPUDispatcher, "get_call_template", ["self", "args", "kws"]),
    (CPUDispatcher, "get_compile_result", ["self", "sig"]),
    (CPUDispatcher, "_search_new_conversions", ["self", "args", "kws"]),
    (CPUDispatcher, "_can_compile", None),
    (sigutils, "normalize_signature", ["sig"]),
    (event, "register", ["kind", "listener"]),
    (type(rtsys), "initialize", ["self", "ctx"]),
)


@functools.cache
def unusable() -> bool:
    """Without the internals everything still works, only uncached."""
    return bool(internals_changed())


def _decorate(function: Any, signatures: tuple[Any, ...], options: dict[str, Any]) -> Any:
    eager = numba.njit(**{**_DEFAULTS, **options})(function)
    if not isinstance(eager, CPUDispatcher):  # NUMBA_DISABLE_JIT=1
        return eager
    attach(eager)
    return LazySignatures.of(eager, signatures) if signatures else eager


class LazySignatures(CPUDispatcher):  # type: ignore[misc]  # Numba has no types
    """A dispatcher for given signatures only, which are compiled when it is first called or asked for them.

    The compiled code is made by an ordinary dispatcher and then entered here. Compilation stays switched off in this
    one all the time, so that a call from another thread meanwhile cannot compile for the types of its arguments.
    """

    _eager: Any
    _signatures: tuple[Any, ...]
    _ready: bool
    _busy: bool

    @classmethod
    def of(cls, eager: Any, signatures: tuple[Any, ...]) -> LazySignatures:
        self = cls(eager.py_func, targetoptions=eager.targetoptions)
        self._eager, self._signatures, self._ready, self._busy = eager, signatures, False, False
        self._can_compile = False
        return self

    def wanting(self) -> bool:
        """Whether signatures are neither compiled nor in the cache."""
        cache = self._eager._cache
        return not self._ready and not all(
            isinstance(cache, MachineCode) and cache.has(signature, self.targetctx) for signature in self._signatures
        )

    def is_quick(self) -> bool:
        """Whether signatures are compiled so fast that nobody needs to begin with it beforehand."""
        quick = getattr(self._eager._cache, "is_quick", None)
        return quick is not None and all(quick(signature) for signature in self._signatures)

    def open(self) -> bool:
        """Compile or load the signatures if that has not happened; True if a failed look-up is worth repeating."""
        if self._ready:
            return False
        waited = ahead.finish(self)
        if not _Compiling.depth():
            counters["compile_seconds"] += waited
        with global_compiler_lock:
            if self._ready or self._busy:  # another thread was faster, or the function calls itself
                return self._ready
            self._busy = True
            try:
                for signature in self._signatures:
                    self._eager.compile(signature)
                for result in self._eager.overloads.values():
                    self.add_overload(result)
                self._ready = True
            finally:
                self._busy = False
        return True

    # The C part asks this when no compiled signature fits and compilation is off: the first call always ends here.
    def _search_new_conversions(self, *args: Any, **kws: Any) -> bool:
        opened = self.open()
        return bool(super()._search_new_conversions(*args, **kws)) or opened

    def __reduce__(self) -> str:
        return str(self.__qualname__)  # pickled by name, as functions are: another process compiles or loads its own

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Answer the type inference of a caller that is being compiled."""
        self.open()
        return super().get_call_template(args, kws)

    def get_compile_result(self, sig: Any) -> Any:
        """Answer a ``FunctionType`` parameter that is given this function."""
        self.open()
        return super().get_compile_result(sig)


class MachineCode(_Cache):  # type: ignore[misc]  # Numba has no types
    """The cache of one function, as Numba's dispatcher asks for it."""

    def __init__(self, function: Any, stamp: str, identity: str) -> None:
        self.stamp = stamp
        self._name = f"{function.__module__}.{function.__qualname__}"
        self._identity = identity
        self._folder = plain_name(function.__module__, 100)
        self._stem = plain_name(function.__qualname__, 60)
        self._enabled = True

    @property
    def cache_path(self) -> str:
        """The folder of the function's entries."""
        return str(cache_location().path / NATIVE / self._folder)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return the compiled signature from the cache, or None."""
        started = time.perf_counter()
        result = self._load(sig, target_context) if self._enabled else None
        if result is None:
            target_context.refresh()
        counters["misses" if result is None else "hits"] += 1
        if not _Compiling.depth():
            counters["compile_seconds" if result is None else "load_seconds"] += time.perf_counter() - started
        return result

    def save_overload(self, sig: Any, data: Any) -> None:
        """Put a compiled signature into the cache if that is possible."""
        started = time.perf_counter()
        if self._enabled and cache_location().persistent:
            self._save(sig, data)
        if not _Compiling.depth():
            counters["compile_seconds"] += time.perf_counter() - started

    def enable(self) -> None:
        """Use the cache."""
        self._enabled = True

    def disable(self) -> None:
        """Neither read nor write."""
        self._enabled = False

    def flush(self) -> None:
        """Forget all compiled signatures of the function."""
        for path in Path(self.cache_path).glob(f"{self._stem}-*{private.SUFFIX}"):
            private.remove(path)

    def has(self, sig: Any, target_context: Any) -> bool:
        """Whether there is an entry for a signature, be it one that turns out to be spoilt."""
        try:
            return self._place(sig, target_context.codegen())[1].exists()
        except NotDescribable:
            return False

    def _load(self, sig: Any, target_context: Any) -> Any:
        try:
            key, path = self._place(sig, target_context.codegen())
        except NotDescribable:
            return None
        data = private.read(path, key)
        if data is None:
            return None
        try:
            # All that loaded code needs. `target_context.refresh()`, as Numba would call, loads the whole compiler as
            # well: 150 ms that a run from a full cache need not pay.
            rtsys.initialize(target_context)
            result = CompileResult._rebuild(target_context, *pickle.loads(data))
            # Running code with arguments of another layout would be fatal: check although the key says it.
            if tuple(result.signature.args) == tuple(sigutils.normalize_signature(sig)[0]):
                return result
        except Exception:  # whatever an entry from another world may raise
            pass
        private.remove(path)
        return None

    def _save(self, sig: Any, result: Any) -> None:
        if result.library.has_dynamic_globals or any(not lifted.can_cache for lifted in result.lifted):
            return  # it holds addresses of this process
        try:
            key, path = self._place(sig, result.codegen)
            data = dumps(result._reduce())
        except Exception:  # what cannot be written down stays uncached
            return
        private.write(path, key, data)

    def _place(self, sig: Any, codegen: Any, *made: str) -> tuple[str, Path]:
        """Return key and place of machine code; `made` is what else it depends on where it is not Numba's."""
        arguments, returned = sigutils.normalize_signature(sig)
        signature = ", ".join(type_text(argument) for argument in arguments) + f" -> {type_text(returned)}"
        key = "\n".join((*made, self._name, self._identity, signature, repr(codegen.magic_tuple()), environment()))
        return key, Path(self.cache_path) / f"{self._stem}-{digest(key)[:32]}{private.SUFFIX}"


class _Compiling(event.Listener):  # type: ignore[misc]  # Numba has no types
    """Adds up the time of outermost compilations of functions with our cache, failed ones included."""

    _here: ClassVar[threading.local] = threading.local()

    @classmethod
    def depth(cls) -> int:
        """Return how many compilations are under way in this thread."""
        return getattr(cls._here, "depth", 0)

    def on_start(self, event: Any) -> None:
        """Note the time if nothing was being compiled."""
        if not self.depth():
            self._here.started = time.perf_counter()
        self._here.depth = self.depth() + 1

    def on_end(self, event: Any) -> None:
        """Add the time if nothing is being compiled any more."""
        self._here.depth = self.depth() - 1
        if not self.depth() and isinstance(getattr(event.data["dispatcher"], "_cache", None), MachineCode):
            counters["compile_seconds"] += time.perf_counter() - self._here.started


class Loading:
    """Adds the time of what is done inside to `load_seconds`, unless something around it is timed already.

    Attributes
    ----------
    loaded : bool
        Set inside; time that nothing was loaded in does not count.
    """

    loaded = False

    def __enter__(self) -> Loading:
        self._started = time.perf_counter()
        _Compiling._here.depth = _Compiling.depth() + 1
        return self

    def __exit__(self, *error: object) -> None:
        _Compiling._here.depth = _Compiling.depth() - 1
        if self.loaded and not _Compiling.depth():
            counters["load_seconds"] += time.perf_counter() - self._started


@functools.cache
def _listen() -> None:
    event.register("numba:compile", _Compiling())


@functools.cache
def environment() -> str:
    """Everything outside the function that the machine code depends on, apart from the processor."""
    settings = [f"{name}={getattr(config, name, None)}" for name in _SETTINGS]
    versions = (sys.version, numba.__version__, llvmlite.__version__, numpy.__version__)
    return "\n".join((_FORMAT, *versions, *settings))


_identities: dict[tuple[str, str], str] = {}


def _name(function: types.FunctionType, identity: str) -> None:
    """See to it that one name stands for one function in this process.

    Symbols are named after module, qualified name, argument types and a counter that starts anew in each process. Two
    functions of the same name, made by a factory for instance, could be cached by two processes under the same symbol,
    and a third process might then run one for the other (`test_factory_functions_are_kept_apart`).
    """
    key = (function.__module__, function.__qualname__)
    if function.__closure__ or _identities.setdefault(key, identity) != identity:
        function.__qualname__ += f".{identity[:16]}"


def plain_name(name: str, length: int) -> str:
    """Return the end of a name with characters that file systems know."""
    return re.sub(r"[^\w.-]", "_", name)[-length:]
