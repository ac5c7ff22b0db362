"""PDF of a document where no browser prints it: text, tables and pictures on pages that matplotlib draws."""

from __future__ import annotations

import io
import textwrap
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from symgen.base.files import need_library
from symgen.study.report.document import DocumentTable, Picture, ReportDocument, Section, TableCell
from symgen.study.report.letterhead import PAPERS, signing_section

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Margins of a page, and the height of a mark [inch].
MARGIN, MARK = 0.75, 0.6
#: Points of an inch, and widths of letters over their size: of text on average, of a typewriter's all alike.
_POINTS, _LETTER, _TYPED = 72.0, 0.53, 0.603
#: Type of headings by level, of text, and the largest and the smallest type of tables [points].
_HEADINGS, _TEXT, _LARGE, _TINY = (16.0, 12.5, 10.5), 9.0, 8.0, 3.5
#: Distance of lines over their type, of pictures beside each other, and of paragraphs [inch].
_LINE, _GAP, _SPACE = 1.35, 0.2, 0.06
#: Height of a line of a caption [inch].
_CAPTION = _LARGE * _LINE / _POINTS
#: Pictures of a strip beside each other, and others; room that has to be below a heading of text or tables [inch].
_STRIP, _PAIR, _NEXT = 4, 2, 1.0
#: The fact that this page is no print.
_DRAWN = ("paper", "drawn by matplotlib, as there was no browser that prints")


def plain_pdf(document: ReportDocument) -> bytes:
    """Return a document as a PDF file."""
    need_library("report", "matplotlib", extra="plot")
    paper = _Paper(PAPERS[document.letterhead.paper])
    paper.write_paragraph(document.title, _HEADINGS[0], bold=True)
    paper.draw_mark(document.letterhead.logo)
    if document.verdict is not None:
        paper.write_paragraph(document.verdict.text, bold=True)
    if document.origin:
        paper.write_paragraph(" · ".join(f"{label} {text}" for label, text in document.origin))
    for text in document.lead:
        paper.write_paragraph(text)
    for section in document.sections:
        _write_section(paper, section, 1)
    paper.leave_space(0.15)
    paper.write_paragraph("Settings and versions", _HEADINGS[1], bold=True, together=1.0)
    paper.write_table(DocumentTable("", ("made with", ""), (*document.facts, _DRAWN), words=2))
    if document.command:
        paper.write_paragraph("Reproduce with")
        paper.write_typed_lines([document.command])
    for section in signing_section(document):
        _write_section(paper, section, 1)
    return paper.pdf()


def _write_section(paper: _Paper, section: Section, level: int) -> None:
    if section.sheet:
        paper.begin_page()
    paper.leave_space(0.15)
    across = _STRIP if section.strip else _PAIR
    pictures_next = section.pictures_first or not (section.text or section.findings or section.tables)
    below = paper.height_of_first(section.pictures, across) if pictures_next else 0.0
    if section.tables:
        below = sum(map(paper.height_of_paragraph, section.text)) + _NEXT
    size = _HEADINGS[min(level, len(_HEADINGS) - 1)]
    paper.write_paragraph(section.title, size, bold=True, together=max(_NEXT, below))
    if section.pictures_first:
        paper.draw_pictures(section.pictures, across)
    for text in section.text:
        paper.write_paragraph(text)
    for text in section.findings:
        paper.write_paragraph(f"\N{EN DASH} {text}")
    for table in section.tables:
        paper.write_table(_with_room(table) if section.sheet else table)
    if not section.pictures_first:
        paper.draw_pictures(section.pictures, across)
    for part in section.parts:
        _write_section(paper, part, level + 1)


def _with_room(table: DocumentTable) -> DocumentTable:
    """Return a table with room for a hand: two empty rows and a line after each row."""
    line = tuple("_" * 24 if i else "" for i in range(len(table.headings)))
    return replace(table, rows=tuple(x for row in table.rows for x in (("",) * len(row), row, line)))


