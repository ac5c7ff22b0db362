"""Rays of outputs beside crossings by complex numbers, in 300 directions over a room; rows, C and sentences."""

import cmath
import json
import math
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from result.targets.compilers import compiled, written
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError

#: A room with a wall that bulges outwards and one that bulges inwards; a box with round corners turns in it, a post
#: moves, and a door stands open. A line closes the room far above.
ROOM = """
[mechanism]
name = "room"
[run]
until = 6.0
integrator = "dop853"
output_step = 0.02
[parameters]
r = 0.2
[bodies.car]
mass = 1.0
inertia = 1.0
position = [0.3, -0.4]
velocity = [0.1, 0.05]
angular_velocity = 2.2
points = { nose = [0.1, 0.02] }
[bodies.box]
mass = 1.0
inertia = 1.0
centre_of_mass = [0.05, 0.0]
position = [-0.7, 0.6]
angular_velocity = 0.4
[bodies.post]
type = "point"
mass = 1.0
position = [1.2, 0.5]
velocity = [-0.05, 0.1]
[outlines.walls]
body = "ground"
closed = true
points = [
    [-2.0, -1.5],
    [2.0, -1.5],
    { to = [2.0, 1.5], radius = 2.5 },
    [-2.0, 1.5],
    { to = [-2.0, -1.5], radius = -2.5 },
]
[outlines.crate]
body = "box"
box = [0.5, 0.3]
fillet = 0.1
[outputs.seen]
smallest = 0.1
[outputs.seen.ray]
body = "car"
at = "nose"
direction = [0.8, 0.6]
reach = 2.4
shapes = [
    { outline = "walls" },
    { outline = "crate" },
    { body = "post", disc = "r" },
    { body = "ground", segment = [[0.5, -1.5], [0.9, -1.0]] },
    { line = "ground", on = [0.0, 1.3], normal = [0.0, -1.0] },
]
"""
SEEN = "[outputs.seen]\nsmallest = 0.1\n[outputs.seen.ray]"


def of(text: str) -> symgen.Model:
    """Return the model of a text."""
    return symgen.Model(mechanism_of(tomllib.loads(text)))


def on_segment(ray: complex, eye: complex, a: complex, b: complex) -> list[float]:
    """Ways along a ray to a segment, by a linear system."""
    system = np.array([[ray.real, (a - b).real], [ray.imag, (a - b).imag]])
    way, part = np.linalg.solve(system, [(a - eye).real, (a - eye).imag])
    return [way] if way >= 0.0 and 0.0 <= part <= 1.0 else []


def on_arc(ray: complex, eye: complex, centre: complex, radius: float, start: float, angle: float) -> list[float]:
    """Ways to an arc from an angle on, to the left, by the roots of a polynomial."""
    off = eye - centre
    roots = np.roots([1.0, 2.0 * (ray.conjugate() * off).real, abs(off) ** 2 - radius**2])
    ways = [root.real for root in roots if abs(root.imag) < 1e-12 and root.real >= 0.0]
    return [s for s in ways if (cmath.phase(off + s * ray) - start) % (2.0 * math.pi) <= angle]


def seen(time: float, r: float = 0.2) -> float:
    """What the ray meets first, all bodies at their places by their velocities."""
    turn = cmath.exp(2.2j * time)
    eye = 0.3 - 0.4j + (0.1 + 0.05j) * time + turn * (0.1 + 0.02j)
    ray = turn * (0.8 + 0.6j)
    ways = [2.4]
    corners = [-2.0 - 1.5j, 2.0 - 1.5j, 2.0 + 1.5j, -2.0 + 1.5j]
    ways += on_segment(ray, eye, corners[0], corners[1]) + on_segment(ray, eye, corners[2], corners[3])
    half = math.asin(0.6)
    ways += on_arc(ray, eye, 0.0, 2.5, -half, 2.0 * half) + on_arc(ray, eye, -4.0, 2.5, -half, 2.0 * half)
    ways += on_segment(ray, eye, 0.5 - 1.5j, 0.9 - 1.0j) + on_segment(ray, eye, -50.0 + 1.3j, 50.0 + 1.3j)
    ways += on_arc(ray, eye, 1.2 + 0.5j + (-0.05 + 0.1j) * time, r, 0.0, 7.0)
    tilt = cmath.exp(0.4j * time)
    middle = -0.65 + 0.6j - 0.05 * tilt  # the centre of mass stays
    for k, (wide, high) in enumerate(((0.25, 0.15), (0.15, 0.25)) * 2):
        side = tilt * 1j**k
        ways += on_segment(
            ray, eye, middle + side * (wide - 1j * (high - 0.1)), middle + side * (wide + 1j * (high - 0.1))
        )
        start = 0.4 * time + k * math.pi / 2.0
        ways += on_arc(ray, eye, middle + side * (wide - 0.1 + 1j * (high - 0.1)), 0.1, start, math.pi / 2.0)
    return min(ways)


