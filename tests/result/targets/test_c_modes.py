"""Dry friction, stops and ropes in C against runs: the same steps, transitions and states."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

import symgen
from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_fmu import fmu_of, simulated
from tests.run.modes.test_clutches import CLUTCH
from tests.run.modes.test_stops import BALL, ROPE

WORDS = ("slip", "stick", "reverse", "hit", "rest", "leave")
#: A loop around the functions of a model, which prints outputs and transitions.
PROGRAM = """
#include "{prefix}.h"
#include <stdio.h>
#include <stdlib.h>
static {prefix} model;
int main(int count, char **words) {{
    const double until = atof(words[1]), step = atof(words[2]);
    int event = -1, seen = 0;
    {prefix}_init(&model);
    for (int i = 3; i + 1 < count; i += 2) {prefix}_set(&model, atoi(words[i]), atof(words[i + 1]));
    int failed = {prefix}_start(&model);
    for (long k = 1; !failed && event < 0; k++) {{
        double columns[{upper}_COLUMNS], t;
        const char *word;
        {prefix}_bodies(&model, model.t, model.y, columns);
        printf("%.17g", model.t);
        for (int i = 0; i < {upper}_COLUMNS; i++) printf(",%.17g", columns[i]);
        printf("\\n");
        for (; (word = {prefix}_transition(&model, seen, &t)); seen++) fprintf(stderr, "%.17g %s\\n", t, word);
        if (k*step > until*(1 + 1e-12)) break;
        failed = {prefix}_show(&model, k*step, step, &event);
    }}
    return failed;
}}
"""
#: One call, after which transitions are read as the guide has it; each is a line, and the last line counts lost ones.
ONE_CALL = """
#include "{prefix}.h"
#include <stdio.h>
int main(void) {{
    static {prefix} model;
    int event, told = 0, lost = 0;
    {prefix}_init(&model);
    if ({prefix}_start(&model) || {prefix}_show(&model, 9.0, 0.003, &event)) return 1;
    for (double t; told < model.transitions_count[0]; told++) {{
        const char *word = {prefix}_transition(&model, told, &t);
        if (word) printf("%.17g %s\\n", t, word);
        else lost++;
    }}
    printf("%d\\n", lost);
    return 0;
}}
"""
HEAD = '[mechanism]\nname = "{}"\ngravity = [0.0, -9.81]\n'
#: A pendulum between two stops.
DOOR = (
    HEAD.format("door")
    + """
[bodies.rod]
mass = 1.2
inertia = 0.3
position = [0.5, 0.0]

