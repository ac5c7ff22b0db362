"""Lead screws with losses: closed forms at every pitch, and a guide whose rows share the thread's reaction."""

import math

import pytest

import symgen
from symgen.cli import main

JACK = """
[mechanism]
name = "jack"
space = "spatial"
gravity = [0.0, 0.0, -9.81]

[run]
until = 0.1

[bodies.spindle]
mass = 2.0
inertia = [0.01, 0.01, 0.01]

[bodies.nut]
mass = 20.0
inertia = [0.1, 0.1, 0.1]
position = [0.0, 0.0, 0.2]

[joints.bearing]
type = "revolute"
between = ["ground", "spindle"]
at = [[0.0, 0.0, 0.0], "centre"]
axis = [0.0, 0.0, 1.0]

[joints.key]
{key}

[joints.thread]
type = "screw"
between = ["spindle", "nut"]
at = ["centre", "centre"]
axis = [0.0, 0.0, 1.0]
pitch = {pitch}
offset = 0.2
efficiency = {efficiency}

[forces.motor]
type = "torque"
joint = "bearing"
torque = {torque}
"""
KEY = 'type = "perpendicular"\nbetween = ["ground", "nut"]\naxes = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]'
GUIDE = 'type = "prismatic"\nbetween = ["ground", "nut"]\nat = [[0.0, 0.0, 0.2], "centre"]\naxis = [0.0, 0.0, 1.0]'
PITCHES = (0.0005, 0.001, 0.002, 0.003, 0.004, 0.005, 0.006, 0.008, 0.01, 0.015, 0.02, 0.0628)


def jack(folder, **keys):
    path = folder / "jack.toml"
    path.write_text(JACK.format(**{"key": KEY, "torque": 10.0, "efficiency": "[0.4, -0.5]"} | keys), encoding="utf-8")
    return path


@pytest.mark.fast("0.0005", "0.004", "0.0628")
@pytest.mark.parametrize("pitch", PITCHES, ids=str)
def test_a_jack_runs_at_every_pitch(pitch, tmp_path):
    """J alpha = T + eta h m (g - h alpha), h = p/2 pi: the nut drives the spindle, or with 1/eta is driven by it."""
    h = pitch / (2.0 * math.pi)
    for torque in (10.0, -10.0):
        result = symgen.load(jack(tmp_path, pitch=pitch, torque=torque)).simulate()
        found = [(torque + share * 20.0 * 9.81 * h) / (0.01 + share * 20.0 * h * h) for share in (-0.5, 1.0 / 0.4)]
        drives = torque > 0.0 and 9.81 > h * found[0]
        assert result.status == "ok", result.reason
        assert result["nut.z"][-1] - 0.2 == pytest.approx(-h * found[0 if drives else 1] * 0.005, rel=1e-6), torque


def test_check_says_which_guide_a_lossy_thread_does_without(tmp_path, capsys):
    path = jack(tmp_path, pitch=0.01, key=GUIDE)
    assert main(["check", str(path)]) == 0
    said = capsys.readouterr().out
    assert "runs refuse friction of thread, as other joints share its reaction" in said
    assert "'perpendicular' in place of 'prismatic'" in said
    assert main(["check", str(jack(tmp_path, pitch=0.01))]) == 0
    assert "runs refuse" not in capsys.readouterr().out
