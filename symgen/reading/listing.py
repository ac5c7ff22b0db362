"""Listings of a page: a mechanism's file and its emitted code, with links between their lines and the rows."""

from __future__ import annotations

from collections.abc import Container, Mapping
from html import escape
from typing import TYPE_CHECKING

from symgen.reading.html import attribute, fold, small

if TYPE_CHECKING:
    from symgen.reading.function_source import Computed


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
        name = back.get(number, "")
        link = f'  <a href="#rows-{attribute(name)}">rows</a>'
        lines.append(f'<span id="file-{number}">{escape(line)}{link}</span>' if name in joints else escape(line))
    return [fold(f"{len(lines)} lines", f"<pre>{chr(10).join(lines)}</pre>")]


def code_listing(
    source: str, parts: Mapping[str, str], listed: Container[str], back: Mapping[int, Computed]
) -> list[str]:
    """Return emitted modules; lines that compute what belongs to a row lead to it.

    Parameters
    ----------
    source : str
        Of the module ``model``.
    parts : mapping of str to str
        Sources of the method's modules, by name.
    listed : container of str
        Which of them are listed.
    back : mapping of int to Computed
        What lines of ``model`` compute.
    """
    lines = []
    for number, line in enumerate(source.splitlines(), 1):
        c = back.get(number)
        if c is None:
            lines.append(escape(line))
        else:
            link = f'<a href="#row-{attribute(c.row)}"># {escape(c.row)}: {escape(c.what)}</a>'
            lines.append(f'<span id="line-{number}">{escape(line.partition("  # ")[0])}  {link}</span>')
    listings = [fold(f"module model, {len(lines)} lines", f"<pre>{chr(10).join(lines)}</pre>")]
    for stem, text in parts.items():
        head = f"module {escape(stem)}, {text.count(chr(10))} lines"
        shown = f"<pre>{escape(text)}</pre>" if stem in listed else small("Left out, for the size of this page.")
        listings.append(fold(head, shown))
    return listings
