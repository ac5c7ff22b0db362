"""Loops made from their source: all of them are in the language, and they are Numba's to the last bit."""

from __future__ import annotations

from importlib import import_module

import pytest

from symgen.native.loops import read_loop
from symgen.runtime import rows
from symgen.runtime.hunting import with_events
from symgen.runtime.stopping import with_stops
from symgen.store.emitted import COMPILER
from symgen.store.loops import _lines, definition

from .twofold import process

SCHEMES = {
    **dict.fromkeys(("explicit", "adams", "implicit"), ("constant", "adaptive")),
    **dict.fromkeys(("alpha", "lie", "projected"), ("constant",)),
}
LOOPS = [(scheme, name) for scheme, names in SCHEMES.items() for name in names]


@pytest.mark.parametrize(("scheme", "name"), LOOPS)
@pytest.mark.parametrize("events", [False, True])
def test_every_loop_is_in_the_language(scheme, name, events):
    loop = getattr(import_module(f"symgen.runtime.schemes.{scheme}"), name)
    loop = with_events(loop) if events else loop
    read(loop)
    read(with_stops(loop))


@pytest.mark.parametrize("kind", ["", "_with_events", "_with_stops", "_with_both"])
@pytest.mark.parametrize("steps", ["constant", "adaptive"])
def test_every_loop_over_rows_is_in_the_language(steps, kind):
    read(getattr(rows, steps + kind))


def read(loop):
    """Raise where a part of a loop is left to Numba."""
    (signature,) = loop._signatures
    read_loop(loop._eager, signature.args, definition)


def test_a_loop_whose_file_was_edited_since_it_was_loaded_is_numbas(tmp_path, monkeypatch):
    """The definition at its place in the file is another one by then."""
    file = tmp_path / "edited_later.py"
    text = (
        "from numba import njit\n@njit(error_model='numpy', fastmath={'contract'})\ndef area(x):\n    return 2.0 * x\n"
    )
    file.write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    area = import_module("edited_later").area
    assert definition(area) is not None
    file.write_text(text.replace("2.0", "3.0"))
    _lines.cache_clear()
    assert definition(area) is None
    assert area(1.0) == 2.0
    _lines.cache_clear()


#: Every loop, by a model, a method and an integrator that enter it.
CASES = {
    "explicit-constant": ("pendulum", "lagrange", "rk4"),
    "explicit-adaptive": ("four-bar", "direct-correction", "dop853"),
    "adams": ("four-bar", "lagrange", "abm4", "four-bar", "lagrange", "abm"),
    "implicit": ("four-bar", "ggl", "radau5", "four-bar", "lagrange", "trapezoidal"),
    "alpha": ("spherical-double-pendulum", "generalized-alpha", "generalized-alpha"),
    "projected": ("four-bar", "index3-augmented-lagrangian", "trapezoidal"),
    "lie": ("heavy-top", "lagrange", "rkmk4"),
}


@pytest.mark.slow  # Numba compiles the loops once more
@pytest.mark.parametrize("case", CASES)
def test_runs_are_numbas_to_the_last_bit(case):
    """Where nothing can be contracted, as emitted functions are judged (`test_judge`)."""
    found = []
    for compiler, made in (("libm", "from the source"), ("numba", "by Numba")):
        done = process("native.loops", *CASES[case], **{COMPILER: compiler})
        assert done.stderr.strip().endswith(made)
        found.append(done.stdout)
    assert found[0] == found[1]
