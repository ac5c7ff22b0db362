"""Gears with involute teeth: distances of flanks, a constant ratio, play, and impacts on both sides."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import symgen
from benchmarks.mechanisms.toml import text as toml
from tests.describe.contacts.test_outlines import chains_of, described, number
from tests.run.contacts.scenes import loaded

Array = NDArray[np.float64]

MODULE, TEETH, PRESSURE = 0.005, (17, 29), math.radians(20.0)
BASES = tuple(0.5 * z * MODULE * math.cos(PRESSURE) for z in TEETH)
TIGHT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11, "verify": False}


def profile(teeth: int, thinner: float = 0.02, **more: Any) -> dict[str, Any]:
    return {"gear_profile": {"module": MODULE, "teeth": teeth, "thinner": thinner, **more}}


def pair(driven: bool = True, second: dict[str, Any] | None = None) -> dict[str, Any]:
    """Return two gears on shafts, the first one driven or free; a tooth of it is in a gap of the second one."""
    bodies, joints = dict[str, Any](), dict[str, Any]()
    for name, place, angle in (("one", 0.0, 0.0), ("two", "apart", f"pi + pi/{TEETH[1]} + start")):
        bodies[name] = {"mass": 1.0, "inertia": 1e-3 if name == "one" else "heavy", "position": [place, 0.0]}
        bodies[name] |= {"angle": angle, "angular_velocity": 0.0 if driven or name == "two" else "speed"}
        joints[f"{name}_shaft"] = {"type": "revolute", "between": ["ground", name], "at": [[place, 0.0], "centre"]}
    if driven:
        joints["motor"] = {"type": "driver", "joint": "one_shaft", "value": "speed*t + 0.5*grows*t**2"}
    bodies["two"]["angular_velocity"] = "spin"
    return {
        "mechanism": {"name": "gears"},
        "parameters": {
            **{"apart": 0.5 * sum(TEETH) * MODULE, "speed": 0.0, "spin": 0.0, "start": 0.0, "load": 0.0, "grows": 0.0},
            **{"e": 0.0, "heavy": 5e-3},
        },
        "bodies": bodies,
        "joints": joints,
        "forces": {"load": {"type": "torque", "body": "two", "torque": "load"}},
        "outlines": {
            "pinion": {"body": "one", **profile(TEETH[0])},
            "wheel": {"body": "two", **(second or profile(TEETH[1]))},
        },
        "contacts": {"mesh": {"between": [{"outline": "pinion"}, {"outline": "wheel"}], "restitution": "e"}},
    }


def play(apart: float, thinner: float = 0.02) -> float:
    """Return the way along the line of action that is free, from the thickness of the teeth on their rolling circles.

    On circles that roll on each other at a distance, teeth have s = 2 r (s0 / (2 r0) + inv(alpha0) - inv(alpha)).
    """
    alpha = math.acos(sum(BASES) / apart)
    involute = [math.tan(x) - x for x in (PRESSURE, alpha)]
    thick = 0.0
    for teeth, base in zip(TEETH, BASES, strict=True):
        own = MODULE * (0.5 * math.pi - thinner) / (teeth * MODULE)
        thick += 2.0 * base / math.cos(alpha) * (own + involute[0] - involute[1])
    return (2.0 * math.pi * BASES[0] / math.cos(alpha) / TEETH[0] - thick) * math.cos(alpha)


def flanks(teeth: int, angle: float, place: float, thinner: float = 0.02) -> Array:
    """Return points of all flanks of a gear as complex numbers, a row for each flank."""
    base = 0.5 * teeth * MODULE * math.cos(PRESSURE)
    tip = 0.5 * teeth * MODULE + MODULE
    half = (0.5 * math.pi - thinner) / teeth + math.tan(PRESSURE) - PRESSURE
    roll = np.linspace(0.0, math.sqrt((tip / base) ** 2 - 1.0), 400)
    right = base * (1.0 - 1j * roll) * np.exp(1j * (roll - half))
    turns = np.exp(1j * (angle + 2.0 * math.pi * np.arange(teeth) / teeth))[:, np.newaxis]
    return np.concatenate([turns * right, turns * right.conjugate()]) + place


def distance(one: Array, other: Array) -> float:
    """Return the least distance of the points of flanks from the sides between the points of others."""
    start, way = one[:, :-1].ravel(), np.diff(one, axis=1).ravel()
    near = np.abs(start - other.mean()) < 1.2 * np.abs(other - other.mean()).max()
    start, way = start[near], way[near]
    points = other.ravel()
    points = points[np.abs(points - one.mean()) < 1.05 * np.abs(one - one.mean()).max()]
    part = np.clip(((points[:, np.newaxis] - start) * way.conjugate()).real / np.abs(way) ** 2, 0.0, 1.0)
    return float(np.abs(points[:, np.newaxis] - start - part * way).min())


@pytest.mark.slow
def test_gaps_are_distances_of_flanks(tmp_path: Path) -> None:
    """At any place within the play, and with centres farther apart."""
    model, draw = loaded(toml(pair()), tmp_path), np.random.default_rng(1)
    standard = 0.5 * sum(TEETH) * MODULE
    for _ in range(12):
        apart = standard * float(draw.uniform(1.0, 1.01))
        free, turned = play(apart), float(draw.uniform(-1.0, 1.0))
        part = float(draw.uniform(-0.45, 0.45))
        start = part * free / BASES[1] - turned * TEETH[0] / TEETH[1]
        raw = pair()
        raw["bodies"]["one"]["angle"] = turned
        raw["joints"]["motor"]["value"] = turned
        model = loaded(toml(raw), tmp_path)
        run = model.simulate(until=1e-6, parameters={"apart": apart, "start": start}, **TIGHT)
        gap = float(run["mesh.gap"][0])
        assert abs(gap - (0.5 - abs(part)) * free) < 1e-12
        one, two = flanks(TEETH[0], turned, 0.0), flanks(TEETH[1], math.pi + math.pi / TEETH[1] + start, apart)
        known = min(distance(one, two), distance(two, one))
        assert abs(gap - known) < 2e-8, (gap, known)


@pytest.mark.slow
def test_the_ratio_is_constant_at_any_distance_of_the_centres(tmp_path: Path) -> None:
    """A load presses the wheel on the pinion, whose speed grows; the force is that of the line of action."""
    model = loaded(toml(pair()), tmp_path)
    for apart in np.linspace(1.0, 1.01, 10) * 0.5 * sum(TEETH) * MODULE:
        for speed, load in ((3.0, 5.0), (-3.0, -5.0)):
            values = {"apart": float(apart), "speed": speed, "load": load, "grows": 0.6}
            run = model.simulate(until=1.0, output_step=0.02, parameters=values, **TIGHT)
            assert run.ok, run.reason
            hit = max(event.t for event in run.events)
            after = run.t > hit
            wheel = run["two.theta"] - run["two.theta"][0] + TEETH[0] / TEETH[1] * run["one.theta"]
            side = 0.5 * play(float(apart)) / BASES[1]
            np.testing.assert_allclose(wheel[after], math.copysign(side, load), rtol=0.0, atol=1e-9)
            bends = -0.6 * TEETH[0] / TEETH[1]
            force = abs(load - 5e-3 * bends) / BASES[1]
            np.testing.assert_allclose(run["mesh.force"][after], force, rtol=1e-8)


def struck(e: float, speed: float, until: float) -> tuple[float, int]:
    """Return how far a free wheel has turned between flanks at rest, and how often it struck."""
    side = 0.5 * play(0.5 * sum(TEETH) * MODULE) / BASES[1]
    place, time, count = 0.0, 0.0, 0
    while time + (way := (math.copysign(side, speed) - place) / speed) < until:
        place, time, speed, count = math.copysign(side, speed), time + way, -e * speed, count + 1
    return place + speed * (until - time), count


@pytest.mark.slow
def test_a_wheel_strikes_both_sides_of_its_gap_and_three_hundred_derivatives(tmp_path: Path) -> None:
    model = loaded(toml(pair()), tmp_path)
    for e in np.linspace(0.4, 0.99, 300):
        settings = {"until": 0.1, "parameters": {"e": float(e), "spin": 1.0}}
        run = model.simulate(sensitivities=["e"], **settings, **TIGHT)
        known, count = struck(float(e), 1.0, 0.1)
        assert run.ok, run.reason
        assert sum(event.name == "mesh.hit" for event in run.events) == count > 3
        assert abs(run["two.theta"][-1] - run["two.theta"][0] - known) < 1e-10, e
        place = run.q.names.index("two.theta")
        slope = np.asarray(run.sensitivities.table("q")).reshape(len(run.t), -1)[-1, place]
        h = 1e-6
        ends = [struck(float(e) + x, 1.0, 0.1) for x in (h, -h)]
        if ends[0][1] == ends[1][1]:
            difference = (ends[0][0] - ends[1][0]) / (2.0 * h)
            assert abs(slope - difference) < 1e-6 * abs(difference) + 1e-9, e


@pytest.mark.slow
def test_a_spring_holds_a_wheel_within_its_play_or_at_a_flank(tmp_path: Path) -> None:
    """At equilibrium the flanks of one side carry what the spring does not, none within the play."""
    raw = pair()
    raw["forces"]["load"]["torque"] = f"load - 50*(two.theta - pi - pi/{TEETH[1]})"
    model, free = loaded(toml(raw), tmp_path), 0.5 * play(raw["parameters"]["apart"]) / BASES[1]
    for load in np.linspace(-3.0, 3.0, 60):
        found = model.equilibrium(parameters={"load": float(load)})
        turn = float(np.clip(load / 50.0, -free, free))
        assert abs(found.q["two.theta"] - math.pi - math.pi / TEETH[1] - turn) < 1e-9
        forces = [abs(x) for name, x in found.multipliers.items() if name.startswith("mesh")]
        assert abs(sum(forces) - abs(load - 50.0 * turn) / BASES[1]) < 1e-6


@pytest.mark.slow
def test_looped_code_turns_gears_as_straight_code_does(tmp_path: Path) -> None:
    """Of an angle that stood twice in its gaps looped code counted the turns twice, and stopped."""
    model, parameters = loaded(toml(pair()), tmp_path), {"e": 0.4, "speed": 5.0, "grows": -20.0}
    settings = {"until": 0.3, "parameters": parameters, **TIGHT}
    runs = [model.simulate(shape=shape, **settings) for shape in ("straight", "looped")]
    assert all(run.ok for run in runs) and len(runs[0].events) == len(runs[1].events) > 2
    np.testing.assert_allclose(runs[0].q.values[-1], runs[1].q.values[-1], rtol=0.0, atol=1e-9)


@pytest.mark.slow
def test_two_free_gears_rattle_with_their_momentum(tmp_path: Path) -> None:
    """Impacts keep the momentum along the line of action and multiply the rate of approach by -e."""
    model = loaded(toml(pair(driven=False)), tmp_path)
    for e in (0.3, 0.8, 1.0):
        run = model.simulate(until=0.3, output_step=1e-3, parameters={"e": e, "speed": 2.0}, integrator="dop853")
        assert run.ok, run.reason
        spins = np.array([run["one.omega"], run["two.omega"]])
        inertias = np.array([1e-3, 5e-3])
        kept = inertias[0] * spins[0] / BASES[0] - inertias[1] * spins[1] / BASES[1]
        np.testing.assert_allclose(kept, kept[0], rtol=1e-9)
        approach = np.abs(BASES[0] * spins[0] + BASES[1] * spins[1])
        count = np.searchsorted(sorted(x.t for x in run.events if x.name == "mesh.hit"), run.t)
        np.testing.assert_allclose(approach, approach[0] * np.power(e, count), rtol=1e-7, atol=1e-10)


@pytest.mark.parametrize(("tolerance", "most"), [(1e-4, 16), pytest.param(1e-6, 80, marks=pytest.mark.slow)])
def test_arcs_of_flanks_are_near_the_involute(tolerance: float, most: int) -> None:
    """The curve at a distance r from an involute is one that begins at an angle farther by r over the base radius."""
    teeth, r = 9, 1e-4
    (chain,) = chains_of(described(profile(teeth, 0.0, tolerance=tolerance), r))
    base, tip = 0.5 * teeth * MODULE * math.cos(PRESSURE), 0.5 * teeth * MODULE + MODULE + r
    half, count = 0.5 * math.pi / teeth + math.tan(PRESSURE) - PRESSURE + r / base, 0
    for piece in chain.pieces:
        k, length = number(piece.curvature), number(piece.length)
        start, along = complex(*map(number, piece.start)), complex(*map(number, piece.along))
        if k <= 0.0 or abs(1.0 / k - tip) < 1e-9 or abs(1.0 / k - r) < 1e-9:
            continue
        count += 1
        for part in np.linspace(0.0, 1.0, 9):
            point = start + along * (1.0 - np.exp(-1j * k * length * part)) / (1j * k)
            roll = math.sqrt(max(0.0, (abs(point) / base) ** 2 - 1.0))
            angle = abs((np.angle(point) + math.pi / teeth) % (2.0 * math.pi / teeth) - math.pi / teeth)
            assert base * abs(angle + roll - math.atan(roll) - half) < tolerance * MODULE + 1e-12
    assert 2 * teeth < count <= 2 * teeth * most


@pytest.mark.parametrize(
    ("second", "sentence"),
    [
        (profile(29, 0.0, pressure_angle=0.3), "gears of one module and one pressure angle"),
        (profile(29, 0.0, addendum=0.2), "teeth that meet before the last ones part"),
        (profile(2), "a number of at least 4, got 2"),
        (profile(29, 0.0, addendum=4.0), "teeth with a width at their tips"),
        (profile(29, 0.0, tolerance=1.0), "a part of the module from 1e-9 to 1e-2"),
        (profile(29, 0.0, pressure_angle=20.0), "an angle from 0.05 to 0.8 rad, got 20.0 rad"),
        ({**profile(29), "box": [1.0, 1.0]}, "got box and gear_profile"),
    ],
)
def test_teeth_that_are_none(second: dict[str, Any], sentence: str, tmp_path: Path) -> None:
    (tmp_path / "gears.toml").write_text(toml(pair(second=second)))
    with pytest.raises(symgen.InputError) as caught:
        symgen.load(tmp_path / "gears.toml")
    assert sentence in str(caught.value)


def test_teeth_have_no_friction(tmp_path: Path) -> None:
    raw = pair()
    raw["contacts"]["mesh"]["friction"] = 0.1
    (tmp_path / "gears.toml").write_text(toml(raw))
    with pytest.raises(symgen.InputError, match="no friction along teeth"):
        symgen.load(tmp_path / "gears.toml")
