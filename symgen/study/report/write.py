"""Files of a document: self-contained HTML, or Markdown with separate pictures."""

from __future__ import annotations

import base64
import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Protocol
from urllib.parse import quote

from symgen.base.arguments import kind_of_value
from symgen.base.arguments import path_argument as argument_path
from symgen.base.errors import InputError
from symgen.base.escapes import markdown_text
from symgen.base.files import Content, check_path, system_message, templates_folder, write_all, write_whole
from symgen.study.report.browser_pdf import find_browser, print_pdf
from symgen.study.report.document import DocumentTable, Picture, ReportDocument, Section, TableCell
from symgen.study.report.kinds import STUDY_REPORTS
from symgen.study.report.latex import latex_tables
from symgen.study.report.letterhead import signing_section
from symgen.study.report.localised import localise_document
from symgen.study.report.plain_pdf import plain_pdf

if TYPE_CHECKING:
    import jinja2

#: Endings of reports -> the libraries needed.
WRITTEN: Mapping[str, tuple[str, ...]] = {**dict.fromkeys((".html", ".md", ".pdf"), ("matplotlib",)), ".tex": ()}


class Reported(Protocol):
    """A study that names its report, one of `symgen.study.report.kinds`."""

    report_kind: ClassVar[str]


def check_report(where: str, path: Path) -> None:
    """Refuse a report that cannot be written, before it is created.

    Raises
    ------
    InputError
        If the ending is not known, matplotlib is missing, or the file cannot be written.
    """
    check_path(where, path, WRITTEN, "plot")
    if path.suffix.lower() == ".md" and _report_folder(path).exists() and not _report_folder(path).is_dir():
        raise InputError(where, f"'{_report_folder(path)}' to be a folder, for the pictures", "a file of that name")


def write(document: ReportDocument, path: Path) -> Path:
    """Write a document; the page appears whole or not at all.

    Parameters
    ----------
    document : ReportDocument
        The report.
    path : Path
        ``.html``: one file that opens without a network; ``.pdf``: the same, printed by a browser, or drawn by
        matplotlib where there is none; ``.md``: pictures go into the folder ``NAME-files`` beside it; ``.tex``: the
        tables for a paper.
    """
    check_report("report", path)
    document = localise_document(document)
    if path.suffix.lower() == ".html":
        return write_whole(path, html_report(document))
    if path.suffix.lower() == ".tex":
        return write_whole(path, latex_tables(document))
    if path.suffix.lower() == ".pdf":
        program = find_browser()
        return (
            write_whole(path, plain_pdf(document))
            if program is None
            else print_pdf(program, html_report(document), path)
        )
    folder, is_new = _report_folder(path), False
    files: dict[Path, Content] = {
        folder / f"{p.name}.{p.kind}": p.data
        for p in (*document.pictures(), *filter(None, (document.letterhead.logo,)))
    }
    try:
        if files and not folder.exists():
            folder.mkdir()
            is_new = True
        write_all(files | {path: markdown_report(document, folder.name)})
    except OSError as error:
        raise InputError(str(folder), "a folder that can be made", system_message(error)) from error
    finally:
        if is_new and not any(folder.iterdir()):  # something could not be written
            folder.rmdir()
    return path


def write_report(study: Reported | Sequence[Reported], path: str | PathLike[str]) -> Path:
    """Write the report of a comparison, of several beside each other, or of a stress study.

    Parameters
    ----------
    study : Study, Stress or sequence of Study
        What `symgen.compare` or the stress study returns.
    path : path
        A ``.html`` file, which opens without a network, its ``.pdf``, ``.md`` with pictures in a folder beside it, or
        ``.tex``, the tables for a paper.

    Raises
    ------
    InputError
        If the ending is another one, matplotlib is missing, or the file cannot be written.
    """
    file = argument_path("report", path)
    check_report("report", file)
    studies = study if isinstance(study, Sequence) else [study]
    kinds = {getattr(each, "report_kind", "") for each in studies}
    if len(kinds) != 1 or kinds == {""}:
        raise InputError("report", "a comparison or a stress study", kind_of_value(study))
    return write(STUDY_REPORTS.get(*kinds)(studies), file)


def _report_folder(path: Path) -> Path:
    return path.with_name(f"{path.stem}-files")


