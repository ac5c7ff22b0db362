"""Parameters set on the way and controllers on a clock, against motions known in closed form."""

import math
import pickle

import numpy as np
import pytest
from support.checks import assert_same_arrays
from support.emitted import mechanism_of

import symgen
from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout import abi

#: A rod on a pin with a spiral spring and a motor, no gravity: (m l^2 / 12 + m c^2) theta'' = u - k theta.
ROD = {
    "mechanism": {"name": "rod-on-a-spring"},
    "parameters": {"mass": 3.0, "lever": 0.5, "stiffness": 4.0, "torque": 0.0, "idle": 1.0},
    "bodies": {
        "rod": {
            "mass": "mass",
            "inertia": "mass/12",
            "points": {"end": ["-lever", 0.0]},
            "position": [0.5 * math.cos(0.4), 0.5 * math.sin(0.4)],
            "angle": 0.4,
            "angular_velocity": 0.0,
        }
    },
    "joints": {"pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "end"]}},
    "forces": {
        "spring": {"type": "torsional-spring-damper", "between": ["ground", "rod"], "stiffness": "stiffness"},
        "motor": {"type": "torque", "body": "rod", "torque": "torque*idle"},
    },
}
TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13, "until": 2.0}
CONSTANT = {"options": {"integrator.adaptive": "false"}}


@pytest.fixture(scope="module")
def rod():
    return symgen.load(mechanism_of(ROD))


def swing(theta, omega, t, stiffness=4.0, mass=3.0, torque=0.0):
    """Angle and rate after a time: the oscillation about torque / stiffness, or a parabola where there is no spring."""
    inertia = mass / 3.0
    if stiffness == 0.0:
        return theta + omega * t + torque / inertia * t * t / 2.0, omega + torque / inertia * t
    w, rest = math.sqrt(stiffness / inertia), torque / stiffness
    x = theta - rest
    return rest + x * math.cos(w * t) + omega / w * math.sin(w * t), -x * w * math.sin(w * t) + omega * math.cos(w * t)


def at(sim):
    return sim.q["rod.theta"], sim.v["rod.omega"]


def energy(sim):
    """Kinetic and potential energy, work, and the balance of the three."""
    state = sim._loop.state
    t, v, work = float(state.w[abi.KINETIC]), float(state.w[abi.POTENTIAL]), float(state.y[6])
    return t, v, work, t + v - float(state.gauges[abi.ENERGY_START]) - work


@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_numbers_of_forces_masses_and_inputs_change_on_the_way(rod, shape):
    sim = rod.start(**TIGHT, shape=shape)
    sim.run(0.7)
    expected = swing(0.4, 0.0, 0.7)
    sim.set(stiffness=9.0)
    assert sim.parameters == {"mass": 3.0, "lever": 0.5, "stiffness": 9.0, "torque": 0.0, "idle": 1.0}
    sim.step(0.5)
    np.testing.assert_allclose(at(sim), expected := swing(*expected, 0.5, 9.0), atol=1e-10)
    sim.set({"mass": 2.0}, torque=1.5)
    sim.step(0.4)
    np.testing.assert_allclose(at(sim), expected := swing(*expected, 0.4, 9.0, 2.0, 1.5), atol=1e-10)
    sim.step(0.3, u={"torque": -2.0})
    sim.step(0.1)  # held
    np.testing.assert_allclose(at(sim), swing(*expected, 0.4, 9.0, 2.0, -2.0), atol=1e-10)


