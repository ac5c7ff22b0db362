"""Why a run has no modes: sweeps and C say the sentence of a single run, with the row at fault."""

import copy
import subprocess
from pathlib import Path
from typing import Any

import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.load import parse_toml, read_raw
from symgen.describe.files.validate import validate

PRESS = """
[mechanism]
name = "press"
gravity = [0.0, -9.81]
[parameters]
P = START
[bodies.ram]
mass = 2.0
inertia = 0.1
position = [0.0, 1.0]
[joints.guide]
type = "translational"
between = ["ground", "ram"]
at = [[0.0, 0.0], [0.0, 0.0]]
axis = [0.0, 1.0]
KEYS
"""


def press(keys: str, start: float) -> dict[str, Any]:
    return parse_toml(PRESS.replace("KEYS", keys).replace("START", repr(start)), "press.toml")


def pins(start: float, **more: Any) -> dict[str, Any]:
    """Return the four-bar with friction by reactions in all pins."""
    raw = copy.deepcopy(read_raw("four-bar")[0])
    raw["parameters"]["P"] = start
    for pin in "ABCD":
        raw["joints"][pin]["friction"] = {"coefficient": "P", "radius": 0.3}
    return raw | more


MOTOR = {"motor": {"type": "torque", "body": "crank", "torque": "0.01*sin(t)"}}
#: What is wrong, with the value of P up to which a run is right, the value at which it is not, and its sentence.
FAULTS = {
    "a gap": (
        press('stop = { lower = "P" }', 0.5),
        1.5,
        "stop guide.lower: expected a gap of at least 0, got -0.5 at t",
    ),
    "a restitution": (
        press('stop = { lower = 0.0, restitution = "P" }', 0.5),
        1.25,
        "stop guide.lower: expected a restitution from 0 to 1, got 1.25",
    ),
    "bounds": (
        press('friction = { sliding = 2.0, static = "P" }', 3.0),
        1.0,
        "expected bounds of at least 0, at rest at least that in motion, got 1 at rest and 2 in motion",
    ),
    "a bound in motion": (
        press('friction = { sliding = "P", static = 3.0 }', 1.0),
        0.0,
        "friction of guide: expected a bound in motion above 0, as that at rest is above 0, got 0",
    ),
}
COORDINATES = "absolute", "joint"


@pytest.mark.by_turns(8)
@pytest.mark.parametrize("coordinates", COORDINATES)
@pytest.mark.parametrize("fault", [*FAULTS])
@pytest.mark.fast("a gap-absolute")
def test_a_row_of_a_sweep_says_what_a_run_says(fault: str, coordinates: str) -> None:
    raw, wrong, sentence = FAULTS[fault]
    model = symgen.Model(validate(raw, "file.toml"))
    settings = {"until": 0.2, "integrator": "rk4", "step": 1e-3, "coordinates": coordinates}
    with pytest.raises(InputError) as refused:
        model.simulate(parameters={"P": wrong}, **settings)
    assert sentence in str(refused.value)
    rows = model.sweep({"P": [raw["parameters"]["P"], wrong]}, **settings)
    assert list(rows.status) == ["ok", "failed"]
    assert list(rows.reason) == ["", str(refused.value)]


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["rk4", "dop853"])
@pytest.mark.parametrize("fault", [*FAULTS])
def test_c_says_what_a_run_says(fault: str, integrator: str, tmp_path: Path) -> None:
    raw, wrong, _ = FAULTS[fault]
    raw = copy.deepcopy(raw)
    model = symgen.Model(validate(raw, "file.toml"))
    with pytest.raises(InputError) as refused:
        model.simulate(parameters={"P": wrong}, until=0.2, integrator=integrator, coordinates="absolute")
    folder = tmp_path / "c"
    if fault == "shared":  # of many parameters
        raw["parameters"]["P"] = wrong
        model = symgen.Model(validate(raw, "file.toml"))
    model.generate(folder, target="c", integrator=integrator)
    if fault != "shared":  # a file is refused with the wrong value: it is given afterwards
        main = folder / "main.c"
        text = main.read_text(encoding="utf-8")
        assert "press_init(&model);" in text
        main.write_text(text.replace("press_init(&model);", f"press_init(&model); press_set(&model, 0, {wrong!r});"))
    command = ["cc", "-std=c99", "-O1", *map(str, sorted(folder.glob("*.c"))), "-lm", "-o", str(tmp_path / "run")]
    subprocess.run(command, check=True, timeout=300)
    done = subprocess.run([tmp_path / "run", "0.2"], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 1
    assert done.stderr.strip() == str(refused.value)
