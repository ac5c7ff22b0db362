"""Derivatives through the residual and the factor that is there: against the derivatives of the whole elimination."""

import numpy as np
import pytest

from symgen import Settings, load
from symgen.ir.graph import Graph
from symgen.ir.program import BY_RESIDUAL
from symgen.layout import abi
from symgen.lower.residual import slopes
from symgen.native import types
from symgen.result.sensitivities import prepared
from symgen.running.prepare import prepare
from symgen.runs.directed_model import DirectedModel
from symgen.store.emitted import AdjointFunction

LANES = 2


@pytest.mark.parametrize(
    ("name", "coordinates", "method"),
    [
        ("four-bar", "absolute", "baumgarte"),
        ("four-bar", "joint", "lagrange"),
        ("andrews", "absolute", "direct-correction"),
        ("andrews", "joint", "direct-correction"),
        ("spatial-slider-crank", "absolute", "lagrange"),
        ("rolling-disc", "joint", "lagrange"),
    ],
)
def test_both_ways_have_the_same_derivatives(name, coordinates, method):
    settings = Settings(method=method, integrator="dop853", coordinates=coordinates, until=0.1)
    run, _ = prepared(load(name).mechanism, settings)
    model, law, start, rng = (
        DirectedModel(run.compiled, LANES),
        run.compiled.law_module,
        run.start,
        np.random.default_rng(3),
    )
    sizes, kind = model.sizes, abi.RHS.signature.arguments
    y = model.longer(start.y + 0.01 * rng.standard_normal(len(start.y)), "y", rng.standard_normal((sizes["y"], LANES)))
    seeds = np.zeros((sizes["p"], LANES))
    own = len(run.compiled.info.parameters)
    seeds[:own] = rng.standard_normal((own, LANES)) * np.abs(start.p[:own, np.newaxis])
    p = model.parameters(start.p, seeds)
    found = {}
    for function in (law.rhs, getattr(law, BY_RESIDUAL)):
        w, rates, counters = model.longer(start.w, "w"), model.longer(start.y * 0.0, "y"), np.zeros(40, dtype=np.int64)
        model.function(function).caller(kind)(0.3, y, p, w, counters, rates)
        first, size = run.compiled.info.sections["multipliers"]
        found[function] = rates[: sizes["y"]], model.shadow(rates, "y"), model.shadow(w, "w")[first : first + size]
    (values, by_state, by_rows), (others, through, of_rows) = found.values()
    assert others == pytest.approx(values, rel=1e-13, abs=1e-13 * np.abs(values).max())
    assert through == pytest.approx(by_state, rel=1e-10, abs=1e-12 * np.abs(by_state).max())
    assert of_rows == pytest.approx(by_rows, rel=1e-10, abs=1e-12 * np.abs(by_rows).max())

    ends = rng.standard_normal(sizes["y"])
    bars = [np.zeros(sizes[array]) for array in ("y", "p", "w")]
    plain = y[: sizes["y"]].copy(), p[: sizes["p"]].copy(), start.w.copy()
    adjoint = AdjointFunction(getattr(law, BY_RESIDUAL)).caller((*kind, *[types.float64[::1]] * 4))
    adjoint(0.3, *plain, counters, np.zeros(sizes["y"]), *bars, ends.copy())
    inner = bars[0] @ model.shadow(y, "y") + bars[1] @ model.shadow(p, "p")
    assert inner == pytest.approx(ends @ by_state, rel=1e-10)


def test_only_runs_with_derivatives_have_it():
    settings = Settings(method="lagrange", integrator="dop853", until=0.1)
    mechanism = load("four-bar").mechanism
    assert hasattr(prepared(mechanism, settings)[0].compiled.law_module, BY_RESIDUAL)
    assert not hasattr(prepare(mechanism, settings).compiled.law_module, BY_RESIDUAL)


def test_products_in_derivatives():
    g = Graph()
    x, k = g.input("q", 0), g.input("p", 0)
    product, square = g.mul(x, k), g.mul(x, x)
    assert slopes(g, [product]) == 2
    assert slopes(g, [g.add(square, product)]) == 4
    assert slopes(g, [g.mul(g.call("held", square), product)]) == 3
    assert slopes(g, [g.call("carried", square, x)]) == 0
    assert slopes(g, [g.mul(g.input("w", 0), g.constant(2.0))]) == 0
