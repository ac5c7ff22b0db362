"""A light ring between two sliding frictions and a gear: it is solved as the ring without inertia is."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

SHIFT = """
[mechanism]
name = "gearshift"
[parameters]
ring = 1e-9
[bodies.engine]
mass = 1.0
inertia = 1.0
angular_velocity = 0.0
[bodies.ring]
mass = 1.0
inertia = "ring"
angular_velocity = 0.0
[bodies.load]
mass = 1.0
inertia = 10.0
[joints.e]
type = "revolute"
between = ["ground", "engine"]
at = [[0, 0], [0, 0]]
[joints.l]
type = "revolute"
between = ["ground", "load"]
at = [[0, 0], [0, 0]]
[joints.brake]
type = "revolute"
between = ["ground", "ring"]
at = [[0, 0], [0, 0]]
friction = { sliding = "100*(1 - min(1, max(0, (t - 2)/0.1)))" }
[joints.clutch]
type = "revolute"
between = ["engine", "ring"]
at = [[0, 0], [0, 0]]
friction = { sliding = "100*min(1, max(0, (t - 2)/0.1))" }
[joints.planetary]
type = "gear"
between = ["engine", "ring"]
carrier = "load"
radii = [0.5, 0.75]
[forces.motor]
type = "torque"
body = "engine"
torque = "20 if t > 0.5 else 0"
[forces.drag]
type = "torque"
body = "load"
torque = "-20*load.omega*abs(load.omega)/10.471975511966**2"
"""
#: Share of the engine's rate that the brake gives to the load; rate of the ring by those of engine and load.
SHARE, RING = 0.4, np.array([-2.0 / 3.0, 5.0 / 3.0])
EXACT = {"rtol": 1e-12, "atol": 1e-13, "method": "DOP853"}


def drag(rate: float) -> float:
    return 20.0 * rate * abs(rate) / 10.471975511966**2


def by_phases(inertia: float) -> float:
    """Return the rate of the engine at 5 s: the ring braked, between sliding frictions, and carried by the clutch."""

    def fade(t: float) -> float:
        return min(1.0, max(0.0, (t - 2.0) / 0.1))

    def braked(t: float, y: np.ndarray) -> list[float]:
        return [(20.0 - 100.0 * fade(t) - SHARE * drag(SHARE * y[0])) / (1.0 + 10.0 * SHARE**2)]

    def needed(t: float, y: np.ndarray) -> float:
        """What the brake holds less what the ring asks of it, which the gear has from the engine; the clutch rubs."""
        own = np.diag([1.0, 10.0])
        force = np.array([20.0 - 100.0 * fade(t), -drag(SHARE * y[0])]) + 100.0 * fade(t) * RING
        along = np.linalg.solve(own + inertia * np.outer(RING, RING), np.column_stack([force, RING]))
        hold = -(RING @ along[:, 0]) / (RING @ along[:, 1])
        return 100.0 * (1.0 - fade(t)) - abs(hold)

    def sliding(t: float, y: np.ndarray) -> np.ndarray:
        ring = RING @ y
        clutch = 100.0 * fade(t) * np.sign(y[0] - ring)
        force = np.array([20.0 - clutch, -drag(y[1])])
        force = force + (clutch - 100.0 * (1.0 - fade(t)) * np.sign(ring)) * RING
        return np.linalg.solve(np.diag([1.0, 10.0]) + inertia * np.outer(RING, RING), force)

    def together(_: float, y: np.ndarray) -> list[float]:
        return [(20.0 - drag(y[0])) / (11.0 + inertia)]

    def meets(_: float, y: np.ndarray) -> float:
        return y[0] - RING @ y

    def ends(function):  # type: ignore[no-untyped-def]
        function.terminal = True
        return function

    first = solve_ivp(braked, (0.5, 2.0), [0.0], **EXACT).y[:, -1]
    rest = solve_ivp(braked, (2.0, 2.1), first, events=ends(needed), **EXACT)
    t, engine = rest.t[-1], rest.y[0, -1]
    y = np.array([engine, SHARE * engine])
    for end in (2.1, 5.0):
        found = solve_ivp(sliding, (t, end), y + 1e-15, first_step=1e-6, events=ends(meets), **EXACT)
        t, y = found.t[-1], found.y[:, -1]
        if found.status == 1:
            break
    return float(solve_ivp(together, (t, 5.0), y[:1], **EXACT).y[0, -1])


def shift(text: str = SHIFT) -> symgen.Model:
    return symgen.Model(validate(parse_toml(text, "shift.toml"), "shift.toml"))


@pytest.mark.by_turns(3)
@pytest.mark.parametrize("way", [{}, {"coordinates": "joint"}, {"integrator": "radau5"}], ids=["", "joint", "radau5"])
@pytest.mark.slow
def test_a_light_ring_takes_as_many_steps_as_one_without_inertia(way: dict[str, str]) -> None:
    texts = SHIFT.replace('inertia = "ring"', "inertia = 0.0"), SHIFT
    runs = [shift(text).simulate(until=5.0, verify=False, **way) for text in texts]
    assert [run.status for run in runs] == ["ok", "ok"] and runs[1].steps <= 1.1 * runs[0].steps
    assert runs[1]["engine.omega"][-1] == pytest.approx(by_phases(1e-9), abs=2e-8)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_rings_from_1e_12_to_1e_3_are_smooth(coordinates: str) -> None:
    inertias = np.geomspace(1e-12, 1e-3, 301)
    rows = shift().sweep(
        {"ring": inertias}, quantities=("engine.omega",), times=[5.0], until=5.0, coordinates=coordinates
    )
    assert set(rows.status) == {"ok"}
    assert int(max(rows["steps"])) < 100
    ends = rows["engine.omega"][:, 0]
    some = range(0, 301, 50)
    assert ends[some] == pytest.approx([by_phases(inertias[k]) for k in some], abs=2e-7)
    slope = (ends - by_phases(0.0)) / inertias
    heavy = inertias > 1e-6
    assert float(np.ptp(slope[heavy])) < 0.05 * abs(math.fsum(slope[heavy]) / heavy.sum())
