"""C code beside what Numba and symgen's own compiler make of the same functions, and its runs beside `simulate`."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.in_coordinates import in_coordinates
from support.locks import LOCKED, parts
from support.rotation import of_turn
from support.switching import with_switchable

from symgen import Settings, load
from symgen.base.errors import InputError
from symgen.compile.native.c99 import c_functions
from symgen.describe.catalogue import MACHINES, entries
from symgen.result.targets import TARGETS, Request
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from tests.result.targets.compilers import called, compiled, written

STATES = 1000
NAMES = [entry.name for entry in (*entries(), *entries(MACHINES)) if not entry.sized] + ["chain:4", "n-four-bar:2"]
QUICK = [
    ("four-bar", "absolute"),
    ("bricard", "joint"),
    ("wiper", "absolute"),
    ("rolling-disc", "absolute"),
    ("curved-lever", "absolute"),
]


def agree(name, coordinates, folder):
    mechanism = load(name).mechanism
    library = called(written(mechanism, folder, coordinates=coordinates))
    settings = Settings("direct-correction", integrator="rk4", shape="straight", coordinates=coordinates)
    run = prepare(mechanism, settings, Purpose.STATE)
    info, law, start = run.compiled.info, run.compiled.law_module, run.start
    y0, p = np.zeros(info.ny), np.zeros(len(start.p))
    assert library.begin(y0, p) == 0
    np.testing.assert_allclose(y0, start.y[: info.ny], rtol=1e-11, atol=1e-11)
    np.testing.assert_allclose(p, start.p, rtol=1e-14, atol=1e-14)
    random, w, iw = np.random.default_rng(1), start.w.copy(), np.zeros(16, dtype=np.int64)
    if mechanism.bounded:  # the start of a run chooses their modes
        begun = prepare(mechanism, settings).simulation()
        begun.turn.begin()
        w = begun.state.w.copy()
    speed = 1.0 + np.abs(y0[info.nq : info.work]).max()
    rates = corrections = 0.0
    for k in range(STATES):
        y, t = y0.copy(), float(random.uniform(0.0, 1.0))
        y[: info.nq] += 1e-3 * random.standard_normal(info.nq)
        y[info.nq : info.work] += speed * random.standard_normal(info.nv)
        here, there = np.zeros(info.ny), np.zeros(info.ny)
        if law.rhs(t, y, start.p, w, iw, here) and hasattr(law, "confirm"):
            iw[0] = 1
            law.confirm(t, y, start.p, w, iw, here)
            iw[0] = 0
        failed = library.rates(t, y, there)
        assert bool(failed) != bool(np.isfinite(here).all())
        if not failed:
            rates = max(rates, np.abs(here - there).max() / np.abs(here).max())
        if k < 100:  # states that are a step's error off
            y = y0.copy()
            y[: info.work] += 1e-7 * random.standard_normal(info.work)
            mine, own = y.copy(), np.append(y, np.zeros(8))
            start_w = w.copy()
            code = library.corrected(0.0, 1e-3, mine)
            bits = law.accept(0.0, own, start.p, start_w, iw)
            assert code == bits & 1
            corrections = max(corrections, np.abs(mine - own[: info.ny]).max() / max(1.0, np.abs(own).max()))
    return rates, corrections


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates"), QUICK)
def test_rates_and_corrections_are_those_of_numba(name, coordinates, tmp_path):
    rates, corrections = agree(name, coordinates, tmp_path)
    assert rates < 1e-11
    assert corrections < 1e-13


@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates"), of_turn(in_coordinates(NAMES), 16))
def test_the_whole_catalogue(name, coordinates, tmp_path):
    rates, corrections = agree(name, coordinates, tmp_path)
    # strains of a stiff beam are small differences of positions
    assert rates < (1e-9 if load(name).mechanism.beams else 1e-11)
    assert corrections < 1e-11


def rows_of(program, *words):
    result = subprocess.run([str(program), *words], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    head, *rows = result.stdout.splitlines()
    return head.split(","), np.array([row.split(",") for row in rows], dtype=float)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "coordinates"), [("four-bar", "joint"), ("slider-crank", "absolute"), ("curved-lever", "absolute")]
)
def test_the_program_runs_as_simulate_does(name, coordinates, tmp_path):
    model = load(name)
    names, rows = rows_of(compiled(written(model.mechanism, tmp_path, coordinates=coordinates)), "0.5")
    result = model.simulate(
        method="direct-correction", integrator="rk4", step=model.mechanism.defaults.step, until=0.5,
        coordinates=coordinates, shape="straight",
    )  # fmt: skip
    columns = ["t", *result.q.names, *result.v.names]  # outputs of joints follow
    assert names[: len(columns)] == columns
    assert rows[-1, 0] == 0.5
    end = np.concatenate([result.q.values[-1], result.v.values[-1]])
    np.testing.assert_allclose(rows[-1, 1 : len(end) + 1], end, rtol=1e-11, atol=1e-11)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", LOCKED)
@pytest.mark.parametrize("step", ["1e-3", "1e-2"])
def test_a_program_that_locks_says_what_a_run_says(name, step, tmp_path):
    description, expected, free = LOCKED[name]
    mechanism = mechanism_of(description)
    moved = parts(load(mechanism).kinematics([0.0, 0.3, 1.0]).ended)
    ended = subprocess.run([compiled(written(mechanism, tmp_path)), "2", step], capture_output=True, text=True)
    assert ended.returncode == 1 and ended.stderr.startswith("dead centre at t = ")
    found = parts(ended.stderr.strip())
    assert found[0] == pytest.approx(expected, abs=1e-5) and found[1:] == moved[1:] and found[2] >= free
    assert float(ended.stdout.splitlines()[-1].partition(",")[0]) <= expected


@pytest.mark.slow
def test_a_program_whose_forces_are_undefined_says_until_when(tmp_path):
    """The root of 0.25 - t has no value behind 0.25 s, and nothing locks."""
    pushed = {
        "mechanism": {"name": "rooted"},
        "bodies": {"a": {"type": "point", "mass": 2.0}},
        "forces": {"f": {"type": "force", "body": "a", "at": "centre", "force": ["sqrt(0.25 - t)", 0.0]}},
    }
    program = compiled(written(mechanism_of(pushed), tmp_path))
    ended = subprocess.run([program, "1", "0.03"], capture_output=True, text=True)
    assert ended.returncode == 1 and ended.stderr == "the motion cannot be continued at t = 0.25 s\n"


@pytest.mark.slow
@pytest.mark.parametrize("origin", [0.0, 1e4])
def test_whether_joints_close_does_not_depend_on_the_origin(origin, tmp_path):
    """Two rods of 1 m reach each other as long as their pivots are at most 2 m apart."""
    rod = {"mass": 1.0, "inertia": 0.1, "points": {"a": [-0.5, 0.0], "b": [0.5, 0.0]}}
    described = {
        "mechanism": {"name": "reach"},
        "parameters": {"gap": 1.9},
        "bodies": {
            "left": {**rod, "position": [origin + 0.475, 0.156], "angle": 0.318},
            "right": {**rod, "position": [origin + 1.425, 0.156], "angle": -0.318},
        },
        "joints": {
            "A": {"type": "revolute", "between": ["ground", "left"], "at": [[origin, 0.0], "a"]},
            "B": {"type": "revolute", "between": ["left", "right"], "at": ["b", "a"]},
            "C": {"type": "revolute", "between": ["ground", "right"], "at": [[f"{origin} + gap", 0.0], "b"]},
        },
    }
    library = called(written(mechanism_of(described), tmp_path))
    y = np.zeros(13)
    assert library.begin(y, np.zeros(99)) == 0
    library.set(0, 1.9999)
    assert library.start(y) == 0
    ends = y[:2] + 0.5 * np.array([np.cos(y[2]), np.sin(y[2])])
    assert ends - [origin, 0.0] == pytest.approx([0.99995, np.sqrt(1.0 - 0.99995**2)], abs=1e-9)
    library.set(0, 2.0 + 1e-6)
    assert library.start(y) == 1


BALL = """
[mechanism]
name = "gamma"
gravity = [0.0, -9.81]
[parameters]
e = 0.7
[bodies.ball]
type = "point"
mass = 1.0
position = [0.0, 1.0]
velocity = [1.0, 0.0]
[events.floor]
when = "ball.y < 0"
reset = { "ball.vy" = "-e*ball.vy" }
[events.far]
when = "ball.x > 1.5"
action = "stop"
[run]
until = 2.0
step = 1e-3
"""


@pytest.mark.slow
def test_events_change_velocities_and_end_the_run(tmp_path):
    # also: a mechanism whose name is one of the mathematical library's
    (tmp_path / "ball.toml").write_text(BALL)
    names, rows = rows_of(compiled(written(load(tmp_path / "ball.toml").mechanism, tmp_path / "c")))
    t, hit, speed = rows[-1, 0], np.sqrt(2 / 9.81), np.sqrt(2 * 9.81) * 0.7
    while hit + 2 * speed / 9.81 < t:
        hit, speed = hit + 2 * speed / 9.81, 0.7 * speed
    assert t == pytest.approx(1.5, abs=1e-12)
    height = speed * (t - hit) - 9.81 / 2 * (t - hit) ** 2
    assert rows[-1, names.index("ball.y")] == pytest.approx(height, abs=1e-11)


STONE = """
[mechanism]
name = "stone"
space = "spatial"
gravity = [0.0, 0.0, -9.81]
[bodies.stone]
mass = 1.0
inertia = [1.0, 2.0, 2.5{products}]
position = [0.0, 0.0, 1.0]
angular_velocity = [1.0, 0.5, 0.2]
[events.floor]
when = "stone.z < 0"
reset = {{ "stone.vz" = "-0.5*stone.vz" }}
[run]
until = 0.6
step = 1e-3
"""


@pytest.mark.slow
@pytest.mark.parametrize("products", ["", ", 0.1, 0.0, 0.0"])
def test_a_body_in_space_is_changed_whether_its_axes_are_principal_or_not(products, tmp_path):
    (tmp_path / "stone.toml").write_text(STONE.format(products=products))
    model = load(tmp_path / "stone.toml")
    names, rows = rows_of(compiled(written(model.mechanism, tmp_path / "c")))
    hit = np.sqrt(2 / 9.81)
    height = 0.5 * 9.81 * hit * (0.6 - hit) - 9.81 / 2 * (0.6 - hit) ** 2
    assert rows[-1, names.index("stone.z")] == pytest.approx(height, abs=1e-11)
    result = model.simulate(method="direct-correction", integrator="rk4", step=1e-3, shape="straight")
    end = np.concatenate([result.q.values[-1], result.v.values[-1]])
    np.testing.assert_allclose(rows[-1, 1 : len(end) + 1], end, rtol=1e-9, atol=1e-9)


@pytest.mark.slow
def test_a_length_that_changes_closes_the_mechanism_anew(tmp_path):
    model = load("wiper")
    library = called(written(model.mechanism, tmp_path))
    names = [p.name for p in model.mechanism.parameters]
    info = prepare(model.mechanism, Settings(shape="straight"), Purpose.STATE).compiled.info
    y, p = np.zeros(info.ny), np.zeros(1000)
    library.begin(y, p)
    changed = next(n for n, q in zip(names, model.mechanism.parameters, strict=True) if q.unit == "m" and not q.formula)
    value = 1.02 * p[names.index(changed)]
    library.set(names.index(changed), value)
    assert library.start(y) == 0
    own = prepare(model.mechanism, Settings(parameters={changed: value}, shape="straight"), Purpose.STATE).start
    np.testing.assert_allclose(y[: info.work], own.y[: info.work], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"shape": "looped"}, "--target c: expected the straight shape, got looped"),
        ({"methods": ("lagrange", "penalty")}, "--target c: expected one method, got lagrange, penalty"),
        ({"methods": None}, "--target c: expected one method, got all"),
    ],
)
def test_what_c_has_not_is_refused(keys, words, tmp_path):
    with pytest.raises(InputError, match=words):
        written(load("pendulum").mechanism, tmp_path / "c", **keys)
    assert not (tmp_path / "c").exists()


@pytest.mark.slow
def test_numbers_of_32_bits(tmp_path):
    folder = written(load("pendulum").mechanism, tmp_path)
    program = compiled(folder, "-DPENDULUM_SINGLE", "-fsingle-precision-constant")
    _, rows = rows_of(program, "0.5")
    result = load("pendulum").simulate(method="direct-correction", integrator="rk4", step=1e-3, until=0.5)
    assert rows[-1, 1] == pytest.approx(result.q.values[-1, 0], abs=1e-4)


@pytest.mark.slow
def test_long_functions_are_divided(tmp_path):
    run = prepare(load("front-suspension").mechanism, Settings("lagrange", shape="straight"), Purpose.STATE)
    from symgen.run.compiling.checked import check_kernels

    text = c_functions(check_kernels(run.compiled, ("rhs",)))
    assert "rhs_part1(" in text
    assert max(map(len, text.split("\n\n"))) < 60_000


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["wiper", "bricard"])
def test_bytes_do_not_depend_on_the_process(name, tmp_path):
    texts = []
    for seed in ("1", "2"):
        folder = tmp_path / seed
        command = [sys.executable, "-m", "symgen", "generate", name, "--target", "c", "--output", str(folder)]
        subprocess.run(command, check=True, capture_output=True, env={**os.environ, "PYTHONHASHSEED": seed})
        texts.append({path.name: path.read_text() for path in folder.iterdir()})
    assert texts[0] == texts[1]


@pytest.mark.slow
def test_the_loop_of_the_guide_compiles(tmp_path):
    guide = (Path(__file__).parents[3] / "docs" / "howto" / "c-and-fmu.md").read_text(encoding="utf-8")
    (loop,) = [block.split("```")[0] for block in guide.split("```c\n") if block.startswith('#include "cart_pole.h"')]
    folder = written(load("cart-pole").mechanism, tmp_path)
    (folder / "main.c").write_text(loop + "int main(void) { setup(); for (int i = 0; i < 10; i++) loop(); }")
    assert compiled(folder, "-DCART_POLE_SINGLE", "-fsingle-precision-constant").exists()


def test_javascript_is_a_module(tmp_path):
    TARGETS.get("javascript").write(Request(load("four-bar").mechanism, tmp_path))
    text = (tmp_path / "four-bar.mjs").read_text()
    assert "export const model = makeLive(" in text
    assert "function rhs(t, y, p, w, iw, ydot)" in text


@pytest.mark.slow
def test_a_program_holds_joints_that_may_be_off(tmp_path):
    """It has no transitions: rows that may be off are in force, as `run` begins."""
    whole = load("four-bar").mechanism
    switched = with_switchable(whole, whole.joints[-1].name)
    rows = [rows_of(compiled(written(x, tmp_path / n)), "0.5")[1] for x, n in ((switched, "a"), (whole, "b"))]
    np.testing.assert_allclose(rows[0][-1], rows[1][-1], rtol=1e-9, atol=1e-9)


IMPATIENT = """
#include "{prefix}.h"
#include <stdio.h>
#include <stdlib.h>
static {prefix} model;
static void steps(void) {{
    int event = 7;
    const int step = {prefix}_step(&model, 1e-3), advance = {prefix}_advance(&model, 0.1, 1e-3, &event);
    printf("%d %d %d %g %s\\n", step, advance, event, (double)model.t, {prefix}_refusal(step));
}}
int main(int count, char **words) {{
    {prefix}_init(&model);
    steps();
    if (count > 1) {prefix}_set(&model, atoi(words[1]), 1000);
    printf("%d\\n", {prefix}_start(&model));
    steps();
    return 0;
}}
"""


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("wiper-None", "pendulum-dop853", "belt-oscillator-None")
@pytest.mark.parametrize(("name", "integrator"), [("belt-oscillator", None), ("wiper", None), ("pendulum", "dop853")])
def test_a_step_before_the_start_is_refused(name, integrator, tmp_path):
    """With friction it would go on in modes that nothing has chosen."""
    mechanism = load(name).mechanism
    folder = written(mechanism, tmp_path, **({"integrator": integrator} if integrator else {}))
    prefix = next(folder.glob("*.h")).stem
    (folder / "main.c").write_text(IMPATIENT.format(prefix=prefix))
    lines = subprocess.run([compiled(folder)], capture_output=True, text=True, check=True).stdout.splitlines()
    modes = " and chooses the modes" if name == "belt-oscillator" else ""
    sentence = f"the motion has not begun: {prefix}_start comes before the first step; it closes the joints{modes}"
    assert lines == [f"2 2 -1 0 {sentence}", "0", "0 0 -1 0.1 "]
    if name == "wiper":  # whose crank is longer than its rod
        place = [p.name for p in mechanism.parameters].index("crank_length")
        ran = subprocess.run([folder / "sim", str(place)], capture_output=True, text=True, check=True)
        assert ran.stdout.splitlines()[1:] == ["1", lines[0]]
