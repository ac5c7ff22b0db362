"""Dry friction, stops and ropes in model exchange: FMPy integrates by CVode, and runs say what is right."""

import ctypes
import subprocess
import zipfile

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Model
from fmpy.validation import validate_fmu

import symgen
from symgen.result.targets import Request
from symgen.result.targets._c_model import CModel
from symgen.result.targets.fmu import fmu_files
from tests.result.targets.test_c_modes import DOOR, loaded, transitions_of
from tests.result.targets.test_fmu import fmu_of, importer_of
from tests.run.modes.test_clutches import CLUTCH
from tests.run.modes.test_stops import BALL, ROPE

#: A pendulum whose rate a blow turns round.
KICKED = """
[mechanism]
name = "kicked"
gravity = [0.0, -9.81]
[bodies.rod]
mass = 1.2
inertia = 0.3
position = [0.5, 0.0]
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], [-0.5, 0.0]]
[events.kick]
when = "rod.theta + 1.0"
reset = { "rod.omega" = "-0.5*rod.omega" }
[run]
until = 1.0
"""

#: A point on a curve of two pieces, before a wall.
CURVE = """
[mechanism]
name = "curve"
gravity = [0.0, -9.81]
[bodies.b]
type = "point"
mass = 1.0
position = [-0.5, 0.0]
velocity = [1.5, 0.0]
[joints.curve]
type = "rows"
rows = [{ position = "b.y - (0.5*b.x**3 if b.x > 0 else 0)" }]
[stops.wall]
gap = "0.6 - b.x"
restitution = 0.5
[events.half]
when = "b.x - 0.3"
action = "record"
"""


def exchanged(path, until, tolerance=1e-12, outputs=None, **keys):
    """Return what CVode makes of an FMU, with a row before and one behind each event."""
    description = read_model_description(str(path))
    names = outputs or [v.name for v in description.modelVariables if v.causality == "output"]
    return simulate_fmu(
        str(path), fmi_type="ModelExchange", stop_time=until, relative_tolerance=tolerance,
        output_interval=until / 1000, output=names, **keys,
    )  # fmt: skip


def events_of(rows):
    """Return the times of the events of an FMU."""
    times = rows["time"]
    return np.unique(times[1:][np.diff(times) == 0.0])


def assert_same_motion(model, rows, until, error, coordinates="absolute", parameters=None):
    """Compare rows of an FMU, behind events, with a run; return its transitions."""
    times = np.unique(rows["time"])
    last = np.searchsorted(rows["time"], times, side="right") - 1
    own = model.simulate(
        until=until, times=times, integrator="dop853", rtol=1e-12, coordinates=coordinates, parameters=parameters or {}
    )
    assert own.ok
    happened = np.array([t for t, _ in transitions_of(own)])
    found = events_of(rows)
    assert max(np.abs(found - t).min() for t in happened) < error
    away = np.abs(times[:, None] - happened).min(axis=1) > 10.0 * error
    for name in (*own.q.names, *own.v.names):
        assert np.abs(rows[name][last] - own[name])[away].max() < 100.0 * error, name
    for name in rows.dtype.names:
        if name.endswith(".mode"):
            np.testing.assert_array_equal(rows[name][last][away], own[name][away])
    return [word for _, word in transitions_of(own)]


