"""Live pages in Chromium without a window: frames a second while a motion plays, what a frame costs, and sizes.

    python -m benchmarks.frames [MODEL ...]

Chromium draws in software, as tests of pages do, with at most 60 frames a second.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from rich.table import Table

from benchmarks.show import show
from symgen.api import load
from tests.browser.chromium import Chromium

MODELS = ("toggle-press", "scissor-lift", "jansen-leg", "wiper", "front-suspension")
WIDTHS = (1280, 390)
SECONDS = 3.0
#: Plays, and gives frames a second and the median of what the page computes and draws in one [ms].
PLAYED = """new Promise((done) => {
  if (!document.getElementById('play').classList.contains('playing')) document.getElementById('play').click();
  const own = window.requestAnimationFrame, costs = [];
  window.requestAnimationFrame = (f) => own((now) => {
    const begun = performance.now(); f(now); costs.push(performance.now() - begun);
  });
  let first = 0, count = 0;
  const look = (now) => {
    first ||= now;
    if (now - first < %g) { count += 1; own(look); return; }
    window.requestAnimationFrame = own;
    costs.sort((a, b) => a - b);
    done([1e3 * count / (now - first), costs[costs.length >> 1]]);
  };
  own(look);
})"""


def measured(browser: Chromium, page: Path, width: int) -> tuple[float, float]:
    """Return frames a second and milliseconds of one."""
    browser.open(page, width=width, height=800 if width > 600 else 844)
    browser.run("document.getElementById('forces').click()")  # arrows too
    browser.frame()
    rate, cost = browser.run(PLAYED % (1e3 * SECONDS))
    return float(rate), float(cost)


def main(models: tuple[str, ...]) -> None:
    """Print the table."""
    table = Table("mechanism", "page [kB]", "live", *(f"{w} px: frames/s, ms" for w in WIDTHS))
    with tempfile.TemporaryDirectory() as folder, Chromium() as browser:
        for name in models:
            view = load(name).simulate().view()
            page = view.save(Path(folder) / "page.html")
            cells = (f"{rate:.0f}, {cost:.1f}" for rate, cost in (measured(browser, page, w) for w in WIDTHS))
            size = f"{page.stat().st_size / 1e3:.0f}"
            table.add_row(name, size, "yes" if view.live else "no", *cells)
    show(table)


if __name__ == "__main__":
    main(tuple(sys.argv[1:]) or MODELS)
