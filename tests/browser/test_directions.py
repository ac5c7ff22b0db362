"""Directions of arrows in pages: what the script draws in turned positions, against what was worked out by hand."""

import math
from pathlib import Path

import numpy as np
import pytest

from symgen.describe.files.builder import MechanismBuilder
from symgen.result.player.motion_page import motion_page
from symgen.result.player.recording import Recording
from tests.browser.chromium import WITHOUT_WEBGL, Chromium

pytestmark = pytest.mark.browser

ANGLES = (0.3, 0.9, 0.3 + 0.5 * math.pi, -2.6)
#: Keeps the ends of open lines in the colour of forces, as they stand on the picture.
HEARD = """(() => {
  const of = CanvasRenderingContext2D.prototype, { beginPath, moveTo, lineTo, stroke, closePath } = of;
  let path = [], closed = false;
  window.heard = [];
  of.beginPath = function () { path = []; closed = false; return beginPath.call(this); };
  of.moveTo = function (x, y) { path.push([x, y]); return moveTo.call(this, x, y); };
  of.lineTo = function (x, y) { path.push([x, y]); return lineTo.call(this, x, y); };
  of.closePath = function () { closed = true; return closePath.call(this); };
  of.stroke = function () {
    if (!closed && this.strokeStyle === '#a0522d') window.heard.push(path);
    return stroke.call(this);
  };
})();"""


def heard(chromium: Chromium, k: int) -> np.ndarray:
    """Return the one line of a force in a frame, upwards as the page is read."""
    share = k / (len(ANGLES) - 1)
    (line,) = chromium.run(f"(() => {{ window.heard = []; window.symgen.frame({share!r}); return window.heard; }})()")
    return np.array(line) * [1.0, -1.0]


def along(line: np.ndarray) -> np.ndarray:
    return np.asarray((line[-1] - line[0]) / np.linalg.norm(line[-1] - line[0]))


@pytest.mark.parametrize("frame", ["ground", "body"])
def test_forces_in_the_plane(frame: str, chromium: Chromium, tmp_path: Path) -> None:
    builder = MechanismBuilder("arm").body("a", mass=1.0, inertia=1.0, points={"tip": (2.0, 0.5)}, angle=0.3)
    builder.joint("pin", "revolute", between=("ground", "a"), at=((0.0, 0.0), "centre"))
    builder.force("f", "force", body="a", at="tip", force=(3.0, -4.0), frame=frame)
    q = np.array([[0.0, 0.0, angle] for angle in ANGLES])
    path = tmp_path / "arm.html"
    motion_page(Recording(builder.build(), {}, np.arange(4.0), q)).save(path)
    chromium.open(path, scripts=(HEARD,))
    for k, angle in enumerate(ANGLES):
        c, s = (1.0, 0.0) if frame == "ground" else (math.cos(angle), math.sin(angle))
        # points of the body stand on the page's grid of a two-hundredth of a symbol
        assert along(heard(chromium, k)) == pytest.approx([0.6 * c + 0.8 * s, 0.6 * s - 0.8 * c], abs=5e-3)
    assert chromium.said == []


def space(tmp_path: Path, kind: str, **keys: object) -> Path:
    """Return the page of a body that turns about x."""
    builder = MechanismBuilder("arm", space="spatial", gravity=(0.0, 0.0, -9.81))
    builder.body("a", mass=1.0, inertia=(1e-4, 1e-4, 1e-4), points={"tip": (1.0, 0.25, 0.1)})
    builder.force("f", kind, body="a", **keys)
    q = np.array([[0.0, 0.0, 0.0, math.cos(angle / 2), math.sin(angle / 2), 0.0, 0.0] for angle in ANGLES])
    path = tmp_path / "space.html"
    motion_page(Recording(builder.build(), {}, np.arange(4.0), q)).save(path)
    return path


@pytest.mark.parametrize("frame", ["ground", "body"])
def test_forces_in_space_without_webgl(frame: str, chromium: Chromium, tmp_path: Path) -> None:
    chromium.open(
        space(tmp_path, "force", at="tip", force=(0.0, 3.0, 4.0), frame=frame), scripts=(HEARD, WITHOUT_WEBGL)
    )
    chromium.run("window.symgen.look(0, 0, [0, 0, 0])")  # to the right is y, upwards z
    for k, angle in enumerate(ANGLES):
        c, s = (1.0, 0.0) if frame == "ground" else (math.cos(angle), math.sin(angle))
        assert along(heard(chromium, k)) == pytest.approx([0.6 * c - 0.8 * s, 0.6 * s + 0.8 * c], abs=5e-3)
    assert chromium.said == []


#: Where pixels are that have the hue of forces, and how many the picture has.
BROWN = """(() => {
  window.symgen.frame(%r);
  const solid = document.getElementById('solid'), c = document.createElement('canvas');
  Object.assign(c, { width: solid.width, height: solid.height });
  const context = c.getContext('2d'), found = [];
  context.drawImage(solid, 0, 0);
  const d = context.getImageData(0, 0, c.width, c.height).data;
  for (let i = 0; i < d.length; i += 4) {
    const [r, g, b] = d.slice(i, i + 3);
    if (r < 80 || Math.abs(g / r - 82 / 160) > 0.1 || Math.abs(b / r - 45 / 160) > 0.1) continue;
    found.push([(i / 4) %% c.width, -Math.floor(i / 4 / c.width)]);
  }
  return found;
})()"""


@pytest.mark.parametrize("frame", ["ground", "body"])
def test_forces_in_space_by_webgl(frame: str, chromium: Chromium, tmp_path: Path) -> None:
    """The direction in which pixels of the arrow lie, to the side on which there are more of them: the head's."""
    path = space(tmp_path, "force", at="tip", force=(0.0, 3.0, 4.0), frame=frame)
    chromium.open(path, scale=2.0)
    assert not chromium.run("document.getElementById('solid').hidden")
    chromium.run(
        "(() => { const t = document.getElementById('trace'); t.value = ''; t.dispatchEvent(new Event('change')); })()"
    )
    chromium.run("window.symgen.look(0, 0, [0, 0, 0])")
    for k, angle in enumerate(ANGLES):
        pixels = np.array(chromium.run(BROWN % (k / (len(ANGLES) - 1))), dtype=np.float64)
        assert len(pixels) > 100
        way = np.linalg.svd(pixels - pixels.mean(axis=0), full_matrices=False)[2][0]
        on = pixels @ way
        way *= np.sign(np.mean(on) - 0.5 * (on.min() + on.max()))
        c, s = (1.0, 0.0) if frame == "ground" else (math.cos(angle), math.sin(angle))
        own = np.array([0.6 * c - 0.8 * s, 0.6 * s + 0.8 * c])
        assert way @ own > math.cos(math.radians(10.0))


def test_a_torque_about_an_axis_of_the_ground(chromium: Chromium, tmp_path: Path) -> None:
    """About z, seen from aside, while the body turns about x: a flat line in every position."""
    chromium.open(space(tmp_path, "torque", torque=(0.0, 0.0, 2.0)), scripts=(HEARD, WITHOUT_WEBGL))
    chromium.run("window.symgen.look(0, 0, [0, 0, 0])")
    for k in range(len(ANGLES)):
        wide, tall = np.ptp(heard(chromium, k), axis=0)
        assert tall < 0.03 * wide
