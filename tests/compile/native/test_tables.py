"""Looped code compiled from its source: all of it is in the language, and it does what Numba's does."""

import numpy as np
import pytest
from support.golden import LOOPED, emitted_looped, written
from support.rotation import of_turn

from symgen.compile.native import types
from symgen.compile.native.language import ArrayView, Assign, Evaluate, Invoke, ScalarOperation, Variable
from symgen.compile.native.read import Foreign, read_function
from symgen.compile.native.read_tables import Written
from symgen.compile.store.emitted import EmittedFunction
from symgen.compile.store.loaded_modules import load_module
from symgen.compile.store.paths import ENVIRONMENT_VARIABLE

from .test_loops import compared
from .test_read import Source
from .twofold import ARRAY, NUMBER, WHOLE, own_functions, process

A, T = ("float", True), ("unsigned", True)
#: Types of arguments by their names, where a function is handed no tables and where it is.
PLAIN = {"t": NUMBER, "iw": WHOLE, **dict.fromkeys(("y", "p", "w", "ydot", "out", "k", "r", "j"), ARRAY)}
HANDED = {
    **{"T": types.uint32[::1], "t": NUMBER, "at": types.uint32, "value": NUMBER},
    **dict.fromkeys(("y", "p", "w", "out"), ARRAY),
}


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("model", LOOPED)
def test_looped_code_is_in_the_language(model, tmp_path):
    for path in written(emitted_looped(model, False), tmp_path).glob("*.py"):
        module = load_module(path)
        for name in own_functions(module):
            function = getattr(module, name)
            assert isinstance(function, EmittedFunction)
            names = function.py_func.__code__.co_varnames[: function.py_func.__code__.co_argcount]
            kinds = HANDED if "T" in names else PLAIN
            function.read(tuple(kinds.get(x, types.int64) for x in names))  # raises where a part is outside


NAMES = {
    "np": np,
    "tables": Written("_compiled_tables", lambda context, w: None),
    "call": Written(
        "_compiled_code",
        lambda context, address, *rest: (
            types.int64(types.int64, types.uint32[::1], types.float64[::1], types.uint32),
            None,
        ),
    ),
    "other": Written("other", lambda context, x: (types.int64(types.int64), None)),
    "SIZE": np.int64(3),
}


def of(lines: str, *kinds: tuple[str, bool]):
    """Read a function of an array of floats, or of others, with its tables."""
    body = "".join(f"    {line}\n" for line in lines.split("; "))
    text = f"def f({', '.join('wxyz'[: len(kinds) or 1])}):\n{body}    return 0\n"
    return read_function(Source(text, NAMES), kinds or (A,))


def test_tables_are_found_and_handed_on():
    f = of("T = tables(w); a = np.int64(T[SIZE]) + T[2]; call(a, T, w, T[3])")
    start, view, number, call = f.body[:4]
    assert isinstance(start, Assign) and start.value.name == "bits"
    assert isinstance(view, ArrayView) and (view.name, view.array, view.type) == ("T", "w", "unsigned")
    assert isinstance(number, Assign) and f.variables["a"] == "int"
    assert [x.type for x in number.value.arguments] == ["int", "int"]
    assert isinstance(call, Evaluate) and isinstance(call.call, Invoke)
    assert call.call.function == Variable("int", "a") and call.call.arguments[:2] == ("T", "w")
    index = call.call.arguments[2]
    assert isinstance(index, ScalarOperation) and (index.type, index.name) == ("unsigned", "unsigned")


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
def test_what_could_differ_is_outside(lines, why):
    with pytest.raises(Foreign) as told:
        of(lines)
    assert str(told.value).startswith(why)


def test_what_returns_nothing_is_called_by_looped_code_alone():
    assert of("x[0] = 1.0", T, A).returned == "int"
    text = "def f(T, w):\n    w[0] = 1.0\n"
    assert read_function(Source(text, NAMES), (T, A)).returned == "int"
    with pytest.raises(Foreign):
        read_function(Source(text, NAMES), (A, A))


#: Kinds of joints and forces with an elimination and a projection, the other kind of law, and stages of an integrator.
CASES = {
    "elements": ("everything", "direct-correction", "rk4"),
    "augmented": ("slider-crank", "augmented-lagrangian", "abm4"),
    "stages": ("four-bar", "ggl", "radau5"),
}


@pytest.mark.by_turns(4)
@pytest.mark.slow  # Numba compiles all of looped code once more, another case in another turn
@pytest.mark.parametrize("case", of_turn(CASES, 3))
def test_runs_of_looped_code_are_numbas(case):
    compared("looped", *CASES[case])


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_spoilt_entries_of_the_cache_are_made_anew(tmp_path):
    environment = {ENVIRONMENT_VARIABLE: str(tmp_path)}
    first = process("compile.native.loops", "looped", "pendulum", "lagrange", "rk4", **environment)
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
            entry.unlink()
    again = process("compile.native.loops", "looped", "pendulum", "lagrange", "rk4", **environment)
    assert again.stdout == first.stdout
    assert {entry: entry.read_bytes() for entry in kept} == kept
