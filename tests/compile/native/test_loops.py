"""Loops compiled from their source: all of them are in the language, and they do what Numba's do."""

from __future__ import annotations

import importlib
import json

import msgspec
import numpy as np
import pytest
from support.rotation import of_turn

from symgen.base.errors import InputError
from symgen.compile.native.language import ScalarOperation
from symgen.compile.native.loops import read_loop
from symgen.compile.native.types import float64
from symgen.compile.store import function_source
from symgen.compile.store import jit as store
from symgen.compile.store.paths import ENVIRONMENT_VARIABLE
from symgen.run.loops.event_loop import loop_with_events
from symgen.run.loops.seams import loop_with_seams
from symgen.run.rows.rows import over_rows

from .twofold import process

SCHEMES = {
    "picard": ("constant", "adaptive"),
    **dict.fromkeys(("explicit", "adams", "implicit", "backward", "partitioned"), ("constant", "adaptive")),
    **dict.fromkeys(("alpha", "lie", "projected", "half_explicit", "rattle", "symplectic", "screw"), ("constant",)),
    **dict.fromkeys(("discrete_gradient", "symmetric"), ("constant",)),
}
LOOPS = [(scheme, name) for scheme, names in SCHEMES.items() for name in names]


@pytest.mark.by_turns(4)
@pytest.mark.fast(
    "False-explicit-constant",
    "False-picard-constant",
    "False-lie-constant",
    "False-half_explicit-constant",
    "False-rattle-constant",
    "False-symplectic-constant",
    "False-screw-constant",
    "False-symmetric-constant",
    "True-adams-adaptive",
)
@pytest.mark.parametrize(("scheme", "name"), LOOPS)
@pytest.mark.parametrize("events", [False, True])
def test_every_loop_is_in_the_language(scheme, name, events):
    loop = loop_with_events(loop_of(scheme, name)) if events else loop_of(scheme, name)
    read(loop)
    read(loop_with_seams(loop))


@pytest.mark.by_turns(4)
@pytest.mark.fast(
    "explicit-constant-False-False",
    "explicit-adaptive-True-False",
    "picard-constant-True-False",
    "picard-adaptive-True-True",
)
@pytest.mark.parametrize("events", [False, True])
@pytest.mark.parametrize("seams", [False, True])
@pytest.mark.parametrize("steps", ["constant", "adaptive"])
@pytest.mark.parametrize("scheme", ["explicit", "picard"])
def test_every_loop_over_rows_is_in_the_language(scheme, steps, events, seams):
    loop = loop_of(scheme, steps)
    read(over_rows(loop, events, seams))
    if events:
        read(over_rows(loop, events, seams, effects=True))


def loop_of(scheme, name):
    """Return the loop of a scheme with constant or adaptive steps."""
    return getattr(importlib.import_module(f"symgen.run.loops.schemes.{scheme}"), name)


def read(loop):
    """Return a loop in the checked language; raise where a part of it is outside."""
    return read_loop(loop, loop.signature.arguments)


@store.jit(float64(float64))
def doubled(x):
    """Make a list, as a user's loop might."""
    numbers = [x, 2.0 * x]
    return numbers[1]


def test_a_loop_outside_the_language_is_refused():
    refusal = (
        f"the function '{__name__}.doubled': expected the language of compiled functions, "
        "got an expression 'List' (line 4)"
    )
    for _ in range(2):
        with pytest.raises(InputError) as error:
            doubled(2.0)
        assert str(error.value) == refusal


def test_a_loop_whose_file_was_edited_since_it_was_loaded_is_refused(tmp_path, monkeypatch):
    """The definition at its place in the file is another one by then; nothing is in the cache."""
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(tmp_path / "cache"))
    file = tmp_path / "edited_later.py"
    head = "from symgen.compile.native.types import float64\nfrom symgen.compile.store.jit import jit\n\n\n"
    file.write_text(f"{head}@jit(float64(float64))\ndef area(x):\n    return 2.0 * x\n")
    monkeypatch.syspath_prepend(tmp_path)
    area = importlib.import_module("edited_later").area
    text = file.read_text()
    assert area.tree() is not None
    file.write_text(text.replace("2.0", "3.0"))
    function_source.lines_when_loaded.cache_clear()
    with pytest.raises(InputError, match=r"'edited_later\.area': .* got 'area', whose definition is not at"):
        area(1.0)
    file.write_text(text)
    function_source.lines_when_loaded.cache_clear()
    assert area(1.0) == 2.0


#: Loops, and a model, a method and an integrator that enter each. Numba compiles them once more, which takes most of a
#: minute each: these few have every construct of all loops, and one of them is compiled in a turn. Exact solutions
#: prove that all loops do what they should.
CASES = {
    ("explicit", "adaptive"): ("four-bar", "direct-correction", "dop853"),
    ("half_explicit", "constant"): ("four-bar", "half-explicit", "half-explicit"),
    ("screw", "constant"): ("heavy-top", "lagrange", "rkmk4-screws"),
    ("implicit", "adaptive"): ("four-bar", "ggl", "radau5"),
}
#: Integrators whose steps depend on rounding, as errors are estimated.
ADAPTIVE = {"dop853", "radau5"}


def compared(shape, *words):
    """Assert that short runs by both compilers are the same to what rounding grows to."""
    found = []
    for module in ("loops", "by_numba"):
        done = json.loads(process(f"compile.native.{module}", shape, *words).stdout)
        assert done["numba"] == (module == "by_numba")
        found.append(done["runs"])
    for integrator, one, other in zip(words[2::3], *found, strict=True):
        assert integrator in ADAPTIVE or one["steps"] == other["steps"]
        for name, numbers in one["states"].items():
            size = np.abs(other["states"][name]).max()
            np.testing.assert_allclose(numbers, other["states"][name], rtol=0, atol=1e-9 * size, err_msg=name)


@pytest.mark.by_turns(5)
@pytest.mark.slow
@pytest.mark.parametrize("loop", of_turn(CASES, 4), ids="-".join)
def test_runs_are_numbas(loop):
    compared("straight", *CASES[loop])


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_these_loops_have_every_construct():
    found = {loop: constructs(read(loop_of(*loop))) for loop in LOOPS}
    assert set().union(*found.values()) == set().union(*(found[loop] for loop in CASES))
    assert len(found["picard", "adaptive"]) > 30


def constructs(value: object) -> set[tuple[str, str]]:
    """Return the kinds of statements and expressions of a loop, operations by their names."""
    if isinstance(value, dict | tuple | list):
        parts = list(value.values()) if isinstance(value, dict) else list(value)
        return set().union(*map(constructs, parts))
    if not isinstance(value, msgspec.Struct):
        return set()
    operation = value.name if isinstance(value, ScalarOperation) else ""
    return {(type(value).__name__, operation)}.union(*(constructs(getattr(value, f)) for f in value.__struct_fields__))


@pytest.mark.slow
def test_a_run_imports_no_numba():
    for shape, *case in (("straight", "four-bar", "lagrange", "rk4"), ("looped", "pendulum", "lagrange", "rk4")):
        assert not json.loads(process("compile.native.loops", shape, *case).stdout)["numba"]
