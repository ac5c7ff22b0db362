"""Contacts in loops: runs beside straight code, over impacts, slip, stick, lift-off and rest."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import symgen
from symgen.base.settings import Settings
from symgen.run.planning.prepare import prepare
from tests.run.contacts.scenes import CRANK, DROP, LIGHT, body, floor, head, loaded, rods, woodpecker

TIGHT: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-13, "verify": False, "coordinates": "absolute"}
#: A disc that skids up a slope and rolls back.
SKID = head("skid") + body("disc", 3.0, 0.06, (0.0, 0.2), (2.0, 0.0), 4.0) + floor("disc", 0.2, "0.15")
#: A disc that a slope turns back, and a follower that leaves its eccentric.
SLOPE = head("slope", 3.0, -9.3) + body("disc", 3.0, 0.06, (0.0, 0.2), (-2.0, 0.0), 4.0) + floor("disc", 0.2, "0.15")
FOLLOWER = """
[mechanism]
name = "cam"
gravity = [0.0, -9.81]

[bodies.f]
type = "point"
mass = 0.5

[joints.guide]
type = "rows"
rows = [{ position = "f.x" }]

[forces.spring]
type = "force"
body = "f"
force = [0.0, "-800*f.y - 10"]

[contacts.cam]
gap = "f.y - 0.01*(1 - cos(100*t))"
"""
SCENES = {
    "skid": (SKID, 2.0),
    "slope": (SLOPE, 1.0),
    "follower": (FOLLOWER, 0.07),
    "drop": (DROP, 1.5),
    "rods": (rods(0.2, 0.5, (1.0, 0.7), (1.0, 0.6), (20.0, 35.0, -0.4, -0.9)), 0.3),
    "guide": (CRANK, 0.01),
    "light": (LIGHT, 0.0025),
    "woodpecker": (woodpecker(), 0.15),
}


def both_shapes(model: Any, **settings: Any) -> list[Any]:
    """Return runs in straight and in looped code, which are the same within rounding."""
    straight, looped = (model.simulate(shape=shape, **TIGHT | settings) for shape in ("straight", "looped"))
    assert straight.ok and looped.ok and looped.shape == "looped" and straight.events
    assert [event.name for event in looped.events] == [event.name for event in straight.events]
    times = [[event.t for event in run.events] for run in (straight, looped)]
    np.testing.assert_allclose(times[1], times[0], rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(looped.q.values, straight.q.values, rtol=0.0, atol=1e-9)
    return [straight, looped]


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_both_shapes_agree(name: str, tmp_path: Path) -> None:
    text, until = SCENES[name]
    straight, looped = both_shapes(loaded(text, tmp_path), until=until, method="lagrange", integrator="dop853")
    for output in straight.outputs.names:
        a, b = straight[output], looped[output]
        np.testing.assert_allclose(b, a, rtol=0.0, atol=1e-7 * (1.0 + np.abs(a).max()))


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "until"), [("rocking-block", 1.5), ("slider-crank-with-clearance", 0.02)])
@pytest.mark.parametrize(
    ("method", "integrator"), [("direct-correction", "picard"), ("lagrange", "radau5"), ("ggl", "radau5")]
)
def test_machines_of_the_catalogue_agree(name: str, until: float, method: str, integrator: str) -> None:
    both_shapes(symgen.load(name), until=until, method=method, integrator=integrator, rtol=1e-11, atol=1e-12)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "until"), [("skidding-wheel", 4.0), ("woodpecker", 0.3), ("geneva", 1.0)])
def test_others_of_the_catalogue_agree(name: str, until: float) -> None:
    both_shapes(symgen.load(name), until=until, method="lagrange", integrator="dop853")


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_skid_over_300_coefficients(tmp_path: Path) -> None:
    """Friction takes the slip at mu g (1 + m r^2 / J), and the disc rolls on from there."""
    text = SKID.replace("0.15", '"mu"', 1).replace("[bodies.disc]", "[parameters]\nmu = 0.15\n[bodies.disc]")
    values = np.linspace(0.1, 0.7, 300)
    mechanism = loaded(text, tmp_path).mechanism
    settings = Settings(
        "lagrange", "dop853", until=2.0, shape="looped", coordinates="absolute", verify=False, rtol=1e-12
    )
    outcomes = [prepare(mechanism, replace(settings, parameters={"mu": float(mu)})).integrate() for mu in values]
    slip = 2.0 + 0.2 * 4.0
    times = slip / (3.0 * 9.81 * values)
    ends = 2.0 * times - 0.5 * 9.81 * values * times**2 + (2.0 - 9.81 * values * times) * (2.0 - times)
    np.testing.assert_allclose([outcome.states[-1][0] for outcome in outcomes], ends, rtol=0.0, atol=1e-10)
