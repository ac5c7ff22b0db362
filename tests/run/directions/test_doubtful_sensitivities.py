"""Sensitivities that do not exist, or only from one side: refused, noted or unverified, each in one sentence."""

import pytest

import symgen
from symgen import InputError
from symgen.derive.methods import METHODS
from symgen.result.sensitivities import SCHEMES
from symgen.run.integrators import INTEGRATORS
from tests.run.directions.lengths import FOUR_BAR, ROD, model
from tests.run.directions.test_reset_sensitivities import BALL

TIGHT = {"rtol": 1e-12, "atol": 1e-12, "integrator": "dop853"}


@pytest.mark.parametrize("integrator", [name for name in INTEGRATORS.names if name not in SCHEMES])
def test_every_other_integrator_is_refused(integrator):
    scheme = INTEGRATORS.get(integrator, "integrator")
    fits = (n for n in ("lagrange", *METHODS.names) if set(METHODS.get(n, "method").forms) & set(scheme.forms))
    settings = {"integrator": integrator, "method": next(fits), "until": 0.1}
    with pytest.raises(
        InputError, match=f"expected an explicit scheme .* got '{integrator}'; (take dop853|with the m)"
    ):
        symgen.simulate("four-bar", sensitivities="crank_mass", **settings)


@pytest.mark.slow
def test_lengths_of_a_mechanism_that_moves_by_its_dimensions():
    with pytest.raises(InputError, match=r"stays closed, got one by which the row P0\.x cannot be met"):
        symgen.simulate("bricard", sensitivities="joints.P0.at[0][0]", until=0.1, integrator="dop853")


@pytest.mark.slow
def test_a_passage_of_a_singular_position():
    settings = {"until": 1.0, "method": "direct-correction", "integrator": "dop853"}
    run = symgen.simulate("n-four-bar:2", sensitivities="bodies.coupler1.mass", **settings)
    assert run.status == "unverified"
    assert run.reason.startswith("the motion passes near a singular position at t = 0.71")


def test_a_run_that_goes_on_is_refused():
    settings = {"integrator": "rk4", "step": 1e-2, "method": "lagrange"}
    first = symgen.simulate("four-bar", until=0.1, **settings)
    with pytest.raises(InputError, match="a run from the described start, got one that continues another run"):
        symgen.simulate("four-bar", until=0.2, start=first, sensitivities="crank_mass", **settings)


def test_an_event_without_speed_has_no_time(tmp_path):
    run = model(tmp_path, ROD).simulate(
        until=2.0, stop_when="sign(rod.theta + pi/2) < 0", sensitivities="length", **TIGHT
    )
    assert run.status == "unverified"
    assert run.reason == "the event that ended the run is met without speed: its time has no derivative"


def test_an_event_at_the_start(tmp_path):
    ball = model(tmp_path, BALL)
    run = ball.simulate(until=0.5, parameters={"h0": 0.0}, sensitivities="h0", **TIGHT)
    assert run.status == "unverified"
    assert run.reason == "the event 'bounce' is at the start: with other numbers it may happen behind it"
    # gravity does not move the start
    assert ball.simulate(until=0.5, parameters={"h0": 0.0}, sensitivities="g", **TIGHT).status == "ok"


def test_events_that_accumulate(tmp_path):
    run = model(tmp_path, BALL).simulate(until=3.0, sensitivities=("h0", "e"), **TIGHT)
    assert run.status == "failed"
    assert run.reason.startswith("events of 'bounce' accumulate at t = 2.5586339655")


@pytest.mark.slow
def test_a_start_that_is_not_held_is_noted(tmp_path):
    settings = {"until": 0.1, "sensitivities": ("a", "m1"), "integrator": "rk4", "step": 1e-2}
    note = (
        "sensitivities to a: the start is not held: derivatives are those of the shortest change that keeps it closed"
    )
    assert note not in model(tmp_path, FOUR_BAR).simulate(**settings).notes
    loose = model(tmp_path, FOUR_BAR.replace('hold = "angle"\n', ""))
    assert note in loose.simulate(**settings).notes
    adjoint = loose.gradient("crank.theta", by=("a", "m1"), way="adjoint", until=0.1, integrator="rk4", step=1e-2)
    assert note in adjoint.result.notes
    assert note not in loose.simulate(start={"crank.theta": 1.0}, **settings).notes
