"""Fails with a clear sentence when a new version of Numba changed what `symgen.store.jit` stands on."""

from __future__ import annotations

import pickle

import numba
from numba.core.caching import _Cache
from numba.core.registry import CPUDispatcher

from symgen.store import jit


def test_the_internals_of_numba_are_as_expected():
    problems = jit.internals_changed()
    assert not problems, f"Numba {numba.__version__} changed; adapt symgen/store/jit.py: " + "; ".join(problems)


def test_a_dispatcher_asks_its_cache_before_compiling_and_tells_it_afterwards():
    calls = []

    class Spy(_Cache):
        cache_path = ""

        def load_overload(self, sig, target_context):
            calls.append(("load", sig))

        def save_overload(self, sig, data):
            calls.append(("save", sig))
            assert hasattr(data.library, "has_dynamic_globals"), "CodeLibrary.has_dynamic_globals is gone"
            assert isinstance(pickle.loads(pickle.dumps(data.codegen.magic_tuple())), tuple)

        def enable(self): ...
        def disable(self): ...
        def flush(self): ...

    @numba.njit
    def double(x):
        return 2 * x

    assert isinstance(double, CPUDispatcher), "numba.njit no longer makes a CPUDispatcher"
    double._cache = Spy()
    assert double(2) == 4
    assert calls == [("load", (numba.int64,)), ("save", (numba.int64,))], "Dispatcher.compile uses its cache otherwise"


def test_a_missing_internal_is_named_and_means_uncached(monkeypatch, cache):
    table = (*jit._INTERNALS, (CPUDispatcher, "gone", None), (CPUDispatcher, "compile", ["self", "types"]))
    monkeypatch.setattr(jit, "_INTERNALS", table)
    assert jit.internals_changed() == [
        "CPUDispatcher has no 'gone' any more",
        "CPUDispatcher.compile should take (self, types), but takes (self, sig)",
    ]
    monkeypatch.setattr(jit, "unusable", lambda: True)
    double = numba.njit(lambda x: 2 * x)
    jit.attach(double)
    assert double(2) == 4
    assert not (cache / "native").exists()
