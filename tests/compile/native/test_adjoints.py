"""Adjoints of emitted functions: against directional derivatives, whose rules print other code, by inner products."""

import numpy as np
import pytest

from symgen import Settings, load
from symgen.compile.native import types
from symgen.compile.store.emitted import AdjointFunction, TangentFunction
from symgen.run.layout import abi
from symgen.run.planning.prepare import prepare

ARRAY = types.float64[::1]


def compiled(name, coordinates, method="lagrange"):
    settings = Settings(method=method, integrator="dop853", coordinates=coordinates, until=0.1, shape="straight")
    return prepare(load(name).mechanism, settings)


@pytest.mark.by_turns(3)
@pytest.mark.fast("four-bar-absolute", "four-bar-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", ["four-bar", "andrews", "spatial-slider-crank", "flying-spaghetti"])
def test_inner_products(name, coordinates):
    run = compiled(name, coordinates)
    law, info, rng = run.compiled.law_module, run.compiled.info, np.random.default_rng(3)
    start, ny, arguments = run.start, info.ny, abi.RHS.signature.arguments
    y, p, w = start.y + 0.01 * rng.standard_normal(ny), start.p.copy(), start.w.copy()
    counters, end = np.zeros(abi.N_COUNTERS, dtype=np.int64), rng.standard_normal(ny)
    bars = [np.zeros_like(array) for array in (y, p, w)]
    before = end.copy()
    AdjointFunction(law.rhs).caller((*arguments, *[ARRAY] * 4))(0.3, y, p, w, counters, np.zeros(ny), *bars, end)
    assert not end.any()  # what was stored depends on nothing before

    lanes, places = 2, {"y": ny, "ydot": ny, "p": len(p), "w": len(w)}
    directions = [rng.standard_normal((len(array), lanes)) for array in (y, p, w)]
    longer = [np.concatenate([a, d.ravel()]) for a, d in zip((y, p, w), directions, strict=True)]
    rates = np.zeros(ny * (1 + lanes))
    TangentFunction(law.rhs, lanes, places).caller(arguments)(0.3, *longer, counters, rates)
    expected = before @ rates[ny:].reshape(ny, lanes)
    found = sum(bar @ d for bar, d in zip(bars, directions, strict=True))
    assert found == pytest.approx(expected, rel=1e-10)
