"""States of a file's own: closed forms and SciPy, every integrator, both coordinates, analyses and what is refused."""

import numpy as np
import pytest
from scipy.integrate import simpson, solve_ivp
from scipy.linalg import expm

import symgen
from symgen import MechanismBuilder
from symgen.api import Model
from symgen.base.errors import InputError
from symgen.derive.methods import METHODS
from symgen.describe.files.validate import validate
from symgen.result.saved import read_last_state
from symgen.run.compiling.method_choice import choose_method

TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13}
IMPLICIT = {"integrator": "radau5", "rtol": 1e-11, "atol": 1e-12}
RUNS = [
    settings | more for settings in (TIGHT, IMPLICIT) for more in ({}, {"coordinates": "joint"}, {"shape": "looped"})
]


def motor_file(inductance=0.02):
    """A motor with its inductance on a wheel with a bearing that damps."""
    pin = {"type": "revolute", "between": ["ground", "wheel"], "at": [[0.0, 0.0], [0.0, 0.0]]}
    return {
        "mechanism": {"name": "motor-with-current"},
        "parameters": {"K": 0.7, "R": 1.2, "L": inductance, "U": 3.0},
        "bodies": {"wheel": {"mass": 1.0, "inertia": 0.04, "angular_velocity": 0.5}},
        "joints": {"pin": pin},
        "forces": {"drive": {"type": "torque", "body": "wheel", "torque": "K*i - 0.05*wheel.omega"}},
        "states": {"i": {"rate": "(U - R*i - K*pin.rate)/L", "start": 0.1, "unit": "A"}},
    }


def motor(inductance=0.02):
    return validate(motor_file(inductance), "motor")


@pytest.mark.parametrize("settings", RUNS, ids=str)
def test_a_motor_with_its_current(settings):
    result = Model(motor()).simulate(until=1.0, **settings)
    matrix = np.array([[-0.05 / 0.04, 0.7 / 0.04, 0.0], [-0.7 / 0.02, -1.2 / 0.02, 3.0 / 0.02], [0.0, 0.0, 0.0]])
    omega, current, _ = expm(matrix) @ [0.5, 0.1, 1.0]
    assert result.v["wheel.omega"][-1] == pytest.approx(omega, abs=1e-10)
    assert result.outputs["i"][-1] == pytest.approx(current, abs=1e-10)


@pytest.mark.parametrize("settings", RUNS, ids=str)
def test_a_first_order_lag(settings):
    """T x' = sin(w t) - x, which no force reads."""
    mechanism = (
        MechanismBuilder("lag")
        .parameter("T", 0.3)
        .body("ball", type="point", mass=1.0, velocity=[1.0, 0.0])
        .state("x", "(sin(4*t) - x)/T", "2*T")
        .build()
    )
    result, t, scale = Model(mechanism).simulate(until=1.0, **settings), 1.0, 0.3
    steady = lambda t: (np.sin(4 * t) - 4 * scale * np.cos(4 * t)) / (1 + (4 * scale) ** 2)  # noqa: E731
    wanted = steady(t) + (2 * scale - steady(0.0)) * np.exp(-t / scale)
    assert result.outputs["x"][-1] == pytest.approx(wanted, abs=1e-10)


def on_rail(name, force, **states):
    builder = MechanismBuilder(name).body("mass", mass=2.0, inertia=1.0, position=[0.1, 0.0])
    builder.joint("rail", "translational", between=["ground", "mass"], at=[[0, 0], [0, 0]], axis=[1, 0])
    builder.force("push", "force", body="mass", force=[force, 0.0])
    for state, (rate, start) in states.items():
        builder.state(state, rate, start)
    return builder.build()


def cylinder():
    """A cylinder with two chambers, in bar and cm so that pressures are not far from 1."""
    return on_rail(
        "cylinder",
        "20*(a - b) - 3*mass.vx",
        a=("(2.0*sqrt(9 - a) - 20*mass.vx)/(0.2 + mass.x)", 2.0),
        b=("(-2.5*sqrt(b) + 20*mass.vx)/(1.2 - mass.x)", 3.0),
    )


def by_cylinder(t, y):
    x, v, a, b = y
    return [
        v,
        (20 * (a - b) - 3 * v) / 2,
        (2 * np.sqrt(9 - a) - 20 * v) / (0.2 + x),
        (-2.5 * np.sqrt(b) + 20 * v) / (1.2 - x),
    ]


