"""Modules for browsers, in Node: transitions are told once, whatever the times at which the motion is looked at."""

import json
import shutil
import subprocess

import pytest

from symgen.cli import main

#: A block under friction that is pulled, pushed and let go by jumps at known times.
BLOCK = """[mechanism]
name = "block"
[run]
until = 1.0
step = 0.01
[bodies.b]
mass = 1.0
inertia = 0.1
[joints.rail]
type = "translational"
between = ["ground", "b"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
friction = { sliding = 1.0 }
[forces.push]
type = "force"
body = "b"
force = ["(3 if t > 0.5 else 0) - (6 if t > 0.625 else 0) - 2*b.x", 0.0]
"""
SCRIPT = """
import { model } from "./block.mjs";
const look = (spacing) => {
  const y = model.start(), told = [...model.transitions()];
  for (let k = 1, t = 0; k * spacing < 1 + 1e-9; k++) {
    while (t < k * spacing - 1e-12) {
      const h = Math.min(0.01, k * spacing - t);
      if (!model.step(t, y, h)) throw new Error("failed");
      t = k * spacing - t - h < 1e-11 ? k * spacing : t + h;
    }
    const found = model.transitions();
    if (found.some((each) => each.t > k * spacing + 1e-9)) throw new Error("told before it is shown");
    told.push(...found);
  }
  return { y: [...y], told: told.map((each) => [each.name, each.t]) };
};
console.log(JSON.stringify([0.01, 0.03, 0.05, 0.1, 0.5, 0.03125, 0.0125, 0.125, 0.0078125, 1 / 60].map(look)));
"""


@pytest.fixture(scope="module")
def looks(tmp_path_factory):
    """What Node finds, looking at the same motion at ten spacings."""
    folder = tmp_path_factory.mktemp("block")
    (folder / "block.toml").write_text(BLOCK, encoding="utf-8")
    assert main(["generate", str(folder / "block.toml"), "--target", "javascript", "-o", str(folder)]) == 0
    node = shutil.which("node")
    assert node, "this test needs Node: apt-get install nodejs"
    command = [node, "--input-type=module", "-e", SCRIPT]
    said = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return json.loads(said.stdout)


@pytest.mark.slow
def test_a_transition_at_an_output_is_told_once(looks):
    """The block breaks loose at 0.5 s, turns, rests: 0.5 = 16 * 0.03125 and 0.625 = 5 * 0.125 are outputs."""
    first = looks[0]["told"]
    assert first[0][0] == "rail.slip" and first[0][1] == pytest.approx(0.5, abs=1e-9)
    assert "rail.reverse" in [name for name, _ in first]
    for look in looks:
        assert [name for name, _ in look["told"]] == [name for name, _ in first]
        assert [t for _, t in look["told"]] == pytest.approx([t for _, t in first], abs=1e-7)


def test_outputs_at_the_ends_of_steps_change_no_bits(looks):
    whole = looks[4]["y"]
    assert all(look["y"] == whole for look in looks[:5] if look is not looks[1])
    for look in (looks[i] for i in (5, 6, 7, 8, 9)):
        assert look["y"] == pytest.approx(whole, abs=1e-7)