# -- HTML --------------------------------------------------------------------------------------------------------------


@lru_cache(maxsize=1)
def _report_templates() -> jinja2.Environment:
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(templates_folder() / "report"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=True,
    )
    environment.filters["embedded"] = _embed_picture
    environment.filters["css_text"] = _css_text
    environment.tests["cell"] = lambda value: isinstance(value, TableCell)
    return environment


def _embed_picture(picture: Picture) -> str:
    kind = {"svg": "image/svg+xml", "png": "image/png"}[picture.kind]
    return f"data:{kind};base64,{base64.b64encode(picture.data).decode()}"


def _css_text(text: str) -> str:
    """Return a text for a style sheet, in which nothing but letters, digits and blanks stands for itself."""
    return "".join(c if c.isalnum() or c == " " else f"\\{ord(c):06x}" for c in text)


def html_report(document: ReportDocument) -> str:
    """Return a document as one HTML page: style and pictures inside, no scripts, no other files."""
    names = " · ".join((document.title, *(f"{label} {text}" for label, text in document.origin)))
    template = _report_templates().get_template("page.html.j2")
    return template.render(document=document, signing=[*signing_section(document)], names=names)


# -- Markdown ----------------------------------------------------------------------------------------------------------


def markdown_report(document: ReportDocument, folder: str) -> str:
    """Return a document as Markdown with tables, pictures being files in `folder`."""
    logo = document.letterhead.logo
    lines = [f"![logo]({quote(f'{folder}/{logo.name}.{logo.kind}')})", ""] if logo else []
    lines += [f"# {markdown_text(document.title)}", ""]
    lines += [f"**{markdown_text(document.verdict.text)}**", ""] if document.verdict else []
    origin = ", ".join(f"{label} {text}" for label, text in document.origin)
    lines += [markdown_text(origin), ""] if origin else []
    lines += [x for text in document.lead for x in (markdown_text(text), "")]
    lines += [f"[Play the motion]({document.page})", ""] if document.page else []
    for section in document.sections:
        lines += _markdown_section(section, 2, folder)
    lines += ["## Settings and versions", ""]
    lines += _markdown_table(DocumentTable("", ("made with", ""), document.facts, words=2))
    if document.command:
        fence = "`" * max(3, 1 + max(map(len, re.findall("`+", document.command)), default=0))
        lines += ["Reproduce with", "", f"{fence}sh", document.command, fence, ""]
    for section in signing_section(document):
        lines += _markdown_section(section, 2, folder)
    return "\n".join(lines).rstrip() + "\n"


def _markdown_section(section: Section, level: int, folder: str) -> list[str]:
    lines = [f"{'#' * level} {markdown_text(section.title)}", ""]
    shown = _markdown_pictures(section, folder)
    lines += shown if section.pictures_first else []
    lines += [x for text in section.text for x in (markdown_text(text), "")]
    lines += [f"- {markdown_text(text)}" for text in section.findings]
    lines += [""] if section.findings else []
    for table in section.tables:
        lines += _markdown_table(table)
    lines += [] if section.pictures_first else shown
    for part in section.parts:
        lines += _markdown_section(part, level + 1, folder)
    return lines


def _markdown_pictures(section: Section, folder: str) -> list[str]:
    lines = list[str]()
    for picture in section.pictures:
        address = quote(f"{folder}/{picture.name}.{picture.kind}")
        lines += [f"![{markdown_text(picture.alternative)}]({address})", "", markdown_text(picture.caption), ""]
    return lines


def _markdown_table(table: DocumentTable) -> list[str]:
    def markdown_row(cells: tuple[str | TableCell, ...]) -> str:
        texts = [cell.text if isinstance(cell, TableCell) else cell for cell in cells]
        return f"| {' | '.join(map(markdown_text, texts))} |"

    marks = ["---" if i < table.words else "---:" for i in range(len(table.headings))]
    lines = [markdown_text(table.caption), ""] if table.caption else []
    lines += [
        markdown_row(table.headings),
        f"| {' | '.join(marks)} |",
        *(markdown_row(cells) for cells in table.rows),
        "",
    ]
    return [*lines, *(x for note in table.notes for x in (markdown_text(note), ""))]
