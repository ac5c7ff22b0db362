"""Formulas of a file as JavaScript: what follows from parameters in a page, such as the described start."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from symgen.errors import SymgenError
from symgen.vocabulary.expressions import Expr, Name, Number, Reading
from symgen.vocabulary.functions import ELEMENTARY

_FORMS = {
    **{"add": "{} + {}", "sub": "{} - {}", "mul": "{} * {}", "div": "{} / {}", "neg": "-{}", "not": "{} ? 0 : 1"},
    **{"lt": "{} < {} ? 1 : 0", "le": "{} <= {} ? 1 : 0", "gt": "{} > {} ? 1 : 0", "ge": "{} >= {} ? 1 : 0"},
    **{"and": "{} && {} ? 1 : 0", "or": "{} || {} ? 1 : 0", "where": "{} ? {} : {}"},
    **{name: f"Math.{name}({{}})" for name in (*ELEMENTARY, "abs", "sign")},
    **{name: f"Math.{name}({{}}, {{}})" for name in ("atan2", "min", "max", "pow")},
}


class NotInPages(SymgenError):
    """A formula has something that pages do not."""


@dataclass(frozen=True)
class Script:
    """A number in a script: what it is called there. Arithmetic with it writes further lines."""

    lines: list[str] = field(repr=False)
    text: str

    def _with(self, function: str, *operands: object) -> Script:
        return let(self.lines, _FORMS[function].format(*map(_text, operands)))

    def __add__(self, other: object) -> Script:
        return self if _text(other) == "0" else self._with("add", self, other)

    def __radd__(self, other: object) -> Script:
        return self if _text(other) == "0" else self._with("add", other, self)

    def __sub__(self, other: object) -> Script:
        return self._with("sub", self, other)

    def __rsub__(self, other: object) -> Script:
        return self._with("sub", other, self)

    def __mul__(self, other: object) -> Script:
        return self._with("mul", self, other)

    def __rmul__(self, other: object) -> Script:
        return self._with("mul", other, self)

    def __truediv__(self, other: object) -> Script:
        return self._with("div", self, other)

    def __rtruediv__(self, other: object) -> Script:
        return self._with("div", other, self)


def _text(value: object) -> str:
    if isinstance(value, Script):
        return value.text
    number = repr(float(value)).removesuffix(".0")  # type: ignore[arg-type]  # numbers and scripts only
    return f"({number})" if number.startswith("-") else number


def let(lines: list[str], text: str) -> Script:
    """Write a line that gives a value a name; return the name."""
    name = f"a{len(lines)}"
    lines.append(f"const {name} = {text};")
    return Script(lines, name)


class ScriptLines:
    """Numbers of `symgen.describe.start` that write down how they are worked out.

    Parameters
    ----------
    places : dict of str to str
        What names of parameters are in the script.
    """

    def __init__(self, places: dict[str, str]) -> None:
        self.places, self.lines = places, list[str]()

    def value(self, expression: Expr, where: str) -> Any:
        """Return what a formula stands for."""
        if isinstance(expression, Number):
            return expression.value
        if isinstance(expression, Name):
            return Script(self.lines, self.places[expression.name])
        if isinstance(expression, Reading):
            raise NotInPages(f"{where}: a reading")
        return self.apply(expression.function, *(self.value(a, where) for a in expression.arguments))

    def apply(self, function: str, *arguments: Any) -> Any:
        """Return a function of formulas."""
        if function not in _FORMS:
            raise NotInPages(f"the function {function}")
        return let(self.lines, _FORMS[function].format(*map(_text, arguments)))

    def above(self, limit: Any, x: Any, where: str, expected: str, got: str) -> Any:
        """Return `x`; what is not above the limit shows in the page as a start that is not finite."""
        return let(self.lines, f"{_text(x)} > {_text(limit)} ? {_text(x)} : NaN")

    def result(self, value: Any) -> str:
        """Return the text of a value."""
        return _text(value)
