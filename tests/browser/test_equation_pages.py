"""Pages of derived equations in a real browser: offline, without errors, and the way from a joint to a line of code."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from symgen import catalogue
from symgen.cli import main
from tests.browser.chromium import Chromium

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def chromium() -> Iterator[Chromium]:
    with Chromium() as browser:
        yield browser


def page_of(name: str, folder: Path, *arguments: str) -> Path:
    path = folder / "page.html"
    assert main(["inspect", name, "-o", str(path), *arguments]) == 0
    return path


def settled(chromium: Chromium) -> float:
    """Wait until something was painted; return when, from the beginning of the navigation [ms]."""
    painted = """new Promise((found) => new PerformanceObserver((list) => {
      for (const e of list.getEntries()) if (e.name === 'first-contentful-paint') found(e.startTime);
    }).observe({ type: 'paint', buffered: true }))"""
    return float(chromium.run(painted))


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", sorted(catalogue.known()))
def test_pages_of_the_catalogue(name: str, coordinates: str, chromium: Chromium, tmp_path: Path) -> None:
    """Nothing is said on the console, nothing asked of a network; all that is folded can be opened."""
    path = page_of(name, tmp_path, "--coordinates", coordinates)
    assert path.stat().st_size <= 2_000_000
    chromium.open(path)
    settled(chromium)
    chromium.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    chromium.frame()
    assert chromium.said == []
    wide = "document.documentElement.scrollWidth <= window.innerWidth"
    assert chromium.run(wide)
    tall = "[...document.querySelectorAll('.fold')].every((f) => f.clientHeight <= window.innerHeight)"
    assert chromium.run(tall)
    assert chromium.run(
        "[...document.querySelectorAll('a[href^=\"#\"]')].every((a) => "
        "document.getElementById(decodeURIComponent(a.getAttribute('href').slice(1))))"
    )
    assert chromium.run("window.symgen.names.length") > 0


CLICK = "(() => {{ const e = {}; e.dispatchEvent(new MouseEvent('click', {{ bubbles: true, cancelable: true }})); }})()"
SEEN = """(() => {{ const r = document.getElementById('{}').getBoundingClientRect();
  return r.height > 0 && r.bottom > 0 && r.top < window.innerHeight; }})()"""


def test_two_clicks_from_a_joint_to_its_row_and_to_the_line_of_its_jacobian_entry(
    chromium: Chromium, tmp_path: Path
) -> None:
    chromium.open(page_of("four-bar", tmp_path))
    chromium.frame()
    chromium.run(CLICK.format("document.querySelector('#joint-B *')"))
    chromium.frame()
    assert chromium.run(SEEN.format("row-B.x"))
    entry = (
        "[...document.querySelectorAll('[id=\"row-B.x\"] a.code')].find((a) => a.textContent.startsWith('crank.omega'))"
    )
    target = chromium.run(f"{entry}.getAttribute('href').slice(1)")
    chromium.run(CLICK.format(entry))
    chromium.frame()
    assert chromium.run(SEEN.format(target))
    text = chromium.run(f"document.getElementById('{target}').textContent")
    assert text.strip().startswith("w[104] = ") and "B.x: crank.omega" in text
    # and back: from the line to its row, from the row's joint to the sketch
    chromium.run(CLICK.format(f"document.querySelector('#{target} a')"))
    chromium.frame()
    assert chromium.run(SEEN.format("row-B.x"))
    chromium.run(CLICK.format("document.querySelector('#rows-B a')"))
    chromium.frame()
    assert chromium.run(SEEN.format("joint-B"))
    assert chromium.run("document.getElementById('joint-B').classList.contains('marked')")
