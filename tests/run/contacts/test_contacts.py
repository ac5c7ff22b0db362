"""Contacts: bodies that skid, roll, bounce, rock and slip; closed forms and independent simulations decide."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symgen.base.errors import InputError
from tests.run.contacts.scenes import G, body, floor, head, loaded, rocking_block, rods

WAYS = [(i, c) for i in ("dop853", "picard", "radau5") for c in ("absolute", "joint")]
ways = pytest.mark.parametrize(("integrator", "coordinates"), WAYS, ids=["-".join(way) for way in WAYS])


def run_of(text: str, folder: Path, until: float, integrator: str = "dop853", **keys: Any) -> Any:
    """Return a run that is not verified by a second one, with tight tolerances."""
    if integrator != "picard":
        keys.setdefault("rtol", 1e-12)
    return loaded(text, folder).simulate(until=until, integrator=integrator, verify=False, **keys)


def times_of(result: Any, word: str) -> list[float]:
    """Return the times of the events with a last word."""
    return [event.t for event in result.events if event.name.endswith(f".{word}")]


@pytest.mark.slow
def test_a_disc_skids_and_rolls(tmp_path: Path) -> None:
    """Speeds at which it rolls follow from the momentum about a point of the floor."""
    text = head("skid") + body("disc", 3.0, 0.5 * 3.0 * 0.04, (0.0, 0.2), (2.0, 0.0), 4.0) + floor("disc", 0.2, 0.15)
    result = run_of(text, tmp_path, 2.0)
    rolls = (2.0 - 0.5 * 0.2 * 4.0) / 1.5
    assert [event.name for event in result.events] == ["floor.stick"]
    assert abs(result.events[0].t - (2.0 - rolls) / (0.15 * G)) < 1e-12
    assert abs(result["disc.vx"][-1] - rolls) < 1e-12 and result["floor.mode"][-1] == 1.0
    # rolls at the angular velocity -v / r
    assert abs(result["disc.omega"][-1] + rolls / 0.2) < 1e-12


@ways
@pytest.mark.slow
def test_a_disc_on_a_slope_turns_back_and_rolls(integrator: str, coordinates: str, tmp_path: Path) -> None:
    angle, mu, r, v0, w0 = math.radians(18.0), 0.3, 0.15, 0.8, -7.0
    gx, gy = G * math.sin(angle), -G * math.cos(angle)
    text = head("slope", gx, gy) + body("disc", 1.0, 0.5 * r * r, (0.0, r), (v0, 0.0), -w0)
    result = run_of(text + floor("disc", r, mu), tmp_path, 1.5, integrator, coordinates=coordinates)
    # slip s = v - r w forwards: friction is -mu N along it, the spin gets 2 mu N / (m r)
    slip = v0 - r * w0
    a, b = gx - mu * -gy, 2.0 * mu * -gy / r
    rolls = slip / (r * b - a)
    v = v0 + a * rolls
    x = v0 * rolls + 0.5 * a * rolls**2 + v * (1.5 - rolls) + gx / 3.0 * (1.5 - rolls) ** 2
    assert [event.name for event in result.events] == ["floor.stick"]
    assert abs(result.events[0].t - rolls) < 1e-12 and abs(result["disc.x"][-1] - x) < 1e-12


def bounces(h: float, e: float, mu: float, v: float, rim: float) -> tuple[list[float], list[float]]:
    """Return times and speeds after the impacts of a spinning disc, m 1 and k 1/2, whose rim moves by `rim` at rest."""
    t, down, times, speeds = math.sqrt(2.0 * h / G), math.sqrt(2.0 * G * h), list[float](), list[float]()
    for _ in range(6):
        impulse = (1.0 + e) * down
        slip = v + rim
        change = -math.copysign(min(mu * impulse, abs(slip) / 3.0), slip)
        v, rim = v + change, rim + 2.0 * change
        times.append(t)
        speeds.append(v)
        down *= e
        t += 2.0 * down / G
    return times, speeds


@ways
@pytest.mark.fast("dop853-absolute")
def test_a_spinning_disc_bounces(integrator: str, coordinates: str, tmp_path: Path) -> None:
    text = head("drop") + body("disc", 1.0, 0.5 * 0.01, (0.0, 0.9), (0.3, 0.0), 25.0) + floor("disc", 0.1, 0.07, 0.6)
    result = run_of(text, tmp_path, 3.0, integrator, coordinates=coordinates)
    times, speeds = bounces(0.8, 0.6, 0.07, 0.3, 2.5)
    hits = [event for event in result.events if event.name == "floor.hit"]
    assert np.allclose([event.t for event in hits[:6]], times, rtol=0.0, atol=1e-12)
    assert np.allclose([event.v_after["disc.vx"] for event in hits[:6]], speeds, rtol=0.0, atol=1e-12)
    ends = math.sqrt(2.0 * 0.8 / G) * (1.0 + 0.6) / (1.0 - 0.6)
    (note,) = [note for note in result.notes if "accumulate" in note]
    assert abs(float(note.split("t = ")[1].split(" s:")[0]) - ends) < 1e-9
    assert result.ok and result["floor.mode"][-1] == 1.0


@pytest.mark.slow
def test_two_contacts_at_once(tmp_path: Path) -> None:
    """A disc flies into a corner: impulses of both contacts and their friction by a projection of one's own."""
    r, mu, e, v = 0.2, (0.25, 0.3), (0.5, 0.7), np.array([-1.0, -1.5, 4.0])
    text = head("corner") + body("disc", 1.0, 0.5 * r * r, (r, r), (-1.0, -1.5), 4.0) + floor("disc", r, mu[0], e[0])
    text += (
        f'[contacts.wall]\nbetween = [{{ body = "disc", disc = {r!r} }}, {{ line = "ground", normal = [1.0, 0.0] }}]\n'
    )
    result = run_of(f"{text}friction = {mu[1]!r}\nrestitution = {e[1]!r}\n", tmp_path, 1e-3)
    mass = np.diag([1.0, 1.0, 0.5 * r * r])
    normal = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
    along = np.array([[1.0, 0.0, r], [0.0, -1.0, r]])
    p, q = np.zeros(2), np.zeros(2)
    for _ in range(4000):  # projections in turn, which come to the impulses where there is one solution
        for i in range(2):
            after = v + np.linalg.solve(mass, normal.T @ p + along.T @ q)
            own = normal[i] @ np.linalg.solve(mass, normal[i])
            p[i] = max(0.0, p[i] - (normal[i] @ after + e[i] * normal[i] @ v) / own)
            after = v + np.linalg.solve(mass, normal.T @ p + along.T @ q)
            own = along[i] @ np.linalg.solve(mass, along[i])
            q[i] = np.clip(q[i] - along[i] @ after / own, -mu[i] * p[i], mu[i] * p[i])
    after = v + np.linalg.solve(mass, normal.T @ p + along.T @ q)
    assert np.allclose([result[f"disc.{x}"][0] for x in ("vx", "vy", "omega")], after, rtol=0.0, atol=1e-12)


