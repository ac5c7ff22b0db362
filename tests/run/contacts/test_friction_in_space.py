"""Friction of contacts in space: slip and rolling, starts of slip, impacts, feet, beside closed forms."""

import math
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from support.ending import Ending

from symgen import InputError
from symgen.result.result import Result
from tests.run.contacts.scenes import G, loaded
from tests.run.contacts.scenes_in_space import ball_of, body, contact, head, listed

Array = np.ndarray
FLOOR = 'plane = "ground"'
EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-14, "verify": False}


def last(result: Result, name: str, keys: str = "x y z") -> Array:
    """Return the last values of some quantities of a body."""
    return np.array([result[f"{name}.{key}"][-1] for key in keys.split()])


def slider(mu: object = 0.21, velocity: Any = (2.0, 0.7, 0.0), omega: Any = (5.0, 9.0, 30.0)) -> str:
    """Return a ball that slides on the floor."""
    ball = ball_of(0.2, (0.0, 0.0, 0.2), velocity, 1.3, omega=omega)
    return head() + ball + contact('body = "ball", sphere = 0.2', FLOOR, friction=mu)


def rolled(mu: float, velocity: Any, omega: Any, until: float) -> tuple[float, Array, Array]:
    """Return when the ball of `slider` begins to roll, and its velocity and place after that."""
    v, u = np.array(velocity), np.array(velocity) + np.cross(omega, [0.0, 0.0, -0.2])
    time = float(np.linalg.norm(u) / (3.5 * mu * G))
    pull = -mu * G * u / np.linalg.norm(u)
    rolling = v + pull * time
    return time, rolling, v * time + 0.5 * pull * time**2 + rolling * (until - time)


WAYS = {
    "dop853": ("absolute", {"integrator": "dop853", "rtol": 1e-12}, 1e-9),
    "joint": ("joint", {"integrator": "dop853", "rtol": 1e-12}, 1e-9),
    "picard": ("absolute", {"integrator": "picard", "rtol": 1e-11}, 1e-9),
    "radau5": ("absolute", {"integrator": "radau5", "rtol": 1e-10}, 1e-9),
    "rk4": ("absolute", {"integrator": "rk4", "step": 1e-3}, 4e-4),
}


@pytest.mark.slow
@pytest.mark.by_turns(5)
@pytest.mark.parametrize("way", WAYS)
def test_a_ball_with_spin_slides_and_rolls(way: str, tmp_path: Path) -> None:
    """Explicit constant steps err where slip ends, by up to 4e-4 s: its direction has no derivative there."""
    coordinates, settings, most = WAYS[way]
    result = loaded(slider(), tmp_path).simulate(until=1.2, coordinates=coordinates, verify=False, **settings)
    time, velocity, place = rolled(0.21, (2.0, 0.7, 0.0), (5.0, 9.0, 30.0), 1.2)
    (stick,) = result.events
    assert result.ok and stick.name == "touch.stick" and abs(stick.t - time) < most
    assert np.abs(last(result, "ball", "vx vy vz") - velocity).max() < most
    assert np.abs(last(result, "ball", "x y") - place[:2]).max() < most
    weight = 1.3 * G
    assert abs(result["touch.force"][-1] - weight) < 1e-9 and abs(result["touch.friction"][0] - 0.21 * weight) < 1e-9
    assert result["touch.mode"][0] == 2.0 and result["touch.mode"][-1] == 1.0 and result["touch.slip"][-1] < 1e-9
    assert "other motions" not in " ".join(result.notes)


@pytest.mark.slow
def test_spins_swept(tmp_path: Path) -> None:
    """Three hundred spins: each ball rolls when its closed form does, and rows are single runs."""
    text = slider().replace("angular_velocity = [5.0, 9.0, 30.0]", 'angular_velocity = [5.0, "spin", 30.0]')
    model = loaded("[parameters]\nspin = 9.0\n" + text, tmp_path)
    values = np.linspace(-40.0, 40.0, 300)
    settings: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-14, "until": 3.0}
    table = model.sweep(vary={"spin": values}, **settings).to_dataframe()
    columns = ["ball.vx", "ball.vy", "ball.x", "ball.y"]
    for spin, found in zip(values, table[columns].to_numpy(), strict=True):
        _, velocity, place = rolled(0.21, (2.0, 0.7, 0.0), (5.0, spin, 30.0), 3.0)
        assert np.abs(found - [*velocity[:2], *place[:2]]).max() < 1e-10
    single = [model.simulate(parameters={"spin": float(x)}, verify=False, **settings) for x in values[::100]]
    assert table[columns].to_numpy()[::100].tolist() == [[r[c][-1] for c in columns] for r in single]


