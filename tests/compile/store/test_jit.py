import ctypes
import os
import pickle
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from symgen.base.errors import InputError
from symgen.compile.native.machine import load_machine_code
from symgen.compile.native.types import FunctionType, float64, int64
from symgen.compile.store import jit, private
from symgen.compile.store.stats import cache_stats

from .conftest import LAW, LOOPS, MODEL, RUN

#: What `RUN` compiles: of the loop `advance` is a part.
ALL = ["euler", "geometry", "rhs", "table"]


def compiled(cache: Path) -> list[str]:
    """Names of the functions in the cache."""
    return sorted(path.name.rpartition("-")[0] for path in (cache / "native").rglob("*.bin"))


def counts(found: dict) -> tuple[int, int]:
    return found["hits"], found["misses"]


class TestSecondProcess:
    @pytest.mark.slow
    def test_finds_everything_whatever_the_hash_seed(self, law, cache, python):
        first = python(RUN, law, PYTHONHASHSEED="1")
        assert counts(first) == (0, 4)
        assert first["compile_seconds"] > 0 and first["load_seconds"] == 0
        assert compiled(cache) == ALL
        second = python(RUN, law, PYTHONHASHSEED="2")
        assert counts(second) == (4, 0)
        assert second["load_seconds"] > 0 and second["compile_seconds"] == 0
        assert second["y"] == first["y"] and second["status"] == 0
        # Another folder with the same name and content, such as a checkout, has the same machine code.
        copy = law.parents[3] / "copy" / law.parent.name
        copy.mkdir(parents=True)
        for path in law.parent.iterdir():
            (copy / path.name).write_bytes(path.read_bytes())
        assert counts(python(RUN, copy / law.name)) == (4, 0)

    def test_compiles_again_what_was_edited_and_all_that_calls_it(self, law, python):
        python(RUN, law)
        # Same size and same time stamp: only the content tells.
        status = law.stat()
        law.write_text(LAW.replace("-p[0]", "+p[0]"))
        os.utime(law, ns=(status.st_atime_ns, status.st_mtime_ns))
        edited = python(RUN, law)
        assert counts(edited) == (3, 1) and edited["y"][0] > 1
        law.with_name("model.py").write_text(MODEL.replace("sin", "cos"))
        assert counts(python(RUN, law)) == (1, 3)

    @pytest.mark.parametrize(
        "name", ["table", *(pytest.param(name, marks=pytest.mark.slow) for name in ("rhs", "geometry", "euler"))]
    )
    def test_survives_every_kind_of_damage(self, law, cache, python, tmp_path, name):
        good = python(RUN, law)
        witness = tmp_path / "witness"

        class Harmful:
            def __reduce__(self):
                return Path.touch, (witness,)

        (entry,) = (cache / "native").rglob(f"{name}-*.bin")
        (other,) = (cache / "native").rglob(f"{'rhs' if name == 'euler' else 'euler'}-*.bin")
        code = next((cache / "bytecode").glob("lagrange-*.bin"))
        whole = entry.read_bytes()
        flipped = bytes([*whole[:-40], whole[-40] ^ 4, *whole[-39:]])
        for content in (whole[:-1], whole[:70], b"", flipped, other.read_bytes(), pickle.dumps(Harmful())):
            entry.write_bytes(content)
            code.write_bytes(code.read_bytes()[: len(content) % 97])
            found = python(RUN, law)
            assert counts(found) == (3, 1) and found["y"] == good["y"]
            assert entry.read_bytes() == whole, "written anew, and the same"
        entry.unlink()
        assert counts(python(RUN, law)) == (3, 1)
        assert not witness.exists() and python(RUN, law)["misses"] == 0

    def test_compiles_again_when_a_helper_in_another_file_was_edited(self, cache, python, tmp_path):
        library = tmp_path / "library"
        library.mkdir()
        (library / "inner.py").write_text(
            "from symgen.compile.store.jit import jit\n@jit()\ndef f(x):\n    return 2.0 * x\n"
        )
        (library / "middle.py").write_text("from inner import f\n")
        (library / "outer.py").write_text(
            "from symgen.compile.native.types import float64\nfrom symgen.compile.store.jit import jit\n"
            "from middle import f\n"
            "@jit(float64(float64))\ndef g(x):\n    return f(x)\n"
        )
        script = """
import json, outer
from symgen.compile.store.stats import cache_stats
print(json.dumps([outer.g(1.0), cache_stats()["misses"]]))
"""
        assert python(script) == [2.0, 1]
        assert python(script) == [2.0, 0]
        # of another length: Python takes its byte code for that of a file of this length and of this second
        (library / "inner.py").write_text((library / "inner.py").read_text().replace("2.0", "3.25"))
        assert python(script) == [3.25, 1]

    def test_works_uncached_where_nothing_can_be_written(self, generated, python, tmp_path):
        (tmp_path / "file").write_text("")
        found = python(RUN, generated / "lagrange.py", SYMGEN_CACHE_DIR=str(tmp_path / "file" / "cache"))
        assert (*counts(found), found["status"]) == (0, 4, 0)

    @pytest.mark.slow
    def test_two_at_once_and_one_that_is_killed(self, law, python, tmp_path):
        path = os.pathsep.join([str(tmp_path / "library"), str(Path(__file__).parents[3])])
        environment = {**os.environ, "PYTHONPATH": path}
        command = [sys.executable, "-c", RUN, str(law)]
        running = [subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL) for _ in range(3)]
        running[0].kill()
        assert [process.wait() for process in running][1:] == [0, 0]
        assert counts(python(RUN, law)) == (4, 0)

    def test_nothing_is_compiled_where_numba_would_not(self, law, cache, python):
        plain = python(RUN, law, NUMBA_DISABLE_JIT="1")
        assert (*counts(plain), plain["status"]) == (0, 0, 0) and compiled(cache) == []


