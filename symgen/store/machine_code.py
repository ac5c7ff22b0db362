"""Machine code of one function in the cache, an entry a signature, as Numba's dispatcher asks for it; and what it took.

The key of an entry holds everything that the machine code depends on: the sources, the code and what it closes over,
signature, options, processor, and the versions of Python, NumPy, llvmlite and Numba. Whatever is odd is a miss.
"""

from __future__ import annotations

import functools
import pickle
import re
import sys
import threading
import time
from pathlib import Path
from typing import Any, ClassVar

import llvmlite
import numba
import numpy
from numba.core import config, event, sigutils
from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.runtime import rtsys
from numba.core.serialize import dumps

from symgen.store import private
from symgen.store.identity import NotDescribable, digest, type_text
from symgen.store.paths import cache_location
from symgen.store.stats import counters
from symgen.store.upkeep import NATIVE

_FORMAT = "2"
# Settings of Numba that change the machine code although the source stays the same.
_SETTINGS = ("OPT", "BOUNDSCHECK", "DEBUGINFO_DEFAULT", "LOOP_VECTORIZE", "SLP_VECTORIZE", "DISABLE_INTEL_SVML")


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
        if not Compiling.depth():
            counters["compile_seconds" if result is None else "load_seconds"] += time.perf_counter() - started
        return result

    def save_overload(self, sig: Any, data: Any) -> None:
        """Put a compiled signature into the cache if that is possible."""
        started = time.perf_counter()
        if self._enabled and cache_location().persistent:
            self._save(sig, data)
        if not Compiling.depth():
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


class Compiling(event.Listener):  # type: ignore[misc]  # Numba has no types
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
        Compiling._here.depth = Compiling.depth() + 1
        return self

    def __exit__(self, *error: object) -> None:
        Compiling._here.depth = Compiling.depth() - 1
        if self.loaded and not Compiling.depth():
            counters["load_seconds"] += time.perf_counter() - self._started


@functools.cache
def listen() -> None:
    """Have `Compiling` told of every compilation from now on."""
    event.register("numba:compile", Compiling())


@functools.cache
def environment() -> str:
    """Everything outside the function that the machine code depends on, apart from the processor."""
    settings = [f"{name}={getattr(config, name, None)}" for name in _SETTINGS]
    versions = (sys.version, numba.__version__, llvmlite.__version__, numpy.__version__)
    return "\n".join((_FORMAT, *versions, *settings))


def plain_name(name: str, length: int) -> str:
    """Return the end of a name with characters that file systems know."""
    return re.sub(r"[^\w.-]", "_", name)[-length:]
