"""FMUs as importers run them: FMPy validates them, steps them and integrates them by CVode."""

import zipfile

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Model
from fmpy.validation import validate_fmu
from support.emitted import mechanism_of
from support.locks import LOCKED, parts
from support.rotation import of_turn

from symgen import Settings, load
from symgen.base.errors import InputError
from symgen.describe import catalogue
from symgen.describe.files.validate import validate
from symgen.result.targets import TARGETS, Request
from symgen.result.targets._base_units import base_unit
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c import BALL, NAMES, rows_of

#: Crank and its rate after 10 s, from `dop853` at 1e-13, which the tests of that method hold.
FOUR_BAR = {"crank.theta": -4.9126194602875, "crank.omega": 0.0326701961}


def fmu_of(model, path, **keys):
    TARGETS.get("fmu").write(Request(model.mechanism, path, **keys))
    return path


def importer_of(path, folder):
    """Return arguments of `simulate_fmu`: an FMU 3 for model exchange, as an instance that callers reset."""
    description, folder = read_model_description(str(path)), extract(str(path), str(folder))
    instance = FMU3Model(
        guid=description.guid, unzipDirectory=folder, instanceName=description.modelName,
        modelIdentifier=description.modelExchange.modelIdentifier,
    )  # fmt: skip
    instance.instantiate()
    return {"filename": folder, "model_description": description, "fmu_instance": instance, "fmi_type": "ModelExchange"}


def simulated(path, kind, until, tolerance=1e-9, step=None, outputs=None, **keys):
    description = read_model_description(str(path))
    names = outputs or [v.name for v in description.modelVariables if v.causality == "output"]
    if kind == "ModelExchange":
        keys |= {"solver": "CVode", "relative_tolerance": tolerance}
    rows = simulate_fmu(
        str(path), fmi_type=kind, stop_time=until, output_interval=step or until / 10, output=names,
        record_events=False, **keys,
    )  # fmt: skip
    return {name: rows[name] for name in ("time", *names)}


def size_of(path):
    """Return the bytes of an FMU without the library of another system."""
    with zipfile.ZipFile(path) as archive:
        return sum(entry.compress_size for entry in archive.infolist() if "win" not in entry.filename)


@pytest.fixture(scope="module", params=[2, 3])
def four_bar(request, tmp_path_factory):
    return fmu_of(load("four-bar"), tmp_path_factory.mktemp("fmu") / "four-bar.fmu", fmi=request.param)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_it_is_valid_and_small(four_bar):
    assert validate_fmu(str(four_bar)) == []
    assert size_of(four_bar) < 200_000
    description = read_model_description(str(four_bar))
    names = {v.name: v for v in description.modelVariables}
    assert names["crank_mass"].unit == "kg"
    assert names["crank.theta"].causality == "output"
    assert sum(v.derivative is not None for v in description.modelVariables) == 2


@pytest.mark.slow
@pytest.mark.slow_cases("2-1e-09-7.5e-06", "2-1e-11-7.5e-08", "3-1e-09-7.5e-06")
@pytest.mark.parametrize(("tolerance", "error"), [(1e-9, 7.5e-6), (1e-11, 7.5e-8)])
def test_model_exchange_neither_drifts_nor_restarts(four_bar, tolerance, error):
    # CVode on the equation reduced by hand to one coordinate is 5e-6 off at 1e-9 and 5e-8 at 1e-11
    rows = simulated(four_bar, "ModelExchange", 10.0, tolerance, 0.1)
    assert abs(rows["crank.theta"][-1] - FOUR_BAR["crank.theta"]) < error
    run = prepare(load("four-bar").mechanism, Settings(shape="straight"), Purpose.STATE)
    names, w = [q.name for q in run.compiled.info.coordinates], run.start.w.copy()
    for k in range(len(rows["time"])):
        y = run.start.y.copy()
        y[: len(names)] = [rows[name][k] for name in names]
        run.compiled.model.geometry(0.0, y, run.start.p, w)
        assert np.abs(run.compiled.section(w, "residual")).max() < 1e-12


