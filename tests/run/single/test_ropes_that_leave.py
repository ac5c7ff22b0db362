"""Ropes that leave their sheaves, touch them again and come back, beside closed forms.

Without gravity the speed v of a load stays. On a sheave of radius r the free length s of the rope has (s^2)' = 2 r v
while it unwinds, and its direction turns with v/s; a straight rope turns about what is before it. A load whose velocity
is turned round goes back the way that it came.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

import symgen
from symgen.base.errors import InputError
from symgen.study.stress.study import stress

TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13}
RADIUS, BACK = 0.1, 0.8
END = np.array([-1.0, RADIUS])


class Unwinding:
    """A load on a rope over sheaves that turn it to the right, which it leaves one after the other.

    Parameters
    ----------
    end : array
        The fixed end.
    sheaves : list of (array, float)
        Centres, and direction of the rope as it leaves each, from the last one on.
    direction, free : float
        Direction of the free part and its length at the start.
    parts : list of float
        Straight part before each sheave: the free part is longer by it, as the rope leaves.
    """

    def __init__(self, end, sheaves, direction, free, parts):
        self.end, self.sheaves, self.direction, self.free, self.parts = end, sheaves, direction, free, parts

    def times(self, speed):
        """Return the times at which the rope leaves the sheaves."""
        times, psi, free, t = [], self.direction, self.free, 0.0
        for (_, leaves), part in zip(self.sheaves, self.parts, strict=True):
            grown = free + RADIUS * (leaves - psi)
            t += (grown**2 - free**2) / (2.0 * RADIUS * speed)
            times.append(t)
            psi, free = leaves, grown + part
        return times

    def at(self, speed, t):
        """Return the place of the load."""
        psi, free, begun = self.direction, self.free, 0.0
        for (centre, leaves), part, ends in zip(self.sheaves, self.parts, self.times(speed), strict=True):
            if t < ends:
                now = math.sqrt(free**2 + 2.0 * RADIUS * speed * (t - begun))
                psi += (now - free) / RADIUS
                along, across = np.array([math.cos(psi), math.sin(psi)]), np.array([-math.sin(psi), math.cos(psi)])
                return centre + RADIUS * across + now * along
            psi, free, begun = leaves, free + RADIUS * (leaves - psi) + part, ends
        psi += speed * (t - begun) / free
        return self.end + free * np.array([math.cos(psi), math.sin(psi)])


ONE = Unwinding(END, [(np.zeros(2), 0.0)], -math.pi / 2.0, 0.5, [1.0])

OVER = """
[mechanism]
name = "over-the-top"
[parameters]
v = 2.0
back = {back}
[run]
until = 1.3
[bodies.load]
type = "point"
mass = 1.0
position = [0.1, -0.5]
velocity = ["v", 0.0]
[joints.rope]
type = "rope"
between = ["ground", "load"]
at = [[-1.0, 0.1], "centre"]
over = [{{ at = [0.0, 0.0], radius = 0.1, turn = "right" }}]
{more}
[events.turned]
when = "t > back"
reset = {{ "load.vx" = "-load.vx", "load.vy" = "-load.vy" }}
"""


def over(back=BACK, more=""):
    return OVER.format(back=back, more=more)


def loaded(text, tmp_path):
    (path := tmp_path / "model.toml").write_text(text)
    return symgen.load(path)


WAYS = (
    {},
    {"coordinates": "joint"},
    {"integrator": "radau5", "rtol": 1e-10},
    {"integrator": "dop853", "shape": "looped", "rtol": 1e-10},
    {"integrator": "rk4", "step": 1e-4},
    {"method": "baumgarte", "integrator": "dop853", "rtol": 1e-11},
)


@pytest.mark.slow_cases("keys2", "keys3", "keys4", "keys5")
@pytest.mark.parametrize("keys", WAYS)
def test_a_load_swings_up_and_back(keys, tmp_path):
    run = loaded(over(), tmp_path).simulate(times=[0.3, 0.5, 0.7, 1.0, 1.3], **keys)
    assert run.ok, run.reason
    leaves = ONE.times(2.0)[0]
    assert leaves == pytest.approx(0.454384, abs=1e-6)
    names = {event.name: event.t for event in run.events}
    assert names["rope.leaves1"] == pytest.approx(leaves, abs=1e-8)
    assert names["rope.comes1"] == pytest.approx(2.0 * BACK - leaves, abs=1e-8)
    for k, t in enumerate(run.t):
        place = ONE.at(2.0, t if t <= BACK else 2.0 * BACK - t)
        assert [run["load.x"][k], run["load.y"][k]] == pytest.approx(place, abs=2e-7), t
    assert np.abs(run.energy_error).max() < 1e-8


def test_300_speeds_leave_and_come_back(tmp_path):
    """Rows of a sweep; by the speed a rope leaves or not, and is back on its sheave at the end or not."""
    speeds = np.linspace(0.6, 4.0, 300)
    columns = ["load.x", "load.y", "rope.on1"]
    swept = symgen.sweep(loaded(over(), tmp_path), {"v": speeds}, quantities=columns, **TIGHT)
    assert set(swept.status.tolist()) == {"ok"}
    own = np.array([ONE.at(v, 2.0 * BACK - 1.3) for v in speeds])
    assert np.abs(np.array([swept["load.x"], swept["load.y"]]).T - own).max() < 1e-9
    left = np.array([ONE.times(v)[0] < min(BACK, 2.0 * BACK - 1.3) for v in speeds])
    assert np.array_equal(np.ravel(swept["rope.on1"]) < 0.5, left) and 0 < left.sum() < 300


def test_100_speeds_leave_for_good_and_steps_do(tmp_path):
    speeds, model = np.linspace(1.0, 3.0, 100), loaded(over(back=9.0), tmp_path)
    swept = symgen.sweep(model, {"v": speeds}, quantities=["load.x", "load.y"], until=1.0, **TIGHT)
    own = np.array([ONE.at(v, 1.0) for v in speeds])
    assert np.abs(np.array([swept["load.x"], swept["load.y"]]).T - own).max() < 1e-9
    stepped = model.start(integrator="rk4", step=1e-3)
    for _ in range(10):
        stepped.step(0.1)
    assert [stepped.bodies["load.x"], stepped.bodies["load.y"]] == pytest.approx(ONE.at(2.0, 1.0), abs=1e-8)
    first = model.simulate(until=0.7)  # a run goes on from one whose rope has left
    second = model.simulate(until=1.0, start=first)
    assert [second["load.x"][-1], second["load.y"][-1]] == pytest.approx(ONE.at(2.0, 1.0), abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_derivatives_go_through_leaving_and_coming(coordinates, tmp_path):
    """Forward and adjoint, beside the closed form's slope by the speed."""
    model = loaded(over(), tmp_path)
    for until in (0.7, 1.3):
        t, h = (until if until < BACK else 2.0 * BACK - until), 1e-5
        slope = (ONE.at(2.0 + h, t) - ONE.at(2.0 - h, t)) / (2.0 * h)
        keys = {"coordinates": coordinates, "until": until, **TIGHT}
        run = model.simulate(sensitivities=("v",), **keys)
        for name, own in zip(("load.x", "load.y"), slope, strict=True):
            assert run.gradient(name).values[-1, 0] == pytest.approx(own, abs=1e-7), (until, name)
            back = model.gradient(name, by=("v",), way="adjoint", **keys)
            assert back.by["v"] == pytest.approx(own, abs=1e-7), (until, name)


