"""Feet and boxes that slide on a floor in space and come to rest, over 300 values each, beside codes of their own."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.ending import Ending

from tests.run.contacts.scenes import G, loaded
from tests.run.contacts.scenes_in_space import body, contact, head, listed
from tests.run.contacts.test_friction_in_space import FEET, FLOOR, in_bowl, last, planar_bowl, tripod

Array = np.ndarray
TIGHT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-14}
#: Mass, moment of inertia about the vertical, coefficient, and height of the centre times it.
MASS, TURNS, MU, LEVER = 2.0, 0.3, 0.4, 0.12


class Table:
    """The table on three feet in the plane of its floor: place and angle where its feet rest.

    The first foot below 1e-6 m/s rests from there on; where the others do not let it, it is off by 1e-7 at most.
    """

    def __init__(self, yaw: float) -> None:
        self.at = np.array(FEET)[:, :2]
        whole = solve_ivp(
            self.slides, (0.0, 3.0), [0.0, 0.0, 0.0, 0.9, 0.5, yaw], "DOP853", rtol=1e-12, atol=1e-14,
            events=[Ending(lambda t, z, i=i: float(np.hypot(*self.slips(z)[i])) - 1e-6) for i in range(3)],
        )  # fmt: skip
        z, self.foot = whole.y[:, -1], next(i for i, times in enumerate(whole.t_events) if len(times))
        self.x, self.y, self.angle = z[:3]
        if abs(z[5]) > 1e-5:  # it turns about the foot that rests, until it rests as a whole
            arm = self.arms(z[2])[self.foot]
            pivot = z[:2] + arm
            turn = solve_ivp(
                self.pivots, (0.0, 1.0), z[[2, 5]], "DOP853", rtol=1e-12, atol=1e-14,
                events=Ending(lambda t, x: x[1] * math.copysign(1.0, z[5])),
            )  # fmt: skip
            self.angle = float(turn.y[0, -1])
            self.x, self.y = pivot - self.arms(self.angle)[self.foot]

    def arms(self, angle: float) -> Array:
        """Return the feet from the centre."""
        c, s = math.cos(angle), math.sin(angle)
        return self.at @ np.array([[c, s], [-s, c]])

    def slips(self, z: Array) -> Array:
        """Return the velocities of the feet."""
        arms = self.arms(z[2])
        return np.asarray(z[3:5] + z[5] * np.column_stack([-arms[:, 1], arms[:, 0]]))

    def slides(self, _: float, z: Array) -> Array:
        """Return the rates while all feet slide: forces of sizes that balance weight and moments."""
        arms, slips = self.arms(z[2]), self.slips(z)
        ways = slips / np.linalg.norm(slips, axis=1)[:, None]
        columns = np.array([np.ones(3), arms[:, 1] - LEVER * ways[:, 1], arms[:, 0] - LEVER * ways[:, 0]])
        forces = -MU * np.linalg.solve(columns, [MASS * G, 0.0, 0.0])[:, None] * ways
        moment = float(np.sum(arms[:, 0] * forces[:, 1] - arms[:, 1] * forces[:, 0]))
        return np.array([*z[3:], *forces.sum(axis=0) / MASS, moment / TURNS])

    def pivots(self, _: float, x: Array) -> Array:
        """Return the rates while one foot rests: three forces upwards, two along the floor there, and the turning."""
        arms, rest = self.arms(x[0]), self.foot
        ways = math.copysign(1.0, x[1]) * np.column_stack([-(arms - arms[rest])[:, 1], (arms - arms[rest])[:, 0]])
        ways /= np.maximum(np.linalg.norm(ways, axis=1), 1e-300)[:, None]
        system, right = np.zeros((6, 6)), np.array([MASS * G, 0.0, 0.0, 0.0, 0.0, 0.0])
        system[0, :3] = 1.0
        system[1, :3], system[1, 4] = arms[:, 1] - LEVER * ways[:, 1], 0.3
        system[2, :3], system[2, 3] = arms[:, 0] - LEVER * ways[:, 0], 0.3
        # the centre turns about the foot: its acceleration is alpha e_z x r - omega^2 r with r from the foot
        r = -arms[rest]
        system[3, :3], system[3, 3], system[3, 5] = -MU * ways[:, 0], 1.0, MASS * r[1]
        system[4, :3], system[4, 4], system[4, 5] = -MU * ways[:, 1], 1.0, -MASS * r[0]
        right[3:5] = -MASS * x[1] ** 2 * r
        system[5, :3] = -MU * (arms[:, 0] * ways[:, 1] - arms[:, 1] * ways[:, 0])
        system[5, 3:] = -arms[rest][1], arms[rest][0], -TURNS
        found = np.linalg.solve(system, right)
        return np.array([x[1], found[5]])


@pytest.mark.slow
def test_three_hundred_yaws_of_a_table(tmp_path: Path) -> None:
    """Feet come to rest one after the other; sixty tables are their planar equations, places change smoothly."""
    text = tripod((0.0, 0.0, -G), (0.9, 0.5, 0.0)).replace(
        "angular_velocity = [0.0, 0.0, 0.0]", 'angular_velocity = [0.0, 0.0, "yaw"]'
    )
    model = loaded(text.replace("[bodies", "[parameters]\nyaw = 4.0\n[bodies", 1), tmp_path)
    values = np.linspace(-6.0, 6.0, 300)
    table = model.sweep(vary={"yaw": values}, until=1.5, **TIGHT).to_dataframe()
    assert (table["status"] == "ok").all()
    places = table[["table.x", "table.y"]].to_numpy()
    angles = 2.0 * np.unwrap(np.arctan2(table["table.e3"], table["table.e0"]), period=math.pi)
    angles -= angles[150] - Table(float(values[150])).angle
    assert np.abs(np.diff(places, 2, axis=0)).max() < 1e-3
    for i in range(0, 300, 5):
        own = Table(float(values[i]))
        assert np.abs(places[i] - [own.x, own.y]).max() < 5e-8, values[i]
        assert abs(math.remainder(angles[i] - own.angle, 2.0 * math.pi)) < 2e-7, values[i]


@pytest.mark.slow
def test_a_ball_rolls_in_a_bowl_for_twenty_seconds(tmp_path: Path) -> None:
    place = 0.9 * np.array([math.sin(0.6) * math.cos(0.7), math.sin(0.6) * math.sin(0.7), -math.cos(0.6)])
    result = loaded(in_bowl(place, (0.0, 0.0, 0.0), 0.5), tmp_path).simulate(until=20.0, verify=False, **TIGHT)
    angle, times = planar_bowl(0.6, 0.5, 20.0)
    wanted = 0.9 * np.array([math.sin(angle) * math.cos(0.7), math.sin(angle) * math.sin(0.7), -math.cos(angle)])
    assert result.ok and not result.events and not times
    assert np.abs(last(result, "ball") - wanted).max() < 1e-11


def pushed_box(size: tuple[float, float, float], mu: float) -> str:
    """Return a box that slides along one of its sides, which is not along an axis of the floor."""
    a, b, c = size
    inertia = [1.5 * x / 12.0 for x in (b * b + c * c, a * a + c * c, a * a + b * b)]
    text = body("box", (0.0, 0.0, 0.5 * c), (0.0, 0.0, 0.0), 1.5, inertia, turn=(0.0, 0.0, 0.3))
    way = f'["{math.cos(0.3)!r}*v", "{math.sin(0.3)!r}*v", 0.0]'
    text = text.replace("velocity = [0.0, 0.0, 0.0]", f"velocity = {way}", 1)
    box = contact(f'body = "box", box = {listed(size)}', FLOOR, friction=mu)
    return head() + "[parameters]\nv = 1.0\n" + text + box


@pytest.mark.slow
def test_three_hundred_pushes_of_a_box(tmp_path: Path) -> None:
    """A flat box slides on four corners and stays where its speed is gone, v^2 / (2 mu g) further."""
    model, values = loaded(pushed_box((0.4, 0.3, 0.2), 0.3), tmp_path), np.linspace(0.05, 2.5, 300)
    table = model.sweep(vary={"v": values}, until=1.0, **TIGHT).to_dataframe()
    assert (table["status"] == "ok").all()
    way = values**2 / (2.0 * 0.3 * G)
    for name, wanted in (("box.x", math.cos(0.3) * way), ("box.y", math.sin(0.3) * way), ("box.z", 0.1 + 0.0 * way)):
        assert np.abs(table[name] - wanted).max() < 1e-8


@pytest.mark.slow
@pytest.mark.parametrize("v", [1.0, 1.5])
def test_a_tall_box_tips(v: float, tmp_path: Path) -> None:
    """It stops on its edge, tips back or over, and its energy never grows."""
    result = loaded(pushed_box((0.2, 0.3, 0.4), 0.7), tmp_path).simulate(
        until=1.2, parameters={"v": v}, times=np.linspace(0.0, 1.2, 601).tolist(), verify=False, **TIGHT
    )
    speeds = sum(result[f"box.{x}"] ** 2 for x in ("vx", "vy", "vz"))
    inertia = {"wx": 1.5 * 0.25 / 12.0, "wy": 1.5 * 0.2 / 12.0, "wz": 1.5 * 0.13 / 12.0}
    energy = (
        0.75 * speeds + 1.5 * G * result["box.z"] + sum(0.5 * i * result[f"box.{w}"] ** 2 for w, i in inertia.items())
    )
    assert result.ok and np.diff(energy).max() < 1e-9
    assert abs(result["box.z"][-1] - (0.1 if v > 1.2 else 0.2)) < 1e-2
