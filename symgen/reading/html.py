"""Pieces of a page: what is folded, tables, formulas as MathML."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from symgen.reading.boxes import Box, mathml
from symgen.reading.sheet import Equation
from symgen.reading.typeset import broken


def attribute(text: str) -> str:
    """Return a text as an attribute's value."""
    return escape(text, quote=True)


def short(text: str) -> str:
    """Return a line of code, its end left out where it is long."""
    return text if len(text) <= 60 else text[:57] + "..."


def small(text: str) -> str:
    """Return a remark."""
    return f'<p class="small">{escape(text)}</p>'


def section(ident: str, title: str, parts: Iterable[str]) -> str:
    """Return a section with its heading."""
    return f'<section id="{ident}"><h2>{escape(title)}</h2>\n' + "\n".join(parts) + "\n</section>"


def fold(head: str, inside: str, is_open: bool = False, ident: str = "", marked: bool = False) -> str:
    """Return something that is folded; `head` is HTML where `marked`, or has MathML in it."""
    text = head if marked or "<math" in head else escape(head, quote=False)
    name = f' id="{attribute(ident)}"' if ident else ""
    start = f"<details{name}{' open' if is_open else ''}><summary>{text}</summary>"
    return f'{start}<div class="fold">{inside}</div></details>'


def table(lines: Sequence[Sequence[str]], numbers: int = 0) -> str:
    """Return a table of HTML; the last `numbers` columns are numbers."""
    rows = []
    for i, line in enumerate(lines):
        tag, first = "th" if i == 0 else "td", len(line) - numbers
        cells = (f"<{tag}{' class=n' if k >= first else ''}>{text}</{tag}>" for k, text in enumerate(line))
        rows.append(f"<tr>{''.join(cells)}</tr>")
    return f"<table>{''.join(rows)}</table>"


def math(box: Box) -> str:
    """Return a formula."""
    return f"<math>{mathml(box)}</math>"


def equation(line: Equation, tail: str = "") -> str:
    """Return an equation, broken where it is long."""
    lines = broken(line.right, 62.0 - line.left.width, 62.0)
    parts = []
    for i, boxes in enumerate(lines):
        inside = "".join(map(mathml, boxes))
        if i == 0:
            inside = f"{mathml(line.left)}<mo>=</mo>{inside}"
        if tail and i == len(lines) - 1:
            inside += "<mo>=</mo><mn>0</mn>"
        parts.append(f"<div{' class=more' if i else ''}><math>{inside}</math></div>")
    return f'<div class="equation">{"".join(parts)}</div>'


def equations(lines: Iterable[Equation]) -> str:
    """Return equations one below the other."""
    return "\n".join(map(equation, lines))
