"""Whole runs in C by a named integrator, with error control, against runs: rows, transitions, reasons for ends."""

import subprocess
from pathlib import Path

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.locks import LOCKED

import symgen
from symgen.base.errors import InputError
from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c_modes import DOOR, HEAD, PROGRAM, loaded, rows_of, transitions_of
from tests.result.targets.test_fmu import fmu_of, simulated
from tests.run.modes.test_stops import BALL

BUCKET = (Path(__file__).parents[3] / "benchmarks" / "bounded" / "files" / "bucket.toml").read_text(encoding="utf-8")
#: A ball that bounces by a reset, and one whose rebounds end.
BOUNCING = (
    HEAD.format("bouncing")
    + """
[parameters]
e = 0.8

[bodies.ball]
type = "point"
mass = 1.0
position = [0.0, 1.0]
velocity = [1.0, 0.0]

[events.floor]
when = "ball.y < 0"
reset = { "ball.vy" = "-e*ball.vy" }
"""
)
#: A rod whose motor jumps twice, at times that are known.
DRIVEN = (
    DOOR.replace("stop = { lower = -2.0, upper = 0.2, restitution = 0.4 }\n", "")
    + """
[forces.motor]
type = "torque"
body = "rod"
torque = "0 if t < 1 else (3 if t < 2 else 2 - t)"

[run]
until = 4.0
"""
)
#: A block that is pushed by an input, without friction.
PUSHED = """
[mechanism]
name = "pushed"

[inputs]
push = 1.0

[bodies.block]
type = "point"
mass = 2.0

[forces.push]
type = "force"
body = "block"
force = ["push", 0.0]

[run]
until = 2.0
"""
#: A program that turns an input over at 1 s, between steps that are longer than its outputs are apart.
TURNING = """
#include "pushed.h"
#include <stdio.h>
int main(void) {
    static pushed model;
    int event, failed;
    pushed_init(&model);
    failed = pushed_start(&model);
    for (int k = 1; k <= 20 && !failed; k++) {
        if (k == 11) pushed_set(&model, PUSHED_P_push, -1.0);
        failed = pushed_show(&model, 0.1*k, 0, &event);
        printf("%.17g,%.17g,%.17g\\n", model.t, model.y[0], model.y[2]);
    }
    return failed;
}
"""


def run_of(program: Path, *words: object) -> subprocess.CompletedProcess[str]:
    """Return what a program prints, and how it ends."""
    return subprocess.run([program, *map(str, words)], capture_output=True, text=True)


def rows_in(text: str) -> np.ndarray:
    """Return the numbers of a program's rows, without their names."""
    return np.loadtxt(text.splitlines()[1:], delimiter=",", ndmin=2)


def assert_same_rows(model, folder, coordinates="absolute", most=1e-9, **keys):
    """Compare the rows of a program with the run of its model, to a given difference; return the run."""
    ran = run_of(compiled(written(model.mechanism, folder, integrator="dop853", coordinates=coordinates, **keys)))
    rows = rows_in(ran.stdout)
    tolerances = {name: keys[name] for name in ("rtol", "atol") if name in keys}
    options = {name: text for name, text in keys.get("options", {}).items()}
    result = model.simulate(integrator="dop853", coordinates=coordinates, options=options, **tolerances)
    own = np.array([result[name] for name in (*result.q.names, *result.v.names)]).T
    count = min(len(own), len(rows))
    assert count > 40 and np.abs(own[:count] - rows[:count, 1 : own.shape[1] + 1]).max() < most
    np.testing.assert_allclose(result.t[:count], rows[:count, 0], rtol=1e-13)
    assert ran.returncode == (result.status == "failed")
    return result, ran


@pytest.mark.slow
def test_a_program_prints_the_rows_of_a_run_with_error_control(tmp_path):
    result, _ = assert_same_rows(symgen.load("pendulum"), tmp_path)
    assert result.steps < 300  # several of the 1001 rows lie in one step
    header = (tmp_path / "pendulum.h").read_text()
    (size,) = (int(line.split()[3]) for line in header.splitlines() if "bytes at most" in line)
    probe = tmp_path / "probe" / "size.c"
    probe.parent.mkdir()
    probe.write_text(
        '#include "../pendulum.h"\n#include <stdio.h>\nint main(void) { printf("%zu", sizeof(pendulum)); }\n'
    )
    assert size - 64 < int(run_of(compiled(probe.parent)).stdout) <= size


