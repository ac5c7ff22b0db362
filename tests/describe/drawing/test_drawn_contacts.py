"""Surfaces of contacts in pictures."""

import math

import symgen
from symgen.describe.drawing.mechanism_scene import build_scene
from symgen.describe.drawing.scene import DrawnCircle, Line, Solid

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


SPACE = """
[mechanism]
name = "shown"
space = "spatial"
gravity = [0.0, 0.0, -9.81]
[bodies.ball]
mass = 1.0
inertia = [0.01, 0.01, 0.01]
position = [0.0, 0.0, 0.3]
[bodies.coin]
mass = 1.0
inertia = [0.01, 0.01, 0.02]
position = [0.5, 0.0, 0.4]
orientation = { rotation_vector = [1.2, 0.0, 0.0] }
[bodies.pill]
mass = 1.0
inertia = [0.01, 0.01, 0.02]
position = [1.0, 0.0, 0.5]
[bodies.die]
mass = 1.0
inertia = [0.01, 0.01, 0.02]
position = [1.5, 0.0, 0.4]
[contacts.floor]
between = [{ body = "ball", sphere = 0.1 }, { plane = "ground" }]
[contacts.bowl]
between = [{ body = "ball", sphere = 0.1 }, { body = "ground", at = [0.0, 0.0, 0.6], sphere = -1.0 }]
[contacts.rim]
between = [{ body = "coin", disc = 0.2 }, { plane = "ground" }]
[contacts.ends]
between = [{ body = "pill", capsule = [0.1, 0.4] }, { plane = "ground" }]
[contacts.corners]
between = [{ plane = "ground" }, { body = "die", box = [0.2, 0.3, 0.4] }]
[contacts.tip]
between = [{ body = "die", at = [0.0, 0.0, -0.3] }, { plane = "ground" }]
"""


def test_all_shapes_in_space_are_drawn(tmp_path):
    (tmp_path / "shown.toml").write_text(SPACE)
    scene = build_scene(symgen.load(tmp_path / "shown.toml").mechanism)
    items = {item.name: item.marks for item in scene.items if item.role == "contact"}
    assert set(items) == {"floor", "bowl", "rim", "ends", "corners", "tip"}
    ball, *rings, plane = items["floor"]
    assert isinstance(ball, DrawnCircle) and ball.radius == 0.1 and len(rings) == 3
    for ring in rings:
        assert all(abs(math.hypot(*point) - 0.1) < 1e-12 for point in ring.points)
    assert plane.body < 0 and plane.closed and all(z == 0.0 for _, _, z in plane.points)
    assert min(x for x, _, _ in plane.points) <= -0.15 and max(x for x, _, _ in plane.points) >= 0.15
    assert len(items["bowl"]) == 3 and all(
        abs(math.hypot(x, y, z - 0.6) - 1.0) < 1e-12 for ring in items["bowl"] for x, y, z in ring.points
    )
    rim = items["rim"][0]
    assert rim.closed and all(abs(z) < 1e-12 and abs(math.hypot(x, y) - 0.2) < 1e-12 for x, y, z in rim.points)
    ends = [mark.at for mark in items["ends"] if isinstance(mark, DrawnCircle)]
    assert len(ends) == 2 and abs(abs(ends[0][2] - ends[1][2]) - 0.4) < 1e-12
    box, floor = items["corners"][:2]
    assert isinstance(box, Solid) and len(box.faces) == 6 and isinstance(floor, Line)
    assert {tuple(abs(round(x, 12)) for x in point) for face in box.faces for point in face} == {(0.1, 0.15, 0.2)}
    assert isinstance(items["tip"][0], DrawnCircle) and items["tip"][0].at == (0.0, 0.0, -0.3)
