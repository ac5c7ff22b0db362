"""A report with its numbers as the chosen locale writes them."""

from __future__ import annotations

from dataclasses import replace

from symgen.base.locales import local_text
from symgen.study.report.document import DocumentTable, Picture, ReportDocument, Section, TableCell

#: Facts that are no numbers of the machine.
_KEPT = ("versions", "machine")


def localise_document(document: ReportDocument) -> ReportDocument:
    """Return a report whose texts, tables and captions have local numbers; the command and versions stay."""
    return replace(
        document,
        lead=_texts(document.lead),
        facts=tuple((label, text if label in _KEPT else local_text(text)) for label, text in document.facts),
        sections=tuple(map(_section, document.sections)),
        verdict=None if document.verdict is None else _styled(document.verdict),
    )


def _texts(texts: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(map(local_text, texts))


def _styled(cell: TableCell) -> TableCell:
    return replace(cell, text=local_text(cell.text))


def _cell(cell: str | TableCell) -> str | TableCell:
    return local_text(cell) if isinstance(cell, str) else _styled(cell)


def _section(section: Section) -> Section:
    return replace(
        section,
        text=_texts(section.text),
        findings=_texts(section.findings),
        tables=tuple(map(_table, section.tables)),
        pictures=tuple(map(_picture, section.pictures)),
        parts=tuple(map(_section, section.parts)),
    )


def _table(table: DocumentTable) -> DocumentTable:
    rows = tuple(tuple(_cell(cell) for cell in row) for row in table.rows)
    caption, headings = local_text(table.caption), _texts(table.headings)
    return replace(table, caption=caption, headings=headings, rows=rows, notes=_texts(table.notes))


def _picture(picture: Picture) -> Picture:
    return replace(picture, caption=local_text(picture.caption), alternative=local_text(picture.alternative))
