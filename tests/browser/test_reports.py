"""Reports in a browser: sketches are bounded in height."""

import re
from pathlib import Path

import pytest

import symgen
from symgen.study.report.document import DocumentTable, Letterhead, ReportDocument, Section
from symgen.study.report.machine_report import machine_report
from symgen.study.report.picture import sketches_section
from symgen.study.report.write import html_report, write
from tests.browser.chromium import Chromium

pytestmark = pytest.mark.browser


def test_a_tall_sketch_is_no_taller_than_a_screen(chromium: Chromium, tmp_path: Path) -> None:
    """One of 160 by 480 was blown up to 1900 pixels; it keeps its proportions, beside a wide one."""
    shapes = {"tall": (160, 480), "wide": (640, 200)}
    sketches = {
        name: f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" width="{w}" height="{h}"></svg>'
        for name, (w, h) in shapes.items()
    }
    path = tmp_path / "report.html"
    path.write_text(
        html_report(ReportDocument("sketches", (), (), "", tuple(sketches_section(sketches)))), encoding="utf-8"
    )
    for width in (1280, 390):
        chromium.open(path, width)
        tall, wide = chromium.run("[...document.querySelectorAll('.pictures img')].map((i) => i.clientHeight)")
        assert 0 < wide < 0.5 * width and 0 < tall <= 480
        assert chromium.run(
            "[...document.querySelectorAll('img')].every((i) => getComputedStyle(i).objectFit === 'contain')"
        )
    assert chromium.said == []


#: The width of A4 between its margins, in pixels of 96 to the inch.
PRINTED = round((210 - 2 * 12) / 25.4 * 96)


def test_no_table_is_wider_than_paper_or_a_telephone(chromium: Chromium, tmp_path: Path) -> None:
    """A table of modes made a browser shrink all pages, and long names hid the last column of the first table."""
    names = tuple((f"spring_on_sleeve{k}, torque", "-2.39 mN m", "at 0.66 s; work of the run 70 µJ") for k in range(3))
    first = DocumentTable("", ("", "largest", "when and where"), names)
    moves = ", ".join(f"upper_wishbone_{k} {90 - k}.5%" for k in range(6))
    row = ("1", "0 +- 2.99128i", "0.476077", "0", moves, moves)
    modes = DocumentTable("Modes", ("mode", "eigenvalue", "frequency", "damping", "moves", "stiffness by"), (row,) * 3)
    sections = Section("At a glance", tables=(first,), beside=True), Section("Frequencies", tables=(modes,))
    path = tmp_path / "report.html"
    path.write_text(html_report(ReportDocument("press", (), (), "", sections)), encoding="utf-8")
    widths = "[...document.querySelectorAll('.scroll')].map((e) => e.scrollWidth - e.clientWidth)"
    chromium.open(path, 390)
    assert chromium.run(widths)[0] == 0
    chromium.call("Emulation.setEmulatedMedia", media="print")
    chromium.open(path, PRINTED)
    assert chromium.run(widths) == [0, 0]
    assert chromium.run("document.documentElement.scrollWidth") <= PRINTED
    chromium.call("Emulation.setEmulatedMedia", media="")


def test_a_report_is_printed(tmp_path):
    model = symgen.load("pendulum")
    path = write(machine_report(model, model.simulate(until=0.5)), tmp_path / "pendulum.pdf")
    assert path.read_bytes().startswith(b"%PDF") and path.stat().st_size > 20_000


@pytest.mark.parametrize(("paper", "points"), [("a4", rb"59\d[.\d]* 841[.\d]*"), ("letter", rb"612 792")])
def test_a_browser_prints_the_size(paper, points, tmp_path):
    document = ReportDocument("press", (), (), "", letterhead=Letterhead(paper=paper))
    data = write(document, tmp_path / "a.pdf").read_bytes()
    assert re.search(rb"/MediaBox \[0 0 " + points + rb"\]", data)


def test_a_wide_table_is_printed_across_with_its_heading(tmp_path):
    table = DocumentTable("Rows", tuple(f"column {k} [m/s]" for k in range(12)), (tuple(["1.23456e-10"] * 12),) * 3)
    sections = Section("Before", ("words",)), Section("All rows", tables=(table,)), Section("After", ("words",))
    document = ReportDocument("press", (), (), "", sections, letterhead=Letterhead(paper="a4"))
    data = write(document, tmp_path / "a.pdf").read_bytes()
    sizes = re.findall(rb"/MediaBox \[0 0 (\d+)[.\d]* (\d+)[.\d]*\]", data)
    assert [int(width) > int(height) for width, height in sizes] == [False, True, False]
