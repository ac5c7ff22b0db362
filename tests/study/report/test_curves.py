"""Curves of reports have the units of the first page and draw nothing twice; paper keeps headings with what follows."""

import re

import numpy as np
import pytest
from analyses.rods import of_raw

from symgen.result.labelled import Labelled
from symgen.study.report import plain_pdf
from symgen.study.report.curves import curve_pictures, curves_of_run
from symgen.study.report.document import DocumentTable, ReportDocument, Section
from symgen.study.report.key_numbers import key_numbers
from symgen.study.report.words import engineering_number, engineering_unit

TIME = Labelled(np.linspace(0.0, 1.0, 5)[:, np.newaxis], ("t",), ("s",))


def lift(mass: float = 300.0, **outputs: object) -> dict[str, object]:
    """Return a mass on a rail that a driver lifts with 0.2 m/s2: it takes `mass` times 10.01 m/s2."""
    rail = {"type": "translational", "between": ["ground", "cage"], "at": [[0.0, 0.0], "centre"], "axis": [0.0, 1.0]}
    return {
        "mechanism": {"name": "lift", "gravity": [0.0, -9.81]},
        "run": {"until": 1.0},
        "parameters": {"load": {"value": mass, "unit": "kg"}},
        "bodies": {"cage": {"mass": "load", "inertia": 1.0, "position": [0.0, 0.0]}},
        "joints": {"rail": rail, "ram": {"type": "driver", "joint": "rail", "value": "0.1*t**2"}},
        "outputs": {"pull": {"value": "ram.effort", "unit": "N", **outputs}},
    }


def labels(picture) -> list[str]:
    """Return the texts of a picture, which are drawn as outlines, with the text beside each as a comment."""
    return re.findall(r"<!-- (.*?) -->", picture.data.decode())


@pytest.mark.parametrize(
    ("unit", "peak", "shown", "largest"),
    [
        *(("N", 8560.0, "kN", 8.56), ("N", 640.0, "N", 640.0), ("N m", 2.4e6, "MN m", 2.4), ("W", 0.02, "mW", 20.0)),
        *(("m", 0.013, "mm", 13.0), ("m", 0.7, "m", 0.7), ("m", 2e3, "m", 2e3), ("J", 4.0, "J", 4.0)),
        *(("rad", np.pi, "deg", 180.0), ("rad/s", 1.0, "deg/s", 180.0 / np.pi), ("kg", 3e4, "kg", 3e4)),
    ],
)
def test_curves_have_the_unit_of_the_largest_number(unit: str, peak: float, shown: str, largest: float) -> None:
    values = np.linspace(-0.3, 1.0, 5)[:, np.newaxis] * peak
    (picture,) = curve_pictures("a", TIME, Labelled(values, ("column",), (unit,)))
    assert f"column [{shown}]" in labels(picture) and picture.caption == "column over t"
    size, name = engineering_unit(unit, peak)
    assert (peak / size, name) == (pytest.approx(largest), shown)
    if unit != "kg":
        assert engineering_number(peak, unit).split(" ", 1)[1] == shown


@pytest.mark.slow
def test_a_load_that_is_also_an_output_is_drawn_once() -> None:
    model = of_raw(lift())
    result = model.simulate(output_step=0.05)
    pictures = [*curves_of_run(result, result.along("t"))]
    forces = [texts for texts in map(labels, pictures) if "force [kN]" in texts]
    assert len(forces) == 1 and "ram.effort, pull" in forces[0]
    first = {number.what: number.value for number in key_numbers(model.mechanism, result)}
    assert first["ram, force"] == "3 kN"
    assert not [text for texts in map(labels, pictures) for text in texts if text.endswith(("[N]", "[rad]"))]


def test_a_heading_on_paper_without_a_browser_stands_with_its_table(monkeypatch: pytest.MonkeyPatch) -> None:
    """Wherever the page ends, the lines from the heading to the first row of its table are on one page."""
    table = DocumentTable("Forces", ("quantity", "largest"), (("first row", "1 kN"), ("second row", "2 kN")))
    pages: list[list[str]] = []

    def written(paper: plain_pdf._Paper) -> bytes:
        pages[:] = [[text.get_text() for text in page.texts] for page in paper._pages]
        return b""

    monkeypatch.setattr(plain_pdf._Paper, "pdf", written)
    for count in range(30, 75):
        before = Section("Before", tuple(["words"] * count))
        loads = Section("Largest loads", ("Largest absolute values.",), tables=(table, table))
        plain_pdf.plain_pdf(ReportDocument("lift", (), (), "", (before, loads)))
        (own,) = [page for page in pages if "Largest loads" in page]
        after = own[own.index("Largest loads") :]
        assert any("Forces" in line for line in after) and any(line.startswith("first row") for line in after), count
