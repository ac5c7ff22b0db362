"""Stops against closed forms and event-driven references."""

import copy
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.checks import assert_same_motion
from support.ending import Ending

import symgen
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.describe.files.load import parse_toml, read_raw
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism
from symgen.run.planning.prepare import Prepared, prepare

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
    constant = {"rk4": {"step": 4e-3}, "gauss": {"step": 1e-3, "method": "symmetric-projection"}}
    steps = constant.get(integrator, {"rtol": 1e-12, "atol": 1e-12})
    return prepare(mechanism, Settings(integrator=integrator, until=until, verify=False, **steps | settings))


def times(outcome: Any, name: str) -> np.ndarray:
    return np.array([event.t for event in outcome.happened if event.name == name])


def multiplier(outcome: Any, row: str) -> float:
    place = [r.name for r in outcome.compiled.info.rows].index(row)
    return float(outcome.compiled.section(outcome.w, "multipliers")[place])


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("integrator", ["dop853", "picard", "radau5", "rk4", "gauss"])
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


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("integrator", "coordinates"),
    [("dop853", "absolute"), ("picard", "joint"), ("radau5", "joint"), ("gauss", "absolute"), ("gauss", "joint")],
)
def test_a_four_bar_strikes_a_stop_of_its_crank(integrator: str, coordinates: str) -> None:
    """Impacts, their end and the torque at rest of an event-driven reference in one coordinate."""
    outcome = ready(four_bar(), 6.0, integrator, coordinates=coordinates).integrate()
    hits = times(outcome, "A.lower.hit")
    np.testing.assert_allclose(hits[:3], [1.3417148338025, 2.459850077041, 3.163183939102], rtol=0, atol=1e-11)
    rest = outcome.happened[-1]
    assert rest.name == "A.lower.rest"
    assert abs(rest.t + rest.left - 4.2510652271) < 2e-10
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

    while t < until:
        run = solve_ivp(
            *(locked if closed else free, (t, until), state),
            method="DOP853",
            rtol=1e-13,
            atol=1e-14,
            events=Ending(force if closed else gap, -1.0),
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


@pytest.mark.by_turns(3)
@pytest.mark.slow
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


@pytest.mark.parametrize("text", [BALL.replace("0.7", "0.0"), ROPE])
def test_an_impact_without_rebound_accumulates_nothing(text: str) -> None:
    """A ball that stays down and a rope that gets tight: events, and no note on times of 0 s."""
    result = symgen.load(described(text)).simulate(until=2.5)
    assert [event.name.rpartition(".")[2] for event in result.events][-2:] == ["hit", "rest"]
    assert result.notes == ()


def test_stops_that_strike_at_once_say_what_newton_s_law_does() -> None:
    """Three balls on a rail, two of them in touch: by Newton's law all gaps open at once, no cradle."""
    balls = "".join(
        f'[bodies.{name}]\ntype = "point"\nmass = 1.0\nposition = [{x}, 0.0]\nvelocity = [{v}, 0.0]\n'
        f'[joints.rail_{name}]\ntype = "rows"\nrows = [{{ position = "{name}.y" }}]\n'
        for name, x, v in (("a", 0.0, 1.0), ("b", 2.0, 0.0), ("c", 3.0, 0.0))
    )
    gaps = "".join(f'[stops.{x}{y}]\ngap = "{y}.x - {x}.x - 1"\nrestitution = 1.0\n' for x, y in ("ab", "bc"))
    result = symgen.load(described(f'[mechanism]\nname = "cradle"\n{balls}{gaps}')).simulate(until=2.0)
    np.testing.assert_allclose([result[f"{x}.vx"][-1] for x in "abc"], [-1 / 3, 2 / 3, 2 / 3], atol=1e-12)
    (note,) = [note for note in result.notes if "at once" in note]
    assert note.startswith("ab and bc strike at once at t = 1 s: by Newton's law each gap opens")
    alone = symgen.load(described(BALL)).simulate(until=2.0)
    assert not any("at once" in note for note in alone.notes)


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
        *("rail.stick", "rail.upper.rest", "rail.upper.leave", "rail.slip"),
    ]
    np.testing.assert_allclose([event.t for event in outcome.happened[-2:]], [2.0, 2.75], rtol=0, atol=1e-12)
    assert outcome.states[-1][0] == pytest.approx(0.5 - 2.25**3 / 3.0, abs=1e-8)


