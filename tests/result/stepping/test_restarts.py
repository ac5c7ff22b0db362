"""Runs that begin anew from other values: the start of a fresh run to the last bit, with code and memory kept."""

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import AssemblyError, InputError
from symgen.run.planning import prepare, restarts
from symgen.run.starts import kept

#: A pendulum with a state of its own and an input.
LAGGING = {
    "mechanism": {"name": "lagging", "gravity": [0.0, -9.81]},
    "inputs": {"push": {"default": 0.5, "unit": "N m"}},
    "bodies": {"arm": {"mass": 1.0, "inertia": 0.1, "position": [0.5, 0.0], "points": {"end": [-0.5, 0.0]}}},
    "joints": {"A": {"type": "revolute", "between": ["ground", "arm"], "at": [[0.0, 0.0], "end"]}},
    "states": {"lag": {"rate": "arm.theta - lag", "start": 0.2}},
    "forces": {"drive": {"type": "torque", "body": "arm", "torque": "push - lag"}},
}
CONSTANT = {"integrator": "rk4", "step": 1e-3}
RUNS = {
    "loop": ("four-bar", CONSTANT, [{"crank.theta": 1.2}, {"crank.theta": 1.3}, {"crank.omega": 3.0}, {}]),
    "joint": ("slider-crank", CONSTANT, [{"O.angle": 0.4}, {"O.angle": 0.3, "O.rate": 2.0}, {"O.rate": 1.0}]),
    "tree": ("four-bar", {"coordinates": "joint", **CONSTANT}, [{"crank.theta": 1.2}, {"crank.theta": 1.3}]),
    "space": ("spherical-double-pendulum", CONSTANT, [{"upper.wy": 2.0}, {"upper.wy": 3.0}]),
    "adaptive": ("slider-crank", {}, [{"crank.theta": 0.3}, {"crank.theta": 0.9}]),
    "state": (LAGGING, CONSTANT, [{"lag": 0.7}, {"lag": 0.1, "arm.theta": 0.3}]),
}


@pytest.mark.parametrize("name", RUNS)
def test_another_start_is_that_of_a_fresh_run(name, monkeypatch):
    described, settings, others = RUNS[name]
    model = symgen.load(mechanism_of(described) if isinstance(described, dict) else described)
    sim = model.start(**settings)
    sim.run(0.02)
    fresh = [model.start(start=start, **settings) for start in others]
    with monkeypatch.context() as once:
        once.setattr(prepare, "find_preparation", None)  # nothing is planned or compiled anew
        for start, other in zip(others, fresh, strict=True):
            sim.reset(start)
            for array, expected in zip(sim.save().arrays.items(), other.save().arrays.items(), strict=True):
                np.testing.assert_array_equal(array[1], expected[1], err_msg=array[0])
            sim.run(0.02)
            other.run(0.02)
            result, expected = sim.result(), other.result()
            assert sim.bodies == other.bodies and result.notes == expected.notes and result.start == expected.start
    sim.reset()
    assert sim.t == 0.0 and sim.bodies == model.start(**settings).bodies


ALIKE = {
    "loop": {"crank.theta": 1.2, "crank.omega": 3.0},
    "joint": {"O.rate": 1.0, "O.angle": 0.3},
    "tree": {"crank.theta": 1.2},
    "space": {"upper.wy": 2.0, "upper.wx": 0.5},
}


@pytest.mark.parametrize("name", ALIKE)
def test_a_start_that_differs_in_values_alone_is_that_of_a_fresh_run(name, monkeypatch):
    described, settings, _ = RUNS[name]
    model = symgen.load(described)
    sim = model.start(**settings)
    sim.reset(ALIKE[name])
    others = [{key: factor * x for key, x in ALIKE[name].items()} for factor in (1.1, 0.9, 1.0)]
    fresh = [model.start(start=start, **settings) for start in others]
    monkeypatch.setattr(restarts, "read_holds", None)  # names are looked up once
    for start, other in zip(others, fresh, strict=True):
        sim.reset(start)
        for array, expected in zip(sim.save().arrays.items(), other.save().arrays.items(), strict=True):
            np.testing.assert_array_equal(array[1], expected[1], err_msg=array[0])


def test_a_start_that_differs_in_values_alone_may_be_refused():
    sim = symgen.load("four-bar").start(**CONSTANT)
    sim.reset({"rocker.theta": 2.2})
    before = sim.bodies
    with pytest.raises(AssemblyError, match="stays open"):
        sim.reset({"rocker.theta": 1.5})
    with pytest.raises(InputError, match="a finite number"):
        sim.reset({"rocker.theta": float("nan")})
    assert sim.bodies == before
    sim.reset({"rocker.theta": 2.2})
    assert sim.bodies == before


def test_starts_from_optimised_code_have_the_same_bits(monkeypatch):
    monkeypatch.setattr(kept, "MANY", 2)
    sim = symgen.load("four-bar").start(**CONSTANT)
    states = []
    for _ in range(3):
        sim.reset({"crank.theta": 1.2})
        states.append(sim.save().arrays)
    for other in states[1:]:
        for name, array in states[0].items():
            np.testing.assert_array_equal(other[name], array, err_msg=name)


def test_a_reset_to_the_run_s_own_start_has_its_notes():
    sim = symgen.load("four-bar").start(**CONSTANT)
    own = sim.result().notes
    sim.reset({"crank.theta": 1.2})
    assert "the start holds crank.theta = 1.2 rad" in "; ".join(sim.result().notes)
    sim.reset()
    assert sim.result().notes == own


def test_a_start_that_is_refused_changes_nothing():
    sim = symgen.load("four-bar").start(**CONSTANT)
    sim.run(0.01)
    before = sim.bodies
    with pytest.raises(AssemblyError, match="stays open"):
        sim.reset({"rocker.theta": 1.5})
    with pytest.raises(InputError, match="none of that name"):
        sim.reset({"rocker.thta": 1.0})
    assert sim.bodies == before and sim.t == 0.01