def controller():
    """A PI controller whose integral is led back where the actuator is at its limit."""
    demand, out = "8*(1 - mass.x) - 3*mass.vx + e", "min(max(8*(1 - mass.x) - 3*mass.vx + e, -2), 2)"
    return on_rail("controller", out, e=(f"5*(1 - mass.x) + ({out} - ({demand}))/0.2", 0.0))


def by_controller(t, y):
    x, v, e = y
    demand = 8 * (1 - x) - 3 * v + e
    out = min(max(demand, -2.0), 2.0)
    return [v, out / 2, 5 * (1 - x) + (out - demand) / 0.2]


@pytest.mark.parametrize("settings", RUNS, ids=str)
@pytest.mark.parametrize(
    ("mechanism", "rates", "start"),
    [(cylinder(), by_cylinder, [0.1, 0.0, 2.0, 3.0]), (controller(), by_controller, [0.1, 0.0, 0.0])],
    ids=["cylinder", "controller"],
)
def test_against_scipy(mechanism, rates, start, settings):
    result = Model(mechanism).simulate(until=1.0, **settings)
    wanted = solve_ivp(rates, (0.0, 1.0), start, "DOP853", rtol=1e-13, atol=1e-13, max_step=0.002).y[:, -1]
    own = [result.q["mass.x"][-1], result.v["mass.vx"][-1], *result.outputs.values[-1]]
    np.testing.assert_allclose(own, wanted, rtol=0.0, atol=1e-10)


def driven_four_bar():
    """A four-bar whose crank a motor holds up: its current is a state."""
    return (
        MechanismBuilder("four-bar-with-motor", gravity=[0.0, -9.81])
        .parameter("U", 40.0)
        .body("crank", mass=1.0, inertia=0.1, position=[0.0, 0.5], angle=np.pi / 2)
        .body("coupler", mass=1.5, inertia=0.5, position=[1.0, 1.3], angle=0.3)
        .body("rocker", mass=1.2, inertia=0.4, position=[2.2, 0.8], angle=1.3)
        .joint("A", "revolute", between=["ground", "crank"], at=[[0.0, 0.0], [-0.5, 0.0]])
        .joint("B", "revolute", between=["crank", "coupler"], at=[[0.5, 0.0], [-1.0, 0.0]])
        .joint("C", "revolute", between=["coupler", "rocker"], at=[[1.0, 0.0], [0.8, 0.0]])
        .joint("D", "revolute", between=["ground", "rocker"], at=[[2.0, 0.0], [-0.8, 0.0]])
        .force("drive", "torque", body="crank", torque="2*i")
        .state("i", "(U - 8*i - 2*A.rate)/0.05", unit="A")
        .build()
    )


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_eigenvalues_of_a_four_bar_with_its_motor(coordinates):
    model = Model(driven_four_bar())
    rest = model.equilibrium(coordinates=coordinates)
    found = model.modes(at="equilibrium", coordinates=coordinates).eigenvalues
    angle, current = rest.q["crank.theta"], 40.0 / 8.0
    assert rest.stability == "stable"

    def rates(angle, omega, i):
        run = model.simulate(
            until=1e-9, step=1e-9, integrator="rk4", start={"crank.theta": angle, "crank.omega": omega, "i": i}
        )
        return np.array([omega, run.a["crank.alpha"][0], (40.0 - 8.0 * i - 2.0 * omega) / 0.05])

    here, h = np.array([angle, 0.0, current]), 1e-3
    steps = [h * row for row in np.eye(3)]
    differences = [
        (8 * (rates(*(here + e)) - rates(*(here - e))) - (rates(*(here + 2 * e)) - rates(*(here - 2 * e)))) / (12 * h)
        for e in steps
    ]
    wanted = np.linalg.eigvals(np.array(differences).T)
    np.testing.assert_allclose(np.sort_complex(found), np.sort_complex(wanted), rtol=1e-7)