# -- several sheaves ---------------------------------------------------------------------------------------------------

LOW = np.array([-1.0, -0.2])
RISE = math.atan2(0.2, 1.0) + math.asin(RADIUS / math.hypot(1.0, 0.2))
TWO = Unwinding(
    LOW,
    [(np.array([0.6, 0.0]), 0.0), (np.zeros(2), RISE)],
    -math.pi / 2.0,
    0.5,
    [0.6, math.sqrt(1.0 + 0.04 - RADIUS**2)],
)


@pytest.mark.parametrize("turned", [None, pytest.param([0.3, -0.5, 0.2], marks=pytest.mark.slow)])
def test_a_rope_leaves_two_sheaves_one_after_the_other(turned, tmp_path):
    """In the plane, and in a plane that is turned in space; 60 speeds."""
    frame = None if turned is None else Rotation.from_rotvec(turned)

    def placed(*point):
        return tuple(point) if frame is None else tuple(map(float, frame.apply((*point, 0.0))))

    builder = symgen.MechanismBuilder("two", **({} if frame is None else {"space": "spatial"}))
    builder.parameter("v", 2.0)
    along = placed(1.0, 0.0)
    builder.body("load", type="point", mass=1.0, position=placed(0.7, -0.5), velocity=[f"v*{x!r}" for x in along])
    axis = {} if frame is None else {"axis": tuple(map(float, frame.apply((0.0, 0.0, 1.0))))}
    over = [{"at": placed(x, 0.0), "radius": RADIUS, "turn": "right", **axis} for x in (0.0, 0.6)]
    builder.joint("rope", "rope", between=("ground", "load"), at=(placed(*LOW), "centre"), over=over)
    model = symgen.load(builder.build())
    names = ["load.x", "load.y", "load.z"][: len(along)]
    speeds = np.linspace(0.5, 4.0, 60)
    swept = symgen.sweep(model, {"v": speeds}, quantities=[*names, "rope.on1", "rope.on2"], until=1.0, **TIGHT)
    assert set(swept.status.tolist()) == {"ok"}
    own = np.array([placed(*TWO.at(v, 1.0)) for v in speeds])
    assert np.abs(np.array([swept[name] for name in names]).T - own).max() < 1e-9
    left = np.array([TWO.times(v) for v in speeds]) < 1.0
    assert np.array_equal(np.array([np.ravel(swept["rope.on2"]), np.ravel(swept["rope.on1"])]).T < 0.5, left)
    assert len({tuple(row) for row in left.tolist()}) == 3


