"""Surfaces that move by themselves: conveyors, crawlers and treadmills, beside closed forms and code of its own."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from symgen.base.errors import InputError
from tests.run.contacts.scenes import G, body, head, loaded
from tests.run.contacts.scenes_in_space import ball_of
from tests.run.contacts.scenes_in_space import contact as contact_in_space
from tests.run.contacts.scenes_in_space import head as head_in_space
from tests.run.contacts.test_derivatives import slopes_of

Array = NDArray[np.float64]

#: Mass of a parcel [kg] and its friction on a belt.
MASS, MU = 2.0, 0.3


def parcel(speed: str, mu: str = '"mu"', outputs: bool = True, shape: str = '{ line = "ground", SPEED }') -> str:
    """Return a parcel that is laid on a belt, with what its friction takes and what the drive gives."""
    other = shape.replace("SPEED", f'surface_speed = "{speed}"')
    text = head("conveyor") + f"[parameters]\nV = 0.5\nmu = {MU}\nw = 4.0\n" + body("box", MASS, 0.05, (0.0, 0.1))
    text += '[outlines.box]\nbody = "box"\nbox = [0.3, 0.2]\n'
    text += f'[contacts.belt]\nbetween = [{{ outline = "box" }}, {other}]\nfriction = {mu}\n'
    return text + ('[outputs]\nlost = "belt.dissipated"\ngiven = "belt.driven"\n' if outputs else "")


def test_a_parcel_is_carried_off(tmp_path: Path) -> None:
    """It slides until it has the belt's speed; half of what the drive gives is lost, and half is in its motion."""
    run = loaded(parcel("V"), tmp_path).simulate(until=0.6)
    stick = 0.5 / (MU * G)
    assert run.ok and {event.name for event in run.events} == {"belt.stick"}
    assert abs(run.events[0].t - stick) < 1e-9
    assert abs(run["box.x"][-1] - 0.5 * (0.6 - 0.5 * stick)) < 1e-9
    assert abs(run["given"][-1] - MASS * 0.5**2) < 1e-8 and abs(run["lost"][-1] - 0.5 * MASS * 0.5**2) < 1e-8
    assert run.energy_drift_max < 1e-9


@pytest.mark.slow
def test_three_hundred_speeds_of_a_belt(tmp_path: Path) -> None:
    model = loaded(parcel("V"), tmp_path)
    speeds, until, push = np.linspace(-3.0, 3.0, 300), 0.7, MU * G
    table = model.sweep(vary={"V": speeds}, until=until, rtol=1e-10).to_dataframe()
    slides = np.minimum(np.abs(speeds) / push, until)
    assert 0 < np.sum(slides == until) < 250
    places = np.sign(speeds) * (0.5 * push * slides**2 + np.abs(speeds) * (until - slides))
    given, kinetic = MASS * push * slides * np.abs(speeds), 0.5 * MASS * (push * slides) ** 2
    assert set(table["status"]) == {"ok"}
    np.testing.assert_allclose(table["box.x"], places, rtol=0.0, atol=1e-9)
    for i in range(0, 300, 10):
        run = model.simulate(until=until, rtol=1e-10, parameters={"V": float(speeds[i])}, verify=False)
        assert abs(run["given"][-1] - given[i]) < 1e-8 and abs(run["lost"][-1] - given[i] + kinetic[i]) < 1e-8


def on_reversing_belt(speed: float, w: float, until: float) -> tuple[float, float, int]:
    """Return place and velocity of a parcel on a belt of the velocity V cos(w t), and how often it slides from rest."""
    t, x, v, mode, slips = 0.0, 0.0, 0.0, 1.0, 0

    def rates(t: float, y: Array, sense: float) -> list[float]:
        return [y[1], sense * MU * G if sense else -speed * w * math.sin(w * t)]

    def over(t: float, y: Array, sense: float) -> float:
        if sense:
            return sense * (speed * math.cos(w * t) - y[1])
        return MU * G - abs(speed * w * math.sin(w * t))

    over.terminal, over.direction = True, -1.0  # type: ignore[attr-defined]
    while t < until:
        part = solve_ivp(rates, (t, until), [x, v], "DOP853", events=over, args=(mode,), rtol=1e-12, atol=1e-14)
        t, (x, v) = float(part.t[-1]), part.y[:, -1]
        if part.status == 1:
            pull = -speed * w * math.sin(w * t)
            mode = math.copysign(1.0, pull) if abs(pull) > MU * G * (1.0 - 1e-9) else 0.0
            slips += mode != 0.0
    return float(x), float(v), slips


