"""What paper of a workshop has besides its content: number, revision, author and day, a mark, who signs, its size."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Final

from symgen.base.arguments import one_word_of
from symgen.base.errors import InputError, quote
from symgen.base.files import system_message
from symgen.base.locales import local_date
from symgen.study.report.document import DocumentTable, Letterhead, Picture, ReportDocument, Section

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

#: Sizes of paper, width and height [inch].
PAPERS: Final = {"a4": (8.27, 11.69), "letter": (8.5, 11.0)}
#: Largest file of a logo [bytes]: it is inside of every report.
LARGEST_LOGO = 500_000
_PNG = b"\x89PNG\r\n\x1a\n"
_SVG = re.compile(rb"<svg[\s>]")


def letterhead_of_options(number: str, logo: str | None, signatures: Sequence[str], paper: str) -> Letterhead:
    """Return the letterhead of a command's options.

    Raises
    ------
    InputError
        If the paper is none, or the logo is no picture that browsers show.
    """
    size = paper_of_option(paper)
    picture = None if logo is None else logo_of_file(Path(logo))
    return Letterhead(_line(number), picture, tuple(filter(None, map(_line, signatures))), size)


def paper_of_option(text: str) -> str:
    """Return the size of paper that an option names.

    Raises
    ------
    InputError
        If there is no such size.
    """
    return one_word_of("--paper", text.lower(), PAPERS)


def put_on_paper(document: ReportDocument, size: str) -> ReportDocument:
    """Return a report for a size of paper."""
    return replace(document, letterhead=replace(document.letterhead, paper=size))


def origin_of_file(mechanism: Mechanism, number: str = "") -> tuple[tuple[str, str], ...]:
    """Return number, revision and author, those that there are, and the day of a report."""
    own = {"report": number, "revision": mechanism.revision, "author": mechanism.author}
    return (*((label, text) for label, text in own.items() if text), ("date", local_date(date.today())))


def signing_section(document: ReportDocument) -> Iterator[Section]:
    """Yield the page that is signed, with what it accepts, where somebody signs."""
    if not document.letterhead.signatures:
        return
    which = ", ".join(f"{label} {text}" for label, text in document.origin)
    text = f"The signatures accept this document ({which}) on {document.title}, and its result:"
    rows = tuple((who, "", "", "") for who in document.letterhead.signatures)
    table = DocumentTable("", ("for", "name", "date", "signature"), rows, words=4)
    verdict = (document.verdict.text,) if document.verdict else ()
    yield Section("Acceptance", (text, *verdict), tables=(table,), sheet=True)


def logo_of_file(path: Path) -> Picture:
    """Return a logo with its content, which is inside of the report.

    Raises
    ------
    InputError
        If the file is no PNG or SVG, cannot be read, or is large.
    """
    expected = "a picture that is PNG or SVG"
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError("--logo", expected, f"{quote(str(path))} ({system_message(error)})") from None
    if len(data) > LARGEST_LOGO:
        raise InputError("--logo", f"a file of at most {LARGEST_LOGO // 1000} kB", f"{len(data) // 1000} kB")
    kind = "png" if data.startswith(_PNG) else "svg" if _SVG.search(data[:2000]) else ""
    if not kind:
        raise InputError("--logo", expected, f"{quote(str(path))}, which is neither")
    return Picture("logo", "", "", data, kind)


def _line(text: str) -> str:
    """Return a text in one line."""
    return " ".join(text.split())
