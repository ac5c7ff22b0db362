"""Cams by their radius, a formula of the direction or a table, beside the smooth curve itself."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from symgen.base.errors import InputError
from tests.run.contacts.scenes import loaded
from tests.run.contacts.test_outlines import WAYS, cam_follower

#: Radius of a cam [m], its slope, and how near arcs come to it [m].
RADIUS, NEAR = "0.026 + 0.004*cos(phi) + 0.001*sin(3*phi)", 1e-7


def radius(phi: float) -> tuple[float, float]:
    """Return the radius of the cam and its slope."""
    return (
        0.026 + 0.004 * math.cos(phi) + 0.001 * math.sin(3.0 * phi),
        -0.004 * math.sin(phi) + 0.003 * math.cos(3.0 * phi),
    )


def cam(of: str = f'radius = "{RADIUS}", tolerance = {NEAR}', more: str = "") -> str:
    """Return the follower of `cam_follower` on the cam."""
    text = cam_follower([])
    assert "closed = true, points = []" in text and "position = [0.0, 0.038]" in text
    text = text.replace("closed = true, points = []", of).replace("[0.0, 0.038]", f"[0.0, {lift(math.pi)!r}]")
    return text + more


def lift(angle: float) -> float:
    """Return the height of a disc of 8 mm over the shaft of the cam; `angle` is that of the guide on the cam."""

    def centre(phi: float) -> complex:
        r, slope = radius(phi)
        normal = complex(r, -slope) / math.hypot(r, slope)
        return (r + 0.008 * normal) * complex(math.cos(phi), math.sin(phi))

    def aside(phi: float) -> float:
        return (centre(phi) * complex(math.cos(angle), -math.sin(angle))).imag

    return abs(centre(float(brentq(aside, angle - 0.7, angle + 0.7, xtol=1e-15))))


def test_a_radius_is_an_outline(tmp_path: Path) -> None:
    """Arcs are tangent, within the tolerance, and said; a constant radius is a circle."""
    text = str(loaded(cam(), tmp_path).inspect())
    assert "m, no hollow corner, from radius, unit 1 m, curves by arcs within 1e-07 m" in text
    round_one = str(loaded(cam("radius = 0.03"), tmp_path).inspect())
    assert f"outline cam: 16 pieces, {0.06 * math.pi:.6g} m, no hollow corner" in round_one


@pytest.mark.slow
def test_three_hundred_speeds_of_a_cam_by_its_radius(tmp_path: Path) -> None:
    model = loaded(cam(), tmp_path)
    run = model.simulate(until=3.2, output_step=0.02, rtol=1e-10)
    expected = np.array([lift(math.pi + 2.0 * t) for t in run.t])
    assert run.status == "ok" and np.abs(run["follower.y"] - expected).max() < 2.0 * NEAR
    speeds = np.linspace(0.5, 6.0, 300)
    table = model.sweep(vary={"om": speeds}, until=0.5, rtol=1e-10).to_dataframe()
    ends = np.array([lift(math.pi + 0.5 * speed) for speed in speeds])
    assert (table["status"] == "ok").all() and np.abs(table["follower.y"] - ends).max() < 2.0 * NEAR


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("way", ["dop853", "radau5", "joint", "rk4"])
def test_other_ways_on_a_cam_by_its_radius(way: str, tmp_path: Path) -> None:
    run = loaded(cam(), tmp_path).simulate(until=1.6, output_step=0.02, **WAYS[way])
    expected = np.array([lift(math.pi + 2.0 * t) for t in run.t])
    assert run.ok and np.abs(run["follower.y"] - expected).max() < 2.0 * NEAR


@pytest.mark.slow
def test_a_table_of_radii(tmp_path: Path) -> None:
    """Of 72 points, between which a smooth table is off by less than 2e-8 m; arcs by default by 6e-7 m."""
    x = np.linspace(0.0, 2.0 * math.pi, 73)
    y = [radius(float(phi))[0] for phi in x]
    y[-1] = y[0]
    points = f'\n[tables.profile]\nx = {x.tolist()}\ny = {y}\ninterpolation = "cubic"\nperiodic = true\n'
    model = loaded(cam('radius = "profile(phi)"', points), tmp_path)
    run = model.simulate(until=3.2, output_step=0.02, rtol=1e-10)
    expected = np.array([lift(math.pi + 2.0 * t) for t in run.t])
    assert run.status == "ok" and np.abs(run["follower.y"] - expected).max() < 1e-6


@pytest.mark.parametrize(
    ("of", "sentence"),
    [
        ('radius = "0.03 + 0.02*om*cos(phi)"', "outlines.cam.radius: expected a number or an expression of phi"),
        ('radius = "0.03*cos(phi)"', "outlines.cam.radius: expected a radius above 0, got -0.00294051 m at phi"),
        ('radius = "0.03 + 0.001*phi"', "outlines.cam.radius: expected a radius that is the same after a turn"),
        (
            'radius = "0.03 + 0.01*sqrt(abs(sin(phi - 1)))"',
            "outlines.cam.tolerance: expected curves that arcs come near to",
        ),
        ('radius = 0.03, unit = "1 mm"', "outlines.cam.unit: expected no such key without file or path"),
        ("box = [0.1, 0.1], tolerance = 1e-5", "outlines.cam.tolerance: expected no such key without file or path or"),
        ('radius = 0.03, path = "M 0 0 L 1 0"', "outlines.cam.points: expected one of points"),
    ],
)
def test_radii_that_are_refused(of: str, sentence: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as refused:
        loaded(cam(of), tmp_path)
    assert sentence in str(refused.value) and "\n" not in str(refused.value)
