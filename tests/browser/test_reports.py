"""Reports in a browser: sketches are bounded in height."""

import base64
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


#: A platform on two parallel arms, which a driver lifts.
LIFT = """\
[mechanism]
name = "platform"
title = "Platform on two arms"
gravity = [0.0, -9.81]

[run]
until = 3.0

[parameters]
arm = { value = 600, unit = "mm" }
load = { value = 1500, unit = "N" }
lift = { value = 60, unit = "deg" }

[bodies.low]
mass = 8.0
inertia = 0.24
centre_of_mass = ["arm/2", 0.0]
points = { A = [0.0, 0.0], B = ["arm", 0.0] }
angle = "-20 deg"

[bodies.high]
mass = 8.0
inertia = 0.24
centre_of_mass = ["arm/2", 0.0]
points = { A = [0.0, 0.0], B = ["arm", 0.0] }
position = [0.0, 0.25]
angle = "-20 deg"

[bodies.table]
mass = 25.0
inertia = 2.0
centre_of_mass = [0.4, 0.0]
points = { L = [0.0, 0.0], U = [0.0, 0.25], tip = [0.9, 0.0] }
position = ["arm*cos(pi/9)", "-arm*sin(pi/9)"]

[joints.a]
type = "revolute"
between = ["ground", "low"]
at = [[0.0, 0.0], "A"]

[joints.b]
type = "revolute"
between = ["ground", "high"]
at = [[0.0, 0.25], "A"]

[joints.c]
type = "revolute"
between = ["low", "table"]
at = ["B", "L"]

[joints.d]
type = "revolute"
between = ["high", "table"]
at = ["B", "U"]

[joints.turn]
type = "driver"
joint = "a"
value = "-pi/9 + lift*(1 - cos(pi*t/3))/2"

[forces.cargo]
type = "force"
body = "table"
at = [0.5, 0.0]
force = [0.0, "-load"]

[outputs]
torque = { value = "turn.effort", unit = "N m", largest = 2000 }
height = { value = "1000*table.tip.y", unit = "mm" }
"""
FURTHER = "\n".join(
    f'{body}_{kind}{k} = "{body}.{kind} + {k}*{body}.x"'
    for body in ("low", "high", "table")
    for kind in ("vx", "vy", "ay", "omega")
    for k in range(4)
)
#: Machines as text and what is changed, the most pages, and words of the first page.
PRINTED_MACHINES = {
    "good": (LIFT, {}, 2, "keeps 1 limit"),
    "at a dead point": (LIFT, {"lift": 2.4}, 2, "singular position"),
    "jammed": (LIFT, {"lift": 1.9198621771937625}, 3, ""),
    "overloaded": (LIFT, {"load": 6000.0}, 2, "1 of 1 limit is exceeded"),
    "with contacts": ("woodpecker", {}, 3, "The run reaches 2 s"),
    "with fifty quantities": (LIFT + FURTHER, {}, 4, "keeps 1 limit"),
}
#: Headings that stand at the foot of a page with nothing below them, by the layout on paper: none may.
BLOCKS = """
  [...document.querySelectorAll('h2, h3')].filter((h) => {
    const next = h.nextElementSibling;
    return next && getComputedStyle(h).breakAfter !== 'avoid';
  }).length
"""


@pytest.mark.parametrize("name", PRINTED_MACHINES)
def test_a_report_on_paper_and_on_a_telephone(name: str, chromium: Chromium, tmp_path: Path) -> None:
    """Few pages, the last one not nearly empty, nothing wider than paper or telephone, units of the first page."""
    text, changed, most, words = PRINTED_MACHINES[name]
    file = tmp_path / "machine.toml"
    file.write_text(text)
    model = symgen.load(file if "\n" in text else text)
    document = machine_report(model, model.simulate(parameters=changed))
    page = write(document, tmp_path / "machine.html")
    assert words in page.read_text(encoding="utf-8")
    for width, media in ((1280, ""), (390, ""), (PRINTED, "print")):
        chromium.call("Emulation.setEmulatedMedia", media=media)
        chromium.open(page, width)
        assert chromium.run("document.documentElement.scrollWidth") <= width
        if media:
            assert chromium.run(BLOCKS) == 0
            printed = chromium.call("Page.printToPDF", preferCSSPageSize=True, paperWidth=8.27, paperHeight=11.69)
    chromium.call("Emulation.setEmulatedMedia", media="")
    data = base64.b64decode(printed["data"])
    assert len(re.findall(rb"/Type\s*/Page\b(?!s)", data)) <= most
    if "\n" in text and name != "jammed":  # newtons and radians of the file are kN and degrees on all pages
        shown = page.read_text(encoding="utf-8")
        assert " kN</td>" in shown and " deg</td>" in shown and not re.search(r"[0-9] rad\b|\[rad\]", shown)
    assert chromium.said == []
