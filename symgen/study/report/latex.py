"""The tables of a report for a paper: LaTeX with booktabs."""

from __future__ import annotations

import re
from collections.abc import Iterator

from symgen.study.report.document import DocumentTable, ReportDocument, TableCell

#: What needs a backslash or a name of its own in text.
_TEXT = {
    **{character: rf"\{character}" for character in "&%$#_{}"},
    **{"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"},
    **{"–": "--", "…": r"\dots{}", "µ": r"\textmu{}", "°": r"\textdegree{}"},
    **{"Φ": r"$\Phi$", "ν": r"$\nu$", "γ": r"$\gamma$", "λ": r"$\lambda$", "²": "$^2$", "₀": "$_0$", "’": "'"},
    **{"×": r"$\times$", "±": r"$\pm$", "−": "$-$", "|": "$|$", "<": "$<$", ">": "$>$"},
}
_DIGITS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
_POWER = re.compile(r"(?:(−?)(\d+(?:\.\d+)?)×)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)")


def latex_tables(document: ReportDocument) -> str:
    """Return the tables of numbers at the head of each section, for a document that uses booktabs."""
    tables = [(s.title, x) for s in document.sections for x in s.tables if x.words < len(x.headings)]
    lines = ["% needs \\usepackage{booktabs}", *([f"% {document.command}"] if document.command else [])]
    for title, table in tables:
        lines += ["", *_lines_of_table(title, table)]
    return "\n".join(lines) + "\n"


def _lines_of_table(title: str, table: DocumentTable) -> Iterator[str]:
    columns = "l" * table.words + "r" * (len(table.headings) - table.words)
    yield from (
        r"\begin{table}",
        r"  \centering\small",
        rf"  \caption{{{latex_with_powers(f'{title}. {table.caption}')}}}",
    )
    yield from (rf"  \begin{{tabular}}{{@{{}}{columns}@{{}}}}", r"    \toprule")
    yield "    " + " & ".join(map(latex_with_powers, table.headings)) + r" \\"
    yield r"    \midrule"
    for row in table.rows:
        cells = (cell.text if isinstance(cell, TableCell) else cell for cell in row)
        yield "    " + " & ".join(map(latex_with_powers, cells)) + r" \\"
    yield from (r"    \bottomrule", r"  \end{tabular}")
    for note in table.notes:
        yield rf"  \par\footnotesize {latex_with_powers(note)}"
    yield r"\end{table}"


def latex_with_powers(text: str) -> str:
    """Return text for LaTeX: signs as names, powers of ten as formulas."""
    parts, end = list[str](), 0
    for match in _POWER.finditer(text):
        sign, mantissa, power = match.groups()
        factor = f"{'-' if sign else ''}{mantissa}\\cdot" if mantissa else ""
        parts += [_escape(text[end : match.start()]), f"${factor}10^{{{power.translate(_DIGITS)}}}$"]
        end = match.end()
    return "".join([*parts, _escape(text[end:])])


def _escape(text: str) -> str:
    return "".join(_TEXT.get(character, character) for character in text)
