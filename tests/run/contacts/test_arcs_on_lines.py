"""Arcs of outlines on lines: cams of arc flanks under flat faces and ovals that roll, beside closed forms and SciPy."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from benchmarks.mechanisms.toml import text as toml
from symgen.base.errors import InputError
from tests.run.contacts.scenes import G, loaded
from tests.run.contacts.test_derivatives import slopes_of
from tests.run.contacts.test_outlines import WAYS

Array = NDArray[np.float64]

#: Radii of base circle, flanks and nose of a cam [m], and the distance of the nose's centre.
BASE, FLANK, NOSE, REACH = 0.03, 0.1, 0.008, 0.034
#: Centre of the flank above the axis of the nose, and the half angles of nose and nose with flanks.
_FAR, _NEAR = FLANK - BASE, FLANK - NOSE
FX = (_FAR**2 - _NEAR**2 + REACH**2) / (2.0 * REACH)
CENTRE = complex(FX, -math.sqrt(_FAR**2 - FX**2))
ON_NOSE = math.atan2(-CENTRE.imag, REACH - CENTRE.real)
ON_FLANK = math.atan2(-CENTRE.imag, -CENTRE.real)


def cam() -> list[Any]:
    """Return the points of the cam, whose flanks are arcs: their circles leave it."""
    upper = [CENTRE + FLANK * complex(math.cos(a), math.sin(a)) for a in (ON_FLANK, ON_NOSE)]
    (a, b), (c, d) = ([p.real, p.imag] for p in upper), ([p.real, -p.imag] for p in upper[::-1])
    return [
        [-BASE, 0.0],
        {"to": d, "radius": BASE},
        {"to": c, "radius": FLANK},
        {"to": b, "radius": NOSE},
        {"to": a, "radius": FLANK},
        {"to": [-BASE, 0.0], "radius": BASE},
    ]


def lift(angle: float) -> float:
    """Return the height of a flat face over the shaft; `angle` is that of the nose from the direction of the face."""
    a = abs((angle + math.pi) % math.tau - math.pi)
    if a < ON_NOSE:
        return REACH * math.cos(a) + NOSE
    return FLANK + CENTRE.real * math.cos(a) + CENTRE.imag * math.sin(a) if a < ON_FLANK else BASE


def flat_follower(friction: float | None = None) -> str:
    """Return a driven cam under a flat face that a spring presses."""
    contact = {"between": [{"outline": "cam"}, {"line": "follower", "normal": [0.0, -1.0]}]}
    return toml(
        {
            "mechanism": {"name": "cam", "gravity": [0.0, -G]},
            "parameters": {"om": 2.0},
            "bodies": {
                "cam": {"mass": 1.0, "inertia": 0.001, "angle": -math.pi / 2.0},
                "follower": {"mass": 0.3, "inertia": 1e-4, "position": [0.0, BASE]},
            },
            "joints": {
                "shaft": {"type": "revolute", "between": ["ground", "cam"], "at": [[0.0, 0.0], "centre"]},
                "guide": {
                    **{"type": "translational", "between": ["ground", "follower"]},
                    **{"at": [[0.0, 0.0], "centre"], "axis": [0.0, 1.0]},
                },
                "motor": {"type": "driver", "joint": "shaft", "value": "-pi/2 + om*t"},
            },
            "forces": {
                "spring": {"type": "force", "body": "follower", "force": ["0", f"-400*(follower.y - {BASE} + 0.03)"]}
            },
            "outlines": {"cam": {"body": "cam", "closed": True, "points": cam()}},
            "contacts": {"touch": contact if friction is None else {**contact, "friction": friction}},
        }
    )


def test_the_cam_is_one_of_arc_flanks() -> None:
    """Its flanks touch base circle and nose, and its lift is smooth between them."""
    assert 0.0 < ON_NOSE < ON_FLANK < math.pi
    for angle in (ON_NOSE, ON_FLANK):
        assert abs(lift(angle - 1e-9) - lift(angle + 1e-9)) < 1e-10
        slopes = [(lift(angle + 2e-6 + way) - lift(angle - 2e-6 + way)) / 4e-6 for way in (-3e-6, 3e-6)]
        assert abs(slopes[0] - slopes[1]) < 2e-6


@pytest.mark.parametrize("way", [pytest.param(way, marks=() if way == "default" else pytest.mark.slow) for way in WAYS])
@pytest.mark.parametrize("friction", [None, pytest.param(0.1, marks=pytest.mark.slow)])
def test_a_flat_face_on_a_cam_of_arc_flanks(way: str, friction: float | None, tmp_path: Path) -> None:
    """It is one contact without an event, and slides at the speed of the cam times its height."""
    model = loaded(flat_follower(friction), tmp_path)
    for speed in (2.0, 6.0):
        run = model.simulate(until=6.4 / speed, output_step=0.02, parameters={"om": speed}, **WAYS[way])
        expected = np.array([lift(math.pi - speed * t) for t in run.t])
        assert run.ok and np.abs(run["follower.y"] - expected).max() < 1e-11, (way, speed, run.reason)
        assert [event.name for event in run.events if event.name != "touch.hit"] == []
        if friction is not None:
            assert np.abs(np.abs(run["touch.slip"]) - speed * expected).max() < 1e-9


@pytest.mark.slow
def test_three_hundred_speeds_of_a_cam_of_arc_flanks(tmp_path: Path) -> None:
    model, until = loaded(flat_follower(0.1), tmp_path), 0.6
    speeds = np.linspace(-9.0, 9.0, 300)
    table = model.sweep(vary={"om": speeds}, until=until).to_dataframe()
    ends = np.array([lift(math.pi - speed * until) for speed in speeds])
    assert (table["status"] == "ok").all() and np.abs(table["follower.y"] - ends).max() < 1e-11


#: Radii of an oval of four arcs, and the distances of their centres from its own; it rolls.
LONG, SHORT = 0.16, 0.06
ASIDE = 0.07
DOWN = math.sqrt((LONG - SHORT) ** 2 - ASIDE**2)
#: Half of the angle of the flat arcs.
HALF = math.asin(ASIDE / (LONG - SHORT))


def oval() -> list[Any]:
    """Return the points of the oval, counterclockwise from its right end."""
    x, y = LONG * math.sin(HALF), LONG * math.cos(HALF) - DOWN
    return [
        [x, -y],
        {"to": [x, y], "radius": SHORT},
        {"to": [-x, y], "radius": LONG},
        {"to": [-x, -y], "radius": SHORT},
        {"to": [x, -y], "radius": LONG},
    ]


def height(angle: float) -> tuple[float, float, float]:
    """Return the height of the oval's centre over a line, and its derivatives by the angle of the oval."""
    a = (angle + 0.5 * math.pi) % math.pi - 0.5 * math.pi
    if abs(a) < HALF:  # on a flat arc, whose centre is above
        return LONG - DOWN * math.cos(a), DOWN * math.sin(a), DOWN * math.cos(a)
    s = math.copysign(1.0, a)
    return SHORT + ASIDE * s * math.sin(a), ASIDE * s * math.cos(a), -ASIDE * s * math.sin(a)


