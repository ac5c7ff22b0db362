"""A ratchet of eight teeth: two rounded flanks meet at every tip and root, and its pawl falls from one to the next."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.rotation import of_turn

import symgen
from tests.result.targets.test_c_modes import loaded

TEETH, TIP, ROOT, PIVOT = 8, 0.1, 0.08, (-0.06, 0.112)


def ratchet(offset: float) -> str:
    """Return a wheel that a torque turns to and fro, at an angle, and a pawl that a spring presses onto its teeth."""
    text = f"""
[mechanism]
name = "ratchet"
gravity = [0.0, 0.0]
[run]
until = 10.0
[parameters]
turn = 0.0
[bodies.wheel]
mass = 0.5
inertia = 0.002
angle = "turn"
[bodies.pawl]
mass = 0.05
inertia = 0.0001
position = [{PIVOT[0]}, {PIVOT[1]}]
[joints.W]
type = "revolute"
between = ["ground", "wheel"]
at = [[0.0, 0.0], [0.0, 0.0]]
friction = {{ sliding = 0.01 }}
[joints.P]
type = "revolute"
between = ["ground", "pawl"]
at = [[{PIVOT[0]}, {PIVOT[1]}], [0.0, 0.0]]
[forces.spring]
type = "torque"
body = "pawl"
torque = "-0.05 - 0.2*pawl.theta - 0.0005*pawl.omega"
[forces.drive]
type = "torque"
body = "wheel"
torque = "-0.15*sin(6*t)"
"""
    x = f"({PIVOT[0]} + 0.06*cos(pawl.theta) + 0.01*sin(pawl.theta))"
    y = f"({PIVOT[1]} + 0.06*sin(pawl.theta) - 0.01*cos(pawl.theta))"
    u, v = (f"({x}*cos(wheel.theta) + {y}*sin(wheel.theta))", f"({y}*cos(wheel.theta) - {x}*sin(wheel.theta))")
    for tooth in range(TEETH):
        here = offset + 2.0 * math.pi / TEETH * tooth  # of the radial flank; the other one ends at the next
        ends = {"f": (ROOT, here, TIP, here), "b": (TIP, here, ROOT, here + 2.0 * math.pi / TEETH)}
        for name, (r, phi, far, psi) in ends.items():
            a, b = r * math.cos(phi), r * math.sin(phi)
            length = math.hypot(far * math.cos(psi) - a, far * math.sin(psi) - b)
            c, s = (far * math.cos(psi) - a) / length, (far * math.sin(psi) - b) / length
            along = f"min(max(({u} - {a!r})*{c!r} + ({v} - {b!r})*{s!r}, 0.0), {length!r})"
            gap = f"sqrt(({u} - {a!r} - {c!r}*{along})**2 + ({v} - {b!r} - {s!r}*{along})**2) - 0.004"
            text += f'[stops.{name}{tooth}]\ngap = "{gap}"\nrestitution = 0.2\n'
    return text


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("settings", "bound"),
    [
        ({}, 2e-6),
        ({"rtol": 1e-9}, 1e-6),
        ({"integrator": "dop853", "rtol": 2e-12, "atol": 1e-13}, 1e-7),  # finer than the rounding of a gap at a tip
        ({"integrator": "radau5", "rtol": 1e-8}, 5e-6),
        ({"coordinates": "joint"}, 5e-6),
    ],
    ids=["own", "picard", "dop853", "radau5", "joint"],
)
def test_a_ratchet_turns_one_way(settings: dict[str, Any], bound: float, tmp_path: Path) -> None:
    result = loaded(ratchet(0.35), tmp_path).simulate(**settings)
    assert result.status == "ok", result.reason
    # impacts accumulate ten times a second, some a hit later in other coordinates
    assert len(result.events) == (779 if "coordinates" in settings else 771)
    assert result["wheel.theta"][-1] == pytest.approx(22.4334623, abs=bound)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("rtol", [1e-8, 1e-11])
def test_flights_that_begin_below_zero_by_rounding_end_where_they_began(rtol: float, tmp_path: Path) -> None:
    """At a tip the pawl once sank with each bounce by as much again: it lost a tooth's flank at 7.03 s."""
    result = loaded(ratchet(0.3499385), tmp_path).simulate(integrator="dop853", rtol=rtol, verify=False, until=7.5)
    assert result.status == "ok", result.reason
    assert len(result.events) in (591, 592)  # impacts accumulate, once a hit later
    assert result["wheel.theta"][-1] == pytest.approx(19.45156716, abs=1e-7)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_ratchet_over_the_angle_at_which_it_starts(tmp_path: Path) -> None:
    """Rows of a sweep by two tolerances differ by what these allow: no start loses a hit."""
    model = loaded(ratchet(0.35), tmp_path)
    turns = np.array(of_turn(np.linspace(-0.02, 0.02, 301), 25))
    common = {"quantities": ("wheel.theta",), "until": 3.0, "times": (3.0,), "integrator": "dop853"}
    rough, fine = (symgen.sweep(model, {"turn": turns}, rtol=rtol, **common) for rtol in (1e-8, 1e-10))
    assert list(rough.status) == list(fine.status) == ["ok"] * len(turns)
    np.testing.assert_allclose(rough.values, fine.values, rtol=0, atol=1e-8)