@pytest.mark.slow_cases("2", "3")
def test_co_simulation_is_a_run_with_the_same_step(four_bar):
    rows = simulated(four_bar, "CoSimulation", 1.0)
    own = load("four-bar").simulate(
        method="direct-correction", integrator="rk4", step=1e-3, until=1.0, output_step=0.1, shape="straight"
    )
    for name in ("crank.theta", "rocker.omega"):
        np.testing.assert_allclose(rows[name], own[name], rtol=1e-11, atol=1e-11)


@pytest.mark.slow
def test_parameters_assemble_anew_and_those_that_follow_cannot_be_set(tmp_path):
    model = load("wiper")
    path = fmu_of(model, tmp_path / "wiper.fmu")
    for kind, keys, tolerance in (
        ("CoSimulation", {"integrator": "rk4", "step": 1e-3}, 1e-11),
        ("ModelExchange", {"integrator": "dop853", "rtol": 1e-12}, 1e-7),
    ):
        rows = simulated(path, kind, 0.2, 1e-11, start_values={"crank_length": 0.051})
        own = model.simulate(until=0.2, output_step=0.02, parameters={"crank_length": 0.051}, **keys)
        np.testing.assert_allclose(rows["arm.theta"], own["arm.theta"], rtol=0, atol=tolerance)
        np.testing.assert_allclose(rows["energy"], own["energy"], rtol=0, atol=100 * tolerance)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("fmi", [2, 3])
def test_events_change_velocities_and_end_the_motion(kind, fmi, tmp_path):
    (tmp_path / "ball.toml").write_text(BALL)
    path = fmu_of(load(tmp_path / "ball.toml"), tmp_path / "ball.fmu", fmi=fmi)
    assert validate_fmu(str(path)) == []
    rows = simulated(path, kind, 1.4, step=0.05)
    t, hit, speed = 1.4, np.sqrt(2 / 9.81), np.sqrt(2 * 9.81) * 0.7
    while hit + 2 * speed / 9.81 < t:
        hit, speed = hit + 2 * speed / 9.81, 0.7 * speed
    assert rows["time"][-1] == pytest.approx(t)
    assert rows["ball.y"][-1] == pytest.approx(speed * (t - hit) - 9.81 / 2 * (t - hit) ** 2, abs=1e-6)
    over = simulated(path, kind, 2.0, step=0.05)
    assert over["time"][-1] == pytest.approx(1.5, abs=0.051)


@pytest.mark.slow
def test_an_output_at_a_reset_has_the_velocities_behind_it(tmp_path):
    """In runs with steps of either kind, in C, and in both kinds of FMU."""
    struck = {
        "mechanism": {"name": "struck"},
        "bodies": {"a": {"type": "point", "mass": 1.0, "velocity": [1.0, 0.0]}},
        "events": {"blow": {"when": "a.x > 0.5", "reset": {"a.vx": "-2*a.vx"}}},
        "run": {"until": 1.0, "step": 0.0625, "output_step": 0.125},
    }
    model, expected = load(mechanism_of(struck)), [1.0] * 4 + [-2.0] * 5
    for coordinates in ("absolute", "joint"):
        for settings in ({"integrator": "picard"}, {"integrator": "dop853"}, {"integrator": "rk4", "step": 0.0625}):
            result = model.simulate(coordinates=coordinates, **settings)
            assert result.ok and list(result["a.vx"]) == pytest.approx(expected) and result.events[0].v["a.vx"] == 1.0
            energy = result.kinetic + result.potential - result.work
            assert list(energy) == pytest.approx([0.5] * 9)
    _, rows = rows_of(compiled(written(model.mechanism, tmp_path / "c")))
    assert list(rows[:, 3]) == pytest.approx(expected)
    for kind in ("CoSimulation", "ModelExchange"):
        found = simulated(fmu_of(model, tmp_path / "struck.fmu"), kind, 1.0, step=0.125)
        assert list(found["a.vx"]) == pytest.approx(expected), kind


