"""A wheel with a motor on ground of many arcs, beside one smooth curve by SciPy."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from support.ending import Ending

from benchmarks.mechanisms.toml import text as toml
from tests.run.contacts.scenes import G, loaded

Array = NDArray[np.float64]

#: Radius, inertia, friction and speed at the start of a wheel of 1 kg; height and wave number of the ground's slope.
R, INERTIA, MU, SPEED = 0.1, 0.005, 0.3, 0.5
SLOPE, WAVES = 0.2, 2.0 * math.pi
UNTIL, PULSE = 0.6, 8.0


def ground(pieces: int) -> list[Any]:
    """Return arcs that are tangent to each other, with the curve's slope SLOPE sin(WAVES s) at their ends."""
    s = np.linspace(-0.5, 1.0, pieces + 1)
    slope = SLOPE * np.sin(WAVES * s)
    turn, middle = np.diff(slope), 0.5 * (slope[1:] + slope[:-1])
    steps = (s[1] - s[0]) * np.sinc(turn / (2.0 * math.pi)) * np.exp(1j * middle)
    nodes = np.concatenate([[0.0], np.cumsum(steps)])
    nodes -= nodes[pieces // 3]
    arcs = [
        {"to": [p.real, p.imag], "bulge": b}
        for p, b in zip(nodes[1:].tolist(), np.tan(turn / 4.0).tolist(), strict=True)
    ]
    return [[float(nodes[0].real), float(nodes[0].imag)], *arcs]


def wheel(pieces: int) -> str:
    """Return a wheel that rolls at the start, with a motor whose torque is a pulse."""
    return toml(
        {
            "mechanism": {"name": "wheel", "gravity": [0.0, -G]},
            "parameters": {"torque": 0.5},
            "bodies": {
                "wheel": {
                    **{"mass": 1.0, "inertia": INERTIA, "position": [0.0, R]},
                    **{"velocity": [SPEED, 0.0], "angular_velocity": -SPEED / R},
                }
            },
            "forces": {"motor": {"type": "torque", "body": "wheel", "torque": f"-torque*cos({PULSE}*t)"}},
            "outlines": {"road": {"body": "ground", "points": ground(pieces)}},
            "contacts": {
                "touch": {"between": [{"body": "wheel", "disc": R}, {"outline": "road"}], "friction": MU},
            },
        }
    )


def smooth(torque: float) -> tuple[Array, list[str]]:
    """Return place and angle of the wheel on the smooth curve at the end, and what happens on the way.

    A state is the way on the ground, the speed of the centre, the rate and angle of rolling, and the point of touch.
    """

    def forces(t: float, y: Array) -> tuple[float, float, float]:
        slope, bend = SLOPE * math.sin(WAVES * y[0]), SLOPE * WAVES * math.cos(WAVES * y[0])
        normal = G * math.cos(slope) + bend * y[1] ** 2 / (1.0 - R * bend)
        drive = torque * math.cos(PULSE * t)
        return normal, (R * drive / INERTIA + G * math.sin(slope)) / (1.0 + R**2 / INERTIA), drive

    def rates(t: float, y: Array, sense: float) -> list[float]:
        normal, held, drive = forces(t, y)
        push = sense * MU * normal if sense else held
        slope, bend = SLOPE * math.sin(WAVES * y[0]), SLOPE * WAVES * math.cos(WAVES * y[0])
        way = y[1] / (1.0 - R * bend)
        spin = (drive - R * push) / INERTIA
        return [way, push - G * math.sin(slope), spin, y[2], way * math.cos(slope), way * math.sin(slope)]

    def breaks(t: float, y: Array, sense: float) -> float:
        normal, held, _ = forces(t, y)
        return MU * normal - abs(held)

    def catches(t: float, y: Array, sense: float) -> float:
        return sense * (R * y[2] - y[1])

    last, t, y, sense, log = -1.0, 0.0, np.array([0.0, SPEED, SPEED / R, 0.0, 0.0, 0.0]), 0.0, list[str]()
    while True:
        normal, held, _ = forces(t, y)
        if not sense and abs(held) >= MU * normal * (1.0 - 1e-12):
            sense = math.copysign(1.0, held)
            if log and t == last:
                log[-1] = "reverse"
            elif t > 0.0:
                log.append("slip")
        event = Ending(catches if sense else breaks, -1.0)
        part = solve_ivp(rates, (t, UNTIL), y, "DOP853", events=event, args=(sense,), rtol=1e-11, atol=1e-13)
        assert part.success
        t, y = float(part.t[-1]), part.y[:, -1]
        assert forces(t, y)[0] > 0.0
        if part.status == 0:
            slope = SLOPE * math.sin(WAVES * y[0])
            return np.array([y[4] - R * math.sin(slope), y[5] + R * math.cos(slope), -y[3]]), log
        if sense:
            y[2], sense = y[1] / R, 0.0
            last = t
            log.append("stick")


@pytest.mark.slow
def test_three_hundred_torques_on_ground_of_arcs(tmp_path: Path) -> None:
    """Differences from one smooth curve fall with the square of the arcs' length, while it rolls and while it slips."""
    torques = np.linspace(0.0, 1.2, 300)
    expected = [smooth(float(torque)) for torque in torques]
    kinds = {tuple(log) for _, log in expected}
    assert {(), ("stick",), ("reverse",)} < kinds, kinds
    errors = list[float]()
    for pieces in (30, 60, 120):
        model = loaded(wheel(pieces), tmp_path)
        settings = {"integrator": "dop853", "rtol": 1e-10, "until": UNTIL}
        table = model.sweep(vary={"torque": torques}, **settings).to_dataframe()
        assert set(table["status"]) == {"ok"}
        keys = [next(k for k in table.columns if k.startswith(f"wheel.{name}")) for name in ("x", "y", "theta")]
        ends = table[keys].to_numpy() * [1.0, 1.0, R]
        errors.append(float(np.abs(ends - np.array([end for end, _ in expected]) * [1.0, 1.0, R]).max()))
        run = model.simulate(parameters={"torque": float(torques[-1])}, **settings)
        assert [event.name for event in run.events] == [f"touch.{name}" for name in expected[-1][1]]
    assert errors[0] < 5e-3
    assert 3.0 < errors[0] / errors[1] < 5.0 and 3.0 < errors[1] / errors[2] < 5.0, errors
