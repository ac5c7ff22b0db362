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
