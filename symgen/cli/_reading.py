"""LaTeX output of ``symgen inspect``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symgen.base.settings import Settings


def latex_of_equations(name: str, settings: Settings, select: str | None, symbols: bool, whole: bool) -> str:
    """Return the equations as LaTeX: a document, or a part of one."""
    from symgen.api import Model
    from symgen.describe.files.load import read_raw
    from symgen.describe.files.validate import validate
    from symgen.result.reading.inspection import method_of
    from symgen.result.reading.latex_document import latex_document
    from symgen.result.reading.law_steps import law_as_steps
    from symgen.result.reading.length_symbols import put_length_symbols
    from symgen.run.compiling.choices import choose_coordinates

    raw, source = read_raw(name)
    model = Model(validate(put_length_symbols(raw) if symbols else raw, source))
    values = model.parameters(settings.parameters)
    equations = model.equations_in(choose_coordinates(model.mechanism, settings.coordinates, "straight").name)
    names = tuple(item.strip() for item in (select or "").split(",") if item.strip())
    choice = method_of(settings)
    steps = law_as_steps(choice.method.name, choice.options, equations.derived.driving is not None)
    return latex_document(equations.mechanism, equations.derived, steps, values, names, whole)
