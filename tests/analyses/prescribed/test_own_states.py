"""States of a file's own in `kinematics`, `inverse` and `equilibrium`."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.random_closed import make

from symgen.base.errors import AnalysisError, InputError

TIMES = np.linspace(0.0, 0.4, 9)


def disc(**sections):
    """A disc on a pin that a torque of a state turns, which decays from 2."""
    return {
        "mechanism": {"name": "disc"},
        "states": {"c": {"rate": "-c", "start": 2.0}},
        "bodies": {"a": {"mass": 1.0, "inertia": 1.0}},
        "joints": {"p": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], "centre"]}}
        | sections.pop("joints", {}),
        "forces": {"other": {"type": "torque", "body": "a", "torque": "c"}} | sections.pop("forces", {}),
        **sections,
    }


DRIVEN = {"d": {"type": "driver", "joint": "p", "value": "t**2"}}
MOTOR = {"motor": {"type": "torque", "body": "a", "torque": "3"}}


def model_of(description):
    from symgen.api import Model
    from symgen.describe.files.validate import validate

    return Model(validate(description, "test"))


@pytest.mark.slow
def test_a_prescribed_motion_integrates_the_state():
    """The effort is I theta'' - c, with theta'' = 2 and c = 2 exp(-t), before the start as well."""
    model, t = model_of(disc(joints=DRIVEN, outputs={"o": "c + 1"})), np.array([-0.5, 0.0, 0.5, 1.0])
    for times in (t, t[1:]):
        moved = model.kinematics(times)
        np.testing.assert_allclose(moved.efforts["d"], 2.0 - 2.0 * np.exp(-times), atol=1e-8)
        np.testing.assert_allclose(moved.outputs["o"], 1.0 + 2.0 * np.exp(-times), atol=1e-8)
        assert moved.ok and not moved.notes
        for names in ([], ["d"], ["p"]):
            needed = model.inverse(times=times, actuators=names).efforts.values[:, 0]
            np.testing.assert_allclose(needed, 2.0 - 2.0 * np.exp(-times), atol=1e-8)
    begun = model.kinematics(t[1:], start={"c": 4.0, "a.theta": 0.0})
    np.testing.assert_allclose(begun.outputs["c"], 4.0 * np.exp(-t[1:]), atol=1e-8)


@pytest.mark.slow_cases(".nc")
@pytest.mark.parametrize("ending", [None, ".nc", ".csv", ".parquet"])
def test_a_recorded_motion_has_the_state(ending, tmp_path):
    model = model_of(disc(forces=MOTOR))
    run = model.simulate(until=1.0, times=np.linspace(0.0, 1.0, 3))
    motion = run if ending is None else tmp_path / f"run{ending}"
    if ending is not None:
        run.save(motion)
    np.testing.assert_allclose(model.inverse(motion, actuators=["motor"]).efforts["motor"], 3.0, atol=1e-9)


def test_a_record_without_the_state_is_refused(tmp_path):
    plain = disc(forces=MOTOR | {"other": {"type": "torque", "body": "a", "torque": "1"}})
    del plain["states"]
    file = tmp_path / "run.csv"
    model_of(plain).simulate(until=1.0, times=[0.0, 1.0]).save(file)
    with pytest.raises(InputError, match="no column 'c'"):
        model_of(disc(forces=MOTOR)).inverse(file, actuators=["motor"])


@pytest.mark.slow
def test_a_state_without_an_end_ends_in_a_sentence():
    """c' = c^2 from 2 has a pole at 0.5 s."""
    raw = disc(joints=DRIVEN, states={"c": {"rate": "c**2", "start": 2.0}})
    with pytest.raises(AnalysisError, match=r"cannot be integrated along the motion beyond t = 0\.[45]"):
        model_of(raw).kinematics([0.0, 0.4, 1.0])