def test_what_a_change_adds_to_the_energy_is_work(rod):
    sim = rod.start(**TIGHT)
    sim.run(0.7)
    theta, omega = swing(0.4, 0.0, 0.7)
    sim.set(stiffness=9.0)
    kinetic, potential, work, balance = energy(sim)
    assert work == pytest.approx(0.5 * 5.0 * theta**2, rel=1e-9)
    assert (kinetic, potential) == pytest.approx((0.5 * omega**2, 0.5 * 9.0 * theta**2), rel=1e-9)
    sim.run(1.0)
    theta, omega = swing(theta, omega, 0.3, 9.0)
    before = energy(sim)[2]
    sim.set(mass=6.0)
    kinetic, potential, work, balance = energy(sim)
    assert work - before == pytest.approx(0.5 * 1.0 * omega**2, rel=1e-9)
    assert abs(balance) < 1e-10
    sim.run(3.0)
    assert abs(energy(sim)[3]) < 1e-10


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "abm",
    "bdf",
    "picard",
    "rkmk4-screws",
    "radau5",
    "discrete-gradient",
    "phem56",
    "rattle",
    "half-explicit",
    "generalized-alpha",
    "hht",
)
@pytest.mark.parametrize("integrator", INTEGRATORS.names)
def test_schemes_keep_their_order_over_a_change(rod, integrator):
    """What they remember of the rates before it is forgotten."""
    chosen = INTEGRATORS.get(integrator)
    method = integrator if integrator in METHODS.names else "lagrange"
    method = {"phem56": "half-explicit", "gauss": "symmetric-projection", "hht": "generalized-alpha"}.get(
        integrator, method
    )
    expected = swing(*swing(0.4, 0.0, 1.0), 1.0, 9.0)
    # a first step at which the error is far from rounding and falls as it is to
    own = {"abm": 0.0625, "bdf": 0.04, "dop853": 0.25, "picard": 1.0}
    first = own[integrator] if integrator in own else {1: 0.01, 2: 0.04, 3: 0.05, 4: 0.0625, 5: 0.1}[chosen.order]
    errors = []
    for step in (first, first / 2):
        more = CONSTANT if chosen.adaptive else {}
        settings = {"method": method, "integrator": integrator, "until": 2.0, "max_violation": 1.0, **more}
        sim = rod.start(**settings, step=step, max_energy_error=1e9)
        sim.run(1.0)
        sim.set(stiffness=9.0)
        sim.run(2.0)
        errors.append(float(np.abs(np.subtract(at(sim), expected)).max()))
    assert math.log2(errors[0] / errors[1]) > chosen.order - 0.2


@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_what_moves_a_joint_or_has_no_sense_is_refused_and_changes_nothing(rod, shape):
    sim = rod.start(**TIGHT, shape=shape)
    # looped code has the numbers that parameters alone decide from the formulas, and names the one
    overflow = "set: expected parameters" if shape == "straight" else "expected a finite number, got 'torque*idle'"
    sim.run(0.3)
    before = sim.save()
    for values, sentence in (
        ({"lever": 0.6}, "set: expected parameters that leave the position of every joint as it is, got a violation"),
        ({"mass": 0.0}, "set: expected a mass and an inertia of rod above 0, got 0"),
        ({"mass": -1.0}, "set: expected a mass and an inertia of rod above 0, got -1"),
        ({"stiffness": math.nan}, "parameter 'stiffness': expected a finite number, got nan"),
        ({"stiffnes": 1.0}, "did you mean 'stiffness'?"),
        ({"stiffness": 1e308, "torque": 1e308, "idle": 1e308}, overflow),
    ):
        with pytest.raises(symgen.InputError) as error:
            sim.set(values)
        assert sentence in str(error.value)
        after = sim.save()
        assert after.parameters == before.parameters
        assert_same_arrays(after.arrays, before.arrays)
    sim.set(lever=0.5 + 1e-9)  # less than the run tolerates


def test_setting_what_is_there_already_changes_nothing(rod):
    sim, other = (rod.start(integrator="abm4", step=0.01) for _ in range(2))
    for k in range(10):
        sim.step(0.01, u={"torque": 0.0} if k % 2 else None)
        other.step(0.01)
    np.testing.assert_array_equal(sim.state, other.state)


# -- controllers -------------------------------------------------------------------------------------------------------


