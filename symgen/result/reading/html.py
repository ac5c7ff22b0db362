"""Pieces of a page: folds, tables, formulas as MathML, patterns of sparse matrices."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING

from symgen.result.reading.boxes import TextBox
from symgen.result.reading.notations import mathml
from symgen.result.reading.sheet import Equation
from symgen.result.reading.typeset import break_lines

if TYPE_CHECKING:
    from symgen.derive.formulate.equations import Equations


def attribute_text(text: str) -> str:
    """Return a text as an attribute's value."""
    return escape(text, quote=True)


def shorten_code(text: str) -> str:
    """Return a line of code, its end left out where it is long."""
    return text if len(text) <= 60 else text[:57] + "..."


def prose_html(text: str) -> str:
    """Return a sentence of the code as a page shows it: words in backticks as code, powers and transposes raised."""
    shown = re.sub(r"(`+)(.+?)\1", r"<code>\2</code>", escape(text, quote=False))
    raised = re.sub(r"(?<=[\w)])\^(-?\d+|[T+])(?![\w])", r"<sup>\1</sup>", shown)
    return raised.replace("<sup>-", "<sup>−")


def small_html(text: str) -> str:
    """Return a remark."""
    return f'<p class="small">{prose_html(text)}</p>'


def section_html(ident: str, title: str, parts: Iterable[str]) -> str:
    """Return a section with its heading."""
    return f'<section id="{ident}"><h2>{escape(title)}</h2>\n' + "\n".join(parts) + "\n</section>"


def folded_html(head: str, inside: str, is_open: bool = False, ident: str = "", marked: bool = False) -> str:
    """Return a folded part; `head` is HTML where `marked`, or has MathML in it."""
    text = head if marked or "<math" in head else prose_html(head)
    name = f' id="{attribute_text(ident)}"' if ident else ""
    start = f"<details{name}{' open' if is_open else ''}><summary>{text}</summary>"
    return f'{start}<div class="fold">{inside}</div></details>'


def html_table(lines: Sequence[Sequence[str]], numbers: int = 0) -> str:
    """Return a table of HTML; the last `numbers` columns are numbers."""
    rows = []
    for i, line in enumerate(lines):
        tag, first = "th" if i == 0 else "td", len(line) - numbers
        cells = (f"<{tag}{' class=n' if k >= first else ''}>{text}</{tag}>" for k, text in enumerate(line))
        rows.append(f"<tr>{''.join(cells)}</tr>")
    return f"<table>{''.join(rows)}</table>"


def formula_html(box: TextBox) -> str:
    """Return a formula."""
    return f"<math>{mathml(box)}</math>"


def vector_equation(text: str) -> str:
    """Return an equation of `symgen.result.reading.row_words` with signs and indices as on paper."""
    shown = escape(text).replace(" . ", " · ").replace(" - ", " − ").replace(" x ", " × ")
    shown = re.sub(r"\b(omega|theta)(?=\()", lambda m: {"omega": "ω", "theta": "θ"}[m[1]], shown)
    return re.sub(r"\b([ervu]|ω|θ)(?:_([xyz]))?\(", r"<b>\1</b><sub>\2</sub>(", shown).replace("<sub></sub>", "")


def equation_html(line: Equation, tail: str = "") -> str:
    """Return an equation, broken where it is long."""
    lines = break_lines(line.right, 62.0 - line.left.width, 62.0)
    parts = []
    for i, boxes in enumerate(lines):
        inside = "".join(map(mathml, boxes))
        if i == 0:
            inside = f"{mathml(line.left)}<mo>=</mo>{inside}"
        if tail and i == len(lines) - 1:
            inside += "<mo>=</mo><mn>0</mn>"
        parts.append(f"<div{' class=more' if i else ''}><math>{inside}</math></div>")
    return f'<div class="equation">{"".join(parts)}</div>'


def equations_html(lines: Iterable[Equation]) -> str:
    """Return equations one below the other."""
    return "\n".join(map(equation_html, lines))


#: Largest number of entries that each have a title with their place.
NAMED = 2500
_FILLS = {"x": "#1f5fa8", "1": "#b9c7d8", "f": "#c4622d"}


def pattern_of_jacobian(equations: Equations) -> dict[tuple[int, int], str]:
    """Return the entries of D: ``x`` varies, ``1`` is constant, of any value."""
    g = equations.graph
    return {(i, j): "x" if g.value(n) is None else "1" for i, r in enumerate(equations.rows) for j, n in r.entries}


def pattern_of_factor(equations: Equations, order: Sequence[int]) -> dict[tuple[int, int], str]:
    """Return the entries of the factor L of D G D^T: ``x`` of the matrix, ``f`` filled in.

    Parameters
    ----------
    equations : Equations
        What was derived.
    order : sequence of int
        The order in which rows are eliminated: row and column k of L are of row ``order[k]``.
    """
    columns = [frozenset(j for j, _ in row.entries) for row in equations.rows]
    m = len(columns)
    near = [{j for j in range(m) if j != i and columns[i] & columns[j]} for i in range(m)]
    first = [set(n) for n in near]
    place = {row: k for k, row in enumerate(order)}
    entries: dict[tuple[int, int], str] = {(k, k): "x" for k in range(len(order))}
    for row in order:
        later = {n for n in near[row] if place[n] > place[row]}
        for n in later:
            entries[place[n], place[row]] = "x" if n in first[row] else "f"
            near[n] |= later - {n}
    return entries


def pattern_svg(
    entries: Mapping[tuple[int, int], str], rows: Sequence[str], columns: Sequence[str], title: str, links: bool = False
) -> str:
    """Return a pattern as SVG, entries of one colour as one path where there are many.

    Parameters
    ----------
    entries : mapping
        Kind of entry by row and column.
    rows, columns : sequence of str
        Their names.
    title : str
        Alternative text.
    links : bool
        Whether rows are linked to where they are written.
    """
    m, n = len(rows), len(columns)
    cell = max(1.0, min(16.0, 640.0 / max(m, n, 1)))
    parts = [
        f'<svg class="pattern" viewBox="0 0 {n} {m}" width="{n * cell:.0f}" height="{m * cell:.0f}" role="img">',
        f"<title>{escape(title)}</title>",
        f'<rect width="{n}" height="{m}" fill="#fff" stroke="#9aa4b0" stroke-width="{1 / cell:.3f}"/>',
    ]
    if len(entries) <= NAMED:
        for (i, j), kind in entries.items():
            words = f"<title>{escape(rows[i])}, {escape(columns[j])}</title>"
            box = f'<rect x="{j}.06" y="{i}.06" width=".88" height=".88" fill="{_FILLS[kind]}">{words}</rect>'
            parts.append(f'<a href="#row-{escape(rows[i], quote=True)}">{box}</a>' if links else box)
    else:
        for kind, fill in _FILLS.items():
            path = "".join(f"M{j} {i}h1v1h-1z" for (i, j), own in entries.items() if own == kind)
            if path:
                parts.append(f'<path d="{path}" fill="{fill}"/>')
    return "".join([*parts, "</svg>"])
