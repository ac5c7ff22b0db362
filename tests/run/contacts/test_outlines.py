"""Discs beside outlines: closed forms, segments of their own, and event-driven code by SciPy."""

import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.mechanisms.toml import text as toml
from symgen.run.integrators import INTEGRATORS
from tests.describe.contacts.test_outlines import CAM, mirrored
from tests.run.contacts.scenes import G, loaded
from tests.run.contacts.test_derivatives import slopes_of

Array = NDArray[np.float64]

#: Ways of a run.
WAYS: dict[str, dict[str, Any]] = {
    "default": {},
    "dop853": {"integrator": "dop853", "rtol": 1e-11},
    "radau5": {"integrator": "radau5"},
    "joint": {"coordinates": "joint"},
    "rk4": {"integrator": "rk4", "step": 1e-3},
    "picard": {"integrator": "picard"},
}


def cam_follower(points: list[Any], friction: float | None = None) -> str:
    """Return a driven cam under a roller that a spring presses."""
    contact = {"between": [{"body": "follower", "disc": 0.008}, {"outline": "cam"}]}
    return toml(
        {
            "mechanism": {"name": "cam", "gravity": [0.0, -G]},
            "parameters": {"om": 2.0},
            "bodies": {
                "cam": {"mass": 1.0, "inertia": 0.001, "angle": -math.pi / 2.0},
                "follower": {"mass": 0.3, "inertia": 1e-4, "position": [0.0, 0.038]},
            },
            "joints": {
                "shaft": {"type": "revolute", "between": ["ground", "cam"], "at": [[0.0, 0.0], "centre"]},
                "guide": {
                    **{"type": "translational", "between": ["ground", "follower"]},
                    **{"at": [[0.0, 0.0], "centre"], "axis": [0.0, 1.0]},
                },
                "motor": {"type": "driver", "joint": "shaft", "value": "-pi/2 - om*t"},
            },
            "forces": {
                "spring": {"type": "force", "body": "follower", "force": ["0", "-200*(follower.y - 0.038 + 0.02)"]}
            },
            "outlines": {"cam": {"body": "cam", "closed": True, "points": points}},
            "contacts": {"touch": contact if friction is None else {**contact, "friction": friction}},
        }
    )


def gap_of_cam(x: Array, y: Array) -> Array:
    """Return the distance from the hull of two discs, of 30 mm at the origin and of 10 mm at 40 mm."""
    y, (c, s) = np.abs(y), (0.5, math.sqrt(0.75))
    along = s * x - c * y
    flank = np.where(along > 0.04 * s, np.hypot(x - 0.04, y) - 0.01, c * x + s * y - 0.03)
    return np.where(along < 0.0, np.hypot(x, y) - 0.03, flank)


@pytest.mark.parametrize("way", [pytest.param(way, marks=() if way == "default" else pytest.mark.slow) for way in WAYS])
@pytest.mark.parametrize("friction", [None, pytest.param(0.1, marks=pytest.mark.slow)])
def test_a_follower_keeps_its_distance_from_a_cam(way: str, friction: float | None, tmp_path: Path) -> None:
    """No event is logged while it passes from the base circle to flanks and nose; direction of the points is free."""
    for points in (CAM, mirrored(CAM)) if way == "dop853" else (CAM,):
        model = loaded(cam_follower(points, friction), tmp_path)
        for speed in (2.0, 6.0):
            run = model.simulate(until=6.4 / speed, output_step=0.02, parameters={"om": speed}, **WAYS[way])
            angle = math.pi / 2.0 + speed * run.t
            y = run["follower.y"]
            error = gap_of_cam(-y * np.sin(angle), y * np.cos(angle)) - 0.008
            assert run.ok and np.abs(error).max() < 1e-11, (way, speed, run.reason)
            assert [event.name for event in run.events if event.name != "touch.hit"] == []


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", [name for name, each in INTEGRATORS.items() if {"ode", "index-1"} & {*each.forms}])
def test_every_integrator_keeps_a_follower_on_a_cam(name: str, coordinates: str, tmp_path: Path) -> None:
    model = loaded(cam_follower(CAM), tmp_path)
    run = model.simulate(until=3.2, output_step=0.02, integrator=name, coordinates=coordinates)
    angle, y = math.pi / 2.0 + 2.0 * run.t, run["follower.y"]
    assert run.ok and not run.events
    assert np.abs(gap_of_cam(-y * np.sin(angle), y * np.cos(angle)) - 0.008).max() < 1e-11


