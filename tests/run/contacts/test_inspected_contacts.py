"""What `inspect` and notes say of contacts: which depend on each other, jamming numbers, forces that are not unique."""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.describe.contacts.test_outlines import CAM
from tests.run.contacts.scenes import body, floor, head, loaded, rods
from tests.run.contacts.test_outlines import cam_follower, gap_of_cam

#: A plank on two feet beside a disc, on one floor, and another disc above it.
PLANK = head("plank", 1.5, -9.7) + body("plank", 2.0, 0.05, (0.0, 0.1)) + body("disc", 1.0, 0.005, (1.0, 0.1))
PLANK += (
    body("high", 1.0, 0.005, (2.0, 0.5)) + floor("disc", 0.1, 0.4, name="rim") + floor("high", 0.1, 0.4, name="top")
)
for _name, _x in (("left", -0.3), ("right", 0.2)):
    _shapes = f'[{{ body = "plank", at = [{_x!r}, -0.1] }}, {{ line = "ground" }}]'
    PLANK += f"[contacts.{_name}]\nbetween = {_shapes}\nfriction = 0.5\n"


@pytest.mark.slow
def test_parts_and_forces_that_are_not_unique(tmp_path: Path) -> None:
    model = loaded(PLANK, tmp_path)
    facts = {each["name"]: each for each in model.inspect().facts["contacts"]}
    assert not facts["top"]["closed"] and "part" not in facts["top"]
    assert facts["rim"]["part"] == ["rim"] and facts["rim"]["unique"]
    assert facts["left"]["part"] == facts["right"]["part"] == ["left", "right"]
    assert not facts["left"]["unique"] and not facts["right"]["unique"]
    # a force at a foot: 1/m + x^2 / J, and x y / J along the floor, with y = -0.1
    for name, x in (("left", -0.3), ("right", 0.2)):
        wanted = [0.5 + x * x / 0.05 - s * 0.5 * (-0.1 * -x / 0.05) for s in (1.0, -1.0)]
        assert np.allclose(sorted(facts[name]["jamming"]), sorted(wanted), rtol=1e-12)
    (note,) = [note for note in model.simulate(until=0.01, verify=False).notes if "not unique" in note]
    assert note == "forces of contacts are not unique at left, right: each has a part in proportion to its bound"


@pytest.mark.slow_cases("absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_jamming_numbers_through_joints(coordinates: str, tmp_path: Path) -> None:
    """Two rods on a pin: the mobilities of the tip in their angles."""
    lengths, masses, (a, b) = (1.0, 0.8), (1.5, 0.7), (math.radians(20.0), math.radians(50.0))
    model = loaded(rods(0.4, 0.0, lengths, masses, (20.0, 50.0, 0.0, 0.0)), tmp_path)
    (facts,) = model.inspect(coordinates=coordinates).facts["contacts"]
    (l1, l2), (m1, m2) = lengths, masses
    lean = 0.5 * m2 * l1 * l2 * math.cos(b - a)
    mass = np.array([[m1 * l1**2 / 3.0 + m2 * l1**2, lean], [lean, m2 * l2**2 / 3.0]])
    tip = np.array([[l1 * math.cos(a), l2 * math.cos(b)], [l1 * math.sin(a), l2 * math.sin(b)]])
    mobility = tip @ np.linalg.solve(mass, tip.T)
    wanted = [mobility[1, 1] - s * 0.4 * mobility[1, 0] for s in (1.0, -1.0)]
    assert facts["closed"] and facts["unique"] and np.allclose(facts["jamming"], wanted, rtol=1e-9)


@pytest.mark.slow
def test_a_command_says_so(tmp_path: Path) -> None:
    (tmp_path / "plank.toml").write_text(PLANK)
    command = [sys.executable, "-m", "symgen", "inspect", "plank.toml"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    (left,) = [line for line in lines if line.startswith("contact left:")]
    assert left.endswith("forces not unique") and "coupled with right" in left
    (rim,) = [line for line in lines if line.startswith("contact rim:")]
    assert "closed at the start, alone" in rim and not rim.endswith("forces not unique")
    assert any(line.startswith("contact top:") and line.endswith("open at the start") for line in lines)
    assert any(line.startswith("friction of contact left:") and "0.5" in line for line in lines)


def test_pieces_of_an_outline_have_one_formula(tmp_path: Path) -> None:
    """With the five numbers of its piece the centre of a roller is as far from a cam as from the hull of two discs."""
    model = loaded(cam_follower(CAM), tmp_path)
    inspected = model.inspect()
    (outline,) = inspected.facts["outlines"]
    assert outline["row"] == "touch.normal" and outline["body"] == "cam"
    for turn in np.linspace(0.05, 6.2, 40):
        for far in (0.04, 0.07):
            x, y, found = far * math.cos(turn), far * math.sin(turn), list[tuple[float, float]]()
            for p in outline["pieces"]:
                c, s, k = math.cos(p["angle"]), math.sin(p["angle"]), p["curvature"]
                a, b = c * (x - p["x"]) + s * (y - p["y"]), c * (y - p["y"]) - s * (x - p["x"])
                z = 2.0 * b + k * (a * a + b * b)
                way = math.atan2(k * a, 1.0 + k * b) / k if k else a
                found.append((way, z / (1.0 + math.sqrt(1.0 + k * z))))
            ends = [p["before"] for p in outline["pieces"][1:]]
            lengths = [end - p["before"] for end, p in zip(ends, outline["pieces"], strict=False)]
            within = [gap for (way, gap), most in zip(found, [*lengths, lengths[0]], strict=True) if 0.0 <= way <= most]
            expected = gap_of_cam(np.array([x]), np.array([y]))[0] - 0.008
            assert min(abs(gap - expected) for gap in within) < 1e-12
    text = str(inspected)
    assert "gap = z/(1 + sqrt(1 + k*z)), z = 2*b + k*(a**2 + b**2)" in text
    assert "touch.normal: while it is closed, the gap to an outline of cam is 0" in text
