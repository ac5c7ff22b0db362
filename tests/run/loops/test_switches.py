"""What forces and integrands compare over the state: parts of a motion that begin and end inside a step are seen."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.checks import assert_same_motion
from support.emitted import mechanism_of

import symgen
from symgen.describe.facts.keys_for_jumps import advice_on_jumps
from symgen.run.compiling.events import compile_events
from symgen.run.layout import abi
from symgen.study.ensemble.parameter_sweep import sweep

#: Two kilograms under 3 N, and what is added between two values, beside an oscillation that has steps of usual length.
WINDOW = """[mechanism]
name = "window"
gravity = [0.0, 0.0]
[parameters]
low = 0.3
high = 0.31
[bodies.bob]
type = "point"
mass = 2.0
position = [0.0, 0.5]
velocity = [0.5, 0.0]
[forces.push]
type = "force"
body = "bob"
force = ["FORCE", "-400*bob.y"]
"""
OVER_SPEED = "3 + 5*(1 if low < bob.vx and bob.vx < high else 0)"
OVER_PLACE = "3 + 5*(1 if low < bob.x and bob.x < high else 0)"
BUMP = "60*max(0, 1 - abs(2*bob.x - low - high)/(high - low))"
OVER_TABLE = "wide(bob.x)"
TABLE = """[tables.wide]
x = [0.0, 0.1, 0.2, 0.35, 1.0]
y = [3.0, 1.0, 5.0, -2.0, 2.0]
interpolation = "linear"
"""
OVER_TIME = "3 + 5*(1 if low < t and t < high else 0)"
TIMES = np.linspace(0.05, 0.8, 16)
ADAPTIVE = ("abm", "dop853", "dopri5", "picard", "radau5", "sdirk")


def speeds(low: float, high: float, where: str) -> np.ndarray:
    """Speeds at the times, in closed form."""
    begin = (low - 0.5) / 1.5 if where == "speed" else low
    end = begin + (high - low) / 4.0 if where == "speed" else high
    inside = np.clip(TIMES, begin, end) - begin
    return 0.5 + 1.5 * TIMES + 2.5 * inside


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("switches")


def made(folder: Path, force: str, more: str = "") -> symgen.Model:
    file = folder / f"w{abs(hash(force + more))}.toml"
    file.write_text(WINDOW.replace("FORCE", force) + more, encoding="utf-8")
    return symgen.load(file)


def pushed(
    model: symgen.Model, integrator: str, low: float, high: float, times: Sequence[float] | np.ndarray = TIMES
) -> symgen.Result:
    """A run of 0.8 s at a tolerance of 1e-8."""
    parameters = {"low": low, "high": high}
    return model.simulate(
        method="lagrange", integrator=integrator, rtol=1e-8, times=times, until=0.8, parameters=parameters
    )


@pytest.mark.fast(
    "3 + 5*(1 if low < bob.vx and bob.vx < high else 0)-speed-dop853",
    "3 + 5*(1 if low < t and t < high else 0)-time-abm",
    "3 + 5*(1 if low < t and t < high else 0)-time-dopri5",
    "3 + 5*(1 if low < t and t < high else 0)-time-picard",
    "3 + 5*(1 if low < t and t < high else 0)-time-radau5",
    "3 + 5*(1 if low < t and t < high else 0)-time-sdirk",
)
@pytest.mark.parametrize("integrator", ADAPTIVE)
@pytest.mark.parametrize(("force", "where"), [(OVER_SPEED, "speed"), (OVER_TIME, "time")])
def test_short_pushes_are_not_stepped_over(folder: Path, integrator: str, force: str, where: str) -> None:
    """They were at a third of the places: off by 1e-2 m/s, and `ok`."""
    model, shift = made(folder, force), 0.5 if where == "speed" else 0.0
    for place in np.linspace(0.031, 0.67, 9):
        for width in (0.002, 0.008):
            low = shift + place
            result = pushed(model, integrator, low, low + width)
            assert result.status == "ok", result.reason
            np.testing.assert_allclose(result["bob.vx"], speeds(low, low + width, where), rtol=0.0, atol=2e-5)


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_runs_step_by_step_do_not_step_over_them(folder: Path, integrator: str) -> None:
    model = made(folder, OVER_SPEED)
    for low in (0.55, 0.81, 1.07):
        changed = {"low": low, "high": low + 0.004}
        run = model.start(method="lagrange", integrator=integrator, rtol=1e-8, parameters=changed)
        for k, expected in enumerate(speeds(low, low + 0.004, "speed")):
            if k == 5:
                saved = run.save()
            run.run(TIMES[k])
            assert run.bodies["bob.vx"] == pytest.approx(expected, abs=2e-5)
        run.restore(saved)
        run.step(TIMES[-1] - TIMES[4])
        assert run.bodies["bob.vx"] == pytest.approx(expected, abs=2e-5)


@pytest.mark.slow_cases("1 if low < bob.x and bob.x < high else 0-1.0-abm")
@pytest.mark.parametrize("integrator", ADAPTIVE)
@pytest.mark.parametrize(
    ("integrand", "area"),
    [
        ("1 if low < bob.x and bob.x < high else 0", 1.0),
        ("(sign(bob.x - low) - sign(bob.x - high))/2", 1.0),
        ("max(0, 1 - abs(2*bob.x - low - high)/(high - low))", 0.5),
    ],
)
def test_short_parts_of_integrands_are_not_stepped_over(
    folder: Path, integrator: str, integrand: str, area: float
) -> None:
    """Nothing acts on the motion: with `abm` and implicit schemes nothing was added up, with others by chance."""
    model = made(folder, "0", f'[outputs]\nnarrow = "integral({integrand})"\n')
    for low in np.linspace(0.02, 0.36, 7):
        result = pushed(model, integrator, low, low + 0.002, [0.8])
        assert result.status == "ok", result.reason
        assert abs(result["narrow"][-1] - area * 0.004) < 1e-6


@pytest.mark.parametrize("integrator", ADAPTIVE)
@pytest.mark.parametrize("width", [0.0005, 0.003])
def test_bumps_are_not_stepped_over(folder: Path, integrator: str, width: float) -> None:
    """The work of a bump in the way gives the speed behind it: `abm` missed one in three, passed at its middle."""
    model = made(folder, BUMP)
    for low in np.linspace(0.02, 0.33, 7):
        result = pushed(model, integrator, low, low + width, [0.8])
        assert abs(result["bob.vx"][-1] - math.sqrt(0.25 + 30.0 * width)) < 1e-5


@pytest.mark.parametrize("integrator", ["dopri5", "radau5"])
def test_events_behind_short_pushes(folder: Path, integrator: str) -> None:
    """What stops a run, and what is noted, inside the push and behind it."""
    model = made(folder, OVER_SPEED)
    low, high = 0.8113, 0.8153
    begin, end = (low - 0.5) / 1.5, (low - 0.5) / 1.5 + 0.001
    result = model.simulate(
        method="lagrange",
        integrator=integrator,
        rtol=1e-9,
        times=TIMES,
        until=0.8,
        parameters={"low": low, "high": high},
        record_when=("bob.vx > 0.8133",),
        stop_when=("bob.vx > 1.2",),
    )
    times = [event.t for event in result.events]
    np.testing.assert_allclose(times, [begin + 0.0005, end + (1.2 - high) / 1.5], rtol=0.0, atol=1e-7)


def test_what_is_passed_alone_changes_no_step(folder: Path) -> None:
    """One switch a step is what the error estimate sees; a force beside it that compares nothing has the same steps."""
    settings = {"method": "lagrange", "rtol": 1e-8, "until": 0.8, "times": [0.8]}
    for integrator in ADAPTIVE:
        compared = made(folder, "3*(1 if bob.x > -1 else 0)").simulate(integrator=integrator, **settings)
        plain = made(folder, "3").simulate(integrator=integrator, **settings)
        assert (compared.steps, compared.rejected) == (plain.steps, plain.rejected)
        assert compared["bob.x"][-1] == plain["bob.x"][-1]


def test_kinks_of_a_force_that_does_nothing_leave_rebounds_as_they_are(folder: Path) -> None:
    """Velocities jump across what the force compares: that is no passage of it."""
    rebound = """[events.floor]
