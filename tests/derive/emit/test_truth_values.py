"""Conditions of parameters beside others: computed once a run they are numbers, no truth values."""

import numpy as np
import pytest

import symgen
from symgen.api import Model
from symgen.base.errors import InputError
from symgen.describe.files.builder import MechanismBuilder

#: A force, and how far it moves 1 kg in 1 s, from rest: closed forms for a = 0.7, b = 2.
FORCES = {
    "2 if a > 0.5 and t > 0.3 else 0": 0.7**2,
    "2 if t > 0.3 and a > 0.5 else 0": 0.7**2,
    "1 if (a > 0.5 or b < 1) and not (t < 0.2) else 0": 0.5 * 0.8**2,
    "1 if t > 0.4 or not (a > 0.5) else 0": 0.5 * 0.6**2,
    "1 if a > 0.5 and b > 1 and t > 0.5 and not (b > 3) else 0": 0.5 * 0.5**2,
    "2*b if (a > 1 or t > 0.3) and (b > 1 or t > 2) else 0": 2.0 * 0.7**2,
}


def pushed(force: str) -> Model:
    built = MechanismBuilder("pushed", gravity=(0.0, 0.0)).run(until=1.0).parameter("a", 0.7).parameter("b", 2.0)
    return symgen.load(
        built.body("m", type="point", mass=1.0).force("f", "force", body="m", force=[force, 0.0]).build()
    )


@pytest.mark.by_turns(3)
@pytest.mark.fast("1 if a > 0.5 and b > 1 and t > 0.5 and not (b > 3) else 0")
@pytest.mark.parametrize("force", FORCES)
def test_single_runs(force):
    for settings in ({}, {"coordinates": "joint"}, {"shape": "looped"}):
        run = pushed(force).simulate(integrator="dopri5", rtol=1e-9, atol=1e-9, **settings)
        assert run.status == "ok"
        # steps find jumps in time by their errors, which a few tolerances leave open
        np.testing.assert_allclose(run.q["m.x"][-1], FORCES[force], atol=1e-6)


@pytest.mark.slow
def test_rows_of_sweeps_choose_by_their_own_parameters():
    model = pushed("2 if a > 0.5 and t > 0.3 else 0")
    rows = {"step": 0.1, "until": 1.0, "integrator": "rk4", "quantities": ("q",)}
    found = symgen.sweep(model, {"a": [0.2, 0.7]}, **rows)
    assert list(found.status) == ["ok", "ok"]
    np.testing.assert_allclose(found["m.x"][:, -1], [0.0, 0.7**2], rtol=1e-13, atol=0.0)
    with pytest.raises(InputError, match="target 'lanes': expected no formulas that jump at times known beforehand"):
        symgen.sweep(model, {"a": [0.2, 0.7]}, target="lanes", **rows)


@pytest.mark.slow
def test_lanes_choose_by_their_own_parameters():
    found = symgen.sweep(
        *(pushed("2 if a > 0.5 and b > 1 else 0"), {"a": [0.2, 0.7]}),
        **{"step": 0.1, "until": 1.0, "integrator": "rk4", "quantities": ("q",), "target": "lanes"},
    )
    np.testing.assert_allclose(found["m.x"][:, -1], [0.0, 1.0], rtol=1e-13, atol=0.0)
