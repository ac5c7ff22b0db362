from __future__ import annotations

import os
import pickle
import subprocess
import sys
import threading
from pathlib import Path

import numba
import numpy as np
import pytest
from numba import types

from symgen.store import identity, jit, private
from symgen.store.stats import cache_stats

from .conftest import LAW, MODEL, RUN


def compiled(cache: Path) -> list[str]:
    """Names of the functions in the cache."""
    return sorted(path.name.rpartition("-")[0] for path in (cache / "native").rglob("*.bin"))


@pytest.mark.slow
class TestSecondProcess:
    def test_finds_loop_and_emitted_function_whatever_the_hash_seed(self, cache, generated, python):
        law = generated / "lagrange.py"
        first = python(RUN, law, PYTHONHASHSEED="1")
        assert (first["hits"], first["misses"]) == (0, 4)  # euler, advance, rhs, geometry
        assert first["compile_seconds"] > 0 and first["load_seconds"] == 0
        assert compiled(cache) == ["advance", "euler", "geometry", "rhs"]
        second = python(RUN, law, PYTHONHASHSEED="2")
        assert (second["hits"], second["misses"]) == (2, 0)  # what they call is inside
        assert second["load_seconds"] > 0 and second["compile_seconds"] == 0
        assert second["y"] == first["y"] and second["status"] == 0
        # Another folder with the same name and content, such as a checkout, has the same machine code.
        copy = generated.parent.parent / "copy" / generated.name
        copy.mkdir(parents=True)
        for path in generated.iterdir():
            (copy / path.name).write_bytes(path.read_bytes())
        third = python(RUN, copy / "lagrange.py")
        assert (third["hits"], third["misses"]) == (2, 0)

    def test_compiles_again_what_was_edited_and_all_that_calls_it(self, cache, generated, python):
        law = generated / "lagrange.py"
        python(RUN, law)
        # Same size and same time stamp: only the content tells.
        status = law.stat()
        law.write_text(LAW.replace("-p[0]", "+p[0]"))
        os.utime(law, ns=(status.st_atime_ns, status.st_mtime_ns))
        edited = python(RUN, law)
        assert (edited["hits"], edited["misses"]) == (2, 1)  # euler and geometry; rhs
        assert edited["y"][0] > 1
        (generated / "model.py").write_text(MODEL.replace("sin", "cos"))
        edited = python(RUN, law)
        assert (edited["hits"], edited["misses"]) == (1, 2)  # euler; rhs and geometry

    def test_survives_every_kind_of_damage(self, cache, generated, python, tmp_path):
        law = generated / "lagrange.py"
        good = python(RUN, law)
        witness = tmp_path / "witness"

        class Foreign:
            def __reduce__(self):
                return Path.touch, (witness,)

        foreign = pickle.dumps(Foreign())
        rhs, euler = next(cache.rglob("rhs-*.bin")), next(cache.rglob("euler-*.bin"))
        code = next((cache / "bytecode").glob("lagrange-*.bin"))
        machine_code = rhs.read_bytes()
        for content in (machine_code[:-1], machine_code[:50], b"", foreign, euler.read_bytes()):
            rhs.write_bytes(content)
            code.write_bytes(code.read_bytes()[: len(content) % 97])
            found = python(RUN, law)
            assert (found["hits"], found["misses"]) == (2, 1)  # euler and geometry; rhs
            assert found["y"] == good["y"]
        assert not witness.exists()
        assert python(RUN, law)["misses"] == 0  # and it was written anew

    def test_compiles_again_when_a_helper_in_another_file_was_edited(self, cache, python, tmp_path):
        library = tmp_path / "library"
        library.mkdir()
        (library / "inner.py").write_text("from symgen.store.jit import jit\n@jit()\ndef f(x):\n    return 2.0 * x\n")
        (library / "middle.py").write_text("from inner import f\n")
        (library / "outer.py").write_text(
            "from symgen.store.jit import jit\nfrom middle import f\n@jit()\ndef g(x):\n    return f(x)\n"
        )
        script = """
import json, outer
from symgen.store.stats import cache_stats
print(json.dumps([outer.g(1.0), cache_stats()["misses"]]))
"""
        assert python(script) == [2.0, 2]
        assert python(script) == [2.0, 0]
        # of another length: Python takes its byte code for that of a file of this length and of this second
        (library / "inner.py").write_text((library / "inner.py").read_text().replace("2.0", "3.25"))
        assert python(script) == [3.25, 2]

    def test_works_uncached_where_nothing_can_be_written(self, generated, python, tmp_path):
        (tmp_path / "file").write_text("")
        found = python(RUN, generated / "lagrange.py", SYMGEN_CACHE_DIR=str(tmp_path / "file" / "cache"))
        assert (found["hits"], found["misses"], found["status"]) == (0, 4, 0)

    def test_two_at_once(self, cache, generated, python, tmp_path):
        law = generated / "lagrange.py"
        path = os.pathsep.join([str(tmp_path / "library"), str(Path(__file__).parents[2])])
        environment = {**os.environ, "PYTHONPATH": path}
        processes = [
            subprocess.Popen([sys.executable, "-c", RUN, law], env=environment, stdout=subprocess.DEVNULL)
            for _ in range(2)
        ]
        assert [process.wait() for process in processes] == [0, 0]
        assert python(RUN, law)["misses"] == 0

    def test_factory_functions_are_kept_apart(self, cache, python, tmp_path):
        (tmp_path / "library").mkdir()
        (tmp_path / "library" / "factory.py").write_text("""\
from numba import types
from symgen.store.jit import jit
@jit(types.float64(types.FunctionType(types.float64(types.float64)), types.float64))
def apply(function, x):
    return function(x)
def make(factor, step):
    @jit()
    def scale(x):
        return factor * step(x)
    return scale
@jit()
def one(x):
    return x
@jit()
def half(x):
    return 0.5 * x
""")
        script = """
import json, sys, factory
from symgen.store.jit import cache_stats
steps = {"one": factory.one, "half": factory.half}
made = [factory.make(float(text[0]), steps[text[1:]]) for text in sys.argv[1:]]
for function in made:
    function(1.0)
print(json.dumps([[factory.apply(function, 1.0) for function in made], cache_stats()["hits"]]))
"""
        assert python(script, "2one") == [[2.0], 0]
        assert python(script, "3one") == [[3.0], 2]  # apply and one
        assert python(script, "2half") == [[1.0], 1]
        assert python(script, "2one", "3one", "2half") == [[2.0, 3.0, 1.0], 4]
        assert python(script, "3one", "2half", "2one") == [[3.0, 1.0, 2.0], 4]

    def test_switches_of_numba(self, cache, generated, python):
        plain = python(RUN, generated / "lagrange.py", NUMBA_DISABLE_JIT="1")
        assert (plain["hits"], plain["misses"], plain["status"]) == (0, 0, 0)
        python(RUN, generated / "lagrange.py")
        other = python(RUN, generated / "lagrange.py", NUMBA_BOUNDSCHECK="1")  # other machine code
        assert (other["hits"], other["misses"]) == (0, 4)


