"""C, FMUs, pages and steps from Python are single runs with the same steps."""

import json
import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from benchmarks.bounded.touch.kinds import drawn
from benchmarks.mechanisms.toml import text as toml
from tests.describe.contacts.test_outlines import CAM
from tests.result.targets.test_c_modes import program_of, rows_of
from tests.result.targets.test_fmu import fmu_of, simulated
from tests.run.contacts.scenes import DROP, loaded, rocking_block, woodpecker
from tests.run.contacts.scenes_in_space import DIE, SKITTLE, SPUN
from tests.run.contacts.test_outlines import cam_follower, roof
from tests.run.contacts.test_surface_speed import parcel

#: Steps of a module that Node reads: its last state, and what has happened.
NODE = """
const { model } = await import(process.argv[1]);
const y = model.start(), [until, step] = process.argv.slice(2).map(Number), happened = [];
for (let k = 0; (k + 1)*step <= until*(1 + 1e-12); k++) {
  if (!model.step(k*step, y, step)) throw new Error(`no step at ${k*step}`);
  happened.push(...model.transitions());
}
console.log(JSON.stringify({ y: Array.from(y), happened }));
"""

#: Files, their ends, steps, and how many transitions are compared: times of later ones are ill-conditioned, as
#: joints are corrected where a last bit decides. The last number is the error: the sled's flights become so low that
#: last bits decide their times.
PRINTED = {
    "disc": (DROP, 3.0, 5e-4, 20, "disc.x", 1e-12),
    "block": (rocking_block(0.15, 0.5, 0.12), 1.6, 5e-4, 12, "block.theta", 1e-12),
    "woodpecker": (woodpecker(), 0.4, 5e-5, 30, "sleeve.y", 1e-12),
    "die": (DIE, 0.6, 5e-4, 8, "die.z", 1e-12),
    "ball": (SKITTLE, 1.2, 5e-4, 20, "ball.x", 1e-9),
    "spun": (SPUN, 2.0, 5e-4, 20, "ball.x", 1e-9),
    "belt": (parcel("V*cos(w*t)", outputs=False).replace("w = 4.0", "w = 9.0"), 1.2, 5e-4, 20, "box.x", 1e-12),
    "cam": (cam_follower(CAM, 0.1), 1.6, 5e-4, 20, "follower.y", 1e-12),
    "roof": (roof(0.5), 0.6, 5e-4, 20, "disc.x", 1e-12),
    "sled": (toml(drawn("sled", 29).raw), 0.4, 5e-4, 60, "disc.theta", 2e-11),
}


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("name", PRINTED)
def test_printed_runs_with_the_same_steps(name: str, tmp_path: Path) -> None:
    """C, an FMU and steps from Python are single runs with the same steps, relative to the sizes of coordinates."""
    text, until, step, count, seen, most = PRINTED[name]
    model = loaded(text + f"[run]\nuntil = {until}\nstep = {step}\n", tmp_path)
    rows, transitions = rows_of(program_of(model, tmp_path / "c"), until, step)
    run = model.simulate(method="direct-correction", integrator="rk4", step=step, until=until, times=rows[:, 0])
    own = np.array([run[each] for each in (*run.q.names, *run.v.names)]).T
    error = np.abs(own - rows[:, 1 : own.shape[1] + 1]) / np.maximum(1.0, np.abs(own).max(axis=0))
    assert run.ok and error.max() < most
    expected = [(event.t, event.name) for event in run.events][:count]
    assert [word for _, word in transitions[: len(expected)]] == [word for _, word in expected]
    times = [t for t, _ in transitions[: len(expected)]]
    assert np.allclose(times, [t for t, _ in expected], rtol=0.0, atol=most)
    found = simulated(fmu_of(model, tmp_path / "scene.fmu"), "CoSimulation", until, step=until / 4.0, outputs=[seen])
    assert abs(found[seen][-1] - own[-1, [*run.q.names].index(seen)]) < most
    model.generate(tmp_path / "page", target="javascript")
    (module,), node = (tmp_path / "page").glob("*.mjs"), shutil.which("node")
    assert node, "this test needs Node: apt-get install nodejs"
    command = [node, "--input-type=module", "-e", NODE, str(module), repr(until), repr(step)]
    page = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    off = np.abs(np.array(page["y"])[: own.shape[1]] - own[-1]) / np.maximum(1.0, np.abs(own).max(axis=0))
    assert off.max() < most
    assert [each["name"] for each in page["happened"][: len(expected)]] == [word for _, word in expected]
    moments = [each["t"] for each in page["happened"][: len(expected)]]
    assert np.allclose(moments, [t for t, _ in expected], rtol=0.0, atol=most)
    steps = model.start(method="direct-correction", integrator="rk4", step=step)
    for _ in range(4):
        steps.step(until / 4.0)
    assert abs(steps[seen] - run[seen][-1]) < most


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_last_impacts_in_c_are_those_of_a_closed_form(tmp_path: Path) -> None:
    """A flight that begins ever more slowly ends where a height is 0 up to rounding: all 43 times are that exact."""
    until, step, e = 3.0, 5e-4, 0.7
    model = loaded(DROP, tmp_path)
    _, transitions = rows_of(program_of(model, tmp_path / "c"), until, step)
    run = model.simulate(method="direct-correction", integrator="rk4", step=step, until=until, verify=False)
    fall = math.sqrt(2.0 / 9.81)
    count = np.arange(43)
    times = fall * (1.0 + 2.0 * (e - e ** (count + 1)) / (1.0 - e))
    rounding = np.spacing(0.1) / (9.81 * fall * e**count)
    for found in (transitions, [(event.t, event.name) for event in run.events]):
        assert [name for _, name in found] == ["floor.hit"] * 43 + ["floor.rest"]
        assert np.all(np.abs([t for t, _ in found[:43]] - times) < 1e-13 + 20.0 * rounding)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_block_that_rocks_to_rest_in_c_is_off_by_less_than_by_a_rounding_of_gravity(tmp_path: Path) -> None:
    until, step = 4.0, 5e-4
    text = rocking_block(0.15, 0.5, 0.12).replace("-9.81]", '"-g"]') + "[parameters]\ng = 9.81\n"
    model = loaded(text, tmp_path)
    rows, _ = rows_of(program_of(model, tmp_path / "c"), until, step)

    def states_of(g: float) -> np.ndarray:
        settings = {"method": "direct-correction", "integrator": "rk4", "step": step, "until": until}
        run = model.simulate(parameters={"g": g}, times=rows[:, 0], verify=False, **settings)
        assert run.ok
        return np.array([run[name] for name in (*run.q.names, *run.v.names)]).T

    own = states_of(9.81)
    off = np.abs(rows[:, 1 : own.shape[1] + 1] - own)
    moved = [np.abs(states_of(9.81 + k * float(np.spacing(9.81))) - own).max() for k in (-2, -1, 1, 2)]
    assert off.max() < 4.0 * max(moved) < 1e-9 and off[-1].max() < 1e-12