when = "bob.x < 0"
reset = { "bob.vx" = "-0.8*bob.vx" }
"""
    settings = {"method": "lagrange", "integrator": "radau5", "rtol": 1e-8, "until": 0.8, "times": [0.8]}
    found = []
    for force in ("-9", "-9 + 1e-40*(abs(bob.vx) + abs(bob.vx + 0.3))"):
        file = folder / "rebound.toml"
        text = WINDOW.replace("FORCE", force).replace("position = [0.0, 0.5]", "position = [0.2, 0.5]")
        file.write_text(text + rebound, encoding="utf-8")
        result = symgen.load(file).simulate(**settings)
        assert result.status == "ok" and result.events
        found.append([*(event.t for event in result.events), result["bob.x"][-1]])
    np.testing.assert_allclose(*found, rtol=1e-9)


@pytest.mark.by_turns(8)
@pytest.mark.fast(
    "3 + 5*(1 if low < t and t < high else 0)-0.0-dopri5-joint",
    "60*max(0, 1 - abs(2*bob.x - low - high)/(high - low))-0.0-dop853-joint",
    "60*max(0, 1 - abs(2*bob.x - low - high)/(high - low))-0.0-dopri5-absolute",
    "wide(bob.x)-0.0-dopri5-absolute",
)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("integrator", ["dop853", "dopri5"])
@pytest.mark.parametrize(
    ("force", "shift"), [(OVER_SPEED, 0.5), (OVER_PLACE, 0.0), (OVER_TIME, 0.0), (BUMP, 0.0), (OVER_TABLE, 0.0)]
)
def test_rows_of_sweeps_are_single_runs(
    folder: Path, force: str, shift: float, integrator: str, coordinates: str
) -> None:
    settings = {"method": "lagrange", "integrator": integrator, "rtol": 1e-8, "until": 0.8, "times": [0.4, 0.8]}
    settings["coordinates"] = coordinates
    model = made(folder, force, TABLE if force == OVER_TABLE else "")
    lows = np.array([0.05, 0.2, 0.3137]) + shift
    runs = {"low": lows, "high": lows + 0.003}
    found = sweep(model, runs=runs, quantities=["bob.x", "bob.vx"], **settings)
    for r, (low, high) in enumerate(zip(*runs.values(), strict=True)):
        alone = model.simulate(**settings, parameters={"low": low, "high": high})
        assert_same_motion(found.values[r], [alone["bob.x"], alone["bob.vx"]])
        for name in ("steps", "rejected", "evaluations"):
            assert found[name][r] == getattr(alone, name)


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_a_push_in_a_step_that_a_reset_ends_is_not_stepped_over(folder: Path, integrator: str) -> None:
    """It was off by up to 0.1 m/s at 1e-8, and `ok`: what was seen was the state behind the reset."""
    wall = """[events.wall]
