"""Elastic stops: derivatives of those with a spring, and a refusal of those with a damper, whose force jumps."""

import math

import pytest
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError

MASS, STIFFNESS, DISTANCE = 2.0, 1000.0, 0.1


def buffer(**damper):
    """Return a slide that meets a buffer at 1 m/s."""
    slide = {"mass": MASS, "inertia": 0.1, "velocity": [-1.0, 0.0], "position": [DISTANCE, 0.0], "hold": "velocity"}
    rail = {"type": "translational", "between": ["ground", "slide"], "at": [[0.0, 0.0], "centre"], "axis": [1.0, 0.0]}
    rail["stop"] = {"lower": 0.0, "stiffness": STIFFNESS} | damper
    return symgen.load(
        mechanism_of({"mechanism": {"name": "buffer"}, "bodies": {"slide": slide}, "joints": {"rail": rail}})
    )


def test_a_stop_with_a_spring_has_derivatives():
    """The slide is away for pi sqrt(m/k), so that x = t - distance - pi sqrt(m/k) afterwards."""
    path = "joints.rail.stop.stiffness"
    result = buffer().simulate(until=0.5, sensitivities=(path, "bodies.slide.mass"), rtol=1e-11, atol=1e-12)
    by = result.gradient("slide.x")
    assert result["slide.x"][-1] == pytest.approx(0.5 - DISTANCE - math.pi * math.sqrt(MASS / STIFFNESS), abs=1e-9)
    assert by[path][-1] == pytest.approx(0.5 * math.pi * math.sqrt(MASS) * STIFFNESS**-1.5, rel=1e-7)
    assert by["bodies.slide.mass"][-1] == pytest.approx(-0.5 * math.pi / math.sqrt(MASS * STIFFNESS), rel=1e-7)


def test_a_stop_with_a_damper_has_none():
    model = buffer(damping=5.0)
    with pytest.raises(InputError, match="sensitivities: expected a run without jumps of formulas"):
        model.simulate(until=0.5, sensitivities=("joints.rail.stop.stiffness",))
    with pytest.raises(InputError, match="expected a run without jumps of formulas"):
        model.start(integrator="rk4", step=1e-3).derivatives()
