"""Jumps of formulas at times that parameters give, in C and in FMUs, against runs with the same parameters."""

from types import SimpleNamespace

import numpy as np
import pytest
from fmpy import simulate_fmu
from support.rotation import of_turn

from symgen.compile.loopcode.loop_instances import Instances
from symgen.result.targets import Request
from symgen.result.targets._c_model import CModel, sources
from symgen.run.breaks.foreseen_seams import foresee_in_run
from symgen.run.layout import abi
from symgen.run.printed.foreseen_run import FORESEEN, foresee_run
from tests.result.targets.test_c_modes import DOOR, loaded, program_of, rows_of, transitions_of
from tests.result.targets.test_fmu import fmu_of, importer_of

#: A door that is pushed from `begin` on, for a time, and shaken by a wave and by a periodic table of two levels.
PUSHED = (
    DOOR
    + """
[parameters]
begin = 0.4
span = 0.2
push = 6.0
pace = 11.0
stretch = 1.0

[forces.hand]
type = "torque"
body = "rod"
torque = "push*(1 if t > begin and t < begin + span else 0)"

[forces.wave]
type = "torque"
body = "rod"
torque = "1 if sin(pace*t + 0.3) > 0.2 else 0"

[tables.teeth]
x = [0.0, 0.1, 0.15, 0.25]
y = [0.0, 0.2, 0.5, 0.0]
interpolation = "pchip"
periodic = true

[forces.teeth]
type = "torque"
body = "rod"
torque = "teeth(t*stretch)"

[run]
until = 1.0
step = 0.001
"""
)
#: Names of parameters in the order of their values.
NAMES = ("begin", "span", "push", "pace", "stretch")


def values_of(count):
    """Return values of the parameters; the first push begins behind `until` of the file."""
    random = np.random.default_rng(65)
    values = np.column_stack(
        [
            random.uniform(0.05, 1.4, count), random.uniform(0.02, 0.4, count), random.uniform(-9.0, 9.0, count),
            random.uniform(3.0, 25.0, count), random.uniform(0.4, 2.0, count),
        ]
    )  # fmt: skip
    values[0, 0] = 1.3
    return values


#: The search as plain Python.
PLAIN = Instances(FORESEEN, lambda copy, _: copy).of(foresee_run)


def laid_out(run, p, until):
    """Return times of seams, and which are skipped, that a run finds by itself: window after window up to its end."""
    passages, adaptive = run.passages, run.spec.adaptive
    foresight = passages.foresight(run.spec, np.array([0.0, until]))._replace(lines=passages.lines.plain)
    seams, result, t, start = passages.seams(run.compiled, adaptive), [], 0.0, 1
    state = SimpleNamespace(y=np.zeros(9), p=p, w=np.zeros(9), control=np.zeros(abi.N_CONTROL, dtype=np.int64))
    while t < until and PLAIN(start, t, foresight, seams, state):
        t, start = foresight.known[0], 0
        last = seams.rows[1] - (t < np.inf)  # which is the end of the window
        result += zip(seams.times[:last], seams.skips[:last], strict=True)
    return [(x, skip) for x, skip in result if x < until]


#: The stop of the door, and one that jumps.
STOP = "stop = { lower = -2.0, upper = 0.2, restitution = 0.4 }"
JUMPING = STOP.replace("0.2,", '"0.2 if t < begin else 0.3",')


@pytest.mark.by_turns(3)
@pytest.mark.parametrize("integrator", [None, "dop853"])
@pytest.mark.parametrize(
    ("torque", "stop", "count"),
    [
        ("1 if t > begin else 0", STOP, 300), ("1 if 2*t + begin > 9*span else 0", STOP, 300),
        ("max(t - begin, span)", STOP, 300), ("max(t - begin, 0) if t > begin else -1", JUMPING, 300),
        pytest.param("1 if sin(pace*t) > 0.2 else 0", STOP, 8, marks=pytest.mark.slow),
        pytest.param("1 if sin(pace*t)*t > 0.3*begin else 0", STOP, 8, marks=pytest.mark.slow),
        pytest.param("abs(begin*t - t*t) + (1 if begin*t - t*t > 0 else 0)", STOP, 8, marks=pytest.mark.slow),
        ("1 if t > begin and t < begin + span else max(t - begin, 0)", "", 300),
    ],
)  # fmt: skip
def test_a_run_finds_the_seams_that_are_known_before_it(torque, stop, count, integrator, tmp_path):
    """They are those of runs from Python, whatever the parameters are."""
    force = f'[forces.hand]\ntype = "torque"\nbody = "rod"\ntorque = "{torque}"\n[run]\nuntil = 1.0\n'
    numbers = "[parameters]\nbegin = 0.4\nspan = 0.2\npace = 11.0\n"
    model = loaded(DOOR.replace(STOP, stop) + numbers + force, tmp_path)
    integrator = integrator if stop else "dopri5"  # without rows with bounds, runs are printed by their names
    run = CModel.of(Request(model.mechanism, tmp_path / "c", integrator=integrator), "c").printed_run
    foreseen = foresee_in_run(model.mechanism, (), run.spec.adaptive, run.integrator.order, (0.0, run.spec.step))
    places, p, passed = {q.name: i for i, q in enumerate(run.compiled.info.parameters)}, np.zeros(99), 0
    for begin, span, _, pace, _ in values_of(count):
        values = {"begin": begin, "span": span, "pace": pace}
        for name, x in values.items():
            p[places[name]] = x
        expected = [(x.t, x.skips + x.strikes) for x in foreseen.seams(values, 1.0)] or [(0.0, 0)]
        seams = laid_out(run, p, 1.0)
        assert [skip for _, skip in seams] == [skip for _, skip in expected]
        assert [x for x, _ in seams] == pytest.approx([x for x, _ in expected], abs=1e-14)
        passed += len(expected) > 1
    assert passed > count // 4