when = "bob.x > 0.4"
reset = { "bob.vx" = "-bob.vx" }
"""
    model = made(folder, "8*(1 if low < bob.x and bob.x < high and bob.vx > 0 else 0)", wall)
    settings = {"method": "lagrange", "integrator": integrator, "rtol": 1e-8, "until": 1.2, "times": [1.2]}
    for low in np.linspace(0.33, 0.397, 5):
        result = model.simulate(**settings, parameters={"low": low, "high": low + 0.0005})
        assert result["bob.vx"][-1] == pytest.approx(-math.sqrt(0.25 + 8.0 * 0.0005), abs=1e-5)


#: A point that falls sideways past a spring of its free length, which leaves that by the fourth power of time.
AT_ITS_LENGTH = """[mechanism]
name = "kink"
gravity = [0.0, -9.81]
[bodies.p]
type = "point"
mass = 1.0
position = [2.0, 0.0]
[forces.coil]
type = "spring-damper"
between = ["ground", "p"]
at = [[0.0, 0.0], "centre"]
stiffness = 50.0
free_length = 2.0
"""
SQUARE, ONE_SIDED = (lambda d: -10.0 * abs(d) * d), (lambda d: -30.0 * max(d, 0.0))
AT_THE_START = {
    'actuator = "-10*abs(length - 2)*(length - 2)"': SQUARE,
    'actuator = "-10*sign(length - 2)*(length - 2)**2"': SQUARE,
    'actuator = "-10*(length - 2)**2 if length > 2 else 10*(length - 2)**2"': SQUARE,
    'actuator = "-30*(length - min(2, length))"': ONE_SIDED,
    'potential = "10*abs(length - 2)**3/3"': SQUARE,
    'potential = "15*(length - 2)**2 if length > 2 else 0"': ONE_SIDED,
}


def fallen(law: Callable[[float], float]) -> list[float]:
    """Where the point is after 0.8 s, by SciPy."""

    def rate(_: float, state: np.ndarray) -> list[float]:
        x, y, vx, vy = state
        length = math.hypot(x, y)
        pull = (law(length - 2.0) - 50.0 * (length - 2.0)) / length
        return [vx, vy, pull * x, pull * y - 9.81]

    found = solve_ivp(rate, (0.0, 0.8), [2.0, 0.0, 0.0, 0.0], "DOP853", rtol=1e-12, atol=1e-12, max_step=1e-3)
    return [float(x) for x in found.y[:2, -1]]


@pytest.mark.by_turns(4)
@pytest.mark.fast(
    'actuator = "-10*abs(length - 2)*(length - 2)"-abm',
    'actuator = "-10*sign(length - 2)*(length - 2)**2"-dopri5',
    'actuator = "-10*(length - 2)**2 if length > 2 else 10*(length - 2)**2"-picard',
    'actuator = "-10*(length - 2)**2 if length > 2 else 10*(length - 2)**2"-auto',
    'actuator = "-30*(length - min(2, length))"-dopri5',
    'actuator = "-30*(length - min(2, length))"-abm',
    'potential = "10*abs(length - 2)**3/3"-abm',
    'potential = "15*(length - 2)**2 if length > 2 else 0"-dopri5',
)
@pytest.mark.parametrize("integrator", ["dop853", "dopri5", "picard", "radau5", "abm", "auto"])
@pytest.mark.parametrize("law", AT_THE_START)
def test_a_kink_at_the_start_is_no_obstacle(tmp_path: Path, law: str, integrator: str) -> None:
    """The length stays within rounding of the switch for a while: each passage was taken again, and the run failed."""
    file = tmp_path / "kink.toml"
    file.write_text(AT_ITS_LENGTH + law, encoding="utf-8")
    method = "auto" if integrator == "auto" else "lagrange"
    result = symgen.simulate(file, method=method, integrator=integrator, rtol=1e-8, until=0.8)
    assert result.status == "ok", result.reason
    assert result.rejected < 20
    np.testing.assert_allclose([result["p.x"][-1], result["p.y"][-1]], fallen(AT_THE_START[law]), rtol=0.0, atol=1e-6)


def test_sizes_are_those_of_terms_and_of_the_state(folder: Path) -> None:
    """Distances far from the origin are rounded as coordinates are, and those near it as the mechanism's length."""
    far = WINDOW.replace("position = [0.0, 0.5]", "position = [1000.0, 0.5]")
    file = folder / "far.toml"
    file.write_text(far.replace("FORCE", "abs(bob.x - 1000.25) + abs(bob.y)"), encoding="utf-8")
    model = symgen.load(file)
    compiled = model.compile("lagrange")
    watched, start = compile_events(model.mechanism, compiled, (), 1e-8), model.assemble(compiled)
    out = np.zeros(6)
    watched.function(0.0, start.y, start.p, start.w, np.zeros_like(start.y), out)
    length = start.w[abi.LENGTH]
    np.testing.assert_allclose(sorted(out[4:]), [0.5 + 0.5 + length, 1000.0 + 1000.25 + 1000.0 + length], rtol=1e-14)