class _Paper:
    """Pages that are filled from the top; places are inches below it."""

    def __init__(self, size: tuple[float, float]) -> None:
        self._size, self._width, self._height = size, size[0] - 2 * MARGIN, size[1] - 2 * MARGIN
        self._pages: list[Figure] = []
        self._below = self._height  # the first line begins a page

    def pdf(self) -> bytes:
        """Return the file."""
        from matplotlib.backends.backend_pdf import PdfPages

        stream = io.BytesIO()
        with PdfPages(stream, metadata={"CreationDate": None}) as file:
            for page in self._pages:
                file.savefig(page)
        return stream.getvalue()

    def leave_space(self, height: float) -> None:
        """Leave room, but not at the head of a page."""
        self._below = min(self._height, self._below + height)

    def draw_mark(self, mark: Picture | None) -> None:
        """Draw a mark at the top right of the page that is written; one that is SVG is left out."""
        from matplotlib.image import imread

        data = None if mark is None else _png_of_picture(mark)
        if data is None:
            return
        array = imread(io.BytesIO(data), format="png")
        wide = min(MARK * array.shape[1] / array.shape[0], 0.3 * self._width)
        left, bottom = self._size[0] - MARGIN - wide, self._size[1] - MARGIN - MARK
        place = (left / self._size[0], bottom / self._size[1], wide / self._size[0], MARK / self._size[1])
        ax = self._pages[-1].add_axes(place)
        ax.imshow(array, interpolation="none")
        ax.set_axis_off()

    def begin_page(self) -> None:
        """Leave the rest of a page empty."""
        self._below = self._height

    def write_paragraph(self, text: str, size: float = _TEXT, bold: bool = False, together: float = 0.0) -> None:
        """Write a paragraph; `together`: what has to follow it on its page [inch]."""
        self._write_lines(self._wrapped(text, size), size, {"fontweight": "bold" if bold else "normal"}, together)
        self.leave_space(_SPACE)

    def height_of_paragraph(self, text: str) -> float:
        """Return the height of a paragraph with the space below it [inch]."""
        return len(self._wrapped(text, _TEXT)) * _TEXT * _LINE / _POINTS + _SPACE

    def _wrapped(self, text: str, size: float) -> list[str]:
        return textwrap.wrap(text, int(self._width * _POINTS / (_LETTER * size))) or [""]

    def write_typed_lines(self, lines: Sequence[str]) -> None:
        """Write lines in letters of one width, as large as they fit."""
        longest = max(map(len, lines), default=1)
        size = min(_LARGE, self._width * _POINTS / (_TYPED * max(1, longest)))
        if size < _TINY:
            size = _TINY
            lines = [
                part for line in lines for part in textwrap.wrap(line, int(self._width * _POINTS / (_TYPED * size)))
            ]
        self._write_lines(lines, size, {"family": "DejaVu Sans Mono"})
        self.leave_space(0.1)

    def write_table(self, table: DocumentTable) -> None:
        """Write a table."""
        if table.caption:
            self.write_paragraph(table.caption, together=0.5)
        cells = [table.headings, *(tuple(c.text if isinstance(c, TableCell) else c for c in r) for r in table.rows)]
        wide = [max(map(len, column)) for column in zip(*cells, strict=True)]
        lines = [
            "  ".join(
                cell.ljust(w) if i < table.words else cell.rjust(w)
                for i, (cell, w) in enumerate(zip(row, wide, strict=True))
            ).rstrip()
            for row in cells
        ]
        self.write_typed_lines([lines[0], "-" * max(map(len, lines)), *lines[1:]])
        for note in table.notes:
            self.write_paragraph(note, _LARGE)

    def draw_pictures(self, pictures: Sequence[Picture], across: int) -> None:
        """Draw pictures, so many beside each other where they are narrow."""
        for row in _rows_of_pictures(pictures, across):
            self._draw_row(row, across)

    def height_of_first(self, pictures: Sequence[Picture], across: int) -> float:
        """Return the height of the first row of pictures with its captions [inch]; 0 where there is none."""
        first = next(iter(_rows_of_pictures(pictures, across)), [])
        return max((high for *_, high in self._sizes(first, across)), default=-3 * _CAPTION) + 3 * _CAPTION

    def _sizes(self, row: Sequence[Picture], across: int) -> list[tuple[Any, float, float]]:
        """Return pixels, width and height of the pictures of a row [inch]; no pixels where there is no PNG."""
        from matplotlib.image import imread

        width = self._width_of_picture(row[0], across) if row else 0.0
        tallest, found = self._height - 3 * _CAPTION, []
        for data in map(_png_of_picture, row):
            array: Any = None if data is None else imread(io.BytesIO(data), format="png")
            height = 0.0 if array is None else width * array.shape[0] / array.shape[1]
            found.append((array, width if height <= tallest else width * tallest / height, min(height, tallest)))
        return found

    def _width_of_picture(self, picture: Picture, across: int) -> float:
        return self._width if picture.wide else (self._width - (across - 1) * _GAP) / across

    def _draw_row(self, row: Sequence[Picture], across: int) -> None:
        width, sizes = self._width_of_picture(row[0], across), self._sizes(row, across)
        whole = max(high for *_, high in sizes)
        self._begin_page_unless_room(whole + 3 * _CAPTION)
        page = self._pages[-1]
        for i, (picture, (array, wide, high)) in enumerate(zip(row, sizes, strict=True)):
            left = MARGIN + i * (width + _GAP)
            if array is not None:
                bottom = self._size[1] - MARGIN - self._below - high
                ax = page.add_axes(
                    (left / self._size[0], bottom / self._size[1], wide / self._size[0], high / self._size[1])
                )
                ax.imshow(array, aspect="auto", interpolation="none")
                ax.set_axis_off()
            words = picture.caption if array is not None else f"{picture.caption}: as a picture in .html"
            lines = textwrap.wrap(words, int(width * _POINTS / (_LETTER * _LARGE)))[:2]
            for k, line in enumerate(lines):
                self._write_line(line, left, self._below + whole + (k + 1) * _CAPTION, _LARGE, {})
        self._below += whole + 3 * _CAPTION

    def _write_lines(self, lines: Sequence[str], size: float, look: dict[str, Any], together: float = 0.0) -> None:
        high = size * _LINE / _POINTS
        self._begin_page_unless_room(min(self._height, high * len(lines) + together) if together else high)
        for line in lines:
            self._begin_page_unless_room(high)
            self._below += high
            self._write_line(line, MARGIN, self._below, size, look)

    def _begin_page_unless_room(self, height: float) -> None:
        """Begin a page unless this one has so much room."""
        from matplotlib.figure import Figure

        if not self._pages or self._below + height > self._height:
            self._pages.append(Figure(figsize=self._size))
            self._below = 0.0

    def _write_line(self, line: str, left: float, below: float, size: float, look: dict[str, Any]) -> None:
        place = left / self._size[0], 1.0 - (MARGIN + below) / self._size[1]
        self._pages[-1].text(*place, line, fontsize=size, parse_math=False, **look)


def _rows_of_pictures(pictures: Sequence[Picture], across: int) -> list[list[Picture]]:
    """Return pictures that stand beside each other: a wide one alone."""
    rows = list[list[Picture]]()
    for picture in pictures:
        if rows and not picture.wide and not rows[-1][0].wide and len(rows[-1]) < across:
            rows[-1].append(picture)
        else:
            rows.append([picture])
    return rows


def _png_of_picture(picture: Picture) -> bytes | None:
    """Return a picture as PNG; None where it exists as SVG only."""
    if picture.kind == "png":
        return picture.data
    return None if picture.pixels is None else picture.pixels()
