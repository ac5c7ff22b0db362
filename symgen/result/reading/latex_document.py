"""Derived equations as LaTeX with lines no wider than a page: a document, or its sections alone."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from symgen.base.errors import InputError, sizes_in_words, suggest
from symgen.base.escapes import latex_text
from symgen.describe.parts.own_units import as_written
from symgen.result.reading.notations import latex
from symgen.result.reading.row_words import row_words
from symgen.result.reading.sheet import LINE, Equation, Sheet
from symgen.result.reading.typeset import break_lines

if TYPE_CHECKING:
    from symgen.derive.formulate.equations import Equations
    from symgen.describe.mechanism import Mechanism
    from symgen.result.reading.law_steps import Law

#: Sections of a document.
SECTIONS = ("nomenclature", "Phi", "D", "nu", "gamma", "N", "M", "f", "energies", "law", "left-out")
#: Those of a part of another document, which needs amsmath alone.
EQUATIONS = SECTIONS[1:-2]
#: Equations of one environment: TeX keeps it in memory as a whole.
_TOGETHER = 24

_POWER = r"Energies and power; that of drivers without rows is $b \dot v + c$"
_HEAD = r"""\documentclass[10pt,a4paper]{article}
\usepackage[utf8]{inputenc}
\usepackage{amsmath,amssymb,longtable}
\usepackage[margin=25mm]{geometry}
\allowdisplaybreaks
\setlength{\parindent}{0pt}
\setlength{\emergencystretch}{6em}
"""


def latex_document(
    mechanism: Mechanism,
    equations: Equations,
    law: Law,
    values: Mapping[str, float],
    select: Sequence[str] = (),
    whole: bool = True,
) -> str:
    r"""Return all derived equations as a document, or its sections as paragraphs of another one.

    Parameters
    ----------
    mechanism, equations : Mechanism, Equations
        As for `symgen.result.reading.sheet.Sheet`.
    law : Law
        The method's law.
    values : mapping
        Values of parameters.
    select : sequence of str
        Sections of `SECTIONS`, and joints, that it is restricted to.
    whole : bool
        Whether it is a document; otherwise it has `EQUATIONS` unless sections are selected.

    Raises
    ------
    InputError
        If a name in `select` is neither.
    """
    content, joints = select_sections(equations, select)
    content = content or (SECTIONS if whole else EQUATIONS)
    e, sheet = equations, Sheet(mechanism, equations, joints)
    sections: dict[str, list[str]] = {
        "nomenclature": _nomenclature_lines(sheet, values),
        "Phi": _latex_section(r"Constraints $\Phi = 0$", _aligned_lines(sheet.phi(sheet.rows), " = 0")),
        "D": _latex_section(
            r"Jacobian $D$, by joint; blocks that are not written are zero",
            _aligned_lines(line for joint in sheet.joints for line in sheet.jacobian(joint)),
        ),
        "nu": _latex_section(
            r"Velocity constraints $D v = \nu$", _aligned_lines(sheet.nu(sheet.rows)) or [r"$\nu = 0$"]
        ),
        "gamma": _latex_section(
            r"Acceleration constraints $D \dot v = \gamma$", _aligned_lines(sheet.gamma(sheet.rows))
        ),
        "N": _latex_section(
            r"Rates of the coordinates $\dot q = N v$", _aligned_lines(sheet.rates()) or [r"$\dot q = v$"]
        ),
        "M": _latex_section(r"Mass matrix $M$; what is not written is zero or symmetric", _aligned_lines(sheet.mass())),
        "f": _latex_section(r"Forces $f$", _aligned_lines(sheet.forces()) or [r"$f = 0$"]),
        "energies": _latex_section(_POWER if e.driving else "Energies and power", _aligned_lines(sheet.energies())),
    }
    if whole and e.m:
        held = row_words(mechanism)
        items = [rf"\item {_latex_sentence(r.name)}: {_latex_sentence(held[r.name].words)}" for r in sheet.rows]
        sections["Phi"] = (
            _latex_section("Rows in words", [r"\begin{itemize}", *items, r"\end{itemize}"]) + sections["Phi"]
        )
    if not e.m:
        for part in ("Phi", "D", "nu", "gamma"):
            del sections[part]
    chosen = [part for part in sections if part in content]
    parts = [text for part in chosen for text in sections[part]]
    parts += _latex_section("Shared terms", _aligned_lines(sheet.shared_equations(sheet.nodes(chosen))))
    if "law" in content:
        parts += _law_lines(law) if e.m else []
    if "left-out" in content and e.omissions:
        items = [rf"\item {_latex_sentence(o.what)}: {_latex_sentence(o.why)}" for o in e.omissions]
        parts += _latex_section("Left out", [r"\begin{itemize}", *items, r"\end{itemize}"])
    if whole:
        return "\n".join([*_document_head(mechanism, sheet), *parts, r"\end{document}"]) + "\n"
    notes = [f"{mechanism.name}: {sizes_in_words(e)}; numbers have six digits"]
    notes += [f"left out: {o.what}: {o.why}" for o in e.omissions]
    texts = [*(f"% {note}" for note in notes), *(text.replace(r"\section*", r"\paragraph") for text in parts)]
    return "\n".join(texts) + "\n"


def _document_head(mechanism: Mechanism, sheet: Sheet) -> list[str]:
    """Return the document up to its first section."""
    e = sheet.equations
    free = ", ".join(_latex_sentence(r.name) for r in e.rows if r.phi is None)
    kind = "bodies" if mechanism.topology is None else "the joints of a tree"
    return [
        _HEAD,
        rf"\title{{{latex_text(mechanism.title or mechanism.name)}}}",
        r"\author{}\date{}",
        r"\begin{document}",
        r"\maketitle",
        rf"Mechanism \texttt{{{_breakable_text(mechanism.name)}}} in coordinates of {kind}: {sizes_in_words(e)}. "
        rf"Its motion follows from",
        r"\[ M \dot v + D^T \lambda = f, \qquad D v = \nu, \qquad D \dot v = \gamma, \qquad \dot q = N v. \]"
        if e.m
        else r"\[ M \dot v = f, \qquad \dot q = N v. \]",
        *(
            rf"\par {_latex_sentence(k)} has no row: it prescribes {_latex_sentence(what)}."
            for k, what in sheet.sentences_on_drivers().items()
        ),
        *([rf"\par Nonholonomic, conditions on velocities without $\Phi$: {free}."] if free else []),
        r"\par Numbers are rounded to six digits.",
    ]


def select_sections(equations: Equations, select: Sequence[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the selected sections and joints; ``joints.D`` is a joint, ``D`` the Jacobian."""
    with_rows = tuple(dict.fromkeys(row.joint for row in equations.rows))
    sections, joints = list[str](), list[str]()
    for item in select:
        joint = item.removeprefix("joints.")
        if item in SECTIONS:
            sections.append(item)
        elif joint in with_rows:
            joints.append(joint)
        else:
            expected = f"a joint with rows, or one of {', '.join(SECTIONS)}"
            raise InputError("--select", expected, f"'{item}'", suggest(item, (*SECTIONS, *with_rows)))
    return tuple(sections), tuple(joints)


