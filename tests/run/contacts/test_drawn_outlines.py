"""A cam that is drawn, an ellipse of SVG: its follower beside the ellipse itself, in runs, rows and commands."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.run.contacts.scenes import loaded
from tests.run.contacts.test_outlines import cam_follower

#: Semi-axes of a cam [mm], and how near arcs come to it [m].
LONG, SHORT, NEAR = 30.0, 22.0, 1e-7
ARCS = f"M{LONG} 0A{LONG} {SHORT} 0 1 1 -{LONG} 0A{LONG} {SHORT} 0 1 1 {LONG} 0Z"


def drawn(folder: Path) -> str:
    """Return the file of `cam_follower` with a drawing for its outline, which is written into a folder."""
    drawing = f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{ARCS}"/></svg>'
    (folder / "cam.svg").write_text(drawing, encoding="utf-8")
    text = cam_follower([])
    assert "closed = true, points = []" in text
    return text.replace("closed = true, points = []", f'file = "cam.svg", unit = "1 mm", tolerance = {NEAR}')


def lift(angle: float) -> float:
    """Return the height of a disc of 8 mm over the shaft of an ellipse that has turned by an angle."""

    def centre(x: float) -> complex:
        normal = complex(SHORT * math.cos(x), LONG * math.sin(x))
        return complex(LONG * math.cos(x), SHORT * math.sin(x)) + 8.0 * normal / abs(normal)

    def aside(x: float) -> float:  # across the guide, which stands at an angle on the cam
        return (centre(x) * complex(math.cos(angle), -math.sin(angle))).imag

    return 1e-3 * abs(centre(float(brentq(aside, angle - 0.7, angle + 0.7, xtol=1e-15))))


@pytest.mark.slow
def test_the_follower_of_a_drawn_ellipse(tmp_path: Path) -> None:
    model = loaded(drawn(tmp_path), tmp_path)
    run = model.simulate(until=3.2, output_step=0.02, rtol=1e-10)
    expected = np.array([lift(math.pi + 2.0 * t) for t in run.t])
    assert run.status == "ok" and np.abs(run["follower.y"] - expected).max() < 2.0 * NEAR
    speeds = np.linspace(0.5, 6.0, 300)
    table = model.sweep(vary={"om": speeds}, until=0.5, rtol=1e-10).to_dataframe()
    ends = np.array([lift(math.pi + 0.5 * speed) for speed in speeds])
    assert (table["status"] == "ok").all() and np.abs(table["follower.y"] - ends).max() < 2.0 * NEAR


@pytest.mark.slow
def test_commands_read_the_drawing_beside_their_file(tmp_path: Path) -> None:
    folder = tmp_path / "drawn"
    folder.mkdir()
    (folder / "cam.toml").write_text(drawn(folder), encoding="utf-8")

    def answer(*words: str) -> str:
        command = [sys.executable, "-m", "symgen", *words]
        return subprocess.run(command, cwd=tmp_path, check=True, text=True, capture_output=True).stdout

    run = json.loads(answer("run", "drawn/cam.toml", "--until", "1", "--json"))
    final = run["final"]["q"]["follower.y"]
    assert run["status"] == "ok" and abs(final - lift(math.pi + 2.0)) < 2.0 * NEAR
    assert "from cam.svg, unit 0.001 m, curves by arcs within 1e-07 m" in answer("inspect", "drawn/cam.toml")
