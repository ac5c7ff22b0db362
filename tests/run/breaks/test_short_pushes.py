"""Pushes shorter than a step, at times known beforehand: no error estimate sees them, and no run may miss them."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.checks import assert_same_motion
from support.pushed import pushed_point

import symgen
from symgen.compile.loopcode.loop_instances import Instances
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.parts.driven_mechanism import Jump
from symgen.run.breaks.foreseen_seams import foresee_changes
from symgen.run.breaks.in_time import InTime, new_search
from symgen.run.loops.times_of_jumps import COUNT, search_curve
from symgen.study.ensemble.parameter_sweep import sweep
from symgen.study.ensemble.sweep_plan import make_ensemble

SCHEMES = ["dop853", "dopri5", "picard", "abm", "sdirk", "radau5"]
#: Two points without weight, each direction pushed once: force over t, impulse [N s], and the middle of the push [s].
AT, SHORT = 3.337, 1e-4
PUSHES: list[tuple[str, float]] = [
    (f"100 if t > {AT - SHORT / 2!r} and t < {AT + SHORT / 2!r} else 0", 0.01),
    (f"200*max(0, 1 - abs(t - at)/{SHORT!r})", 0.02),
    (f"300*max(0, 1 - ((t - at)/{SHORT!r})**2)", 0.04),
    (f"50*(sign(t - {AT - SHORT / 2!r}) - sign(t - {AT + SHORT / 2!r}))", 0.01),
]


@pytest.fixture(scope="module")
def pushed(tmp_path_factory: pytest.TempPathFactory) -> symgen.Model:
    text = f'[mechanism]\nname = "short"\ngravity = [0.0, 0.0]\n[run]\nuntil = 10.0\n[parameters]\nat = {AT}\n'
    for name, (x, y) in {"a": PUSHES[:2], "b": PUSHES[2:]}.items():
        text += f'[bodies.{name}]\ntype = "point"\nmass = 1.0\nposition = [0.0, 0.0]\nvelocity = [0.1, -0.2]\n'
        text += f'[forces.push_{name}]\ntype = "force"\nbody = "{name}"\nforce = ["{x[0]}", "{y[0]}"]\n'
    file = tmp_path_factory.mktemp("short") / "short.toml"
    file.write_text(text, encoding="utf-8")
    return symgen.load(file)


def expected(end: float, at: tuple[float, ...] = (AT,) * 4) -> dict[str, float]:
    """Positions and speeds behind the pushes: each acts like a blow in its middle."""
    found = dict[str, float]()
    for (axis, speed), (_, impulse), moment in zip(
        [("a.x", 0.1), ("a.y", -0.2), ("b.x", 0.1), ("b.y", -0.2)], PUSHES, at, strict=True
    ):
        found[axis] = speed * end + impulse * (end - moment)
        found[axis.replace(".", ".v")] = speed + impulse
    return found


def compared(values: Callable[[str], float], end: float, at: tuple[float, ...] = (AT,) * 4) -> None:
    # each push is 0.01 to 0.04 of speed; the tolerance of runs is 1e-8 of the largest numbers, about 1, a step
    for name, value in expected(end, at).items():
        assert values(name) == pytest.approx(value, abs=1e-6), name


@pytest.mark.parametrize("integrator", SCHEMES)
def test_runs_miss_none(pushed: symgen.Model, integrator: str) -> None:
    result = pushed.simulate(method="lagrange", integrator=integrator, rtol=1e-8)
    assert result.status == "ok"
    compared(lambda name: result[name][-1], 10.0)


@pytest.mark.parametrize("integrator", SCHEMES)
def test_runs_step_by_step_miss_none(pushed: symgen.Model, integrator: str) -> None:
    for until, ends in ((10.0, (10.0,)), (10.0, (1.0, 3.3, 5.0, 10.0))):
        run = pushed.start(method="lagrange", integrator=integrator, rtol=1e-8, until=until)
        for end in ends:
            run.run(end)
        compared(run.bodies.__getitem__, 10.0)


def test_a_run_that_is_taken_back_meets_them_again(pushed: symgen.Model) -> None:
    run = pushed.start(method="lagrange", integrator="dop853", rtol=1e-8)
    run.run(2.0)
    saved = run.save()
    run.run(9.0)
    run.restore(saved)
    run.step(8.0)
    compared(run.bodies.__getitem__, 10.0)


def test_a_parameter_that_is_set_moves_them(pushed: symgen.Model) -> None:
    run = pushed.start(method="lagrange", integrator="dopri5", rtol=1e-8)
    run.run(2.0)
    run.set(at=6.0)
    run.run(10.0)
    compared(run.bodies.__getitem__, 10.0, (AT, 6.0, 6.0, AT))


def test_rows_of_sweeps_are_single_runs(pushed: symgen.Model) -> None:
    settings: dict[str, Any] = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-8}
    found = sweep(pushed, vary={"at": [2.0, AT, 7.0]}, quantities=["a.vy", "b.x"], **settings)
    for row, at in zip(found.values[:, :, -1], (2.0, AT, 7.0), strict=True):
        alone = pushed.simulate(parameters={"at": at}, **settings)
        assert_same_motion(row, [alone["a.vy"][-1], alone["b.x"][-1]])
        assert alone["a.vy"][-1] == pytest.approx(-0.18, abs=1e-8)


@pytest.mark.parametrize("step", [0.01, 0.0123])
def test_constant_steps_meet_each_push(pushed: symgen.Model, step: float) -> None:
    run = pushed.simulate(method="lagrange", integrator="rk4", step=step)
    assert run.warnings == ()
    for name, value in expected(10.0).items():
        assert run[name][-1] == pytest.approx(value, abs=1e-10), name


def test_devices_refuse_to_go_across(pushed: symgen.Model) -> None:
    asked = symgen.Settings(method="lagrange", integrator="dopri5")
    assert make_ensemble(pushed, asked, {"at": [2.0, 3.0]}, {}, None, "cpu").driving.jumps
    with pytest.raises(symgen.InputError, match="no jumps and kinks of formulas"):
        make_ensemble(pushed, asked, {"at": [2.0, 3.0]}, {}, None, "cuda")


def called_with(f: Any, formula: Callable[[float], float], j: int, t: float) -> float:
    """Return the value of a formula that is a function of Python."""
    return formula(t)


def test_plateaus_are_not_searched(pushed: symgen.Model) -> None:
    """What stays where it is has a least value everywhere: looking for it between all looks would take seconds."""
    formulas = InTime(pushed.mechanism, {"at": AT})
    (jump,) = (
        jump for jump in foresee_changes(pushed.mechanism).kinks if abs(formulas.value_at(jump.argument, 0.0)) > 1e6
    )

    def counted(t: float) -> float:
        looks.append(t)
        return formulas.value_at(jump.argument, t)

    looks, search = list[float](), new_search(jump, 10.0)
    Instances({"formula_at": called_with}, lambda copy, _: copy).of(search_curve)(search, counted, 0, 0.0, 10.0)
    assert search.found[COUNT] == len(formulas.crossings(jump, 10.0)) == 2
    assert len(looks) < 4 * (2048 + 4096)


@pytest.mark.slow
def test_passages_of_any_frequency_are_found(pushed: symgen.Model) -> None:
    """Peaks that pass a level for a moment, more of them than the first looks, with known times."""
    random = np.random.default_rng(7)
    for _ in range(60):
        w, phase, part = 10.0 ** random.uniform(0.0, 4.0), random.uniform(0.0, 6.0), 10.0 ** random.uniform(-5.0, -0.4)
        argument = parse("sin(w*t + p) - d", FormulaNames("a formula", {x: x for x in "twpd"}, {}, {}), "here")
        values = {"w": w, "p": phase, "d": math.cos(part)}
        found = InTime(pushed.mechanism, values).crossings(Jump(argument), 10.0)
        turns = np.arange(math.floor(phase / math.tau) - 1, math.ceil((10.0 * w + phase) / math.tau) + 1)
        peaks = (0.5 * math.pi + math.tau * turns - phase) / w
        expected = np.sort(np.concatenate([peaks - part / w, peaks + part / w]))
        # a double root is known to the root of rounding of an angle of w t
        sure = 1e-7 * (1.0 + w) / w
        kept = expected[(expected > sure) & (expected < 10.0 - sure)]
        there = np.sort([t for t in found if sure < t < 10.0 - sure])
        np.testing.assert_allclose(there, kept, rtol=0.0, atol=sure)


@pytest.mark.slow_cases("dop853")
@pytest.mark.parametrize("integrator", ["dop853", "radau5"])
def test_thousands_of_pushes_are_seen(tmp_path: Path, integrator: str) -> None:
    """A hundredth of each period at 50 Hz for 30 s: 3000 times on and off."""
    model = pushed_point(tmp_path, "10 if sin(2*pi*f*t) > cos(0.01*pi) else 0", 30.0)
    result = model.simulate(method="lagrange", integrator=integrator, rtol=1e-8)
    assert (result.status, result.warnings) == ("ok", ())
    assert result["a.vx"][-1] == pytest.approx(0.1 + 10.0 * 0.01 * 30.0, abs=1e-6)


@pytest.mark.slow
def test_a_spike_of_a_long_table_is_seen(tmp_path: Path) -> None:
    """One point of 6000, and the same table read along a curve that goes over it twice."""
    x = np.linspace(0.0, 10.0, 6001)
    y = np.zeros(6001)
    y[3210] = 300.0
    tables = f"[tables.spike]\nx = {x.tolist()}\ny = {y.tolist()}\n"
    for formula, until in (("spike(t)", 10.0), ("spike(10*sin(pi*t/20))", 20.0)):
        result = pushed_point(tmp_path, formula, until, tables).simulate(
            method="lagrange", integrator="dop853", rtol=1e-8
        )
        times = np.linspace(0.0, until, 2_000_001)
        there = np.interp(times if until == 10.0 else 10.0 * np.sin(math.pi * times / 20.0), x, y)
        # each flank is off by half a step of the sum, 5e-6 s, times how far the force is from a line there
        assert result["a.vx"][-1] == pytest.approx(0.1 + float(np.trapezoid(there, times)), abs=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("settings", [{"integrator": "dop853"}, {"integrator": "rk4", "step": 0.01}])
def test_what_cannot_be_told_apart_is_told(tmp_path: Path, settings: dict[str, Any]) -> None:
    model = pushed_point(tmp_path, "10 if sin(2e7*t) > 0.999 else 0", 1.0)
    expected = "formulas change, or pass points of tables, more often than can be distinguished"
    assert any(expected in warning for warning in model.simulate(method="lagrange", **settings).warnings)
    found = symgen.sweep(model, {"f": [1.0, 2.0]}, method="lagrange", **settings)
    assert all(expected in row[0] for row in found.warnings)


@pytest.mark.by_turns(3)
@pytest.mark.fast("picard")
@pytest.mark.parametrize("integrator", SCHEMES)
def test_events_that_come_and_go_within_a_step_are_seen(tmp_path: Path, integrator: str) -> None:
    """Conditions of the time alone: of one that is true 500 times for 90 us `dop853` saw none."""
    model = pushed_point(tmp_path, "0.1", 10.0)
    often, once = "sin(2*pi*f*t) > 0.9999", "max(0, 1 - abs(t - 3.337)/1e-4) > 0.5"
    result = model.simulate(method="lagrange", integrator=integrator, rtol=1e-8, record_when=[often, once])
    found = [np.array([event.t for event in result.events if event.name == name]) for name in (often, once)]
    first = math.asin(0.9999) / (100.0 * math.pi)
    np.testing.assert_allclose(found[0], first + 0.02 * np.arange(500), rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(found[1], [3.33695], rtol=0.0, atol=1e-9)
    stopped = model.simulate(method="lagrange", integrator=integrator, rtol=1e-8, stop_when=[once])
    assert stopped.t[-1] == pytest.approx(3.33695, abs=1e-9)


@pytest.mark.slow
def test_rows_of_sweeps_see_them_too(tmp_path: Path) -> None:
    model = pushed_point(tmp_path, "0.1", 10.0)
    often = "sin(2*pi*f*t) > 0.9999"
    found = sweep(
        model, vary={"f": [50.0, 7.0]}, method="lagrange", integrator="dop853", rtol=1e-8, record_when=[often]
    )
    assert found[f"event.{often}.count"].tolist() == [500.0, 70.0]


def test_runs_step_by_step_see_them_too(tmp_path: Path) -> None:
    once = "max(0, 1 - abs(t - 3.337)/1e-4) > 0.5"
    run = pushed_point(tmp_path, "0.1", 10.0).start(method="lagrange", integrator="dop853", rtol=1e-8, stop_when=[once])
    event = run.run(5.0)
    assert event is not None and event.t == pytest.approx(3.33695, abs=1e-9)