@pytest.mark.slow
def test_a_ball_slips_across_a_slope_and_rolls(tmp_path: Path) -> None:
    """The momentum along the slope says when: ``u' = b e - c u / |u|``; the plane is turned, or gravity is."""
    angle, mu, r = 0.35, 0.2, 0.2
    b, c = G * math.sin(angle), 3.5 * mu * G * math.cos(angle)
    u = np.array([-1.0, 1.5])
    time = (c * float(np.hypot(*u)) + b * u[0]) / (c * c - b * b)
    end = u - u / 3.5 + np.array([b * (1.0 - 1.0 / 3.5) * time + 5.0 / 7.0 * b * (3.0 - time), 0.0])
    leaned = head((b, 0.0, -G * math.cos(angle))) + ball_of(r, (0.0, 0.0, r), (-1.0, 1.5, 0.0), 1.3)
    leaned += contact(f'body = "ball", sphere = {r}', FLOOR, friction=mu)
    turn = Rotation.from_euler("y", angle)
    normal = turn.apply([0.0, 0.0, 1.0])
    turned = head() + ball_of(r, r * normal, turn.apply([-1.0, 1.5, 0.0]), 1.3)
    turned += contact(f'body = "ball", sphere = {r}', f"{FLOOR}, normal = {listed(normal)}", friction=mu)
    for text, back in ((leaned, Rotation.identity()), (turned, turn.inv())):
        result = loaded(text, tmp_path).simulate(until=3.0, **EXACT)
        (stick,) = result.events
        assert result.ok and stick.name == "touch.stick" and abs(stick.t - time) < 1e-9
        assert np.abs(back.apply(last(result, "ball", "vx vy vz")) - [*end, 0.0]).max() < 2e-9


@pytest.mark.slow
def test_slopes_swept_through_the_angle_of_friction(tmp_path: Path) -> None:
    """A block on a point at rest stays where friction holds it; else it slides as its closed form does."""
    text = head((3.0 * 0.6, 3.0 * 0.8, -4.0)) + "[parameters]\nmu = 0.75\n"
    text += body("block", (0.0, 0.0, 0.0)) + contact('body = "block"', FLOOR, friction='"mu"')
    values = np.linspace(0.5, 1.0, 300)
    table = loaded(text, tmp_path).sweep(vary={"mu": values}, integrator="dop853", until=1.0).to_dataframe()
    wanted = np.maximum(3.0 - 4.0 * values, 0.0) / 2.0
    assert (table["status"] == "ok").all()
    for name, part in (("block.x", 0.6), ("block.y", 0.8)):
        assert np.abs(table[name] - part * wanted).max() < 1e-9


def in_bowl(place: Any, velocity: Any, mu: float, omega: Any = (0.0, 0.0, 0.0)) -> str:
    """Return a ball of 0.1 m in a bowl of 1 m."""
    text = head() + ball_of(0.1, place, velocity, omega=omega)
    return text + contact('body = "ball", sphere = 0.1', 'body = "ground", sphere = -1.0', friction=mu)


