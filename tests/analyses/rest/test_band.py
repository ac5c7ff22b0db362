"""The band in which dry friction holds: against closed forms, a potential of one angle, and runs from its ends."""

import copy
import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import symgen
from symgen.describe.files.load import parse_toml, read_raw
from symgen.describe.files.validate import validate

PIN = """
[mechanism]
name = "pendulum"
gravity = [0.0, -9.81]

[parameters]
torque = 0.5

[bodies.bob]
mass = 1.0
inertia = 0.5
points = { pivot = [0.0, 1.0] }

[joints.pin]
type = "revolute"
between = ["ground", "bob"]
at = [[0.0, 0.0], "pivot"]
start = { angle = 0.02 }
friction = { sliding = 0.3, static = "torque" }
STOP
"""


def pendulum(stop: str = "") -> symgen.Model:
    return symgen.load(validate(parse_toml(PIN.replace("STOP", stop), "p"), "p.toml"))


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_the_band_of_a_pendulum(coordinates: str) -> None:
    """The start is stuck; the equilibrium is that without friction, and the band is asin(torque / m g l)."""
    rest = pendulum().equilibrium(coordinates=coordinates, parameters={"torque": 4.0})
    assert abs(rest.q["pin.angle"]) < 1e-9
    (low, high), half = rest.band["pin.angle"], math.asin(4.0 / 9.81)
    assert abs(low + half) < 1e-11 and abs(high - half) < 1e-11
    assert rest.notes[-1].endswith(f"it holds with pin.angle from {-half:.9g} rad to {half:.9g} rad")
    assert rest.to_dict()["band"] == {"pin.angle": [low, high]}


@pytest.mark.slow
def test_a_bound_beyond_all_forces_holds_everywhere() -> None:
    rest = pendulum().equilibrium(parameters={"torque": 10.0})
    assert rest.band == {"pin.angle": (-math.inf, math.inf)}
    assert rest.notes[-1].endswith("it holds wherever it stands")
    assert rest.to_dict()["band"] == {"pin.angle": [None, None]}


def test_stops_end_a_band() -> None:
    rest = pendulum("stop = { lower = -0.1, upper = 2.0 }").equilibrium(parameters={"torque": 4.0})
    low, high = rest.band["pin.angle"]
    assert abs(low + 0.1) < 1e-8 and abs(high - math.asin(4.0 / 9.81)) < 1e-11


def place(angle: float) -> tuple[float, float, float, float]:
    """Return the angles of coupler and rocker of the four-bar, and its energy and that of nothing else."""
    b = np.array([2.0 * math.cos(angle), 2.0 * math.sin(angle)])
    across = np.array([10.0, 0.0]) - b
    distance = float(np.hypot(*across))
    along = (8.0**2 - 5.0**2 + distance**2) / (2.0 * distance)
    side = math.sqrt(8.0**2 - along**2)
    c = b + along * across / distance + side * np.array([-across[1], across[0]]) / distance
    coupler, rocker = math.atan2(*(c - b)[::-1]), math.atan2(c[1], c[0] - 10.0)
    return coupler, rocker, 9.81 * (2.0 * b[1] / 2 + 8.0 * (b[1] + c[1]) / 2 + 5.0 * c[1] / 2), distance


def excess(angle: float, torque: float) -> float:
    """Return the force along the crank's angle less that of four pins, by central differences."""
    h = 1e-5
    (c1, r1, v1, _), (c0, r0, v0, _) = place(angle + h), place(angle - h)
    coupler, rocker, force = ((x - y) / (2.0 * h) for x, y in ((c1, c0), (r1, r0), (v1, v0)))
    return abs(force) - torque * (1.0 + abs(coupler - 1.0) + abs(rocker - coupler) + abs(rocker))


def four_bar(**frictions: dict[str, Any]) -> symgen.Model:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    for name, friction in frictions.items():
        raw["joints"][name]["friction"] = friction
    return symgen.load(validate(raw, source))


@pytest.mark.slow
def test_four_pins_hold_together() -> None:
    model = four_bar(**{name: {"sliding": 4.0} for name in "ABCD"})
    rest = model.equilibrium(start={"crank.theta": -2.07596285039})
    (low, high), crank = rest.band["A.angle"], rest.q["crank.theta"]
    bare = four_bar().equilibrium(start={"crank.theta": -2.07596285039})
    assert abs(bare.q["crank.theta"] - crank) < 1e-9
    assert bare.band == {} and len(bare.notes) < len(rest.notes)
    wanted = []
    for way in (-1.0, 1.0):
        far = next(x for x in np.arange(0.01, 2.0, 0.01) if excess(crank + way * x, 4.0) > 0.0)
        wanted.append(
            brentq(lambda angle: excess(angle, 4.0), crank + way * (far - 0.01), crank + way * far, xtol=1e-14)
        )
        for inside, angle in ((True, wanted[-1] - way * 1e-6), (False, wanted[-1] + way * 1e-6)):
            run = model.simulate(start={"crank.theta": angle}, until=0.02, verify=False)
            assert bool(abs(run.v.values[-1]).max() < 1e-12) is inside
    turned = rest.q["A.angle"] - crank
    np.testing.assert_allclose((low, high), np.array(wanted) + turned, rtol=0, atol=1e-8)
    scanned = model.equilibria(("crank.theta", np.linspace(crank - 0.2, crank + 0.3, 4)))
    np.testing.assert_allclose(scanned[0].band["A.angle"], (low, high), rtol=0, atol=1e-9)


def test_there_is_no_band_with_reactions_or_more_freedom() -> None:
    rest = four_bar(A={"coefficient": 0.3, "radius": 0.05}).equilibrium()
    assert rest.band == {} and "as friction of A depends on reactions" in rest.notes[-1]
    double = PIN.replace(
        "STOP", "[bodies.rod]\nmass = 1.0\ninertia = 0.1\nposition = [0.0, -1.0]\npoints = { p = [0.0, 1.0] }\n"
    )
    double += '[joints.q]\ntype = "revolute"\nbetween = ["bob", "rod"]\nat = ["centre", "p"]\n'
    rest = symgen.load(validate(parse_toml(double, "p"), "p.toml")).equilibrium()
    assert rest.band == {} and "no band of them with 2 degrees of freedom" in rest.notes[-1]