[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], [-0.5, 0.0]]
stop = { lower = -2.0, upper = 0.2, restitution = 0.4 }
"""
)


def program_of(model: symgen.Model, folder: Path, **keys) -> Path:
    """Return a program that prints outputs and transitions, compiled without a warning."""
    written(model.mechanism, folder, **keys)
    prefix = next(folder.glob("*.h")).stem
    (folder / "main.c").write_text(PROGRAM.format(prefix=prefix, upper=prefix.upper()))
    return compiled(folder)


def rows_of(program: Path, *words: object) -> tuple[np.ndarray, list[tuple[float, str]]]:
    """Return outputs and transitions of a program."""
    ran = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=True)
    pairs = (line.split() for line in ran.stderr.splitlines())
    return np.loadtxt(ran.stdout.splitlines(), delimiter=","), [(float(t), word) for t, word in pairs]


def transitions_of(result: symgen.Result) -> list[tuple[float, str]]:
    """Return the transitions of a run."""
    return [(event.t, event.name) for event in result.events if event.name.rpartition(".")[2] in WORDS]


def assert_same_run(model, program, until, step, coordinates="absolute", most=1e-9):
    """Compare a program with the run of its model."""
    rows, transitions = rows_of(program, until, step)
    result = model.simulate(
        method="direct-correction", integrator="rk4", step=step, until=until, times=rows[:, 0], coordinates=coordinates
    )
    assert result.ok
    own = np.array([result[name] for name in (*result.q.names, *result.v.names)]).T
    assert np.abs(own - rows[:, 1 : own.shape[1] + 1]).max() < most
    expected = transitions_of(result)
    assert [word for _, word in transitions] == [word for _, word in expected]
    np.testing.assert_allclose([t for t, _ in transitions], [t for t, _ in expected], rtol=0, atol=most)
    return transitions


def loaded(text, tmp_path):
    (tmp_path / "model.toml").write_text(text)
    return symgen.load(tmp_path / "model.toml")


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_block_on_a_belt_sticks_and_slips(tmp_path):
    model = symgen.load("belt-oscillator")
    program = program_of(model, tmp_path / "c")
    transitions = assert_same_run(model, program, 2.0, 0.002)
    assert [word for _, word in transitions] == ["contact.slip", "contact.stick"] * 2
    assert len((tmp_path / "c" / "belt_oscillator.c").read_text()) < 210_000


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_impacts_of_a_ball_accumulate(tmp_path):
    model = loaded(BALL, tmp_path)
    transitions = assert_same_run(model, program_of(model, tmp_path / "c"), 2.7, 0.003)
    fall = np.sqrt(2.0 / 9.81)
    assert transitions[0] == (pytest.approx(fall, abs=1e-12), "floor.hit")
    assert transitions[-1][1] == "floor.rest"
    assert transitions[-1][0] == pytest.approx(fall * (1.0 + 0.7) / (1.0 - 0.7), abs=1e-5)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_program_keeps_as_many_transitions_as_it_asks_for(tmp_path):
    """A ball strikes the floor more than a hundred times in one call."""
    model = loaded(BALL.replace("restitution = 0.7", "restitution = 0.9"), tmp_path)
    run = model.simulate(method="direct-correction", integrator="rk4", step=3e-3, until=9.0, verify=False)
    expected, folder = transitions_of(run), written(model.mechanism, tmp_path / "c")
    (folder / "main.c").write_text(ONE_CALL.format(prefix="ball"))
    assert run.ok and len(expected) > 100
    for kept, options in ((64, ()), (100, ("-DBALL_TRANSITIONS=100",)), (1000, ("-DBALL_TRANSITIONS=1000",))):
        ran = subprocess.run([compiled(folder, *options)], capture_output=True, text=True, check=True)
        *lines, lost = ran.stdout.splitlines()
        assert int(lost) == max(0, len(expected) - kept)
        assert [line.split()[1] for line in lines] == [word for _, word in expected[int(lost) :]]
        times = [float(line.split()[0]) for line in lines]
        np.testing.assert_allclose(times, [t for t, _ in expected[int(lost) :]], rtol=0.0, atol=1e-9)


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("source", "until", "step", "coordinates"),
    [
        (DOOR, 4.0, 1e-3, "joint"),
        (ROPE, 2.0, 1e-3, "absolute"),
        ("toggle-press", 0.4, 2e-4, "absolute"),
        ("dry-four-bar", 8.0, 1e-3, "joint"),
    ],
)
def test_runs_with_stops_ropes_and_friction(source, until, step, coordinates, tmp_path):
    model = loaded(source, tmp_path) if "\n" in source else symgen.load(source)
    program = program_of(model, tmp_path / "c", coordinates=coordinates)
    assert len(assert_same_run(model, program, until, step, coordinates)) > 2


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_a_clutch_locks_in_c_and_in_an_fmu_when_its_closed_form_does(tmp_path):
    """Torques -2 t and 2 t on 2 and 3 kg m^2: equal speeds of 4 rad/s where t^2 (1/2 + 1/3) = 10."""
    text = CLUTCH.replace('sliding = "pressure"', 'sliding = "slope*t"') + "[run]\nuntil = 5.0\nstep = 0.002\n"
    model = loaded(text, tmp_path)
    ((time, word),) = assert_same_run(model, program_of(model, tmp_path / "c"), 5.0, 0.002)
    assert (time, word) == (pytest.approx(np.sqrt(12.0), abs=1e-10), "clutch.stick")
    rows = simulated(fmu_of(model, tmp_path / "clutch.fmu"), "CoSimulation", 5.0, step=0.5, outputs=["load.omega"])
    assert rows["load.omega"][-1] == pytest.approx(4.0, abs=1e-10)


#: The same, at rest on a stop, and an event that has it leave.
KICKED = (
    DOOR.replace("lower = -2.0", "lower = -1.0").replace("[bodies.rod]", "[parameters]\nkick = 0.7\n\n[bodies.rod]")
    + '\n[events.kick]\nwhen = "t - 3.0"\nreset = { "rod.omega" = "kick - 0.5*rod.omega" }\n'
)
RESETTING = """
#include "{prefix}.h"
#include <stdio.h>
#include <stdlib.h>
static {prefix} model;
int main(int count, char **words) {{
    const double kick = count > 1 ? atof(words[1]) : 0;
    {prefix}_init(&model);
    {prefix}_set(&model, {upper}_P_kick, kick);
    int event, failed = {prefix}_start(&model);
    for (int k = 1; k < 300 && !failed; k++) {{
        double y[{upper}_NY], first[{upper}_NY], second[{upper}_NY];
        double before[{upper}_COLUMNS], behind[{upper}_COLUMNS];
        failed = {prefix}_show(&model, 0.01*k, 1e-3, &event);
        for (int i = 0; i < {upper}_NY; i++) y[i] = model.y[i];
        {prefix}_bodies(&model, model.t, y, before);
        {prefix}_rates(&model, model.t, model.y, first);
        failed = failed || {prefix}_reset(&model, model.t, 0, y);
        {prefix}_bodies(&model, model.t, y, behind);
        {prefix}_rates(&model, model.t, model.y, second);
        for (int i = 0; i < {upper}_NY; i++) failed = failed || first[i] != second[i];
        printf("%.17g %.17g\\n", before[5], behind[5]);
    }}
    failed = failed || {prefix}_advance(&model, 3.0, 1e-3, &event) || {prefix}_advance(&model, 3.01, 1e-3, &event);
    printf("%.17g %.17g %.17g\\n", model.t, model.y[2], model.y[5]);
    return failed;
}}
"""


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_reset_of_a_state_takes_rows_with_bounds_out_of_force_as_runs_do(tmp_path):
    """The rod rests on its stop long before 3 s; as it is held there, no velocity could be given to it."""
    model = loaded(KICKED, tmp_path)
    folder = written(model.mechanism, tmp_path / "c")
    (folder / "main.c").write_text(RESETTING.format(prefix="door", upper="DOOR"))
    program = str(compiled(folder))
    for kick in np.linspace(-1.0, 2.0, 13):
        ran = subprocess.run([program, repr(float(kick))], capture_output=True, text=True, check=True)
        *rows, (t, theta, omega) = [[float(word) for word in line.split()] for line in ran.stdout.splitlines()]
        before, behind = np.array(rows).T
        np.testing.assert_allclose(behind, kick - 0.5 * before, rtol=0.0, atol=1e-14)
        assert np.all(before[-50:] == 0.0)
        own = model.simulate(
            until=3.01, parameters={"kick": float(kick)}, integrator="rk4", step=1e-3, times=[3.0, 3.01], verify=False
        )
        assert t == pytest.approx(3.01)
        assert [theta, omega] == pytest.approx([own["rod.theta"][-1], own["rod.omega"][-1]], abs=1e-9)
