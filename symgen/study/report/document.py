"""Parts of a report, independent of its subject and file format."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Picture:
    """A picture inside the page itself.

    Attributes
    ----------
    name : str
        Name of its file where pictures are separate files: words joined by dashes, without ending.
    caption : str
        What it shows, below it.
    alternative : str
        Alternative text.
    data : bytes
        The file.
    kind : str
        ``svg`` or ``png``.
    wide : bool
        Whether it needs the whole width of the page.
    pixels : callable, optional
        Returns a picture that is ``svg`` as ``png``, for paper without a browser.
    """

    name: str
    caption: str
    alternative: str
    data: bytes
    kind: str
    wide: bool = False
    pixels: Callable[[], bytes] | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class TableCell:
    """A cell of a table with its own style.

    Attributes
    ----------
    text : str
        Its content.
    mood : str
        ``good``, ``doubtful``, ``bad`` or ``faint``; never the only sign of the meaning.
    """

    text: str
    mood: str


@dataclass(frozen=True)
class DocumentTable:
    """A table.

    Attributes
    ----------
    caption : str
        What it shows, above it.
    headings : tuple of str
        Of the columns.
    rows : tuple of tuple of (str or Cell)
        As many cells as headings.
    words : int
        Number of columns of words, from the left; the others hold numbers and are right-aligned.
    notes : tuple of str
        Below it.
    """

    caption: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str | TableCell, ...], ...]
    words: int = 1
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Section:
    """A part of a report, in this order: text, findings, tables, pictures, parts of its own.

    Where `beside` is set, its pictures are left of its tables; with `pictures_first` they are above all else; with
    `strip` they are small, four beside each other on paper; with `sheet` it is a page of its own on paper, whose rows
    have room for a hand.
    """

    title: str
    text: tuple[str, ...] = ()
    findings: tuple[str, ...] = ()
    tables: tuple[DocumentTable, ...] = ()
    pictures: tuple[Picture, ...] = ()
    parts: tuple[Section, ...] = ()
    beside: bool = False
    pictures_first: bool = False
    strip: bool = False
    sheet: bool = False

    @property
    def anchor(self) -> str:
        """Target of links to the section."""
        return anchor_of_title(self.title)


@dataclass(frozen=True)
class Letterhead:
    """What paper of a workshop has besides its content.

    Attributes
    ----------
    number : str
        Of the report.
    logo : Picture, optional
        A mark at the top right.
    signatures : tuple of str
        Who signs, each with a line for name, day and signature.
    paper : str
        ``a4`` or ``letter``.
    """

    number: str = ""
    logo: Picture | None = None
    signatures: tuple[str, ...] = ()
    paper: str = "a4"


@dataclass(frozen=True)
class ReportDocument:
    """A whole report.

    Attributes
    ----------
    title : str
        At its head.
    lead : tuple of str
        Paragraphs below the title.
    facts : tuple of (str, str)
        Settings and versions, by label, at the end of the report.
    command : str
        The command that makes it again; empty where there is none.
    sections : tuple of Section
        Its content.
    page : str
        Address of a page that plays the motion, relative to the document; empty where there is none.
    verdict : TableCell, optional
        One sentence with its mood, before all else.
    origin : tuple of (str, str)
        Number, revision, author and day, by label, below the title.
    letterhead : Letterhead
        Mark and size of the paper.
    """

    title: str
    lead: tuple[str, ...]
    facts: tuple[tuple[str, str], ...]
    command: str
    sections: tuple[Section, ...] = field(default=())
    page: str = ""
    verdict: TableCell | None = None
    origin: tuple[tuple[str, str], ...] = ()
    letterhead: Letterhead = Letterhead()

    def pictures(self) -> list[Picture]:
        """Return all pictures in the order of the report."""
        return [p for section in self.sections for p in _pictures_of_section(section)]


def _pictures_of_section(section: Section) -> Sequence[Picture]:
    return [*section.pictures, *(p for part in section.parts for p in _pictures_of_section(part))]


def anchor_of_title(title: str) -> str:
    """Return a title as the name of a place in a page."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")
