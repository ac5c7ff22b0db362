"""Spheres, rims, capsules and boxes on planes and on each other, without friction, beside closed forms."""

import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from tests.run.contacts.scenes import G, loaded
from tests.run.contacts.scenes_in_space import body, contact, head, listed

BALL, PLANE = 'body = "ball", sphere = 0.1', 'plane = "ground"'
BOUNCE = (
    head() + "[parameters]\ne = 0.7\n" + body("ball", (0.0, 0.0, 1.1), (0.3, -0.2, 0.0)) + contact(BALL, PLANE, '"e"')
)


def last_bounce(e: float) -> tuple[float, float]:
    """Return when a ball that falls by 1 m rests, and when it strikes first."""
    first = math.sqrt(2.0 / G)
    return first * (1.0 + 2.0 * e / (1.0 - e)), first


@pytest.mark.slow_cases("dop853-joint", "radau5-absolute", "rk4-absolute", "picard-absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("integrator", ["dop853", "picard", "radau5", "rk4"])
def test_a_ball_bounces_until_it_rests_and_slides(integrator: str, coordinates: str, tmp_path: Path) -> None:
    more: dict[str, Any] = {"step": 1e-3} if integrator == "rk4" else {"rtol": 1e-10}
    result = loaded(BOUNCE, tmp_path).simulate(
        until=3.0, integrator=integrator, coordinates=coordinates, verify=False, **more
    )
    rests, first = last_bounce(0.7)
    assert result.ok and result.events[0].name == "touch.hit" and abs(result.events[0].t - first) < 1e-9
    assert result.events[-1].name == "touch.rest" and abs(result.events[-1].t - rests) < 1e-6
    assert abs(result["ball.x"][-1] - 0.9) < 1e-9 and abs(result["ball.y"][-1] + 0.6) < 1e-9
    assert abs(result["ball.z"][-1] - 0.1) < 1e-12 and abs(result["touch.force"][-1] - G) < 1e-9


@pytest.mark.slow
def test_restitutions_swept(tmp_path: Path) -> None:
    """Three hundred coefficients: none fails, each rests when its closed form does; rows are single runs."""
    values = np.linspace(0.05, 0.85, 300)
    model, settings = loaded(BOUNCE, tmp_path), {"integrator": "dop853", "until": 1.2}
    table = model.sweep(vary={"e": values}, **settings).to_dataframe()
    (height,) = [key for key in table.columns if key.startswith("ball.z")]
    for e, found in zip(values, table[height], strict=True):
        rests, first = last_bounce(e)
        wanted, t, up = 0.1, first, math.sqrt(2.0 * G) * e
        while rests > 1.2 and t + 2.0 * up / G < 1.2:
            t, up = t + 2.0 * up / G, up * e
        if rests > 1.2:
            wanted += up * (1.2 - t) - G * (1.2 - t) ** 2 / 2.0
        assert abs(found - wanted) < 1e-7
    single = [model.simulate(parameters={"e": float(e)}, verify=False, **settings)["ball.z"][-1] for e in values[::100]]
    assert table[height].tolist()[::100] == single


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_two_spheres_strike_obliquely(seed: int, tmp_path: Path) -> None:
    """The impulse is along the line of centres; spins stay."""
    draw = np.random.default_rng(seed)
    masses, radii, e = draw.uniform(0.5, 2.0, 2), draw.uniform(0.1, 0.3, 2), draw.uniform(0.2, 1.0)
    apart = draw.normal(size=3)
    apart /= np.linalg.norm(apart)
    aside = np.cross(apart, draw.normal(size=3))
    aside *= 0.8 * sum(radii) / np.linalg.norm(aside)
    speeds = draw.normal(size=3) * 0.1, draw.normal(size=3) * 0.1
    one, other = speeds[0] + 2.0 * apart, speeds[1]
    # they meet where the distance of the centres along their relative velocity is the sum of the radii
    place, closing = apart + aside, one - other
    a, b, c = closing @ closing, place @ closing, place @ place - sum(radii) ** 2
    t = (b - math.sqrt(b * b - a * c)) / a
    normal = place - closing * t
    normal /= np.linalg.norm(normal)
    impulse = (1.0 + e) * (closing @ normal) / (1.0 / masses[0] + 1.0 / masses[1])
    text = head((0.0,) * 3) + body("ball", (0.0,) * 3, one, masses[0], omega=(1.0, 2.0, 3.0))
    text += body("other", place, other, masses[1])
    text += contact(f'body = "ball", sphere = {float(radii[0])!r}', f'body = "other", sphere = {float(radii[1])!r}', e)
    result = loaded(text, tmp_path).simulate(until=1.0, integrator="dop853", verify=False, rtol=1e-11)
    (hit,) = result.events
    assert hit.name == "touch.hit" and abs(hit.t - t) < 1e-11
    for name, before, mass, sign in (("ball", one, masses[0], -1.0), ("other", other, masses[1], 1.0)):
        after = before + sign * impulse / mass * normal
        assert np.allclose([result[f"{name}.{x}"][-1] for x in ("vx", "vy", "vz")], after, rtol=0.0, atol=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_ball_in_a_hollow_sphere_is_a_spherical_pendulum(coordinates: str, tmp_path: Path) -> None:
    length, angle, about = 0.4, 0.9, 4.0

    def rates(_: float, y: np.ndarray) -> list[float]:
        spin = math.sin(angle) ** 2 * about / math.sin(y[0]) ** 2
        return [y[1], math.sin(y[0]) * math.cos(y[0]) * spin**2 - G / length * math.sin(y[0]), spin]

    end = solve_ivp(rates, (0.0, 1.5), [angle, 0.0, 0.0], rtol=1e-12, atol=1e-13, method="DOP853").y[:, -1]
    place = length * math.sin(angle), 0.0, -length * math.cos(angle)
    text = head() + body("ball", place, (0.0, place[0] * about, 0.0), 2.0)
    text += contact(BALL, 'body = "ground", sphere = -0.5')
    result = loaded(text, tmp_path).simulate(
        until=1.5, integrator="dop853", verify=False, rtol=1e-11, coordinates=coordinates
    )
    wanted = length * np.array([math.sin(end[0]) * math.cos(end[2]), math.sin(end[0]) * math.sin(end[2])])
    assert result.ok and not result.events
    assert np.allclose([result["ball.x"][-1], result["ball.y"][-1]], wanted, rtol=0.0, atol=1e-9)
    spin = math.sin(angle) ** 2 * about / math.sin(end[0]) ** 2
    pressed = 2.0 * (length * (end[1] ** 2 + (math.sin(end[0]) * spin) ** 2) + G * math.cos(end[0]))
    assert abs(result["touch.force"][-1] - pressed) < 1e-8


RIM = 'body = "coin", disc = 0.5'


@pytest.mark.slow
@pytest.mark.parametrize(("spin", "about"), [(0.0, 0.0), (6.0, 1.0), (-9.0, 2.0)])
def test_a_coin_on_ice_leans_as_its_equations_say(spin: float, about: float, tmp_path: Path) -> None:
    """Its centre moves up and down alone; two momenta stay, about its axis and about the vertical."""
    r, a, c, lean = 0.5, 0.0625, 0.125, 0.3
    axis_rate = spin + about * math.sin(lean)  # about the axis, which is lean above the floor
    along, upright = c * axis_rate, a * about * math.cos(lean) ** 2 + c * axis_rate * math.sin(lean)

    def rates(_: float, y: np.ndarray) -> list[float]:
        # angle t of the axis above the floor: centre at r cos t
        t, u = y
        turn = (upright - along * math.sin(t)) / (a * math.cos(t) ** 2)
        force = a * turn**2 * -math.sin(t) * math.cos(t) + along * turn * math.cos(t)
        # L = (a + m r^2 sin^2 t) u^2/2 + a turn^2 cos^2 t/2 + along part - m g r cos t
        return [
            u,
            (force + G * r * math.sin(t) - r * r * math.sin(t) * math.cos(t) * u * u) / (a + (r * math.sin(t)) ** 2),
        ]

    end = solve_ivp(rates, (0.0, 0.15), [lean, 0.0], rtol=1e-12, atol=1e-13, method="DOP853").y[:, -1]
    axis = np.array([0.0, -math.cos(lean), math.sin(lean)])
    omega = spin * axis + about * np.array([0.0, 0.0, 1.0])
    turn = (math.pi / 2.0 - lean, 0.0, 0.0)
    own = Rotation.from_rotvec(turn).inv().apply(omega)
    text = head() + body("coin", (0.0, 0.0, r * math.cos(lean)), (0.1, 0.2, 0.0), 1.0, (a, a, c), turn=turn, omega=own)
    text += contact(RIM, PLANE)
    result = loaded(text, tmp_path).simulate(until=0.15, integrator="dop853", verify=False, rtol=1e-11)
    assert result.ok and not result.events
    assert abs(result["coin.z"][-1] - r * math.cos(end[0])) < 1e-9
    assert abs(result["coin.vz"][-1] + r * math.sin(end[0]) * end[1]) < 1e-9
    assert abs(result["coin.x"][-1] - 0.015) < 1e-10 and abs(result["coin.y"][-1] - 0.03) < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("shape", ["capsule", "box"])
def test_one_end_strikes(shape: str, seed: int, tmp_path: Path) -> None:
    """The impulse at the lowest corner, or at the lower end of a capsule, from mass and inertia."""
    draw = np.random.default_rng(seed)
    inertia, turn, e = np.array([0.03, 0.04, 0.05]), draw.uniform(-0.7, 0.7, 3), draw.uniform(0.2, 1.0)
    turned = Rotation.from_rotvec(turn).as_matrix()
    if shape == "box":
        edges, radius, words = np.array([0.2, 0.3, 0.4]), 0.0, "box = [0.2, 0.3, 0.4]"
        ends = [0.5 * edges * np.array([i, j, k]) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
    else:
        radius, words = 0.1, "axis = [0.0, 1.0, 1.0], capsule = [0.1, 0.6]"
        ends = [sign * 0.3 * np.array([0.0, 1.0, 1.0]) / math.sqrt(2.0) for sign in (-1.0, 1.0)]
    lever = min((turned @ end for end in ends), key=lambda end: float(end[2])) - radius * np.array([0.0, 0.0, 1.0])
    fall = 0.05
    up, speed = np.array([0.0, 0.0, 1.0]), math.sqrt(2.0 * G * fall)
    world = turned @ np.diag(1.0 / inertia) @ turned.T
    arm = np.cross(lever, up)
    impulse = (1.0 + e) * speed / (1.0 + arm @ world @ arm)
    text = head() + body("it", (0.0, 0.0, fall - lever[2]), (0.3, 0.0, 0.0), 1.0, inertia, turn=turn)
    text += contact(f'body = "it", {words}', PLANE, e)
    t = speed / G
    result = loaded(text, tmp_path).simulate(until=t + 1e-4, integrator="dop853", verify=False, rtol=1e-11)
    assert [event.name for event in result.events] == ["touch.hit"] and abs(result.events[0].t - t) < 1e-11
    rates = [result[f"it.{x}"][-1] for x in ("vx", "vy", "vz")]
    assert np.allclose(rates, [0.3, 0.0, impulse - speed - G * 1e-4], rtol=0.0, atol=1e-9)
    spun = np.array([result[f"it.{x}"][-1] for x in ("wx", "wy", "wz")])
    # gyroscopic torques act for 1e-4 s
    assert np.allclose(spun, turned.T @ world @ arm * impulse, rtol=0.0, atol=1e-3 * np.linalg.norm(spun))


@pytest.mark.slow
def test_a_box_comes_to_rest_on_four_corners(tmp_path: Path) -> None:
    text = (
        head() + body("die", (0.0, 0.0, 0.3), (0.3, 0.1, 0.0)) + contact('body = "die", box = [0.2, 0.3, 0.4]', PLANE)
    )
    result = loaded(text, tmp_path).simulate(until=1.0, integrator="dop853", verify=False)
    assert result.ok and abs(result["touch.force"][-1] - G) < 1e-9 and result["touch.mode"][-1] == 1.0
    assert abs(result["die.x"][-1] - 0.3) < 1e-12 and abs(result["die.z"][-1] - 0.2) < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("place", [-0.4, -0.2, 0.25, 0.38])
def test_a_ball_falls_on_a_capsule(place: float, tmp_path: Path) -> None:
    """On its cylinder or on an end, the nearest point of its axis decides."""
    axis = np.array([math.cos(0.3), 0.0, math.sin(0.3)])
    start = place * axis + np.array([0.0, 0.03, 0.5])

    def gap(t: float) -> tuple[float, np.ndarray]:
        centre = start - np.array([0.0, 0.0, G * t * t / 2.0])
        way = centre - np.clip(centre @ axis, -0.3, 0.3) * axis
        return float(np.linalg.norm(way)) - 0.18, way

    t = brentq(lambda t: gap(t)[0], 0.0, 0.32, xtol=1e-15)
    normal = gap(t)[1]
    normal /= np.linalg.norm(normal)
    velocity = np.array([0.0, 0.0, -G * t])
    velocity -= 1.6 * (velocity @ normal) * normal
    text = head() + body("ball", start)
    text += contact(BALL, f'body = "ground", axis = {listed(axis)}, capsule = [0.08, 0.6]', 0.6)
    result = loaded(text, tmp_path).simulate(until=t + 1e-3, integrator="dop853", verify=False, rtol=1e-11)
    assert [event.name for event in result.events] == ["touch.hit"] and abs(result.events[0].t - t) < 1e-11
    velocity[2] -= G * 1e-3
    assert np.allclose([result[f"ball.{x}"][-1] for x in ("vx", "vy", "vz")], velocity, rtol=0.0, atol=1e-10)


@pytest.mark.slow
def test_balls_lie_in_a_bowl_with_one_on_top(tmp_path: Path) -> None:
    """Three balls of a bowl are apart by the size of the fourth: forces by the angles of their centres."""
    r, hollow = 0.1, 0.5
    ring = 0.13  # of the three centres about the vertical
    depth, height = math.sqrt((hollow - r) ** 2 - ring**2), math.sqrt(4.0 * r * r - ring**2)
    text = head()
    for i in range(3):
        angle = 2.0 * math.pi * i / 3.0 + 0.4
        text += body(f"b{i}", (ring * math.cos(angle), ring * math.sin(angle), -depth), mass=0.5)
        text += contact(f'body = "b{i}", sphere = {r}', f'body = "ground", sphere = {-hollow}', name=f"bowl{i}")
        text += contact(f'body = "b{i}", sphere = {r}', f'body = "top", sphere = {r}', name=f"top{i}")
    text += body("top", (0.0, 0.0, height - depth), mass=2.0)
    result = loaded(text, tmp_path).simulate(until=1e-6, integrator="dop853", verify=False)
    # from rest: each of three moves on its sphere, the top downwards; their gaps stay 0 as long as they push
    out, down = np.array([1.0, 0.0]), np.array([0.0, -1.0])
    wall = np.array([-ring, depth]) / (hollow - r)  # pushes a ball inwards and up
    line = np.array([-ring, height]) / (2.0 * r)  # from a ball to the top
    # unknown: accelerations of a ball (x, z), of the top (z), force of the wall, force of the top
    matrix, right = np.zeros((5, 5)), np.zeros(5)
    for k, unit in enumerate((out, -down)):
        matrix[k, k], matrix[k, 3], matrix[k, 4] = 0.5, -(wall @ unit), line @ unit
        right[k] = -0.5 * G * (unit @ -down)
    matrix[2, 2], matrix[2, 4], right[2] = 2.0, -3.0 * line[1], -2.0 * G
    matrix[3, :2] = wall
    matrix[4, :2], matrix[4, 2] = -line, line[1]
    solved = np.linalg.solve(matrix, right)
    assert solved[3] > 0.0 and solved[4] > 0.0
    for i in range(3):
        assert (
            abs(result[f"bowl{i}.force"][0] - solved[3]) < 1e-9 and abs(result[f"top{i}.force"][0] - solved[4]) < 1e-9
        )


@pytest.mark.slow
def test_a_column_of_balls_carries_what_lies_above(tmp_path: Path) -> None:
    text, count = head(), 6
    for i in range(count):
        text += body(f"b{i}", (0.0, 0.0, 0.1 + 0.2 * i))
        below = PLANE if i == 0 else f'body = "b{i - 1}", sphere = 0.1'
        text += contact(f'body = "b{i}", sphere = 0.1', below, name=f"c{i}")
    result = loaded(text, tmp_path).simulate(until=0.5, integrator="dop853", verify=False)
    assert result.ok and not result.events
    assert np.allclose([result[f"c{i}.force"][-1] for i in range(count)], [(count - i) * G for i in range(count)])


@pytest.mark.slow
def test_the_command_runs_and_refuses(tmp_path: Path) -> None:
    path = tmp_path / "ball.toml"
    path.write_text(BOUNCE)
    command = [sys.executable, "-m", "symgen", "run", str(path), "--until", "3"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "touch.rest" in done.stdout
    path.write_text(f"{BOUNCE}friction = -0.3\n")
    refused = subprocess.run(command, capture_output=True, text=True, check=False)
    sentence = "contacts.touch.friction: expected a value of at least 0, got -0.3"
    assert refused.returncode == 2 and sentence in refused.stderr


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_ball_hangs_in_a_bowl_and_swings(coordinates: str, tmp_path: Path) -> None:
    """At its equilibrium the bowl carries it; its two frequencies are those of a pendulum, and its spins have none."""
    text = head() + body("ball", (0.0, 0.0, -0.4)) + contact(BALL, 'body = "ground", sphere = -0.5')
    model = loaded(text, tmp_path)
    squares = np.sort(model.modes(coordinates=coordinates).omega_squared)
    assert np.allclose(squares, [0.0, 0.0, 0.0, G / 0.4, G / 0.4], rtol=0.0, atol=1e-9)