def rolling_oval(mu: str = "5.0") -> str:
    """Return the oval on a line, which it rolls along."""
    at = -height(0.0)[0]
    text = toml(
        {
            "mechanism": {"name": "oval", "gravity": [0.0, -G]},
            "parameters": {"om": -4.0, "b": 1.0},
            "bodies": {
                "oval": {
                    **{"mass": 1.0, "inertia": 0.004, "position": [0.0, -at]},
                    **{"velocity": [f"om*{at!r}", 0.0], "angular_velocity": "om"},
                }
            },
            "outlines": {"o": {"body": "oval", "closed": True, "points": oval()}},
            "contacts": {"touch": {"between": [{"outline": "o"}, {"line": "ground"}], "friction": mu}},
        }
    )
    return text


def rolled(om: float, until: float) -> float:
    """Return the angle of the oval by its energy, without slip."""

    def rates(t: float, y: Array) -> list[float]:
        h, slope, bend = height(y[0])
        inertia = 0.004 + h * h + slope * slope
        return [y[1], -(y[1] ** 2 * slope * (h + bend) + G * slope) / inertia]

    part = solve_ivp(rates, (0.0, until), [0.0, om], "DOP853", rtol=1e-12, atol=1e-13, max_step=1e-3)
    return float(part.y[0, -1])