def _latex_section(title: str, body: Iterable[str]) -> list[str]:
    listed = list(body)
    return [rf"\section*{{{title}}}", *listed] if listed else []


def _breakable_text(text: str) -> str:
    return latex_text(text).replace("-", r"-\allowbreak ")


def _latex_sentence(text: str) -> str:
    """Return a sentence with names and formulas in it; long ones may be broken."""
    return re.sub(r"\\_|[.*]", r"\g<0>\\allowbreak ", latex_text(text))


def _aligned_rows(rows: Sequence[str]) -> list[str]:
    texts = []
    for first in range(0, len(rows), _TOGETHER):
        texts.append("\\begin{align*}\n" + " \\\\\n".join(rows[first : first + _TOGETHER]) + "\n\\end{align*}")
    return texts


def _aligned_lines(lines: Iterable[Equation], tail: str = "") -> list[str]:
    return _aligned_rows([text for line in lines for text in _equation_rows(line, tail)])


def _equation_rows(line: Equation, tail: str = "") -> list[str]:
    """Return an equation as rows of an aligned environment."""
    left, wide = latex(line.left), line.left.width > LINE / 3  # a name that takes most of the line
    room = LINE - 4.0 if wide else LINE - line.left.width - (2.0 if tail else 0.0)
    rows, start = ([rf"\rlap{{${left}$}} &"], r"&\quad =") if wide else ([], f"{left} &=")
    for boxes in break_lines(line.right, room - 1.5, room - 3.0):
        rows.append(f"{start} {' '.join(map(latex, boxes))}")
        start = r"&\quad {}"
    rows[-1] += tail
    return rows


def _nomenclature_lines(sheet: Sheet, values: Mapping[str, float]) -> list[str]:
    lines = [r"\section*{Nomenclature}"]
    notes = {p.name: f", {p.note}" for p in sheet.mechanism.parameters if p.note}
    for title, quantities in sheet.quantities():
        if not quantities:
            continue
        lines += [
            rf"\subsection*{{{title}}}",
            r"\begin{longtable}{@{}p{0.3\textwidth}p{0.36\textwidth}p{0.12\textwidth}r@{}}",
        ]
        for quantity in quantities:
            numbers = title in ("Parameters", "Inputs")
            number, unit = as_written(sheet.mechanism, quantity, values) if numbers else (0.0, quantity.unit)
            value = f"{number:.6g}" if numbers else ""
            symbol = latex(sheet.writer.symbol(quantity.name))
            meaning = _latex_sentence(quantity.name + notes.get(quantity.name, ""))
            lines.append(rf"${symbol}$ & \raggedright {meaning} & {_latex_sentence(unit)} & {value} \\")
        lines.append(r"\end{longtable}")
    return lines


def _law_lines(law: Law) -> list[str]:
    lines = [rf"\section*{{The law of \texttt{{{_breakable_text(law.method)}}}}}", f"{_latex_sentence(law.summary)}."]
    for function, purpose, steps in law.parts:
        lines += [
            rf"\paragraph{{{_latex_sentence(function)}}} {_latex_sentence(purpose)}",
            *_aligned_rows([step.latex for step in steps]),
        ]
    return lines
