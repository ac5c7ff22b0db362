"""Surfaces of contacts in pictures."""

import symgen
from symgen.describe.drawing.mechanism_scene import build_scene
from symgen.describe.drawing.scene import DrawnCircle, Line

FILE = """
[mechanism]
name = "shown"
gravity = [0.0, -9.81]
[bodies.wheel]
mass = 1.0
inertia = 0.02
position = [0.3, 0.2]
[bodies.arm]
mass = 1.0
inertia = 0.02
position = [1.0, 0.5]
[contacts.floor]
between = [{ body = "wheel", disc = 0.2 }, { line = "ground" }]
[contacts.slot]
between = [{ body = "wheel", at = [0.15, 0.0], disc = 0.01 }, { body = "arm", segment = [[0.1, 0.0], [0.4, 0.1]] }]
[contacts.tip]
between = [{ body = "arm", at = [-0.2, -0.3] }, { line = "ground" }]
[contacts.rim]
between = [{ body = "wheel", disc = 0.2 }, { body = "ground", disc = -3.0 }]
"""


def test_all_shapes_are_drawn(tmp_path):
    (tmp_path / "shown.toml").write_text(FILE)
    scene = build_scene(symgen.load(tmp_path / "shown.toml").mechanism)
    items = {item.name: item.marks for item in scene.items if item.role == "contact"}
    assert set(items) == {"floor", "slot", "tip", "rim"}
    ring, spoke, guide, *hatches = items["floor"]
    assert isinstance(ring, Line) and ring.closed and ring.body == 0 and len(hatches) >= 3
    assert abs(max(x for x, _, _ in ring.points) - 0.2) < 1e-12
    assert spoke.body == 0 and guide.body < 0 and all(y == 0.0 for _, y, _ in guide.points)
    segment = items["slot"][-1]
    assert segment.body == 1 and segment.points == ((0.1, 0.0, 0.0), (0.4, 0.1, 0.0))
    assert isinstance(items["tip"][0], DrawnCircle) and items["tip"][0].at == (-0.2, -0.3, 0.0)
    (hole,) = items["rim"]  # its disc is drawn once
    assert hole.body < 0 and hole.closed and abs(max(x for x, _, _ in hole.points) - 3.0) < 1e-12
    wheel, arm = (item for item in scene.items if item.role == "body")
    assert len(wheel.marks) == 2 and not wheel.marks[0].look.dashed
    assert any(isinstance(mark, Line) and mark.closed and len(mark.points) == 3 for mark in arm.marks)
