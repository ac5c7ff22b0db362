"""Scenes with several contacts: grippers, an edge, many discs; sweeps, steps and C."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.ending import Ending

from tests.result.targets.test_c_modes import assert_same_run, program_of
from tests.run.contacts.scenes import G, body, floor, head, loaded


def gripper(power: int) -> str:
    """Return two fingers on a hand that a driver lifts from 0.2 s on, with a disc between them that lies on a floor."""
    text = head("grip") + "[inputs]\nsqueeze = 2.0\n" + body("ball", 0.1, 4.5e-5, (0.0, 0.03))
    text += body("hand", 0.5, 1e-3, (0.0, 0.2))
    text += '[joints.lift]\ntype = "translational"\nbetween = ["ground", "hand"]\nat = [[0.0, 0.0], [0.0, 0.0]]\n'
    text += 'axis = [0.0, 1.0]\nangle = 0.0\n[joints.motor]\ntype = "driver"\njoint = "lift"\n'
    text += f'value = "0.2 + 0.1*(0.0 if t < 0.2 else 1.0)*(t - 0.2)**{power}"\n'
    for name, side in (("left", -1.0), ("right", 1.0)):
        text += body(name, 0.05, 1e-4, (0.04 * side, 0.03))
        text += f'[joints.guide_{name}]\ntype = "translational"\nbetween = ["hand", "{name}"]\n'
        text += "at = [[0.0, -0.17], [0.0, 0.0]]\naxis = [1.0, 0.0]\nangle = 0.0\n"
        for on, sign in ((name, -side), ("hand", side)):
            force = f'["{sign}*squeeze*(1.0 if t < 1.2 else 0.25)", 0.0]'
            text += f'[forces.{on}_{name}]\ntype = "force"\nbody = "{on}"\nforce = {force}\n'
        line = f'{{ line = "{name}", on = [{-0.01 * side!r}, 0.0], normal = [{-side!r}, 0.0] }}'
        text += f'[contacts.at_{name}]\nbetween = [{{ body = "ball", disc = 0.03 }}, {line}]\nfriction = 0.5\n'
    return text + floor("ball", 0.03, 0.5)


@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["dop853", "picard", "radau5"])
def test_a_gripper_lifts_holds_and_lets_slip(integrator: str, tmp_path: Path) -> None:
    result = loaded(gripper(2), tmp_path).simulate(until=1.6, integrator=integrator, verify=False, rtol=1e-10)
    # up at 0.2 m/s^2 until 1.2 s: from 0.1 m with 0.2 m/s it falls against friction of 5 m/s^2
    lands = 1.2 + (0.2 + math.sqrt(0.2**2 + 2.0 * 4.81 * 0.1)) / 4.81
    times = {event.name: event.t for event in result.events}
    assert result.ok and abs(times["floor.lift"] - 0.2) < 1e-9 and abs(times["floor.hit"] - lands) < 1e-9
    assert abs(times["at_left.slip"] - 1.2) < 1e-9
    held = loaded(gripper(2), tmp_path).simulate(until=1.1, integrator=integrator, verify=False)
    assert abs(held["ball.y"][-1] - 0.03 - 0.1 * 0.9**2) < 1e-12


@pytest.mark.slow
def test_a_hand_that_starts_smoothly_lifts_as_well(tmp_path: Path) -> None:
    """At 0.2 s nothing accelerates: friction that other rows carry is watched, as the hand takes it along."""
    result = loaded(gripper(3), tmp_path).simulate(until=1.0, integrator="dop853", verify=False)
    assert [event.name for event in result.events] == ["floor.lift"] and abs(result.events[0].t - 0.2) < 1e-5
    assert abs(result["ball.y"][-1] - 0.03 - 0.1 * 0.8**3) < 1e-10


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["dop853", pytest.param("picard", marks=pytest.mark.slow)])
def test_a_disc_rolls_off_a_table(integrator: str, tmp_path: Path) -> None:
    """Past the end it rolls about the corner, slips and lifts, as in an integration of one's own."""
    from scipy.integrate import solve_ivp

    r, mu, v = 0.1, 0.4, 0.6
    text = head("edge") + body("disc", 1.0, 0.5 * r * r, (-0.2, r), (v, 0.0), -v / r)
    text += '[contacts.table]\nbetween = [{ body = "disc", disc = 0.1 }, '
    text += '{ body = "ground", segment = [[-1.0, 0.0], [0.0, 0.0]] }]\nfriction = 0.4\n'
    result = loaded(text, tmp_path).simulate(until=0.8, integrator=integrator, verify=False, rtol=1e-11)

    # about the corner: 3/2 r a'' = g sin a, N = g cos a - r a'^2, T = g sin a / 3
    def rolls(_: float, y: np.ndarray) -> list[float]:
        return [y[1], G * math.sin(y[0]) / (1.5 * r)]

    def slips(_: float, y: np.ndarray) -> float:
        return mu * (G * math.cos(y[0]) - r * y[1] ** 2) - G * math.sin(y[0]) / 3.0

    one = solve_ivp(rolls, (0.0, 1.0), [0.0, v / r], events=Ending(slips), rtol=1e-12, atol=1e-14, method="DOP853")
    slip = 0.2 / v + one.t[-1]

    def slides(_: float, y: np.ndarray) -> list[float]:
        pressed = G * math.cos(y[0]) - r * y[1] ** 2
        return [y[1], (G * math.sin(y[0]) - mu * pressed) / r]

    def lifts(_: float, y: np.ndarray) -> float:
        return G * math.cos(y[0]) - r * y[1] ** 2

    two = solve_ivp(slides, (0.0, 1.0), one.y[:, -1], events=Ending(lifts), rtol=1e-12, atol=1e-14, method="DOP853")
    times = [slip, slip + two.t[-1]]
    assert [event.name for event in result.events] == ["table.slip", "table.lift"]
    assert np.allclose([event.t for event in result.events], times, rtol=0.0, atol=1e-9)


