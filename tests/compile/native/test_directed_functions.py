"""Directions as functions of the language: printed as C, they are those that machine code has beside each number."""

import inspect

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

import symgen
from symgen.compile.native import types
from symgen.compile.native.directed_functions import directed_function
from symgen.compile.native.read_values import Foreign
from symgen.compile.store.loaded_modules import load_module
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model

from .printed import Library
from .test_operations import HEAD, HUMP, SECOND, TABLE, printed, programs
from .test_tangents import LOOP, POWER, directed, emitted
from .twofold import arguments_of, written


def in_c(function, values, rates, folder):
    """Return the arrays of a function after its call in C, and one direction of each, as `directed` does."""
    names = list(inspect.signature(function.py_func).parameters)
    places = {names[i]: len(values[i]) for i in rates}
    longer = [np.concatenate([v, rates[i].ravel()]) if i in rates else v for i, v in enumerate(values)]
    made = directed_function(function.read(arguments_of(function)), places)
    folder.mkdir(exist_ok=True)
    Library({"f": made}, folder).function("f", types.int64(*arguments_of(function)))(*longer)
    shown = {i: longer[i][len(values[i]) :].reshape(-1, 1) for i in rates}
    return [longer[i][: len(values[i])] if i in rates else longer[i] for i in range(len(values))], shown


def assert_same(function, values, rates, folder):
    own = in_c(function, tuple(map(np.copy, values)), rates, folder)
    machine = directed(function, tuple(map(np.copy, values)), rates)
    for i in rates:
        for found, expected in ((own[0][i], machine[0][i]), (own[1][i], machine[1][i])):
            defined = np.isfinite(found) & np.isfinite(expected)
            size = max(1.0, np.abs(expected[np.isfinite(expected)]).max(initial=0.0))
            np.testing.assert_array_equal(np.isfinite(found), np.isfinite(expected))
            np.testing.assert_allclose(found[defined] / size, expected[defined] / size, rtol=1e-9, atol=1e-11)


@pytest.mark.slow
@given(program=programs())
@settings(max_examples=6, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True, database=None)
def test_random_programs(tmp_path_factory, program):
    folder, rng = tmp_path_factory.mktemp("directed"), np.random.default_rng(5)
    function = load_module(written(folder, TABLE, HUMP, SECOND, printed(*program), head=HEAD)).f
    values = rng.uniform(0.1, 0.9, 12), np.zeros(8)
    assert_same(function, values, {0: rng.standard_normal((12, 1)), 1: np.zeros((8, 1))}, folder / "c")


@pytest.mark.slow
def test_loops_that_are_left_early(tmp_path):
    function, rng = load_module(written(tmp_path, POWER, LOOP)).f, np.random.default_rng(2)
    values = rng.uniform(0.5, 1.5, 12), np.zeros(8)
    assert_same(function, values, {0: rng.standard_normal((12, 1)), 1: np.zeros((8, 1))}, tmp_path / "c")


@pytest.mark.slow
@pytest.mark.parametrize(("name", "method"), [("wiper", "direct-correction"), ("rolling-disc", "null-space")])
def test_functions_of_models(name, method, tmp_path):
    model = symgen.load(name)
    compiled = compile_model(model.mechanism, choose_method(method))
    start, rng, n = model.assemble(compiled), np.random.default_rng(1), compiled.info.ny
    rooms = {"t": 0.3, "p": start.p, "w": start.w, "iw": np.zeros(40, dtype=np.int64), "ydot": np.zeros(n)}
    rooms["y"] = start.y[:n] + 1e-4 * rng.standard_normal(n)
    scales = {"y": np.ones(n), "p": 0.3 * np.abs(start.p)}
    for k, function in enumerate(emitted(compiled)):
        names = list(inspect.signature(function.py_func).parameters)
        if function.__name__ not in ("prepare", "geometry", "rhs") or not set(names) <= set(rooms):
            continue
        values = tuple(np.copy(rooms[p]) if isinstance(rooms[p], np.ndarray) else rooms[p] for p in names)
        rates = {
            i: (rng.standard_normal(len(values[i])) * scales.get(p, np.zeros(len(values[i]))))[:, np.newaxis]
            for i, p in enumerate(names)
            if p not in ("t", "iw")
        }
        assert_same(function, values, rates, tmp_path / f"{function.__name__}{k}")


def test_an_array_without_directions_takes_none(tmp_path):
    function = load_module(written(tmp_path, "def f(y, out):\n    out[0] = 2.0*y[0]\n    return 0\n")).f
    read = function.read(arguments_of(function))
    with pytest.raises(Foreign, match="the array 'out' without directions"):
        directed_function(read, {"y": 1})
    assert (
        directed_function(read, {"y": 1, "out": 1}).key == directed_function(read, {"out": 1, "y": 1}).key != read.key
    )
