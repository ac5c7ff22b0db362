"""Pages of derived equations in a real browser: offline, without errors, and the way from a joint to a line of code."""

import json
import types
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.in_coordinates import in_coordinates

from symgen.api import load
from symgen.base.settings import Settings
from symgen.cli import main
from symgen.describe import catalogue
from symgen.result.reading.inspection import run_at_start
from tests.browser.chromium import Chromium

pytestmark = pytest.mark.browser


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


@pytest.mark.by_turns(4)
@pytest.mark.fast("four-bar-absolute", "spatial-slider-crank-joint")
@pytest.mark.parametrize(("name", "coordinates"), in_coordinates(sorted(catalogue.all_names())))
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
    rates_are_those_of_the_compiled_code(name, coordinates, chromium)


def plainly_python(function: Any) -> Any:
    """Return an emitted function, and all that it calls, as plain Python, where nothing is fused."""
    inner = function.py_func
    known, called = dict(inner.__globals__), set(inner.__code__.co_names)
    known |= {name: plainly_python(known[name]) for name in called if hasattr(known.get(name), "py_func")}
    return types.FunctionType(inner.__code__, known)


def rates_are_those_of_the_compiled_code(name: str, coordinates: str, chromium: Chromium) -> None:
    """At the start and near it, to 1e-12 of the largest, or four times what fusing multiplication and addition does."""
    run, _, _ = run_at_start(load(name).mechanism, Settings(shape="straight", coordinates=coordinates))
    law, start, info = run.compiled.law_module, run.start, run.compiled.info
    plain, random = plainly_python(law.rhs), np.random.default_rng(3)
    states, expected, plainly = [], [], []
    for k in range(20):
        y = start.y.copy()
        y[: info.work] += (k > 0) * 1e-3 * random.standard_normal(info.work)
        both = []
        for rhs in (law.rhs, plain):
            ydot, iw = np.zeros(info.ny), np.zeros(16, dtype=np.int64)
            suspicious = rhs(0.0, y, start.p, start.w.copy(), iw, ydot)
            both.append(ydot)
        if suspicious == 0:
            states.append(y.tolist())
            expected.append(both[0])
            plainly.append(both[1])
    assert states
    found = np.array(chromium.run(f"{json.dumps(states)}.map((y) => window.symgen.rates(0, y))"), dtype=np.float64)
    largest = np.abs(expected).max(axis=1, keepdims=True)
    largest[largest == 0.0] = 1.0  # at rest in balance
    off, fused = (float(np.max(np.abs(x - expected) / largest)) for x in (found, np.array(plainly)))
    assert off <= max(1e-12, 4.0 * fused)
    assert chromium.run("window.symgen.y0") == start.y.tolist()
    # parameters given for one call: those of the file give what no parameters give
    given = json.dumps(start.p[: len(info.parameters)].tolist())
    again = chromium.run(f"window.symgen.rates(0, {json.dumps(states[0])}, {given})")
    assert np.array_equal(np.array(again, dtype=np.float64), found[0])


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


def test_formulas_are_whole_without_a_font_for_mathematics(chromium: Chromium, tmp_path: Path) -> None:
    """Nothing is cut below or above, and brackets of matrices are as tall as these."""
    path = page_of("slider-crank", tmp_path)
    plain = "math { font-family: 'DejaVu Sans', sans-serif !important; }"
    path.write_text(path.read_text().replace("</style>", f"{plain}</style>"))
    chromium.open(path)
    chromium.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    chromium.frame()
    cut = "[...document.querySelectorAll('.equation')].filter((e) => e.scrollHeight > e.clientHeight).length"
    assert chromium.run("document.querySelectorAll('.equation').length") > 20 and chromium.run(cut) == 0
    inside = """(() => { const found = [...document.querySelectorAll('mtable.tall')].map((m) => {
      const [own, ...rows] = [m, ...m.querySelectorAll('mtr')].map((e) => e.getBoundingClientRect());
      const { borderLeftWidth, borderRightWidth } = getComputedStyle(m);
      return own.height >= Math.max(...rows.map((r) => r.bottom)) - Math.min(...rows.map((r) => r.top))
        && parseFloat(borderLeftWidth) > 0 && parseFloat(borderRightWidth) > 0; });
      return found.length > 2 && found.every(Boolean); })()"""
    assert chromium.run(inside)
    assert chromium.said == []
