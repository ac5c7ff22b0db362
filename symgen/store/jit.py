"""Numba functions whose machine code outlives the process, in a cache that a crash or a stranger cannot spoil.

Numba's own disk cache keeps an index of pickles beside the source: a truncated index raises at import, a foreign one
runs code, an unwritable folder raises at decoration, and two processes can cross each other's entries. This one keeps
one self-checking file per compiled signature in the user's cache folder (`symgen.store.machine_code`).

It stands on internals of Numba, which `internals_changed` lists and `tests/store/test_canary.py` watches.
"""

from __future__ import annotations

import functools
import inspect
import types
from collections.abc import Callable
from typing import Any, TypeVar

import numba
from numba.core import event, sigutils
from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import CPUDispatcher
from numba.core.runtime import rtsys

from symgen.store.identity import NotDescribable, describe, describe_function, digest, source_stamp
from symgen.store.machine_code import MachineCode, listen
from symgen.store.stats import cache_stats

__all__ = ["attach", "cache_stats", "internals_changed", "jit"]


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
        # a stamp that is given covers the function's text, so its place there says which one it is
        own = f"{function.__qualname__} {function.__code__.co_firstlineno}" if stamp else describe_function(function)
        stamp = stamp or source_stamp(function)
        identity = digest(stamp, own, describe(dict(dispatcher.targetoptions)))
    except (NotDescribable, OSError, ValueError):  # an empty closure cell is a ValueError
        return
    _name(function, identity)
    listen()
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

    def open(self) -> bool:
        """Compile or load the signatures if that has not happened; True if a failed look-up is worth repeating."""
        if self._ready:
            return False
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
