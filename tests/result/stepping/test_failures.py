"""What goes wrong on the way: steps that fail, interrupts, arguments without sense."""

import _thread
import math
import pickle
import signal
import threading

import numpy as np
import pytest
from support.checks import assert_same_arrays

import symgen
from symgen.run.layout import abi
from symgen.run.single.simulation import Simulation


@pytest.fixture(scope="module")
def four_bar():
    return symgen.load("four-bar")


#: Settings under which a run of the four-bar ends after some steps -> what its reason says.
FAILING = {
    "drift": (
        {"method": "lagrange", "integrator": "euler", "step": 1e-3, "max_energy_error": 1e9},
        "velocity violation |D v - nu| exceeds",
    ),
    "energy": (
        {"method": "direct-correction", "integrator": "euler", "step": 0.02, "max_energy_error": 0.02},
        "energy leaves its balance",
    ),
    "explosion": (
        {
            **{"method": "baumgarte", "integrator": "rk4", "step": 0.02, "max_violation": 1e300},
            **{"options": {"method.alpha": 1e4, "method.beta": 1e4}, "max_energy_error": 1e300},
        },
        "no longer finite",
    ),
    "newton": ({"method": "generalized-alpha", "integrator": "generalized-alpha", "step": 0.9}, "did not converge"),
    "adaptive": (
        {"method": "lagrange", "integrator": "dopri5", "rtol": 1e-3, "atol": 1e-3, "max_violation": 1e-5},
        "position violation |Phi| exceeds",
    ),
    "most": ({"method": "lagrange", "integrator": "dopri5", "rtol": 1e-12, "max_attempts": 50}, "makes no progress"),
}


@pytest.mark.parametrize("name", FAILING)
def test_a_step_that_fails_leaves_the_last_accepted_state(four_bar, name):
    """The same state as that of a run that was told to pause before the failing step."""
    settings, sentence = FAILING[name]
    settings = {"shape": "straight", "until": 20.0, **settings}
    result = four_bar.simulate(**settings)
    assert result.status == "failed" and sentence in result.reason
    sim = four_bar.start(**settings)
    with pytest.raises(symgen.StepError) as error:
        sim.step(20.0)
    assert error.value.reason == str(error.value) == result.reason
    assert isinstance(error.value, symgen.SimulationError)
    assert sim.t <= error.value.time <= 20.0 and np.all(np.isfinite(sim.state))
    again = pickle.loads(pickle.dumps(error.value))
    assert (again.reason, again.time) == (error.value.reason, error.value.time)

    reached = sim.save()
    other = four_bar.start(**settings)
    other._loop.enter(other._loop.outputs(np.zeros(0)), 20.0, sim.steps)  # the loop itself, told to pause
    assert other.t == sim.t
    assert_same_arrays(reached.arrays, other.save().arrays)
    with pytest.raises(symgen.StepError) as later:
        sim.step(20.0)
    if name == "most":  # so many attempts are those of a call
        assert later.value.time > error.value.time
        return
    assert later.value.reason == error.value.reason
    assert_same_arrays(reached.arrays, sim.save().arrays)


def test_a_run_goes_on_after_a_failure_where_the_cause_is_removed(four_bar):
    sim = four_bar.start(method="generalized-alpha", integrator="generalized-alpha", until=10.0)
    with pytest.raises(symgen.StepError, match="did not converge"):
        for _ in range(100):
            sim.step(0.9)
    t = sim.t
    sim.step(0.01)
    assert sim.t == pytest.approx(t + 0.01, abs=1e-14)


def test_a_start_beyond_a_limit_is_an_error_too():
    with pytest.raises(symgen.StepError, match="at t = 0 s"):
        symgen.load("driven-four-bar").start(method="lagrange", step=1e-3, max_violation=1e-300)


@pytest.mark.slow
def test_an_interrupt_ends_a_long_run_at_an_accepted_state(four_bar):
    settings = {"method": "direct-correction", "integrator": "rk4", "step": 1e-3, "shape": "straight"}
    sim = four_bar.start(**settings)
    sim.run(0.01)  # everything is loaded: what frees memory meanwhile may swallow an interrupt
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # it is ignored where a shell runs behind
    try:
        timer = threading.Timer(0.3, _thread.interrupt_main)
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            sim.run(1e6)
        timer.join()
    finally:
        signal.signal(signal.SIGINT, before)
    steps, state = sim.steps, sim.state.copy()
    sim.step(1e-3)
    assert sim.steps == steps + 1
    other = four_bar.start(**settings)
    if steps:
        other.run(steps * 1e-3)
    np.testing.assert_array_equal(other.state, state)