def roof(slope: float, segments: bool = False, mu: float = 0.3, v: float = 0.6, fillet: float = 0.0) -> str:
    """Return a disc that rolls over a ridge, or beyond the end of its first side alone; `fillet` rounds the ridge."""
    ridge = [[-1.0, 0.0], [0.0, 0.0], [math.cos(slope), -math.sin(slope)]]
    other = {"body": "ground", "segment": ridge[:2]} if segments else {"outline": "roof"}
    raw = {
        "mechanism": {"name": "roof", "gravity": [0.0, -G]},
        "parameters": {"mu": mu, "v": v, "rho": fillet},
        "bodies": {
            "disc": {
                **{"mass": 1.0, "inertia": 0.005, "position": [-0.15, 0.1]},
                **{"velocity": ["v", 0.0], "angular_velocity": "-v/0.1"},
            }
        },
        "outlines": {"roof": {"body": "ground", "points": ridge, **({"fillet": "rho"} if fillet else {})}},
        "contacts": {"touch": {"between": [{"body": "disc", "disc": 0.1}, other], "friction": "mu"}},
    }
    return toml(raw)


@pytest.mark.slow
def test_a_disc_passes_a_ridge_as_the_end_of_its_first_side(tmp_path: Path) -> None:
    """Sixty times over a ridge that is too steep for the disc to meet its second side."""
    outline, alone = (loaded(roof(1.2, segments), tmp_path) for segments in (False, True))
    draw = np.random.default_rng(20)
    for _ in range(60):
        values = {"mu": float(draw.uniform(0.05, 1.5)), "v": float(draw.uniform(0.2, 0.95))}
        until = 0.15 / values["v"] + 0.1
        runs = [each.simulate(until=until, output_step=until / 20.0, parameters=values) for each in (outline, alone)]
        assert all(run.ok for run in runs), runs[0].reason
        assert [event.name for event in runs[0].events] == [event.name for event in runs[1].events]
        np.testing.assert_allclose(runs[0].q.values, runs[1].q.values, rtol=0.0, atol=1e-7)