@pytest.mark.slow
def test_a_co_simulation_that_locks_logs_what_a_run_says(tmp_path):
    description, expected, _ = LOCKED["four-bar-lock"]
    model, lines = load(mechanism_of(description)), []
    path = fmu_of(model, tmp_path / "locked.fmu", fmi=3)
    with pytest.raises(FMICallException):
        simulate_fmu(
            str(path), fmi_type="CoSimulation", stop_time=1.0, output_interval=0.01,
            logger=lambda *words: lines.append(words[-1].decode()),
        )  # fmt: skip
    found, moved = parts(lines[0]), parts(model.kinematics([0.0, 0.3, 1.0]).ended)
    assert found[0] == pytest.approx(expected, abs=1e-5) and found[1:] == moved[1:]


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_mechanism_in_space_has_one_degree_of_freedom(tmp_path):
    model = load("bricard")
    path = fmu_of(model, tmp_path / "bricard.fmu")
    assert validate_fmu(str(path)) == []
    assert size_of(path) < 200_000
    rows = simulated(path, "ModelExchange", 1.0)
    own = model.simulate(method="direct-correction", integrator="dop853", rtol=1e-12, until=1.0, output_step=0.1)
    for name in own.q.names:
        np.testing.assert_allclose(np.abs(rows[name]), np.abs(own[name]), rtol=0, atol=2e-6)


CONTROLLER = """
[mechanism]
name = "controller"
gravity = [0.0, 0.0]
[inputs]
speed = 0.0
[parameters]
kp = 0.3
ki = 2.0
[bodies.clock]
type = "point"
mass = 1.0
[states.total]
start = "0*kp"
rate = "4.0 - speed"
[outputs]
command = { value = "kp*(4.0 - speed) + ki*total" }
[run]
until = 1.0
step = 1e-3
"""


def wiper_driven_by(command, **more):
    """Return the wiper of the catalogue with a command before the torque of its motor."""
    raw = catalogue.raw("wiper")
    raw["forces"]["motor"]["torque"] = f"({command})*size*curve(rate)"
    return load(validate(raw | more, "wiper"))


class Unit:
    """An FMU in co-simulation."""

    def __init__(self, path, parameters):
        description = read_model_description(str(path))
        self.names = {v.name: v.valueReference for v in description.modelVariables}
        self.slave = FMU2Slave(
            guid=description.guid, unzipDirectory=extract(str(path), str(path.with_suffix(""))),
            modelIdentifier=description.coSimulation.modelIdentifier, instanceName=path.stem,
        )  # fmt: skip
        self.slave.instantiate()
        self.slave.setupExperiment(startTime=0.0)
        for name, value in parameters.items():
            self[name] = value
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def __getitem__(self, name):
        return self.slave.getReal([self.names[name]])[0]

    def __setitem__(self, name, value):
        self.slave.setReal([self.names[name]], [value])

    def close(self):
        self.slave.terminate()
        self.slave.freeInstance()


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_controller_drives_the_wiper_in_one_co_simulation(tmp_path):
    parameters = {"crank_length": 0.045}
    (tmp_path / "controller.toml").write_text(CONTROLLER)
    plant = wiper_driven_by("drive", inputs={"drive": 0.0})
    paths = [
        fmu_of(plant, tmp_path / "wiper.fmu"),
        fmu_of(load(tmp_path / "controller.toml"), tmp_path / "controller.fmu"),
    ]
    whole = wiper_driven_by(
        "0.3*(4.0 - crank.omega) + 2.0*total", states={"total": {"start": "0*size", "rate": "4.0 - crank.omega"}}
    ).simulate(until=1.5, parameters=parameters, output_step=0.5)
    gaps = []
    for h in (1e-3, 5e-4):
        wiper, controller = Unit(paths[0], parameters), Unit(paths[1], {})
        run, total = plant.start(parameters=parameters, method="direct-correction", integrator="rk4", step=h), 0.0
        for k in range(round(1.5 / h)):
            controller["speed"] = wiper["crank.omega"]
            wiper["drive"] = controller["command"]
            wiper.slave.doStep(k * h, h)
            controller.slave.doStep(k * h, h)
            # the same loop in steps of symgen: both hold their inputs over a step
            speed = run.v["crank.omega"]
            run.step(h, {"drive": 0.3 * (4.0 - speed) + 2.0 * total})
            total += h * (4.0 - speed)
        for name in ("crank.omega", "arm.theta"):
            assert wiper[name] == pytest.approx(run[name], abs=1e-11)
        gaps.append([wiper[name] - whole[name][-1] for name in ("crank.omega", "arm.theta")])
        wiper.close()
        controller.close()
    # one run of mechanism and controller together has no delay; that of sampling is of the first order
    coarse, fine = np.array(gaps)
    np.testing.assert_allclose(coarse, 2 * fine, rtol=0.02)
    assert np.abs(coarse - 2 * fine).max() < 2e-5


