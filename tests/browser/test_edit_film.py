"""The steps of docs/edit.md, one after the other; what is seen at each of them is the film of that page."""

import io
from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image

from symgen.describe.edits.template import new_file_text
from tests.browser.chromium import Chromium
from tests.browser.editor_page import KEPT, Page

pytestmark = pytest.mark.browser


@pytest.fixture
def page(chromium: Chromium, tmp_path: Path) -> Iterator[Page]:
    file = tmp_path / "crank-rocker.toml"
    file.write_text(new_file_text("crank-rocker"))
    with Page.of(chromium, file) as opened:
        yield opened


class Film:
    """Pictures of a page, each with the time for which it is seen [ms]."""

    def __init__(self, page: Page, folder: Path) -> None:
        self.page, self.folder = page, folder
        self.frames, self.times = list[Image.Image](), list[int]()

    def take(self, time: int = 900) -> None:
        self.page.chromium.frame()
        seen = self.page.chromium.picture(self.folder / "frame.png").read_bytes()
        whole = Image.open(io.BytesIO(seen)).convert("RGB")
        self.last = whole.resize((960, 600), Image.Resampling.LANCZOS)
        self.frames.append(whole.resize((800, 500), Image.Resampling.LANCZOS))
        self.times.append(time)

    def save(self, path: Path) -> None:
        """Write the film with the colours of its last picture."""
        palette = self.frames[-1].quantize(32)
        frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in self.frames]
        further = {"save_all": True, "append_images": frames[1:], "duration": self.times, "loop": 0, "optimize": True}
        frames[0].save(path, **further)


def test_a_crank_rocker_from_paper(page: Page, tmp_path: Path) -> None:
    page.open(1280, 800)
    page.rested()
    film = Film(page, tmp_path)
    film.take()

    def use(tool: str, *places: str | tuple[float, float]) -> None:
        page.press(f"[data-tool={tool}]")
        before = page.text("text")
        for k, place in enumerate(places):
            page.click(*(page.where(place) if isinstance(place, str) else page.place(*place)))
            if k < len(places) - 1:
                film.take(400)
        page.until(f"document.getElementById('text').value.length > {len(before)}")
        page.rested()
        film.take()

    text = page.text("text")
    at = text.index("[bodies.rod]")
    page.run(f"(t => {{ t.focus(); t.setSelectionRange({at}, {at}); }})(document.getElementById('text'))")
    page.press("#remove")
    page.until("!document.getElementById('text').value.includes('[bodies.rod]')")
    film.take()
    page.press("[data-tool=bar]")
    use("bar", (-0.35, 0.0), (-0.25, 0.15))
    use("bar", "bodies.bar1.points.B", (0.3, 0.4))
    use("bar", "bodies.bar2.points.B", (0.4, 0.0))
    use("pin", "bodies.bar1.points.A", "bodies.bar1.points.A")
    use("pin", "bodies.bar3.points.B", "bodies.bar3.points.B")
    use("motor", "joints.pin3")
    page.press("[data-tool=move]")
    x, y = page.where("joints.pin2")
    page.mouse("mousePressed", x, y)
    for k in range(1, 9):
        page.mouse("mouseMoved", x + 5 * k, y - 5 * k)
        page.chromium.frame()
        film.take(120)
    page.mouse("mouseReleased", x + 40, y - 40)
    page.rested()
    film.take()
    for k in range(20):
        page.run(f"window.symgen.frame({0.05 * k})")
        film.take(120)
    page.run("window.symgen.frame(0)")
    page.key("s", 2)
    page.until("document.getElementById('status').textContent.startsWith('saved')")
    film.take(2000)
    saved = page.editor.document.path.read_text()
    assert saved == page.text("text") and saved.count("[bodies.") - saved.count("# [bodies.") == 3
    assert page.text("freedoms") == "0 degrees of freedom" and page.text("facts").endswith("status ok")
    assert len(film.frames) > 40 and page.said() == []
    if KEPT:
        film.save(Path(KEPT) / "edit.gif")
        film.last.quantize(64, dither=Image.Dither.NONE).save(Path(KEPT) / "edit.png", optimize=True)
