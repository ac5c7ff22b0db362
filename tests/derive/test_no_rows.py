"""Mechanisms without a row of constraints: nothing is corrected, and all methods that differ in it are one."""

import numpy as np
import pytest

import symgen

CORRECTING = ("direct-correction", "velocity-projection", "post-stabilization")


@pytest.mark.parametrize(("name", "coordinates"), [("cart-pole", "joint"), ("free-rigid-body", "absolute")])
def test_states_and_evaluations_are_those_of_lagrange(name, coordinates):
    """A scheme that takes over its last stage evaluates again where a correction says that it changed the state."""
    model = symgen.load(name)
    settings = {"integrator": "dopri5", "rtol": 1e-8, "until": 0.5, "coordinates": coordinates, "verify": False}
    base = model.simulate(method="lagrange", **settings)
    for method in CORRECTING:
        own = model.simulate(method=method, **settings)
        assert (own.steps, own.evaluations) == (base.steps, base.evaluations)
        assert np.array_equal(own.q.values, base.q.values) and np.array_equal(own.v.values, base.v.values)


def test_emitted_code_has_no_correction(tmp_path):
    symgen.load("cart-pole").generate(tmp_path, ["direct-correction"], coordinates="joint")
    text = (tmp_path / "direct_correction.py").read_text()
    assert "nothing is corrected" in text and "spread(" not in text and "refactor(" not in text


@pytest.mark.slow
def test_energy_is_still_balanced_where_no_row_is():
    """Scaling velocities to the energy needs no row."""
    model, settings = symgen.load("chain:2"), {"integrator": "rk4", "step": 2e-2, "until": 2.0, "coordinates": "joint"}
    drift = {
        method: model.simulate(method=method, verify=False, max_energy_error=1.0, **settings).energy_drift_max
        for method in ("lagrange", "energy-projection")
    }
    assert drift["energy-projection"] < 0.1 * drift["lagrange"]
