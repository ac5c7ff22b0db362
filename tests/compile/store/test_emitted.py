"""Functions of emitted modules: compiled from their text, kept in the cache, and called."""

import threading
from pathlib import Path

import llvmlite
import numpy as np
import pytest

from symgen.base.errors import InputError
from symgen.compile.native.types import float64, int64
from symgen.compile.store import emitted, jit
from symgen.compile.store.loaded_modules import load_module
from symgen.compile.store.stats import cache_stats
from symgen.run.layout.kernel_addresses import address

from .conftest import LAW, MODEL, NJIT, RUN

ARRAY = float64[::1]
SIGNATURE = int64(float64, ARRAY, ARRAY, ARRAY, int64[::1], ARRAY)
KINDS = SIGNATURE.arguments


def entries(cache: Path, name: str) -> list[Path]:
    return sorted((cache / "native").rglob(f"{name}-*.bin"))


def counts(found: dict) -> list[int]:
    return [found[key] for key in ("hits", "misses")]


def state() -> list:
    return [0.0, np.array([1.0, 0.5]), np.array([9.81]), np.zeros(4), np.zeros(2, np.int64), np.zeros(2)]


def right(values: list, function) -> bool:
    expected = state()
    function.py_func(*expected)
    return all(np.allclose(a, b, rtol=1e-14) for a, b in zip(values, expected, strict=True))


class TestKey:
    def test_an_edited_translator_makes_everything_anew(self, law, monkeypatch):
        function = load_module(law).rhs
        before = function.symbol(KINDS)
        monkeypatch.setattr(jit, "reached_digest", lambda *roots: "another")
        assert function.symbol(KINDS) != before

    @pytest.mark.slow
    def test_another_processor_has_code_of_its_own(self, law, python):
        names = dict.fromkeys(("generic", llvmlite.binding.get_host_cpu_name()))
        found = [python(RUN, law, NUMBA_CPU_NAME=name) for name in names]
        assert [counts(each) for each in found] == [[0, 4]] * len(found)
        for other in found[1:]:
            np.testing.assert_allclose(other["y"], found[0]["y"], rtol=1e-12)

    def test_another_version_has_code_of_its_own(self, law, monkeypatch):
        function = load_module(law).rhs
        before = function.symbol(KINDS)
        jit._digest_of_environment.cache_clear()
        monkeypatch.setattr(llvmlite, "__version__", "0.1")
        try:
            assert function.symbol(KINDS) != before
        finally:
            jit._digest_of_environment.cache_clear()

    def test_sines_of_the_library_have_code_of_their_own(self, law, monkeypatch):
        function = load_module(law).rhs
        before = function.symbol(KINDS)
        monkeypatch.setenv("SYMGEN_COMPILER", "explain")
        assert function.symbol(KINDS) == before
        monkeypatch.setenv("SYMGEN_COMPILER", "libm")
        assert function.symbol(KINDS) != before


class TestParts:
    """Laws whose functions stand in modules of their own, import each other by other names, and are handed on."""

    @pytest.fixture
    def parts(self, law) -> Path:
        folder = law.parent
        head = "import math\nfrom numba import njit\n"
        (folder / "rhs_0a.py").write_text(LAW)
        closed = (
            f"\n{NJIT}def rhs(t, y, p, w, iw, ydot):\n    y[0] += 0.5\n    return accelerate(t, y, p, w, iw, ydot)\n"
        )
        (folder / "rhs_closed_0b.py").write_text(f"{head}from .rhs_0a import rhs as accelerate\n{closed}")
        handed = 'from .model import geometry\nfrom .rhs_closed_0b import rhs\n\n__all__ = ["geometry", "rhs"]\n'
        law.write_text(handed)
        (folder / "other.py").write_text("from .rhs_0a import rhs\n")
        return law

    def test_each_is_compiled_once_and_found_again(self, parts, cache, python):
        first = python(RUN, parts)
        assert counts(first) == [0, 5]
        assert [len(entries(cache, n)) for n in ("rhs", "geometry", "table")] == [2, 1, 1]
        assert counts(python(RUN, parts)) == [5, 0]
        other = python(RUN, parts.with_name("other.py"))  # another law with one of these parts
        assert counts(other) == [4, 0] and other["y"] != first["y"]

    def test_a_changed_part_is_made_anew_with_those_that_call_it(self, parts, python):
        python(RUN, parts)
        part = parts.with_name("rhs_0a.py")
        part.write_text(part.read_text().replace("-p[0]", "+p[0]"))
        assert counts(python(RUN, parts)) == [3, 2]

    def test_they_compute_what_python_computes(self, parts):
        module = load_module(parts)
        values, plain = state(), state()
        module.rhs(*values)
        plain[1][0] += 0.5
        module.rhs.py_func.__globals__["accelerate"].py_func(*plain)
        assert all(np.allclose(a, b, rtol=1e-14) for a, b in zip(values, plain, strict=True))
        assert load_module(parts.with_name("other.py")).rhs is module.rhs.py_func.__globals__["accelerate"]

    def test_a_long_function_is_found_where_it_is_called(self, law, cache, python):
        """Too long to be copied into `rhs`: its machine code is in memory before, made anew or not."""
        lines = "".join(f"    w[{i % 3 + 1}] += math.sin(y[{i % 2}] + w[{i % 3}])\n" for i in range(100))
        law.with_name("model.py").write_text(MODEL.replace("    return 0\n", f"{lines}    return 0\n"))
        first = python(RUN, law)
        for entry in entries(cache, "geometry"):
            entry.unlink()
        second = python(RUN, law)
        assert (counts(second), second["y"]) == ([3, 1], first["y"])


