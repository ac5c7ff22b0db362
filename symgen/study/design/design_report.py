"""The report of a design: the machine before and after, side by side, with all limits and outputs."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from symgen.analyses.kinds import AnalysisTable
from symgen.base.errors import fit_lines
from symgen.describe.drawing.drawing import Drawing
from symgen.result.extremes import without_doubles
from symgen.result.labelled import Labelled
from symgen.result.plots import figure_over_column
from symgen.study.design import tables
from symgen.study.machine_class import machine_class, version_list
from symgen.study.report.document import DocumentTable, Picture, ReportDocument, Section, TableCell
from symgen.study.report.letterhead import origin_of_file
from symgen.study.report.picture import MOST_BODIES, picture_of_figure
from symgen.study.report.words import as_sentence, engineering_number

if TYPE_CHECKING:
    from symgen.result.result import Result
    from symgen.study.design.found import Design

#: Rows of the table of all quantities at most.
MOST_ROWS = 60
#: Moods of the states of limits.
_MOODS = {"missed": "bad", "active": "doubtful", "kept": "good"}


def design_report(found: Design, command: str = "") -> ReportDocument:
    """Return the report of a design.

    Parameters
    ----------
    found : Design
        The answer.
    command : str, optional
        The command that makes the report again.
    """
    model = found.first_model
    runs = found.first_result, found.result
    sections = [
        Section("Numbers", tables=(_document_table(tables.table_of_values(found)),)),
        *_limits_section(found),
        Section(
            "Before and after", pictures=(*_pictures(found, runs),), tables=(_quantities(runs),), pictures_first=True
        ),
        _searches_section(found),
    ]
    facts = [
        ("aim", found.aim),
        ("until", f"{found.until:g} s"),
        ("versions", version_list()),
        ("machine", machine_class()),
    ]
    title = f"{model.mechanism.title or model.name}: numbers by an aim"
    lead = f"{as_sentence(tables.sentence_of_aim(found))}"
    origin = origin_of_file(model.mechanism)
    return ReportDocument(
        title, (lead,), tuple(facts), command, tuple(sections), verdict=_verdict(found), origin=origin
    )


def _verdict(found: Design) -> TableCell:
    """Return one sentence on the answer."""
    if not found.ok:
        return TableCell(as_sentence(found.reason or ""), "bad")
    change = f"from {engineering_number(found.before, found.unit)} to {engineering_number(found.after, found.unit)}"
    kept = f" and all {len(found.limits)} limits are kept" if len(found.limits) > 1 else ""
    return TableCell(f"{found.aim} goes {change}{kept}.", "good")


def _document_table(table: AnalysisTable, caption: str = "") -> DocumentTable:
    words = next((i for i, heading in enumerate(table.headings) if heading not in table.left), len(table.headings))
    return DocumentTable(caption, tuple(table.headings), tuple(map(tuple, table.rows)), words)


def _limits_section(found: Design) -> Iterator[Section]:
    if not found.limits:
        return
    table = tables.table_of_limits(found)
    rows = list[tuple[str | TableCell, ...]]()
    for text, before, after, t, state, price in table.rows:
        rows.append((text, before, after, t, TableCell(state, _MOODS[state]), price))
    lead = "A price is what the aim would gain for one more unit of room at an active limit."
    yield Section("Limits", (lead,), tables=(DocumentTable("", tuple(table.headings), tuple(rows)),))


def _pictures(found: Design, runs: tuple[Result, Result]) -> Iterator[Picture]:
    """Yield drawings of both motions, and the quantity of the aim over time."""
    models = found.first_model, found.model
    for word, model, result in zip(("before", "after"), models, runs, strict=True):
        if len(model.mechanism.bodies) <= MOST_BODIES and len(result.t):
            drawn = Drawing.of_motion(model.mechanism, result.q.values, dict(result.parameters))
            caption = f"The motion {word}"
            yield Picture(word, caption, caption, drawn.svg.encode(), "svg", pixels=drawn.png)
    if found.course is not None:
        quantity, along = found.course, Labelled(found.times[:, np.newaxis], ("t",), ("s",))
        title = f"{quantity.names[0].removesuffix(' before')} before and after"
        yield picture_of_figure("aim", title, title, partial(figure_over_column, along, quantity, title))


def _quantities(runs: tuple[Result, Result]) -> DocumentTable:
    """Return the extremes of outputs and loads in both runs, so that nothing gets worse unseen."""
    first, last = (result.whole(("outputs", "elements", "magnitudes")) for result in runs)
    rows, kept = list[tuple[str, ...]](), {first.names[i] for i in without_doubles(first.names)}
    for name, unit in zip(first.names, first.units, strict=True):
        if name in kept and name in last.names:
            pairs = (_range_in_words(table[name], unit) for table in (first, last))
            rows.append((name, *(cell for pair in pairs for cell in pair)))
    shown = fit_lines(len(rows), MOST_ROWS)
    notes = (f"{len(rows) - shown} more are left out.",) if len(rows) > shown else ()
    headings = ("quantity", "before, least", "before, most", "after, least", "after, most")
    return DocumentTable("Outputs and loads", headings, tuple(rows[:shown]), notes=notes)


def _range_in_words(values: np.ndarray, unit: str) -> tuple[str, str]:
    if not len(values) or np.isnan(values).all():
        return "", ""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    return engineering_number(low, unit), engineering_number(high, unit)


def _searches_section(found: Design) -> Section:
    parts = [tables.table_of_starts(found), *([tables.table_of_failures(found)] if found.failed else [])]
    return Section(
        "Searches", tuple(as_sentence(note) for note in found.notes), tables=tuple(map(_document_table, parts))
    )