def rocking_times(b: float, h: float, start: float) -> tuple[list[float], float]:
    """Return times of the impacts of a block, and their limit.

    Quarters of a rocking period are elliptic integrals; each impact keeps Housner's part of the rate.
    """
    from scipy.integrate import quad

    own, p2 = math.atan2(b, h), 3.0 * G / (4.0 * math.hypot(b, h))
    ratio = 1.0 - 1.5 * math.sin(own) ** 2

    def quarter(amplitude: float) -> float:
        def slowness(x: float) -> float:  # theta = amplitude (1 - x^2)
            lost = math.sin(own - amplitude * (1.0 - 0.5 * x * x)) * math.sin(0.5 * amplitude * x * x)
            return amplitude * x / math.sqrt(p2 * lost) if x > 0.0 else math.sqrt(2.0 * amplitude / p2 / math.sin(own))

        return quad(slowness, 0.0, 1.0, epsabs=1e-14, epsrel=1e-13)[0]

    t, amplitude, hits = 0.0, start, list[float]()
    while amplitude > 1e-24:
        t += quarter(amplitude)
        hits.append(t)
        left = math.sin(own - 0.5 * amplitude) * math.sin(0.5 * amplitude) * ratio**2
        for _ in range(60):
            amplitude = 2.0 * math.asin(left / math.sin(own - 0.5 * amplitude))
        t += quarter(amplitude)
    return hits, t


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.fast("picard")
@pytest.mark.parametrize("integrator", ["dop853", "picard", "radau5"])
def test_a_block_rocks_and_comes_to_rest(integrator: str, tmp_path: Path) -> None:
    """Impacts in turn end at the limit of their times, which a note has; where runs end their rounding differs."""
    hits, limit = rocking_times(0.12, 0.45, 0.1)
    for until in (5.0, 5.5, 6.0, 7.0, 8.0):
        result = run_of(rocking_block(0.12, 0.45, 0.1), tmp_path, until, integrator)
        assert np.allclose(times_of(result, "hit")[:4], hits[:4], rtol=0.0, atol=1e-9)
        (note,) = [note for note in result.notes if "accumulate" in note]
        assert note.startswith("impacts of ") and abs(float(note.split("t = ")[1].split(" s:")[0]) - limit) < 1e-7
        assert result.ok and result["left.mode"][-1] == result["right.mode"][-1] == 1.0