def test_an_interrupt_between_a_failure_and_what_is_done_about_it_loses_no_state(four_bar, monkeypatch):
    settings, _ = FAILING["explosion"]
    sim = four_bar.start(**settings)
    sim.step(0.01)
    real = Simulation.go_until

    def interrupted(self, *arguments):
        code = real(self, *arguments)
        if code == abi.NOT_FINITE:
            monkeypatch.undo()
            raise KeyboardInterrupt
        return code

    monkeypatch.setattr(Simulation, "go_until", interrupted)
    with pytest.raises(KeyboardInterrupt):
        sim.step(20.0)
    assert 1 < sim.steps and np.all(np.isfinite(sim.state))
    other = four_bar.start(**settings)
    other.step(0.01)
    other._loop.enter(other._loop.outputs(np.zeros(0)), 20.0, sim.steps)
    assert_same_arrays(other.save().arrays, sim.save().arrays)


# -- arguments ---------------------------------------------------------------------------------------------------------


def test_what_has_no_sense_is_refused_in_one_sentence(four_bar):
    sim = four_bar.start(integrator="rk4", step=1e-3)
    sim.step(0.01)
    other = symgen.load("pendulum").start()
    adaptive = four_bar.start(integrator="dopri5")
    for call, sentence in (
        (lambda: four_bar.start(times=[0.1]), "start: times: expected settings of a run without outputs"),
        (lambda: four_bar.start(times=np.array([0.1, 0.2])), "start: times: expected settings of a run without"),
        (lambda: four_bar.start(repeat=2), "start: repeat: expected settings of a run without outputs"),
        (lambda: four_bar.start(stepp=2), "did you mean 'step'?"),
        *(
            (lambda x=x: sim.step(x), "dt: expected a finite number above 0")
            for x in (0, -1.0, math.nan, "1", None, True)
        ),
        (lambda: sim.run(0.005), "until: expected a time from 0.01 s on, where the run stands, got 0.005"),
        (lambda: sim.run(math.inf), "until: expected a finite number"),
        (lambda: sim.step(0.1, u=3.0), "set: expected numbers by the names of parameters, got 3.0"),
        (lambda: sim.step(0.1, u={"x": 1.0}), "parameter 'x': expected a parameter of four-bar"),
        (lambda: sim.set({3: 1.0}), "named by texts, got 3"),
        (lambda: sim.set(crank_mass="1"), "parameter 'crank_mass': expected a finite number, got '1'"),
        (lambda: sim.every(0.0, print), "interval: expected a finite number above 0"),
        (lambda: sim.every(0.1, 3), "controller: expected a function, got 3"),
        (lambda: sim.every(0.1, None), "controller: expected a function, got None"),
        (lambda: sim.restore({}), "restore: expected what `save` returned, got a dict of 0"),
        (lambda: sim.restore(other.save()), "restore: expected a state of mechanism four-bar ("),
        (
            lambda: sim.restore(adaptive.save()),
            "expected a state of integrator rk4 with constant steps, got one of dopri5",
        ),
        (lambda: sim.state["crank.x"] and sim.q["crnk"], "did you mean"),
    ):
        state = sim.save()
        with pytest.raises(symgen.InputError) as error:
            call()
        assert sentence in str(error.value)
        assert_same_arrays(state.arrays, sim.save().arrays)


def test_what_is_damaged_is_refused(four_bar):
    import dataclasses

    sim = four_bar.start(integrator="rk4", step=1e-3)
    saved = sim.save()
    for arrays in (
        {**saved.arrays, "y": saved.arrays["y"][:-1]},
        {**saved.arrays, "control": saved.arrays["control"].astype(float)},
        {name: a for name, a in saved.arrays.items() if name != "w"},
    ):
        with pytest.raises(symgen.InputError, match="as this run has it"):
            sim.restore(dataclasses.replace(saved, arrays=arrays))