def test_inputs_and_kinks_on_the_way():
    """A ramp that ends and an input that jumps: c' = omega + u - c in closed form, piece by piece."""
    joints = {"d": {"type": "driver", "joint": "p", "value": "2*min(t, 0.3)"}}
    raw = disc(joints=joints, states={"c": {"rate": "a.omega + u - c", "start": 0.0}}, inputs={"u": 0.0})
    moved = model_of(raw).kinematics([0.0, 0.1, 0.3, 0.4, 0.5, 1.0], inputs={"u": "piecewise(t < 0.5, 0, 3)"})
    first = 2.0 * (1.0 - np.exp(-np.array([0.0, 0.1, 0.3])))
    second = first[-1] * np.exp(-np.array([0.1, 0.2]))
    third = 3.0 + (second[-1] - 3.0) * np.exp(-0.5)
    np.testing.assert_allclose(moved.outputs["c"], [*first, *second, third], atol=1e-7)


RATES = (
    ("-{0:.3f}*x + sin({1:.3f}*t)", lambda a, b, t, q, v, x, z: -a * x + np.sin(b * t)),
    ("{0:.3f}*b0.omega - {1:.3f}*x + 0.3*z", lambda a, b, t, q, v, x, z: a * v - b * x + 0.3 * z),
    ("tanh({0:.3f}*b0.theta - x) - {1:.3f}*z", lambda a, b, t, q, v, x, z: np.tanh(a * q - x) - b * z),
    ("-80*(x - {0:.3f}*b0.omega**2) + {1:.3f}*t", lambda a, b, t, q, v, x, z: -80.0 * (x - a * v**2) + b * t),
)


@pytest.mark.by_turns(3)
@pytest.mark.fast("1")
@pytest.mark.parametrize("seed", range(8))
def test_random_states_along_driven_chains(seed):
    """States by SciPy along the motion in closed form; efforts are those of a run, which integrates everything."""
    rng = np.random.default_rng(seed)
    (first, f), (second, g) = (RATES[i] for i in rng.integers(len(RATES), size=2))
    a, b, c, d, amplitude, pace = (round(float(x), 3) for x in rng.uniform(0.4, 2.0, 6))
    start = [round(float(x), 3) for x in rng.uniform(-1.0, 1.0, 2)]
    links, joints, forces = {}, {}, {}
    for i in range(int(rng.integers(1, 4))):
        links[f"b{i}"] = {"mass": 1.0 + i, "inertia": 0.1, "points": {"low": [0.0, -0.5], "top": [0.0, 0.5]}}
        below = ["ground", [0.0, 0.0]] if i == 0 else [f"b{i - 1}", "top"]
        joints[f"j{i}"] = {"type": "revolute", "between": [below[0], f"b{i}"], "at": [below[1], "low"]}
        joints[f"d{i}"] = {"type": "driver", "joint": f"j{i}", "value": f"{amplitude}*sin({pace + i}*t)"}
        forces[f"f{i}"] = {"type": "torque", "body": f"b{i}", "torque": "3*x - 2*z"}
    states = {"x": {"rate": first.format(a, b), "start": start[0]}}
    swapped = second.format(c, d).replace("x", "?").replace("z", "x").replace("?", "z").replace("ezp", "exp")
    states["z"] = {"rate": swapped, "start": start[1]}
    model = model_of(
        {"mechanism": {"name": f"chain-{seed}", "gravity": [0.0, -9.81]}, "bodies": links, "joints": joints}
        | {"forces": forces, "states": states}
    )

    def rate(t, y):
        q, v = amplitude * np.sin(pace * t), amplitude * pace * np.cos(pace * t)
        return [f(a, b, t, q, v, y[0], y[1]), g(c, d, t, q, v, y[1], y[0])]

    expected = solve_ivp(rate, (0.0, TIMES[-1]), start, "Radau", t_eval=TIMES, rtol=1e-10, atol=1e-12).y
    moved = model.kinematics(TIMES)
    for name, values in zip("xz", expected, strict=True):
        np.testing.assert_allclose(moved.outputs[name], values, atol=1e-7)
    run = model.simulate(until=TIMES[-1], times=TIMES, method="lagrange", integrator="dop853", rtol=1e-10, atol=1e-11)
    for name in moved.drivers:
        np.testing.assert_allclose(moved.efforts[name], run[f"{name}.effort"], atol=1e-5)
    needed = model.inverse(times=TIMES, actuators=list(moved.drivers)[::-1]).efforts
    for name in moved.drivers:
        np.testing.assert_allclose(needed[name], moved.efforts[name], atol=1e-6)