@jit.jit(float64(float64))
def at_the_top(x):
    """Twice as much."""
    return 2.0 * x


@jit.jit()
def half(x):
    return 0.5 * x


@jit.jit(float64(float64))
def quarter(x):
    return half(half(x))


@jit.jit(int64(FunctionType(int64(int64)), int64))
def count(function, n):
    return function(n) + 1


@jit.jit(int64(int64))
def next_one(n):
    return n + 1


@jit.jit(float64(float64))
def wrong(x):
    return x.nothing


def again(function, **options):
    """The same function, not yet compiled in this process."""
    return jit.RuntimeFunction(function.py_func, signature=function.signature, **options)


class TestDecorator:
    def test_is_pickled_by_name(self):
        assert pickle.loads(pickle.dumps(at_the_top)) is at_the_top

    def test_is_named_and_described_as_the_function(self):
        assert at_the_top.__name__ == "at_the_top" and at_the_top.__doc__ == "Twice as much."
        assert at_the_top.contracted and not jit.jit(contracted=False)(lambda x: x).contracted

    def test_is_compiled_at_the_first_call_and_never_again(self, cache):
        double, before = again(at_the_top), cache_stats()
        assert compiled(cache) == []
        assert double(2) == 4.0 and isinstance(double(2), float)
        assert double(np.float32(1.5)) == 3.0
        assert cache_stats()["misses"] - before["misses"] == 1 and compiled(cache) == ["at_the_top"]
        for arguments in ((), (1.0, 2.0), (None,)):
            with pytest.raises(TypeError):
                double(*arguments)

    def test_is_called_from_compiled_code_and_given_as_a_function(self, cache):
        assert quarter(8.0) == 2.0
        assert half(9.0) == 4.5  # compiled for what it is called with
        assert count(next_one, 40) == 42  # compiled by being given

    def test_an_error_of_the_reader_comes_at_every_call(self, cache):
        for _ in range(2):
            with pytest.raises(InputError, match=r"\.wrong': expected the language .*, got an attribute"):
                wrong(1.0)

    def test_first_calls_from_several_threads(self, cache):
        double, before, results = again(at_the_top), cache_stats(), list[float]()
        threads = [threading.Thread(target=lambda: results.append(double(2))) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert results == [4.0] * 4 and cache_stats()["misses"] - before["misses"] == 1

    def test_options_are_part_of_the_key(self, cache):
        keys = {again(at_the_top, **options).key((float64,)) for options in ({}, {"contracted": False}, {"once": True})}
        assert len(keys) == 3


def test_nothing_is_read_from_a_folder_that_others_can_enter(cache):
    again(at_the_top)(1.0)
    folder = next((cache / "native").iterdir())
    folder.chmod(0o750)
    before = cache_stats()["misses"]
    assert again(at_the_top)(1.0) == 2.0 and cache_stats()["misses"] == before + 1


class TestMade:
    """Object files of text in LLVM's language are made once and read again."""

    TEXT = 'define i64 @"{name}"(i64 %x) {{\n  %y = add i64 %x, {more}\n  ret i64 %y\n}}\n'

    def test_an_object_file_is_made_once(self, cache, monkeypatch):
        name = "symgen.test_jit.first"
        code = jit.object_file(self.TEXT.format(name=name, more=3), name)
        monkeypatch.setattr(
            "symgen.compile.native.machine.compile_module", lambda text, symbol: pytest.fail("made twice")
        )
        assert jit.object_file(self.TEXT.format(name=name, more=3), name) == code
        call = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64)(load_machine_code(code, name))
        assert call(39) == 42
        assert len(compiled(cache)) == 1

    def test_another_text_of_the_same_name_and_a_spoilt_file_are_made_anew(self, cache):
        name = "symgen.test_jit.second"
        code = jit.object_file(self.TEXT.format(name=name, more=1), name)
        assert jit.object_file(self.TEXT.format(name=name, more=2), name) != code
        for path in (cache / "native").rglob("*.bin"):
            content = bytearray(path.read_bytes())
            content[-1] ^= 1
            path.write_bytes(content)
        assert jit.object_file(self.TEXT.format(name=name, more=1), name) == code


class TestIdentity:
    def test_what_a_name_means_is_part_of_the_key(self, monkeypatch):
        keys = set()
        for meaning in (half, at_the_top, 3.0, 3, -0.0, 0.0):
            monkeypatch.setitem(globals(), "half", meaning)
            keys.add(again(quarter).key((float64,)))
        assert len(keys) == 6

    def test_the_loops_of_these_tests_are_parts_and_loops(self):
        assert LOOPS.count("@jit()") == 1, "what `ALL` rests on"


def test_the_head_of_a_file_holds_its_key(tmp_path):
    assert private._entry_head("ab", b"c") != private._entry_head("a", b"bc")