@pytest.mark.slow
def test_impacts_that_add_energy_end_a_run(tmp_path: Path) -> None:
    data = 20.0, 30.0, -0.1, -0.2
    with pytest.raises(
        InputError, match=r"contact tip: expected an impact that adds no energy, got one that adds 0\.0407"
    ):
        run_of(rods(0.5, 0.7, (1.0, 1.0), (1.0, 1.0), data), tmp_path, 1e-3)
    result = run_of(rods(0.2, 0.5, (1.0, 1.0), (1.0, 1.0), data), tmp_path, 1e-3)
    lean = 0.5 * math.cos(math.radians(10.0))
    mass = np.array([[4.0 / 3.0, lean], [lean, 1.0 / 3.0]])
    before, after = np.array([-0.1, -0.2]), np.array([result["one.omega"][0], result["two.omega"][0]])
    assert abs(after @ mass @ after / (before @ mass @ before) - 0.88172953) < 1e-8


@pytest.mark.slow
def test_impulses_of_joints_are_those_of_bodies(tmp_path: Path) -> None:
    """A tip slides in an impact: momentum of both rods, of bodies and of joint coordinates alike."""
    lengths, masses = (1.0, 0.8), (1.5, 0.7)
    text = rods(0.01, 0.5, lengths, masses, (20.0, 50.0, -0.4, -0.9), 0.1)
    for coordinates in ("absolute", "joint"):
        hit = run_of(text, tmp_path, 0.4, coordinates=coordinates).events[0]
        assert hit.name == "tip.hit"
        top, middle = ([hit.impulses[f"{pin}.{x}"] for x in "xy"] for pin in ("top", "middle"))
        tip = np.array([hit.impulses["tip.slip.rate"], hit.impulses["tip.normal"]])
        assert abs(abs(tip[0]) - 0.01 * tip[1]) < 1e-12 * tip[1]
        one, two = (
            masses[i] * np.array([hit.v_after[f"{n}.v{x}"] - hit.v[f"{n}.v{x}"] for x in "xy"])
            for i, n in enumerate(("one", "two"))
        )
        # the impulse of a pin is what its first body gets
        assert np.allclose(tip - np.array(middle), two, rtol=0.0, atol=1e-11)
        assert np.allclose(np.array(middle) - np.array(top), one, rtol=0.0, atol=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_rod_jams(way: float, tmp_path: Path) -> None:
    """A sliding tip has a finite force up to mu (3 sin cos) = 1 + 3 cos^2, one way."""
    a = math.radians(50.0)
    most = (1.0 + 3.0 * math.cos(a) ** 2) / (3.0 * math.sin(a) * math.cos(a))

    def text(mu: float) -> str:
        rod = body("rod", 1.0, 1.0 / 3.0, (math.cos(a), math.sin(a)), (way, 0.0), angle=a)
        tip = '[contacts.tip]\nbetween = [{ body = "rod", at = [-1.0, 0.0] }, { line = "ground" }]\n'
        return f"{head('rod')}{rod}{tip}friction = {mu!r}\n"

    assert run_of(text(most - 1e-9), tmp_path, 1e-3).ok
    if way > 0.0:
        assert run_of(text(most + 1e-9), tmp_path, 1e-3).ok
    else:
        with pytest.raises(InputError, match="contact tip: expected a finite force, got none at t = 0 s"):
            run_of(text(most + 1e-9), tmp_path, 1e-3)


def test_several_motions_are_named(tmp_path: Path) -> None:
    a, omega = math.radians(55.0), 4.5
    rod = body(
        "rod", 1.0, 1.0 / 3.0, (math.cos(a), math.sin(a)), (-1.0 - omega * math.sin(a), omega * math.cos(a)), omega, a
    )
    tip = '[contacts.tip]\nbetween = [{ body = "rod", at = [-1.0, 0.0] }, { line = "ground" }]\nfriction = 2.0\n'
    with pytest.raises(
        InputError, match="contacts: expected one motion at t = 0 s, got several: tip slides backwards, and tip"
    ):
        run_of(head("rod") + rod + tip, tmp_path, 1e-3)


@pytest.mark.slow
def test_two_feet_share_friction(tmp_path: Path) -> None:
    """A block on a slope rests inside the cone, without drift; both feet have equal parts of their bounds."""
    text = head("slope", 2.0, -9.5) + body("block", 1.0, 0.02, (0.0, 0.1))
    for name, x in (("left", -0.2), ("right", 0.2)):
        shapes = f'[{{ body = "block", at = [{x!r}, -0.1] }}, {{ line = "ground" }}]'
        text += f"[contacts.{name}]\nbetween = {shapes}\nfriction = 0.5\n"
    result = loaded(text, tmp_path).simulate(until=1e4)
    assert result.status == "ok" and abs(result["block.x"][-1]) < 1e-13
    pressed = np.array([result[f"{name}.force"][-1] for name in ("left", "right")])
    friction = np.array([result[f"{name}.friction"][-1] for name in ("left", "right")])
    assert np.allclose(pressed, [4.25, 5.25], rtol=0.0, atol=1e-12) and np.allclose(friction, -2.0 * pressed / 9.5)


@pytest.mark.slow
@ways
def test_a_disc_rolls_in_a_hole(integrator: str, coordinates: str, tmp_path: Path) -> None:
    """It swings as a pendulum of 3/2 of its length, whose quarter is an elliptic integral."""
    from scipy.special import ellipk

    hole, r, start = 0.6, 0.15, 0.8
    way = hole - r
    place = way * math.sin(start), -way * math.cos(start)
    text = head("hole") + body("disc", 1.0, 0.5 * r * r, place)
    text += f'[contacts.in]\nbetween = [{{ body = "disc", disc = {r!r} }}, {{ body = "ground", disc = {-hole!r} }}]\n'
    text = text.replace("contacts.in]", "contacts.rim]")
    text += 'friction = 0.6\n[events.bottom]\nwhen = "disc.x"\ndirection = "any"\naction = "record"\n'
    quarter = ellipk(math.sin(start / 2.0) ** 2) / math.sqrt(2.0 * G / (3.0 * way))
    result = run_of(text, tmp_path, 3.0 * quarter + 0.05, integrator, coordinates=coordinates, rtol=1e-12)
    assert np.allclose([event.t for event in result.events], [quarter, 3.0 * quarter], rtol=0.0, atol=1e-11)


def test_friction_at_rest_above_that_in_motion(tmp_path: Path) -> None:
    """A spring pulls a block at constant speed: it breaks loose at mu_s m g / k v, and swings once."""
    mass, k, v, static, sliding = 1.2, 50.0, 0.08, 0.4, 0.25
    text = f"""{head("belt")}[bodies.block]
type = "point"
mass = {mass}
[forces.pull]
type = "force"
body = "block"
force = ["{k}*({v}*t - block.x)", 0.0]
[contacts.floor]
gap = "block.y"
slip = "block.x"
friction = {{ sliding = {sliding}, static = {static} }}
"""
    result = run_of(text, tmp_path, 3.5)
    breaks, omega = static * mass * G / (k * v), math.sqrt(k / mass)
    # in motion u = v t - x - mu m g / k swings: u = A cos + (v / omega) sin until x' = v - u' = 0
    spare = (static - sliding) * mass * G / k
    half = 2.0 * (math.pi - math.atan2(spare * omega, v)) / omega
    assert [event.name for event in result.events[:3]] == ["floor.slip", "floor.stick", "floor.slip"]
    assert abs(result.events[0].t - breaks) < 1e-11 and abs(result.events[1].t - breaks - half) < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize("steps", [37, 64, 100])
def test_events_on_the_steps_of_generalized_alpha(steps: int, tmp_path: Path) -> None:
    """Two feet stick, and a disc lands and skids, at the end of one of its steps."""
    text = head("feet", 2.0) + body("block", 2.0, 0.05, (0.0, 0.1), (1.0, 0.0))
    for name, side in (("left", -0.2), ("right", 0.2)):
        text += f'[contacts.{name}]\nbetween = [{{ body = "block", at = [{side}, -0.1] }}, {{ line = "ground" }}]\n'
        text += "friction = 0.5\n"
    sticks = 1.0 / (0.5 * G - 2.0)
    settings: dict[str, Any] = {"method": "generalized-alpha", "verify": False}
    result = loaded(text, tmp_path).simulate(until=2.0 * sticks, step=sticks / steps, **settings)
    assert result.ok and [event.name for event in result.events] == ["left.stick", "right.stick"]
    assert abs(result.events[0].t - sticks) < 1e-12 and abs(result["block.x"][-1] - 0.5 * sticks) < 1e-12
    text = head("drop") + body("disc", 1.0, 0.005, (0.0, 0.6), (1.0, 0.0)) + floor("disc", 0.1, 0.2)
    lands = math.sqrt(2.0 * 0.5 / G)
    result = loaded(text, tmp_path).simulate(until=2.0 * lands, step=lands / steps, **settings)
    assert result.ok and [event.name for event in result.events] == ["floor.hit", "floor.rest"]
    # the impulse of friction is up to 0.63 N s, and rolling takes a third of the momentum
    assert abs(result["disc.x"][-1] - lands * (1.0 + 2.0 / 3.0)) < 1e-12