def test_steps_saved_runs_and_runs_that_go_on():
    model, settings = Model(motor()), {"integrator": "rk4", "step": 1e-3}
    whole = model.simulate(until=0.4, **settings)
    run = model.start(until=0.4, **settings)
    run.step(0.15)
    saved, here = run.save(), float(run.states["i"])
    run.step(0.25)
    end = float(run.states["i"])
    run.restore(saved)
    assert float(run.states["i"]) == here
    run.step(0.25)
    assert float(run.states["i"]) == end == whole.outputs["i"][-1]
    half = model.simulate(until=0.2, **settings)
    # the same making takes up all arrays, another one time, coordinates, velocities and states
    assert model.simulate(until=0.4, start=half, **settings).outputs["i"][-1] == end
    other = model.simulate(until=0.4, start=half, **TIGHT).outputs["i"][-1]
    assert other == pytest.approx(end, abs=1e-7)


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_rows_of_sweeps_are_single_runs(coordinates):
    settings = {"integrator": "rk4", "step": 1e-3, "until": 0.3, "coordinates": coordinates}
    swept = symgen.sweep(motor(), {"R": [1.2, 2.0], "i": [0.1, 0.4]}, quantities=["i", "wheel.omega"], **settings)
    for k, resistance in enumerate((1.2, 2.0)):
        for j, current in enumerate((0.1, 0.4)):
            one = Model(motor()).simulate(parameters={"R": resistance}, start={"i": current}, **settings)
            assert swept["i"][k, j, -1] == pytest.approx(one.outputs["i"][-1], rel=1e-13)
            assert swept["wheel.omega"][k, j, -1] == pytest.approx(one.v["wheel.omega"][-1], rel=1e-13)
    plain = symgen.sweep(motor(), {"R": [1.2, 2.0], "i": [0.1, 0.4]}, quantities=["wheel.omega"], **settings)
    np.testing.assert_allclose(plain["wheel.omega"], swept["wheel.omega"], rtol=1e-13)


def test_inputs_and_events_read_states():
    raw = motor_file()
    del raw["parameters"]["U"]
    raw["inputs"] = {"U": 3.0}
    raw["events"] = {"high": {"when": "i > 0.6", "action": "stop"}}
    result = Model(validate(raw, "motor")).simulate(until=1.0, inputs={"U": "3*cos(5*t) - 0.5*i"}, **TIGHT)

    def rates(t, y):
        return [(0.7 * y[1] - 0.05 * y[0]) / 0.04, (3 * np.cos(5 * t) - 1.7 * y[1] - 0.7 * y[0]) / 0.02]

    at = solve_ivp(rates, (0.0, result.t[-1]), [0.5, 0.1], "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    assert 0.001 < result.t[-1] < 0.2
    assert result.outputs["i"][-1] == pytest.approx(0.6, abs=1e-10)
    np.testing.assert_allclose([result.v["wheel.omega"][-1], result.outputs["i"][-1]], at, atol=1e-10)


@pytest.mark.slow_cases("nc-joint")
@pytest.mark.parametrize(("ending", "coordinates"), [("nc", "joint"), ("csv", "absolute")])
def test_saved_runs_go_on(tmp_path, ending, coordinates):
    settings = {**TIGHT, "coordinates": coordinates}
    model, path = Model(motor()), tmp_path / f"half.{ending}"
    model.simulate(until=0.2, **settings).save(path)
    whole = model.simulate(until=0.4, **settings)
    on = model.simulate(until=0.4, start=read_last_state("start", path), **settings)
    assert on.outputs["i"][-1] == pytest.approx(whole.outputs["i"][-1], abs=1e-11)


def test_auto_sees_a_stiff_state():
    assert Model(motor(1.2e-6)).simulate(until=0.1, integrator="auto").integrator == "radau5"


def test_a_stiff_state_costs_an_implicit_scheme_few_steps():
    """The time constant of the current is 1e-6 s: an explicit scheme takes 3e5 steps, and Newton's method sees it."""
    result = Model(motor(1.2e-6)).simulate(until=1.0, integrator="radau5", rtol=1e-8)
    gain = (0.7**2 / 1.2 + 0.05) / 0.04
    omega = 0.7 * 3.0 / 1.2 / 0.04 / gain
    assert result.v["wheel.omega"][-1] == pytest.approx(omega + (0.5 - omega) * np.exp(-gain), rel=1e-5)
    assert result.steps < 300


def test_integrals_and_states_stand_side_by_side():
    raw = motor_file()
    raw["outputs"] = {"charge": {"value": "integral(i)"}, "twice": {"value": "2*i"}}
    for settings in (TIGHT, IMPLICIT, {**IMPLICIT, "coordinates": "joint"}):
        result = Model(validate(raw, "motor")).simulate(until=1.0, output_step=1e-3, **settings)
        assert result.outputs["twice"][-1] == 2.0 * result.outputs["i"][-1]
        charge = simpson(result.outputs["i"], x=result.t)
        assert result.outputs["charge"][-1] == pytest.approx(charge, rel=1e-8)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"states": {"i": {"start": 1.0}}}, "states.i.rate: expected a number or an expression"),
        (
            {"states": {"i": {"rate": "U", "begin": 1.0}}},
            "states.i: expected the keys rate, start, unit, got .*'begin'",
        ),
        (
            {"states": {"i": {"rate": "U", "start": "wheel.omega"}}},
            "states.i.start: expected a number or an expression",
        ),
        (
            {"states": {"i": {"rate": "U", "start": "i"}}},
            "'i', which has no meaning here; only forces, torques, rates of states",
        ),
        (
            {"states": {"i": {"rate": "wheel.alfa"}}},
            "states.i.rate: expected .*'alfa', which body 'wheel' does not have",
        ),
        (
            {"states": {"R": {"rate": "1"}}},
            "states.R: expected a name used once, got 'R', which is a parameter already",
        ),
        ({"states": {"t": {"rate": "1"}}}, "a state name that has no meaning of its own"),
        ({"states": {"i": 3}}, "states.i: expected a table, got 3"),
        ({"outputs": {"i": "1"}}, "'i'"),
        (
            {"joints": {"d": {"type": "driver", "joint": "pin", "value": "i*t"}}},
            "only forces, torques, rates of states",
        ),
    ],
)
def test_bad_input_is_one_sentence(change, words):
    raw = motor_file()
    for section, entries in change.items():
        raw[section] = {**raw.get(section, {}), **entries}
    with pytest.raises(InputError, match=words) as error:
        validate(raw, "motor")
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"start": {"j": 1.0}}, "start 'j': expected a coordinate or velocity of a body or joint, or a state"),
    ],
)
def test_what_does_not_fit_is_refused(settings, words):
    with pytest.raises(InputError, match=words):
        Model(motor()).simulate(until=0.1, **settings)


