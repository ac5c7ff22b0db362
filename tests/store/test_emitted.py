"""Functions of emitted modules: made from their source or compiled by Numba, kept in the cache, and called."""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
import threading
from pathlib import Path

import llvmlite.binding
import numba
import numpy as np
import pytest
from numba import types

from symgen.errors import InputError
from symgen.native import internals
from symgen.native.library import Library
from symgen.runtime.kernels import address
from symgen.store import emitted, machine_code
from symgen.store.modules import load_module
from symgen.store.stats import cache_stats

FOLDER = "four-bar_0123456789abcdef_1"
NJIT = '@njit(error_model="numpy", fastmath={"contract"})\n'
MODEL = f'''
import math
import numpy as np
from numba import njit

TABLE_X = np.array([0.0, 1.0, 2.0])

{NJIT}def table(x):
    """A table."""
    return 1.0 if x <= TABLE_X[1] else TABLE_X[2]


{NJIT}def geometry(t, y, w):
    """A sine."""
    w[0] = math.sin(y[0])*table(y[0])
    return 0
'''
LAW = f"""
import math
from numba import njit
from .model import geometry

{NJIT}def rhs(t, y, p, w, iw, ydot):
    geometry(t, y, w)
    ydot[0] = y[1]
    ydot[1] = -p[0] * w[0]
    iw[0] += 1
    return 0


{NJIT}def lengthy(t, y, p, w, iw, ydot):
    rhs(t, y, p, w, iw, ydot)
    total = 0.0
    for x in y:
        total += x
    ydot[1] += total
    return 0
"""
LOOPS = """\
from numba import types
from symgen.store.jit import jit

_A = types.float64[::1]
RHS = types.FunctionType(types.int64(types.float64, _A, _A, _A, types.int64[::1], _A))

@jit(types.int64(RHS, types.int64, types.float64, _A, _A, _A, types.int64[::1], _A))
def euler(rhs, steps, h, y, p, w, iw, ydot):
    for k in range(steps):
        rhs(k * h, y, p, w, iw, ydot)
        for i in range(y.shape[0]):
            y[i] += h * ydot[i]
    return 0
"""
RUN = """\
import json, sys
import numpy as np
from symgen.store.modules import load_module
from symgen.store.jit import cache_stats
import loops

law = load_module(sys.argv[1])
y, ydot = np.array([1.0, 0.0]), np.zeros(2)
function = getattr(law, sys.argv[2] if len(sys.argv) > 2 else "rhs")
loops.euler(function, 10, 0.01, y, np.array([9.81]), np.zeros(4), np.zeros(2, np.int64), ydot)
print(json.dumps({"y": y.tolist(), **cache_stats()}))
"""
ARRAY = types.float64[::1]
SIGNATURE = types.int64(types.float64, ARRAY, ARRAY, ARRAY, types.int64[::1], ARRAY)
KINDS = (("float", False), *(("float", True),) * 3, ("int", True), ("float", True))


@pytest.fixture
def law(tmp_path, cache) -> Path:
    """An emitted law beside its model, and a library `loops` on the path of `python`."""
    folder = tmp_path / "generated" / FOLDER
    folder.mkdir(parents=True)
    (folder / "model.py").write_text(MODEL)
    (folder / "law.py").write_text(LAW)
    (tmp_path / "library").mkdir()
    (tmp_path / "library" / "loops.py").write_text(LOOPS)
    yield folder / "law.py"
    for name in [name for name in sys.modules if name.startswith("symgen_generated")]:
        del sys.modules[name]


def entries(cache: Path, name: str) -> list[Path]:
    return sorted((cache / "native").rglob(f"{name}-*.bin"))


def counts(found: dict) -> list[int]:
    return [found[key] for key in ("hits", "misses", "translated", "foreign")]


def state() -> list:
    return [0.0, np.array([1.0, 0.5]), np.array([9.81]), np.zeros(4), np.zeros(2, np.int64), np.zeros(2)]


def expected(function) -> list:
    values = state()
    getattr(function, "py_func", function)(*values)
    return values


def right(values: list, function) -> bool:
    return all(np.allclose(a, b, rtol=1e-14) for a, b in zip(values, expected(function), strict=True))


