"""Lengths and angles on the picture of ``symgen edit``: shown for what is selected, typed, and undone."""

import math
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from symgen.describe import catalogue
from tests.browser.chromium import Chromium
from tests.browser.editor_page import Page

pytestmark = pytest.mark.browser

SHOWN = "[...document.querySelectorAll('#dimensions .dimension')].map((e) => [e.title, e.textContent])"


@pytest.fixture
def page(chromium: Chromium, tmp_path: Path) -> Iterator[Page]:
    own = catalogue.file_of_entry("four-bar")
    assert own is not None
    with Page.of(chromium, Path(shutil.copy(own, tmp_path / "bar.toml"))) as opened:
        yield opened


def typed(page: Page, name: str, value: str) -> None:
    """Click a dimension and type another value."""
    page.until(f"[...document.querySelectorAll('#dimensions .dimension')].some((e) => e.title === '{name}')")
    box = f"[...document.querySelectorAll('#dimensions .dimension')].find((e) => e.title === '{name}')"
    page.chromium.frame()
    x, y = page.run(f"(r => [r.x + r.width / 2, r.y + r.height / 2])({box}.getBoundingClientRect())")
    page.click(x, y)
    page.until("document.activeElement.matches('input.dimension')")
    page.chromium.call("Input.insertText", text=value)  # the number before is selected
    page.key("Enter")


def test_dimensions_of_what_is_selected_are_typed_and_undone(page: Page) -> None:
    page.open(1280, 900)
    page.rested()
    text = page.text("text")
    assert page.run(SHOWN) == []
    q = page.run("symgen.q[0]")
    page.click(*page.place(q[3] + 1.2, q[4] + 1.2 * math.tan(q[5])))  # on the coupler, off its centre
    page.until("document.getElementById('status').textContent.startsWith('bodies.coupler is selected')")
    page.until(f"({SHOWN}).length === 2")
    assert page.run(SHOWN)[0] == ["bodies.coupler.B-C", "8 m"]
    page.picture("dimensions")
    typed(page, "bodies.coupler.B-C", "8.5")
    page.until("document.getElementById('status').textContent === 'bodies.coupler.B-C is 8.5'")
    page.rested()
    after = page.text("text")
    assert "points = { B = [-4.0, 0.0], C = [4.5, 0.0] }" in after
    changes = [b for a, b in zip(text.splitlines(), after.splitlines(), strict=True) if a != b]
    assert len(changes) == 1
    page.until(f"({SHOWN}).length === 2 && ({SHOWN})[0][1] === '8.5 m'")
    typed(page, "bodies.coupler.B-C", "-1")
    page.until("document.getElementById('status').textContent.includes('expected a length above 0')")
    assert page.text("text") == after
    page.key("Escape")
    page.run("document.getElementById('undo').click()")
    assert page.text("text") == text
    page.rested()

    page.press("#sizes")
    page.until(f"({SHOWN}).some(([name]) => name.startsWith('ground.'))")
    assert dict(page.run(SHOWN))["ground.A-D"] == "10 m"
    page.picture("dimensions-all")
    assert page.said() == []


def test_a_bar_that_was_drawn_shows_its_length_and_angle(page: Page) -> None:
    page.open(1280, 900)
    page.rested()
    page.press("[data-tool=bar]")
    page.chromium.frame()
    for x, y in ((12.0, 1.0), (12.0, 4.0)):
        page.click(*page.place(x, y))
    page.until(f"({SHOWN}).length === 2")
    assert [words for _, words in page.run(SHOWN)] == ["3 m", "90°"]
    page.press("[data-tool=move]")
    name = page.run(SHOWN)[1][0]
    typed(page, name, "0")
    page.until(f"document.getElementById('status').textContent === '{name} is 0'")
    assert "B = [3.0, 0.0]" in page.text("text")
    page.rested()
    assert page.said() == []
