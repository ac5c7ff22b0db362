"""The report of one machine: its largest loads are those of the run, and every format says the same."""

import re

import msgspec
import numpy as np
import pytest
from analyses.rods import of_raw

import symgen
from symgen.base.errors import InputError
from symgen.study.report import browser_pdf as paper
from symgen.study.report.document import DocumentTable, Letterhead, ReportDocument, Section
from symgen.study.report.machine_report import machine_report
from symgen.study.report.plain_pdf import plain_pdf
from symgen.study.report.write import html_report, markdown_report, write


@pytest.fixture(scope="module")
def driven():
    model = symgen.load("driven-four-bar")
    return model, model.simulate(until=1.0, output_step=0.01)


def si_number(text: str) -> float:
    """Return the number of a text such as 39.2 kN."""
    number, unit = re.fullmatch(r"([-\d.]+) (.*)", text).groups()
    return float(number) * {"k": 1e3, "M": 1e6, "m": 1e-3, "µ": 1e-6}.get(unit[0], 1.0)


@pytest.mark.slow
def test_the_largest_loads_are_those_of_the_run(driven):
    model, result = driven
    document = machine_report(model, result, "symgen report driven-four-bar", "crank.theta")
    (loads,) = (s for s in document.sections if s.title == "Largest loads")
    rows = {row[0]: row for table in loads.tables for row in table.rows}
    assert {*rows} == {"motor.effort", "motor.power", "A.F", "B.F", "C.F", "D.F"}
    for name, (_, largest, at, place) in rows.items():
        k = int(np.argmax(np.abs(result[name])))
        assert si_number(largest) == pytest.approx(result[name][k], rel=5e-3)
        assert float(at) == pytest.approx(result.t[k], rel=1e-3, abs=1e-12)
        assert float(place) == pytest.approx(np.degrees(result["crank.theta"][k]), rel=1e-3)
    # the motor's power is its torque times the speed of the crank, which is constant
    power, torque = (si_number(rows[f"motor.{name}"][1]) for name in ("power", "effort"))
    assert power == pytest.approx(2 * np.pi * torque, rel=1e-2)


@pytest.mark.slow
def test_a_driver_along_a_slide_has_its_effort_alone():
    block = {"mass": 3.0, "inertia": 0.1, "position": [0.0, 0.0]}
    rail = {
        "type": "translational",
        "between": ["ground", "block"],
        "at": [[0.0, 0.0], "centre"],
        "axis": [1.0, 0.0],
    }
    raw = {
        "mechanism": {"name": "slide", "gravity": [0.0, -9.81]},
        "run": {"until": 1.0},
        "bodies": {"block": block},
        "joints": {"rail": rail, "ram": {"type": "driver", "joint": "rail", "value": "0.1*t**2"}},
    }
    model = of_raw(raw)
    document = machine_report(model, model.simulate(output_step=0.1))
    (loads,) = (s for s in document.sections if s.title == "Largest loads")
    rows = {row[0]: row[1] for table in loads.tables for row in table.rows}
    assert {*rows} == {"ram.effort", "ram.power", "rail.F"}
    assert si_number(rows["ram.effort"]) == pytest.approx(0.6) and si_number(rows["rail.F"]) == pytest.approx(29.4)


@pytest.mark.slow
def test_the_report_has_pictures_and_what_repeats_it(driven):
    model, result = driven
    document = machine_report(model, result, "symgen report driven-four-bar")
    titles = ["At a glance", "Motion", "Largest loads", "Curves"]  # and no frequencies, as no freedom is left
    assert [s.title for s in document.sections] == titles
    curves = [picture.caption for picture in document.sections[-1].pictures]
    assert curves == ["Force over t", "motor.effort over t", "motor.power over t", "Angle over t", "Energy over t"]
    assert len([*document.pictures()]) == 2 + 6 + len(curves)
    page = html_report(document)
    assert "symgen report driven-four-bar" in page and "prefers-color-scheme: dark" in page
    assert "# Planar four-bar" in markdown_report(document, "files")


def test_frequencies_at_rest_are_those_of_modes():
    model = symgen.load("pendulum")
    document = machine_report(model, model.simulate(until=0.2))
    (rest,) = (s for s in document.sections if s.title == "Frequencies at rest")
    (table,) = rest.tables
    frequency = float(table.rows[0][table.headings.index("frequency [Hz]")])
    assert frequency == pytest.approx(float(model.modes().frequencies[0]), rel=1e-5)


