"""Formulas of a run in a module of their own: values, rates along the motion, angles that count turns, the cache."""

import math

import numpy as np
import pytest
from support.both_shapes import spatial
from support.emitted import mechanism_of
from support.models import EVERYTHING, ROUGH

from symgen.api import load
from symgen.compile.native import types
from symgen.compile.store.jit import jit
from symgen.compile.store.paths import ENVIRONMENT_VARIABLE
from symgen.derive.formulate.formulate import formulate
from symgen.derive.formulate.measure_nodes import ModelNodes as Derivation
from symgen.derive.lower.looped.instances import instances_of_mechanism
from symgen.derive.lower.windings import winding_order
from symgen.describe import catalogue
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.parts.context import Context
from symgen.run.compiling.side import compile_side
from symgen.run.layout.abi import OBSERVE

CRANK = "sin(crank.theta)*rod.vx + k*t**2"


_A = types.float64[::1]


@jit(types.int64(OBSERVE, types.float64, _A, _A, _A, _A, _A))
def entered(function, t, y, p, w, ydot, out):
    return function(t, y, p, w, ydot, out)


def names_of(mechanism) -> FormulaNames:
    known = Context(
        "test", {p.name: p.value for p in mechanism.parameters}, (), {b.name: b for b in mechanism.bodies}, None
    )
    return FormulaNames("a formula", {n: n for n in (*known.values, "t")}, known.coordinates)


def slider_crank():
    raw = catalogue.raw("slider-crank")
    return load(mechanism_of({**raw, "parameters": {**raw.get("parameters", {}), "k": 1.7}}))


@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_values_and_rates_are_those_of_the_formula(shape):
    model = slider_crank()
    compiled = model.compile(shape=shape)
    formulas = [(text, parse(text, names_of(model.mechanism), "test")) for text in (CRANK, "slider.x", "min(t, 2)")]
    side = compile_side(model.mechanism, compiled, "trial", "A trial", formulas, rates=1)
    info, rng = compiled.info, np.random.default_rng(2)
    q, v = [c.name for c in info.coordinates], [c.name for c in info.velocities]
    y, ydot = rng.standard_normal(info.ny), rng.standard_normal(info.ny)
    k = compiled.parameter_array(model.parameters(), {})
    theta, omega = y[q.index("crank.theta")], y[info.nq + v.index("crank.omega")]
    vx, ax = y[info.nq + v.index("rod.vx")], ydot[info.nq + v.index("rod.vx")]
    expected = [
        math.sin(theta) * vx + 1.7 * 0.3**2,
        y[q.index("slider.x")],
        0.3,
        math.cos(theta) * omega * vx + math.sin(theta) * ax + 2 * 1.7 * 0.3,
        y[info.nq + v.index("slider.vx")],
        1.0,
    ]
    found = side(0.3, y, k, compiled.scratch(), ydot)
    np.testing.assert_allclose(found, expected, rtol=1e-14)
    out = np.zeros(6)
    entered(side.function, 0.3, y, k, compiled.scratch(), ydot, out)
    np.testing.assert_allclose(out, expected, rtol=1e-14)


def test_nothing_of_the_model_is_made_anew_and_the_module_is_found_again(tmp_path, monkeypatch):
    model = slider_crank()
    compiled = model.compile()
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(tmp_path))
    formulas = [("x", parse("slider.x", names_of(model.mechanism), "test"))]
    first = compile_side(model.mechanism, compiled, "trial", "A trial", formulas)
    files = sorted(path.name for path in tmp_path.rglob("*.py"))
    assert [name.partition("_")[0] for name in files] == ["trial"]
    again = compile_side(model.mechanism, compiled, "trial", "A trial", formulas)
    assert again.function is first.function
    other = compile_side(model.mechanism, compiled, "trial", "A trial", formulas, rates=1)
    assert other.function is not first.function
    assert len(list(tmp_path.rglob("trial_*.py"))) == 2


@pytest.mark.slow_cases("stewart-platform")
@pytest.mark.parametrize("name", [*catalogue.names(), "everything", "rough", "spatial"])
def test_angles_stand_where_each_shape_has_them(name):
    made = {"everything": EVERYTHING, "rough": ROUGH}
    mechanism = (
        spatial().mechanism if name == "spatial" else mechanism_of(made[name]) if name in made else load(name).mechanism
    )
    equations, order = formulate(mechanism), winding_order(mechanism, "straight")
    assert len(order) == len(equations.windings)
    model = Derivation(mechanism, equations.graph)  # nodes that are there already are found again
    assert [model.measure(m).value for m in order] == list(equations.windings)
    in_loops = dict.fromkeys(angle for instance in instances_of_mechanism(mechanism) for angle in instance.angles)
    assert tuple(in_loops) == winding_order(mechanism, "looped")