def test_300_directions_over_a_room() -> None:
    run = of(ROOM).simulate(rtol=1e-12, atol=1e-13)
    assert run.ok, run.status
    exact = np.array([seen(t) for t in run.t])
    assert len(exact) == 301 and np.unique(np.round(exact, 3)).size > 150
    assert exact.min() < 0.8 and np.sum(exact == 2.4) > 3
    np.testing.assert_allclose(run["seen"], exact, rtol=0.0, atol=1e-8)


def test_rows_and_derivatives_have_them() -> None:
    model, times = of(ROOM), [t for t in np.linspace(0.0, 6.0, 301) if abs(seen(t, 0.21) - seen(t)) > 1e-4]
    until = float(times[len(times) // 2])
    rows = symgen.sweep(model, {"r": [0.18, 0.2]}, quantities=["seen"], until=until)
    np.testing.assert_allclose(rows["seen"][:, -1], [seen(until, 0.18), seen(until)], rtol=0.0, atol=1e-6)
    slope = model.simulate(until=until, sensitivities=["r"]).gradient("seen").row()["r"]
    assert slope == pytest.approx((seen(until, 0.2 + 1e-6) - seen(until, 0.2 - 1e-6)) / 2e-6, rel=1e-5)


@pytest.mark.slow
def test_c_has_them(tmp_path: Path) -> None:
    written(of(ROOM).mechanism, tmp_path)
    prefix = next(tmp_path.glob("*.h")).stem
    body = "{p}_init(&m); if ({p}_start(&m)) return 1; {p}_outputs(&m, m.t, m.y, out); "
    text = (
        '#include "{p}.h"\n#include <stdio.h>\nint main(void) {{ static {p} m; double out[{u}_OUTPUTS]; int e; ' + body
    )
    text += "if ({p}_advance(&m, 0.5, 1e-3, &e)) return 1; {p}_outputs(&m, m.t, m.y, out); "
    text += 'printf("%.17g", out[0]); return 0; }}'
    (tmp_path / "main.c").write_text(text.format(p=prefix, u=prefix.upper()))
    ran = subprocess.run([str(compiled(tmp_path))], capture_output=True, text=True, check=True)
    assert float(ran.stdout) == pytest.approx(seen(0.5), abs=1e-8)


def test_in_a_process_of_its_own(tmp_path: Path) -> None:
    (tmp_path / "room.toml").write_text(ROOM)
    command = [sys.executable, "-m", "symgen", "run", "room.toml", "--until", "0.5", "--json"]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert json.loads(ran.stdout)["final"]["outputs"]["seen"] == pytest.approx(seen(0.5), abs=1e-6)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (SEEN, '[outputs.seen]\nvalue = "car.x"\n[outputs.seen.ray]', "one of value and ray, got both"),
        ('disc = "r"', "disc = 0.0", "a radius other than 0"),
        ('outline = "crate"', 'outline = "crat"', "did you mean 'crate'"),
        ('body = "car"\n', 'body = "post"\n', "post"),
        ("reach = 2.4", "reach = -1.0", "above 0"),
        ('line = "ground"', 'lin = "ground"', "the unknown key 'lin'; did you mean 'line'"),
    ],
)
def test_sentences(old: str, new: str, words: str) -> None:
    assert old in ROOM
    with pytest.raises(InputError) as error:
        of(ROOM.replace(old, new))
    assert words in str(error.value)