def sampled(beats, h, gains=(2.0, 1.1)):
    """The rod without a spring under a controller that samples and holds: states at its beats."""
    x, found = (0.4, 0.0), []
    for _ in range(beats):
        found.append(x)
        x = swing(*x, h, 0.0, 3.0, -gains[0] * x[0] - gains[1] * x[1])
    return found


@pytest.mark.parametrize("integrator", ["dop853", "rk4", "abm4"])
def test_a_controller_is_called_at_multiples_of_its_interval(rod, integrator):
    more = {"rtol": 1e-12, "atol": 1e-13} if integrator == "dop853" else {"step": 1e-3}
    sim = rod.start(integrator=integrator, until=2.0, parameters={"stiffness": 0.0}, **more)
    times, seen = [], []

    def controller(t, run):
        times.append(t)
        seen.append(at(run))
        assert run.t == pytest.approx(t, abs=1e-15)
        return {"torque": -2.0 * run.q["rod.theta"] - 1.1 * run.v["rod.omega"]}

    sim.every(0.1, controller)
    sim.run(1.23)
    sim.step(0.07)
    sim.run(2.0)
    assert times == [k * 0.1 for k in range(20)]  # one at 2.0 belongs to what comes after
    # what 1000 steps of order 4 are off by, times the slack that a state of another order of magnitude would need
    np.testing.assert_allclose(seen, sampled(20, 0.1), atol=1e-10 if integrator == "dop853" else 1e-9)


def test_controllers_of_several_rates_and_pieces_make_no_difference(rod):
    settings = {"integrator": "abm4", "step": 1e-3, "until": 1.0}

    def made():
        sim, calls = rod.start(**settings), []
        sim.every(0.004, lambda t, run: calls.append(("a", t)) or {"torque": math.sin(9 * t) - run.v["rod.omega"]})
        sim.every(0.01, lambda t, run: calls.append(("b", t)) or run.set(stiffness=4.0 + math.cos(t)))
        return sim, calls

    whole, calls = made()
    whole.run(0.1)
    part, others = made()
    for dt in (0.001, 0.003, 0.016, 0.02):
        part.step(dt)
    saved = pickle.loads(pickle.dumps(part.save()))
    part, more = made()
    part.restore(saved)
    part.run(0.1)
    assert others + more == calls and len(calls) == 25 + 10
    assert [t for name, t in calls if name == "b"] == [k * 0.01 for k in range(10)]
    np.testing.assert_array_equal(part.state, whole.state)
    assert part.parameters == whole.parameters


def test_beats_between_steps_are_met_by_shortened_ones(rod):
    sim, times = rod.start(integrator="rk4", step=0.01), []
    sim.every(0.0125, lambda t, run: times.append((t, run.t)))
    sim.run(0.1)
    assert len(times) == 8 and all(t == now for t, now in times)
    free, beats = rod.start(integrator="rk4"), []
    free.every(0.03, lambda t, run: beats.append(run.steps))
    free.step(0.1)  # three whole intervals and a rest: one step each
    assert beats == [0, 1, 2, 3] and free.steps == 4


def test_a_controller_neither_steps_nor_restores_and_its_errors_come_through(rod):
    sim = rod.start(integrator="rk4", step=0.01)
    saved = sim.save()
    for call in (lambda t, run: run.step(0.1), lambda t, run: run.run(1.0), lambda t, run: run.restore(saved)):
        other = rod.start(integrator="rk4", step=0.01)
        other.every(0.1, call)
        with pytest.raises(symgen.SimulationError, match="a controller cannot call"):
            other.step(0.1)
    calls = []

    def fails_once(t, run):
        calls.append(t)
        if len(calls) == 2:
            raise RuntimeError("no signal")

    sim.every(0.05, fails_once)
    with pytest.raises(RuntimeError, match="no signal"):
        sim.run(0.2)
    assert sim.t == pytest.approx(0.05)
    sim.run(0.2)
    assert calls == [0.0, 0.05, 0.05, 0.1, 3 * 0.05]
    with pytest.raises(symgen.InputError, match="controllers as that which was saved"):
        sim.restore(saved)
