"""``symgen edit`` for people who use a keyboard or a screen reader: axe-core finds nothing."""

import shutil
from collections.abc import Iterator
from importlib.resources import files
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


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_axe_finds_nothing(width: int, theme: str, page: Page) -> None:
    page.open(width)
    page.until("window.symgen.editor.times().lived === window.symgen.editor.version()")
    if page.run("document.documentElement.dataset.theme") != theme:
        page.press("#theme")
    text = page.text("text")
    at = text.index("[joints.motor]")
    page.run(f"(t => {{ t.focus(); t.setSelectionRange({at}, {at}); }})(document.getElementById('text'))")
    page.run("document.getElementById('joint').open = true")
    page.until("document.querySelectorAll('#joint math').length > 1")
    page.press("#seek")
    page.press("[data-tool=slide]")
    page.run("window.symgen.editor.offer('test', 'bar.toml has changed on the disk.', [['Load the file', () => {}]])")
    for menu in ("more", "seen"):
        page.run(f"document.getElementById('{menu}').open = true")
    page.type(text.index("[bodies"), "mas")
    page.until("!document.getElementById('errors').hidden")
    page.run(files("axe_core_python").joinpath("axe.min.js").read_text(encoding="utf-8") + "; true")
    found = page.run(
        "axe.run().then((r) => r.violations.map((v) => [v.id, v.nodes.slice(0, 3).map((n) => n.html.slice(0, 120))]))"
    )
    assert found == []
    assert page.said() == []