@pytest.mark.by_turns(3)
@pytest.mark.fast("1")
@pytest.mark.parametrize("seed", range(8))
def test_random_states_in_recorded_motions(seed):
    """A motor's torque is a formula of time in the run; the motion needs just that."""
    raw = make(seed)
    body = next(name for name, keys in raw["bodies"].items() if keys.get("type") != "point")
    raw["states"] = {
        "x": {"rate": f"{body}.omega - 2*x + sin(3*t)", "start": 0.7},
        "z": {"rate": f"x*z - z + {body}.theta", "start": -0.4},
    }
    raw.setdefault("forces", {})["of_states"] = {"type": "torque", "body": body, "torque": "4*x - 3*z"}
    raw["forces"]["motor"] = {"type": "torque", "body": body, "torque": "3 + sin(5*t)"}
    model = model_of(raw)
    run = model.simulate(until=0.2, times=np.linspace(0.0, 0.2, 5), method="lagrange", integrator="dop853")
    needed = model.inverse(run, actuators=["motor"])
    assert needed.missing.max() < 1e-6 * max(1.0, float(np.abs(run.a.values).max()))
    np.testing.assert_allclose(needed.efforts["motor"], 3.0 + np.sin(5.0 * run.t), atol=1e-6)


@pytest.mark.parametrize("start", [0.0, 1e-9, 0.1, -2.0])
def test_an_equilibrium_with_a_state_whose_slope_is_singular_at_the_start(start):
    """s' = 1 - s^3 rests at 1; the torque s - 2 theta - omega is 0 at theta = 1/2."""
    raw = disc(states={"c": {"rate": "1 - c**3", "start": start}})
    raw["forces"]["other"]["torque"] = "c - 2*angle - rate"
    rest = model_of(raw).equilibrium()
    assert rest.states == {"c": pytest.approx(1.0, abs=1e-9)}
    assert rest.q["a.theta"] == pytest.approx(0.5, abs=1e-9) and rest.stability == "stable"
    assert rest.to_dict()["states"] == rest.states


def test_states_that_their_rates_do_not_determine():
    with pytest.raises(AnalysisError, match="rates of the states c do not determine them"):
        model_of(disc(states={"c": {"rate": "cos(t)"}})).equilibrium()


def test_the_multiplier_of_a_coupling_has_the_sign_of_all_others():
    """A torque of 1 turns two equal discs: the coupling takes half of it from the first, minus its factor times it."""
    raw = disc(joints={"q": {"type": "revolute", "between": ["ground", "b"], "at": [[1.0, 0.0], "centre"]}})
    raw["bodies"]["b"] = {"mass": 1.0, "inertia": 1.0, "position": [1.0, 0.0]}
    raw["joints"]["link"] = {"type": "coupling", "terms": {"p": 1.0, "q": -1.0}}
    raw["forces"]["other"]["torque"] = "1"
    run = model_of(raw).simulate(until=0.1, times=[0.0, 0.1], method="lagrange", integrator="rk4")
    np.testing.assert_allclose(run.lam["link.coupling"], 0.5, atol=1e-12)
    np.testing.assert_allclose(run.a["a.alpha"], 1.0 - run.lam["link.coupling"], atol=1e-12)
