"""Drivers that run into stops, and bounds that become undefined, are named at once."""

import pytest

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

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


def test_a_row_of_a_sweep_names_it_too() -> None:
    model, settings = ram("speed*t"), {"until": 2.0, "integrator": "rk4", "step": 1e-3, "coordinates": "joint"}
    alone = model.simulate(parameters={"speed": 0.3}, verify=False, **settings)
    rows = model.sweep({"speed": [0.2, 0.3]}, **settings)
    assert list(rows.status) == ["ok", "failed"] and rows.reason[1] == alone.reason
