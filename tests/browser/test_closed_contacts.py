"""Pages show which contacts are closed: their surfaces are lit."""

from pathlib import Path

import pytest

from symgen import load
from tests.browser.chromium import Chromium
from tests.run.contacts.scenes import body, floor, head

pytestmark = pytest.mark.browser

#: Columns of the points of the picture in the colour of pushing forces, at a share of the motion; width of the picture.
LIT = """(() => {
  window.symgen.frame(SHARE);
  const canvas = document.getElementById("view"), {width, height} = canvas;
  const points = canvas.getContext("2d").getImageData(0, 0, width, height).data;
  const probe = document.createElement("canvas").getContext("2d");
  probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--push").trim();
  probe.fillRect(0, 0, 1, 1);
  const [r, g, b] = probe.getImageData(0, 0, 1, 1).data, found = [];
  for (let k = 0; k < points.length; k += 4)
    if (points[k] === r && points[k + 1] === g && points[k + 2] === b) found.push(k / 4 % width);
  return [width, found];
})()"""


def lit(chromium: Chromium, share: float) -> tuple[int, list[int]]:
    """Return the width of the picture and the columns of points that are lit."""
    width, columns = chromium.run(LIT.replace("SHARE", str(share)))
    return width, columns


def test_a_disc_that_falls_and_stays(chromium: Chromium, tmp_path: Path) -> None:
    """It is in flight for 0.29 s and lies on the floor for the rest of a second."""
    text = head("fall") + body("disc", 1.0, 0.005, (0.0, 0.5)) + floor("disc", 0.1, 0.3)
    (tmp_path / "fall.toml").write_text(text)
    result = load(tmp_path / "fall.toml").simulate(until=1.0, integrator="rk4", step=1e-3)
    chromium.open(result.view().save(tmp_path / "page.html"), 1280, 800)
    (_, flies), (_, lies) = lit(chromium, 0.1), lit(chromium, 0.9)
    assert not flies and len(lies) > 100
    assert [line for line in chromium.said if "readback" not in line] == []


def test_the_piece_of_an_outline_that_is_touched(chromium: Chromium, tmp_path: Path) -> None:
    """A disc slides over a floor of four pieces, of which the one under it is lit."""
    ends = [-1.0, -0.5, 0.1, 0.4, 1.0]
    text = head("slides") + body("disc", 1.0, 0.005, (-0.9, 0.05), (1.8, 0.0))
    text += f'[outlines.floor]\nbody = "ground"\npoints = {[[x, 0.0] for x in ends]!r}\n'
    text += '[contacts.touch]\nbetween = [{ body = "disc", disc = 0.05 }, { outline = "floor" }]\n'
    (tmp_path / "slides.toml").write_text(text)
    result = load(tmp_path / "slides.toml").simulate(until=1.0, integrator="rk4", step=1e-3)
    chromium.open(result.view().save(tmp_path / "page.html"), 1280, 800)
    for share, low, high in ((0.1, -1.0, -0.5), (0.4, -0.5, 0.1), (0.65, 0.1, 0.4), (0.9, 0.4, 1.0)):
        width, columns = lit(chromium, share)
        scale = (width - 40) / 2.0  # the floor is 2 m long
        assert abs(min(columns) - width / 2 - low * scale) < 4 and abs(max(columns) - width / 2 - high * scale) < 4
    assert [line for line in chromium.said if "readback" not in line] == []