#: Outlines, with the place and the velocity at the start of the centre of a disc of 0.05 m that rolls round them.
ROUND: dict[str, tuple[dict[str, Any], complex, complex]] = {
    "face": ({"box": [0.2, 0.2]}, 0.01 + 0.15j, 2.1),
    "junction": ({"box": [0.2, 0.2]}, 0.1 + 0.15j, 1.5),
    "closure": ({"box": [0.2, 0.2]}, -0.1 + 0.15j, 1.5),
    "back": ({"box": [0.2, 0.2]}, -0.15 - 0.1j, -1.5j),
    "hexagon": ({"polygon": {"sides": 6, "radius": 0.1}, "angle": math.pi / 6.0}, 0.15j, 1.5),
    "cam": ({"points": CAM, "closed": True}, -0.08, 1.3j),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", ROUND)
def test_rolling_round_an_outline(name: str, tmp_path: Path) -> None:
    """It neither slips nor leaves, in all ways, and energy is kept, wherever it begins and the outline closes."""
    outline, place, velocity = ROUND[name]
    r, place, velocity = 0.05, complex(place), complex(velocity)
    rolls = math.copysign(abs(velocity) / r, (place.conjugate() * velocity).imag)
    raw = {
        "mechanism": {"name": "round"},
        "bodies": {
            "disc": {
                **{"mass": 1.0, "inertia": 0.5 * r * r, "position": [place.real, place.imag]},
                **{"velocity": [velocity.real, velocity.imag], "angular_velocity": rolls},
            }
        },
        "forces": {"pull": {"type": "force", "body": "disc", "force": ["-400*disc.x", "-400*disc.y"]}},
        "outlines": {"o": {"body": "ground", **outline}},
        "contacts": {"touch": {"between": [{"body": "disc", "disc": r}, {"outline": "o"}], "friction": 5.0}},
    }
    model, turns = loaded(toml(raw), tmp_path), list[float]()
    for way in ("default", "dop853", "radau5", "joint"):
        run = model.simulate(until=2.0, output_step=0.05, verify=False, **WAYS[way])
        kinetic = 0.5 * (run["disc.vx"] ** 2 + run["disc.vy"] ** 2) + 0.25 * (r * run["disc.omega"]) ** 2
        energy = kinetic + 200.0 * (run["disc.x"] ** 2 + run["disc.y"] ** 2)
        assert run.ok and not run.events, (way, run.reason)
        assert np.abs(energy - energy[0]).max() < 1e-7 * energy[0], way
        turns.append(run["disc.theta"][-1])
    assert abs(turns[0]) > 4.0 * math.pi
    np.testing.assert_allclose(turns, turns[1], rtol=0.0, atol=2e-7)


def valley(outline: bool) -> str:
    """Return a disc in a valley of two sides, as an outline or as two lines."""
    points = [[-2.0, 0.5], [0.0, 0.0], [2.0, 0.8]]
    disc, law = {"body": "disc", "disc": 0.1}, {"friction": "mu", "restitution": "e"}
    contacts: dict[str, Any] = {"touch": {"between": [disc, {"outline": "slopes"}], **law}}
    if not outline:
        normals = {"left": [0.25, 1.0], "right": [-0.4, 1.0]}
        contacts = {k: {"between": [disc, {"line": "ground", "normal": n}], **law} for k, n in normals.items()}
    raw = {
        "mechanism": {"name": "valley", "gravity": [0.0, -G]},
        "parameters": {"mu": 0.3, "e": 0.0},
        "bodies": {"disc": {"mass": 1.0, "inertia": 0.005, "position": [-1.0, 0.25 + 0.1 * math.hypot(1.0, 0.25)]}},
        "outlines": {"slopes": {"body": "ground", "points": points}},
        "contacts": contacts,
    }
    return toml(raw)


@pytest.mark.slow
def test_a_valley_is_two_lines(tmp_path: Path) -> None:
    outline, lines = (loaded(valley(each), tmp_path) for each in (True, False))
    for way in ("default", "radau5", "joint"):
        for mu in (0.05, 0.3, 1.0):
            for e in (0.0, 0.5):
                settings = {"until": 2.0, "output_step": 0.05, "parameters": {"mu": mu, "e": e}, **WAYS[way]}
                runs = [model.simulate(**settings) for model in (outline, lines)]
                assert all(run.ok for run in runs), runs[0].reason
                np.testing.assert_allclose(runs[0].q.values, runs[1].q.values, rtol=0.0, atol=1e-11)
                force = runs[1]["left.force"] + runs[1]["right.force"]
                np.testing.assert_allclose(runs[0]["touch.force"], force, rtol=0.0, atol=1e-8)
                assert len(runs[0].events) == len(runs[1].events)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("mu", "v"), [(0.0, 0.6), (0.2, 0.9), (1.5, 0.6)])
def test_derivatives_over_a_ridge(mu: float, v: float, tmp_path: Path) -> None:
    """By the speed, by the friction and by a radius of the outline: pieces change with it, and code does not."""
    text = roof(0.5, mu=mu, v=v, fillet=0.05)
    values = {"v": v, "rho": 0.05, **({"mu": mu} if mu else {})}
    # the slope by rho is 0.02: ends rounded to 1e-12 are 5e-6 of it in differences with 1e-5
    slopes = slopes_of(text, 0.6, "disc.x", values, tmp_path, steps={"rho": 3e-5})
    assert min(abs(slopes["v"]), abs(slopes["rho"])) > 1e-3


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_rows_of_radii_are_single_runs(tmp_path: Path) -> None:
    """Chains follow parameters: one compiled model has all of them."""
    model = loaded(roof(0.5, fillet=0.05), tmp_path)
    radii = np.linspace(0.01, 0.3, 300)
    table = model.sweep(vary={"rho": radii}, integrator="dop853", until=0.7).to_dataframe()
    (key,) = [key for key in table.columns if key.startswith("disc.x")]
    assert set(table["status"]) == {"ok"} and len(set(table[key])) == 300
    for i in range(0, 300, 30):
        run = model.simulate(parameters={"rho": float(radii[i])}, integrator="dop853", until=0.7, verify=False)
        assert table[key][i] == run["disc.x"][-1]


