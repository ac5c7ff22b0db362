"""Analyses at a state where forces depend on time: the state at the instant, without a run, and with a word."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from analyses import rods

#: Phases of a force A sin(w t + phase) that acts at t = 0.
PHASES = np.linspace(0.0, 2.0 * math.pi, 13)
WORD = "depends on t: it counts as at t = 0 s"


def shaken_pendulum():
    """A rod of 2 kg and 1 m on a pin, by its formula at rest: A sin(phase) = m g l/2 sin(angle)."""
    rod = {**rods.ROD, "position": [0.0, -0.5], "angle": "-pi/2"}
    torque = {"type": "torque", "body": "rod", "torque": "3.0*sin(2*t + phase)"}
    pin = rods.pin("ground", "rod", rods.GROUND2, "A")
    return rods.model({"rod": rod}, {"pin": pin}, forces={"shake": torque}, parameters={"phase": 0.0})


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_frequencies_of_a_shaken_pendulum_are_those_about_its_rest_at_the_instant(coordinates):
    """Where the sine began at 0, a run of 1,834 s was followed by a stiff solver: modes did not end."""
    weight, inertia, model = 2.0 * rods.GRAVITY * 0.5, 2.0 / 3.0, shaken_pendulum()
    for phase in PHASES:
        own = {"coordinates": coordinates, "parameters": {"phase": float(phase)}}
        angle = math.asin(3.0 * math.sin(phase) / weight)
        square = weight * math.cos(angle) / inertia
        modes = model.modes(**own)
        assert_allclose(modes.omega_squared, [square], rtol=1e-9)
        assert_allclose(modes.frequencies, [math.sqrt(square) / (2.0 * math.pi)], rtol=1e-9)
        system = model.linearise(**own)
        assert_allclose(np.abs(system.eigenvalues().imag), math.sqrt(square), rtol=1e-9)
        rest = model.equilibrium(**own)
        assert_allclose(rest.q["rod.theta"], angle - 0.5 * math.pi, atol=1e-9)
        for found in (modes, system, rest):
            assert any(WORD in note and "'shake'" in note for note in found.notes)


def test_a_state_whose_rate_depends_on_time_counts_as_at_the_instant():
    """A lag c' = (10 + sin(8 t) - c)/0.1 presses a mass on a spring: it rests at 10 N over 100 N/m."""
    body = {"mass": 1.0, "inertia": 0.1}
    rail = rods.pin("ground", "a", rods.GROUND2, rods.GROUND2, "translational", axis=[1.0, 0.0])
    forces = {
        "spring": {"type": "spring-damper", "joint": "rail", "stiffness": 100.0},
        "push": {"type": "force", "body": "a", "force": ["c", 0.0]},
    }
    lag = {"c": {"rate": "(10 + sin(8*t) - c)/0.1"}}
    model = rods.model({"a": body}, {"rail": rail}, forces=forces, states=lag, gravity=[0.0, 0.0])
    assert_allclose(model.equilibrium().q["a.x"], 0.1, rtol=1e-9)
    assert_allclose(sorted(model.linearise().eigenvalues().imag), [-10.0, 0.0, 10.0], atol=1e-6)
    assert any("state 'c' " + WORD in note for note in model.linearise().notes)


def arm(seed, links=6, lighter=0.3):
    """An arm in space on an upright axis, whose links grow lighter, with a torque in each joint."""
    rng, z, before, half = np.random.default_rng(seed), 0.0, "ground", 0.0
    bodies, joints, forces, inputs = {}, {}, {}, {}
    for k in range(links):
        mass, length = 3.0 * lighter**k, 0.2 + 0.2 * rng.random()
        axis = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]][0 if k == 0 else rng.integers(3)]
        inertia = [mass * length**2 / 10.0 * (1.0 + 0.2 * rng.random()) for _ in range(3)]
        bodies[f"b{k}"] = {"mass": mass, "inertia": inertia, "position": [0.0, 0.0, z + 0.5 * length]}
        joints[f"j{k}"] = rods.pin(before, f"b{k}", [0.0, 0.0, half], [0.0, 0.0, -0.5 * length], axis=axis)
        forces[f"m{k}"] = {"type": "torque", "joint": f"j{k}", "torque": f"t{k}"}
        inputs[f"t{k}"] = {"default": 0.0, "unit": "N m"}
        z, before, half = z + length, f"b{k}", 0.5 * length
    return rods.model(bodies, joints, "spatial", forces=forces, inputs=inputs)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 5])
def test_a_rest_is_found_where_it_is_given_in_joint_coordinates(seed):
    """Weight and torques cancel, so that the sum of forces was no measure: 9e-8 'of the forces' was not balanced."""
    model = arm(seed)
    functions = model.functions(coordinates="joint")
    names = [c.name for c in functions.coordinates]
    pose, still = np.linspace(0.1, 0.6, len(names)), np.zeros(len(names))
    hold = {f"t{k}": float(torque) for k, torque in enumerate(functions.bias(pose, still))}
    there = dict(zip(names, pose, strict=True))
    rest = model.equilibrium(start=there, inputs=hold, coordinates="joint")
    assert_allclose([rest.q[name] for name in names], pose, atol=1e-12)
    system = model.linearise(start=there, inputs=hold, coordinates="joint")
    stood = {name: x for name, x in there.items() if name in system.states}
    assert len(stood) >= 5 and all(abs(system.about[name] - x) < 1e-12 for name, x in stood.items())