def planar_bowl(angle: float, mu: float, until: float) -> tuple[float, list[float]]:
    """Return the angle of a ball in a bowl that starts at rest, and when it begins to roll and to slip in turn.

    Angle, its rate and the speed r omega; it slips at ``L rate + r omega``.
    """
    length, z, t, times = 0.9, np.array([angle, 0.0, 0.0]), 0.0, list[float]()
    way = 0.0 if 2.0 / 7.0 * math.tan(angle) < mu else -1.0

    def force(z: Array) -> float:
        return float(G * math.cos(z[0]) + length * z[1] ** 2)

    def rates(_: float, z: Array, way: float, begins: float) -> list[float]:
        if way == 0.0:
            return [z[1], -5.0 / 7.0 * G / length * math.sin(z[0]), 0.0]
        return [z[1], (-G * math.sin(z[0]) - way * mu * force(z)) / length, -2.5 * way * mu * force(z)]

    def ends(t: float, z: Array, way: float, begins: float) -> float:
        if way == 0.0:
            return mu * force(z) - 2.0 / 7.0 * G * abs(math.sin(z[0]))
        return float(way * (length * z[1] + z[2]) + (1e-12 if t < begins + 1e-6 else 0.0))

    while True:
        given: dict[str, Any] = {"args": (way, t), "events": Ending(ends, -1.0)}
        run = solve_ivp(rates, (t, until), z, method="DOP853", rtol=1e-13, atol=1e-15, **given)
        t, z = run.t[-1], run.y[:, -1]
        if run.status == 0:
            return float(z[0]), times
        times.append(float(t))
        z[2] = -length * z[1]
        held = 2.0 / 7.0 * abs(math.sin(z[0])) * G <= mu * force(z)
        way = -float(np.sign(math.sin(z[0]))) if way == 0.0 or not held else 0.0


@pytest.mark.slow
@pytest.mark.parametrize(("mu", "most"), [(0.5, 1e-10), (0.15, 2e-8)])
def test_a_ball_rolls_and_slips_in_a_bowl(mu: float, most: float, tmp_path: Path) -> None:
    """Beside a run in its plane; starts of slip, of which there are two, err by the velocity that leads them."""
    place = 0.9 * np.array([math.sin(0.6) * math.cos(0.7), math.sin(0.6) * math.sin(0.7), -math.cos(0.6)])
    result = loaded(in_bowl(place, (0.0, 0.0, 0.0), mu), tmp_path).simulate(until=3.0, **EXACT)
    angle, times = planar_bowl(0.6, mu, 3.0)
    wanted = 0.9 * np.array([math.sin(angle) * math.cos(0.7), math.sin(angle) * math.sin(0.7), -math.cos(angle)])
    assert result.ok and np.abs(last(result, "ball") - wanted).max() < most
    assert [event.name for event in result.events] == ["touch.stick", "touch.slip"] * (len(times) // 2) + [
        "touch.stick"
    ] * (len(times) % 2)
    assert np.allclose([event.t for event in result.events], times, rtol=0.0, atol=most)


@pytest.mark.slow
def test_a_spinning_ball_in_a_bowl_does_not_know_directions(tmp_path: Path) -> None:
    """It slips across and sticks; turned by 1.1 rad it is the same."""
    ends = list[Array]()
    for turned in (0.0, 1.1):
        turn = Rotation.from_euler("z", turned)
        place = turn.apply([0.9 * math.sin(0.6), 0.0, -0.9 * math.cos(0.6)])
        text = in_bowl(place, turn.apply([0.0, 1.3, 0.0]), 0.12, (0.0, 0.0, 8.0))
        result = loaded(text, tmp_path).simulate(until=2.0, **EXACT)
        assert result.ok and [event.name for event in result.events] == ["touch.stick"]
        back = turn.inv()
        velocity = back.apply(last(result, "ball", "vx vy vz"))
        ends.append(np.array([*back.apply(last(result, "ball")), *velocity, result.events[0].t]))
    assert np.abs(ends[0] - ends[1]).max() < 1e-10


FEET = [(0.5, 0.0, -0.3), (-0.25, 0.45, -0.3), (-0.25, -0.45, -0.3)]


def tripod(gravity: Any, velocity: Any, omega: Any = (0.0, 0.0, 0.0)) -> str:
    """Return a table on three points."""
    text = head(gravity) + body("table", (0.0, 0.0, 0.3), velocity, 2.0, (0.2, 0.25, 0.3), omega=omega)
    feet = (contact(f'body = "table", at = {listed(at)}', FLOOR, 0.0, f"foot{i}", 0.4) for i, at in enumerate(FEET))
    return text + "".join(feet)