@pytest.mark.slow_cases("coordinate-partitioning")
@pytest.mark.parametrize("method", ["baumgarte", "coordinate-partitioning", "ggl", "augmented-lagrangian"])
def test_methods_take_states(method):
    wanted = Model(motor()).simulate(until=0.1, **TIGHT)
    integrator = METHODS.get(method).default_integrator
    settings = {"rtol": 1e-10} if integrator == "radau5" else {"step": 5e-4}
    result = Model(motor()).simulate(until=0.1, method=method, integrator=integrator, **settings)
    assert result.outputs["i"][-1] == pytest.approx(wanted.outputs["i"][-1], abs=1e-8)


#: Method and integrator, and the order of a constant step, of schemes whose unknowns are not the stages of a tableau.
SCHEMES = [
    ("lagrange", "newmark", 2),
    ("lagrange", "rodas", 4),
    ("generalized-alpha", "hht", 2),
    ("generalized-alpha", "generalized-alpha", 2),
    ("index3-augmented-lagrangian", "trapezoidal", 2),
    ("rattle", "rattle", 2),
    ("discrete-gradient", "discrete-gradient", 2),
    ("symmetric-projection", "gauss", 4),
    ("half-explicit", "half-explicit", 3),
    ("half-explicit", "phem56", 5),
]


@pytest.mark.parametrize(("method", "integrator", "order"), SCHEMES)
def test_orders_with_a_state(method, integrator, order):
    """Of the motor's current and speed against the matrix exponential, each halving of the step."""
    matrix = np.array([[-0.05 / 0.04, 0.7 / 0.04, 0.0], [-0.7 / 0.02, -1.2 / 0.02, 3.0 / 0.02], [0.0, 0.0, 0.0]])
    wanted, options = (expm(0.1 * matrix) @ [0.5, 0.1, 1.0])[:2], {"options": {"integrator.adaptive": "false"}}
    errors = []
    for step in (2e-3, 1e-3) if order > 3 else (5e-4, 2.5e-4):  # of order 5 more than rounding is left
        settings = {"until": 0.1, "step": step, "method": method, "integrator": integrator}
        settings |= options if integrator in ("generalized-alpha", "hht", "phem56", "rodas") else {}
        result = Model(motor()).simulate(**settings)
        errors.append(np.abs([result.v["wheel.omega"][-1], result.outputs["i"][-1]] - wanted))
    np.testing.assert_allclose(np.log2(errors[0] / errors[1]), order, rtol=0.03)


