"""Functions with directions: their derivatives are those of the same statements in 50 digits."""

import inspect
import re

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

import symgen
from symgen.compile.native.machine import optimise_module
from symgen.compile.native.read_values import Foreign
from symgen.compile.native.tangents import tangent_module
from symgen.compile.store.emitted import EmittedFunction, TangentFunction
from symgen.compile.store.loaded_modules import load_module
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model

from .exactly import derivative
from .test_operations import HEAD, HUMP, SECOND, TABLE, printed, programs
from .twofold import arguments_of, written

LANES = 3


def directed(function, values, rates) -> tuple[list, list]:
    """Return the arrays of a function after its call, and their directions.

    Parameters
    ----------
    values : tuple
        Numbers and arrays.
    rates : dict of int to array, shape (n, L)
        Directions before the call, by position among the arguments.
    """
    names = list(inspect.signature(function.py_func).parameters)
    places = {names[i]: len(values[i]) for i in rates}
    longer = [np.concatenate([v, rates[i].ravel()]) if i in rates else v for i, v in enumerate(values)]
    lanes = next(iter(rates.values())).shape[1]
    TangentFunction(function, lanes, places).caller(arguments_of(function))(*longer)
    shown = {i: longer[i][len(values[i]) :].reshape(-1, lanes) for i in rates}
    return [longer[i][: len(values[i])] if i in rates else longer[i] for i in range(len(values))], shown


def emitted(compiled) -> list[EmittedFunction]:
    """Return all emitted functions of numbers and arrays, each once."""
    found = [f for m in (compiled.model, compiled.law_module) for f in vars(m).values()]
    return list({id(f): f for f in found if isinstance(f, EmittedFunction) and f.__name__ != "side"}.values())


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "method"),
    [
        ("four-bar", "direct-correction"),
        ("four-bar", "penalty"),
        ("cam-follower", "energy-projection"),
        ("rolling-disc", "augmented-lagrangian"),
        ("spatial-slider-crank", "null-space"),
    ],
)
def test_every_function_of_a_model(name, method):
    model = symgen.load(name)
    compiled = compile_model(model.mechanism, choose_method(method))
    start, rng = model.assemble(compiled), np.random.default_rng(1)
    n, seen = compiled.info.ny, set()
    y = start.y[:n] + 1e-4 * rng.standard_normal(n)
    for function in emitted(compiled):
        rooms = {"y": y, "p": start.p, "w": start.w, "iw": np.zeros(40, dtype=np.int64), "ydot": np.zeros(n)}
        rooms |= {"t": 0.3, "x": 0.4, "out": np.zeros(500)}
        names = list(inspect.signature(function.py_func).parameters)
        if not set(names) <= set(rooms):
            continue
        values = tuple(np.copy(rooms[p]) if isinstance(rooms[p], np.ndarray) else rooms[p] for p in names)
        scales = {"y": np.ones(n), "p": 0.3 * np.abs(start.p), "w": 0.3 * np.abs(start.w)}
        rates = {
            i: rng.standard_normal((len(values[i]), LANES)) * scales.get(p, np.zeros(len(values[i])))[:, np.newaxis]
            for i, p in enumerate(names)
            if p not in ("t", "x", "iw")
        }
        if not rates:
            continue
        _, shown = directed(function, values, rates)
        expected = derivative(function, values, {i: rate[:, 1] for i, rate in rates.items()})
        seen.add(function.__name__)
        for i in rates:
            # iterations that go on in 50 digits leave other last changes behind
            if function.__name__ == "accept" and names[i] == "w":
                continue
            allowed = (1e-6 if method == "penalty" else 1e-11) * max(np.abs(expected[i]).max(), 1e-30)
            np.testing.assert_allclose(
                shown[i][:, 1], expected[i], rtol=0.0, atol=allowed, err_msg=f"{function.__name__}, {names[i]}"
            )
    assert {"prepare", "geometry", "rhs", "accept"} <= seen


@given(program=programs())
@settings(max_examples=8, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True, database=None)
def test_random_programs(tmp_path_factory, program):
    folder = tmp_path_factory.mktemp("tangents")
    function = load_module(written(folder, TABLE, HUMP, SECOND, printed(*program), head=HEAD)).f
    rng = np.random.default_rng(5)
    for _ in range(3):
        values = rng.uniform(0.1, 0.9, 12), np.zeros(8)
        rates = {0: rng.standard_normal((12, LANES)), 1: np.zeros((8, LANES))}
        after, shown = directed(function, values, rates)
        try:
            expected = derivative(function, values, {0: rates[0][:, 1]})[1]
        except (TypeError, ValueError, OverflowError):  # roots of negative numbers are complex there
            continue
        defined = np.isfinite(after[1]) & np.isfinite(expected) & (np.abs(expected) < 1e12)
        np.testing.assert_allclose(shown[1][defined, 1], expected[defined], rtol=1e-8, atol=1e-8)


