"""Stops against closed forms and event-driven references."""

import copy
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.describe.load import parse_toml, read_raw
from symgen.describe.mechanism import Mechanism
from symgen.describe.validate import validate
from symgen.running.prepare import Prepared, prepare

G = 9.81
BALL = """
[mechanism]
name = "ball"
gravity = [0.0, -9.81]

[bodies.ball]
type = "point"
mass = 2.0
position = [0.0, 1.0]

[joints.rail]
type = "rows"
rows = [{ position = "ball.x" }]

[stops.floor]
gap = "ball.y"
restitution = 0.7
"""
#: A load on a rope of 2 m, at the bottom.
ROPE = """
[mechanism]
name = "rope"
gravity = [0.0, -9.81]

[parameters]
speed = "sqrt(3.5*9.81*2.0)"

[bodies.load]
type = "point"
mass = 1.5
position = [0.0, -2.0]
velocity = ["speed", 0.0]

[stops.rope]
gap = "2.0 - sqrt(load.x**2 + load.y**2)"
"""
LEG = """
[mechanism]
name = "leg"
gravity = [0.0, -9.81]

[bodies.thigh]
mass = 1.5
inertia = 0.05
points = { hip = [0.0, 0.3], knee = [0.0, -0.3] }

[bodies.shank]
mass = 1.0
inertia = 0.03
points = { knee = [0.0, 0.3] }

[joints.hip]
type = "revolute"
between = ["ground", "thigh"]
at = [[0.0, 0.0], "hip"]
start = { angle = 1.2 }

[joints.knee]
type = "revolute"
between = ["thigh", "shank"]
at = ["knee", "knee"]
start = { angle = 0.0 }
stop = { upper = 0.0 }
"""


#: A block that its motor presses against a stop and pulls back from it.
SLIDE = """
[mechanism]
name = "slide"

[bodies.block]
mass = 2.0
inertia = 1.0
velocity = [1.0, 0.0]

[joints.rail]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], [0.0, 0.0]]
axis = [1.0, 0.0]
friction = { sliding = 3.0 }
stop = { upper = 0.5, restitution = 0.5 }

[forces.motor]
type = "force"
body = "block"
force = ["8.0 - 4.0*t", 0.0]
"""


@cache
def described(text: str) -> Mechanism:
    return validate(parse_toml(text, "file.toml"), "file.toml")


@cache
def four_bar() -> Mechanism:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["joints"]["A"]["stop"] = {"lower": -1.0, "restitution": 0.6}
    return validate(raw, source)


def ready(mechanism: Mechanism, until: float, integrator: str = "dop853", **settings: Any) -> Prepared:
    steps = {"step": 4e-3} if integrator == "rk4" else {"rtol": 1e-12, "atol": 1e-12}
    return prepare(mechanism, Settings(integrator=integrator, until=until, verify=False, **steps | settings))


def times(outcome: Any, name: str) -> np.ndarray:
    return np.array([event.t for event in outcome.happened if event.name == name])


def multiplier(outcome: Any, row: str) -> float:
    place = [r.name for r in outcome.compiled.info.rows].index(row)
    return float(outcome.compiled.section(outcome.w, "multipliers")[place])


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("integrator", ["dop853", "picard", "radau5", "rk4"])
def test_a_ball_bounces_and_rests(integrator: str, coordinates: str) -> None:
    """Flights last 2 v / g; their series ends at sqrt(2 h / g) (1 + e) / (1 - e)."""
    outcome = ready(described(BALL), 4.0, integrator, coordinates=coordinates).integrate()
    first = np.sqrt(2.0 / G)
    hits = first + 2.0 * first * np.concatenate([[0.0], np.cumsum(0.7 ** np.arange(1, 20))])
    assert outcome.reason == ""
    np.testing.assert_allclose(times(outcome, "floor.hit")[:20], hits, rtol=0, atol=1e-12)
    rest = outcome.happened[-1]
    assert rest.name == "floor.rest"
    end = first * 1.7 / 0.3
    assert abs(rest.t + rest.left - end) < 1e-9
    assert abs(rest.t - end) < 1e-8
    np.testing.assert_allclose(outcome.states[-1][:4], 0.0, rtol=0, atol=1e-15)
    assert multiplier(outcome, "floor.stop") == pytest.approx(-2.0 * G, rel=1e-13)
    assert outcome.energy_drift_max < 1e-10
    impact = outcome.happened[0].impact
    np.testing.assert_allclose(impact.impulses[-1], 2.0 * 1.7 * np.sqrt(2.0 * G), rtol=1e-12)
    assert outcome.happened[0].energy == pytest.approx(-2.0 * G * 0.51, rel=1e-12)