@pytest.mark.slow
def test_margins_of_modes_are_event_indicators(tmp_path):
    text = "[mechanism]\nname = 'rail'\n[bodies.b]\ntype = 'point'\nmass = 1.0\n[joints.rail]\ntype = 'rows'\n"
    model = loaded(text + "rows = [{ position = 'b.y' }]\n[stops.wall]\ngap = '1.0 - b.x'\n", tmp_path)
    files = fmu_files(CModel.of(Request(model.mechanism, tmp_path / "rail.fmu"), "fmu"), 3)
    description = files["modelDescription.xml"].decode()
    for name in ("event.wall.hit", "event.wall.leave", "event.choice_of_states"):
        assert f'name="{name}"' in description
    assert '<ModelExchange modelIdentifier="rail"' in description and description.count("<EventIndicator") == 3
    assert 'name="wall.mode"' in description and 'variability="discrete"' in description
    # the wall is no row that is always in force: both numbers of a point on a rail are states
    assert b"RANK_Q = 1, RANK_V = 1" in files["sources/fmu.c"]


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_block_on_a_belt_sticks_and_slips(tmp_path):
    model = symgen.load("belt-oscillator")
    path = fmu_of(model, tmp_path / "belt.fmu", fmi=3)
    assert validate_fmu(str(path)) == []
    variables = {v.name: v for v in read_model_description(str(path)).modelVariables}
    assert variables["contact.mode"].variability == "discrete"
    assert {"event.contact.slip", "event.contact.reverse", "event.choice_of_states"} < variables.keys()
    words = assert_same_motion(model, exchanged(path, 2.0), 2.0, 2e-9)
    assert words == ["contact.slip", "contact.stick"] * 2


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("source", "until", "coordinates", "fmi", "error"),
    [
        (DOOR, 4.0, "absolute", 2, 1e-9),
        (ROPE, 2.0, "absolute", 3, 1e-9),
        ("toggle-press", 0.4, "joint", 2, 1e-9),
        ("dry-four-bar", 8.0, "joint", 3, 1e-8),
    ],
)
def test_stops_ropes_and_friction(source, until, coordinates, fmi, error, tmp_path):
    model = loaded(source, tmp_path) if "\n" in source else symgen.load(source)
    path = fmu_of(model, tmp_path / "model.fmu", fmi=fmi, coordinates=coordinates)
    assert validate_fmu(str(path)) == []
    assert_same_motion(model, exchanged(path, until), until, error, coordinates)


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_a_ball_comes_to_rest_when_its_flights_end_although_the_tolerance_loses_the_last_ones(tmp_path):
    """Its flights last sqrt(2 h/g) (1 + e)/(1 - e). Where e is small, few of them are left to follow the series by."""
    text = BALL.replace("[bodies.ball]", "[parameters]\ne = 0.7\n\n[bodies.ball]")
    path = fmu_of(loaded(text.replace("restitution = 0.7", 'restitution = "e"'), tmp_path), tmp_path / "ball.fmu")
    for tolerance in (1e-6, 1e-8, 1e-10, 1e-12):
        for e in np.linspace(0.0, 0.9, 19):
            end = np.sqrt(2.0 / 9.81) * (1.0 + e) / (1.0 - e)
            rows = exchanged(path, end + 0.1, tolerance, start_values={"e": e})
            floor = rows["floor.mode"]
            rest = rows["time"][np.flatnonzero(floor)[0]]
            assert rest == pytest.approx(end, rel=50.0 * tolerance if e >= 0.4 else 2e3 * tolerance)
            assert floor[-1] == 1.0 and np.all(np.diff(floor) >= 0.0)
            assert abs(rows["ball.y"][-1]) < 1e-12 and rows["ball.vy"][-1] == 0.0
            assert rows["ball.y"].min() > -100.0 * tolerance
            assert len(events_of(rows)) < 400


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_a_clutch_locks_under_a_ramp_and_opens_where_an_input_jumps(tmp_path):
    """Torques -2 t and 2 t on 2 and 3 kg m^2: equal speeds of 4 rad/s where t^2 (1/2 + 1/3) = 10."""
    model = loaded(CLUTCH.replace('sliding = "pressure"', 'sliding = "slope*t"'), tmp_path)
    rows = exchanged(fmu_of(model, tmp_path / "ramp.fmu", fmi=2), 5.0, outputs=["load.omega", "clutch.mode"])
    locked = np.flatnonzero(rows["clutch.mode"] == 0.0)
    assert rows["time"][locked[0]] == pytest.approx(np.sqrt(12.0), abs=1e-8)
    assert rows["load.omega"][-1] == pytest.approx(4.0, abs=1e-8)
    model = loaded(CLUTCH, tmp_path)
    signals = np.array([(0.0, 8.0), (4.0, 8.0), (4.0, 0.0), (5.0, 0.0)], dtype=[("time", float), ("pressure", float)])
    rows = exchanged(
        fmu_of(model, tmp_path / "jump.fmu", fmi=3), 5.0, outputs=["load.omega", "clutch.mode"], input=signals
    )
    # 8 N m bring 10 rad/s on 2 and 3 kg m^2 together in 10/(4 + 8/3) = 1.5 s
    locked = np.flatnonzero(rows["clutch.mode"] == 0.0)
    assert rows["time"][locked[0]] == pytest.approx(1.5, abs=1e-8)
    assert rows["load.omega"][-1] == pytest.approx(4.0, abs=1e-8)