class TestCache:
    def test_a_second_process_finds_everything(self, law, cache, python):
        first = python(RUN, law, PYTHONHASHSEED="1")
        assert counts(first) == [0, 4, 3, 0]  # euler; three from source
        assert [len(entries(cache, n)) for n in ("rhs", "geometry", "table", "euler")] == [1, 1, 1, 1]
        second = python(RUN, law, PYTHONHASHSEED="2")
        assert counts(second) == [4, 0, 0, 0]
        assert second["y"] == first["y"]
        assert second["load_seconds"] > 0 and second["compile_seconds"] == 0

    @pytest.mark.parametrize(
        "name", ["table", *(pytest.param(name, marks=pytest.mark.slow) for name in ("rhs", "geometry"))]
    )
    def test_whatever_is_odd_is_a_miss(self, law, cache, python, name, tmp_path):
        good = python(RUN, law)
        witness = tmp_path / "witness"

        class Harmful:
            def __reduce__(self):
                return Path.touch, (witness,)

        (entry,) = entries(cache, name)
        whole, other = entry.read_bytes(), next(iter(entries(cache, "euler"))).read_bytes()
        flipped = bytes([*whole[:-40], whole[-40] ^ 4, *whole[-39:]])
        for content in (whole[:-1], whole[:70], b"", flipped, other, pickle.dumps(Harmful())):
            entry.write_bytes(content)
            found = python(RUN, law)
            assert (found["hits"], found["translated"]) == (3, 1) and found["y"] == good["y"]
            assert entry.read_bytes() == whole, "written anew, and the same"
        entry.unlink()
        assert python(RUN, law)["translated"] == 1
        assert not witness.exists()

    def test_an_edited_function_and_all_that_call_it_are_made_anew(self, law, python):
        python(RUN, law)
        law.write_text(LAW.replace("-p[0]", "+p[0]"))
        edited = python(RUN, law)
        assert (edited["hits"], edited["translated"]) == (3, 1) and edited["y"][0] > 1
        law.with_name("model.py").write_text(MODEL.replace("sin", "cos"))
        edited = python(RUN, law)
        assert (edited["hits"], edited["translated"]) == (1, 3)

    def test_an_edited_translator_makes_everything_anew(self, law, cache, monkeypatch):
        function = load_module(law).rhs
        before = function.symbol(KINDS)
        function._keys.clear()
        monkeypatch.setattr(emitted, "sources_digest", lambda *folders: "another")
        assert function.symbol(KINDS) != before

    def test_another_processor_has_code_of_its_own(self, law, python):
        processors = dict.fromkeys(("generic", llvmlite.binding.get_host_cpu_name()))
        found = [python(RUN, law, NUMBA_CPU_NAME=name) for name in processors]
        assert [each["hits"] for each in found] == [0] * len(found)
        assert [each["translated"] for each in found] == [3] * len(found)
        for other in found[1:]:
            np.testing.assert_allclose(other["y"], found[0]["y"], rtol=1e-12)

    @pytest.mark.parametrize("package", [numba, llvmlite, np], ids=lambda package: package.__name__)
    def test_another_version_has_code_of_its_own(self, law, monkeypatch, package):
        function = load_module(law).rhs
        before = function.symbol(KINDS)
        function._keys.clear()
        machine_code.environment.cache_clear()
        assert function.symbol(KINDS) == before
        function._keys.clear()
        machine_code.environment.cache_clear()
        monkeypatch.setattr(package, "__version__", "0.1")
        try:
            assert function.symbol(KINDS) != before
        finally:
            machine_code.environment.cache_clear()

    def test_works_uncached_where_nothing_can_be_written(self, law, python, tmp_path):
        (tmp_path / "file").write_text("")
        found = python(RUN, law, SYMGEN_CACHE_DIR=str(tmp_path / "file" / "cache"))
        assert (found["hits"], found["translated"]) == (0, 3)

    def test_two_at_once_and_one_that_is_killed(self, law, python, tmp_path):
        path = os.pathsep.join([str(tmp_path / "library"), str(Path(__file__).parents[2])])
        environment = {**os.environ, "PYTHONPATH": path}
        command = [sys.executable, "-c", RUN, str(law)]
        running = [subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL) for _ in range(3)]
        running[0].kill()
        assert [process.wait() for process in running][1:] == [0, 0]
        assert python(RUN, law)["misses"] == 0


class TestParts:
    """Laws whose functions stand in modules of their own, import each other by other names, and are handed on."""

    @pytest.fixture
    def parts(self, law) -> Path:
        folder = law.parent
        head = "import math\nfrom numba import njit\n"
        (folder / "rhs_0a.py").write_text(LAW.partition(f"{NJIT}def lengthy")[0])
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
        assert counts(first) == [0, 5, 4, 0]
        assert [len(entries(cache, n)) for n in ("rhs", "geometry", "table")] == [2, 1, 1]
        assert counts(python(RUN, parts)) == [5, 0, 0, 0]
        other = python(RUN, parts.with_name("other.py"))  # another law with one of these parts
        assert counts(other) == [4, 0, 0, 0] and other["y"] != first["y"]

    def test_a_changed_part_is_made_anew_with_those_that_call_it(self, parts, python):
        python(RUN, parts)
        part = parts.with_name("rhs_0a.py")
        part.write_text(part.read_text().replace("-p[0]", "+p[0]"))
        assert counts(python(RUN, parts)) == [3, 2, 2, 0]

    def test_they_compute_what_python_computes(self, parts):
        module = load_module(parts)
        values, plain = state(), state()
        module.rhs(*values)
        plain[1][0] += 0.5
        module.rhs.py_func.__globals__["accelerate"].py_func(*plain)
        assert all(np.allclose(a, b, rtol=1e-14) for a, b in zip(values, plain, strict=True))
        assert load_module(parts.with_name("other.py")).rhs is module.rhs.py_func.__globals__["accelerate"]