LOOP = '''
def f(y, out):
    """Products in loops that are left early."""
    total = 1.0
    k = 0
    while True:
        total = total * y[k]
        k += 1
        if k >= 4:
            break
    for i in range(3):
        if i == 1:
            continue
        total += power(y[i], total) if total > 0.0 else -power(y[i + 1], total)
    out[0] = total
    out[1] = max(total, abs(y[5] - total)) ** 3
    return 0
'''
POWER = '''
def power(base, exponent):
    """A power of a product."""
    if base > 0.5:
        return math.pow(base, 0.1 * exponent)
    return math.atan2(base, exponent) + math.copysign(base, exponent)
'''


def test_loops_choices_and_calls(tmp_path):
    function = load_module(written(tmp_path, POWER, LOOP)).f
    rng = np.random.default_rng(2)
    for sign in (1.0, -1.0):
        values = np.array([0.7, sign * 0.4, 1.1, 0.9, 0.3, 2.0]), np.zeros(2)
        rates = {0: rng.standard_normal((6, LANES)), 1: np.zeros((2, LANES))}
        after, shown = directed(function, values, rates)
        plain = np.zeros(2)
        function(values[0], plain)
        np.testing.assert_allclose(after[1], plain, rtol=1e-14)
        for lane in range(LANES):
            expected = derivative(function, values, {0: rates[0][:, lane]})[1]
            np.testing.assert_allclose(shown[1][:, lane], expected, rtol=1e-13)


STEPS = "".join(f"    x{i + 1} = math.sin(x{i}) + y[{i % 6}]\n" for i in range(70))
LONG = f"def long(y, out):\n    x0 = out[1]\n{STEPS}    out[0] = x70 * out[0]\n    return 0\n"
BOTH = "def f(y, out):\n    long(y, out)\n    long(out, y)\n    long(y, out)\n    return 0\n"


def test_a_long_callee_has_code_of_its_own_for_calls_with_the_same_arrays(tmp_path):
    function = load_module(written(tmp_path, LONG, BOTH)).f
    rng = np.random.default_rng(4)
    values = rng.uniform(0.1, 0.9, 6), rng.uniform(0.1, 0.9, 6)
    rates = {0: rng.standard_normal((6, LANES)), 1: rng.standard_normal((6, LANES))}
    _, shown = directed(function, values, rates)
    expected = derivative(function, values, {i: rate[:, 1] for i, rate in rates.items()})
    for i in rates:
        np.testing.assert_allclose(shown[i][:, 1], expected[i], rtol=1e-12, atol=1e-12)
    entry = TangentFunction(function, LANES, {"y": 6, "out": 6}).compiled_entry(arguments_of(function), "f")
    assert [name for name, _ in entry.called] == ["long"]


INNER = """
def inner(y, out):
    out[5] = y[0] * out[5]
    return 0
"""
ANGLES = "".join(f"    a{i} = y[{i}] * y[0]\n" for i in range(6))
SINES = " + ".join(f"math.sin(a{i})" for i in range(6))
TURNED = f"""
def f(y, out):
{ANGLES}    out[0] = {SINES}
    for i in range(3):
        inner(y, out)
    return 0
"""


def test_functions_of_a_module_agree_on_registers_for_directions(tmp_path):
    function = load_module(written(tmp_path, INNER, TURNED)).f
    rng = np.random.default_rng(6)
    values = rng.uniform(0.1, 0.9, 6), rng.uniform(0.1, 0.9, 6)
    rates = {0: rng.standard_normal((6, 8)), 1: rng.standard_normal((6, 8))}
    _, shown = directed(function, values, rates)
    expected = derivative(function, values, {i: rate[:, 1] for i, rate in rates.items()})
    for i in rates:
        np.testing.assert_allclose(shown[i][:, 1], expected[i], rtol=1e-12, atol=1e-12)
    text = tangent_module(function.read(arguments_of(function)), "f", 8, {"y": 6, "out": 6})
    assert len(set(re.findall(r'"min-legal-vector-width"="\d+"', str(optimise_module(text))))) == 1


def test_an_array_without_directions_is_refused(tmp_path):
    function = load_module(written(tmp_path, POWER, LOOP)).f
    with pytest.raises(Foreign, match="the array 'out' without directions"):
        tangent_module(function.read(arguments_of(function)), "f", LANES, {"y": 6})
