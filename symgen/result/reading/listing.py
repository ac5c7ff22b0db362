"""Listings of a page: a mechanism's file and its emitted code, with links between their lines and the rows."""

from __future__ import annotations

import re
from collections.abc import Container, Mapping
from dataclasses import dataclass
from html import escape
from os import fspath
from pathlib import Path
from typing import TYPE_CHECKING

from symgen.base.errors import plural
from symgen.base.escapes import printable
from symgen.base.ir.program import OutputSlot
from symgen.derive.emit.printer import ElementAccess
from symgen.describe import catalogue
from symgen.result.reading.html import attribute_text, folded_html

if TYPE_CHECKING:
    from os import PathLike

    from symgen.base.ir.program import ModelProgram
    from symgen.derive.formulate.equations import Equations


#: Longer files are not shown [characters].
LONGEST = 150_000


def text_of_model(model: str | PathLike[str]) -> str:
    """Return the text that describes a model; empty where no file does, or a very long one."""
    name = fspath(model)
    path = catalogue.file_of_entry(name) if name in catalogue.all_names() else None if ":" in name else Path(name)
    try:
        text = "" if path is None else path.read_text(encoding="utf-8")
    except (OSError, ValueError):
        return ""
    return text if len(text) <= LONGEST else ""


def lines_of_sections(text: str) -> dict[str, int]:
    """Return the first line, from 1, of each table ``[section.name]`` of a file, by that name."""
    lines: dict[str, int] = {}
    for number, line in enumerate(text.splitlines(), 1):
        header = re.match(r"\s*\[\s*([A-Za-z_]+)\s*\.\s*[\"']?([A-Za-z0-9_]+)[\"']?\s*[\].]", line)
        if header:
            lines.setdefault(f"{header[1]}.{header[2]}", number)
    return lines


@dataclass(frozen=True)
class Computed:
    """An emitted line that computes something of a row.

    Attributes
    ----------
    row, what : str
        The row, and what of it: ``Phi``, ``nu``, ``gamma``, or the velocity whose entry of D it is.
    line : int
        Line of the module, from 1.
    text : str
        The line itself.
    """

    row: str
    what: str
    line: int
    text: str


def lines_that_compute(program: ModelProgram, equations: Equations, source: str) -> list[Computed]:
    """Return the lines of the module ``model`` that compute Phi, nu, entries of D and gamma of each row.

    Parameters
    ----------
    program : ModelProgram
        The program that was printed.
    equations : Equations
        What was derived.
    source : str
        The module's text.
    """
    access = ElementAccess(program.layout, {})
    names, speeds = [r.name for r in equations.rows], [v.name for v in equations.velocities]
    targets = [("geometry", OutputSlot("residual", i), n, "Phi") for i, n in enumerate(names)]
    targets += [("geometry", OutputSlot("nu", i), n, "nu") for i, n in enumerate(names)]
    targets += [
        ("geometry", OutputSlot("jacobian", e.slot), names[e.row], speeds[e.column])
        for e in program.jacobian
        if e.slot is not None
    ]
    targets += [("observe", OutputSlot("out", i), n, "gamma") for i, n in enumerate(names)]
    entries, lines = list[Computed](), assigned_lines(source)
    for function, target, row, what in targets:
        line = lines.get((function, access.write(target)))
        if line is not None:
            entries.append(Computed(row, what, *line))
    return entries


def assigned_lines(source: str) -> dict[tuple[str, str], tuple[int, str]]:
    """Return number and text, without its comment, of the line that assigns an element in each function, by both."""
    lines: dict[tuple[str, str], tuple[int, str]] = {}
    function = ""
    for number, line in enumerate(source.splitlines(), 1):
        if header := re.match(r"def (\w+)\(", line):
            function = header[1]
        elif assigned := re.match(r"    (\w+\[\d+\]) = ", line):
            lines[function, assigned[1]] = number, line.partition("  # ")[0].strip()
    return lines


def file_listing(text: str, places: Mapping[str, int], joints: Container[str]) -> list[str]:
    """Return the lines of a file; those that begin a joint lead to its rows.

    Parameters
    ----------
    text : str
        The file; empty where there is none.
    places : mapping of str to int
        Lines of its sections, from 1.
    joints : container of str
        Names of the joints.
    """
    if not text:
        return ["<p>No file describes this mechanism, or one too long to show.</p>"]
    back = {number: name.removeprefix("joints.") for name, number in places.items() if name.startswith("joints.")}
    lines = []
    for number, line in enumerate(text.splitlines(), 1):
        name, own = back.get(number, ""), escape(printable(line.expandtabs(4)))  # what turns text around is seen
        link = f'  <a href="#rows-{attribute_text(name)}">rows</a>'
        lines.append(f'<span id="file-{number}">{own}{link}</span>' if name in joints else own)
    return [folded_html(f"{plural(len(lines), 'line')}", f"<pre>{chr(10).join(lines)}</pre>")]


def code_listing(source: str, parts: Mapping[str, str], back: Mapping[int, Computed]) -> list[str]:
    """Return emitted modules; lines that compute what belongs to a row lead to it.

    Parameters
    ----------
    source : str
        Of the module ``model``.
    parts : mapping of str to str
        Sources of the method's modules, by name.
    back : mapping of int to Computed
        What lines of ``model`` compute.
    """
    lines = []
    for number, line in enumerate(source.splitlines(), 1):
        c = back.get(number)
        if c is None:
            lines.append(escape(line))
        else:
            link = f'<a href="#row-{attribute_text(c.row)}"># {escape(c.row)}: {escape(c.what)}</a>'
            lines.append(f'<span id="line-{number}">{escape(line.partition("  # ")[0])}  {link}</span>')
    listings = [folded_html(f"module model, {plural(len(lines), 'line')}", f"<pre>{chr(10).join(lines)}</pre>")]
    for stem, text in parts.items():
        head = f"module {escape(stem)}, {plural(text.count(chr(10)), 'line')}"
        listings.append(folded_html(head, f"<pre>{escape(text)}</pre>"))
    return listings