@pytest.mark.by_turns(4)
@pytest.mark.fast("symmetric-projection-gauss-4-joint", "half-explicit-phem56-5-absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint", "looped"])
@pytest.mark.parametrize(("method", "integrator", "order"), SCHEMES)
def test_schemes_with_a_state_in_a_loop(method, integrator, order, coordinates):
    """A four-bar and its motor beside a run of dop853: what a step of 2e-4 leaves of an error of this order."""
    model, settings = Model(driven_four_bar()), {"until": 0.1}
    settings |= {"shape": "looped"} if coordinates == "looped" else {"coordinates": coordinates}
    chosen = integrator in ("generalized-alpha", "hht", "phem56", "rodas")
    options = {"options": {"integrator.adaptive": "false"}} if chosen else {}
    wanted = model.simulate(**settings, **TIGHT)
    result = model.simulate(**settings, **options, step=2e-4, method=method, integrator=integrator)
    assert result.outputs["i"][-1] == pytest.approx(
        wanted.outputs["i"][-1], abs={2: 2e-6, 3: 1e-9, 4: 1e-10, 5: 1e-10}[order]
    )
    np.testing.assert_allclose(
        result.v.values[-1], wanted.v.values[-1], atol={2: 1e-7, 3: 1e-11, 4: 1e-11, 5: 1e-11}[order]
    )


@pytest.mark.slow
def test_generalized_alpha_controls_the_error_of_states():
    """A thousand times less is allowed, and ten times the steps, as order 2 takes; a stiff state takes few of them."""
    settings = {"method": "generalized-alpha", "options": {"integrator.adaptive": "true"}}
    wanted = Model(motor()).simulate(until=0.1, **TIGHT).outputs["i"][-1]
    rough, fine = (Model(motor()).simulate(until=0.1, rtol=tol, atol=tol, **settings) for tol in (1e-6, 1e-9))
    errors = [abs(run.outputs["i"][-1] - wanted) for run in (rough, fine)]
    assert errors[0] < 1e-4 and errors[1] < 0.02 * errors[0]
    assert 7 < fine.steps / rough.steps < 13
    stiff = Model(motor(1.2e-6)).simulate(until=1.0, rtol=1e-6, **settings)
    assert stiff.steps < 500
    assert stiff.outputs["i"][-1] == pytest.approx((3.0 - 0.7 * stiff.v["wheel.omega"][-1]) / 1.2, rel=1e-5)


@pytest.mark.slow_cases(
    "augmented-hamiltonian-absolute", "augmented-hamiltonian-joint", "hamiltonian-baumgarte-absolute"
)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("method", ["augmented-hamiltonian", "hamiltonian-baumgarte"])
def test_methods_of_momenta_take_states(method, coordinates):
    """In a loop, where v is not what the state holds: rates of states are those at v."""
    model, settings = Model(driven_four_bar()), {"until": 0.1, "coordinates": coordinates, **TIGHT}
    wanted, result = (model.simulate(method=name, **settings) for name in ("lagrange", method))
    assert result.outputs["i"][-1] == pytest.approx(wanted.outputs["i"][-1], abs=1e-10)
    np.testing.assert_allclose(result.v.values[-1], wanted.v.values[-1], atol=1e-11)


@pytest.mark.slow
def test_lanes_run_states_as_single_runs_do():
    settings = {"integrator": "rk4", "step": 1e-3, "until": 0.1, "quantities": ["i", "wheel.omega"]}
    single, lanes = (
        symgen.sweep(motor(), {"R": [1.2, 2.0], "i": [0.1, 0.4, 0.7]}, target=target, **settings)
        for target in ("cpu", "lanes")
    )
    for name in settings["quantities"]:
        np.testing.assert_allclose(lanes[name], single[name], rtol=1e-14)
        assert np.ptp(lanes[name][..., -1]) > 0.01


def test_what_a_file_does_not_use_costs_nothing():
    """A state that no force reads adds the operations of its own rate, and none without states."""
    raw = motor_file()
    del raw["states"]
    raw["forces"]["drive"]["torque"] = "K*U - 0.05*wheel.omega"
    without = Model(validate(raw, "motor")).compiled(choose_method("lagrange")).law.operations["rhs"]
    raw["states"] = {"x": {"rate": "U"}}
    assert Model(validate(raw, "motor")).compiled(choose_method("lagrange")).law.operations["rhs"] == without
    raw["states"] = {"x": {"rate": "wheel.omega - x"}}
    assert Model(validate(raw, "motor")).compiled(choose_method("lagrange")).law.operations["rhs"] == without + 1
