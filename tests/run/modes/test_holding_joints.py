"""Joints that hold for a while, beside closed forms: released, caught, broken and dropped."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.holding import CARRIAGE, CLUTCH, JUMPER, LINK, MACHINES, PENDULUM, ROPE

import symgen
from symgen.base.errors import InputError

G = 9.81
TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-14}
#: Methods and integrators of a kind each, with the largest difference from a closed form that events have.
LAWS = (
    *(("direct-correction", integrator, 1e-10) for integrator in ("picard", "dop853", "rk4", "radau5")),
    ("baumgarte", "dop853", 1e-10),
    ("ggl", "radau5", 1e-9),
    ("null-space", "dop853", 1e-10),
    ("coordinate-partitioning", "dop853", 1e-10),
    ("augmented-lagrangian", "dop853", 1e-9),
    ("lagrange", "bdf", 1e-7),
)


@pytest.fixture
def loaded(tmp_path):
    @cache
    def load(text: str) -> symgen.Model:
        (tmp_path / "model.toml").write_text(text)
        return symgen.load(tmp_path / "model.toml")

    return load


def steps_of(integrator: str) -> dict[str, float]:
    tight = {"rtol": 1e-12, "atol": 1e-12}
    return {"step": 1e-3} if integrator == "rk4" else {"rtol": 1e-9} if integrator == "bdf" else tight


def swing(t0: float) -> tuple[float, float]:
    """Return angle below the horizontal, and its rate, of a pendulum of 1 m after a time."""
    found = solve_ivp(lambda _, y: [y[1], G * np.cos(y[0])], (0.0, t0), [0.0, 0.0], "DOP853", rtol=1e-13, atol=1e-14)
    return float(found.y[0, -1]), float(found.y[1, -1])


@pytest.mark.by_turns(4)
@pytest.mark.fast("direct-correction-dop853-1e-10-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(("method", "integrator", "most"), LAWS)
def test_a_released_pendulum_is_a_projectile(method, integrator, most, coordinates, loaded) -> None:
    angle, rate = swing(0.3)
    run = loaded(PENDULUM).simulate(
        method=method,
        integrator=integrator,
        coordinates=coordinates,
        times=[0.2, 0.3, 0.65, 1.0],
        **steps_of(integrator),
    )
    assert run.ok and [(e.name, e.t) for e in run.events] == [("rod.releases", pytest.approx(0.3, abs=1e-12))]
    x, y = np.cos(angle), -np.sin(angle)
    vx, vy = -np.sin(angle) * rate, -np.cos(angle) * rate
    late = run.t[2:] - 0.3
    np.testing.assert_allclose(run["bob.x"][2:], x + vx * late, rtol=0, atol=most)
    np.testing.assert_allclose(run["bob.y"][2:], y + vy * late - 0.5 * G * late**2, rtol=0, atol=most)
    assert run["rod.mode"].tolist() == [1.0, 0.0, 0.0, 0.0] and not run["rod.dissipated"].any()
    assert run["multiplier.rod.distance"][2:].tolist() == [0.0, 0.0]


def shared(speeds: tuple[float, float]) -> tuple[float, float]:
    """Return the common speed of rotors of 2 and 1 kg m^2 after a catch, and the energy that it takes."""
    return (2.0 * speeds[0] + speeds[1]) / 3.0, (speeds[0] - speeds[1]) ** 2 / 3.0


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_clutch_of_teeth_engages_twice(coordinates, loaded) -> None:
    """Speeds after (J1 w1 + J2 w2)/(J1 + J2); angles stay as they are at each catch; a motor drives one between."""
    run = loaded(CLUTCH).simulate(coordinates=coordinates, times=[0.05, 0.2, 0.4, 0.6, 1.0])
    first, lost = shared((3.0, -1.0))
    second, more = shared((first + 4.0 * 0.2 / 2.0, first))
    np.testing.assert_allclose(run["a.omega"], [3.0, first, first + 0.2, second, second], rtol=0, atol=1e-12)
    np.testing.assert_allclose(run["b.omega"], [-1.0, first, first, second, second], rtol=0, atol=1e-12)
    np.testing.assert_allclose(run["teeth.dissipated"], [0.0, lost, lost, lost + more, lost + more], rtol=0, atol=1e-12)
    between = run["b.theta"] - run["a.theta"]
    np.testing.assert_allclose(between[[1, 3, 4]], [0.0, -0.04, -0.04], rtol=0, atol=1e-12)
    assert run["teeth.mode"].tolist() == [0.0, 1.0, 0.0, 1.0, 1.0]
    assert np.abs(run.energy_error).max() < 1e-12
    names = [(event.name, round(event.t, 12)) for event in run.events]
    assert names == [("teeth.holds", 0.1), ("teeth.releases", 0.3), ("teeth.holds", 0.5)]
    assert run.events[0].work == pytest.approx(-lost, abs=1e-13)


def test_a_carriage_drops_what_swings_from_it(loaded) -> None:
    """After the release the body flies and turns as it did, and the carriage goes on at its speed."""
    run = loaded(CARRIAGE).simulate(**TIGHT)
    (event,) = run.events
    q, v, late = event.q, event.v, run.t[-1] - event.t
    assert event.name == "hook.releases" and q["carriage.x"] == pytest.approx(0.5, abs=1e-13)
    assert run["load.x"][-1] == pytest.approx(q["load.x"] + v["load.vx"] * late, abs=1e-12)
    assert run["load.y"][-1] == pytest.approx(q["load.y"] + v["load.vy"] * late - 0.5 * G * late**2, abs=1e-12)
    assert run["load.theta"][-1] == pytest.approx(q["load.theta"] + v["load.omega"] * late, abs=1e-12)
    assert run["carriage.x"][-1] == pytest.approx(0.5 + v["carriage.vx"] * late, abs=1e-12)
    assert np.abs(run.energy_error).max() < 1e-10


def test_a_jumper_falls_and_swings_on_a_cord(loaded) -> None:
    """Free fall by 20 m, then a harmonic motion about 80 g/120 below."""
    run = loaded(JUMPER).simulate(times=[0.4, 1.5, 4.0, 5.5], until=5.5, **TIGHT)
    touch, speed, omega, sag = 0.5 + np.sqrt(40.0 / G), np.sqrt(40.0 * G), np.sqrt(120.0 / 80.0), 80.0 * G / 120.0
    late = run.t[2:] - touch
    swung = -20.0 - sag + sag * np.cos(omega * late) - speed / omega * np.sin(omega * late)
    np.testing.assert_allclose(run["jumper.y"], [0.0, -0.5 * G, *swung], rtol=0, atol=1e-9)


def test_a_link_breaks_by_its_force(loaded) -> None:
    """200 t N reach 50 N at 0.25 s, from which on 100 t m/s^2 act; it never holds again."""
    run = loaded(LINK).simulate(times=[0.2, 0.4, 0.6], **TIGHT)
    late = run.t[1:] - 0.25
    np.testing.assert_allclose(run["block.x"], [0.0, *(12.5 * late**2 + 100.0 / 6.0 * late**3)], rtol=0, atol=1e-11)
    assert [(e.name, e.t) for e in run.events] == [("link.releases", pytest.approx(0.25, abs=1e-12))]


def test_a_rope_takes_the_speed_along_it(loaded) -> None:
    run = loaded(ROPE).simulate(**TIGHT)
    catch, release = run.events
    x, y, vx, vy = (catch.q | catch.v)["ball.x"], catch.q["ball.y"], catch.v["ball.vx"], catch.v["ball.vy"]
    assert np.hypot(x, y) == pytest.approx(1.0, abs=1e-12)
    along, lost = x * vx + y * vy, run["rope.dissipated"][-1]
    assert lost == pytest.approx(along**2, abs=1e-12)
    assert catch.v_after is not None
    assert catch.v_after["ball.vx"] == pytest.approx(vx - along * x, abs=1e-12)
    assert release.t == pytest.approx(0.9, abs=1e-12)
    assert np.abs(run.energy_error).max() < 1e-10


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("machine", "name", "values", "until"),
    [
        ("pendulum", "t0", (0.05, 0.95), 1.0),
        ("clutch", "te", (0.01, 0.29), 0.29),
        ("carriage", "place", (0.05, 0.85), 0.6),
        ("link", "strength", (5.0, 100.0), 0.6),
        ("rope", "length", (0.6, 1.4), 0.85),
    ],
)
def test_sweeps_are_smooth_and_equal_runs(machine, name, values, until, loaded) -> None:
    """300 values of a time, a place, a force and a length: none fails, differences fall with their order."""
    model, numbers = loaded(MACHINES[machine]), np.linspace(*values, 300)
    body = {"pendulum": "bob", "clutch": "b", "carriage": "load", "link": "block", "rope": "ball"}[machine]
    column = f"{body}.theta" if machine == "clutch" else f"{body}.x"
    keys = {"until": until, "integrator": "dop853", "rtol": 1e-10, "atol": 1e-12}
    swept = symgen.sweep(model, {name: numbers}, quantities=[column], **keys)
    assert set(swept.status.tolist()) == {"ok"}
    ends = np.asarray(swept[column]).reshape(300)
    rough = np.abs(np.diff(ends, 4)).max()
    assert rough < 2e-5 * np.ptp(ends), rough
    for k in (0, 137, 299):
        assert ends[k] == model.simulate(parameters={name: numbers[k]}, **keys)[column][-1]


@pytest.mark.parametrize(
    ("machine", "change", "sentence"),
    [
        (
            "clutch",
            ('holds_at = "present"\n', ""),
            "expected a joint in its place where it catches, got one that is off",
        ),
        ("clutch", ('"t > te and t < 0.3 or t > 0.5"', '"a.omega < 2.0 or t > te"'), "ok"),
        (
            "clutch",
            ('"t > te and t < 0.3 or t > 0.5"', '{ during = "t > te and a.omega > 2.0", at_start = false }'),
            "expected a condition that the catch leaves true, got one that it makes false at t = 0.1 s; two conditions",
        ),
        (
            "rope",
            ("holds = {", "holds = 'sqrt(ball.x**2 + ball.y**2) > length' #"),
            "expected a condition that goes on to change where the joint holds",
        ),
    ],
)
def test_catches_that_cannot_be_end_a_run_with_a_sentence(machine, change, sentence, loaded) -> None:
    assert change[0] in MACHINES[machine]
    run = loaded(MACHINES[machine].replace(*change)).simulate()
    if sentence == "ok":
        assert run.ok
        return
    assert run.status == "failed" and sentence in run.reason, run.reason


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('"t < t0"', '"t - t0"', "joints.rod.holds: expected a condition such as 't < 0.3', got 't - t0'"),
        ('"t < t0"', "{ whlie = 't < t0' }", "the unknown key 'whlie'"),
        ('"t < t0"', "{ at_start = true }", "expected a condition: during, catches or releases, got none"),
        ('"t < t0"', "{ during = 't < 1', releases = 't > 1' }", "expected the condition during, or catches and"),
        ('"t < t0"', "3.0", "joints.rod.holds: expected a condition such as"),
        ('holds = "t < t0"', 'holds_at = "present"', "holds_at: expected the key holds beside it"),
        ('holds = "t < t0"', 'holds = "t < 1"\nholds_at = "here"', "holds_at: expected 'described' or 'present'"),
        ('"t < t0"', '"rod.rate < 1"', "joints.rod.holds"),
    ],
)
def test_wrong_keys_are_refused(old, new, sentence, loaded) -> None:
    with pytest.raises(InputError) as error:
        loaded(PENDULUM.replace(old, new))
    assert sentence in str(error.value)


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("machine", "name", "columns"),
    [
        ("pendulum", "t0", ("bob.x", "bob.vy")),
        ("clutch", "te", ("b.theta", "a.omega", "teeth.dissipated")),
        ("carriage", "place", ("load.x", "load.omega")),
        ("link", "strength", ("block.x",)),
        ("rope", "length", ("ball.x", "ball.vy", "rope.dissipated")),
        ("docking", "spin", ("b.x", "a.omega", "weld.dissipated")),
    ],
)
def test_derivatives_pass_through_releases_and_catches(machine, name, columns, coordinates, loaded) -> None:
    """Forward directions and the adjoint beside central differences."""
    model = loaded(MACHINES[machine])
    keys = {"coordinates": coordinates, **TIGHT}
    run = model.simulate(sensitivities=(name,), **keys)
    assert run.ok, run.reason
    value, h = model.parameters()[name], 1e-5
    ends = [model.simulate(parameters={name: value + way * h}, **keys) for way in (1.0, -1.0)]
    for column in columns:
        by = float(run.gradient(column).values[-1, 0])
        difference = (ends[0][column][-1] - ends[1][column][-1]) / (2.0 * h)
        assert by == pytest.approx(difference, rel=1e-6, abs=1e-7), column
        back = model.gradient(column, by=(name,), way="adjoint", **keys)
        assert back.by[name] == pytest.approx(by, rel=1e-8, abs=1e-9), column


def number_of(stepped, column: str) -> float:
    """Return a coordinate or velocity of a run that is stepped."""
    return float(stepped.bodies[column])


@pytest.mark.slow_cases("pendulum")
@pytest.mark.parametrize("machine", ["pendulum", "clutch", "rope", "docking"])
def test_steps_equal_a_run(machine, loaded) -> None:
    """Pieces of a run, saved and gone back to between, and a run that goes on from another one."""
    model = loaded(MACHINES[machine])
    whole, stepped = model.simulate(integrator="rk4", step=1e-3), model.start(integrator="rk4", step=1e-3)
    until = model.mechanism.defaults.until
    stepped.step(0.35)
    saved = stepped.save()
    stepped.step(0.25)
    stepped.restore(saved)
    stepped.step(until - 0.35)
    body = {"pendulum": "bob", "clutch": "b", "rope": "ball", "docking": "b"}[machine]
    for column in (f"{body}.x", f"{body}.vy"):
        assert number_of(stepped, column) == pytest.approx(whole[column][-1], rel=0, abs=1e-13)
    first = model.simulate(integrator="rk4", step=1e-3, until=0.6)
    second = model.simulate(integrator="rk4", step=1e-3, start=first, until=until)
    assert second[f"{body}.x"][-1] == pytest.approx(whole[f"{body}.x"][-1], rel=0, abs=1e-13)


def test_functions_and_modes_take_a_joint_as_it_is_at_the_start(loaded) -> None:
    """A load that hangs has two coordinates with the carriage, one that has been dropped four, and no frequency."""
    held, free = loaded(CARRIAGE), loaded(CARRIAGE.replace('"carriage.x < place"', '"carriage.x > place"'))
    assert [len(x.functions("absolute").rows) for x in (held, free)] == [4, 2]
    hanging = held.modes()
    assert hanging.frequencies.max() * 2.0 * np.pi == pytest.approx(
        np.sqrt(1.0 * G * 0.5 / (0.05 + 0.25 - 0.25 / 4.0)), rel=1e-9
    )


@pytest.mark.slow
def test_a_start_that_is_not_the_described_one_says_what_holds(loaded) -> None:
    """A condition on positions is that of the bodies' tables; a run that goes on from another one knows what holds."""
    model = loaded(CARRIAGE)
    with pytest.raises(
        InputError, match=r"joints\.hook\.holds: expected the key at_start, .* got start of carriage\.x;"
    ):
        model.simulate(start={"carriage.x": 1.0})
    assert model.simulate(until=0.1, start={"carriage.vx": 0.5}).ok
    assert model.simulate(until=0.6, start=model.simulate(until=0.5)).ok
    told = loaded(CARRIAGE.replace('"carriage.x < place"', '{ during = "carriage.x < place", at_start = false }'))
    assert told.simulate(until=0.1, start={"carriage.x": 1.0})["hook.mode"][-1] == 0.0