#: Events of the first row, and what is read: of a ball that bounces and rests, one whose floor drops it again, a
#: four-bar with dry pins against a stop, and a block with friction and a stop that resets push.
def _falling() -> Mechanism:
    text = BALL.replace("[bodies.ball]", "[parameters]\npart = 0.7\n\n[bodies.ball]")
    return described(text.replace("restitution = 0.7", 'restitution = "part"'))


def _dry_linkage() -> Mechanism:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["parameters"]["part"] = 0.6
    raw["joints"]["A"] |= {"stop": {"lower": -1.0, "restitution": "part"}, "friction": {"sliding": 2.0, "static": 3.0}}
    raw["joints"]["D"]["friction"] = {"sliding": 1.0}
    return validate(raw, source)


def _pushed() -> Mechanism:
    text = SLIDE.replace("[bodies.block]", "[parameters]\npart = 0.5\n\n[bodies.block]")
    text += """
[events.push]
when = "block.x - 0.3*part"
direction = "rising"
reset = { "block.vx" = "1.0 + part" }
"""
    return described(text)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("make", "integrator", "coordinates", "settings"),
    [
        (_falling, "dop853", "absolute", {"until": 3.5, "rtol": 1e-10, "times": [0.0, 1.0, 2.0, 3.5]}),
        (_falling, "rk4", "absolute", {"until": 3.0, "step": 1e-2, "times": [1.0, 3.0]}),
        (_dry_linkage, "dop853", "absolute", {"until": 5.0, "times": [2.0, 5.0]}),
        (_dry_linkage, "picard", "joint", {"until": 5.0, "times": [2.0, 5.0]}),
        (_pushed, "dop853", "absolute", {"until": 3.0, "times": [0.5, 3.0], "max_attempts": 1e5}),
    ],
)
def test_rows_of_a_sweep_have_the_impacts_of_single_runs(
    make: Any, integrator: str, coordinates: str, settings: dict[str, Any]
) -> None:
    """In the compiled loop, without Python between two parts of a run: bit for bit."""
    model, parts = symgen.Model(make()), (0.3, 0.5, 0.62)
    settings = {"integrator": integrator, "coordinates": coordinates, **settings}
    alone = [model.simulate(parameters={"part": x}, verify=False, **settings) for x in parts]
    assert all(sum(event.name.endswith("hit") for event in run.events) > 1 for run in alone)
    names = ("q", "v", *(name for name in alone[0].outputs if name.endswith(("mode", "force"))), "energy.error")
    rows = model.sweep({"part": list(parts)}, quantities=names, **settings)
    for i, run in enumerate(alone):
        assert (rows.status[i], rows.reason[i] or "") == (run.status, run.reason or "")
        assert [rows[name][i] for name in ("steps", "evaluations")] == [run.steps, run.evaluations]
        for name in run.q:
            assert rows[name][i].tolist() == run[name].tolist(), name
        for name in run.v:
            assert rows[name][i].tolist() == run[name].tolist(), name
        for name in names[2:]:
            np.testing.assert_allclose(rows[name][i], run[name], rtol=1e-10, atol=1e-10)


