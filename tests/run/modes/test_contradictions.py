"""Drivers that run into stops, and bounds that become undefined, are named at once."""

import subprocess
from pathlib import Path

import pytest

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from tests.result.targets.compilers import compiled, written

RAM = """
[mechanism]
name = "ram"
[parameters]
speed = 0.4
[bodies.ram]
mass = 1.0
inertia = 1.0
[joints.rail]
type = "translational"
between = ["ground", "ram"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
angle = 0.0
stop = { upper = 0.5 }
[joints.motor]
type = "driver"
joint = "rail"
value = "LAW"
"""


def ram(law: str) -> symgen.Model:
    return symgen.Model(validate(parse_toml(RAM.replace("LAW", law), "ram.toml"), "ram.toml"))


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("law", "time"), [("speed*t", 1.25), ("0.5 - 0.2*(1 - t)**3", 1.0)], ids=["at full speed", "smoothly"]
)
@pytest.mark.parametrize("settings", [{}, {"integrator": "rk4", "step": 1e-3}], ids=["default", "rk4"])
@pytest.mark.fast("rk4-at full speed-joint", "rk4-smoothly-absolute")
def test_a_driver_that_runs_into_a_stop_is_named_with_it(
    law: str, time: float, coordinates: str, settings: dict[str, object]
) -> None:
    run = ram(law).simulate(until=2.0, coordinates=coordinates, verify=False, **settings)
    assert run.status == "failed" and run.events[0].t == pytest.approx(time, abs=2e-4)
    assert run.reason.startswith(
        "stop rail.upper: expected an impact that can change the rate of the gap, got a rate of -"
    )
    assert run.reason.endswith("that joints and the driver motor determine")


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_row_of_a_sweep_names_it_too() -> None:
    model, settings = ram("speed*t"), {"until": 2.0, "integrator": "rk4", "step": 1e-3, "coordinates": "joint"}
    alone = model.simulate(parameters={"speed": 0.3}, verify=False, **settings)
    rows = model.sweep({"speed": [0.2, 0.3]}, **settings)
    assert list(rows.status) == ["ok", "failed"] and rows.reason[1] == alone.reason


SQUEEZED = """
[mechanism]
name = "squeezed"
[parameters]
speed = 0.4
[bodies.plug]
type = "point"
mass = 1.0
position = [0.35, 0.0]
[joints.rail]
type = "rows"
rows = [{ position = "plug.y" }]
[stops.wall]
gap = "0.5 - plug.x"
[stops.ram]
gap = "plug.x - (RAM)"
"""
INTEGRATORS = ("picard", "dop853", "radau5", "sdirk", "abm", "rk4")


def squeezed(law: str) -> symgen.Model:
    return symgen.Model(validate(parse_toml(SQUEEZED.replace("RAM", law), "squeezed.toml"), "squeezed.toml"))


def settings_of(integrator: str) -> dict[str, object]:
    return {"integrator": integrator, "verify": False, **({"step": 1e-3} if integrator == "rk4" else {})}


@pytest.mark.by_turns(4)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize(
    ("law", "time"), [("speed*t", 1.25), ("0.5 - 0.2*(1 - t)**3", 1.0)], ids=["at full speed", "smoothly"]
)
@pytest.mark.fast("at full speed-picard-absolute")
def test_stops_that_meet_are_named(law: str, time: float, integrator: str, coordinates: str) -> None:
    run = squeezed(law).simulate(until=2.0, coordinates=coordinates, **settings_of(integrator))
    assert run.status == "failed" and run.t[-1] == pytest.approx(time, abs=4e-3)
    assert run.steps + run.rejected < 4000
    sentence = "stops: expected a motion in which no gap becomes negative, got none that wall, ram allow at t = "
    assert run.reason.startswith(sentence)
    assert float(run.reason.removeprefix(sentence).removesuffix(" s")) == pytest.approx(time, abs=2e-4)


@pytest.mark.slow
def test_stops_that_close_at_both_ends_of_one_body_stay_closed() -> None:
    """Both gaps stay 0 while the ram stands still: nothing contradicts."""
    run = squeezed("0.5 if t > 1 else 0.5*t").simulate(until=1.0 - 1e-6, verify=False)
    assert run.status == "ok" and run["plug.x"][-1] == pytest.approx(0.5, abs=1e-6)


BRAKED = """
[mechanism]
name = "braked"
[parameters]
end = 1.0
[bodies.block]
mass = 1.0
inertia = 1.0
[joints.rail]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
friction = { sliding = "5*sqrt(BOUND)" }
[forces.push]
type = "force"
body = "block"
force = ["PUSH", 0.0]
"""


def braked(bound: str, push: str) -> symgen.Model:
    text = BRAKED.replace("BOUND", bound).replace("PUSH", push)
    return symgen.Model(validate(parse_toml(text, "braked.toml"), "braked.toml"))


@pytest.mark.by_turns(4)
@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("bound", "push"), [("end - t", "3*t"), ("0.125 - block.x", "6")], ids=["over time", "over a coordinate"]
)
@pytest.mark.fast("over time-absolute-picard", "over a coordinate-joint-dop853")
def test_a_bound_that_becomes_undefined_is_named(bound: str, push: str, coordinates: str, integrator: str) -> None:
    run = braked(bound, push).simulate(until=2.0, coordinates=coordinates, **settings_of(integrator))
    assert run.status == "failed" and run.steps + run.rejected < 4000
    sentence = "friction of rail: expected formulas that stay defined, got one that is no number after t = "
    assert run.reason.startswith(sentence)
    if bound == "end - t":
        assert float(run.reason.removeprefix(sentence).removesuffix(" s")) == pytest.approx(1.0, abs=1e-3)


@pytest.mark.by_turns(2)
@pytest.mark.parametrize("integrator", ["picard", "rk4"])
@pytest.mark.slow
def test_rows_and_steps_name_a_contradiction_too(integrator: str) -> None:
    settings = {name: value for name, value in settings_of(integrator).items() if name != "verify"}
    for model, name, values in (
        (squeezed("speed*t"), "speed", [0.1, 0.4]),
        (braked("end - t", "3*t"), "end", [3.0, 1.0]),
    ):
        alone = model.simulate(parameters={name: values[1]}, until=2.0, verify=False, **settings)
        rows = model.sweep({name: values}, until=2.0, **settings)
        assert list(rows.status) == ["ok", "failed"] and rows.reason[1] == alone.reason
        run = model.start(parameters={name: values[1]}, **settings)
        with pytest.raises(symgen.SymgenError, match=r"expected (a motion|formulas that stay)"):
            for _ in range(8):
                run.step(0.25)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("model", "time", "sentence"),
    [
        (ram("speed*t"), 1.25, "an impact that can change the rate of the gap"),
        (squeezed("speed*t"), 1.25, "a motion in which no gap becomes negative"),
        (braked("0.9995 - t", "3*t"), 1.0, "formulas that stay defined"),
    ],
    ids=["driver", "stops", "bound"],
)
def test_a_program_in_c_ends_with_the_sentence(model: symgen.Model, time: float, sentence: str, tmp_path: Path) -> None:
    written(model.mechanism, tmp_path)
    done = subprocess.run([compiled(tmp_path), "2.0", "0.001"], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 1 and sentence in done.stderr
    assert float(done.stdout.splitlines()[-1].partition(",")[0]) == pytest.approx(time, abs=4e-3)
