"""Friction that joints lock at a start, and a driver moves from rest with neither rate nor acceleration."""

import numpy as np
import pytest

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

#: A Scotch yoke whose crank is driven; its slide rubs with 4 N.
YOKE = """
[mechanism]
name = "yoke"
[parameters]
swing = 0.3
[bodies.crank]
mass = 1.0
inertia = 0.1
angle = 1.0
position = [0.27015115293407, 0.42073549240395]
[bodies.slider]
mass = 1.0
inertia = 1.0
position = [0.54030230586814, 0.0]
[joints.pin]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], [-0.5, 0.0]]
[joints.yoke]
type = "rows"
rows = [{ position = "slider.x - 2*crank.x" }]
[joints.rail]
type = "translational"
between = ["ground", "slider"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
angle = 0.0
friction = { sliding = 4.0 }
[joints.motor]
type = "driver"
joint = "pin"
value = "1.0 + swing*(LAW)"
[outputs]
lost = { value = "rail.dissipated", unit = "J" }
"""
LAWS = {"cycloid": "t - sin(t)", "cubic": "t**3", "square": "t**2"}
WAYS = {
    "picard": {},
    "dop853": {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12},
    "rk4": {"integrator": "rk4", "step": 1e-3},
    "radau5": {"integrator": "radau5"},
}


def yoke(law: str) -> symgen.Model:
    return symgen.Model(validate(parse_toml(YOKE.replace("LAW", LAWS[law]), "yoke.toml"), "yoke.toml"))


@pytest.mark.by_turns(4)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("way", [*WAYS])
@pytest.mark.parametrize("law", [*LAWS])
@pytest.mark.slow
def test_friction_acts_as_soon_as_the_driver_moves(law: str, way: str, coordinates: str) -> None:
    run = yoke(law).simulate(until=1.0, coordinates=coordinates, output_step=0.01, verify=False, **WAYS[way])
    assert run.status == "ok"
    assert [event.name for event in run.events] == ([] if law == "square" else ["rail.slip"])
    assert all(event.t < 1e-3 for event in run.events)
    np.testing.assert_allclose(run["rail.force"][1:], 4.0, rtol=1e-12)
    path = run["slider.x"][0] - run["slider.x"][-1]  # to the left all the time
    assert path > 0.01 and run.outputs["lost"][-1] == pytest.approx(4.0 * path, abs=1e-8)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_rows_over_the_swing_are_single_runs() -> None:
    """Amplitudes of both signs, and none: the slide then rests."""
    swings = np.linspace(-0.3, 0.3, 301)
    model, settings = yoke("cycloid"), {"until": 1.0, "integrator": "dop853", "coordinates": "joint"}
    rows = model.sweep({"swing": swings}, quantities=("rail.mode", "slider.x", "lost"), times=[1.0], **settings)
    assert set(rows.status) == {"ok"}
    np.testing.assert_array_equal(rows["rail.mode"][:, 0], np.sign(-swings.round(12)))
    path = np.abs(rows["slider.x"][:, 0] - np.cos(1.0))
    np.testing.assert_allclose(rows["lost"][:, 0], 4.0 * path, atol=1e-8)
    for i in (0, 77, 150, 300):
        alone = model.simulate(parameters={"swing": swings[i]}, times=[1.0], verify=False, **settings)
        assert rows["slider.x"][i, 0] == alone["slider.x"][-1]
