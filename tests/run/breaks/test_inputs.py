"""Inputs of runs against closed forms: order, jumps, data, every shape of code, and what cannot be."""

import json
import math

import numpy as np
import pytest
from support.checks import assert_same_motion

from symgen.api import Model, load
from symgen.base.errors import InputError
from symgen.cli import main
from symgen.describe.files.builder import MechanismBuilder
from symgen.describe.files.load import load_mechanism
from symgen.describe.parts.driven_mechanism import apply_inputs
from symgen.run.breaks import foreseen_seams
from symgen.run.breaks.foreseen_seams import seams_of_motion
from symgen.study.ensemble.parameter_sweep import sweep

STIFFNESS = 40.0
OMEGA = math.sqrt(STIFFNESS)


def oscillator(**run):
    """A point on a spring that an input pushes; what it pushes sideways is an output of the work alone."""
    return (
        MechanismBuilder("pushed-point")
        .run(until=1.0, step=0.01, **run)
        .parameter("stiffness", STIFFNESS)
        .parameter("start", 0.3)
        .input("push", 0.5, unit="N")
        .input("side", 0.0)
        .body("block", type="point", mass=1.0, velocity=(0.0, 0.0))
        .force("all", "force", body="block", force=("push - stiffness*block.x", "side"))
        .build()
    )


@pytest.fixture(scope="module")
def model():
    return Model(oscillator())


def held(x, v, u, h):
    """The oscillator after h with a constant push."""
    rest = u / STIFFNESS
    c, s = math.cos(OMEGA * h), math.sin(OMEGA * h)
    return rest + (x - rest) * c + v / OMEGA * s, -(x - rest) * OMEGA * s + v * c


def through(pieces, until):
    """The oscillator from rest through (begin, push) pieces."""
    x, v = 0.0, 0.0
    for (begin, u), (end, _) in zip(pieces, [*pieces[1:], (until, 0.0)], strict=True):
        x, v = held(x, v, u, end - begin)
    return x, v


def final(model, **asked):
    result = model.simulate(method="lagrange", **{"until": 1.0, "times": (1.0,), **asked})
    assert result.status == "ok", result.reason
    return result.q["block.x"][-1], result.v["block.vx"][-1], result


def test_a_number_is_held_and_needs_no_new_code(model):
    for asked in ({"inputs": {"push": 2.0}}, {"inputs": {"push": "2"}}, {"parameters": {"push": 2.0}}):
        x, v, result = final(model, integrator="dop853", rtol=1e-12, atol=1e-13, **asked)
        assert (x, v) == pytest.approx(held(0.0, 0.0, 2.0, 1.0), abs=1e-11)
        assert result.parameters == {"stiffness": STIFFNESS, "start": 0.3}
        assert result.inputs == {"push": 2.0, "side": 0.0} == result.to_json()["inputs"]
    assert model.simulate(until=0.01).inputs == {"push": 0.5, "side": 0.0}


@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_a_smooth_formula(model, shape):
    """x'' = cos(3 t) - 40 x from rest: (cos 3t - cos wt)/(w^2 - 9)."""
    x, _, result = final(model, integrator="dop853", rtol=1e-12, atol=1e-13, shape=shape, inputs={"push": "cos(3*t)"})
    assert x == pytest.approx((math.cos(3.0) - math.cos(OMEGA)) / (STIFFNESS - 9.0), abs=1e-11)
    assert result.inputs["push"] == "cos(3*t)"


def test_a_formula_of_state_and_parameters(model):
    """A controller in a formula: stiffness taken away, damping added."""
    formula = "start*stiffness*block.x - 2*block.vx + 1"
    x, _, _ = final(model, integrator="dop853", rtol=1e-12, atol=1e-13, inputs={"push": formula})
    square = STIFFNESS * 0.7
    root = math.sqrt(square - 1.0)
    assert x == pytest.approx((1.0 - math.exp(-1.0) * (math.cos(root) + math.sin(root) / root)) / square, abs=1e-11)


# -- jumps -------------------------------------------------------------------------------------------------------------

