"""Room for the drawing in ``symgen edit``, and what a click in the picture selects."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from symgen.describe import catalogue
from tests.browser.chromium import Chromium
from tests.browser.editor_page import Page

pytestmark = pytest.mark.browser


@pytest.fixture
def page(chromium: Chromium, tmp_path: Path) -> Iterator[Page]:
    own = catalogue.file_of_entry("driven-four-bar")
    assert own is not None
    with Page.of(chromium, Path(shutil.copy(own, tmp_path / "bar.toml"))) as opened:
        yield opened


def box(page: Page, of: str) -> tuple[float, float, float, float]:
    """Return left, top, width and height of an element on the screen."""
    found = page.run(
        f"(({{ left, top, width, height }}) => [left, top, width, height])"
        f"(document.querySelector({of!r}).getBoundingClientRect())"
    )
    return float(found[0]), float(found[1]), float(found[2]), float(found[3])


def test_the_picture_has_nearly_half_of_the_window_and_everything_is_on_one_screen(page: Page) -> None:
    page.open(1280, 900)
    page.rested()
    page.until("window.symgen.editor.times().lived === window.symgen.editor.version()")
    _, _, width, height = box(page, "#picture")
    assert width * height > 0.45 * 1280 * 900
    assert box(page, "#pane")[2] == pytest.approx(0.35 * 1280, rel=0.05)
    for part in ("#save", "#undo", "#redo", "#play", "#timeline", "#plot", "#text", "[data-tool=load]"):
        left, top, wide, tall = box(page, part)
        assert wide > 0 and tall > 0 and left >= 0 and left + 20 <= 1280 and top >= 0 and top + 10 <= 900, part
    assert box(page, "#controls")[3] < 50 and box(page, "#plots")[3] < 120
    assert page.run("document.documentElement.scrollHeight <= window.innerHeight")
    assert page.run(
        "[...document.querySelectorAll('#tools button')].every((b) => b.querySelector('svg') && b.textContent)"
    )
    page.picture("layout-1280")


def test_on_a_telephone_the_picture_comes_first_and_tools_lie_below_it(page: Page) -> None:
    page.open(390, 800)
    page.rested()
    tops = [box(page, part)[1] for part in ("#picture", "#tools", "#controls", "#plots", "#pane")]
    assert tops == sorted(tops) and tops[0] < 140
    assert min(box(page, f"[data-tool={tool}]")[3] for tool in ("bar", "pin")) >= 44  # a thumb
    assert page.run("document.documentElement.scrollWidth <= window.innerWidth")
    page.picture("layout-390")


def test_nothing_covers_the_buttons(page: Page) -> None:
    for width in (1280, 390):
        page.open(width, 900)
        page.rested()
        page.press("[data-tool=bar]")
        for part in ("#snap", ".photo button", "#where", "#save", "#undo", "#more summary", "#seen summary"):
            page.run(f"document.querySelector({part!r}).scrollIntoView({{ block: 'center' }})")
            left, top, wide, tall = box(page, part)
            at = f"document.elementFromPoint({left + wide / 2}, {top + tall / 2})"
            assert page.run(f"document.querySelector({part!r}).contains({at})"), (part, width)


def test_a_click_selects_in_picture_and_text_and_del_takes_it_out(page: Page) -> None:
    page.open(1280, 900)
    page.rested()
    text = page.text("text")
    middle = "(({ q }) => q[0])(window.symgen)"
    q = page.run(middle)
    page.click(*page.place(0.5 * q[3] + 0.5 * 8.41, 0.5 * q[4] + 0.5 * 4.74))  # on the coupler, off its pins
    page.until("document.getElementById('status').textContent.startsWith('bodies.coupler is selected')")
    chosen = "(t => t.value.slice(t.selectionStart, t.selectionEnd))(document.getElementById('text'))"
    assert page.run(chosen) == "[bodies.coupler]"
    page.picture("selected")
    page.run("document.getElementById('play').focus()")
    page.key("Delete")
    page.until("!document.getElementById('text').value.includes('[bodies.coupler]')")
    assert page.text("status") == "took out bodies.coupler"
    page.key("z", 2)
    assert page.text("text") == text

    page.rested()
    page.click(*page.place(3.0, -3.0))  # on nothing
    page.run("document.getElementById('play').focus()")
    page.key("Delete")
    page.rested()
    assert page.text("text") == text and page.said() == []