def test_integrals_of_efforts_that_are_cut_off() -> None:
    """What `min` compares in an effort reads its own measure: with outputs that integrate it, nothing ran."""
    result = symgen.load("inverted-pendulum").simulate(integrator="dop853", method="lagrange", until=0.02, times=[0.02])
    assert result.status == "ok", result.reason


@pytest.mark.parametrize(
    ("method", "integrator", "settings", "end"),
    [
        ("lagrange", "dop853", {"max_attempts": 25_000}, 0.5),
        ("lagrange", "radau5", {"max_attempts": 25_000}, 0.5),
        ("lagrange", "trapezoidal", {"step": 1e-2}, 0.49),
        ("lagrange", "newmark", {"step": 1e-2}, 0.49),
        ("generalized-alpha", "generalized-alpha", {"step": 1e-2}, 0.49),
    ],
)
def test_friction_that_sticks_says_why_nothing_goes_on(
    folder: Path, method: str, integrator: str, settings: dict, end: float
) -> None:
    """A block of 1 kg slides for half a second; what is proposed in the place of sign carries it beyond."""
    file = folder / "block.toml"
    text = (
        '[mechanism]\nname = "block"\ngravity = [0, 0]\n[bodies.b]\ntype = "point"\nmass = 1.0\nvelocity = [1, 0]\n'
        '[forces.drag]\ntype = "force"\nbody = "b"\nat = "centre"\nforce = ["-2*LAW", 0]\n'
    )
    file.write_text(text.replace("LAW", "sign(b.vx)"))
    stuck = symgen.simulate(file, method=method, integrator=integrator, until=3.0, **settings)
    assert stuck.status == "failed" and abs(stuck.end - end) < 1e-6
    if "step" in settings:
        newton = "Newton's iteration of an implicit stage did not converge at t = 0.49 s; a formula"
        assert stuck.reason.startswith(newton)
    assert "jumps to and fro with the state, as friction by sign(v) does that sticks" in stuck.reason
    assert "the key friction of a joint with that coordinate, in place of the sign of b.vx" in stuck.reason
    file.write_text(text.replace("LAW", "tanh(b.vx/1e-3)"))
    smooth = symgen.simulate(file, method="lagrange", integrator="radau5", until=3.0)
    assert smooth.status == "ok" and abs(smooth["b.x"][-1] - 0.25) < 1e-6