JUMPS = [
    ("2 if t < start + 0.0137 else -1", [(0.0, 2.0), (0.3137, -1.0)]),
    ("piecewise(t <= 0.25, 1, t < 0.61803, 3, 0) + 0*t", [(0.0, 1.0), (0.25, 3.0), (0.61803, 0.0)]),
    ("sign(sin(2*pi*t*1.3))", [(0.0, 1.0), (1 / 2.6, -1.0), (2 / 2.6, 1.0)]),
    ("1 if not (t > 0.2 and t < 0.5011) else 4", [(0.0, 1.0), (0.2, 4.0), (0.5011, 1.0)]),
]


@pytest.mark.parametrize("integrator", ["dop853", "picard", "abm", "radau5"])
@pytest.mark.parametrize(("formula", "pieces"), JUMPS)
def test_jumps_are_met_exactly(model, formula, pieces, integrator):
    """To 1e-10 of the closed form with an explicit scheme of high order; others to what their tolerance gives."""
    bound = {"dop853": 1e-10, "picard": 1e-10, "abm": 1e-8, "radau5": 1e-8}[integrator]
    x, v, _ = final(model, integrator=integrator, rtol=1e-12, atol=1e-13, inputs={"push": formula})
    assert (x, v) == pytest.approx(through(pieces, 1.0), abs=bound)


