"""The report of a stress study: findings, the map, largest steps, regions of stability, and unreliable statuses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from symgen.base.errors import InputError, enumeration, plural
from symgen.run.planning.automatic import AUTO
from symgen.study.machine_class import machine_class, version_list
from symgen.study.references.effort import IMPLICIT_BUDGET, explicit_limits
from symgen.study.report import words
from symgen.study.report.document import DocumentTable, ReportDocument, Section, TableCell
from symgen.study.report.picture import sketches_section
from symgen.study.report.stress_figures import outcome_maps, overview_picture, region_pictures
from symgen.study.stress.beside import beside_yardstick, cells_beside, extremes_beside, families_beside
from symgen.study.stress.cell_outcome import ACCURATE, OUTCOMES
from symgen.study.stress.findings import cause_of_failure, findings_of_study
from symgen.study.stress.stress_rows import LEGEND, Map, Stress, StressRow, outcomes_of_models

_LEAD = (
    "Every cell is one run of a method with an integrator on a case, compared with a motion from another route: a "
    "closed form, or independently derived equations integrated by another scheme at a tight tolerance. The outcome is "
    f"judged by that distance, not by the status of the run. A run is accurate (ok) up to {ACCURATE:g} of the "
    "mechanism's length."
)
#: Reports of more models than this have an overview.
FEW_MODELS = 3
#: Largest number of cells that are listed.
MOST_CELLS = 6000
_MOODS = {"ok": "good", "inaccurate": "doubtful", "refused": "faint", "unjudged": "faint", "too slow": "faint"}
_MEANINGS = {
    "ok": f"the error is at most {ACCURATE:g} of the mechanism's length at all outputs",
    "inaccurate": "the error is larger, but the mechanism is closed or near its motion; or the run stopped itself for "
    "violations although its motion was right",
    "wrong branch": "the error arose near a singular position, and the mechanism moves on, closed, on another branch",
    "singular": "the run ended at a position where the independent constraint rows are almost dependent",
    "diverged": "the run ended early or left the constraints",
    "too slow": f"more than {{:g}} evaluations at constant and {{:g}} at adaptive steps, or {IMPLICIT_BUDGET:g} of "
    "implicit stages, fewer on large mechanisms; predicted or counted",
    "refused": "the pair or the case is refused with a sentence",
    "unjudged": "the reference itself is not known well enough",
}


def stress_report(study: Stress, command: str = "", sketches: Mapping[str, str] | None = None) -> ReportDocument:
    """Return the report of a stress study.

    Parameters
    ----------
    study : Stress
        The study.
    command : str, optional
        The command that makes it again.
    sketches : mapping of str to str, optional
        SVG of mechanisms by their names, for the head of the report.
    """
    lead = ["This study was interrupted: cells are missing.", _LEAD] if study.interrupted else [_LEAD]
    facts = (
        ("Versions", version_list()),
        ("Machine", machine_class()),
        ("Cells", f"{len(study.rows)}, and {words.plural(len(study.limits), 'search', 'searches')} for largest steps"),
        ("Extent", "quick: fewer cases, one integrator a method, shorter searches" if study.quick else "all cases"),
    )
    sections = [
        _map_section(study),
        Section("Findings", findings=findings_of_study(study)),
        *_limits_section(study),
        *([Section("Regions of stability", pictures=planes)] if (planes := region_pictures(study)) else []),
        _trust_section(study),
        *_left_out_section(study),
        *sketches_section(sketches or {}),
        _cells_section(study),
    ]
    title = f"Stiff and extreme cases: {enumeration([Path(model).stem for model in study.models])}"
    return ReportDocument(title, tuple(lead), facts, command, tuple(sections))


def _map_section(study: Stress) -> Section:
    shown = Map.of_study(study)
    rows = tuple(
        (
            *(line[0], line[1]),
            *(_map_cell(shown.entry(line, family).text) for family in shown.families),
            shown.entry(line).text.split(" ")[0],
        )
        for line in shown.lines
    )
    headings = ("method", "integrator", *(family.replace("-", " ") for family in shown.families), "all")
    table = DocumentTable("Accurate cells of those judged.", headings, rows, words=2, notes=(f"{LEGEND}.",))
    outcomes = tuple((name, _MEANINGS[name].format(*explicit_limits(study.quick))) for name in OUTCOMES)
    meanings = DocumentTable("Outcomes.", ("outcome", "meaning"), outcomes, words=2)
    tables: tuple[DocumentTable, ...] = (table, *_beside_table(study), meanings)
    pictures = outcome_maps(study)
    if len(study.models) > FEW_MODELS:
        tables, pictures = (_models_table(study), *tables), (overview_picture(study), *pictures)
    return Section("Map of methods and cases", tables=tables, pictures=pictures, pictures_first=True)


def _beside_table(study: Stress) -> tuple[DocumentTable, ...]:
    """Return the errors of methods beside the yardstick with the same integrator."""
    lines = beside_yardstick(study)
    if len(lines) < 2:
        return ()
    (families, searched), extremes = families_beside(lines), extremes_beside(lines)
    headings = (
        *("methods", "integrator", *(family.replace("-", " ") for family in families)),
        *(f"largest step, {family} [s]" for family in searched),
        *(f"accurate up to, {family}" for family in extremes),
    )
    rows = tuple(
        (
            *(enumeration(x.methods), x.integrator),
            *(c or words.NONE for c in cells_beside(x, families, searched, extremes)),
        )
        for x in lines
    )
    caption = (
        "Beside lagrange with the same integrator: its error over the error of the method, above 1 where the method is "
        "better, medians over the cases that both follow; the largest constant steps that follow the motion; "
        "and the extreme values up to which all runs are accurate, by bisection, of families in which they differ. "
        "Methods with the same numbers are one line."
    )
    return (DocumentTable(caption, headings, rows, words=2),)


def _models_table(study: Stress) -> DocumentTable:
    counted = outcomes_of_models(study.rows)
    rows = tuple(
        ("mechanisms of families" if model == "-" else model, str(sum(n.values())), *(str(n[x]) for x in OUTCOMES))
        for model, n in counted
    )
    return DocumentTable("Outcomes on each model, planes among them.", ("model", "cells", *OUTCOMES), rows)


def _map_cell(text: str) -> str | TableCell:
    share, _, letters = text.partition(" ")
    if not share:
        return words.NONE
    return text if letters else TableCell(text, "good")


def _limits_section(study: Stress) -> list[Section]:
    if not study.limits:
        return []
    rows = tuple(
        (
            *(limit.model, f"{limit.family} {limit.case}", limit.method, limit.integrator),
            *limit.words,
        )
        for limit in study.limits
    )
    text = (
        f"Found by bisection to about {9 if study.quick else 1} percent, with runs that do not watch themselves: the "
        "largest constant step up to which a run stays within a tenth of the mechanism's length of the reference, and "
        f"the largest one up to which its error stays below {ACCURATE:g} of it, of the range of motions that are small "
        "against it; >= marks the whole run in one step. Methods with their own integrator."
    )
    headings = ("model", "case", "method", "integrator", "stable up to [s]", "accurate up to [s]")
    return [Section("Largest steps", (text,), tables=(DocumentTable("", headings, rows, words=4),))]


def _trust_section(study: Stress) -> Section:
    """Return the list of runs that report success although their error is large."""
    wrong = study.false_successes
    own = [row for row in wrong if row.method == AUTO]
    others = [row for row in wrong if row.method != AUTO]
    text = []
    if any(row.method == AUTO for row in study.rows):
        text.append(
            "No run of auto reports success with such an error: it repeats its run with finer steps until two agree, "
            "and is unverified where they do not."
            if not own
            else f"auto does so in {words.plural(len(own), 'cell')}."
        )
    if not others:
        text.append("No run of another method reports success with such an error.")
    headings = ("model", "case", "method", "integrator", "why", "error [m]", "error / length")
    tables = tuple(
        DocumentTable(caption, headings, tuple(map(_trust_row, rows)), words=5)
        for caption, rows in (("auto.", own), ("Methods selected by name.", others))
        if rows
    )
    return Section(f"Success reported with an error above {ACCURATE:g} of the length", tuple(text), tables=tables)


def _trust_row(row: StressRow) -> tuple[str, ...]:
    case = f"{row.family} {row.case}"
    errors = map(words.rounded_number, (row.error, row.relative_error))
    return row.model, case, row.method, row.integrator, cause_of_failure(row), *errors


def _left_out_section(study: Stress) -> list[Section]:
    unusable = ("Cases without a usable reference.", ("model", "family", "case", "why"), study.unusable, 4)
    skipped = ("Families that do not apply.", ("model", "family", "why"), study.skipped, 3)
    headings = ("mechanism", "method", "integrator", "why")
    left_out = ("Pairs left out for the time of their compilation.", headings, study.left_out, 4)
    tables = tuple(DocumentTable(*table) for table in (unusable, skipped, left_out) if table[2])
    return [Section("What is not judged", tables=tables)] if tables else []


def _cells_section(study: Stress) -> Section:
    """Return all cells of the map, a table for each family."""
    if len(study.rows) > MOST_CELLS:
        text = f"{plural(len(study.rows), 'cell')} are too many for a page; --csv and --json write them."
        return Section("All cells", (text,))
    shown = Map.of_study(study)
    headings = (
        *("model", "case", "method", "integrator", "outcome", "own status"),
        *("error [m]", "error / length", "reference ± [m]", "evaluations"),
    )
    parts = []
    for family in shown.families:
        rows = tuple(_cell_row(row) for row in shown.rows if row.family == family)
        parts.append(
            Section(family.replace("-", " ").capitalize(), tables=(DocumentTable("", headings, rows, words=6),))
        )
    return Section("All cells", parts=tuple(parts))


def _cell_row(row: StressRow) -> tuple[str | TableCell, ...]:
    status = f"{row.status}: {words.readable_number(row.reason)}" if row.reason else row.status
    integrator = row.chosen or row.integrator
    return (
        *(row.model, row.case, row.method, integrator, TableCell(row.outcome, _MOODS.get(row.outcome, "bad")), status),
        *map(words.rounded_number, (row.error, row.relative_error, row.reference_error)),
        str(row.evaluations),
    )


def _report_of_one(studies: Sequence[Stress]) -> ReportDocument:
    """Return the report of a stress study, which has no other one beside it."""
    if len(studies) > 1:
        raise InputError("report", "one stress study", f"{len(studies)} of them")
    return stress_report(studies[0])


KIND = _report_of_one
