"""Outputs that are integrals, of runs of both shapes by an implicit integrator, by closed forms."""

from __future__ import annotations

import math

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


@pytest.mark.slow_cases("abm-relative")
@pytest.mark.parametrize("settings", [{}, {"atol": 1e-8}], ids=["relative", "absolute"])
@pytest.mark.parametrize("integrator", ["dop853", "dopri5", "picard", "abm", "radau5", "sdirk"])
def test_adaptive_steps_are_short_enough_for_integrals(integrator, settings):
    """A point flies straight on, which asks for no step at all: `sin` was off by 0.05 to 4e5, `ok`."""
    mechanism = (
        MechanismBuilder("integrals-alone")
        .run(until=1.0)
        .body("bob", type="point", mass=2.0, position=(1.0, 0.0), velocity=(0.1, 0.0))
        .output("fast", "integral(sin(60*t))")
        .output("jump", "integral(1 if t < 0.7321 else 0)")
        .output("kink", "integral(abs(t - 0.5123))")
        .build()
    )
    found = symgen.load(mechanism).simulate(integrator=integrator, rtol=1e-8, times=[0.5, 1.0], **settings)
    end = found.select(["fast", "jump", "kink"]).values[-1]
    expected = (1.0 - math.cos(60.0)) / 60.0, 0.7321, (0.5123**2 + 0.4877**2) / 2.0
    assert found.status == "ok"
    # local errors of 1e-8 of some hundred steps, most of them around the jump, which explicit schemes do not know
    assert end == pytest.approx(expected, abs=1e-5)