RUBBING = """[mechanism]
name = "rubbing"
[bodies.b]
mass = 1.0
inertia = 0.1
velocity = [1.0, 0.0]
[joints.guide]
type = "translational"
between = ["ground", "b"]
at = [[0, 0], "centre"]
axis = [1, 0]
"""
SLIDING = '[forces.f]\ntype = "force"\nbody = "b"\nforce = ["LAW", "0"]\n'


@pytest.mark.slow
@pytest.mark.parametrize(
    ("law", "read"),
    [
        ("-2*sign(b.vx)", "b.vx"),
        ("-2 if b.vx > 0 else 2", "b.vx"),
        ("-2*sign(guide.rate)", "guide.rate"),
    ],
)
def test_friction_by_the_sign_of_a_velocity_leads_to_the_key_of_a_joint(folder: Path, law: str, read: str) -> None:
    """What the sentence says to write runs to the end and rests where the block comes to rest, at 0.25 m."""
    file = folder / "rubbing.toml"
    file.write_text(RUBBING + SLIDING.replace("LAW", law))
    stuck = symgen.simulate(file, until=1.0)
    key = re.search(
        r"write '(friction = { sliding = BOUND })' in \[joints.guide\], BOUND in N, in place of", stuck.reason
    )
    assert stuck.status == "failed" and key and stuck.reason.endswith(f"the sign of {read}")
    file.write_text(RUBBING + key[1].replace("BOUND", "2.0"))
    sticks = symgen.simulate(file, until=1.0)
    assert sticks.status == "ok" and abs(sticks["b.x"][-1] - 0.25) < 1e-9