@pytest.mark.slow
def test_three_hundred_frequencies_of_a_belt_that_reverses(tmp_path: Path) -> None:
    """Slow belts carry the parcel to and fro; from mu g / V on it slides in a part of each period, at last always."""
    model = loaded(parcel("V*cos(w*t)"), tmp_path)
    waves, until = np.linspace(2.0, 14.0, 300), 2.0
    expected = [on_reversing_belt(0.5, float(w), until) for w in waves]
    assert {slips for *_, slips in expected} >= {0, 2, 4, 6}
    table = model.sweep(vary={"w": waves}, until=until, rtol=1e-10).to_dataframe()
    assert set(table["status"]) == {"ok"}
    np.testing.assert_allclose(table["box.x"], [x for x, *_ in expected], rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(table["box.vx"], [v for _, v, _ in expected], rtol=0.0, atol=1e-7)
    for i in range(0, 300, 30):
        run = model.simulate(until=until, rtol=1e-10, parameters={"w": float(waves[i])}, verify=False)
        assert abs(run["given"][-1] - run["lost"][-1] - 0.5 * MASS * run["box.vx"][-1] ** 2) < 1e-8


#: Ways of a run.
WAYS: dict[str, dict[str, Any]] = {
    "looped": {"shape": "looped"},
    "joint": {"coordinates": "joint"},
    "radau5": {"integrator": "radau5"},
    "bdf": {"method": "ggl", "integrator": "bdf"},
    "picard": {"integrator": "picard"},
}


@pytest.mark.slow
def test_a_belt_that_reverses_in_other_ways(tmp_path: Path) -> None:
    model, until = loaded(parcel("V*cos(w*t)"), tmp_path), 1.5
    x, v, _ = on_reversing_belt(0.5, 9.0, until)
    for way, settings in WAYS.items():
        run = model.simulate(until=until, rtol=1e-9, parameters={"w": 9.0}, **settings)
        assert run.ok, (way, run.reason)
        assert abs(run["box.x"][-1] - x) < 1e-6 and abs(run["box.vx"][-1] - v) < 1e-6, way


@pytest.mark.slow
def test_a_belt_that_starts_with_a_kink(tmp_path: Path) -> None:
    """It reaches its speed in 0.2 s, faster than friction can follow, and the parcel later."""
    run = loaded(parcel("min(5*V*t, V)"), tmp_path).simulate(parameters={"V": 1.0}, until=0.6, rtol=1e-10)
    stick = 1.0 / (MU * G)
    assert run.ok and abs(run["box.x"][-1] - (0.6 - 0.5 * stick)) < 1e-9


@pytest.mark.slow
def test_outlines_move_as_lines_do(tmp_path: Path) -> None:
    """The free side is on the left: the top of a closed belt goes forwards, and crawlers drive on what is below."""
    ground = '[outlines.road]\nbody = "ground"\npoints = [[-9.0, 0.0], [9.0, 0.0]]\n'
    loop = '[outlines.road]\nbody = "ground"\nbox = [9.0, 0.2]\nat = [0.0, -0.1]\nfillet = 0.05\n'
    line = loaded(parcel("V"), tmp_path).simulate(until=0.6)["box.x"][-1]
    for road in (ground, loop):
        text = parcel("V", shape='{ outline = "road", SPEED }') + road
        assert abs(loaded(text, tmp_path).simulate(until=0.6)["box.x"][-1] - line) < 1e-9
    crawler = parcel("0.0").replace('{ outline = "box" }', '{ outline = "box", surface_speed = "V" }')
    assert abs(loaded(crawler, tmp_path).simulate(until=0.6)["box.x"][-1] - line) < 1e-9
    against = crawler.replace('surface_speed = "0.0"', 'surface_speed = "-V"')
    assert np.abs(loaded(against, tmp_path).simulate(until=0.6)["box.x"]).max() < 1e-12


@pytest.mark.slow
def test_a_disc_on_a_belt_takes_a_third_of_its_speed(tmp_path: Path) -> None:
    """Of V, as its moment of inertia is m r^2 / 2; then it rolls. So it does between two belts that it hangs from."""
    text = head("disc") + body("disc", 1.0, 0.005, (0.0, 0.1)) + "[contacts.belt]\nfriction = 0.2\nbetween = "
    text += '[{ body = "disc", disc = 0.1 }, { line = "ground", surface_speed = 0.9 }]\n'
    run = loaded(text, tmp_path).simulate(until=0.5)
    assert [event.name for event in run.events] == ["belt.stick"]
    assert abs(run.events[0].t - 0.3 / (0.2 * G)) < 1e-9
    assert abs(run["disc.vx"][-1] - 0.3) < 1e-9 and abs(run["disc.omega"][-1] - 6.0) < 1e-7


@pytest.mark.slow
def test_balls_on_treadmills(tmp_path: Path) -> None:
    """A ball takes two sevenths of the belt's velocity; a belt whose direction turns is beside equations by SciPy."""
    shape = 'plane = "ground", surface_velocity = [0.6, "0.8*c", 0.0]'
    text = head_in_space() + "[parameters]\nc = 1.0\n" + ball_of(0.2, (0.0, 0.0, 0.2))
    text += contact_in_space('body = "ball", sphere = 0.2', shape, name="belt", friction=0.3)
    text += '[outputs]\nlost = "belt.dissipated"\ngiven = "belt.driven"\n'
    run = loaded(text, tmp_path).simulate(until=0.5)
    stick = 2.0 / (7.0 * 0.3 * G)
    assert run.ok and [event.name for event in run.events] == ["belt.stick"] and abs(run.events[0].t - stick) < 1e-9
    np.testing.assert_allclose([run["ball.vx"][-1], run["ball.vy"][-1]], [1.2 / 7.0, 1.6 / 7.0], atol=1e-9)
    np.testing.assert_allclose([run["given"][-1], run["lost"][-1]], [2.0 / 7.0, 1.0 / 7.0], atol=1e-8)
    turning = text.replace('[0.6, "0.8*c", 0.0]', '["cos(3*t)", "sin(3*t)", 0.0]')
    own = loaded(turning, tmp_path).simulate(until=0.15, rtol=1e-10)

    def rates(t: float, y: Array) -> Array:  # of place, velocity, and that of the lowest point against the ball
        slip = np.array([math.cos(3.0 * t), math.sin(3.0 * t)]) - y[2:4] - y[4:6]
        push = 0.3 * G * slip / np.hypot(*slip)
        return np.concatenate([y[2:4], push, 2.5 * push])

    part = solve_ivp(rates, (0.0, 0.05), np.zeros(6), "DOP853", rtol=1e-12, atol=1e-14)
    assert own.ok and abs(np.interp(0.05, own.t, own["ball.x"]) - part.y[0, -1]) < 1e-6
    place = loaded(turning, tmp_path).simulate(until=0.05, rtol=1e-10)
    np.testing.assert_allclose([place["ball.x"][-1], place["ball.y"][-1]], part.y[:2, -1], atol=1e-9)


@pytest.mark.slow
def test_derivatives_by_the_speed_of_a_belt(tmp_path: Path) -> None:
    """While it slides, after it has stuck, and through stick and slip of a belt that reverses."""
    for speed, until in (("V", 0.1), ("V", 0.5)):
        slopes = slopes_of(parcel(speed, outputs=False), until, "box.x", {"V": 0.5, "mu": MU}, tmp_path)
        stick = min(0.5 / (MU * G), until)
        assert abs(slopes["V"] - (until - stick)) < 1e-7
    slopes_of(parcel("V*cos(w*t)", outputs=False), 1.0, "box.x", {"V": 0.5, "w": 4.0}, tmp_path)


def test_what_is_said_of_a_surface_that_moves(tmp_path: Path) -> None:
    model = loaded(parcel("V*cos(w*t)"), tmp_path)
    text = str(model.inspect())
    assert "the surface moves at V*cos(w*t) [m/s]" in text and "less the way of the surface does not change" in text


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('"V"', '"V if t < 1 else 0"', "a formula of t without jumps, such as min(t/0.1, 1)"),
        ('friction = "mu"', "restitution = 0.2", "friction, by which a surface that moves acts"),
        ('"V"', '"V*box.x"', "a number or an expression of t and parameters"),
        ('"V"', '"0.5 kg"', "a unit such as m/s, mm/s, km/h"),
    ],
)
def test_surfaces_that_are_refused(old: str, new: str, sentence: str, tmp_path: Path) -> None:
    text = parcel("V", outputs=False)
    assert old in text
    with pytest.raises(InputError) as refused:
        loaded(text.replace(old, new), tmp_path)
    assert sentence in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize("call", ["equilibrium", "modes", "linearise", "inverse"])
def test_analyses_refuse_surfaces_that_move(call: str, tmp_path: Path) -> None:
    model = loaded(parcel("V"), tmp_path)
    with pytest.raises(InputError, match="without surfaces that move by themselves, got surface_speed of belt"):
        getattr(model, call)()
