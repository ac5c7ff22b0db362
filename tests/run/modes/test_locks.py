"""Machines that lock: where their drivers can go no further, all ways to move them end with one sentence."""

import pytest
from support.emitted import mechanism_of
from support.locks import LOCKED, parts

import symgen


@pytest.mark.slow_cases(
    "picard-None-1e-06-four-bar-lock", "picard-None-1e-06-slider-lock", "dop853-None-1e-06-four-bar-lock"
)
@pytest.mark.parametrize("name", LOCKED)
@pytest.mark.parametrize(
    ("integrator", "step", "tolerance"),
    [
        ("picard", None, 1e-6),
        ("dop853", None, 1e-6),
        ("radau5", None, 1e-3),
        ("sdirk", None, 1e-3),
        ("rk4", 1e-3, 2e-3),
    ],
)
def test_a_run_ends_where_kinematics_does_with_its_sentence(name, integrator, step, tolerance):
    description, expected, free = LOCKED[name]
    model = symgen.load(mechanism_of(description))
    moved = parts(model.kinematics([0.0, 0.3, 1.0]).ended)
    assert moved[0] == pytest.approx(expected, abs=1e-6) and moved[1] == "'motor'" and moved[2] >= free
    result = model.simulate(integrator=integrator, step=step, until=2.0, verify=False)
    assert result.status == "failed"
    found = parts(result.reason)
    assert found[0] == pytest.approx(expected, abs=tolerance) and found[1:] == moved[1:]


@pytest.mark.parametrize("name", LOCKED)
@pytest.mark.parametrize("integrator", ["picard", "dop853", "radau5", "sdirk"])
def test_few_attempts_are_enough_at_a_lock(name, integrator):
    """The way there has attempts of its own: those of the last millisecond count.

    Newton's method in an implicit step meets rounding there, and how often differs between machines.
    """
    description, expected, _ = LOCKED[name]
    model = symgen.load(mechanism_of(description))
    settings = {"integrator": integrator, "verify": False}
    before = model.simulate(until=expected - 1e-3, **settings)
    result = model.simulate(until=2.0, **settings)
    assert before.ok and result.status == "failed"
    assert result.steps + result.rejected - before.steps - before.rejected <= (
        4000 if integrator in ("radau5", "sdirk") else 500
    )