@pytest.mark.slow
def test_an_oval_rocks_and_rolls(tmp_path: Path) -> None:
    """Slowly it rocks on its flat arcs, and over its ends faster, where it rolls on."""
    model, until = loaded(rolling_oval(), tmp_path), 0.9
    for om in (-2.0, -7.5, 14.0):
        for way in ("default", "dop853", "radau5", "joint"):
            run = model.simulate(parameters={"om": om}, until=until, **{"rtol": 1e-9, **WAYS[way]})
            assert run.ok and not run.events, (om, way, run.reason, run.events)
            assert abs(run["oval.theta"][-1] - rolled(om, until)) < 1e-6, (om, way)
            h = np.array([height(a)[0] for a in run["oval.theta"]])
            assert np.abs(run["oval.y"] - h).max() < 1e-9
    assert abs(rolled(-2.0, until)) < 0.5 * math.pi < math.pi < abs(rolled(14.0, until))


@pytest.mark.slow
def test_three_hundred_spins_of_an_oval(tmp_path: Path) -> None:
    model, until = loaded(rolling_oval(), tmp_path), 0.4
    spins = np.linspace(-7.0, 7.0, 300)
    table = model.sweep(vary={"om": spins}, until=until, rtol=1e-10, integrator="dop853").to_dataframe()
    assert set(table["status"]) == {"ok"}
    expected = [rolled(float(om), until) for om in spins[::10]]
    np.testing.assert_allclose(table["oval.theta"][::10], expected, rtol=0.0, atol=1e-7)
    assert np.abs(np.diff(table["oval.theta"], 2)).max() < 5e-3


@pytest.mark.slow
def test_derivatives_of_an_oval_that_rolls(tmp_path: Path) -> None:
    slopes = slopes_of(rolling_oval(), 0.4, "oval.theta", {"om": -4.0}, tmp_path)
    differences = (rolled(-4.0 + 1e-4, 0.4) - rolled(-4.0 - 1e-4, 0.4)) / 2e-4
    assert abs(slopes["om"] - differences) < 1e-5


#: A rocker: a block with an arc of 0.1 m below, whose centre is 0.08 m above the origin.
ROCKER = [[0.06, 0.0], {"to": [-0.06, 0.0], "radius": 0.1}, [-0.06, 0.03], [0.06, 0.03]]


def rocker(points: list[Any]) -> str:
    """Return a rocker on a line, tilted."""
    place = {"position": [0.0, 0.1 - 0.08 * math.cos(0.15)], "angle": 0.15}
    return toml(
        {
            "mechanism": {"name": "rocker", "gravity": [0.0, -G]},
            "bodies": {"rocker": {"mass": 1.0, "inertia": 0.002, **place}},
            "outlines": {"o": {"body": "rocker", "closed": True, "points": points}},
            "contacts": {"touch": {"between": [{"outline": "o"}, {"line": "ground"}], "friction": 2.0}},
        }
    )


@pytest.mark.slow
def test_a_rocker_rocks_on_its_arc(tmp_path: Path) -> None:
    """As the whole circle would; corners end the arc."""
    run = loaded(rocker(ROCKER), tmp_path).simulate(until=0.6, rtol=1e-10)

    def rates(t: float, y: Array) -> list[float]:  # about the point that touches, 0.1 m below the arc's centre
        c, s = math.cos(y[0]), math.sin(y[0])
        square = 0.1**2 + 0.08**2 - 2.0 * 0.1 * 0.08 * c
        return [y[1], -(0.1 * 0.08 * s * y[1] ** 2 + G * 0.08 * s) / (0.002 + square)]

    part = solve_ivp(rates, (0.0, 0.6), [0.15, 0.0], "DOP853", rtol=1e-12, atol=1e-13)
    assert run.ok and not run.events, (run.reason, run.events)
    assert abs(run["rocker.theta"][-1] - part.y[0, -1]) < 1e-8
    assert np.abs(run["rocker.y"] + 0.08 * np.cos(run["rocker.theta"]) - 0.1).max() < 1e-10


def test_arcs_that_stand_on_both_ends_are_refused(tmp_path: Path) -> None:
    """One part of a contact cannot hold the face of a lens."""
    with pytest.raises(InputError, match="expected arcs whose circles lie within the outline, or whose"):
        loaded(rocker(ROCKER[:2]), tmp_path)