class TestSetting:
    def test_numba_for_all_leaves_the_other_cache_alone(self, law, cache, python):
        first = python(RUN, law)
        kept = entries(cache, "rhs")
        plain = python(RUN, law, SYMGEN_COMPILER="numba")
        assert counts(plain) == [1, 3, 0, 0], "the loop was there, the functions were not"
        assert plain["y"] == first["y"]
        assert len(entries(cache, "rhs")) == 2 and set(kept) < set(entries(cache, "rhs"))
        assert counts(python(RUN, law, SYMGEN_COMPILER="numba"))[:2] == [2, 0]
        assert counts(python(RUN, law, SYMGEN_COMPILER="source")) == [4, 0, 0, 0]

    def test_what_is_left_to_numba_is_explained(self, law, monkeypatch, capsys):
        monkeypatch.setenv("SYMGEN_COMPILER", "explain")
        load_module(law).lengthy(*state())
        (line,) = capsys.readouterr().err.splitlines()
        assert line.endswith(".law.lengthy is left to Numba: a loop over something else than a range (line 5)")

    def test_an_error_of_the_compiler_leaves_the_function_to_numba(self, law, monkeypatch, capsys):
        def refuse(text: str, symbol: str) -> bytes:
            raise RuntimeError("LLVM IR parsing error")

        monkeypatch.setattr(emitted, "compiled", refuse)
        monkeypatch.setenv("SYMGEN_COMPILER", "explain")
        module, values = load_module(law), state()
        module.rhs(*values)
        assert right(values, module.rhs)
        first, *others = capsys.readouterr().err.splitlines()
        assert first.endswith("is left to Numba: LLVM IR parsing error") and len(others) == 2

    def test_another_word_is_an_error(self, law, monkeypatch):
        monkeypatch.setenv("SYMGEN_COMPILER", "gcc")
        with pytest.raises(InputError, match=r"SYMGEN_COMPILER.*one of source, explain, libm, numba.*'gcc'"):
            load_module(law)


class TestNumbaBeside:
    def test_a_function_out_of_the_language_is_compiled_by_numba_and_counted(self, law, cache, python):
        first = python(RUN, law, "lengthy")
        assert [first[k] for k in ("translated", "foreign")] == [3, 1]
        # what Numba compiled holds what it calls: nothing else is needed to run it again
        for name in ("rhs", "geometry", "table"):
            (entry,) = entries(cache, name)
            entry.unlink()
        second = python(RUN, law, "lengthy")
        assert (second["hits"], second["misses"]) == (2, 0)
        assert second["y"] == first["y"]
        values = state()
        module = load_module(law)
        module.lengthy(*values)
        assert right(values, module.lengthy)

    def test_what_numba_compiled_holds_long_functions_behind_those_it_calls(self, law, cache, python):
        """Too long to be copied into `rhs`, which `lengthy` calls: the symbol of nobody is the address 0."""
        model = law.parent / "model.py"
        lines = "".join(f"    w[{i % 3 + 1}] += math.sin(y[{i % 2}] + w[{i % 3}])\n" for i in range(100))
        model.write_text(MODEL.replace("    return 0\n", f"{lines}    return 0\n"))
        first = python(RUN, law, "lengthy")
        for name in ("rhs", "geometry", "table"):
            (entry,) = entries(cache, name)
            entry.unlink()
        second = python(RUN, law, "lengthy")
        assert (second["hits"], second["misses"], second["y"]) == (2, 0, first["y"])

    def test_other_options_and_other_types_are_left_to_numba(self, law, tmp_path):
        law.write_text(LAW.replace(NJIT, "@njit\n", 1))
        module = load_module(law)
        before = cache_stats()["foreign"]
        values = state()
        module.rhs(*values)
        assert right(values, module.rhs) and cache_stats()["foreign"] == before + 1
        strided = state()
        strided[1] = np.zeros(4)[::2]
        module.geometry(0.0, strided[1], strided[3])
        assert not any(
            isinstance(r.library, Library) for t, r in module.geometry.overloads.items() if "C)" not in str(t[1])
        )

    def test_where_numba_is_not_as_expected_it_compiles(self, law, monkeypatch):
        monkeypatch.setattr(internals, "usable", lambda: False)
        module, values = load_module(law), state()
        before = cache_stats()
        module.rhs(*values)
        after = cache_stats()
        assert right(values, module.rhs)
        assert after["translated"] == before["translated"] and after["foreign"] == before["foreign"] + 3

    @pytest.mark.parametrize("change", ["edited", "gone", "no longer Python"])
    def test_a_source_that_changed_since_it_was_loaded_is_read_as_it_was(self, law, change):
        """Numba fuses other operations, so numbers would depend on whether another process tidied the cache."""
        module, values = load_module(law), state()
        if change == "gone":
            law.unlink()
        else:
            law.write_text(LAW.replace("-p[0]", "+p[0]") if change == "edited" else "def rhs(")
        emitted._lines.cache_clear()
        module.rhs(*values)
        assert right(values, module.rhs)
        assert all(isinstance(result.library, Library) for result in module.rhs.overloads.values())

    @pytest.mark.slow
    def test_switches_of_numba(self, law, python):
        plain = python(RUN, law, NUMBA_DISABLE_JIT="1")
        assert counts(plain) == [0, 0, 0, 0]
        for name in ("NUMBA_BOUNDSCHECK", "NUMBA_DEBUGINFO"):
            found = python(RUN, law, **{name: "1"})
            assert (found["translated"], found["foreign"]) == (0, 3)
            np.testing.assert_allclose(found["y"], plain["y"], rtol=1e-12)


