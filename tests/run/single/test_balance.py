"""Energy balance of runs in which forces without potential, dampers and drivers do work, and momentum that is kept."""

import copy
import math

import numpy as np
import pytest
from support import reference
from support.emitted import mechanism_of
from support.kinds import METHODS
from support.plain import Plain
from support.runs import run

from symgen.api import load
from symgen.describe.catalogue import raw
from symgen.run.planning.automatic import constant_integrator

TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-12}


def loaded():
    """The driven four-bar with a damper, a spring, and a wind that changes with time."""
    description = copy.deepcopy(raw("driven-four-bar"))
    damper = {"type": "torsional-spring-damper", "between": ["coupler", "rocker"], "stiffness": 3.0, "damping": 7.0}
    wind = {"type": "force", "body": "coupler", "at": "C", "force": ["20*sin(3*t)", "-2*coupler.vy"]}
    description["forces"] = {"damper": damper, "wind": wind}
    return description


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS)
def test_work_of_drivers_and_losses_is_accounted_for(method):
    """E - E0 is the work that the run integrates as a state of its own; and that is the integral of the power."""
    description = loaded()
    outcome = run(load(mechanism_of(description)), method=method, **TIGHT, until=1.0, output_step=2e-3)
    assert outcome.code == 0
    assert outcome.energy_drift_max <= 1e-6
    plain, n = Plain(description), 9
    powers = []
    for t, y, lam in zip(outcome.times, outcome.states, outcome.multipliers, strict=True):
        q, v = y[:n].tolist(), y[n : 2 * n].tolist()
        _, lost = reference.applied(plain, t, q, v)
        powers.append(lost - lam @ np.array([reference.nu(plain, t, q)[r.name] for r in outcome.compiled.info.rows]))
    powers = np.array(powers)
    integral = np.concatenate([[0.0], np.cumsum((powers[1:] + powers[:-1]) / 2 * np.diff(outcome.times))])
    work = outcome.states[:, -1]
    assert np.abs(work).max() > 100.0 and abs(work[-1]) < 1e-6, "after a turn the energy is back where it was"
    np.testing.assert_allclose(work, integral, atol=1e-3 * np.abs(work).max())


@pytest.mark.slow
def test_momentum_is_kept_where_nothing_acts_from_outside():
    """Two bodies and a point, tied to each other only: linear and angular momentum."""
    rod = {"mass": 1.3, "inertia": 0.4, "points": {"P": [0.6, 0.1]}}
    description = {
        "mechanism": {"name": "free"},
        "bodies": {
            "a": rod | {"velocity": [0.3, -0.2], "angular_velocity": 1.5, "centre_of_mass": [0.1, 0.0]},
            "b": {"mass": 0.8, "inertia": 0.1, "position": [1.2, 0.3], "angle": 0.4, "points": {"P": [-0.5, 0.0]}},
            "c": {"type": "point", "mass": 0.5, "position": [2.0, 1.0], "velocity": [0.0, 1.0]},
        },
        "joints": {
            "pin": {"type": "revolute", "between": ["a", "b"], "at": ["P", "P"]},
            "link": {"type": "distance", "between": ["b", "c"], "at": ["centre", "centre"], "length": 1.0},
        },
        "forces": {
            "spring": {
                "type": "spring-damper",
                "between": ["a", "c"],
                "at": [[0.0, 0.2], "centre"],
                "stiffness": 9.0,
                "damping": 0.4,
                "free_length": 1.0,
            }
        },
    }
    outcome = run(load(mechanism_of(description)), method="direct-correction", **TIGHT, until=3.0, output_step=0.05)
    q, v = outcome.states[:, :8], outcome.states[:, 8:16]
    linear, spin = np.zeros((len(q), 2)), np.zeros(len(q))
    for first, mass, inertia in ((0, 1.3, 0.4), (3, 0.8, 0.1), (6, 0.5, 0.0)):
        linear += mass * v[:, first : first + 2]
        spin += mass * (q[:, first] * v[:, first + 1] - q[:, first + 1] * v[:, first])
        spin += inertia * v[:, first + 2] if inertia else 0.0
    np.testing.assert_allclose(linear, np.tile(linear[0], (len(q), 1)), atol=1e-9)
    np.testing.assert_allclose(spin, spin[0], atol=1e-9)
    assert outcome.energy_drift_max <= 1e-9


def test_a_rolling_disc_and_a_skate_move_as_their_closed_forms_say():
    """A disc down a slope, a = g sin / (1 + I / m r^2); a skate that turns evenly goes round in a circle."""
    sine, cosine = math.sin(0.3), math.cos(0.3)
    description = {
        "mechanism": {"name": "rolling", "gravity": [0.0, -9.81]},
        "bodies": {
            "disc": {"mass": 2.0, "inertia": 0.3, "position": [-0.5 * sine, 0.5 * cosine]},
            "skate": {"mass": 1.0, "inertia": 0.2, "velocity": [1.5, 0.0], "angular_velocity": 0.8},
        },
        "joints": {
            "roll": {
                "type": "rolling",
                "between": ["disc", "ground"],
                "radius": 0.5,
                "axis": [cosine, sine],
                "on": [0.0, 0.0],
            },
            "blade": {"type": "knife-edge", "body": "skate", "axis": [1.0, 0.0]},
        },
        "forces": {"lift": {"type": "force", "body": "skate", "force": [0.0, 9.81]}},
    }
    outcome = run(load(mechanism_of(description)), method="direct-correction", **TIGHT, until=2.0, times=[1.0, 2.0])
    for t, y in zip(outcome.times, outcome.states, strict=True):
        travelled = -9.81 * sine / (1 + 0.3 / (2.0 * 0.25)) * t**2 / 2
        np.testing.assert_allclose(y[2], -travelled / 0.5, atol=1e-9)
        circle = 1.5 / 0.8 * np.array([np.sin(0.8 * t), 1 - np.cos(0.8 * t)])
        np.testing.assert_allclose(y[3:6], [*circle, 0.8 * t], atol=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_a_body_without_joints_falls(method):
    """No rows at all: every section of multipliers and residuals is empty."""
    body = {"mass": 2.0, "inertia": 0.5, "velocity": [1.0, 0.0], "angular_velocity": 2.0}
    description = {"mechanism": {"name": "thrown", "gravity": [0.0, -9.81]}, "bodies": {"b": body}}
    outcome = run(
        load(mechanism_of(description)), method=method, integrator=constant_integrator(method), step=0.1, until=1.0
    )
    np.testing.assert_allclose(outcome.states[-1], [1.0, -4.905, 2.0, 1.0, -9.81, 2.0, 0.0], atol=1e-13)
    assert outcome.multipliers.shape == (11, 0) and outcome.energy_drift_max <= 1e-12
