"""The report of a comparison: error against run time, violations, energies and costs, model by model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symgen.base.errors import enumeration
from symgen.describe.bounds.keys import nouns_of_families
from symgen.describe.bounds.smooth import WITH_LAWS
from symgen.study.comparison.across import across_mechanisms
from symgen.study.comparison.comparison_rows import Row
from symgen.study.comparison.comparison_study import BEYOND, FRONT, LOADED, ONE_RUN, Study
from symgen.study.machine_class import machine_class, version_list
from symgen.study.report import words
from symgen.study.report.comparison_findings import (
    costs_of_methods,
    findings_of_rows,
    methods_of_study,
    representative_rows,
    settings_text,
)
from symgen.study.report.definitions import measured_section
from symgen.study.report.document import DocumentTable, ReportDocument, Section, TableCell
from symgen.study.report.figures import pictures_of_study
from symgen.study.report.picture import sketches_section
from symgen.study.report.source import section_beside_source
from symgen.study.yardstick import YARDSTICK

#: Findings beside the front, on the first screen.
FIRST = 3
_MOODS = {"ok": "good", "unverified": "doubtful", "failed": "bad"}
BELOW = "* below the error of the reference itself"


def comparison_report(
    studies: Sequence[Study],
    command: str = "",
    settings: Sequence[tuple[str, str]] = (),
    sketches: Mapping[str, str] | None = None,
) -> ReportDocument:
    """Return the report of studies.

    Parameters
    ----------
    studies : sequence of Study
        One for each mechanism.
    command : str, optional
        The command that makes it again.
    settings : sequence of (str, str), optional
        Settings by label, in addition to those of the studies.
    sketches : mapping of str to str, optional
        SVG of mechanisms by their names, for the head of the report.
    """
    names = [study.mechanism for study in studies]
    lead = ["This study was interrupted: rows are missing."] if any(study.interrupted for study in studies) else []
    facts = [
        ("Versions", version_list()),
        ("Machine", machine_class()),
        *_settings_section(studies),
        *settings,
        *((f"Digest of {study.mechanism}", study.digest) for study in studies if study.digest),
    ]
    sections = [
        *([_section_across_mechanisms(studies)] if len(studies) > 1 else []),
        *(_section_of_study(study) for study in studies),
    ]
    sections += [*sketches_section(sketches or {}), measured_section(studies)]
    source = section_beside_source(list(studies))
    if source is not None:
        sections.append(source)
    title = f"Error against run time: {enumeration(names)}"
    return ReportDocument(title, tuple(lead), tuple(facts), command, tuple(sections))


def _settings_section(studies: Sequence[Study]) -> list[tuple[str, str]]:
    facts = [("Durations", ", ".join(f"{study.mechanism} {study.until:g} s" for study in studies))]
    repeat = max(study.repeat for study in studies)
    text = f"at least {words.plural(repeat, 'round')} a row after a warm-up" if repeat > 1 else "one round a row"
    facts.append(("Timing", f"processor time, a row and its yardstick in turn, {text}; compilation is no part of it"))
    first = studies[0]
    for label, changed in (("Parameters", first.parameters), ("Start", first.start), ("Options", first.options)):
        if changed:
            facts.append((f"{label} changed", ", ".join(f"{name} = {value}" for name, value in changed.items())))
    return facts


# -- across mechanisms -------------------------------------------------------------------------------------------------


def _section_across_mechanisms(studies: Sequence[Study]) -> Section:
    """Return the section that compares the mechanisms."""
    every = list(dict.fromkeys(method for study in studies for method in methods_of_study(study)))
    by_study = [{row.label: row for row, _ in representative_rows(study)} for study in studies]
    names = tuple(study.mechanism for study in studies)
    errors = tuple((method, *(_error_cell(rows.get(method)) for rows in by_study)) for method in every)
    ratios = tuple(
        (
            method,
            *(words.ratio_in_words(rows[method].cost_ratio) if method in rows else words.NONE for rows in by_study),
        )
        for method in every
        if method != YARDSTICK
    )
    text = "; ".join(f"{study.mechanism}, {study.until:g} s: {settings_text(study)}" for study in studies)
    tables = [DocumentTable("Error [m].", ("method", *names), errors)]
    if any(x != words.NONE for row in ratios for x in row[1:]):
        tables.append(DocumentTable(f"Run time as a multiple of that of {YARDSTICK}.", ("method", *names), ratios))
    tables += _table_across_mechanisms(studies)
    return Section("Side by side", (f"One row a method: {text}.",), tables=tuple(tables))


def _table_across_mechanisms(studies: Sequence[Study]) -> list[DocumentTable]:
    """Return the statistic of methods over all mechanisms."""
    rows = tuple(
        (
            *(x.method, x.integrator, str(x.mechanisms)),
            *(words.ratio_in_words(x.error), words.range_in_words(x.error_low, x.error_high)),
            *(words.ratio_in_words(x.error_mean), words.ratio_in_words(x.time)),
            *(words.range_in_words(x.time_low, x.time_high), words.ratio_in_words(x.time_mean)),
        )
        for x in across_mechanisms(studies)
    )
    if not rows:
        return []
    headings = (
        *("method", "integrator", "mechanisms", f"error of {YARDSTICK} / error", "95 %", "mean", f"× {YARDSTICK}"),
        *("95 %", "mean"),
    )
    caption = (
        f"Over all mechanisms: error of {YARDSTICK} over the error of the method at equal constant steps, above 1 "
        "where the method is better, and run time as a multiple at equal settings; medians with intervals of 95 %, "
        "and geometric means."
    )
    return [DocumentTable(caption, headings, rows, words=2)]


def _error_cell(row: Row | None) -> str | TableCell:
    if row is None:
        return words.NONE
    if row.error is None:
        return TableCell(row.status_text, _MOODS[row.status])
    text = _error_text(row)
    return TableCell(f"{text} ({row.status_text})", _MOODS[row.status]) if row.status != "ok" else text


# -- one mechanism -----------------------------------------------------------------------------------------------------


def _section_of_study(study: Study) -> Section:
    title = (study.title.strip().rstrip("."),) if study.title else ()
    text = tuple(words.as_sentence(t) for t in title)
    if not study.rows:
        return Section(study.mechanism, (*text, "No row was done before the interruption."))
    findings, shown = findings_of_rows(study), pictures_of_study(study)
    tables = (*_contact_table(study), *_gradient_table(study), *_equal_error_table(study), *_cost_table(study))
    parts = (
        Section(f"More on {study.mechanism}", (), findings[FIRST:], tables, shown[1:]),
        Section(f"All rows of {study.mechanism}", tables=(_table_of_all_rows(study), _violations_table(study))),
    )
    return Section(
        study.mechanism, text, findings[:FIRST], (_summary_table(study),), shown[:1], parts, pictures_first=True
    )


def _summary_table(study: Study) -> DocumentTable:
    headings = (
        *("method", "status", "error [m]", "run time", f"× {YARDSTICK}", "max |Φ|", "max |D v − ν|"),
        *("max |D v' − γ|", "energy error [J]"),
    )
    rows = []
    for row, _ in representative_rows(study):
        rows.append(
            (
                row.label,
                TableCell(row.status_text, _MOODS[row.status]),
                _error_text(row),
                _time_text(row),
                words.value_with_spread(row.cost_ratio, row.cost_ratio_spread or None),
                words.rounded_number(row.position_violation_max),
                words.rounded_number(row.velocity_violation_max),
                words.rounded_number(row.acceleration_violation_max),
                words.rounded_number(row.energy_drift_max),
            )
        )
    notes = _meanings_of_marks([row for row, _ in representative_rows(study)])
    return DocumentTable(
        f"One row a method over {study.until:g} s: {settings_text(study)}; coordinates of bodies unless a row says "
        "joint.",
        headings,
        tuple(rows),
        words=2,
        notes=notes,
    )


def _meanings_of_marks(rows: Sequence[Row]) -> tuple[str, ...]:
    """Return the meanings of the marks in some rows."""
    marks = (
        (BELOW, any(row.below_reference for row in rows)),
        (BEYOND, any(row.beyond_limits for row in rows)),
        (LOADED, any(row.disturbed for row in rows)),
    )
    return tuple(text for text, used in marks if used)


def _error_text(row: Row, on_front: bool = False) -> str:
    return words.rounded_number(row.error) + " *" * row.below_reference + " ^" * on_front


def _time_text(row: Row) -> str:
    return words.seconds_in_words(row.run_seconds) + row.time_mark


def _equal_error_table(study: Study) -> tuple[DocumentTable, ...]:
    if not study.at:
        return ()
    rows = tuple(
        (
            *(words.chosen_number(x.error), x.method, x.integrator, words.seconds_in_words(x.seconds)),
            *map(words.ratio_in_words, (x.ratio, x.ratio_low, x.ratio_high)),
        )
        for x in study.at
    )
    first = study.rows[0].label
    headings = "error [m]", "method", "integrator", "CPU time", f"× {first}", "lower quartile", "upper quartile"
    caption = (
        f"CPU time at an error, interpolated between settings, and as a multiple of that of {first} with the same "
        "integrator: medians and quartiles of rounds in which all runs are timed in turn."
    )
    notes = tuple(
        f"{words.chosen_number(x.error)} m, {x.method}, {x.integrator}: {x.reason}" for x in study.at if x.reason
    )
    return (DocumentTable(caption, headings, rows, words=3, notes=notes),)


def _contact_table(study: Study) -> tuple[DocumentTable, ...]:
    if not any(row.law for row in study.rows):
        return ()
    headings = (
        *("method", "integrator", "setting", "error [m]", "run time", "creep [m/s]", "transitions", "impacts"),
        "energy lost [J]",
    )
    rows = tuple(
        (
            *(row.label, row.integrator, words.setting_in_words(row.step, row.rtol), _error_text(row)),
            *(words.seconds_in_words(row.run_seconds), words.rounded_number(row.creep)),
            *(words.NONE if x is None else str(x) for x in (row.transitions, row.impacts)),
            words.rounded_number(row.dissipated),
        )
        for row in study.rows
    )
    caption = (
        f"{words.as_sentence(nouns_of_families())} Creep is the largest rate of a coordinate with "
        f"{WITH_LAWS} at outputs at which it "
        "rests in the reference, of an angle times the length of the mechanism."
    )
    return (DocumentTable(caption, headings, rows, words=3),)


def _gradient_table(study: Study) -> tuple[DocumentTable, ...]:
    if not any(row.differences_seconds is not None for row in study.rows):
        return ()
    rows = tuple(
        (
            *(row.label, row.integrator, words.setting_in_words(row.step, row.rtol), _error_text(row)),
            words.seconds_in_words(row.run_seconds),
            *(words.rounded_number(row.gradient_error), words.seconds_in_words(row.gradient_seconds)),
            *(words.rounded_number(row.adjoint_error), words.seconds_in_words(row.adjoint_seconds)),
            *(words.rounded_number(row.differences_error), words.seconds_in_words(row.differences_seconds)),
        )
        for row in study.rows
    )
    ways = (f"{way}, {what}" for way in ("forward", "adjoint", "differences") for what in ("error", "time"))
    headings = "method", "integrator", "setting", "error [m]", "run time", *ways
    caption = (
        "Derivatives by parameters against differences of references: largest error over the largest derivative. "
        "Forward: of all coordinates at all outputs. Adjoint: of the coordinate at the end that changes most. "
        "Differences of two runs a parameter, with the step of least error among 1e-1 to 1e-9 of it; the time of the "
        "search is left out."
    )
    return (DocumentTable(caption, headings, rows, words=3),)


def _cost_table(study: Study) -> tuple[DocumentTable, ...]:
    rows = tuple(
        (method, words.ratio_in_words(middle), words.ratio_in_words(low), words.ratio_in_words(high), str(count))
        for method, middle, low, high, count in costs_of_methods(study)
    )
    if not rows:
        return ()
    headings = ("method", "median", "smallest", "largest", "pairs")
    caption = (
        f"Run time as a multiple of that of {YARDSTICK} with the same integrator and step or tolerance, over the "
        "settings of the study."
    )
    return (DocumentTable(caption, headings, rows),)


def _table_of_all_rows(study: Study) -> DocumentTable:
    headings = (
        *("method", "integrator", "setting", "status", "error [m]", "run time", "quartiles", f"× {YARDSTICK}"),
        *("error / length", "velocity error [m/s]", "reaction error [N]", "evaluations", "iterations"),
        "energy error [J]",
    )
    rows = list[tuple[str | TableCell, ...]]()
    for i, row in enumerate(study.rows):
        quartiles = row.run_seconds_low, row.run_seconds_high
        both = words.value_with_spread(row.cost_ratio, row.cost_ratio_spread or None)
        rows.append(
            (
                *(row.label, row.integrator, words.setting_in_words(row.step, row.rtol)),
                TableCell(row.status_text, _MOODS[row.status]),
                *(
                    _error_text(row, i in study.front),
                    _time_text(row),
                    " – ".join(map(words.seconds_in_words, quartiles)) if None not in quartiles else words.NONE,
                    both,
                ),
                *map(words.rounded_number, (row.relative_error, row.velocity_error, row.reaction_error)),
                *(str(row.evaluations), str(row.iterations), words.rounded_number(row.energy_drift_max)),
            )
        )
    notes = [*_meanings_of_marks(study.rows), *([FRONT] if len(study.rows) > 1 else [])]
    notes += [] if study.is_repeated else [ONE_RUN]
    for row in study.rows:
        notes += [f"{_name_of_row(row)}: {row.status}: {words.readable_number(row.reason)}"] if row.reason else []
    notes += _warnings_table(study)
    return DocumentTable("Error, run time and counts.", headings, tuple(rows), words=4, notes=tuple(notes))


def _name_of_row(row: Row) -> str:
    return f"{row.label}, {row.integrator}, {words.setting_in_words(row.step, row.rtol)}"


def _warnings_table(study: Study) -> list[str]:
    """Return the warnings of rows, each sentence once with its first row."""
    common = study.common_warnings
    by_text: dict[str, list[Row]] = {}
    for row in study.rows:
        for text in row.warnings:
            by_text.setdefault(text, []).append(row)
    notes = []
    for text, rows in by_text.items():
        more = f" and {words.plural(len(rows) - 1, 'other run')}" if len(rows) > 1 else ""
        where = "every run" if text in common else _name_of_row(rows[0]) + more
        notes.append(f"{where}: {words.readable_number(text)}")
    return notes


def _violations_table(study: Study) -> DocumentTable:
    levels = (("|Φ|", "position"), ("|D v − ν|", "velocity"), ("|D v' − γ|", "acceleration"))
    kinds = (("max", "max"), ("r.m.s.", "rms"), ("final", "final"))
    headings = (
        *("method", "integrator", "setting", "|Φ| / length"),
        *(f"{sign} {kind}" for sign, _ in levels for kind, _ in kinds),
    )
    rows = []
    for row in study.rows:
        values = [
            words.rounded_number(getattr(row, f"{level}_violation_{kind}")) for _, level in levels for _, kind in kinds
        ]
        scaled = words.rounded_number(row.relative_violation)
        rows.append((row.label, row.integrator, words.setting_in_words(row.step, row.rtol), scaled, *values))
    return DocumentTable("Violations at position, velocity and acceleration level.", headings, tuple(rows), words=3)


KIND = comparison_report
