"""What ``symgen edit`` shows and makes beside the motion: freedoms, modes, equations, torques, files, a photo."""

import ast
import base64
import re
import shutil
import struct
import time
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import Path

import pytest

from symgen.describe import catalogue
from tests.browser.chromium import PATIENCE, Chromium
from tests.browser.editor_page import Page

pytestmark = pytest.mark.browser


@pytest.fixture
def file(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    own = catalogue.file_of_entry(request.param)
    assert own is not None
    return Path(shutil.copy(own, tmp_path / f"{request.param}.toml"))


@pytest.fixture
def page(chromium: Chromium, file: Path) -> Iterator[Page]:
    with Page.of(chromium, file) as opened:
        opened.open()
        opened.rested()
        yield opened


def put_cursor(page: Page, before: str) -> None:
    at = page.text("text").index(before)
    page.run(f"(t => {{ t.focus(); t.setSelectionRange({at}, {at}); }})(document.getElementById('text'))")


@pytest.mark.parametrize("file", ["driven-four-bar"], indirect=True)
def test_freedoms_equations_and_the_torque_of_a_motor(page: Page) -> None:
    assert page.text("freedoms") == "0 degrees of freedom"
    assert page.run("document.getElementById('joint').hidden")
    put_cursor(page, "[joints.motor]")
    page.until("!document.getElementById('joint').hidden")
    page.press("#joint summary")
    page.until("document.querySelectorAll('#joint math').length > 1")
    assert page.text("joint").startswith("motor: driver between ")
    assert "motor.driver" in page.text("joint")
    page.picture("equations")

    assert page.text("torque") == "Plot motor.effort over its coordinate"
    page.press("#torque")
    chosen = "[...document.querySelectorAll('#group, #over')].map((e) => e.selectedOptions[0].textContent)"
    assert page.run(chosen) == ["motor: moment [N m]", "motor.angle"]
    put_cursor(page, "[joints.B]")
    page.until("document.getElementById('joint').textContent.startsWith('B: revolute')")
    assert page.run("document.getElementById('torque').hidden")
    put_cursor(page, "[bodies.crank]")
    page.until("document.getElementById('joint').hidden")
    assert page.said() == []


@pytest.mark.parametrize("file", ["toggle-press"], indirect=True)
def test_modes_in_force_are_those_of_the_time_that_is_shown(page: Page) -> None:
    assert page.text("freedoms") == "1 degree of freedom"
    said = set()
    for share in (0.0, 0.1, 0.2, 0.6):
        page.run(f"window.symgen.frame({share})")
        said.add(page.text("inForce"))
    assert any("guide.lower closed" in line for line in said) and any("guide.lower open" in line for line in said)
    assert any("guide at rest" in line for line in said) and any("guide slides" in line for line in said)
    assert page.said() == []


BRACKETS = ".cm-matchingBracket, .cm-nonmatchingBracket"


@pytest.mark.parametrize("file", ["four-bar"], indirect=True)
def test_brackets_at_the_cursor_have_their_partners(page: Page) -> None:
    marks = (
        f"[...document.querySelectorAll('{BRACKETS}')]"
        ".map((e) => [Math.round(e.getBoundingClientRect().top), e.classList.contains('cm-nonmatchingBracket')])"
    )
    put_cursor(page, "[bodies.crank]")
    page.until(f"document.querySelectorAll('{BRACKETS}').length === 2")
    (first, second) = page.run(marks)
    assert first == second and not first[1]
    text = page.text("text")
    page.type(text.index("[bodies.crank]"), "( # ) \n")
    put_cursor(page, "( # )")
    page.until(f"document.querySelectorAll('{BRACKETS}').length === 1")
    assert page.run(marks)[0][1]  # its partner is in a comment
    put_cursor(page, "name =")
    page.until(f"document.querySelectorAll('{BRACKETS}').length === 0")
    assert page.said() == []


def downloaded(page: Page, folder: Path, kind: str, name: str) -> bytes:
    page.press(f"[data-make={kind}]")
    page.until(f"document.getElementById('status').textContent === 'made {name}'")
    ends = time.monotonic() + PATIENCE
    while not (folder / name).exists():
        assert time.monotonic() < ends
        time.sleep(0.02)
    return (folder / name).read_bytes()


@pytest.mark.parametrize("file", ["four-bar"], indirect=True)
def test_what_commands_make_is_downloaded(page: Page, chromium: Chromium, tmp_path: Path) -> None:
    folder = tmp_path / "made"
    folder.mkdir()
    chromium.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))
    report = downloaded(page, folder, "report", "four-bar-report.html").decode()
    assert "symgen report four-bar.toml" in report
    assert b"symgen" in downloaded(page, folder, "page", "four-bar.html")
    downloaded(page, folder, "fmu", "four-bar.fmu")
    with zipfile.ZipFile(folder / "four-bar.fmu") as archive:
        assert "modelDescription.xml" in archive.namelist()
    ast.parse(downloaded(page, folder, "python", "four-bar.py"))
    page.type(0, "wrong")
    page.press("[data-make=report]")
    page.until("document.getElementById('status').textContent.includes('four-bar.toml')")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["four-bar.toml", "made"]
    assert page.said() == []


def image(width: int, height: int) -> str:
    """Return a grey PNG as an address of data."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    rows = zlib.compress((b"\0" + b"\x90" * width) * height)
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")
    return base64.b64encode(data).decode()


@pytest.mark.parametrize("file", ["four-bar"], indirect=True)
def test_a_photo_lies_behind_the_drawing_in_metres(page: Page) -> None:
    page.run(
        "(() => { const b = Uint8Array.from(atob('" + image(40, 20) + "'), (c) => c.charCodeAt(0));"
        " const d = new DataTransfer(); d.items.add(new File([b], 'sketch.png', { type: 'image/png' }));"
        " const f = document.getElementById('chosen'); f.files = d.files;"
        " f.dispatchEvent(new Event('change')); })()"
    )
    page.until("!document.getElementById('photo').hidden")
    page.run(
        "(() => { const f = document.getElementById('photoPlace'); f.value = '-1, 2, 4';"
        " f.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter' })); })()"
    )
    page.chromium.frame()
    left, top, width = page.run(
        "(({ style }) => [style.left, style.top, style.width].map(parseFloat))(document.getElementById('photo'))"
    )
    (x, y), (right, _) = page.run("window.symgen.editor.place(-1, 4)"), page.run("window.symgen.editor.place(3, 4)")
    assert (left, top, width) == pytest.approx((x, y, right - x), abs=0.5)
    page.picture("photo")
    page.run("[...document.querySelectorAll('.photo button')][0].click()")
    assert page.run("document.getElementById('photo').hidden")
    assert re.match(r"Photo$", page.run("document.querySelector('.photo button').textContent"))
    assert page.said() == []