def test_friction_leads_to_the_joint_whose_rate_it_reads_and_jumps_of_positions_to_smooth_ones() -> None:
    pins = {
        "A": {"type": "revolute", "between": ["ground", "crank"], "at": [[0, 0], [-0.5, 0]]},
        "B": {"type": "revolute", "between": ["crank", "rod"], "at": [[0.5, 0], [-0.5, 0]]},
    }
    raw = {
        "mechanism": {"name": "arms", "gravity": [0.0, 0.0]},
        "bodies": {
            "crank": {"mass": 1.0, "inertia": 0.1, "position": [0.5, 0.0]},
            "rod": {"mass": 1.0, "inertia": 0.1, "position": [1.5, 0.0]},
        },
        "joints": pins,
    }

    def advice(torque: str) -> str:
        drag = {"drag": {"type": "torque", "body": "rod", "torque": torque}}
        return advice_on_jumps(mechanism_of({**raw, "forces": drag}))

    assert "in [joints.B], BOUND in N m" in advice("-2*sign(B.rate)")
    assert "in [joints.B], BOUND in N m" in advice("-2*sign(rod.omega)")
    assert "in [joints.A], BOUND in N m" in advice("-2*sign(crank.omega)")
    assert advice("1 if rod.x > 1 else 0").startswith("a steep smooth one in its place, such as tanh(v/1e-3)")
    assert "a joint with that coordinate, in place of the sign of rod.omega - 2.0" in advice(
        "1 if rod.omega > 2 else 0"
    )
    assert advice("1 - rod.omega") == ""


LASH = """[mechanism]
name = "lash"
gravity = [0.0, -9.81]
[bodies.arm]
mass = 1.0
inertia = 0.02
points = { a = [-0.25, 0] }
position = [0.25, 0]
[bodies.horn]
mass = 0.1
inertia = 0.001
[joints.pivot]
type = "revolute"
between = ["ground", "arm"]
at = [[0, 0], "a"]
[joints.shaft]
type = "revolute"
between = ["ground", "horn"]
at = [[0, 0], "centre"]
[forces.servo]
type = "torque"
body = "horn"
torque = "-500*shaft.angle - 20*shaft.rate"
[forces.lash]
type = "torque"
body = "arm"
reaction = "horn"
torque = "-2e4*(angle - 0.02) - 20*rate if angle > 0.02 else -2e4*(angle + 0.02) - 20*rate if angle < -0.02 else 0"
"""


@pytest.mark.by_turns(3)
@pytest.mark.fast("radau5-10.0", "radau5-50.0", "dop853-2.0", "picard-2.0")
@pytest.mark.parametrize("until", [2.0, 10.0, 50.0])
@pytest.mark.parametrize("integrator", ["radau5", "dop853", "picard"])
def test_the_end_of_a_run_decides_on_no_step_of_it(folder: Path, integrator: str, until: float) -> None:
    """An arm falls through the lash of its servo at 0.037 s, and rests where gravity and both springs balance."""
    file = folder / "lash.toml"
    file.write_text(LASH, encoding="utf-8")
    result = symgen.simulate(file, integrator=integrator, until=until, times=[0.0, 2.0], verify=False)
    assert result.status == "ok", result.reason
    moment, angle = 9.81 * 0.25, 0.0
    for _ in range(20):
        angle = -0.02 - moment * math.cos(angle) * (1.0 / 500.0 + 1.0 / 2e4)
    # at 2 s a rest of exp(-500/20*2) of the motion is left
    assert abs(result["arm.theta"][-1] - angle) < 1e-7