@pytest.mark.slow
@pytest.mark.slow_cases("steps1")
@pytest.mark.parametrize("steps", [{"integrator": "dop853"}, {"integrator": "rk4", "step": 1e-2}])
def test_an_impact_at_the_start(steps: dict[str, Any]) -> None:
    """A ball that is thrown from the floor into it: the run and its balance of energies begin behind the impact."""
    text = BALL.replace("[bodies.ball]", "[parameters]\npart = 0.7\n\n[bodies.ball]").replace(
        "= 0.7\n\n[s", "= 0.7\n[s"
    )
    text = text.replace("position = [0.0, 1.0]", "position = [0.0, 0.0]\nvelocity = [0.0, -1.0]")
    model, settings = symgen.load(described(text)), {"until": 0.15, "times": [0.0, 0.1, 0.15], **steps}
    run = model.simulate(verify=False, **settings)
    assert run.status == "ok" and run.energy_drift_max < 1e-13
    np.testing.assert_allclose([event.t for event in run.events], [0.0, 1.4 / G], rtol=0, atol=1e-13)
    height = np.array([0.0, 0.07, 0.49 * (0.15 - 1.4 / G)]) - G / 2 * np.array([0.0, 0.1, 0.15 - 1.4 / G]) ** 2
    np.testing.assert_allclose(run["ball.y"], height, rtol=0, atol=1e-13)
    rows = model.sweep({"part": [0.7]}, quantities=("ball.y", "energy.error"), **settings)
    assert rows.status[0] == "ok" and rows["ball.y"][0].tolist() == run["ball.y"].tolist()


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("steps", [{"integrator": "dop853"}, {"integrator": "rk4", "step": 1e-2}])
def test_rows_with_stops_are_examined_where_constraints_may_jump(steps: dict[str, Any]) -> None:
    """A ball on a wire with a corner at 0.8 m, which some rows have: they fail there, with the words of single runs."""
    text = BALL.replace("[bodies.ball]", "[parameters]\ncorner = 0.0\n\n[bodies.ball]")
    wire = '{ position = "ball.x - (0.1*abs(ball.y - 0.8)*(ball.y - 0.8) + corner*abs(ball.y - 0.8))" }'
    text = text.replace('{ position = "ball.x" }', wire).replace("[0.0, 1.0]", '["0.004 + 0.2*corner", 1.0]')
    model, corners = symgen.load(described(text)), (0.0, 0.3, 0.1)
    settings = {"until": 1.2, "times": [0.1, 0.6, 1.2], **steps}
    alone = [model.simulate(parameters={"corner": x}, verify=False, **settings) for x in corners]
    assert [run.status for run in alone] == ["ok", "failed", "failed"] and "floor.hit" in alone[0].events[0].name
    rows = model.sweep({"corner": list(corners)}, quantities=("q",), **settings)
    for i, run in enumerate(alone):
        assert (rows.status[i], rows["steps"][i], rows["evaluations"][i]) == (run.status, run.steps, run.evaluations)
        assert_same_motion(rows["ball.y"][i][: len(run.t)], run["ball.y"], "ball.y")


@pytest.mark.slow_cases("null-space", "coordinate-partitioning")
@pytest.mark.parametrize(
    "method",
    [
        *("lagrange", "augmented-lagrangian", "hamiltonian-baumgarte", "velocity-projection"),
        *("null-space", "coordinate-partitioning", "dependent-correction"),
    ],
)
def test_methods_have_the_same_impacts(method: str) -> None:
    outcome = ready(described(BALL), 4.0, method=method).integrate()
    first = np.sqrt(2.0 / G)
    hits = first + 2.0 * first * np.concatenate([[0.0], np.cumsum(0.7 ** np.arange(1, 20))])
    np.testing.assert_allclose(times(outcome, "floor.hit")[:20], hits, rtol=0, atol=1e-12)
    assert outcome.happened[-1].name == "floor.rest"
    assert abs(outcome.states[-1][1]) < 1e-12


@pytest.mark.parametrize("method", ["rattle", "half-explicit"])
def test_methods_that_read_all_rows_refuse_stops(method: str) -> None:
    with pytest.raises(InputError, match="where rows may be off"):
        ready(described(BALL), 4.0, method=method, integrator=method, step=1e-3)


def test_a_low_flight_ends_by_its_own_impact() -> None:
    """It rises to 9e-13 m, which counts as zero; that a slider strikes a wall meanwhile does not end it."""
    text = BALL.replace("-9.81", "-1e-3").replace("[0.0, 1.0]", "[0.0, 1e-3]").replace("0.7", "3e-5")
    text = text.replace('"ball.x" }', '"ball.x" }, { position = "slider.y" }')
    slider = '[bodies.slider]\ntype = "point"\nmass = 1.0\nposition = [1.0, 0.0]\nvelocity = [-1.0, 0.0]\n'
    wall = '[stops.wall]\ngap = "slider.x + 0.41427756"\nrestitution = 1.0\n'
    result = symgen.load(described(text + slider + wall)).simulate(until=1.5)
    hits = [(event.name, event.t) for event in result.events if event.name.endswith("hit")]
    assert [name for name, _ in hits] == ["floor.hit", "wall.hit", "floor.hit"]
    assert abs(hits[2][1] - np.sqrt(2.0) * (1.0 + 6e-5)) < 1e-10
