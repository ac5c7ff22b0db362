"""Looped code made from its source: all of it is in the language, and it is Numba's to the last bit."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from numba import types
from numba.extending import intrinsic

from symgen.native.language import Assign, Evaluate, Invoke, Operation, Variable, View
from symgen.native.read import Foreign, read
from symgen.store.emitted import COMPILER, EmittedFunction
from symgen.store.modules import load_module
from symgen.store.paths import ENVIRONMENT_VARIABLE

from .test_read import Dispatcher
from .twofold import own_functions, process

LOOPED = Path(__file__).parents[2] / "generated" / "looped"
A, F, N, T, U = ("float", True), ("float", False), ("int", False), ("unsigned", True), ("unsigned", False)
#: Types of arguments by their names, where a function is handed no tables and where it is.
PLAIN = {"t": F, "iw": ("int", True), **dict.fromkeys(("y", "p", "w", "ydot", "out", "k", "r", "j"), A)}
HANDED = {"T": T, "t": F, "at": U, "value": F, **dict.fromkeys(("y", "p", "w", "out"), A)}


@pytest.mark.parametrize("path", sorted(LOOPED.glob("*.py")), ids=lambda path: path.stem)
def test_looped_code_is_in_the_language(path):
    module = load_module(path)
    for name in own_functions(module):
        function = getattr(module, name)
        assert isinstance(function, EmittedFunction)
        names = function.py_func.__code__.co_varnames[: function.py_func.__code__.co_argcount]
        kinds = [HANDED.get(x, N) if "T" in names else PLAIN.get(x, N) for x in names]
        function.read(tuple(kinds))  # raises where a part is left to Numba


@intrinsic
def _compiled_tables(typing_context, w):
    """Stand for the tables at the end of an array."""
    return types.uint32[::1](w), None


@intrinsic
def _compiled_code(typing_context, address, T, w, i):
    """Stand for a call by an address."""
    return types.int64(types.int64, types.uint32[::1], types.float64[::1], types.uint32), None


@intrinsic
def other(typing_context, x):
    """Stand for a piece of a compiler that is not known."""
    return types.int64(types.int64), None


NAMES = {"np": np, "tables": _compiled_tables, "call": _compiled_code, "other": other, "SIZE": np.int64(3)}


def of(lines: str, *kinds: tuple[str, bool]):
    """Read a function of an array of floats, or of others, with its tables."""
    body = "".join(f"    {line}\n" for line in lines.split("; "))
    text = f"def f({', '.join('wxyz'[: len(kinds) or 1])}):\n{body}    return 0\n"
    return read(Dispatcher(text, NAMES), kinds or (A,), lambda f: getattr(f, "tree", None))


def test_tables_are_found_and_handed_on():
    f = of("T = tables(w); a = np.int64(T[SIZE]) + T[2]; call(a, T, w, T[3])")
    (w,) = f.parameters
    start, view, number, call = f.body[:4]
    assert w.sized
    assert isinstance(start, Assign) and start.value.name == "bits"
    assert isinstance(view, View) and (view.name, view.array, view.type) == ("T", "w", "unsigned")
    assert isinstance(number, Assign) and f.variables["a"] == "int"
    assert [x.type for x in number.value.arguments] == ["int", "int"]
    assert isinstance(call, Evaluate) and isinstance(call.call, Invoke)
    assert call.call.function == Variable("int", "a") and call.call.arguments[:2] == ("T", "w")
    index = call.call.arguments[2]
    assert isinstance(index, Operation) and (index.type, index.name) == ("unsigned", "unsigned")


@pytest.mark.parametrize(
    ("lines", "why"),
    [
        ("T = tables(w); a = T[0] - T[1]", "an operation without sign"),
        ("T = tables(w); b = T[1]; a = np.uint32(b + 1); c = a - b", "an operation without sign"),
        ("T = tables(w); b = T[1]; b -= T[0]", "an operation without sign"),
        ("T = tables(w); a = T[0]; a = 3", "variable 'a' has two types"),
        ("T = tables(w); a, b = 1, 2; a, b = T[0], 1", "variable 'a' has two types"),
        ("T = tables(w); T[0] = 1", "an element of a constant"),
        ("T = tables(w); T = tables(w)", "variable 'T' has two types"),
        ("T = tables(w); T = 1", "variable 'T' has two types"),
        ("T = tables(w)[0]", "an element of an expression"),
        ("T = V = tables(w)", "tables in another place"),
        ("T = tables(3)", "tables in another place"),
        ("T = tables(w); call(0, w, w, 0)", "an array of another kind"),
        ("T = tables(w); call(0, T, w)", "a function with other arguments"),
        ("a = other(1)", "the function 'other'"),
        ("a = np.int32(1)", "a call"),
        ("a = np.int64(1, 2)", "an integer of other than one value"),
        ("T = tables(w); a = max(T[0], 1)", "an argument without sign"),
        ("T = tables(w); i = [0 for i in T]", "an expression 'ListComp'"),
    ],
)
def test_what_could_differ_is_left_to_numba(lines, why):
    with pytest.raises(Foreign) as told:
        of(lines)
    assert str(told.value).startswith(why)


def test_what_returns_nothing_is_called_by_looped_code_alone():
    assert of("x[0] = 1.0", T, A).returned == "int"
    text = "def f(T, w):\n    w[0] = 1.0\n"
    found = read(Dispatcher(text, NAMES), (T, A), lambda f: getattr(f, "tree", None))
    assert found.returned == "int"
    with pytest.raises(Foreign):
        read(Dispatcher(text, NAMES), (A, A), lambda f: getattr(f, "tree", None))


#: A kind of law, correction and integrator each; kinds of joints and forces.
CASES = {
    "elimination": ("pendulum", "lagrange", "rk4"),
    "projection": ("four-bar", "direct-correction", "rk4", "bricard", "mass-orthogonal-projection", "rk4"),
    "augmented": ("four-bar", "index1-augmented-lagrangian", "rk4", "slider-crank", "augmented-lagrangian", "abm4"),
    "stages": ("four-bar", "ggl", "radau5"),
    "elements": (
        "everything",
        "lagrange",
        "rk4",
        "rough",
        "lagrange",
        "rk4",
        "spatial-slider-crank",
        "lagrange",
        "rk4",
    ),
}


@pytest.mark.slow  # Numba compiles all of looped code once more
@pytest.mark.parametrize("case", CASES)
def test_runs_of_looped_code_are_numbas_to_the_last_bit(case):
    """Where nothing can be contracted, as emitted functions are judged (`test_judge`)."""
    direct = process("native.looped", *CASES[case], **{COMPILER: "libm"})
    plain = process("native.looped", *CASES[case], **{COMPILER: "numba"})
    assert direct.stderr.strip().endswith("all from the source")
    assert "rhs" in plain.stderr.split(",")
    assert direct.stdout == plain.stdout


@pytest.mark.slow
def test_a_part_that_is_left_to_numba_changes_nothing(tmp_path):
    """Either calls the other: by address, and as functions of one module."""
    case, names = CASES["elimination"], {"motion", "accept", "solve_code"}
    environment = {ENVIRONMENT_VARIABLE: str(tmp_path), COMPILER: "libm"}
    part = process("native.looped", f"-{','.join(names)}", *case, **environment)
    loaded = process("native.looped", *case, **environment)  # what Numba has compiled is found in the cache
    whole = process("native.looped", *case, **{COMPILER: "libm"})
    assert all(names <= set(found.stderr.split()[-1].split(",")) for found in (part, loaded))
    assert whole.stderr.endswith("all from the source\n")
    assert part.stdout == loaded.stdout == whole.stdout


@pytest.mark.slow
def test_spoilt_entries_of_the_cache_are_made_anew(tmp_path):
    environment = {ENVIRONMENT_VARIABLE: str(tmp_path), COMPILER: "source"}
    first = process("native.looped", *CASES["elimination"], **environment)
    entries = sorted((tmp_path / "native").rglob("*.bin"))
    assert len(entries) > 20
    rng = np.random.default_rng(5)
    kept = {}
    for i, entry in enumerate(entries):
        content = bytearray(entry.read_bytes())
        kept[entry] = bytes(content)
        if i % 3 == 0:  # a bit has changed
            content[int(rng.integers(len(content)))] ^= 1 << int(rng.integers(8))
            entry.write_bytes(content)
        elif i % 3 == 1:  # what callers call is gone
            os.remove(entry)
    again = process("native.looped", *CASES["elimination"], **environment)
    assert again.stdout == first.stdout and again.stderr.endswith("all from the source\n")
    assert {entry: entry.read_bytes() for entry in kept} == kept
