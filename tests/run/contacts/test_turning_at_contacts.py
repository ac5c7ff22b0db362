"""Rolling resistance, and friction of a patch against spin, beside closed forms in the plane and in space."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symgen import InputError, SymgenError
from symgen.result.reading.row_words import row_words
from tests.run.contacts.scenes import G, body, floor, loaded
from tests.run.contacts.scenes import head as plane_head
from tests.run.contacts.scenes_in_space import ball_of, contact, head

EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-14}
R, MASS, MU = 0.2, 1.3, 0.3
#: Resistance b and radius of the patch of balls [m].
ROLLS, PATCH = 0.02, 0.01


def ball(velocity: Any = (0.0, 0.0, 0.0), spin: object = 0.0, height: float = R, keys: str = "", e: float = 0.0) -> str:
    """Return a ball on the floor, or over it, which rolls; keys are those of its contact."""
    x, y, _ = velocity
    omega = (-y / R, x / R, 0.0)
    text = head() + ball_of(R, (0.0, 0.0, height), velocity, MASS, omega=omega)
    text = text.replace("0.0]\norientation", f"{spin}]\norientation")
    return text + contact(f'body = "ball", sphere = {R}', 'plane = "ground"', e, friction=MU) + keys


def wheel(slope: float = 0.0, speed: float = 1.0, height: float = R, e: float = 0.0) -> str:
    """Return a solid wheel in the plane that rolls on a slope of some tangent, with the resistance `b`."""
    size = math.hypot(1.0, slope)
    text = plane_head("wheel", G * slope / size, -G / size) + "[parameters]\nb = 0.02\n"
    text += body("wheel", MASS, 0.5 * MASS * R * R, (0.0, height), (speed, 0.0), -speed / R)
    return text + floor("wheel", R, MU, e) + 'rolling = "b"\n'


@pytest.mark.slow
def test_spins_end_in_the_time_of_the_closed_form(tmp_path: Path) -> None:
    """Three hundred spins; the moment is friction over a ring of the given radius."""
    text = "[parameters]\nspin = 7.0\n" + ball(spin='"spin"', keys=f"torsion = {PATCH}\n")
    model, slows = loaded(text, tmp_path), MU * PATCH * G / (0.4 * R * R)
    values = np.linspace(-4.0, 4.0, 300)
    table = model.sweep(vary={"spin": values}, until=1.2, **EXACT).to_dataframe()
    assert (table["status"] == "ok").all()
    assert np.abs(table["ball.wz"] - np.sign(values) * np.maximum(np.abs(values) - 1.2 * slows, 0.0)).max() < 1e-12
    result = model.simulate(until=5.0, verify=False, **EXACT)
    assert result.ok and [event.name for event in result.events] == ["touch.torsion.stick"]
    assert abs(result.events[0].t - 7.0 / slows) < 1e-12 and result["ball.wz"][-1] == 0.0
    assert result["touch.torsion.moment"][0] == pytest.approx(-MU * PATCH * MASS * G, rel=1e-12)


@pytest.mark.slow
def test_balls_roll_as_far_as_the_closed_form(tmp_path: Path) -> None:
    """Three hundred resistances, in a direction along no axis."""
    text = "[parameters]\nb = 0.02\n" + ball((1.0, 0.5, 0.0), keys='rolling = "b"\n')
    values = np.linspace(0.0, 0.05, 300)
    table = loaded(text, tmp_path).sweep(vary={"b": values}, until=1.5, **EXACT).to_dataframe()
    slows, speed = values * G / (1.4 * R), math.hypot(1.0, 0.5)
    time = np.minimum(1.5, speed / np.maximum(slows, 1e-9))
    assert (table["status"] == "ok").all()
    way = speed * time - 0.5 * slows * time**2
    assert np.abs(table["ball.x"] - way / speed).max() < 1e-11
    assert np.abs(table["ball.y"] - 0.5 * way / speed).max() < 1e-11


WAYS = {
    "dop853": ("absolute", EXACT, 1e-11),
    "joint": ("joint", EXACT, 1e-11),
    "picard": ("absolute", {"integrator": "picard", "rtol": 1e-11}, 1e-9),
    "radau5": ("absolute", {"integrator": "radau5", "rtol": 1e-10}, 1e-9),
}


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
def test_spin_and_rolling_end_apart(way: str, tmp_path: Path) -> None:
    """Of a ball that rolls and spins neither knows of the other; impacts have no impulse of them."""
    coordinates, settings, most = WAYS[way]
    keys = f"rolling = {ROLLS}\ntorsion = {PATCH}\n"
    text = ball((1.0, 0.5, 0.0), 2.0, R + 0.05, keys)
    result = loaded(text, tmp_path).simulate(until=2.5, coordinates=coordinates, verify=False, **settings)
    lands, speed = math.sqrt(2.0 * 0.05 / G), math.hypot(1.0, 0.5)
    spins = lands + 2.0 * 0.4 * R * R / (MU * PATCH * G)
    rolls = lands + speed * 1.4 * R / (ROLLS * G)
    times = {event.name: event.t for event in result.events}
    assert result.ok and list(times) == ["touch.hit", "touch.rest", "touch.torsion.stick", "touch.rolling.stick"]
    assert abs(times["touch.torsion.stick"] - spins) < most and abs(times["touch.rolling.stick"] - rolls) < most
    way_rolled = speed * lands + 0.5 * speed * (rolls - lands)
    assert abs(math.hypot(result["ball.x"][-1], result["ball.y"][-1]) - way_rolled) < most
    assert max(abs(result[f"ball.{key}"][-1]) for key in ("vx", "vy", "wx", "wy", "wz")) < most
    assert result["touch.rolling.moment"][np.searchsorted(result.t, 1.0)] == pytest.approx(ROLLS * MASS * G, rel=1e-9)


@pytest.mark.slow
def test_a_wheel_holds_on_a_slope_until_its_tangent_is_the_resistance_over_the_radius(tmp_path: Path) -> None:
    values = np.linspace(0.0, 0.04, 300)
    table = loaded(wheel(0.1, 0.0), tmp_path).sweep(vary={"b": values}, until=1.0, **EXACT).to_dataframe()
    wanted = np.maximum(0.1 - values / R, 0.0) * G / math.hypot(1.0, 0.1) / 1.5 / 2.0
    assert (table["status"] == "ok").all() and np.abs(table["wheel.x"] - wanted).max() < 1e-12
    model = loaded(wheel(0.1, 0.0).replace("b = 0.02\n", "b = 0.03\n"), tmp_path)
    found = model.equilibrium()
    assert found.multipliers["floor.rolling"] == pytest.approx(-MASS * G * 0.1 / math.hypot(1.0, 0.1) * R, rel=1e-9)


@pytest.mark.slow
def test_derivatives_by_the_resistance(tmp_path: Path) -> None:
    """Of a wheel that rolls, that comes to rest, and that bounces before: beside closed forms and differences."""
    slows, speed = 0.02 * G / (1.5 * R), 1.0

    def slope_of(text: str, until: float) -> tuple[float, Any, float]:
        model = loaded(text, tmp_path)
        run = model.simulate(until=until, sensitivities=["b"], verify=False, **EXACT)
        place = run.q.names.index("wheel.x")
        found = np.asarray(run.sensitivities.table("q")).reshape(len(run.t), -1)[-1, place]
        ends = [
            model.simulate(until=until, parameters={"b": 0.02 + h}, verify=False, **EXACT)["wheel.x"][-1]
            for h in (1e-5, -1e-5)
        ]
        return float(found), run, (ends[0] - ends[1]) / 2e-5

    rolls, _, differs = slope_of(wheel(), 0.5)
    assert rolls == pytest.approx(-0.5 * 0.5**2 * slows / 0.02, rel=1e-9) and rolls == pytest.approx(differs, rel=1e-7)
    rests, run, _ = slope_of(wheel(), 3.0)
    assert [event.name for event in run.events] == ["floor.rolling.stick"]
    assert rests == pytest.approx(-0.5 * speed**2 / slows / 0.02, rel=1e-9)
    bounces, run, differs = slope_of(wheel(height=R + 0.1, e=0.5), 1.0)
    assert run.events[-1].name == "floor.rest" and bounces == pytest.approx(differs, rel=1e-6)


def test_what_turns_not_is_said(tmp_path: Path) -> None:
    box = head() + ball_of(R, (0.0, 0.0, R)) + contact('body = "ball", box = [0.2, 0.2, 0.2]', 'plane = "ground"', 0.0,
                                                      friction=0.3)  # fmt: skip
    scenes = {
        wheel() + "torsion = 0.01\n": "torsion: expected no such key in the plane, got 0.01",
        ball(keys="rolling = -0.1\n"): "rolling: expected a length of at least 0, got -0.1",
        ball(keys="rolling = 0.1\n").replace("friction = 0.3\n", ""): "rolling: expected the key friction beside it",
        f"{box}rolling = 0.1\n": "rolling: expected shapes that touch at one place: a sphere or a rim on a plane",
    }
    for text, sentence in scenes.items():
        with pytest.raises(InputError, match=sentence):
            loaded(text, tmp_path)
    with pytest.raises(InputError, match="straight code where a file has rolling resistance"):
        loaded(wheel(), tmp_path).simulate(shape="looped")


def test_rows_against_turning_have_words(tmp_path: Path) -> None:
    model = loaded(ball((1.0, 0.0, 0.0), keys=f"torsion = {PATCH}\nrolling = {ROLLS}\n"), tmp_path)
    words = row_words(model.mechanism)
    about = {"torsion": "e_z", "rolling1": "e_x", "rolling2": "e_y"}
    for label, axis in about.items():
        expected = f"while it sticks, the turn of ball against ground about {axis} of ground does not change"
        assert words[f"touch.{label}"].words == expected
    planar = row_words(loaded(wheel(), tmp_path).mechanism)
    assert any("the angle of wheel" in row.words for row in planar.values())


@pytest.mark.slow
def test_a_wheel_that_rolls_away_is_no_equilibrium(tmp_path: Path) -> None:
    with pytest.raises(SymgenError, match=r"rolling turns there: it would take 0\.50\d+ N m .* most 0\.25\d+ N m"):
        loaded(wheel(0.2, 0.0), tmp_path).equilibrium()
    with pytest.raises(InputError, match=r"floor\.rolling, which turns at -5 rad/s"):
        loaded(wheel(0.0, 1.0), tmp_path).modes(at="start")