@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize("method", ["direct-correction", "udwadia-kalaba"])
def test_both_shapes_of_code_take_jumps_and_samples(shape, method):
    """A crank that is pushed: a torque that jumps, one that holds samples, against runs from jump to jump."""
    made = Model(
        MechanismBuilder("pushed-crank", gravity=(0.0, -9.81))
        .input("torque", 0.0)
        .input("other", 0.0)
        .body("crank", mass=1.0, inertia=0.05, points={"hub": (-0.3, 0.0)})
        .joint("hub", "revolute", between=("ground", "crank"), at=((0.0, 0.0), "hub"))
        .force("motor", "torque", body="crank", torque="torque + 2*other")
        .build()
    )
    asked = {"method": method, "integrator": "dop853", "rtol": 1e-11, "atol": 1e-12, "shape": shape, "until": 0.4}
    samples = {"t": [0.0, 0.1, 0.31], "u": [0.0, 1.5, -1.0], "interpolation": "hold"}
    found = made.simulate(**asked, times=(0.4,), inputs={"torque": "4 if t < 0.2 else 1", "other": samples})
    # theta'' (I + m l^2) = torque - m g l cos(theta), by SciPy from jump to jump
    from scipy.integrate import solve_ivp

    state = np.zeros(2)
    for begin, end, torque in ((0.0, 0.1, 4.0), (0.1, 0.2, 7.0), (0.2, 0.31, 4.0), (0.31, 0.4, -1.0)):
        rates = lambda t, y, u=torque: [y[1], (u - 9.81 * 0.3 * math.cos(y[0])) / 0.14]  # noqa: E731
        state = solve_ivp(rates, (begin, end), state, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    assert found.q["crank.theta"][-1] == pytest.approx(state[0], abs=1e-9)
    assert found.v["crank.omega"][-1] == pytest.approx(state[1], abs=1e-8)


def slope(model, integrator, sizes, formula, expected, **asked):
    """The fitted order of the error of the state at the end over step sizes."""
    errors = []
    for h in sizes:
        x, v, _ = final(model, integrator=integrator, step=h, inputs={"push": formula}, **asked)
        errors.append(math.hypot(x - expected[0], (v - expected[1]) / OMEGA))
    return np.polyfit(np.log(sizes), np.log(errors), 1)[0]


@pytest.mark.parametrize(("integrator", "order"), [("rk4", 4), ("abm4", 4), ("heun", 2), ("dop853", 8)])
def test_constant_steps_keep_their_order(model, integrator, order):
    """With a smooth input, and with a jump that no grid of steps meets: a restart of a multistep scheme included."""
    sizes = np.array([0.1, 0.05, 0.025]) if order == 8 else np.array([0.01, 0.005, 0.0025, 0.00125])
    asked = {"options": {"integrator.adaptive": "false"}} if integrator == "dop853" else {}
    smooth = np.array([math.cos(3.0) - math.cos(OMEGA), OMEGA * math.sin(OMEGA) - 3.0 * math.sin(3.0)]) / (
        STIFFNESS - 9.0
    )
    assert slope(model, integrator, sizes, "cos(3*t)", smooth, **asked) > order - 0.2
    jumping = through([(0.0, 2.0), (0.31371, -1.0)], 1.0)
    assert slope(model, integrator, sizes, "2 if t < 0.31371 else -1", jumping, **asked) > order - 0.2


def test_kinks_are_met_too(model):
    """A ramp that ends: 10 min(t, 0.30005), from the integral of its response."""
    end = 0.30005
    x = 10.0 * (end - math.sin(OMEGA * end) / OMEGA) / STIFFNESS
    v = 10.0 * (1.0 - math.cos(OMEGA * end)) / STIFFNESS
    expected = held(x, v, 10.0 * end, 1.0 - end)
    sizes = np.array([0.02, 0.01, 0.005, 0.0025])
    for integrator in ("rk4", "abm4"):
        for formula in ("10*min(t, start + 0.00005)", "5*(t + 0.30005 - abs(t - 0.30005))"):
            assert slope(model, integrator, sizes, formula, expected) > 3.8


def test_a_grid_of_steps_that_meets_the_jump_stays_what_it_is(model):
    _, _, result = final(model, integrator="rk4", step=0.01, inputs={"push": "1 if t < 0.5 else 0"})
    assert result.steps == 100 and result.evaluations == 400


def test_accelerations_at_outputs_are_those_of_their_piece(model):
    times = (0.1, 0.3, 0.31, 0.9)
    result = model.simulate(
        method="lagrange", integrator="dop853", until=1.0, times=times, inputs={"push": "2 if t < 0.3 else -1"}
    )
    x = np.asarray(result.q["block.x"])
    np.testing.assert_allclose(
        result.a["block.ax"], np.array([2.0, 2.0, -1.0, -1.0]) - STIFFNESS * x, rtol=0.0, atol=1e-12
    )


def test_the_energy_stays_in_balance_over_jumps(model):
    result = model.simulate(method="lagrange", integrator="dop853", until=2.0, inputs={"push": "30*sign(sin(9*t))"})
    assert result.status == "ok"
    assert np.abs(result.energy_error).max() < 1e-7 * result.kinetic.max()


def test_verifying_and_automatic_runs_take_inputs(model):
    result = model.simulate(method="auto", integrator="auto", until=1.0, inputs={"push": "2 if t < 0.3137 else -1"})
    assert result.status == "ok"
    assert result.q["block.x"][-1] == pytest.approx(through([(0.0, 2.0), (0.3137, -1.0)], 1.0)[0], abs=1e-6)


# -- data --------------------------------------------------------------------------------------------------------------

TIMES, VALUES = [0.0, 0.2, 0.45, 0.61, 0.9], [1.0, -2.0, 3.0, 0.5, 2.0]


@pytest.mark.parametrize("integrator", ["rk4", "dop853", "generalized-alpha"])
def test_samples_are_held(model, integrator):
    asked = {"method": "generalized-alpha"} if integrator == "generalized-alpha" else {"method": "lagrange"}
    result = model.simulate(
        **asked,
        integrator=integrator,
        until=1.0,
        times=(1.0,),
        inputs={"push": {"t": TIMES, "u": VALUES, "interpolation": "hold"}},
    )
    bound = {"rk4": 1e-6, "dop853": 1e-7, "generalized-alpha": 1e-2}[integrator]
    assert result.q["block.x"][-1] == pytest.approx(through(list(zip(TIMES, VALUES, strict=True)), 1.0)[0], abs=bound)
    assert result.inputs["push"] == "5 samples (hold)"


def by_small_steps(push):
    """The oscillator by a rule of its own: exact steps with the push at the middle of each, extrapolated."""

    def run(n):
        x = v = 0.0
        for k in range(n):
            x, v = held(x, v, push((k + 0.5) / n), 1.0 / n)
        return x

    return (4.0 * run(18000) - run(9000)) / 3.0


@pytest.mark.slow_cases("cubic", "pchip")
@pytest.mark.parametrize("how", ["linear", "cubic", "pchip"])
def test_data_are_interpolated(model, how):
    from support.curves import curve

    t, u = [*TIMES, 1.0], [*VALUES, -1.0]
    x, _, _ = final(
        model, integrator="dop853", rtol=1e-11, atol=1e-13, inputs={"push": {"t": t, "u": u, "interpolation": how}}
    )
    assert x == pytest.approx(by_small_steps(curve(t, u, how)), abs=2e-9)  # what the rule leaves at kinks
    if how == "linear":
        other = final(model, integrator="dop853", rtol=1e-11, atol=1e-13, inputs={"push": (np.array(t), np.array(u))})
        assert other[0] == x and other[2].inputs["push"] == "6 samples (linear)"


def test_columns_of_a_file_by_the_command(tmp_path, capsys):
    file = tmp_path / "point.toml"
    file.write_text(TOML)
    data = tmp_path / "data.csv"
    data.write_text("time [s], force [N]\n" + "".join(f"{t}, {u}\n" for t, u in zip(TIMES, VALUES, strict=True)))
    asked = ["run", str(file), "--method", "lagrange", "--integrator", "dop853", "--until", "1", "--json"]
    assert main([*asked, "--input", f"push={data}:force:hold"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["final"]["q"]["block.x"] == pytest.approx(
        through(list(zip(TIMES, VALUES, strict=True)), 1.0)[0], abs=1e-7
    )
    assert found["inputs"] == {"push": f"{data}:force (hold)"}
    assert main([*asked, "--input", "push=2 if t < 0.3137 else -1"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["final"]["q"]["block.x"] == pytest.approx(through([(0.0, 2.0), (0.3137, -1.0)], 1.0)[0], abs=1e-7)
    assert load_mechanism(file).inputs == ("push",)


TOML = f"""
[mechanism]
name = "pushed-point"
[inputs]
push = {{ default = 0.5, unit = "N", note = "a motor's" }}
[bodies.block]
type = "point"
mass = 1.0
velocity = [0.0, 0.0]
[forces.all]
type = "force"
body = "block"
force = ["push - {STIFFNESS}*block.x", 0.0]
"""


# -- where things jump -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        ("1 if t < 0.5 else 0", [0.5]),
        ("1 if 2*t - start*2 > 0.1 else 0", [0.35]),
        ("sign(t*t - 0.25)", [0.5]),
        ("sign((t - 0.5)**2 - 1e-10)", [0.5 - 1e-5, 0.5 + 1e-5]),
        ("1 if sin(40*pi*t) > 0 else 0", [k / 40 for k in range(1, 40)]),
        ("abs(t - 0.2) + max(t, 0.7)", [0.2, 0.7]),
        ("1 if t < 2 else 0", []),
        ("1 if block.x < 0.5 else 0", []),
        ("sin(3*t)", []),
    ],
)
def test_times_of_jumps(model, formula, expected):
    found = apply_inputs(model.mechanism, {"push": formula})
    pieces = seams_of_motion(found, model.parameters() | {s.switch: 0.0 for s in found.jumps}, 1.0)
    assert [p.t for p in pieces[1:]] == pytest.approx(expected, abs=1e-12)


# -- what cannot be ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        (
            {"pusch": 1.0},
            "input 'pusch': expected an input of pushed-point, got none of that name; did you mean 'push'?",
        ),
        ({"push": float("nan")}, "input 'push': expected a finite number, got nan"),
        (
            {"push": "2*sin(u)"},
            "input 'push': expected a number or an expression of t, parameters and body coordinates",
        ),
        ({"push": "2*side"}, "got 'side', which has no meaning here; an input does not depend on others"),
        ({"push": [1.0, 2.0, 3.0]}, "input 'push': expected a pair of times and values, got a list of 3"),
        ({"push": ([0.0, 1.0], [1.0])}, "input 'push': expected as many values as times, got 1 for 2"),
        ({"push": ([0.0, 0.0], [1.0, 2.0])}, "input 'push' times: expected increasing times, got 0.0 after 0.0"),
        ({"push": ([0.0], [1.0])}, "input 'push': expected two samples or more, got 1"),
        ({"push": {"t": [0.0, 1.0]}}, "input 'push': expected either t and u or file and column, got t"),
        ({"push": {"t": [0, 1], "u": [0, 1], "how": "hold"}}, "got the unknown key 'how'"),
        (
            {"push": {"t": [0, 1], "u": [0, 1], "interpolation": "hld"}},
            "hold, linear, cubic, pchip, got 'hld'; did you",
        ),
        ({"push": {"t": [0, 1], "u": [0, 1], "interpolation": "cubic"}}, "expected four samples or more for"),
        (
            {"push": {"t": [0, 0.1, 0.2, 0.5], "u": [0, 1, 0, 1], "interpolation": "cubic"}},
            "expected data from 0 to 1 s",
        ),
        ({"push": "no.csv:force"}, "input 'push': no.csv: expected a file that can be read, got no such file"),
    ],
)
def test_bad_inputs_are_told_in_a_sentence(model, inputs, message):
    with pytest.raises(InputError) as caught:
        model.simulate(until=1.0, inputs=inputs)
    assert message in str(caught.value)