# -- straight beside a sheave ------------------------------------------------------------------------------------------

BESIDE = """
[mechanism]
name = "beside"
[parameters]
v = 1.0
[run]
until = 1.2
[bodies.load]
type = "point"
mass = 1.0
position = [1.0, 0.2]
velocity = [0.0, "-v"]
[joints.rope]
type = "rope"
between = ["ground", "load"]
at = [[-1.0, 0.2], "centre"]
over = [{ at = [0.0, 0.0], radius = 0.1, turn = "right" }]
"""


def touched(speed, t):
    """Return the place of a load whose straight rope of 2 m turns down on a sheave."""
    end = np.array([-1.0, 0.2])
    phi = brentq(lambda x: 0.2 * math.cos(x) + math.sin(x) - RADIUS, -0.5, 0.0, xtol=1e-15)
    until = -2.0 * phi / speed
    if t < until:
        psi = -speed * t / 2.0
        return end + 2.0 * np.array([math.cos(psi), math.sin(psi)])
    first = 2.0 - math.sqrt(1.04 - RADIUS**2)
    free = math.sqrt(first**2 - 2.0 * RADIUS * speed * (t - until))
    psi = phi + (free - first) / RADIUS
    return RADIUS * np.array([-math.sin(psi), math.cos(psi)]) + free * np.array([math.cos(psi), math.sin(psi)])


def test_a_straight_rope_touches_its_sheave(tmp_path):
    """It is off the sheave at the start; 100 speeds, of which some do not get there."""
    model, speeds = loaded(BESIDE, tmp_path), np.linspace(0.1, 2.0, 100)
    assert model.mechanism.joints[0].rows[0].value.value == pytest.approx(2.0, abs=1e-15)
    swept = symgen.sweep(model, {"v": speeds}, quantities=["load.x", "load.y", "rope.on1"], **TIGHT)
    own = np.array([touched(v, 1.2) for v in speeds])
    assert np.abs(np.array([swept["load.x"], swept["load.y"]]).T - own).max() < 1e-9
    on = np.ravel(swept["rope.on1"]) > 0.5
    assert 0 < on.sum() < 100 and np.all(np.diff(on.astype(int)) >= 0)


def test_places_of_parameters_say_whether_a_rope_is_on_its_sheave(tmp_path):
    """In rows of a sweep as well: the length is that of the way where the file is read, so it is given here."""
    text = BESIDE.replace("v = 1.0", "v = 1.0\nh = 0.2").replace("[1.0, 0.2]", '[1.0, "h"]')
    text = text.replace("over =", 'length = "2.5"\nstiffness = 10.0\nover =')
    model = loaded(text, tmp_path)
    swept = symgen.sweep(model, {"h": [0.3, 0.1, -0.1, -0.5]}, quantities=["rope.on1"], until=1e-3)
    assert np.ravel(swept["rope.on1"]).tolist() == [0.0, 0.0, 1.0, 1.0]


@pytest.mark.parametrize(
    ("wound", "length"), [("", math.hypot(1.2, 0.9)), (", wound = true", None), (", wound = false", None)]
)
def test_a_rope_that_could_pass_by_is_wound_if_the_file_says_so(wound, length, tmp_path):
    """A capstan: the rope turns by three quarters of a turn, and its ends could see each other."""
    text = BESIDE.replace("[-1.0, 0.2]", "[-1.0, 0.1]").replace("[1.0, 0.2]", "[0.2, 1.0]")
    model = loaded(text.replace('"right"', f'"right"{wound}'), tmp_path)
    found = model.mechanism.joints[0].rows[0].value.value
    end, load = np.array([-1.0, 0.1]), np.array([0.2, 1.0])
    if "true" in wound:
        parts = math.sqrt(end @ end - RADIUS**2) + math.sqrt(load @ load - RADIUS**2)
        leaves = math.atan2(1.0, 0.2) - math.asin(RADIUS / math.hypot(*load))
        length = parts + RADIUS * (2.0 * math.pi - leaves)
    assert found == pytest.approx(np.linalg.norm(load - end) if length is None else length, abs=1e-12)


def test_an_eyelet_is_not_wound(tmp_path):
    with pytest.raises(InputError, match=r"over\[0\]\.wound: expected no such key without a radius"):
        loaded(BESIDE.replace('radius = 0.1, turn = "right"', "wound = true"), tmp_path)


