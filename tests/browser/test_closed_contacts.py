"""Pages show which contacts are closed: their surfaces are lit."""

from pathlib import Path

import pytest

from symgen import load
from tests.browser.chromium import Chromium
from tests.run.contacts.scenes import body, floor, head

pytestmark = pytest.mark.browser

#: Number of points of the picture in the colour of pushing forces, at a share of the motion.
LIT = """(() => {
  window.symgen.frame(SHARE);
  const canvas = document.getElementById("view"), {width, height} = canvas;
  const points = canvas.getContext("2d").getImageData(0, 0, width, height).data;
  const probe = document.createElement("canvas").getContext("2d");
  probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--push").trim();
  probe.fillRect(0, 0, 1, 1);
  const [r, g, b] = probe.getImageData(0, 0, 1, 1).data;
  let count = 0;
  for (let k = 0; k < points.length; k += 4) if (points[k] === r && points[k + 1] === g && points[k + 2] === b) count++;
  return count;
})()"""


def test_a_disc_that_falls_and_stays(chromium: Chromium, tmp_path: Path) -> None:
    """It is in flight for 0.29 s and lies on the floor for the rest of a second."""
    text = head("fall") + body("disc", 1.0, 0.005, (0.0, 0.5)) + floor("disc", 0.1, 0.3)
    (tmp_path / "fall.toml").write_text(text)
    result = load(tmp_path / "fall.toml").simulate(until=1.0, integrator="rk4", step=1e-3)
    chromium.open(result.view().save(tmp_path / "page.html"), 1280, 800)
    flies, lies = (chromium.run(LIT.replace("SHARE", share)) for share in ("0.1", "0.9"))
    assert flies == 0 and lies > 100
    assert [line for line in chromium.said if "readback" not in line] == []