def test_more_jumps_than_are_looked_for_are_told(model, monkeypatch):
    monkeypatch.setattr(foreseen_seams, "MOST_PIECES", 1000)
    with pytest.raises(InputError, match="inputs: expected at most 1000 jumps"):
        model.simulate(until=1.0, inputs={"push": "sign(sin(1e4*t))"})


@pytest.mark.parametrize(
    ("text", "word", "message"),
    [
        ("t,u\n0,1\n1,x\n", "u", "data.csv: expected a number in every row, got 'x' in row 3"),
        ("t,u\n0,1\n1,\n", "u", "data.csv: expected a number in every row, got '' in row 3"),
        ("t,u\n0,1\n1\n", "u", "data.csv: expected as many cells as in the heading, 2, got 1 in row 3"),
        ("t,u\n0,1,9\n1,2\n", "u", "data.csv: expected as many cells as in the heading, 2, got 3 in row 2"),
        ("t,u,u\n0,1,2\n1,2,3\n", "u", "data.csv: expected a name of its own for each column, got 2 columns 'u'"),
        ("t,force\n0,1\n1,2\n", "forc", "data.csv: expected a column of the file, got 'forc'; did you mean 'force'?"),
        ("t,u\n0,1\n1,2\n", "t", "data.csv: expected a column beside that of the times, got 't'"),
        ("", "u", "data.csv: expected a column of the file, got 'u'"),
        ("t,u\n0,1\n1,2\n", "u:spline", "input 'push' interpolation: expected one of hold, linear, cubic, pchip"),
    ],
)
def test_bad_files_are_told_in_a_sentence(model, tmp_path, text, word, message):
    path = tmp_path / "data.csv"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        model.simulate(until=1.0, inputs={"push": f"{path}:{word}"})
    assert message in str(caught.value)