SPIN = (
    head("drop")
    + "[parameters]\nmu = 0.07\n"
    + body("disc", 1.0, 0.005, (0.0, 0.9), (0.3, 0.0), 25.0)
    + floor("disc", 0.1, '"mu"', 0.6)
)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_rows_of_a_sweep_and_steps_are_single_runs(tmp_path: Path) -> None:
    model, settings = loaded(SPIN, tmp_path), {"integrator": "dop853", "until": 2.5}
    values = np.array([0.0, 0.05, 0.2, 0.7])
    table = model.sweep(vary={"mu": values}, **settings).to_dataframe()
    (key,) = [key for key in table.columns if key.startswith("disc.x")]
    single = [model.simulate(parameters={"mu": float(x)}, verify=False, **settings)["disc.x"][-1] for x in values]
    assert table[key].tolist() == single
    simulation = model.start(integrator="dop853")
    for _ in range(25):
        simulation.step(0.1)
    whole = model.simulate(verify=False, **settings)
    assert abs(simulation["disc.x"] - whole["disc.x"][-1]) < 1e-9


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_the_same_in_c(tmp_path: Path) -> None:
    model = loaded(SPIN, tmp_path)
    transitions = assert_same_run(model, program_of(model, tmp_path / "c"), 2.5, 0.002, most=1e-9)
    assert [word for _, word in transitions][-1] == "floor.rest"


def many_discs(count: int) -> str:
    """Return discs that skid on a floor, each with its speed."""
    text = head("many")
    for i in range(count):
        text += body(f"d{i}", 1.0, 0.005, (float(i), 0.1), (1.0 + 0.1 * i, 0.0))
        text += floor(f"d{i}", 0.1, 0.2, name=f"c{i}")
    return text


@pytest.mark.slow
def test_uncoupled_discs_are_chosen_apart(tmp_path: Path) -> None:
    result: Any = loaded(many_discs(8), tmp_path).simulate(until=1.0, integrator="dop853", verify=False)
    wanted = [(1.0 + 0.1 * i) / 3.0 / (0.2 * G) for i in range(8)]
    assert np.allclose([event.t for event in result.events], wanted, rtol=0.0, atol=1e-10)


#: Runs a file without compilation, and says how often laws are solved for at each choice.
COUNTING = """
import json, sys
from symgen.run.laws import motions
from symgen.run.modes import choosing
import symgen

class Counted:
    def __init__(self, function, count):
        self.function, self.count = function, count
    def __call__(self, *arguments):
        self.count()
        return self.function(*arguments)

solved = []
def solves():
    solved[-1] += 1
choosing.find_parts = Counted(choosing.find_parts, lambda: solved.append(0))
motions.follow_laws = Counted(motions.follow_laws, solves)
run = symgen.load(sys.argv[1]).simulate(until=0.4, integrator="dop853", verify=False, rtol=1e-3)
print(json.dumps({"events": len(run.events), "solved": solved}))
"""


@pytest.mark.slow
def test_uncoupled_discs_cost_as_much_as_alone(tmp_path: Path) -> None:
    """Solutions of eight discs on a floor are eight times those of one, not all of them together."""
    found = []
    for count in (1, 8):
        (tmp_path / "many.toml").write_text(many_discs(count))
        command = [sys.executable, "-W", "ignore", "-c", COUNTING, "many.toml"]
        environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
        done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, env=environment, check=False)
        assert done.returncode == 0, done.stderr
        found.append(json.loads(done.stdout))
    one, eight = found
    assert one["events"] == 1 and eight["events"] == 8
    assert eight["solved"][0] == 8 * one["solved"][0] and max(eight["solved"]) == 8 * max(one["solved"]) == 16


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_pin_with_play_swings_against_its_hole(coordinates: str, tmp_path: Path) -> None:
    """A bar hangs on a pin with play: it falls by the play, strikes without rebound, and hangs."""
    text = head("play") + body("bar", 2.0, 0.05, (0.0, -0.3))
    text += '[joints.pin]\ntype = "revolute"\nbetween = ["ground", "bar"]\nat = [[0.0, 0.0], [0.0, 0.3]]\n'
    text += "clearance = { hole = 0.012, pin = 0.01, friction = 0.1 }\n"
    result = loaded(text, tmp_path).simulate(
        until=0.5, integrator="dop853", verify=False, rtol=1e-11, coordinates=coordinates
    )
    assert [event.name for event in result.events] == ["pin.hit", "pin.rest"]
    assert abs(result.events[0].t - math.sqrt(2.0 * 0.002 / G)) < 1e-10
    assert abs(result["bar.y"][-1] + 0.302) < 1e-12 and abs(result["pin.force"][-1] - 2.0 * G) < 1e-9
    assert result["pin.angle"][-1] == 0.0
