"""Sensitivities of runs whose formulas jump or have kinks: closed forms of a mass that is pushed."""

import pytest

from symgen import InputError
from tests.run.directions.lengths import model

PUSHED = """
[mechanism]
name = "pushed"
[parameters]
m = 2.0
k = 3.0
begin = 0.5
[inputs]
push = { default = 1.5, unit = "N" }
[bodies.p]
type = "point"
mass = "m"
velocity = [0.0, 0.0]
[forces.f]
type = "force"
body = "p"
force = ["FORMULA", 0.0]
"""
M, K, BEGIN, END = 2.0, 3.0, 0.5, 2.0
TIGHT = {"rtol": 1e-12, "atol": 1e-12, "integrator": "dop853"}
STEPS = {"step": 1e-2, "integrator": "rk4"}


def pushed(folder, formula):
    """Return a mass and its force."""
    return model(folder, PUSHED.replace("FORMULA", formula))


@pytest.mark.parametrize("formula", ["k*max(t - begin, 0)", "0.5*k*(t - begin + abs(t - begin))"])
@pytest.mark.parametrize("by_input", [False, True])
def test_a_ramp_whose_begin_moves(tmp_path, formula, by_input):
    # x = k (t - begin)^3 / (6 m)
    inputs = {"inputs": {"push": formula}} if by_input else {}
    run = pushed(tmp_path, "push" if by_input else formula).simulate(
        until=END, times=[END], sensitivities=("m", "k", "begin"), **inputs, **TIGHT
    )
    rest = END - BEGIN
    x = K * rest**3 / (6.0 * M)
    expected = {"m": -x / M, "k": x / K, "begin": -3.0 * x / rest}
    assert run.gradient("p.x").row() == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize("formula", ["k*sign(t - 0.5)", "k if t > 0.5 else -k"])
@pytest.mark.parametrize("by_input", [False, True])
def test_jumps_at_a_time_that_stays(tmp_path, formula, by_input):
    inputs = {"inputs": {"push": formula}} if by_input else {}
    run = pushed(tmp_path, "push" if by_input else formula).simulate(
        until=END, times=[END], sensitivities=("m", "k", "begin"), **inputs, **TIGHT
    )
    x = K / M * ((END - 0.5) ** 2 - END**2 / 2.0)
    assert run.gradient("p.x").row() == pytest.approx({"m": -x / M, "k": x / K, "begin": 0.0}, rel=1e-11)


@pytest.mark.parametrize("formula", ["k*sign(t - begin)", "k if t > 2*begin else 0.0"])
@pytest.mark.parametrize("settings", [TIGHT, STEPS], ids=["adaptive", "constant"])
@pytest.mark.parametrize("by_input", [False, True])
def test_jumps_that_move_are_refused(tmp_path, formula, settings, by_input):
    inputs = {"inputs": {"push": formula}} if by_input else {}
    mass, settings = pushed(tmp_path, "push" if by_input else formula), {**settings, **inputs, "until": END}
    with pytest.raises(InputError, match=r"'begin': .* no comparison .*, got one .* at t = (0\.5|1) s; write ramps by"):
        mass.simulate(sensitivities=("m", "begin"), **settings)
    for way in ("adjoint", "auto"):
        if way == "auto" or (settings["integrator"] == "rk4" and not by_input):
            with pytest.raises(InputError, match="'begin': expected a number that moves no comparison"):
                mass.gradient("p.x", by=("m", "begin"), way=way, **settings)
    # behind the end nothing moves, and other numbers move nothing
    assert mass.simulate(sensitivities=("m", "begin"), **{**settings, "until": 0.2}).ok
    assert mass.simulate(sensitivities=("m", "k"), **settings).ok


@pytest.mark.parametrize("formula", ["k if p.x > begin else 1.0", "push - k*sign(p.vx - begin)"])
@pytest.mark.parametrize("settings", [TIGHT, STEPS], ids=["adaptive", "constant"])
def test_jumps_of_the_state_are_refused(tmp_path, formula, settings):
    mass = pushed(tmp_path, formula)
    with pytest.raises(InputError, match=r"without jumps of formulas, got formulas that jump .* as an event"):
        mass.simulate(until=END, sensitivities=("m",), **settings)
    with pytest.raises(InputError, match="without jumps of formulas"):
        mass.gradient("p.x", by=("m",), until=END, **settings)


@pytest.mark.slow
def test_a_jump_as_an_event(tmp_path):
    # what the sentence on jumps proposes: x = k (t - begin)^2 / (2 m) behind the event
    text = (
        PUSHED.replace("FORMULA", "k*on")
        + """
[states.on]
start = 0.0
rate = 0.0
[events.begin]
when = "t - begin"
reset = { on = "1" }
"""
    )
    run = model(tmp_path, text).simulate(until=END, times=[END], sensitivities=("m", "k", "begin"), **TIGHT)
    rest = END - BEGIN
    x = K * rest**2 / (2.0 * M)
    assert run.gradient("p.x").row() == pytest.approx({"m": -x / M, "k": x / K, "begin": -2.0 * x / rest}, rel=1e-11)