@pytest.mark.slow
def test_an_input_that_changes_inside_a_step_acts_from_then_on(tmp_path):
    written(loaded(PUSHED, tmp_path).mechanism, tmp_path / "c", integrator="dop853")
    (tmp_path / "c" / "main.c").write_text(TURNING)
    t, x, v = np.loadtxt(run_of(compiled(tmp_path / "c")).stdout.splitlines(), delimiter=",").T
    late = np.maximum(t - 1.0, 0.0)
    np.testing.assert_allclose(v, 0.5 * t - late, rtol=0, atol=1e-13)
    np.testing.assert_allclose(x, 0.25 * t**2 - 0.5 * late**2, rtol=0, atol=1e-13)


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        (
            {"target": "c", "integrator": "radau5"},
            "integrator 'radau5': expected an explicit Runge-Kutta scheme: dop853",
        ),
        ({"target": "c", "integrator": "dop583"}, "expected an integrator, got 'dop583'; did you mean 'dop853'?"),
        ({"target": "c", "rtol": 1e-9}, "rtol: expected an integrator with it, such as 'dop853', got none"),
        ({"target": "c", "integrator": "dop853", "atol": -1.0}, "atol: expected a finite number above 0, got -1.0"),
        (
            {"target": "jax", "integrator": "dop853"},
            "integrator: expected target 'c' or 'fmu', which print a whole run",
        ),
        (
            {"target": "c", "integrator": "dop853", "options": {"dop853.adaptve": "false"}},
            "option integrator.adaptve: expected an option of dop853",
        ),
    ],
)
def test_integrators_that_are_not_printed_are_refused(keys, sentence, tmp_path):
    with pytest.raises(InputError) as error:
        symgen.load("pendulum").generate(tmp_path / "c", **keys)
    assert sentence in str(error.value)


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("source", "until", "step", "coordinates"),
    [
        ("belt-oscillator", 4.0, 0.01, "absolute"),
        ("dry-four-bar", 8.0, 0.01, "joint"),
        (BALL, 4.0, 0.01, "absolute"),
        ("toggle-press", 0.4, 2e-3, "absolute"),
        (BUCKET, 1.0, 0.01, "joint"),
    ],
)
def test_transitions_are_those_of_runs(source, until, step, coordinates, tmp_path):
    model = loaded(source, tmp_path) if "\n" in source else symgen.load(source)
    written(model.mechanism, tmp_path / "c", integrator="dop853", coordinates=coordinates)
    prefix = next((tmp_path / "c").glob("*.h")).stem
    first = model.mechanism.defaults.first_step or 0.0
    program = PROGRAM.format(prefix=prefix, upper=prefix.upper()).replace("k*step, step,", f"k*step, {first},")
    begun = f"{prefix}_init(&model);"
    (tmp_path / "c" / "main.c").write_text(program.replace(begun, f"{begun} {prefix}_end(&model, until);"))
    rows, transitions = rows_of(compiled(tmp_path / "c"), until, step)
    result = model.simulate(integrator="dop853", until=until, times=rows[:, 0], coordinates=coordinates)
    assert result.ok
    own = np.array([result[name] for name in (*result.q.names, *result.v.names)]).T
    assert np.abs(own - rows[:, 1 : own.shape[1] + 1]).max() < 1e-9
    expected = transitions_of(result)
    assert len(expected) > 2 and [word for _, word in transitions] == [word for _, word in expected]
    np.testing.assert_allclose([t for t, _ in transitions], [t for t, _ in expected], rtol=0, atol=1e-9)


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("source", "keys"),
    [
        ("four-bar", {"coordinates": "joint", "rtol": 1e-12, "atol": 1e-14}),
        ("slider-crank", {"options": {"dop853.adaptive": "false"}}),
        (DRIVEN, {"rtol": 1e-12, "atol": 1e-14}),
        (BOUNCING + "[run]\nuntil = 3.5\n", {}),
        ("shaper", {"rtol": 1e-12, "atol": 1e-14}),
    ],
)
def test_rows_of_smooth_files(source, keys, tmp_path):
    """Steps end at switches, kinks and jumps; where steps are chosen by rounding, only the tolerance is common."""
    model = loaded(source, tmp_path) if "\n" in source else symgen.load(source)
    assert_same_rows(model, tmp_path / "c", **keys)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["accumulation", "slider-lock"])
def test_runs_that_end_early_say_why(name, tmp_path):
    if name == "accumulation":
        model = loaded(BOUNCING + "[run]\nuntil = 6.0\n", tmp_path)
    else:
        model = symgen.load(mechanism_of(LOCKED[name][0]))
    result, ran = assert_same_rows(model, tmp_path / "c")
    assert result.status == "failed" and ran.stderr == f"{result.reason}\n"


@pytest.mark.slow
def test_an_fmu_steps_by_a_named_integrator(tmp_path):
    """Points of communication shorten no step; the stop time of the importer is the end of the run."""
    model = symgen.load("four-bar")
    fmu = fmu_of(model, tmp_path / "four-bar.fmu", integrator="dop853")
    rows = simulated(fmu, "CoSimulation", 5.0, step=0.05, outputs=["crank.theta"])
    result = model.simulate(integrator="dop853", until=5.0, times=rows["time"])
    np.testing.assert_allclose(rows["crank.theta"], result["crank.theta"], rtol=0, atol=1e-9)
