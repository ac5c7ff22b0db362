"""Bodies that touch, by a command in a process of its own."""

import csv
import json

import pytest

from tests.processes.programs import shell

#: The disc slides at mu g, its spin grows by 2 mu g/r: it rolls at 2/3 of its speed after v/(3 mu g).
SKIDDING = """
[mechanism]
name = "skidding"
gravity = [0.0, -9.81]
[run]
until = 1.5
output_step = 0.5
[bodies.puck]
mass = 2.5
inertia = 0.05
position = [0.4, 0.2]
velocity = [3.0, 0.0]
[contacts.floor]
between = [{ body = "puck", disc = 0.2 }, { line = "ground", on = [0.0, 0.0], normal = [0.0, 1.0] }]
friction = 0.15
"""


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_disc_skids_and_then_rolls(tmp_path):
    (tmp_path / "skidding.toml").write_text(SKIDDING, encoding="utf-8")
    said, _ = shell("symgen run skidding.toml --save rows.csv --json", tmp_path)
    found = json.loads(said)
    assert found["status"] == "ok"
    with (tmp_path / "rows.csv").open(encoding="utf-8", newline="") as file:
        last = list(csv.DictReader(file))[-1]
    instant = 3.0 / (3.0 * 0.15 * 9.81)
    slid = 3.0 * instant - 0.5 * 0.15 * 9.81 * instant**2
    assert float(last["puck.vx"]) == pytest.approx(2.0, abs=1e-9)
    assert float(last["puck.x"]) == pytest.approx(0.4 + slid + 2.0 * (1.5 - instant), abs=1e-9)
    assert [event["name"] for event in found["events"]] == ["floor.stick"]
    assert found["events"][0]["t"] == pytest.approx(instant, abs=1e-9)


#: A disc that 1.5 N pushes along a floor, and that a torsion spring holds: it rolls until the spring balances friction.
HELD = SKIDDING.replace("velocity = [3.0, 0.0]\n", "").replace("[run]\nuntil = 1.5\noutput_step = 0.5\n", "")
HELD += """[forces.push]
type = "force"
body = "puck"
force = [1.5, -3.0]
[forces.hold]
type = "torque"
body = "puck"
torque = "-4.0*puck.theta"
"""


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_an_equilibrium_that_a_contact_carries(tmp_path):
    (tmp_path / "held.toml").write_text(HELD, encoding="utf-8")
    said, notes = shell("python -m symgen equilibrium held.toml --json", tmp_path)
    (found,) = json.loads(said)["equilibria"]
    assert found["stability"] == "stable"
    assert found["q"]["puck.theta"] == pytest.approx(-1.5 * 0.2 / 4.0, abs=1e-12)
    assert found["q"]["puck.x"] == pytest.approx(0.4 + 0.2 * 1.5 * 0.2 / 4.0, abs=1e-12)
    assert found["omega_squared"] == pytest.approx([4.0 / (0.05 + 2.5 * 0.2**2)], rel=1e-9)
    assert found["multipliers"]["floor.normal"] == pytest.approx(-(2.5 * 9.81 + 3.0), abs=1e-9)
    assert "floor closed" in notes
