"""The adjoint through events, jumps at known times and tables, against closed forms and forward directions."""

import pytest
from run.directions.lengths import FOUR_BAR, ROD, model
from run.directions.test_breaks_with_sensitivities import PUSHED
from run.directions.test_reset_sensitivities import BALL

TIGHT = {"rtol": 1e-12, "atol": 1e-12, "integrator": "dop853"}
STEPS = {"step": 1e-2, "integrator": "rk4"}
CURVE = """
[tables.curve]
x = [0.0, 0.5, 1.0, 2.0, 4.0]
y = [0.0, 1.0, 0.5, 2.0, 1.0]
interpolation = "linear"
"""
MIRROR = '[events.back]\nwhen = "rod.theta + pi/2"\ndirection = "falling"\nreset = {"rod.omega" = "-rod.omega"}\n'
STRUCK = (
    FOUR_BAR.replace('g = { value = 9.81, unit = "m/s^2" }', 'g = { value = 9.81, unit = "m/s^2" }\ne = 0.6')
    + '[events.back]\nwhen = "crank.theta - 0.8"\ndirection = "falling"\nreset = {"rocker.omega" = "-e*rocker.omega"}\n'
)


def pushed(formula, more=""):
    return PUSHED.replace("FORMULA", formula).replace("velocity = [0.0, 0.0]", "velocity = [0.2, 0.0]") + more


#: Text of a file, quantity, names, settings.
CASES = {
    "jump": (pushed("k if t > 0.5 else -k"), "p.x", ("m", "k"), {"until": 2.0}),
    "input": (pushed("push*k"), "p.x", ("m", "k"), {"until": 2.0, "inputs": {"push": "1.0 if t < 0.7 else -2.0"}}),
    "kink": (pushed("k*max(t - begin, 0)"), "p.x", ("m", "k", "begin"), {"until": 2.0}),
    "points": (pushed("push*k"), "p.x", ("m", "k"), {"until": 2.0, "inputs": {"push": [[0.0, 1.0], [0.7, -2.0]]}}),
    "table of the time": (pushed("k*curve(t)", CURVE), "p.x", ("m", "k"), {"until": 2.0}),
    "table of the place": (pushed("k*curve(p.x) + 0.3", CURVE), "p.x", ("m", "k"), {"until": 2.0}),
    "kink of the place": (pushed("k*abs(p.x - 0.3) + 0.3"), "p.x", ("m", "k"), {"until": 2.0}),
    "bounces": (BALL, "ball.y", ("h0", "e", "g"), {"until": 1.5}),
    "mirror": (ROD + MIRROR, "rod.theta", ("length", "g"), {"until": 3.0}),
    "recorded": (FOUR_BAR, "crank.theta", ("a", "m2"), {"until": 2.0, "record_when": "crank.theta < 0.3"}),
    "struck": (STRUCK, "crank.theta", ("a", "b", "e", "m2", "g"), {"until": 1.2}),
    "struck in joint coordinates": (STRUCK, "crank.theta", ("a", "e"), {"until": 1.2, "coordinates": "joint"}),
}


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("case", [*CASES])
@pytest.mark.parametrize("steps", ["adaptive", "constant"])
def test_the_adjoint_is_what_forward_directions_are(tmp_path, steps, case):
    text, quantity, by, settings = CASES[case]
    own = model(tmp_path, text)
    settings = {**settings, **(TIGHT if steps == "adaptive" else STEPS)}
    one, other = (own.gradient(quantity, by=by, way=way, **settings) for way in ("adjoint", "forward"))
    assert one.result.ok
    assert one.value == pytest.approx(other.value, rel=1e-11)
    assert one.by == pytest.approx(other.by, rel=1e-10)


@pytest.mark.slow
def test_a_ball_that_bounces_twice(tmp_path):
    found = model(tmp_path, BALL).gradient("ball.y", by=("h0", "e", "g"), way="adjoint", until=1.5, **TIGHT)
    expected = {"h0": 1.488826194916769, "e": 4.310179282157103, "g": -0.1463225081634283}
    assert found.by == pytest.approx(expected, rel=1e-11)


def test_a_table_that_pushes(tmp_path):
    # the curve is 2 t up to 0.5 s, 1.5 - t up to 1 s: x = 0.2 t + k/m (moments of its area about the end)
    found = model(tmp_path, CASES["table of the time"][0]).gradient(
        "p.x", by=("m", "k"), way="adjoint", until=1.0, **TIGHT
    )
    moment = 0.25 * (1.0 - 1.0 / 3.0) + 0.5 * 0.5 * 0.25 + 0.125 * (0.5 * 2.0 / 3.0)
    assert found.by == pytest.approx({"k": moment / 2.0, "m": -3.0 * moment / 4.0}, rel=1e-11)