class Jump:
    """A follower of 0.3 kg on the cam of `cam_follower`: where its force ends, and where it lands again."""

    radius, far, nose, mass, stiffness = 0.038, 0.04, 0.018, 0.3, 200.0
    alpha = math.pi / 3.0
    top = math.atan2(nose * math.sin(alpha), far + nose * math.cos(alpha))

    def __init__(self, speed: float) -> None:
        self.speed = speed

    def height(self, t: float) -> tuple[float, float, float]:
        """Return the height on the cam and its derivatives by time."""
        from_nose = self.speed * t - math.pi
        side, b = math.copysign(1.0, from_nose), abs(from_nose)
        if b > self.alpha:
            y, slope, bend = self.radius, 0.0, 0.0
        elif b > self.top:
            u = b - self.alpha
            y = self.radius / math.cos(u)
            slope, bend = y * math.tan(u), y * (2.0 / math.cos(u) ** 2 - 1.0)
        else:
            q, product = math.sqrt(self.nose**2 - (self.far * math.sin(b)) ** 2), math.sin(b) * math.cos(b)
            y, slope = self.far * math.cos(b) + q, -self.far * math.sin(b) - self.far**2 * product / q
            bend = -self.far * math.cos(b) - self.far**2 * math.cos(2.0 * b) / q - self.far**4 * product**2 / q**3
        return y, side * slope * self.speed, bend * self.speed**2

    def force(self, t: float) -> float:
        """Return the force that keeps it on the cam."""
        y, _, acceleration = self.height(t)
        return self.mass * (acceleration + G) + self.stiffness * (y - 0.018)

    def times(self) -> tuple[float, float]:
        """Return when it leaves the cam, and when it is back."""
        from scipy.optimize import brentq

        first = (math.pi - self.top) / self.speed
        lift = first
        if self.force(first + 1e-12) > 0.0:
            lift = brentq(self.force, first, math.pi / self.speed, xtol=1e-15)
        y, rate, _ = self.height(lift + 1e-13)
        omega, middle = math.sqrt(self.stiffness / self.mass), 0.018 - self.mass * G / self.stiffness

        def gap(t: float) -> float:
            angle = omega * (t - lift)
            flight = middle + (y - middle) * math.cos(angle) + rate / omega * math.sin(angle)
            return flight - self.height(t)[0]

        ahead = np.linspace(lift, lift + 2.0 * math.pi / omega, 20001)[20:]
        low = next(a for a, b in pairwise(ahead) if gap(a) > 0.0 >= gap(b))
        return lift, brentq(gap, low, low + ahead[1] - ahead[0], xtol=1e-15)


@pytest.mark.slow
def test_three_hundred_speeds_through_the_jump_of_a_cam(tmp_path: Path) -> None:
    """Where the curvature jumps the force does, and the follower leaves there or where its force becomes 0."""
    model = loaded(cam_follower(CAM), tmp_path)
    for speed in np.linspace(17.0, 45.0, 300):
        lift, hit = Jump(float(speed)).times()
        settings = {"integrator": "dop853", "rtol": 1e-11, "until": hit + 1e-3, "verify": False}
        run = model.simulate(parameters={"om": float(speed)}, **settings)
        assert run.ok, run.reason
        happened = {event.name: event.t for event in reversed(run.events)}
        assert abs(happened["touch.lift"] - lift) < 1e-9 and abs(happened["touch.hit"] - hit) < 1e-9, speed