@pytest.fixture(scope="module")
def pushed(tmp_path_factory):
    return loaded(PUSHED, tmp_path_factory.mktemp("pushed"))


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_files_whose_jumps_are_at_fixed_times_have_these_in_their_tables(tmp_path):
    fixed = PUSHED[: PUSHED.index("[forces.wave]")].replace("begin", "0.4").replace("0.4 = 0.4\n", "")
    fixed = fixed.replace("span", "0.2").replace("0.2 = 0.2\n", "") + "[run]\nuntil = 1.0\n"
    model = loaded(fixed, tmp_path)
    for target in ("c", "fmu"):
        text = sources(CModel.of(Request(model.mechanism, tmp_path / "x"), target).values)["door.c"]
        assert "foresee_run" not in text and "0.4" in text


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("keys", [{}, {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-13}])
def test_programs_end_where_runs_with_their_parameters_do(pushed, keys, tmp_path):
    """300 values of five parameters; and each goes on behind the end of the file's run."""
    program = program_of(pushed, tmp_path / "c", **keys)
    places = {name: i for i, name in enumerate(p.name for p in pushed.mechanism.parameters)}
    sweep = values_of(300)
    hits = 0
    for values in sweep[:: 1 if not keys else 3]:
        words = [word for name, x in zip(NAMES, values, strict=True) for word in (places[name], repr(float(x)))]
        rows, transitions = rows_of(program, 1.5, 0.001, *words)
        own = pushed.simulate(
            until=1.5, step=0.001, times=[0.0, 1.5], method="direct-correction",
            integrator="rk4", parameters=dict(zip(NAMES, map(float, values), strict=True)),
        ) if not keys else pushed.simulate(
            until=1.5, times=[0.0, 1.5], method="direct-correction", integrator="dop853", rtol=1e-11, atol=1e-13,
            parameters=dict(zip(NAMES, map(float, values), strict=True)),
        )  # fmt: skip
        assert own.ok
        state = np.array([own[name][-1] for name in (*own.q.names, *own.v.names)])
        np.testing.assert_allclose(rows[-1, 1 : len(state) + 1], state, rtol=0, atol=1e-9)
        expected = transitions_of(own)
        assert [word for _, word in transitions] == [word for _, word in expected]
        np.testing.assert_allclose([t for t, _ in transitions], [t for t, _ in expected], rtol=0, atol=1e-9)
        hits += len(expected)
    assert hits > 100


@pytest.mark.by_turns(5)
@pytest.mark.slow
def test_an_importer_is_told_the_times_that_its_parameters_give(tmp_path):
    """300 values of the begin of a push, some behind `until` of the file; each is a time event, and ends as a run."""
    text = PUSHED[: PUSHED.index("[forces.wave]")] + "[run]\nuntil = 1.0\n"
    model = loaded(text, tmp_path)
    path = fmu_of(model, tmp_path / "pushed.fmu", fmi=3)
    importer = importer_of(path, tmp_path / "fmu")
    for begin in of_turn(np.linspace(0.05, 1.4, 300), 6):
        rows = simulate_fmu(
            **importer, stop_time=1.5, relative_tolerance=1e-13, output_interval=0.0015,
            output=["rod.theta", "rod.omega"], start_values={"begin": begin},
        )  # fmt: skip
        importer["fmu_instance"].reset()
        events = rows["time"][1:][np.diff(rows["time"]) == 0.0]
        for t in (begin, begin + 0.2):
            assert t > 1.5 or np.abs(events - t).min() < 1e-14
        own = model.simulate(until=1.5, times=[0.0, 1.5], integrator="dop853", rtol=1e-12, parameters={"begin": begin})
        for name in ("rod.theta", "rod.omega"):
            assert rows[name][-1] == pytest.approx(own[name][-1], abs=1e-9)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_an_importer_goes_from_window_to_window(pushed, tmp_path):
    """Waves and periodic tables are searched for one span of the file's run after another."""
    path = fmu_of(pushed, tmp_path / "pushed.fmu", fmi=2)
    parameters = {"pace": 7.0, "begin": 2.25, "stretch": 1.3}
    rows = simulate_fmu(
        str(path), fmi_type="ModelExchange", stop_time=3.5, relative_tolerance=1e-12, output_interval=0.0035,
        output=["rod.theta", "rod.omega"], start_values=parameters,
    )  # fmt: skip
    events = rows["time"][1:][np.diff(rows["time"]) == 0.0]
    turns = np.arange(5)
    rises, falls = np.arcsin(0.2) + 2.0 * np.pi * turns, np.pi - np.arcsin(0.2) + 2.0 * np.pi * turns
    waves = (np.concatenate([rises, falls]) - 0.3) / 7.0
    teeth = np.concatenate([0.25 * np.arange(1, 18), 0.1 + 0.25 * np.arange(17), 0.15 + 0.25 * np.arange(17)]) / 1.3
    for t in (*waves, *teeth, 2.25, 2.45):
        assert t > 3.49 or t < 0.0 or np.abs(events - t).min() < 1e-13
    own = pushed.simulate(until=3.5, times=[0.0, 3.5], integrator="dop853", rtol=1e-12, parameters=parameters)
    assert rows["rod.theta"][-1] == pytest.approx(own["rod.theta"][-1], abs=1e-8)