@pytest.fixture(scope="module")
def press(tmp_path_factory):
    return fmu_of(symgen.load("toggle-press"), tmp_path_factory.mktemp("press") / "press.fmu", fmi=3)


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_values_of_a_parameter_end_in_the_same_modes(press, tmp_path):
    """An instance is reset and goes on with another force of the piston, and each time the press rests on its die."""
    importer = importer_of(press, tmp_path / "press")
    values, outputs = np.linspace(200.0, 400.0, 40), ["upper.theta", "guide.mode", "guide.lower.mode"]
    ends = []
    for value in values:
        rows = simulate_fmu(
            **importer, stop_time=0.25, relative_tolerance=1e-10, output_interval=0.0025,
            output=outputs, start_values={"push": value},
        )  # fmt: skip
        ends.append([rows[name][-1] for name in outputs])
        importer["fmu_instance"].reset()
    angles, *modes = np.array(ends).T
    assert np.all(modes[0] == 0.0) and np.all(modes[1] == 1.0)
    np.testing.assert_allclose(angles, 0.05 - np.pi / 2, rtol=0, atol=1e-9)  # the angle at which the die stops it


class Importer:
    """An importer with steps by the classical scheme, which halves its step down to an event."""

    def __init__(self, path, folder):
        description = read_model_description(str(path))
        self.names = {v.name: v.valueReference for v in description.modelVariables}
        self.fmu = FMU2Model(
            guid=description.guid, unzipDirectory=extract(str(path), str(folder)), instanceName="own",
            modelIdentifier=description.modelExchange.modelIdentifier,
        )  # fmt: skip
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.t, self.n, self.m = 0.0, description.numberOfContinuousStates, description.numberOfEventIndicators
        self.events = 0
        self.handle()

    def numbers(self, function, count):
        values = np.zeros(count)
        function(values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), count)
        return values

    def put(self, t, x):
        self.fmu.setTime(t)
        x = np.ascontiguousarray(x)
        self.fmu.setContinuousStates(x.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), self.n)

    def rates(self, t, x):
        self.put(t, x)
        return self.numbers(self.fmu.getDerivatives, self.n)

    def moved(self, x, h):
        a = self.rates(self.t, x)
        b = self.rates(self.t + h / 2, x + h / 2 * a)
        c = self.rates(self.t + h / 2, x + h / 2 * b)
        return x + h / 6 * (a + 2 * b + 2 * c + self.rates(self.t + h, x + h * c))

    def signs(self, t, x):
        self.put(t, x)
        return self.numbers(self.fmu.getEventIndicators, self.m) > 0.0

    def handle(self):
        self.fmu.enterEventMode()
        while self.fmu.newDiscreteStates()[0]:
            pass
        self.fmu.enterContinuousTimeMode()

    def go(self, until, step):
        while self.t < until - 1e-12:
            x, h = self.numbers(self.fmu.getContinuousStates, self.n), min(step, until - self.t)
            before, low, high = self.signs(self.t, x), 0.0, h
            passes = np.any(self.signs(self.t + h, self.moved(x, h)) != before)
            while passes and high - low > 1e-13:
                middle = 0.5 * (low + high)
                inside = np.any(self.signs(self.t + middle, self.moved(x, middle)) != before)
                low, high = (low, middle) if inside else (middle, high)
            end = self.moved(x, high)
            self.t += high
            self.put(self.t, end)
            event, _ = self.fmu.completedIntegratorStep()
            if passes or event:
                self.events += 1
                self.handle()

    def __getitem__(self, name):
        return self.fmu.getReal([self.names[name]])[0]


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_state_that_is_kept_has_its_modes(tmp_path):
    """An own importer goes to and fro; its motion is that of a run."""
    model = symgen.load("belt-oscillator")
    importer = Importer(fmu_of(model, tmp_path / "belt.fmu"), tmp_path / "belt")
    importer.go(0.5, 0.01)
    assert importer["contact.mode"] == 0.0
    kept = importer.fmu.getFMUstate()
    bits = importer.fmu.serializeFMUstate(kept)
    ends = []
    for _ in range(2):
        importer.go(1.2, 0.01)
        ends.append([importer[name] for name in ("block.x", "block.vx", "contact.mode", "contact.force")])
        importer.t = 0.5
        importer.fmu.setFMUstate(importer.fmu.deSerializeFMUstate(bits))
        assert importer["contact.mode"] == 0.0
    assert ends[0] == ends[1] and importer.events == 4
    own = model.simulate(until=1.2, times=[0.0, 1.2], integrator="dop853", rtol=1e-12)
    assert ends[0][:2] == pytest.approx([own["block.x"][-1], own["block.vx"][-1]], abs=1e-7)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_euler_s_method_finds_modes_behind_its_events(press):
    model = symgen.load("toggle-press")
    names, h = ["guide.mode", "guide.lower.mode", "upper.theta"], 1e-4
    rows = simulate_fmu(
        str(press),
        fmi_type="ModelExchange",
        solver="Euler",
        stop_time=0.4,
        step_size=h,
        output_interval=h,
        output=names,
    )
    own = model.simulate(until=0.4, times=[0.0, 0.2, 0.4], integrator="dop853")
    for k, t in ((1, 0.2), (2, 0.4)):
        at = np.searchsorted(rows["time"], t - h / 2)
        assert [rows[name][at] for name in names[:2]] == [own[name][k] for name in names[:2]]
        assert rows["upper.theta"][at] == pytest.approx(own["upper.theta"][k], abs=5e-3)


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_a_row_that_changes_with_the_state_beside_a_stop(tmp_path):
    """Its comparison is an indicator too. The sources compile without a warning, with room for all functions."""
    model = loaded(CURVE, tmp_path)
    path = fmu_of(model, tmp_path / "curve.fmu", fmi=3)
    rows = exchanged(path, 1.0)
    assert_same_motion(model, rows, 1.0, 1e-9)
    assert len(events_of(rows)) > 2  # the wall, the event that is recorded, and the comparison
    with zipfile.ZipFile(path) as archive:
        archive.extractall(tmp_path / "curve")
    command = ["cc", "-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "fmu.c", "-o", "x", "-lm"]
    ran = subprocess.run(command, cwd=tmp_path / "curve" / "sources", capture_output=True, text=True, check=False)
    assert (ran.returncode, ran.stderr) == (0, "")


@pytest.mark.slow
def test_events_with_resets_change_velocities_through_joints(tmp_path):
    model = loaded(KICKED, tmp_path)
    rows = exchanged(fmu_of(model, tmp_path / "kicked.fmu"), 1.0, 1e-11)
    own = model.simulate(until=1.0, times=[0.0, 1.0], integrator="dop853", rtol=1e-12)
    assert events_of(rows) == pytest.approx([event.t for event in own.events], abs=1e-8)
    assert rows["rod.omega"][-1] == pytest.approx(own["rod.omega"][-1], abs=1e-7)