@pytest.fixture
def no_browser(monkeypatch):
    monkeypatch.delenv("SYMGEN_BROWSER", raising=False)
    monkeypatch.setattr(paper.shutil, "which", lambda name: None)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.usefixtures("no_browser")
def test_a_pdf_is_drawn_where_no_browser_is(driven, tmp_path):
    """Every picture of the report is in it as pixels, on pages of A4."""
    document = machine_report(*driven)
    data = write(document, tmp_path / "a.pdf").read_bytes()
    assert data.startswith(b"%PDF") and len(re.findall(rb"/Type /Page\b", data)) == 3
    assert re.search(rb"/MediaBox \[ 0 0 595\.4\d* 841\.6\d* \]", data)
    drawn = len(re.findall(rb"/Subtype /Image\b", data)) - len(re.findall(rb"/SMask ", data))
    assert drawn == len(document.pictures())


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.usefixtures("no_browser")
def test_long_words_and_wide_tables_stay_on_the_paper(tmp_path):
    wide = DocumentTable("a table", tuple(f"column {i}" for i in range(40)), (("x" * 30,) * 40,) * 200)
    hostile = Section("$\\frac{$ & <b>", ("word " * 3000, "y" * 900), ("finding",), (wide,), parts=(Section("part"),))
    pages = len(re.findall(rb"/Type /Page\b", plain_pdf(ReportDocument("t", (), (), "c" * 700, (hostile,)))))
    assert pages > 3


@pytest.mark.slow
@pytest.mark.usefixtures("no_browser")
def test_the_command_names_what_made_a_pdf(cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, _ = cli("report", "pendulum", "--until", "0.2", "-o", "a.pdf")
    assert code == 0 and out.startswith("written: a.pdf, drawn by matplotlib, as there is no Chromium")


@pytest.mark.slow
def test_a_browser_that_prints_nothing_is_named(driven, tmp_path, monkeypatch):
    silent = tmp_path / "browser"
    silent.write_text("#!/bin/sh\nexit 3\n")
    silent.chmod(0o755)
    monkeypatch.setenv("SYMGEN_BROWSER", str(silent))
    with pytest.raises(InputError, match=r"which ended with 3"):
        write(machine_report(*driven), tmp_path / "a.pdf")
    assert not (tmp_path / "a.pdf").exists()


@pytest.mark.slow
def test_the_command_writes_its_file(cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = cli("report", "driven-four-bar", "--until", "0.2", "--over", "crank.theta")
    assert code == 0 and err == "" and out.strip() == "written: driven-four-bar.html"
    page = (tmp_path / "driven-four-bar.html").read_text(encoding="utf-8")
    assert re.search(r"symgen report driven-four-bar --until 0.2 --over crank.theta", page)
    assert "Play the motion" not in page
    code, _, err = cli("report", "driven-four-bar", "-o", "a.doc")
    assert code == 2 and "--output: expected a file ending in .html, .md, .pdf, .tex, got 'a.doc'" in err


def test_a_report_links_to_the_page_beside_it(cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, _ = cli("report", "pendulum", "--until", "0.1", "-o", "a.md", "--page", "a motion.html")
    assert code == 0 and out.split("\n")[:2] == ["written: a.md", "written: a motion.html"]
    assert "[Play the motion](a%20motion.html)" in (tmp_path / "a.md").read_text(encoding="utf-8")
    assert "<canvas" in (tmp_path / "a motion.html").read_text(encoding="utf-8")
    for page in ("a.html", "a.png", "other/b.html"):
        code, out, err = cli("report", "pendulum", "-o", "a.html", "--page", page)
        assert code == 2 and out == "" and err.startswith("symgen: --page: expected ") and page in err


@pytest.mark.slow
def test_number_author_revision_and_day_are_below_the_title(driven):
    model, result = driven
    mechanism = msgspec.structs.replace(model.mechanism, author="A. Builder", revision="C")
    document = machine_report(symgen.Model(mechanism), result, letterhead=Letterhead("R-104"))
    origin = dict(document.origin)
    assert (origin["report"], origin["author"], origin["revision"]) == ("R-104", "A. Builder", "C")
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", origin["date"])
    assert {*dict(machine_report(model, result).origin)} == {"date"}
    for text in (html_report(document), markdown_report(document, "files")):
        assert re.search(r"report R-104.*revision C.*author A\. Builder.*date \d{4}", text)