@pytest.mark.slow
def test_a_table_on_three_feet_stops_on_a_slope(tmp_path: Path) -> None:
    text = tripod((G * math.sin(0.2), 0.0, -G * math.cos(0.2)), (1.7, 0.0, 0.0))
    result = loaded(text, tmp_path).simulate(until=2.0, **EXACT)
    slows = G * (0.4 * math.cos(0.2) - math.sin(0.2))
    assert result.ok and [event.name for event in result.events] == [f"foot{i}.stick" for i in range(3)]
    assert max(abs(event.t - 1.7 / slows) for event in result.events) < 1e-9
    assert abs(result["table.x"][-1] - 1.7**2 / 2.0 / slows) < 1e-10
    assert np.abs(last(result, "table", "vx vy vz wx wy wz")).max() < 1e-14
    assert sum(result[f"foot{i}.force"][-1] for i in range(3)) == pytest.approx(2.0 * G * math.cos(0.2), rel=1e-12)
    assert "forces of contacts are not unique" in " ".join(result.notes)


@pytest.mark.slow
def test_a_table_that_turns_comes_to_rest_foot_by_foot(tmp_path: Path) -> None:
    """Beside its planar equations: three forces of known sizes against the velocities of the feet."""
    result = loaded(tripod((0.0, 0.0, -G), (0.9, 0.5, 0.0), (0.0, 0.0, 4.0)), tmp_path).simulate(until=1.0, **EXACT)
    at = np.array(FEET)[:, :2]

    def rates(_: float, z: Array) -> Array:
        c, s = math.cos(z[2]), math.sin(z[2])
        arms = at @ np.array([[c, s], [-s, c]])
        slips = z[3:5] + z[5] * np.column_stack([-arms[:, 1], arms[:, 0]])
        ways = slips / np.linalg.norm(slips, axis=1)[:, None]
        # forces N of the feet: their sum, and no moment about horizontal axes, of which friction has an arm of 0.3 m
        columns = np.array([np.ones(3), arms[:, 1] - 0.12 * ways[:, 1], arms[:, 0] - 0.12 * ways[:, 0]])
        pressed = np.linalg.solve(columns, [2.0 * G, 0.0, 0.0])
        forces = -0.4 * pressed[:, None] * ways
        moment = float(np.sum(arms[:, 0] * forces[:, 1] - arms[:, 1] * forces[:, 0]))
        return np.array([*z[3:], *forces.sum(axis=0) / 2.0, moment / 0.3])

    def stops(_: float, z: Array) -> float:
        c, s = math.cos(z[2]), math.sin(z[2])
        arm = np.array([[c, -s], [s, c]]) @ at[0]
        return float(np.hypot(z[3] - z[5] * arm[1], z[4] + z[5] * arm[0])) - 1e-6

    run = solve_ivp(
        rates, (0.0, 1.0), [0.0, 0.0, 0.0, 0.9, 0.5, 4.0], "DOP853", rtol=1e-12, atol=1e-14, events=Ending(stops)
    )
    assert result.ok and [event.name for event in result.events] == [f"foot{i}.stick" for i in range(3)]
    first, *others = (event.t for event in result.events)
    assert abs(first - run.t[-1]) < 1e-6 and 1e-5 < others[0] - first < 3e-5
    assert np.abs(last(result, "table", "x y") - run.y[:2, -1]).max() < 1e-8
    assert np.abs(last(result, "table", "vx vy vz wx wy wz")).max() < 1e-14


