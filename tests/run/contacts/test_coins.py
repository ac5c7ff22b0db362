"""A coin that rolls on its rim: steady motion in closed form, and others beside equations of its own frame."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from support.spatial_runs import turned

from symgen import AssemblyError
from tests.run.contacts.scenes import G, loaded
from tests.run.contacts.scenes_in_space import body, contact, head

Array = np.ndarray
RADIUS = 0.1
#: Moments of inertia by mass about a diameter of the rim, about the axis, and about the axis at the contact.
ACROSS, ALONG = 0.25 * RADIUS**2, 0.5 * RADIUS**2
ROLLS = ALONG + RADIUS**2
EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-14}
#: Rate of precession of steady motion, from the inclination and the rate about the axis.
STEADY = (
    f"({ROLLS!r} * spin * sin(lean) + sqrt(({ROLLS!r} * spin * sin(lean))**2 + "
    f"{4.0 * ACROSS * G * RADIUS!r} * sin(lean) * cos(lean)**2)) / ({2.0 * ACROSS!r} * sin(lean) * cos(lean))"
)


def coin(turn: object = '"turn"') -> str:
    """Return a coin that rolls, inclined by `lean` about x, which falls, precesses and turns about its axis."""
    text = head() + "[parameters]\nlean = 0.5\nspin = 0.0\nturn = 5.0\nfall = 0.0\n"
    text += body("coin", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 1.0, (ACROSS, ACROSS, ALONG))
    for key, given in {
        "position": f'[0.0, "{RADIUS} * cos(lean)", "{RADIUS} * sin(lean)"]',
        "\nvelocity": f'["-{RADIUS} * spin", "-{RADIUS} * fall * sin(lean)", "{RADIUS} * fall * cos(lean)"]',
        "angular_velocity": f'["fall", "({str(turn).strip(chr(34))}) * sin(lean)", "spin"]',
        "rotation_vector": '["lean", 0.0, 0.0]',
    }.items():
        text = text.replace(f"{key} = [0.0, 0.0, 0.0]", f"{key} = {given}")
    rim = f'body = "coin", axis = [0.0, 0.0, 1.0], disc = {RADIUS}'
    return text + contact(rim, 'plane = "ground"', friction=5.0)


def precession(lean: float, spin: float) -> float:
    """Return the rate of precession at which an inclination stays: ``A W^2 s c - (C + m r^2) w W s = m g r c``."""
    s, c = math.sin(lean), math.cos(lean)
    return float(max(np.roots([ACROSS * s * c, -ROLLS * spin * s, -G * RADIUS * c]).real))


def energy(result: Any) -> Array:
    """Return the energy at all times, by mass."""
    v, w = (np.column_stack([result[f"coin.{k}{x}"] for x in "xyz"]) for k in "vw")
    return 0.5 * (v**2).sum(1) + 0.5 * w**2 @ [ACROSS, ACROSS, ALONG] + G * result["coin.z"]


def rolled(lean: float, fall: float, turn: float, spin: float, until: float) -> tuple[Array, Array]:
    """Return the centre and the axis of a coin after a time.

    The frame of the coin has the horizontal of its plane, the steepest ascent and the axis; angular momentum about
    the contact gives rates of fall, turn and spin, and the place follows from them.
    """

    def frame(z: Array) -> Array:
        return np.asarray((Rotation.from_euler("z", z[4]) * Rotation.from_euler("x", z[0])).as_matrix())

    def rates(_: float, z: Array) -> list[float]:
        lean, fall, turn, spin = z[:4]
        s, c = math.sin(lean), math.cos(lean)
        falls = (ACROSS * turn**2 * s * c - ROLLS * spin * turn * s - G * RADIUS * c) / (ACROSS + RADIUS**2)
        turns = (ALONG * fall * spin - 2.0 * ACROSS * turn * c * fall) / (ACROSS * s)
        spins = RADIUS**2 * fall * turn * s / ROLLS
        velocity = frame(z) @ [-RADIUS * spin, 0.0, RADIUS * fall]
        return [fall, falls, turns, spins, turn, velocity[0], velocity[1]]

    start = [lean, fall, turn, spin, 0.0, 0.0, RADIUS * math.cos(lean)]
    z = solve_ivp(rates, (0.0, until), start, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
    return np.array([*z[5:7], RADIUS * math.sin(z[0])]), frame(z)[:, 2]


@pytest.mark.slow
def test_a_coin_precesses_as_its_closed_form_says_down_to_two_degrees(tmp_path: Path) -> None:
    """Where its centre rests the square of the rate is ``4 g / (r sin)``; otherwise the centre runs round a circle."""
    model = loaded(coin(), tmp_path)
    for degrees in (60.0, 30.0, 10.0, 5.0, 2.0):
        for spin in (0.0, -3.0, 4.0):
            lean = math.radians(degrees)
            turn = precession(lean, spin)
            assert spin != 0.0 or turn == pytest.approx(math.sqrt(4.0 * G / RADIUS / math.sin(lean)), rel=1e-14)
            run = model.simulate(until=1.0, verify=False, parameters=dict(lean=lean, turn=turn, spin=spin), **EXACT)
            axis = turned(run, "coin").apply([0.0, 0.0, 1.0])
            angle = turn * np.array(run.t)
            wanted = np.column_stack([math.sin(lean) * np.sin(angle), -math.sin(lean) * np.cos(angle)])
            assert run.ok and not run.events and np.abs(axis[:, :2] - wanted).max() < 1e-10
            assert np.abs(run["coin.z"] - RADIUS * math.sin(lean)).max() < 1e-12
            assert np.ptp(energy(run)) < 1e-11 and np.abs(run["coin.wz"] - spin).max() < 1e-11
            centre = np.column_stack([run["coin.x"], run["coin.y"]]) - [0.0, RADIUS * math.cos(lean)]
            circle = np.column_stack([np.sin(angle), 1.0 - np.cos(angle)]) * -RADIUS * spin / turn
            assert np.abs(centre - circle).max() < 1e-11


@pytest.mark.slow
@pytest.mark.parametrize("spin", [0.0, -3.0])
def test_three_hundred_inclinations_stay(spin: float, tmp_path: Path) -> None:
    """From 80 to 2 degrees steady motion stays steady for a second."""
    model = loaded(coin(STEADY).replace("spin = 0.0", f"spin = {spin}"), tmp_path)
    leans = np.radians(np.geomspace(80.0, 2.0, 300))
    table = model.sweep(vary={"lean": leans}, until=1.0, **EXACT).to_dataframe()
    assert (table["status"] == "ok").all()
    assert np.abs(table["coin.z"] - RADIUS * np.sin(leans)).max() < 1e-10
    assert np.abs(table["coin.wz"] - spin).max() < 1e-9 and np.abs(table["coin.wx"]).max() < 1e3


@pytest.mark.slow
def test_a_disturbed_coin_is_its_own_equations(tmp_path: Path) -> None:
    """It nutates between steep and flat; energy is kept."""
    model = loaded(coin(), tmp_path)
    for lean, fall, turn, spin in ((0.5, 0.0, 8.0, 3.0), (1.2, 1.0, 4.0, -12.0), (0.2, -1.0, 30.0, 2.0)):
        start = {"lean": lean, "fall": fall, "turn": turn, "spin": spin}
        run = model.simulate(until=1.0, verify=False, parameters=start, **EXACT)
        centre, axis = rolled(lean, fall, turn, spin, 1.0)
        found = turned(run, "coin").apply([0.0, 0.0, 1.0])[-1]
        assert run.ok and not run.events and np.ptp(energy(run)) < 1e-9, start
        assert np.abs([run[f"coin.{x}"][-1] for x in "xyz"] - centre).max() < 1e-9, start
        assert np.abs(found - axis).max() < 1e-9, start
        assert np.ptp(run["coin.z"]) > 1e-3


@pytest.mark.slow
def test_a_coin_never_lies_flat(tmp_path: Path) -> None:
    """Almost without precession it rises again at once, as its own equations say; without any the run ends."""
    model = loaded(coin(), tmp_path)
    run = model.simulate(until=0.2, verify=False, parameters={"lean": 0.3, "turn": 0.5}, **EXACT)
    centre, _ = rolled(0.3, 0.0, 0.5, 0.0, 0.2)
    assert run.ok and run["coin.z"].min() < 0.002 and abs(run["coin.z"][-1] - centre[2]) < 1e-7
    flat = model.simulate(until=1.0, integrator="dop853", verify=False, parameters={"lean": 0.3, "turn": 0.0})
    assert flat.status == "failed" and "the run makes no progress" in str(flat.reason)
    with pytest.raises(AssemblyError, match="or a disc lies flat on its plane; describe another start"):
        model.simulate(until=1.0, parameters={"lean": 0.0})