@pytest.mark.by_turns(3)
@pytest.mark.fast("push3-0.37-3.0")
@pytest.mark.parametrize(
    ("push", "when", "late"),
    [
        ("3*t", 1.0 / 3.0, 2.4),
        ({"t": [0.0, 1.0], "u": [0.0, 3.0]}, 1.0 / 3.0, 2.4),
        ("3 if t > 0.37 else 0", 0.37, 3.0),
        ({"t": [0.0, 0.37], "u": [0.0, 3.0], "interpolation": "hold"}, 0.37, 3.0),
    ],
)
def test_events_that_are_asked_for_read_what_a_run_gives_an_input(model, push, when, late):
    """Beside the file's own: they are read when formulas stand in the place of inputs already."""
    shove = {"when": "t > 0.8", "reset": {"block.vx": "2*push"}}
    asked = {"inputs": {"push": push}, "events": {"shove": shove}, "record_when": "push > 1", "until": 1.0}
    result = model.simulate(method="lagrange", **asked)
    assert [event.name for event in result.events] == ["push > 1", "shove"]
    assert result.events[0].t == pytest.approx(when, abs=1e-12)
    assert result.events[1].v_after["block.vx"] == pytest.approx(2.0 * late, abs=1e-12)
    stopped = model.simulate(method="lagrange", inputs={"push": push}, stop_when="push > 1", until=1.0)
    assert stopped.end == result.events[0].t
    stepped = model.start(method="lagrange", inputs={"push": push}, stop_when="push > 1")
    assert stepped.run(1.0).t == pytest.approx(stopped.end, abs=1e-12)
    found = sweep(
        model, {"start": [0.1, 0.2]}, method="lagrange", inputs={"push": push}, stop_when="push > 1", until=1.0
    )
    assert_same_motion(found["end"], [stopped.end, stopped.end])