# -- ropes that stretch ------------------------------------------------------------------------------------------------


def stretched(stiffness, damping, speed, until):
    """Return the place of a load, by an integration of its own with two phases, in order of time."""

    def way(place):
        q = np.asarray(place)
        square = q @ q - RADIUS**2
        psi = math.atan2(q[1], q[0]) - math.asin(RADIUS / math.hypot(*q))
        return 1.0 - RADIUS * psi + math.sqrt(square), np.array([math.cos(psi), math.sin(psi)]), -psi

    def straight(q):
        apart = q - END
        return np.linalg.norm(apart), apart / np.linalg.norm(apart), 0.0

    rest = way(np.array([0.1, -0.5]))[0]

    def rates(phase):
        def of(_, y):
            length, along, _ = phase(y[:2])
            spring = stiffness * max(0.0, length - rest)
            pull = spring + max(-spring, min(damping * (along @ y[2:]), spring))
            return np.concatenate([y[2:], -pull * along])

        return of

    def leaves(_, y):
        return way(y[:2])[2]

    leaves.terminal, leaves.direction = True, -1.0
    keys = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}
    first = solve_ivp(rates(way), (0.0, until), [0.1, -0.5, speed, 0.0], events=leaves, **keys)
    if first.status == 0:
        return first.y[:2, -1]
    return solve_ivp(rates(straight), (first.t[-1], until), first.y[:, -1], **keys).y[:2, -1]


@pytest.mark.parametrize("speed", [0.7, 2.0, pytest.param(3.3, marks=pytest.mark.slow)])
def test_a_rope_that_stretches_leaves(speed, tmp_path):
    model = loaded(over(back=9.0, more="stiffness = 400.0\ndamping = 3.0"), tmp_path)
    for coordinates in ("absolute", "joint"):
        run = model.simulate(parameters={"v": speed}, until=1.0, coordinates=coordinates, **TIGHT)
        own = stretched(400.0, 3.0, speed, 1.0)
        assert run.ok and [run["load.x"][-1], run["load.y"][-1]] == pytest.approx(own, abs=1e-9)
        assert [event.name for event in run.events] == (["rope.leaves1"] if speed > 1.0 else [])


def test_a_block_is_lifted_out_of_a_bight(tmp_path):
    """The rope goes slack and passes by: the block flies as free, and comes down into the bight again."""
    text = """
[mechanism]
name = "bight"
gravity = [0.0, -9.81]
[run]
until = 1.0
[bodies.block]
mass = 2.0
inertia = 0.01
position = [0.0, -0.3]
[bodies.post]
mass = 1.0
inertia = 0.1
position = [0.5, 0.0]
[joints.foot]
type = "rigid"
between = ["ground", "post"]
at = [[0.5, 0.0], "centre"]
[joints.rope]
type = "rope"
between = ["ground", "post"]
at = [[-0.5, 0.0], "centre"]
over = [{ body = "block", at = "centre", radius = 0.1, turn = "left" }]
stiffness = 1e5
damping = 50.0
[forces.lift]
type = "force"
body = "block"
force = [0.0, "100 if t > 0.2 and t < 0.3 else 0"]
"""
    run = loaded(text, tmp_path).simulate(integrator="dop853", rtol=1e-10, until=1.3)
    names = [event.name for event in run.events]
    assert run.ok and names[:2] == ["rope.leaves1", "rope.comes1"]
    flies = (run.t > 0.301) & (run.t < run.events[1].t - 0.01)
    assert run["block.y"].max() > 0.5 and np.abs(run["block.ay"][flies] + 9.81).max() < 1e-9
    assert run["rope.force"].max() == 0.0


def test_analyses_take_a_rope_as_it_is_at_the_start(tmp_path):
    """A load that hangs from a sheave: its frequency is that of its free length; states of ropes are no freedoms."""
    text = (
        over(back=9.0)
        .replace('["v", 0.0]', "[0.0, 0.0]")
        .replace('name = "over-the-top"', 'name = "hangs"\ngravity = [0.0, -9.81]')
    )
    model = loaded(text, tmp_path)
    modes = model.modes()
    assert modes.frequencies.max() * 2.0 * math.pi == pytest.approx(math.sqrt(9.81 / 0.5), rel=1e-6)
    assert len(model.functions("absolute").rows) == 1


def test_references_of_stress_refuse_ropes_over_sheaves(tmp_path):
    """A second derivation knows no states of ropes; it says so, and a study leaves the file out."""
    text = over(back=9.0).replace('name = "over-the-top"', 'name = "hangs"\ngravity = [0.0, -9.81]')
    (path := tmp_path / "swing.toml").write_text(text)
    study = stress([path], ["gravity"], ["lagrange"], quick=True, jobs=1)
    assert "one whose ropes may leave sheaves" in study.unusable[0][-1]