class TestCalls:
    def test_from_python(self, law):
        module = load_module(law)
        for _ in range(3):
            values = state()
            assert module.rhs(*values) == 0
            assert right(values, module.rhs)
        assert module.geometry._origin is not None and load_module(law.with_name("model.py")).table(3.0) == 2.0
        with pytest.raises(numba.TypingError):
            module.rhs(0.0, None, *values[2:])
        with pytest.raises(TypeError, match="not enough arguments"):
            module.rhs(0.0)

    def test_as_a_first_class_function_and_by_address(self, law):
        module = load_module(law)

        @numba.njit(types.int64(types.FunctionType(SIGNATURE), *SIGNATURE.args))
        def apply(function, t, y, p, w, iw, ydot):
            return function(t, y, p, w, iw, ydot)

        values = state()
        assert apply(module.rhs, *values) == 0 and right(values, module.rhs)
        assert isinstance(module.rhs.overloads[SIGNATURE.args].library, Library)
        assert address(module.rhs, module, SIGNATURE) == address(module.rhs, module, SIGNATURE) > 0
        assert numba.experimental.function_type._get_wrapper_address(module.rhs, SIGNATURE) > 0

    def test_from_compiled_code(self, law):
        module = load_module(law)

        @numba.njit
        def twice(t, y, p, w, iw, ydot):
            return module_rhs(t, y, p, w, iw, ydot) + module_rhs(t, y, p, w, iw, ydot)

        module_rhs = module.rhs
        values = state()
        assert twice(*values) == 0
        assert values[4][0] == 2 and np.allclose(values[5], expected(module.rhs)[5])

    def test_through_the_function_of_c(self, law):
        module = load_module(law)

        @numba.cfunc(SIGNATURE)
        def other(t, y, p, w, iw, ydot):
            return 7

        class Wrapper(types.WrapperAddressProtocol):
            def __wrapper_address__(self):
                return numba.experimental.function_type._get_wrapper_address(module.rhs, SIGNATURE)

            def signature(self):
                return SIGNATURE

        @numba.njit(types.int64(types.FunctionType(SIGNATURE), *SIGNATURE.args))
        def apply(function, t, y, p, w, iw, ydot):
            return function(t, y, p, w, iw, ydot)

        values = state()
        assert apply(other, *values) == 7
        assert apply(Wrapper(), *values) == 0 and right(values, module.rhs)

    def test_first_calls_from_several_threads(self, law):
        module = load_module(law)
        results = []

        def work() -> None:
            values = state()
            module.rhs(*values)
            results.append(right(values, module.rhs))

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert results == [True] * 4

    def test_a_function_that_travels_is_compiled_where_it_arrives(self, law):
        module, values = load_module(law), state()
        code = "import pickle, sys; print(pickle.loads(sys.stdin.buffer.read())(2.5))"
        lone = numba.njit(lambda x: 2.0 * x)
        lone.__class__ = emitted.EmittedFunction
        data = numba.core.serialize.dumps(lone)
        environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
        done = subprocess.run(
            [sys.executable, "-c", code], input=data, capture_output=True, check=True, env=environment
        )
        assert float(done.stdout) == 5.0
        module.rhs(*values)
        assert json.loads(json.dumps(values[5].tolist())) == expected(module.rhs)[5].tolist()
