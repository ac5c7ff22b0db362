"""The dense orthogonal factorisation: redundant rows, light and massless bodies, and what it says of itself."""

import numpy as np
import pytest
from support.emitted import Emitted, mechanism_of
from support.models import EVERYTHING

from benchmarks import robustness
from symgen.api import load
from symgen.base.ir.program import COUNTERS, STATUS
from symgen.describe import load as describe

DENSE = {"method.solver": "dense"}


@pytest.mark.slow
def test_it_gives_the_motion_of_the_elimination_and_says_what_it_met():
    keys = {"method": "direct-correction", "integrator": "rk4", "step": 1e-3, "until": 0.5}
    dense, usual = (load("four-bar").simulate(options=o, **keys) for o in (DENSE, {}))
    assert dense.status == usual.status == "ok"
    np.testing.assert_allclose(np.asarray(dense.q), np.asarray(usual.q), rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(np.asarray(dense.lam), np.asarray(usual.lam), rtol=0.0, atol=1e-10)
    said = "accelerations solved by dense orthogonal factorisation in 2000 evaluations, rank 8 of 8 rows"
    assert dense.notes == (said,) and not usual.notes


@pytest.mark.slow
def test_redundant_rows():
    times = np.linspace(0.0, 1.0, 11)
    result = robustness.parallel_four_bar().simulate(
        method="lagrange", integrator="dop853", rtol=1e-11, atol=1e-12, until=1.0, times=times, options=DENSE
    )
    assert result.status == "ok" and any("rank 11 of 12 rows" in note for note in result.notes)
    np.testing.assert_allclose(np.asarray(result.q), robustness.parallel_motion(times), rtol=0.0, atol=1e-9)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("factor", [1.0, 1e-9, 1e-15])
def test_light_bodies_do_no_harm(factor):
    times = np.linspace(0.0, 1.0, 6)
    model, changed = load("four-bar"), {"coupler_mass": 8.0 * factor}
    keys = {"rtol": 1e-11, "atol": 1e-12, "until": 1.0, "times": times, "parameters": changed, "options": DENSE}
    result = model.simulate(method="lagrange", integrator="dop853", **keys)
    assert result.status == "ok" and not result.warnings
    exact = robustness.null_space_motion(factor, times)
    np.testing.assert_allclose(np.asarray(result.q), exact, rtol=0.0, atol=1e-8)


def test_a_row_that_is_masked_has_no_multiplier_and_is_not_kept():
    emitted = Emitted(mechanism_of(EVERYTHING), "lagrange", {"solver": "dense"})
    nv, m = emitted.info.nv, emitted.info.m
    values = {"k1": 1.7, "k2": -0.6, "m1": 2.5}
    p = emitted.parameters({q.name: values[q.name] for q in emitted.info.parameters})
    y = np.concatenate([np.random.default_rng(3).uniform(-1.0, 1.0, 2 * nv), [0.0]])
    kept = [i for i in range(m) if i != 1]
    for masked in ((), (1,)):
        w, iw, rate = emitted.scratch(), np.zeros(len(COUNTERS), dtype=np.int64), np.zeros(len(y))
        emitted.section(w, "mask")[list(masked)] = np.inf
        emitted.call(emitted.model, "masses", p, w)
        emitted.call(emitted.law, "rhs", 0.3, y, p, w, iw, rate)
        assert iw[COUNTERS.index("dense_rank")] == min(m - len(masked), nv)
        target, multipliers = emitted.section(w, "residual"), emitted.section(w, "multipliers")
        rest = np.abs(emitted.dense(w) @ rate[nv : 2 * nv] - target) / np.abs(target).max()
        assert rest[kept].max() < 1e-10
        assert (rest[1] > 1e-4 and multipliers[1] == 0.0) if masked else rest[1] < 1e-10


@pytest.mark.parametrize("name", ["four-bar", "andrews", "n-four-bar:2"])
def test_no_dependent_coordinate_follows_faster_than_an_independent_one(name):
    """After exchanges no entry of D_u^-1 D_w exceeds 1.01; the quality is that of D P D^T against D D^T."""
    emitted, model = Emitted(describe(name), "coordinate-partitioning"), load(name)
    values = model.parameters()
    q, p = np.asarray(model.initial_state(values)[0]), emitted.parameters(values)
    part = next(m for m in emitted.modules.values() if hasattr(m, "choose") and hasattr(m, "DEPENDENT"))
    dependents = slice(part.DEPENDENT, part.DEPENDENT + emitted.info.nv)
    rng = np.random.default_rng(len(name))
    for _ in range(5):
        w, iw = emitted.scratch(), np.zeros(len(COUNTERS), dtype=np.int64)
        y = np.concatenate([q + rng.uniform(-0.5, 0.5, len(q)), np.zeros(emitted.info.nv + 1)])
        w[dependents] = 1.0
        emitted.call(emitted.law, "geometry", 0.0, y, p, w)
        emitted.call(part, "choose", p, w, iw)
        dependent = w[dependents] == 1.0
        d = emitted.dense(w)
        assert dependent.sum() == emitted.info.m
        assert np.abs(np.linalg.solve(d[:, dependent], d[:, ~dependent])).max() <= 1.01 + 1e-9
        emitted.call(emitted.law, "geometry", 0.0, y, p, w)
        quality = emitted.section(w, "status")[STATUS.index("partition_quality")]
        block = d[:, dependent]
        assert quality == pytest.approx(np.linalg.det(block @ block.T) / np.linalg.det(d @ d.T), rel=1e-6)
