"""Outputs that are integrals, of runs of both shapes by an implicit integrator, by closed forms."""

from __future__ import annotations

import pytest

import symgen
from symgen.describe import MechanismBuilder


@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_integrals_behind_an_implicit_law(shape):
    """A slide that a motor drives as t^2 and a mass of 2 kg that 3 N push: integrands read v, v' and a multiplier."""
    ends = {"at": ((0.0, 0.0), "centre"), "axis": (1.0, 0.0)}
    mechanism = (
        MechanismBuilder("integrals-of-both")
        .run(until=1.0, step=0.05)
        .body("slide", mass=1.5, inertia=0.1)
        .body("block", mass=2.0, inertia=0.1)
        .joint("rail", "translational", between=("ground", "slide"), **ends)
        .joint("guide", "translational", between=("ground", "block"), **ends)
        .joint("motor", "driver", joint="rail", coordinate="displacement", value="t**2")
        .force("push", "force", body="block", force=(3.0, 0.0))
        .output("spent", "integral(motor.power)", unit="J")
        .output("square", "integral(block.vx**2)")
        .output("shaken", "integral(block.ax*slide.ax)")
        .build()
    )
    found = symgen.load(mechanism).simulate(method="ggl", integrator="radau5", rtol=1e-8, shape=shape)
    assert (found.status, found.shape) == ("ok", shape)
    end = dict(zip(("spent", "square", "shaken"), found.select(["spent", "square", "shaken"]).values[-1], strict=True))
    expected = {"spent": 1.5 * 2.0**2 / 2, "square": 1.5**2 / 3, "shaken": 1.5 * 2.0}
    assert end == pytest.approx(expected, rel=1e-8)