def test_what_an_fmu_has_not_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"-o: expected a file ending in \.fmu"):
        fmu_of(load("pendulum"), tmp_path / "pendulum")
    with pytest.raises(InputError, match="fmi: expected 2 or 3, got 1"):
        fmu_of(load("pendulum"), tmp_path / "pendulum.fmu", fmi=1)
    assert not list(tmp_path.iterdir())


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_friction_and_stops_in_co_simulation(tmp_path):
    model = load("toggle-press")
    path = fmu_of(model, tmp_path / "model.fmu", fmi=3)
    assert validate_fmu(str(path)) == []
    step, until = model.mechanism.defaults.step, min(1.5, model.mechanism.defaults.until)
    # points of communication shorten no step, so that rows are those of a run to rounding
    rows = simulate_fmu(str(path), stop_time=until, step_size=7 * step, output_interval=7 * step)
    own = model.simulate(
        method="direct-correction", integrator="rk4", step=step, until=until, times=rows["time"], coordinates="absolute"
    )
    assert any(event.name == "guide.lower.hit" for event in own.events)
    for quantity in (*own.q.names, *own.v.names):
        np.testing.assert_allclose(rows[quantity], own[quantity], rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("unit", "exponents"),
    [
        ("N m/rad", {"kg": 1, "m": 2, "s": -2, "rad": -1}),
        ("kg m^2", {"kg": 1, "m": 2}),
        ("1", {}),
        ("furlong", None),
    ],
)
def test_units_are_products_of_base_units(unit, exponents):
    assert base_unit(unit) == exponents


@pytest.mark.slow
@pytest.mark.parametrize(("name", "fmi"), of_turn([(name, 2 + i % 2) for i, name in enumerate(NAMES)], 16))
def test_the_whole_catalogue(name, fmi, tmp_path):
    model = load(name)
    path = fmu_of(model, tmp_path / "model.fmu", fmi=fmi, coordinates="auto")
    assert validate_fmu(str(path)) == []
    step = model.mechanism.defaults.step
    until = min(0.1, 100 * step)
    own = model.simulate(
        method="direct-correction", integrator="rk4", step=step, until=until, output_step=until / 10,
        coordinates="auto", shape="straight",
    )  # fmt: skip
    rows = simulated(path, "CoSimulation", until)
    touches = any(row.in_contact for row in model.mechanism.bounded)  # an importer finds no modes of contacts
    exchanged = {} if touches else simulated(path, "ModelExchange", until, 1e-10)
    for quantity in own.q.names:
        scale = 1.0 + np.abs(own[quantity]).max()
        np.testing.assert_allclose(rows[quantity], own[quantity], rtol=0, atol=1e-9 * scale)
        if not touches:
            np.testing.assert_allclose(exchanged[quantity], own[quantity], rtol=0, atol=1e-5 * scale)


@pytest.mark.slow
def test_a_pins_force_is_an_output_of_both_kinds(tmp_path):
    text = (catalogue.file_of_entry("four-bar")).read_text() + '\n[outputs]\npin = { value = "C.F", unit = "N" }\n'
    (tmp_path / "four-bar.toml").write_text(text)
    model = load(tmp_path / "four-bar.toml")
    path = fmu_of(model, tmp_path / "four-bar.fmu")
    assert validate_fmu(str(path)) == []
    own = model.simulate(integrator="dop853", rtol=1e-11, until=0.5, output_step=0.1)
    for kind in ("CoSimulation", "ModelExchange"):
        rows = simulated(path, kind, 0.5, step=0.1)
        np.testing.assert_allclose(rows["pin"], own["C.F"], rtol=1e-6)
