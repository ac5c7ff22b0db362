"""Runs in pieces from Python: bit for bit the runs in one piece, and those that `simulate` makes."""

import pickle

import numpy as np
import pytest
from support.checks import assert_same_arrays, assert_same_motion
from support.processes import python
from support.remembering import CONSTANT, PAIRS

import symgen
from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS

STEP, STEPS = 2e-3, 12
LOOSE = {"max_violation": 1.0, "max_energy_error": 1e9, "shape": "straight"}
#: Methods whose laws or corrections are unlike those of `PAIRS`.
MORE = [
    (name, "rk4")
    for name in METHODS.names
    if "ode" in METHODS.get(name).forms and name not in {method for method, _ in PAIRS}
]


@pytest.fixture(scope="module")
def four_bar():
    return symgen.load("four-bar")


def assert_same(sim, other):
    """Two runs remember the same."""
    assert_same_arrays(sim.save().arrays, other.save().arrays)


def assert_end(sim, result):
    """The last output of a run is where the steps have led to."""
    assert_same_motion(sim.state, np.concatenate([result.q.values[-1], result.v.values[-1]]))


@pytest.mark.by_turns(4)
@pytest.mark.fast(
    "direct-correction-rkmk4-screws",
    "generalized-alpha-generalized-alpha",
    "index3-augmented-lagrangian-trapezoidal",
    "half-explicit-half-explicit",
    "discrete-gradient-discrete-gradient",
    "implicit-constraint-symplectic-euler",
    "compliant-constraints-rk4",
    "controllable-velocity-projection-rk4",
)
@pytest.mark.parametrize(("method", "integrator"), [*PAIRS, *MORE])
def test_steps_are_one_run(four_bar, method, integrator):
    """Constant steps: pieces of one, two and more of them, each in another run that takes up where the last one was."""
    more = LOOSE | (CONSTANT if INTEGRATORS.get(integrator).adaptive else {})
    settings = {"method": method, "integrator": integrator, "step": STEP, "until": STEP * STEPS, **more}
    whole = four_bar.simulate(**settings, times=[STEP * STEPS])
    one, other = four_bar.start(**settings), four_bar.start(**settings)
    one.run(STEP * STEPS)
    part = other
    for steps in (1, 1, 2, 5, 1, 2):
        part.step(steps * STEP)
        saved, part = pickle.loads(pickle.dumps(part.save())), four_bar.start(**settings)
        part.restore(saved)
    assert part.steps == whole.steps == STEPS
    assert_same(part, one)
    assert_end(part, whole)


@pytest.mark.slow_cases("half-explicit-phem56")
@pytest.mark.parametrize(("method", "integrator"), [p for p in PAIRS if INTEGRATORS.get(p[1]).adaptive])
def test_adaptive_pieces_end_where_they_are_told_to(four_bar, method, integrator):
    settings = {"method": method, "integrator": integrator, "until": 1.0, **LOOSE}
    sim, other = four_bar.start(**settings), four_bar.start(**settings)
    for k in range(1, 8):
        sim.run(k * 0.07)
        assert sim.t == k * 0.07
        other.restore(sim.save())
        sim.step(0.03)
        other.step(0.03)
        assert other.t == k * 0.07 + 0.03
        assert_same(sim, other)
    whole = four_bar.simulate(**settings, times=[sim.t])
    np.testing.assert_allclose(sim.q, whole.q.values[-1], atol=1e-6)  # 30 times the error of the pair that is worst


@pytest.mark.by_turns(3)
@pytest.mark.fast("heavy-top-ggl-radau5-0.001")
@pytest.mark.parametrize(
    ("name", "method", "integrator", "step"),
    [
        ("spatial-slider-crank", "coordinate-partitioning", "abm4", 1e-3),
        ("bricard", "direct-correction", "rk4", 2e-3),
        ("spherical-double-pendulum", "augmented-lagrangian", "rkmk4", 1e-3),
        ("heavy-top", "ggl", "radau5", 1e-3),
    ],
)
def test_in_space(name, method, integrator, step):
    """Euler parameters, turns that are counted, rows that depend on others."""
    model = symgen.load(name)
    more = LOOSE | (CONSTANT if INTEGRATORS.get(integrator).adaptive else {})
    settings = {"method": method, "integrator": integrator, "step": step, "until": 12 * step, **more}
    whole, one = model.simulate(**settings, times=[12 * step]), model.start(**settings)
    one.run(12 * step)
    sim = model.start(**settings)
    for steps in (1, 4, 7):
        sim.step(steps * step)
        saved, sim = sim.save(), model.start(**settings)
        sim.restore(saved)
    assert_same(sim, one)
    assert_end(sim, whole)


def test_a_saved_state_goes_on_in_another_process(four_bar, tmp_path):
    """With a method that keeps factors and past points, and a parameter that was changed."""
    settings = {"method": "coordinate-partitioning", "integrator": "abm", "step": STEP, **LOOSE, **CONSTANT}
    sim = four_bar.start(**settings)
    sim.run(10 * STEP)
    sim.set(rocker_mass=4.0)
    sim.step(STEP)
    (tmp_path / "saved").write_bytes(pickle.dumps((settings, sim.save())))
    code = (
        "import pickle, sys, symgen\n"
        "settings, saved = pickle.load(open(sys.argv[1], 'rb'))\n"
        "sim = symgen.load('four-bar').start(**settings)\n"
        "sim.restore(saved)\n"
        "assert sim.parameters['rocker_mass'] == 4.0\n"
        "sim.step(20 * 2e-3)\n"
        "print(sim.state.tobytes().hex())"
    )
    done = python(code, tmp_path / "saved")
    assert done.returncode == 0, done.stderr
    sim.step(20 * STEP)
    np.testing.assert_array_equal(np.frombuffer(bytes.fromhex(done.stdout)), sim.state)


