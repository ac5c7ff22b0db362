"""C, FMUs, pages and steps from Python are single runs with the same steps."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from tests.result.targets.test_c_modes import program_of, rows_of
from tests.result.targets.test_fmu import fmu_of, simulated
from tests.run.contacts.scenes import DROP, loaded, rocking_block, woodpecker

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
#: joints are corrected where a last bit decides.
PRINTED = {
    "disc": (DROP, 3.0, 5e-4, 20, "disc.x"),
    "block": (rocking_block(0.15, 0.5, 0.12), 1.6, 5e-4, 12, "block.theta"),
    "woodpecker": (woodpecker(), 0.4, 5e-5, 30, "sleeve.y"),
}


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", PRINTED)
def test_printed_runs_with_the_same_steps(name: str, tmp_path: Path) -> None:
    """C, an FMU and steps from Python are single runs with the same steps, relative to the sizes of coordinates."""
    text, until, step, count, seen = PRINTED[name]
    model = loaded(text + f"[run]\nuntil = {until}\nstep = {step}\n", tmp_path)
    rows, transitions = rows_of(program_of(model, tmp_path / "c"), until, step)
    run = model.simulate(method="direct-correction", integrator="rk4", step=step, until=until, times=rows[:, 0])
    own = np.array([run[each] for each in (*run.q.names, *run.v.names)]).T
    error = np.abs(own - rows[:, 1:]) / np.maximum(1.0, np.abs(own).max(axis=0))
    assert run.ok and error.max() < 1e-12
    expected = [(event.t, event.name) for event in run.events][:count]
    assert [word for _, word in transitions[: len(expected)]] == [word for _, word in expected]
    times = [t for t, _ in transitions[: len(expected)]]
    assert np.allclose(times, [t for t, _ in expected], rtol=0.0, atol=1e-12)
    found = simulated(fmu_of(model, tmp_path / "scene.fmu"), "CoSimulation", until, step=until / 4.0, outputs=[seen])
    assert abs(found[seen][-1] - own[-1, [*run.q.names].index(seen)]) < 1e-12
    model.generate(tmp_path / "page", target="javascript")
    (module,), node = (tmp_path / "page").glob("*.mjs"), shutil.which("node")
    assert node, "this test needs Node: apt-get install nodejs"
    command = [node, "--input-type=module", "-e", NODE, str(module), repr(until), repr(step)]
    page = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    off = np.abs(np.array(page["y"])[: own.shape[1]] - own[-1]) / np.maximum(1.0, np.abs(own).max(axis=0))
    assert off.max() < 1e-12
    assert [each["name"] for each in page["happened"][: len(expected)]] == [word for _, word in expected]
    moments = [each["t"] for each in page["happened"][: len(expected)]]
    assert np.allclose(moments, [t for t, _ in expected], rtol=0.0, atol=1e-12)
    steps = model.start(method="direct-correction", integrator="rk4", step=step)
    for _ in range(4):
        steps.step(until / 4.0)
    assert abs(steps[seen] - run[seen][-1]) < 1e-12
