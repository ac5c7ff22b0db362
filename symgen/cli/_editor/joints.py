"""The equations of a joint of a draft, as the page of `symgen inspect` shows them."""

from __future__ import annotations

from html import escape
from typing import Any

from symgen.base.errors import InputError, quote, suggest
from symgen.derive.formulate.formulate import formulate
from symgen.describe.mechanism import Mechanism
from symgen.result.reading.html import equation_html, equations_html, vector_equation
from symgen.result.reading.page_size import check_size
from symgen.result.reading.row_words import row_words
from symgen.result.reading.sheet import Sheet


def joint_equations(mechanism: Mechanism, name: str) -> dict[str, Any]:
    """Return the rows of a joint and their equations, as markup; names in it are escaped.

    Raises
    ------
    InputError
        If there is no such joint, or the mechanism is too large for a page.
    """
    joint = next((each for each in mechanism.joints if each.name == name), None)
    if joint is None:
        names = [each.name for each in mechanism.joints]
        raise InputError("joint", "the name of a joint", quote(name), suggest(name, names))
    check_size(mechanism)
    derived = formulate(mechanism)
    sheet, words = Sheet(mechanism, derived), row_words(mechanism)
    rows = sheet.rows_of_joint(name)
    phi, gamma = ({line.key: line for line in lines} for lines in (sheet.phi(rows), sheet.gamma(rows)))
    parts = []
    for row in rows:
        held = words[row.name]
        parts.append(f"<p><b>{escape(row.name)}</b>: {escape(held.words)}</p>")
        if held.vectors and mechanism.space == "spatial":
            parts.append(f'<p class="vectors">{vector_equation(held.vectors)}</p>')
        parts += [equation_html(phi[row.name], " = 0")] if row.name in phi else []
        parts.append(equation_html(gamma[row.name]))
    parts.append(equations_html(sheet.jacobian(name)))
    between = " and ".join(dict.fromkeys(joint.bodies))
    return {"title": f"{name}: {joint.kind} between {between}", "markup": "\n".join(parts)}
