"""Rows that may be off, where they are in force: analyses, sweeps and targets give what they do without such rows."""

from functools import cache

import msgspec
import numpy as np
import pytest
from support.set_modes import set_modes
from support.switching import with_switchable

import symgen
from symgen.base.settings import Settings
from symgen.run.layout import abi
from symgen.run.planning.prepare import prepare

RUN = {"method": "lagrange", "integrator": "rk4", "step": 1e-3, "until": 0.2}


@cache
def models():
    """The four-bar whose last joint may be off, and as it is."""
    whole = symgen.load("four-bar")
    return symgen.load(with_switchable(whole.mechanism, whole.mechanism.joints[-1].name)), whole


@pytest.mark.slow
def test_linear_systems_modes_and_equilibria_are_those_of_the_closed_mechanism():
    (switched, whole), near = models(), {"rtol": 1e-10, "atol": 1e-12}
    np.testing.assert_allclose(switched.linearise().eigenvalues(), whole.linearise().eigenvalues(), **near)
    np.testing.assert_allclose(switched.modes().frequencies, whole.modes().frequencies, **near)
    rest, expected = switched.equilibrium(), whole.equilibrium()
    np.testing.assert_allclose(list(rest.q.values()), list(expected.q.values()), **near)
    np.testing.assert_allclose(list(rest.multipliers.values()), list(expected.multipliers.values()), rtol=1e-8)


@pytest.mark.slow
def test_efforts_of_a_motion_are_those_of_the_closed_mechanism():
    switched, whole = models()
    motion = whole.simulate(**RUN, times=(0.0, 0.1, 0.2))
    found, expected = (model.inverse(motion, actuators="A").efforts.values for model in (switched, whole))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("how", [{}, {"coordinates": "joint"}, {"target": "lanes"}], ids=["cpu", "joint", "lanes"])
def test_rows_of_a_sweep_are_those_of_the_closed_mechanism(how):
    switched, whole = models()
    found = symgen.sweep(switched, {"crank.theta": [0.3, 0.5]}, **RUN, **how)
    for i, angle in enumerate((0.3, 0.5)):
        one = whole.simulate(start={"crank.theta": angle}, **RUN)
        assert found.status[i] == one.status == "ok"
        for name in ("crank.theta", "rocker.omega"):
            np.testing.assert_allclose(found[name][i, -1], one[name][-1], rtol=0.0, atol=1e-10)


@pytest.mark.slow_cases("lagrange", "implicit-constraint")
@pytest.mark.parametrize("method", ["lagrange", "implicit-constraint"])
def test_semi_implicit_steps_without_the_joint_are_those_of_the_open_mechanism(method):
    """The joint is off from 0.1 s on: the same steps from there as without it."""
    switched, whole = models()
    *others, last = whole.mechanism.joints
    open_ = symgen.load(msgspec.structs.replace(whole.mechanism, joints=tuple(others), outputs=()))
    limits = {"max_violation": 1.0, "max_energy_error": 1e6, "shape": "straight", "until": 0.2, "step": 1e-3}
    settings = Settings(method=method, integrator="symplectic-euler", verify=False, **limits)
    first, second = (prepare(m.mechanism, settings).simulation() for m in (switched, open_))
    nothing, n = np.zeros(0), first.compiled.info.work
    assert first.enter(first.outputs(nothing), until=0.1) == abi.DONE
    second.state.y[:n] = first.state.y[:n]
    set_modes(first, {f"{last.name}.{axis}": (0.0, 0.0, 0.0, 0.0) for axis in "xy"})
    assert first.enter(first.outputs(nothing), until=0.2) == abi.DONE
    assert second.enter(second.outputs(nothing), until=0.1) == abi.DONE
    np.testing.assert_allclose(first.state.y[:n], second.state.y[:n], rtol=0.0, atol=1e-12)