@pytest.mark.parametrize("integrator", ["rk4", "abm4", "generalized-alpha"])
def test_without_a_step_each_call_is_one(four_bar, integrator):
    settings = {"integrator": integrator, "until": 0.05, **LOOSE}
    if integrator == "generalized-alpha":
        settings["method"] = integrator
    sim = four_bar.start(**settings)
    for _ in range(10):
        sim.step(3e-3)
    whole = four_bar.simulate(**settings, step=3e-3, times=[0.03])
    assert sim.steps == 10
    assert_same_motion(sim.q, whole.q.values[-1])
    other = four_bar.start(**settings)
    other.restore(sim.save())
    for run in (sim, other):
        run.step(2e-3)
        run.step(2e-3)
        assert run.steps == 12 and run.t == pytest.approx(0.034, abs=1e-15)
    np.testing.assert_array_equal(other.state, sim.state)
    sim.run(0.044)  # by steps of the mechanism, 1e-3 s
    assert sim.steps == 22


def test_a_piece_that_is_no_multiple_of_the_step_ends_with_a_shortened_one(four_bar):
    sim = four_bar.start(method="lagrange", integrator="rk4", step=0.01, until=1.0, **LOOSE)
    sim.step(0.025)
    assert sim.steps == 3 and sim.t == 0.025
    sim.step(0.02)
    assert sim.steps == 5 and sim.t == pytest.approx(0.045, abs=1e-15)
    sim.step(0.004)
    assert sim.steps == 6
    by_hand = four_bar.start(method="lagrange", integrator="rk4", until=1.0, **LOOSE)
    for dt in (0.01, 0.01, 0.005, 0.01, 0.01, 0.004):
        by_hand.step(dt)
    np.testing.assert_allclose(sim.state, by_hand.state, rtol=0.0, atol=1e-14)  # times differ by rounding


@pytest.mark.parametrize("integrator", ["rk4", "dopri5"])
def test_times_that_differ_by_rounding_are_one(four_bar, integrator):
    sim, beats = four_bar.start(integrator=integrator, step=1e-3), []
    sim.every(0.1, lambda t, run: beats.append(t))
    sim.run(0.3)
    steps = sim.steps
    for until in (0.1 + 0.2, 0.3, 3 * 0.1, np.nextafter(0.3, 0.0)):
        sim.run(until)
    assert sim.steps == steps and beats == [0.0, 0.1, 0.2]
    sim.run(0.4)
    assert beats == [0.0, 0.1, 0.2, 3 * 0.1]


def test_the_end_of_the_settings_is_no_end(four_bar):
    sim = four_bar.start(integrator="rk4", step=1e-3, until=0.01)
    sim.run(0.02)
    assert sim.steps == 20
    sim.run(0.02)
    assert sim.steps == 20


# -- views -------------------------------------------------------------------------------------------------------------


def test_views_show_the_present_and_have_names(four_bar):
    sim = four_bar.start(integrator="rk4", step=1e-3)
    q, v, before = sim.q, sim.v, sim.q.copy()
    assert np.shares_memory(q, sim.state) and np.shares_memory(v, sim.state)
    sim.step(0.1)
    result = four_bar.simulate(integrator="rk4", step=1e-3, until=0.1)
    assert q["crank.theta"] == result["crank.theta"][-1] != before[2]
    assert v["rocker.omega"] == result["rocker.omega"][-1]
    assert q.names == result.q.names and v.units == result.v.units
    np.testing.assert_array_equal(q["coupler"], q[3:6])
    assert np.shares_memory(q["coupler"], q)
    np.testing.assert_array_equal(sim.state["coupler"], [*q[3:6], *v[3:6]])
    assert sim.state["rocker.omega"] == sim.state[-1] == v[8]
    assert q.to_dict() == result.q.row(-1)
    for plain in (
        2.0 * q,
        q @ q,
        np.concatenate([q, v]),
        np.linalg.norm(q),
        q[1:],
        q.copy(),
        pickle.loads(pickle.dumps(q)),
    ):
        assert type(plain) in (np.ndarray, np.float64)
    np.testing.assert_array_equal(np.concatenate([q, v]), sim.state)
    with pytest.raises(ValueError, match="read-only"):
        q[0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        np.add(q, 1.0, out=q)
    with pytest.raises(symgen.InputError, match=r"got 'crank.thet'; did you mean 'crank.theta'\?"):
        q["crank.thet"]


def test_views_stay_after_restoring(four_bar):
    sim = four_bar.start(method="lagrange", integrator="radau5")
    q, saved = sim.q, sim.save()
    sim.step(0.5)
    sim.restore(saved)
    assert q is sim.q and q["crank.theta"] == saved.arrays["y"][2] and sim.t == saved.t == 0.0
