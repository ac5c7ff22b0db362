"""Right-hand sides at eight nodes of a step at once: at each node they are what they are at one."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

import symgen
from symgen.compile.native import types
from symgen.compile.native.node_functions import FAR, SUSPICIOUS
from symgen.compile.native.read_values import Foreign
from symgen.compile.native.types import NODES
from symgen.compile.store.emitted import NodesFunction
from symgen.compile.store.loaded_modules import load_module
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model
from symgen.run.compiling.side import add_integrals
from symgen.run.layout.right_hand_side import rates_at_nodes

from .test_operations import HEAD, HUMP, INPUTS, OUTPUTS, SECOND, TABLE, printed, programs
from .twofold import uncontracted, written

ARRAYS = (types.float64[::1],) * 5


def as_rates(text: str) -> str:
    """Return a function of (y, out) as a right-hand side."""
    return text.replace("def f(y, out):", "def rhs(t, y, p, w, iw, ydot):").replace("out[", "ydot[")


def loaded(folder, text: str):
    return load_module(written(folder, TABLE, HUMP, SECOND, as_rates(text), head=HEAD)).rhs


def at_each(rhs, times, states, p, w) -> tuple[np.ndarray, list[int]]:
    """Return rates and results of a right-hand side, node by node."""
    rates, results = np.zeros_like(states), []
    for k in range(NODES):
        rate = np.zeros(len(states))
        arguments = float(times[k]), states[:, k].copy(), p.copy(), w.copy(), np.zeros(16, dtype=np.int64), rate
        results.append(rhs(*arguments))
        rates[:, k] = rate
    return rates, results


def at_once(rhs, times, states, p, w) -> tuple[np.ndarray, int]:
    """Return rates and the result at all nodes."""
    rates = np.zeros(states.size)
    result = NodesFunction(rhs).caller(ARRAYS)(times, states.ravel(), p, w, rates)
    return rates.reshape(states.shape), result


@pytest.mark.slow
@given(program=programs())
@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True, database=None)
def test_random_programs(tmp_path_factory, program):
    states = np.random.default_rng(7).uniform(-2.0, 3.0, (max(INPUTS, OUTPUTS), NODES))
    with uncontracted():
        rhs = loaded(tmp_path_factory.mktemp("nodes"), printed(*program))
        found, result = at_once(rhs, np.zeros(NODES), states, np.zeros(1), np.zeros(1))
        expected, results = at_each(rhs, np.zeros(NODES), states, np.zeros(1), np.zeros(1))
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12)
    assert result & SUSPICIOUS == max(results)


@pytest.mark.by_turns(4)
@pytest.mark.fast("four-bar-lagrange", "slider-crank-penalty", "slider-crank-udwadia-kalaba")
@pytest.mark.parametrize("method", ["lagrange", "baumgarte", "penalty", "udwadia-kalaba"])
@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "spatial-slider-crank", "cam-follower", "engine"])
def test_laws_of_mechanisms(name, method):
    model = symgen.load(name)
    compiled = add_integrals(model.mechanism, compile_model(model.mechanism, choose_method(method)))
    start = model.assemble(compiled)
    derive, there = rates_at_nodes(compiled)
    assert there == 1
    rng, n = np.random.default_rng(3), compiled.info.ny
    states = start.y[:n, np.newaxis] + 1e-3 * rng.standard_normal((n, NODES))
    times, rates = np.linspace(0.0, 0.3, NODES), np.zeros(n * NODES)
    derive.caller(ARRAYS)(times, states.ravel(), start.p, start.w.copy(), rates)
    expected, _ = at_each(compiled.law_module.rhs, times, states, start.p, start.w)
    # penalties multiply the rounding of what they hold back
    allowed = (1e-6 if method == "penalty" else 1e-9) * np.abs(expected).max()
    np.testing.assert_allclose(rates.reshape(n, NODES), expected, rtol=0.0, atol=allowed)


def test_a_large_angle_and_a_suspicious_pivot_are_reported(tmp_path):
    text = """
def f(y, out):
    out[0] = math.sin(y[0])
    out[1] = math.cos(y[0])
    return int(y[1] < 0.0)
"""
    rhs, states = loaded(tmp_path, text), np.ones((INPUTS, NODES))
    numbers = np.zeros(NODES), np.zeros(1), np.zeros(1)
    assert at_once(rhs, numbers[0], states, *numbers[1:])[1] == 0
    states[1, 5] = -1.0
    assert at_once(rhs, numbers[0], states, *numbers[1:])[1] == SUSPICIOUS
    states[0, 2] = 1e6
    assert at_once(rhs, numbers[0], states, *numbers[1:])[1] == SUSPICIOUS | FAR
    states[0, 2] = np.nan
    rates, result = at_once(rhs, numbers[0], states, *numbers[1:])
    assert result & FAR
    assert np.isnan(rates[0, 2])


def test_sines_are_those_of_the_library(tmp_path):
    text = """
def f(y, out):
    out[0] = math.sin(y[0])
    out[1] = math.cos(y[0])
    return 0
"""
    rhs, rng = loaded(tmp_path, text), np.random.default_rng(11)
    for size in (1e-9, 1e-3, 1.0, 30.0, 1e3, 3e5):
        states = np.zeros((INPUTS, NODES))
        for _ in range(50):
            states[0] = rng.uniform(-size, size, NODES)
            rates, result = at_once(rhs, np.zeros(NODES), states, np.zeros(1), np.zeros(1))
            assert result == 0
            np.testing.assert_allclose(rates[0], np.sin(states[0]), rtol=3e-16, atol=3e-16)
            np.testing.assert_allclose(rates[1], np.cos(states[0]), rtol=3e-16, atol=3e-16)


@pytest.mark.parametrize(
    "body",
    [
        "    for i in range(2):\n        ydot[i] = y[i]\n    return 0",
        "    k = int(p[0])\n    ydot[0] = y[k]\n    return 0",
        "    y[0] = 1.0\n    return 0",
    ],
)
def test_other_code_has_no_such_form(tmp_path, body):
    rhs = load_module(written(tmp_path, f"def rhs(t, y, p, w, iw, ydot):\n{body}\n", head=HEAD)).rhs
    array, whole = types.float64[::1], types.int64[::1]
    from symgen.compile.native.node_functions import node_module

    with pytest.raises(Foreign):
        node_module(
            rhs.read((types.float64, array, array, array, whole, array)), "f", lambda f: f.name, lambda f: False
        )


@pytest.mark.parametrize("method", ["augmented-lagrangian", "null-space", "coordinate-partitioning"])
def test_laws_that_iterate_are_evaluated_node_by_node(method):
    compiled = compile_model(symgen.load("four-bar").mechanism, choose_method(method))
    assert rates_at_nodes(compiled)[1] == 0
