"""From a document to its file: HTML that needs nothing else, or Markdown with its pictures beside it."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from functools import lru_cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

from symgen.errors import InputError
from symgen.report.document import Cell, Document, Picture, Section, Table
from symgen.result.export import check_path, write_whole

if TYPE_CHECKING:
    import jinja2

#: Endings of reports -> the libraries needed.
WRITTEN: Mapping[str, tuple[str, ...]] = {".html": ("matplotlib",), ".md": ("matplotlib",)}


def check_report(where: str, path: Path) -> None:
    """Refuse a report that cannot be written, before it is made.

    Raises
    ------
    InputError
        If the ending is not known, matplotlib is missing, or the file cannot be written.
    """
    check_path(where, path, WRITTEN, "plot")
    if path.suffix.lower() == ".md" and _folder(path).exists() and not _folder(path).is_dir():
        raise InputError(where, f"'{_folder(path)}' to be a folder, for the pictures", "a file of that name")


def write(document: Document, path: Path) -> Path:
    """Write a document; the page appears whole or not at all.

    Parameters
    ----------
    document : Document
        The report.
    path : Path
        ``.html``: one file that opens without a network; ``.md``: pictures go into the folder ``NAME-files`` beside it.
    """
    check_report("report", path)
    if path.suffix.lower() == ".html":
        text = html(document)
        return write_whole(path, lambda file: file.write_text(text, encoding="utf-8"))
    folder = _folder(path)
    if document.pictures():
        folder.mkdir(exist_ok=True)
    for picture in document.pictures():
        write_whole(folder / f"{picture.name}.{picture.kind}", partial(_put, picture.data))
    text = markdown(document, folder.name)
    return write_whole(path, lambda file: file.write_text(text, encoding="utf-8"))


def _put(data: bytes, file: Path) -> None:
    file.write_bytes(data)


def _folder(path: Path) -> Path:
    return path.with_name(f"{path.stem}-files")


# -- HTML --------------------------------------------------------------------------------------------------------------


@lru_cache(maxsize=1)
def _templates() -> jinja2.Environment:
    import jinja2

    package = Path(__file__).resolve().parent.parent
    # inside the installed package, else beside it in a checkout
    folders = [package / "templates" / "report", package.parent / "templates" / "report"]
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(folders),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=True,
    )
    environment.filters["embedded"] = _embedded
    environment.tests["cell"] = lambda value: isinstance(value, Cell)
    return environment


def _embedded(picture: Picture) -> str:
    kind = {"svg": "image/svg+xml", "png": "image/png"}[picture.kind]
    return f"data:{kind};base64,{base64.b64encode(picture.data).decode()}"


def html(document: Document) -> str:
    """Return a document as one HTML page: style and pictures inside, no scripts, nothing from elsewhere."""
    return _templates().get_template("page.html.j2").render(document=document)


# -- Markdown ----------------------------------------------------------------------------------------------------------


def markdown(document: Document, folder: str) -> str:
    """Return a document as Markdown with tables, pictures being files in `folder`."""
    lines = [f"# {document.title}", ""]
    lines += [x for text in document.lead for x in (text, "")]
    lines += _table(Table("", ("made with", ""), document.facts, words=2))
    if document.command:
        lines += ["Made again by", "", "```sh", document.command, "```", ""]
    for section in document.sections:
        lines += _section(section, 2, folder)
    return "\n".join(lines).rstrip() + "\n"


def _section(section: Section, level: int, folder: str) -> list[str]:
    lines = [f"{'#' * level} {section.title}", ""]
    lines += [x for text in section.text for x in (text, "")]
    lines += [f"- {text}" for text in section.findings]
    lines += [""] if section.findings else []
    for table in section.tables:
        lines += _table(table)
    for picture in section.pictures:
        lines += [f"![{picture.alternative}]({folder}/{picture.name}.{picture.kind})", "", picture.caption, ""]
    for part in section.parts:
        lines += _section(part, level + 1, folder)
    return lines


def _table(table: Table) -> list[str]:
    def row(cells: tuple[str | Cell, ...]) -> str:
        texts = [cell.text if isinstance(cell, Cell) else cell for cell in cells]
        return "| " + " | ".join(text.replace("|", "\\|").replace("\n", " ") for text in texts) + " |"

    marks = ["---" if i < table.words else "---:" for i in range(len(table.headings))]
    lines = [table.caption, ""] if table.caption else []
    lines += [row(table.headings), f"| {' | '.join(marks)} |", *(row(cells) for cells in table.rows), ""]
    return [*lines, *(x for note in table.notes for x in (note, ""))]