LEGS = {
    "sticks": ((0.3, 0.0, -1.5), (0.0, 0.0, 0.0), 0.8, 0.0, ["hit", "rest"], 1e-12),
    "slips": ((2.0, 0.0, -1.5), (0.0, 0.0, 0.0), 0.2, 0.0, ["hit", "rest", "slip"], 1e-10),
    "flies": ((1.0, 0.6, -1.5), (1.0, -2.0, 3.0), 0.3, 0.2, ["hit"] * 9 + ["rest", "stick", "slip"], 1e-9),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", LEGS)
def test_a_leg_strikes_a_floor_and_does_not_know_directions(name: str, tmp_path: Path) -> None:
    """Turned by 0.9 rad about the vertical it is the same; in its plane a leg of a file in the plane is the same."""
    velocity, omega, mu, e, words, most = LEGS[name]
    inertia, foot, ends = 2.0 * 0.8**2 / 12.0, [0.0, 0.0, -0.4], list[Array]()
    for turned in (0.0, 0.9):
        turn = Rotation.from_euler("z", turned)
        way = turn * Rotation.from_euler("y", 0.3)
        height = 0.07 - way.apply(foot)[2]
        text = head() + body(
            "leg", (0.0, 0.0, height), turn.apply(velocity), 2.0, (inertia, inertia, 0.002),
            turn=way.as_rotvec(), omega=way.inv().apply(turn.apply(omega)),
        )  # fmt: skip
        text += contact(f'body = "leg", at = {listed(foot)}, sphere = 0.05', FLOOR, e, friction=mu)
        result = loaded(text, tmp_path).simulate(until=0.25, **EXACT)
        assert result.ok and [event.name for event in result.events] == [f"touch.{word}" for word in words]
        back = turn.inv()
        ends.append(np.array([back.apply(last(result, "leg")), back.apply(last(result, "leg", "vx vy vz"))]))
    assert np.abs(ends[0] - ends[1]).max() < most
    if velocity[1] == 0.0:  # the third axis of the plane is the second one of space, turned about
        text = f'[mechanism]\nname = "leg"\ngravity = [0.0, {-G}]\n[bodies.leg]\nmass = 2.0\ninertia = {inertia!r}\n'
        text += f"position = [0.0, {float(height)!r}]\nangle = -0.3\nvelocity = [{velocity[0]}, {velocity[2]}]\n"
        text += '[contacts.touch]\nbetween = [{ body = "leg", at = [0.0, -0.4], disc = 0.05 }, { line = "ground" }]'
        planar = loaded(text + f"\nrestitution = {e}\nfriction = {mu}\n", tmp_path).simulate(until=0.25, **EXACT)
        assert [event.name for event in planar.events] == [f"touch.{word}" for word in words]
        own = [last(planar, "leg", "x y"), last(planar, "leg", "vx vy")]
        assert np.abs(ends[0][:, [0, 2]] - own).max() < 1e-8


@pytest.mark.slow
def test_heights_of_a_leg_swept(tmp_path: Path) -> None:
    """Three hundred heights: none fails, and ends change smoothly between those at which what happens is another."""
    inertia, turn = 2.0 * 0.8**2 / 12.0, Rotation.from_euler("y", 0.3)
    text = body("leg", (0.0, 0.0, 0.0), (1.0, 0.6, -1.5), 2.0, (inertia, inertia, 0.002), turn=turn.as_rotvec())
    text = (
        head()
        + "[parameters]\nheight = 0.5\n"
        + text.replace("position = [0.0, 0.0, 0.0]", 'position = [0.0, 0.0, "height"]')
    )
    text += contact('body = "leg", at = [0.0, 0.0, -0.4], sphere = 0.05', FLOOR, 0.0, friction=0.3)
    values = np.linspace(0.44, 0.6, 300)
    table = loaded(text, tmp_path).sweep(vary={"height": values}, integrator="dop853", until=0.25).to_dataframe()
    assert (table["status"] == "ok").all()
    x = table["leg.x"].to_numpy()
    assert max(abs(a - 2.0 * b + c) for a, b, c in zip(x, x[1:], x[2:], strict=False)) < 1e-4
    assert max(abs(b - a) for a, b in pairwise(x)) < 2e-3


@pytest.mark.slow
@pytest.mark.parametrize(("mu", "e"), [(0.2, 0.6), (0.02, 0.6), (0.5, 0.0)])
def test_two_balls_strike_with_spin(mu: float, e: float, tmp_path: Path) -> None:
    """The impulse along both surfaces is the friction, or what takes all slip."""
    r, centre = 0.1, 0.2 * np.array([math.cos(0.3), math.sin(0.3), 0.0])
    place, v, w = np.array([-0.3, -0.05, -0.02]), np.array([3.0, 0.5, 0.2]), np.array([5.0, -8.0, 20.0])
    text = head((0.0, 0.0, 0.0)) + ball_of(r, place, v, 1.0, omega=w) + ball_of(r, centre, mass=1.5, name="other")
    text += contact(f'body = "ball", sphere = {r}', f'body = "other", sphere = {r}', e, friction=mu)
    result = loaded(text, tmp_path).simulate(until=0.15, **EXACT)
    hit = result.events[0]
    n = (place + v * hit.t - centre) / np.linalg.norm(place + v * hit.t - centre)
    u, mobility = v + np.cross(w, -r * n), 1.0 + 1.0 / 1.5
    slip = u - (u @ n) * n
    push = -(1.0 + e) * (u @ n) / mobility
    along = min(mu * push, float(np.linalg.norm(slip)) / (3.5 * mobility))
    impulse = push * n - along * slip / np.linalg.norm(slip)
    assert hit.name == "touch.hit" and np.abs(last(result, "ball", "vx vy vz") - v - impulse).max() < 1e-11
    assert np.abs(last(result, "other", "vx vy vz") + impulse / 1.5).max() < 1e-11
    turned = np.cross(-r * n, impulse) / (0.4 * r**2)
    assert (
        np.abs(last(result, "ball", "wx wy wz") @ last(result, "ball", "wx wy wz") - (w + turned) @ (w + turned)) < 1e-9
    )


@pytest.mark.slow
def test_a_ball_leaves_a_ball_where_its_closed_form_does(tmp_path: Path) -> None:
    """It rolls until 17 cos of the angle is 10 cos of that at the start; a little before it slips."""
    angle, length = 0.2, 1.1
    place = length * np.array([math.sin(angle) * math.cos(0.4), math.sin(angle) * math.sin(0.4), math.cos(angle)])
    text = head() + ball_of(0.1, place)
    text += contact('body = "ball", sphere = 0.1', 'body = "ground", sphere = 1.0', friction=1e5)
    result = loaded(text, tmp_path).simulate(until=1.0, **EXACT)
    leaves = math.acos(10.0 / 17.0 * math.cos(angle))
    run = solve_ivp(
        lambda t, z: [z[1], 5.0 / 7.0 * G / length * math.sin(z[0])], (0.0, 2.0), [angle, 0.0], "DOP853",
        rtol=1e-12, atol=1e-14, events=lambda t, z: z[0] - leaves,
    )  # fmt: skip
    assert result.ok and [event.name for event in result.events] == ["touch.slip", "touch.lift"]
    assert abs(result.events[-1].t - float(run.t_events[0][0])) < 2e-7


def test_what_friction_in_space_has_not_is_said(tmp_path: Path) -> None:
    text = slider()
    model = loaded(text, tmp_path)
    with pytest.raises(
        InputError, match="expected a mechanism without friction of contacts in space, got that of touch"
    ):
        model.inverse()
    capsule = 'body = "pill", capsule = [0.1, 0.3]'
    scenes = {
        "poisson": (text.replace("gravity", 'restitution_law = "poisson"\ngravity'), '"newton" beside friction'),
        "capsule": (
            head() + body("pill", (0.0,) * 3) + contact(capsule, 'body = "ground", sphere = 0.2', friction=0.3),
            "a capsule beside a sphere, which have no friction in space",
        ),
        "negative": (slider(-0.1), "a value of at least 0"),
    }
    for wrong, sentence in scenes.values():
        with pytest.raises(InputError, match=sentence):
            loaded(wrong, tmp_path)
    with pytest.raises(InputError, match="straight code where a file has slip of contacts in space"):
        model.simulate(shape="looped")


@pytest.mark.slow
def test_commands_run_and_refuse_it(tmp_path: Path) -> None:
    """In processes of their own: a run and one with two values, and an analysis that has no such rows."""
    (tmp_path / "ball.toml").write_text("[parameters]\nmu = 0.21\n" + slider('"mu"'))

    def done(*words: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "symgen", *words]
        return subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)

    run = done("run", "ball.toml", "--until", "1.2")
    time, *_ = rolled(0.21, (2.0, 0.7, 0.0), (5.0, 9.0, 30.0), 1.2)
    assert run.returncode == 0 and "touch.stick" in run.stdout and f"{time:.3f}"[:-1] in run.stdout
    rows = done("sweep", "ball.toml", "--vary", "mu=values(0.21, 0.3)", "--until", "1.2", "--output", "rows.csv")
    assert rows.returncode == 0 and len((tmp_path / "rows.csv").read_text().splitlines()) == 3
    refused = done("equilibrium", "ball.toml")
    assert refused.returncode == 2 and "closed contacts at rest, got touch, which slides at" in refused.stderr