@jit.jit("float64(float64)")
def at_the_top(x):
    return x


class TestDecorator:
    def test_is_pickled_by_name(self):
        assert pickle.loads(pickle.dumps(at_the_top)) is at_the_top

    def test_defaults_and_documentation(self, cache):
        @jit.jit()
        def double(x):
            """Twice as much."""
            return 2.0 * x

        assert double(3.0) == 6.0
        assert double.__name__ == "double" and double.__doc__ == "Twice as much."
        options = {name: double.targetoptions[name] for name in ("nogil", "error_model", "fastmath")}
        assert options == {"nogil": True, "error_model": "numpy", "fastmath": {"contract"}}
        assert jit.jit(fastmath=False)(lambda x: x).targetoptions["fastmath"] is False

    def test_signatures_are_compiled_at_the_first_call_and_nothing_else_ever(self, cache):
        @jit.jit("float64(float64)", types.int64(types.int64))
        def double(x):
            return 2 * x

        assert double.signatures == []
        before = cache_stats()
        assert double(2) == 4
        assert cache_stats()["misses"] - before["misses"] == 2
        assert double.signatures == [(types.float64,), (types.int64,)]
        assert double(2.5) == 5.0
        assert double(np.float32(1.5)) == 3.0  # safe conversion
        with pytest.raises(TypeError, match="No matching definition"):
            double("2")
        assert len(double.signatures) == 2

    def test_is_called_from_compiled_code_and_given_as_a_function(self, cache):
        @jit.jit("float64(float64)")
        def half(x):
            return 0.5 * x

        @jit.jit("float64(float64)")
        def quarter(x):
            return half(half(x))

        @jit.jit(types.float64(types.FunctionType(types.float64(types.float64)), types.float64))
        def apply(function, x):
            return function(x)

        assert quarter(8.0) == 2.0
        third = jit.jit("float64(float64)")(lambda x: x / 3)
        assert apply(third, 9.0) == 3.0  # compiled by being given
        assert apply(half, 9.0) == 4.5

    def test_an_error_of_the_compiler_comes_at_every_call(self, cache):
        @jit.jit("float64(float64)")
        def wrong(x):
            return x.nothing

        for _ in range(2):
            with pytest.raises(numba.TypingError, match="nothing"):
                wrong(1.0)

    def test_first_calls_from_several_threads(self, cache):
        @jit.jit("float64(float64)")
        def double(x):
            return 2 * x

        results: list[float] = []
        threads = [threading.Thread(target=lambda: results.append(double(2))) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert results == [4.0] * 4
        assert all(isinstance(value, float) for value in results)  # never compiled for int
        assert double.signatures == [(types.float64,)]

    def test_what_closes_over_an_odd_object_stays_uncached(self, cache):
        class Odd:
            def __init__(self):
                self.value = 1

        odd = Odd()

        def closes(x):
            return x if odd is None else 2 * x

        closes_jitted = jit.jit()(lambda x: 2 * x)
        assert type(closes_jitted._cache).__name__ == "MachineCode"
        assert type(jit.jit()(closes)._cache).__name__ == "NullCache"

    def test_recompile_forgets_and_works(self, cache):
        @jit.jit()
        def flushed(x):
            return 2 * x

        flushed(1)
        assert compiled(cache)
        flushed.recompile()
        assert flushed(2) == 4
        assert len(compiled(cache)) == 1


def test_nothing_is_unpickled_from_a_folder_that_others_can_enter(cache, monkeypatch):
    def double(x):
        return 2 * x

    jit.jit()(double)(1.0)
    folder = next((cache / "native").iterdir())
    folder.chmod(0o750)
    monkeypatch.setattr(pickle, "loads", lambda *_: pytest.fail("unpickled"))
    assert jit.jit()(double)(1.0) == 2.0


class TestIdentity:
    def test_equal_content_gives_equal_text(self):
        def text() -> str:
            value = {"a": [1, 2.5, None, b"x"], "b": {"p", "q", "r"}, "c": np.arange(3.0), "d": np.float64(1)}
            return identity.describe(value)

        assert text() == text()

    @pytest.mark.parametrize(
        ("one", "other"),
        [
            (1, 1.0),
            (1, True),
            (0.0, -0.0),
            (1.0, np.float64(1)),
            ("1", 1),
            ((1,), [1]),
            (np.zeros(2), np.zeros(3)),
            (np.zeros(2), np.zeros(2, np.float32)),
            (np.zeros((2, 1)), np.zeros((1, 2))),
            (("a", "b"), ("a,b",)),
            (types.float64, types.float32),
        ],
    )
    def test_other_content_gives_another_text(self, one, other):
        assert identity.describe(one) != identity.describe(other)

    def test_functions_differ_by_what_they_do_and_close_over(self):
        def make(c, default=1):
            def f(x, y=default):
                return c * x + y

            return f

        texts = {identity.describe_function(f) for f in (make(1), make(2), make(1, 2), lambda x: x, lambda x: -x)}
        assert len(texts) == 5
        assert identity.describe_function(make(1)) == identity.describe_function(make(1))

    def test_what_has_no_content_is_refused(self):
        recursive: list[object] = []
        recursive.append(recursive)
        for value in (object(), recursive, np.array([object()])):
            with pytest.raises(identity.NotDescribable):
                identity.describe(value)

    def test_the_stamp_covers_runtime_and_integrators(self, tmp_path, monkeypatch):
        (tmp_path / "store").mkdir()
        for folder in ("runtime", "integrators"):
            (tmp_path / folder).mkdir()
            (tmp_path / folder / "a.py").write_text("a = 1")
        monkeypatch.setattr(identity, "__file__", str(tmp_path / "store" / "identity.py"))
        stamps = set()
        for path in (None, "runtime/a.py", "integrators/a.py", "integrators/new.py"):
            if path is not None:
                (tmp_path / path).write_text("a = 2")
            stamps.add(identity.sources_digest.__wrapped__("runtime", "integrators"))
        assert len(stamps) == 4


def test_the_head_of_a_file_holds_its_key(tmp_path):
    assert private._head("ab", b"c") != private._head("a", b"bc")