@pytest.mark.parametrize(
    ("integrator", "coordinates"), [("dop853", "absolute"), ("picard", "joint"), ("radau5", "joint")]
)
def test_a_four_bar_strikes_a_stop_of_its_crank(integrator: str, coordinates: str) -> None:
    """Impacts, their end and the torque at rest of an event-driven reference in one coordinate."""
    outcome = ready(four_bar(), 6.0, integrator, coordinates=coordinates).integrate()
    hits = times(outcome, "A.lower.hit")
    np.testing.assert_allclose(hits[:3], [1.3417148338025, 2.459850077041, 3.163183939102], rtol=0, atol=1e-11)
    rest = outcome.happened[-1]
    assert rest.name == "A.lower.rest"
    assert abs(rest.t + rest.left - 4.2510652271) < 1e-10
    assert outcome.happened[0].state[outcome.compiled.info.nq :][2 if coordinates == "absolute" else 0] == (
        pytest.approx(-3.31585677294, rel=1e-11)
    )
    assert -multiplier(outcome, "A.lower.stop") == pytest.approx(132.39043415702, rel=1e-12)


def leg_at(angle: float, knee: float, rates: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return M and the forces of the leg, by the angle of the thigh and that of the knee."""
    half, whole, other = 0.3, 0.6, angle + knee
    along = [np.array([np.cos(a), np.sin(a)]) for a in (angle, other)]
    inwards = [np.array([-np.sin(a), np.cos(a)]) for a in (angle, other)]
    thigh = np.stack([half * along[0], np.zeros(2)], axis=1)
    shank = np.stack([whole * along[0] + half * along[1], half * along[1]], axis=1)
    squares = rates[0] ** 2, rates.sum() ** 2
    weight = np.array([0.0, -G])
    mass = 1.5 * thigh.T @ thigh + shank.T @ shank + np.array([[0.08, 0.03], [0.03, 0.03]])
    force = 1.5 * thigh.T @ (weight - half * inwards[0] * squares[0])
    return mass, force + shank.T @ (weight - whole * inwards[0] * squares[0] - half * inwards[1] * squares[1])


def leg_events(until: float) -> list[tuple[float, str]]:
    """Return the events of the leg's knee, from a motion in its two angles."""
    state, t, closed, events = np.array([1.2, 0.0, 0.0, 0.0]), 0.0, True, []

    def force(_: float, y: np.ndarray) -> float:
        mass, forces = leg_at(y[0], 0.0, np.array([y[2], 0.0]))
        return float(forces[1] - mass[1, 0] * forces[0] / mass[0, 0])

    def locked(_: float, y: np.ndarray) -> list[float]:
        mass, forces = leg_at(y[0], 0.0, np.array([y[2], 0.0]))
        return [y[2], 0.0, forces[0] / mass[0, 0], 0.0]

    def free(_: float, y: np.ndarray) -> np.ndarray:
        mass, forces = leg_at(y[0], y[1], y[2:])
        return np.concatenate([y[2:], np.linalg.solve(mass, forces)])

    def gap(_: float, y: np.ndarray) -> float:
        return float(-y[1]) if _ > t + 1e-6 else 1.0

    for function in (force, gap):
        function.terminal, function.direction = True, -1.0  # type: ignore[attr-defined]  # solve_ivp reads them off the function
    while t < until:
        run = solve_ivp(
            *(locked if closed else free, (t, until), state),
            method="DOP853",
            rtol=1e-13,
            atol=1e-14,
            events=force if closed else gap,
        )
        t, state = float(run.t[-1]), run.y[:, -1].copy()
        if run.status != 1:
            break
        if closed:
            events.append((t, "knee.upper.leave"))
            closed = False
            continue
        events.append((t, "knee.upper.hit"))
        mass, _ = leg_at(state[0], 0.0, state[2:])
        state[2:] -= np.linalg.solve(mass, [0.0, 1.0]) * state[3] / np.linalg.inv(mass)[1, 1]
        state[1] = state[3] = 0.0
        if force(t, state) > 0.0:
            events.append((t, "knee.upper.rest"))
            closed = True
    return events


@pytest.mark.parametrize(
    ("integrator", "coordinates"), [("dop853", "joint"), ("dop853", "absolute"), ("picard", "joint")]
)
def test_a_knee_lifts_where_its_force_passes_zero(integrator: str, coordinates: str) -> None:
    outcome = ready(described(LEG), 3.0, integrator, coordinates=coordinates).integrate()
    events = leg_events(3.0)
    assert [event.name for event in outcome.happened] == [name for _, name in events]
    assert events[0][1] == "knee.upper.leave"
    np.testing.assert_allclose([event.t for event in outcome.happened], [t for t, _ in events], rtol=0, atol=1e-9)


def test_a_rope_falls_slack_and_tightens() -> None:
    """With v^2 = 3.5 g l at the bottom it is slack from sin a = 1/2 on, for 4 v cos a / g with v^2 = g l sin a."""
    outcome = ready(described(ROPE), 3.0).integrate()
    slack, tight = outcome.happened[:2]
    assert [slack.name, tight.name] == ["rope.leave", "rope.hit"]
    speed = np.sqrt(G * 2.0 * 0.5)
    np.testing.assert_allclose(slack.state[:2], [np.sqrt(3.0), 1.0], rtol=0, atol=1e-10)
    duration = 4.0 * speed * np.cos(np.pi / 6.0) / G
    assert tight.t - slack.t == pytest.approx(duration, abs=1e-10)
    place = slack.state[:2] + slack.state[2:] * duration - [0.0, 0.5 * G * duration**2]
    np.testing.assert_allclose(tight.state[:2], place, rtol=0, atol=1e-10)
    across = np.array([-place[1], place[0]]) / 2.0
    np.testing.assert_allclose(tight.impact.v, across * (across @ tight.state[2:]), rtol=0, atol=1e-10)
    assert outcome.happened[2].name == "rope.rest"
    assert outcome.energy_drift_max < 1e-9


def test_outputs_and_the_verdict_name_stops() -> None:
    result = symgen.load(described(BALL)).simulate(until=4.0, output_step=0.5)
    assert result.status == "ok"
    assert list(result.outputs["floor.mode"]) == [0.0] * 6 + [1.0] * 3
    np.testing.assert_allclose(result.outputs["floor.force"][6:], 2.0 * G, rtol=1e-12)
    (note,) = [note for note in result.notes if "accumulate" in note]
    assert note.startswith("impacts of floor accumulate at t = 2.5586339")


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (BALL.replace("[0.0, 1.0]", "[0.0, -1.0]"), "stop floor: expected a gap of at least 0, got -1 at t = 0 s"),
        (LEG.replace("start = { angle = 0.0 }", "start = { angle = 0.1 }"), "stop knee.upper: expected a gap of"),
    ],
)
def test_starts_are_within_stops(text: str, sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        symgen.load(described(text)).simulate(until=1.0)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_friction_holds_at_a_stop_until_its_bound(coordinates: str) -> None:
    """A block of 2 kg with 3 N of friction under 8 - 4 t: the stop pushes up to 2 s, friction pulls up to 2.75 s."""
    outcome = ready(described(SLIDE), 5.0, coordinates=coordinates, max_attempts=1e5).integrate()
    assert outcome.reason == ""
    assert [event.name for event in outcome.happened][-4:] == [
        *("rail.stick", "rail.upper.rest", "rail.slip", "rail.upper.leave"),
    ]
    np.testing.assert_allclose([event.t for event in outcome.happened[-2:]], 2.75, rtol=0, atol=1e-12)
    assert outcome.states[-1][0] == pytest.approx(0.5 - 2.25**3 / 3.0, abs=1e-8)


def test_a_sweep_has_stops() -> None:
    text = BALL.replace("[bodies.ball]", "[parameters]\nbounce = 0.7\n\n[bodies.ball]")
    model, parts = symgen.load(described(text.replace("restitution = 0.7", 'restitution = "bounce"'))), (0.3, 0.6)
    settings = {"until": 1.0, "integrator": "dop853", "rtol": 1e-10, "times": [1.0]}
    rows = model.sweep({"bounce": list(parts)}, **settings)["ball.y"][:, -1]
    alone = [model.simulate(parameters={"bounce": x}, verify=False, **settings).q["ball.y"][-1] for x in parts]
    assert rows.tolist() == alone


@pytest.mark.parametrize("method", ["lagrange", "augmented-lagrangian", "hamiltonian-baumgarte", "velocity-projection"])
def test_methods_have_the_same_impacts(method: str) -> None:
    outcome = ready(described(BALL), 4.0, method=method).integrate()
    first = np.sqrt(2.0 / G)
    hits = first + 2.0 * first * np.concatenate([[0.0], np.cumsum(0.7 ** np.arange(1, 20))])
    np.testing.assert_allclose(times(outcome, "floor.hit")[:20], hits, rtol=0, atol=1e-12)
    assert outcome.happened[-1].name == "floor.rest"
    assert abs(outcome.states[-1][1]) < 1e-12


@pytest.mark.parametrize("method", ["null-space", "coordinate-partitioning", "dependent-correction"])
def test_methods_that_read_all_rows_refuse_stops(method: str) -> None:
    with pytest.raises(InputError, match="where rows may be off"):
        ready(described(BALL), 4.0, method=method)