class TestSetting:
    def test_what_is_compiled_is_explained_once(self, law, monkeypatch, capsys):
        monkeypatch.setenv("SYMGEN_COMPILER", "explain")
        module = load_module(law)
        module.rhs(*state())
        lines = capsys.readouterr().err.splitlines()
        assert [line.partition(" compiled in ")[0].rpartition(".")[2] for line in lines] == ["table", "geometry", "rhs"]
        assert all(line.startswith("symgen_generated.") and line.endswith(" s") for line in lines)
        emitted.EmittedFunction.__call__(again(module.rhs), *state())
        assert capsys.readouterr().err == "", "it was in the cache"

    def test_another_word_is_an_error(self, law, monkeypatch):
        monkeypatch.setenv("SYMGEN_COMPILER", "gcc")
        with pytest.raises(InputError, match=r"SYMGEN_COMPILER.*one of source, explain, libm, numba.*'gcc'"):
            load_module(law).rhs(*state())


def again(function):
    """Return an emitted function that was not called yet."""
    other = emitted.EmittedFunction(function.py_func)
    other.origin = function.origin
    return other


class TestLanguage:
    def test_a_function_outside_is_an_error(self, law):
        law.write_text(LAW.replace("    return 0\n", "    for x in y:\n        ydot[1] += x\n    return 0\n"))
        with pytest.raises(InputError) as refusal:
            load_module(law).rhs(*state())
        assert str(refusal.value) == (
            "the function 'symgen_generated.four-bar_0123456789abcdef_1.lagrange.rhs': expected the language of "
            "compiled functions, got a loop over something else than a range (line 7)"
        )

    def test_an_error_of_the_compiler_is_an_error(self, law, monkeypatch):
        monkeypatch.setattr("symgen.compile.native.llvm.llvm_module", lambda *_: "define nonsense")
        with pytest.raises(RuntimeError, match="LLVM IR parsing error"):
            load_module(law).rhs(*state())

    @pytest.mark.parametrize("change", ["edited", "gone", "no longer Python"])
    def test_a_source_that_changed_since_it_was_loaded_is_read_as_it_was(self, law, change):
        module, values = load_module(law), state()
        if change == "gone":
            law.unlink()
        else:
            law.write_text(LAW.replace("-p[0]", "+p[0]") if change == "edited" else "def rhs(")
        emitted._read_lines.cache_clear()
        module.rhs(*values)
        assert right(values, module.rhs)


class TestCalls:
    def test_from_python(self, law):
        module = load_module(law)
        for _ in range(3):
            values = state()
            assert module.rhs(*values) == 0 and right(values, module.rhs)
        assert load_module(law.with_name("model.py")).table(3.0) == 2.0
        for arguments in ((0.0, None, *values[2:]), (0.0, np.zeros(4)[::2], *values[2:]), (0.0,)):
            with pytest.raises(TypeError):
                module.rhs.caller(KINDS)(*arguments)

    def test_by_address(self, law):
        module = load_module(law)
        found = address(module.rhs, module, SIGNATURE)
        assert found == address(module.rhs, module, SIGNATURE) > 0

    def test_first_calls_from_several_threads(self, law):
        module, before, results = load_module(law), cache_stats(), list[bool]()

        def work() -> None:
            values = state()
            module.rhs(*values)
            results.append(right(values, module.rhs))

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert results == [True] * 4 and cache_stats()["misses"] - before["misses"] == 3
