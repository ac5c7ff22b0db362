"""Derivatives through the residual and the factor that is there: against the derivatives of the whole elimination."""

import numpy as np
import pytest

from symgen import Settings, load
from symgen.base.ir.graph import Graph
from symgen.base.ir.program import BY_RESIDUAL, COUNTERS, SLOPES
from symgen.compile.native import types
from symgen.compile.store.emitted import AdjointFunction
from symgen.derive.lower.residual import count_slope_products
from symgen.result.sensitivities import prepare_for_directions
from symgen.run.directions.directed_model import DirectedModel
from symgen.run.layout import abi
from symgen.run.planning.prepare import prepare

LANES = 2


def differentiated(name, coordinates, method, disturbance=0.01):
    """Return a run, its model with directions, a generator, and the state and parameters with random directions."""
    settings = Settings(method=method, integrator="dop853", coordinates=coordinates, until=0.1)
    run, _ = prepare_for_directions(load(name).mechanism, settings)
    model, start, rng = DirectedModel(run.compiled, LANES), run.start, np.random.default_rng(3)
    y = start.y + disturbance * rng.standard_normal(len(start.y))
    y = model.room_with_directions(y, "y", rng.standard_normal((model.sizes["y"], LANES)))
    seeds = np.zeros((model.sizes["p"], LANES))
    own = len(run.compiled.info.parameters)
    seeds[:own] = rng.standard_normal((own, LANES)) * np.abs(start.p[:own, np.newaxis])
    return run, model, rng, y, model.parameters(start.p, seeds)


def values_and_directions(run, model, function, y, p, w):
    """Return rates, their directions and those of the multipliers, and the counters."""
    w, rates = model.room_with_directions(w, "w"), model.room_with_directions(run.start.y * 0.0, "y")
    counters = np.zeros(40, dtype=np.int64)
    model.function(function).caller(abi.RHS.signature.arguments)(0.3, y, p, w, counters, rates)
    first, size = run.compiled.info.sections["multipliers"]
    shown = model.directions_after(rates, "y"), model.directions_after(w, "w")[first : first + size]
    return rates[: model.sizes["y"]], *shown, counters


def compare(found):
    """Compare values and directions of two functions."""
    (values, by_state, by_rows, _), (others, through, of_rows, _) = found
    assert others == pytest.approx(values, rel=1e-13, abs=1e-13 * np.abs(values).max())
    assert through == pytest.approx(by_state, rel=1e-10, abs=1e-12 * np.abs(by_state).max())
    assert of_rows == pytest.approx(by_rows, rel=1e-10, abs=1e-12 * np.abs(by_rows).max())


@pytest.mark.by_turns(3)
@pytest.mark.fast("four-bar-joint-lagrange")
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
    run, model, rng, y, p = differentiated(name, coordinates, method)
    law, start, sizes = run.compiled.law_module, run.start, model.sizes
    found = [values_and_directions(run, model, f, y, p, start.w) for f in (law.rhs, getattr(law, BY_RESIDUAL))]
    compare(found)

    ends = rng.standard_normal(sizes["y"])
    bars = [np.zeros(sizes[array]) for array in ("y", "p", "w")]
    plain = y[: sizes["y"]].copy(), p[: sizes["p"]].copy(), start.w.copy()
    arguments = *abi.RHS.signature.arguments, *[types.float64[::1]] * 4
    adjoint, counters = AdjointFunction(getattr(law, BY_RESIDUAL)).caller(arguments), np.zeros(40, dtype=np.int64)
    adjoint(0.3, *plain, counters, np.zeros(sizes["y"]), *bars, ends.copy())
    inner = bars[0] @ model.directions_after(y, "y") + bars[1] @ model.directions_after(p, "p")
    assert inner == pytest.approx(ends @ found[0][1], rel=1e-10)


@pytest.mark.by_turns(3)
@pytest.mark.fast("slider-crank-absolute-0")
@pytest.mark.parametrize(
    ("name", "coordinates", "left_out"),
    [
        ("bricard", "absolute", 1),
        ("bricard", "joint", 1),
        ("slider-crank", "absolute", 0),
        ("rolling-disc", "joint", 0),
    ],
)
def test_confirmed_rates_have_the_same_derivatives_without_the_rows_left_out(name, coordinates, left_out):
    run, model, _, y, p = differentiated(name, coordinates, "lagrange", disturbance=0.0)
    law, w = run.compiled.law_module, run.start.w.copy()
    first, size = run.compiled.info.sections["mask"]
    w[first : first + size] = 0.0
    found = [values_and_directions(run, model, f, y, p, w) for f in (law.confirm, getattr(law, f"confirm{SLOPES}"))]
    compare(found)
    for *_, counters in found:
        assert counters[COUNTERS.index("suspects")] - counters[COUNTERS.index("light")] == left_out


def test_only_runs_with_derivatives_have_it():
    settings = Settings(method="lagrange", integrator="dop853", until=0.1)
    mechanism = load("four-bar").mechanism
    assert hasattr(prepare_for_directions(mechanism, settings)[0].compiled.law_module, BY_RESIDUAL)
    assert not hasattr(prepare(mechanism, settings).compiled.law_module, BY_RESIDUAL)


def test_products_in_derivatives():
    g = Graph()
    x, k = g.input("q", 0), g.input("p", 0)
    product, square = g.mul(x, k), g.mul(x, x)
    assert count_slope_products(g, [product]) == 2
    assert count_slope_products(g, [g.add(square, product)]) == 4
    assert count_slope_products(g, [g.mul(g.call("held", square), product)]) == 3
    assert count_slope_products(g, [g.call("carried", square, x)]) == 0
    assert count_slope_products(g, [g.mul(g.input("w", 0), g.constant(2.0))]) == 0