@pytest.mark.slow
def test_outputs_read_what_a_run_gives_an_input():
    """A formula of time, one that jumps, a curve and samples: what [outputs] show is what pushes."""
    mechanism = (
        MechanismBuilder("watched-point")
        .run(until=1.0, step=0.01)
        .input("push", 0.5, unit="N")
        .body("block", type="point", mass=1.0, velocity=(0.0, 0.0))
        .force("all", "force", body="block", force=("push", 0.0))
        .output("shove", "2*push", unit="N")
        .output("impulse", "integral(push)", unit="N s")
        .build()
    )
    times = (0.2, 0.6, 1.0)
    for push, expected, impulse in (
        ("sin(3*t)", [2.0 * math.sin(3.0 * t) for t in times], (1.0 - math.cos(3.0)) / 3.0),
        ("2 if t > 0.25 else 0", [0.0, 4.0, 4.0], 1.5),
        ({"t": [0.0, 1.0], "u": [1.0, 3.0], "interpolation": "linear"}, [2.8, 4.4, 6.0], 2.0),
        ({"t": [0.0, 0.5], "u": [1.0, 3.0], "interpolation": "hold"}, [2.0, 6.0, 6.0], 2.0),
    ):
        result = Model(mechanism).simulate(method="lagrange", inputs={"push": push}, times=times)
        shown = result.select(["shove", "impulse"]).values
        np.testing.assert_allclose(shown[:, 0], expected, atol=1e-14)
        assert shown[-1, 1] == pytest.approx(impulse, abs=1e-9) == result.v["block.vx"][-1]


def test_a_default_that_follows_a_parameter_is_told_as_it_was():
    """Whether another input is given or not, and by whom a result is read."""
    mechanism = (
        MechanismBuilder("pushed-point")
        .run(until=0.1, step=0.01)
        .parameter("strength", 1.0)
        .input("push", "2*strength", unit="N")
        .input("side", 0.0)
        .body("block", type="point", mass=1.0, velocity=(0.0, 0.0))
        .force("all", "force", body="block", force=("push", "side"))
        .build()
    )
    for inputs in ({}, {"side": 1.0}, {"side": "t"}):
        result = Model(mechanism).simulate(method="lagrange", parameters={"strength": 3.0}, inputs=inputs)
        assert result.inputs["push"] == 6.0
        assert result.v["block.vx"][-1] == pytest.approx(0.6, abs=1e-12)


def test_sweeps_take_numbers_as_parameters(model):
    found = sweep(model, vary={"push": [1.0, 2.0]}, until=1.0, step=0.01, method="lagrange", quantities=["block.x"])
    for row, push in enumerate((1.0, 2.0)):
        single = model.simulate(until=1.0, step=0.01, method="lagrange", inputs={"push": push}, times=(1.0,))
        assert_same_motion(found["block.x"][row], single.q["block.x"])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda m: m.input("drive", "2*t"), "inputs.drive: expected a number or an expression of parameters, got 't'"),
        (
            lambda m: m.input("mass", 1.0),
            "inputs.mass: expected a name used once, got 'mass', which is a parameter alr",
        ),
        (
            lambda m: m.parameter("twice", "2*push"),
            "parameters.twice: expected a number or an expression of parameters",
        ),
        (
            lambda m: m.body("b", mass="push", inertia=1.0),
            "bodies.b.mass: expected a number or an expression of paramet",
        ),
        (
            lambda m: m.joint("d", "driver", body="a", coordinate="x", value="push*t"),
            "got 'push', which has no meaning here; only forces, torques and actuators may use an input",
        ),
        (
            lambda m: m.force("f", "force", body="a", potential=("push*x", "0*y")),
            "got 'push', which has no meaning here; only forces, torques and actuators may use an input",
        ),
    ],
)
def test_where_inputs_may_not_stand(change, message):
    base = MechanismBuilder("bad").parameter("mass", 1.0).input("push", "2*mass").body("a", mass="mass", inertia=1.0)
    assert base.build().parameters[1].value == 2.0
    with pytest.raises(InputError) as caught:
        change(base).build()
    assert message in str(caught.value)


def test_a_file_without_inputs_says_so():
    with pytest.raises(
        InputError, match=r"input 'x': expected an input of pendulum, got none of that name; it declares"
    ):
        load("pendulum").simulate(inputs={"x": 1.0})
