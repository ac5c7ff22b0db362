"""Inputs that are set while dry friction holds a coordinate: every way gives the bits of a run with the same data."""

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

import symgen
import symgen.gym
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

WHEEL = """
[mechanism]
name = "wheel"
gravity = [0.0, 0.0]
[inputs]
u = { default = 0.0 }
more = { default = 3.0 }
[bodies.wheel]
mass = 1.0
inertia = 1.0
[joints.pin]
type = "revolute"
between = ["ground", "wheel"]
at = [[0.0, 0.0], "centre"]
friction = { sliding = 0.5, static = 0.8 }
[forces.motor]
type = "torque"
body = "wheel"
torque = "u + more - 6"
"""
#: Sizes of bounds, and what is near them.
CORNERS = (2.2, 2.4, 2.5, 2.6, 3.0, 3.4, 3.5, 3.6, 3.79, 3.8, 3.81, 3.9)
STEP, PIECE, PIECES = {"integrator": "rk4", "step": 1e-3}, 0.05, 4


@pytest.fixture(scope="module")
def wheel() -> symgen.Model:
    return symgen.Model(validate(parse_toml(WHEEL, "wheel.toml"), "wheel.toml"))


def values(count: int) -> list[float]:
    numbers = np.random.default_rng(7).uniform(1.5, 4.5, max(count - len(CORNERS), 0))
    return [*CORNERS, *map(float, numbers)][:count]


def state(run: Any) -> tuple[float, float]:
    return run.q["wheel.theta"], run.v["wheel.omega"]


def go(run: Any, pieces: int = PIECES) -> tuple[float, float]:
    for _ in range(pieces):
        run.step(PIECE)
    return state(run)


def by_step(model: symgen.Model, u: float) -> tuple[float, float]:
    run = model.start(**STEP)
    for _ in range(PIECES):
        run.step(PIECE, {"u": u})
    return state(run)


def by_set(*sets: dict[str, float | None]) -> Callable[[symgen.Model, float], tuple[float, float]]:
    def way(model: symgen.Model, u: float) -> tuple[float, float]:
        run = model.start(**STEP)
        for values in sets:
            run.set({name: u if x is None else x for name, x in values.items()})
        return go(run)

    return way


def by_clock(model: symgen.Model, u: float) -> tuple[float, float]:
    run = model.start(**STEP)
    run.every(PIECE, lambda t, run: {"u": u})
    return go(run)


def after_reset(model: symgen.Model, u: float) -> tuple[float, float]:
    run = model.start(**STEP)
    run.set(u=4.4)
    go(run)
    run.reset()
    run.set(u=u)
    return go(run)


def after_restoring(model: symgen.Model, u: float) -> tuple[float, float]:
    run = model.start(**STEP)
    saved = run.save()
    run.set(u=4.4)
    go(run)
    run.restore(saved)
    run.set(u=u)
    return go(run)


def saved_after_the_set(model: symgen.Model, u: float) -> tuple[float, float]:
    run, other = model.start(**STEP), model.start(**STEP)
    run.set(u=u)
    other.restore(run.save())
    return go(other)


def ahead(model: symgen.Model, u: float) -> tuple[float, float]:
    run = model.start(**STEP)
    found = run.horizon({"u": [u] * PIECES}, PIECE)
    last = dict(zip(found.states, found.x[-1], strict=True))
    assert state(run) == (0.0, 0.0)  # it stays where it is
    return last["wheel.theta"], last["wheel.omega"]


WAYS: dict[str, Callable[[symgen.Model, float], tuple[float, float]]] = {
    "step": by_step,
    "set": by_set({"u": None}),
    "set twice": by_set({"u": None}, {"u": None}),
    "another before": by_set({"u": 4.4}, {"u": None}),
    "both sides before": by_set({"u": 1.6}, {"u": 4.4}, {"u": None}),
    "in parts": by_set({"more": 4.0}, {"u": None}, {"more": 3.0}),
    "in parts, loose between": by_set({"more": 9.0}, {"u": None}, {"more": 3.0}),
    "both at once": by_set({"more": 3.0, "u": None}),
    "on a clock": by_clock,
    "after a reset": after_reset,
    "after restoring": after_restoring,
    "saved after the set": saved_after_the_set,
    "ahead": ahead,
}


@pytest.mark.by_turns(16)
@pytest.mark.parametrize("count", [4, pytest.param(60, marks=pytest.mark.slow)])
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.fast(*(f"{way}-4" for way in WAYS))
def test_every_way_is_the_run_with_the_value(way: str, count: int, wheel: symgen.Model) -> None:
    for u in values(count) if count > 4 else (2.4, 3.4, 3.6, 3.9):
        whole = wheel.simulate(parameters={"u": u}, until=PIECE * PIECES, output_step=PIECE, verify=False, **STEP)
        assert WAYS[way](wheel, u) == (whole["wheel.theta"][-1], whole["wheel.omega"][-1]), u


@pytest.mark.slow
def test_values_that_come_later_are_those_of_data(wheel: symgen.Model) -> None:
    """The wheel rests under 3, and takes the value after two pieces; rows of a sweep and a step do the same."""
    for u in values(30):
        held = {"t": [0.0, 2.0 * PIECE], "u": [3.0, u], "interpolation": "hold"}
        whole = wheel.simulate(inputs={"u": held}, until=PIECE * PIECES, output_step=PIECE, verify=False, **STEP)
        run = wheel.start(parameters={"u": 3.0}, **STEP)
        go(run, 2)
        run.set(u=u)
        assert go(run, 2) == (whole["wheel.theta"][-1], whole["wheel.omega"][-1]), u


@pytest.mark.slow
def test_c_takes_inputs_before_and_after_its_start(wheel: symgen.Model, tmp_path: Path) -> None:
    wheel.generate(tmp_path / "c", target="c")
    numbers = values(60)
    (tmp_path / "c" / "own.c").write_text(
        '#include <stdio.h>\n#include "wheel.h"\n'
        f"static const double us[] = {{{', '.join(map(repr, numbers))}}};\n"
        "int main(void) { static wheel m; int e; for (int k = 0; k < (int)(sizeof us/sizeof us[0]); k++)\n"
        "for (int late = 0; late < 3; late++) { wheel_init(&m);\n"
        "if (late == 0) wheel_set(&m, WHEEL_P_u, us[k]); wheel_start(&m);\n"
        "if (late == 2) wheel_set(&m, WHEEL_P_u, 4.4); if (late > 0) wheel_set(&m, WHEEL_P_u, us[k]);\n"
        "for (int i = 1; i <= 200; i++) wheel_advance(&m, 1e-3*i, 1e-3, &e);\n"
        'printf("%.17g %.17g\\n", (double)m.y[2], (double)m.y[5]); } return 0; }\n',
        encoding="utf-8",
    )
    command = ["cc", "-std=c99", "-O1", "-ffp-contract=off", "own.c", "wheel.c", "-lm", "-o", "own"]
    subprocess.run(command, cwd=tmp_path / "c", check=True, capture_output=True)
    out = subprocess.run([str(tmp_path / "c" / "own")], check=True, capture_output=True, text=True).stdout.splitlines()
    rows = np.array([[float(x) for x in line.split()] for line in out]).reshape(len(numbers), 3, 2)
    assert np.array_equal(rows[:, 0], rows[:, 1]) and np.array_equal(rows[:, 0], rows[:, 2])
    for u, row in zip(numbers, rows[:, 0], strict=True):
        whole = wheel.simulate(parameters={"u": u}, until=PIECE * PIECES, verify=False, **STEP)
        assert row == pytest.approx([whole["wheel.theta"][-1], whole["wheel.omega"][-1]], abs=1e-14), u


@pytest.mark.slow
def test_an_environment_takes_them_as_actions(wheel: symgen.Model) -> None:
    act, until = {"u": (1.0, 5.0)}, PIECE * PIECES
    env = symgen.gym.make(
        wheel,
        observe=["wheel.theta", "wheel.omega"],
        act=act,
        reward="0",
        dt=PIECE,
        until=until,
        coordinates="absolute",
        **STEP,
    )
    for u in values(30):
        env.reset()
        for _ in range(PIECES):
            seen, *_ = env.step(np.array([u]))
        whole = wheel.simulate(parameters={"u": u}, until=until, output_step=PIECE, verify=False, **STEP)
        assert tuple(seen) == (whole["wheel.theta"][-1], whole["wheel.omega"][-1]), u


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_an_fmu_takes_them_before_during_and_after_its_initialization(wheel: symgen.Model, tmp_path: Path) -> None:
    wheel.generate(tmp_path / "wheel.fmu", target="fmu", integrator="rk4")
    description = read_model_description(str(tmp_path / "wheel.fmu"))
    names = {v.name: v.valueReference for v in description.modelVariables}
    folder = extract(str(tmp_path / "wheel.fmu"), str(tmp_path / "unpacked"))

    def end(u: float, phase: str) -> list[float]:
        unit = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=phase,
        )
        unit.instantiate()
        unit.setupExperiment(startTime=0.0)
        for now, after in (("before", unit.enterInitializationMode), ("during", unit.exitInitializationMode)):
            if phase == now:
                unit.setReal([names["u"]], [u])
            after()
        for value in {"after": [u], "twice": [4.4, u]}.get(phase, []):
            unit.setReal([names["u"]], [value])
        for k in range(PIECES):
            unit.doStep(k * PIECE, PIECE)
        found = unit.getReal([names["wheel.theta"], names["wheel.omega"]])
        unit.terminate()
        unit.freeInstance()
        return list(found)

    for u in values(20):
        first = end(u, "before")
        assert all(end(u, phase) == first for phase in ("during", "after", "twice")), u
        whole = wheel.simulate(parameters={"u": u}, until=PIECE * PIECES, verify=False, **STEP)
        assert first == pytest.approx([whole["wheel.theta"][-1], whole["wheel.omega"][-1]], abs=1e-14), u
