"""Formulas of a description as lines of another language, one operation a line."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from symgen.base.errors import SymgenError
from symgen.base.vocabulary.elementary_functions import ELEMENTARY
from symgen.base.vocabulary.expressions import Expr, Name, Number, Reading

_NAMES = re.compile(r"\ba\d+\b")
_FORMS = {
    **{"add": "{} + {}", "sub": "{} - {}", "mul": "{} * {}", "div": "{} / {}", "neg": "-{}", "not": "{} ? 0 : 1"},
    **{"lt": "{} < {} ? 1 : 0", "le": "{} <= {} ? 1 : 0", "gt": "{} > {} ? 1 : 0", "ge": "{} >= {} ? 1 : 0"},
    **{"and": "{} && {} ? 1 : 0", "or": "{} || {} ? 1 : 0", "where": "{} ? {} : {}"},
}


class NotInLines(SymgenError):
    """A formula without a form in another language."""


@dataclass(frozen=True)
class Dialect:
    """Syntax of lines in a language.

    Attributes
    ----------
    declaration : str
        A line that names a value.
    number : callable
        The text of a number.
    undefined : str
        The text of an undefined number.
    forms : mapping of str to str
        Functions of formulas besides arithmetic.
    """

    declaration: str
    number: Callable[[float], str]
    undefined: str
    forms: Mapping[str, str]


JAVASCRIPT = Dialect(
    "const {} = {};",
    lambda value: repr(value).removesuffix(".0"),
    "NaN",
    {
        **{name: f"Math.{name}({{}})" for name in (*ELEMENTARY, "abs", "sign")},
        **{name: f"Math.{name}({{}}, {{}})" for name in ("atan2", "min", "max", "pow")},
    },
)
C = Dialect(
    "const real {} = {};",
    repr,
    "NAN",
    {
        **{name: f"M({name})({{}})" for name in ELEMENTARY},
        **{"abs": "M(fabs)({})", "sign": "(real)(({0} > 0) - ({0} < 0))"},
        **{"atan2": "M(atan2)({}, {})", "pow": "M(pow)({}, {})", "min": "M(fmin)({}, {})", "max": "M(fmax)({}, {})"},
    },
)


def _define_operator(function: str, turned: bool = False) -> Callable[[LineValue, object], LineValue]:
    return lambda self, other: self._apply(function, *((other, self) if turned else (self, other)))


@dataclass(frozen=True)
class LineValue:
    """A number by its name in lines. Arithmetic with it writes further lines."""

    writer: FormulaLines = field(repr=False)
    text: str

    def _apply(self, function: str, *operands: object) -> LineValue:
        return self.writer.write_line(function, *operands)

    def __add__(self, other: object) -> LineValue:
        return self if self.writer.is_zero(other) else self._apply("add", self, other)

    def __radd__(self, other: object) -> LineValue:
        return self if self.writer.is_zero(other) else self._apply("add", other, self)

    __sub__, __rsub__ = _define_operator("sub"), _define_operator("sub", turned=True)
    __mul__, __rmul__ = _define_operator("mul"), _define_operator("mul", turned=True)
    __truediv__, __rtruediv__ = _define_operator("div"), _define_operator("div", turned=True)


class FormulaLines:
    """Numbers of `symgen.describe.formulas.start` that record their computation.

    Parameters
    ----------
    places : dict of str to str
        Texts of the names of parameters.
    dialect : Dialect
        The language.
    """

    def __init__(self, places: dict[str, str], dialect: Dialect = JAVASCRIPT) -> None:
        self.places, self.dialect, self.lines = places, dialect, list[str]()

    def value(self, expression: Expr, where: str) -> Any:
        """Return the value of a formula."""
        if isinstance(expression, Number):
            return expression.value
        if isinstance(expression, Name):
            return LineValue(self, self.places[expression.name])
        if isinstance(expression, Reading):
            raise NotInLines(f"{where}: a reading")
        return self.apply_function(expression.function, *(self.value(a, where) for a in expression.arguments))

    def apply_function(self, function: str, *arguments: Any) -> Any:
        """Return a function of formulas."""
        return self.write_line(function, *arguments)

    def check_above(self, limit: Any, x: Any, where: str, expected: str, got: str) -> Any:
        """Return `x`; a value not above the limit makes the start not finite."""
        return self._add_line(f"{self.result(x)} > {self.result(limit)} ? {self.result(x)} : {self.dialect.undefined}")

    def result(self, value: Any) -> str:
        """Return the text of a value."""
        if isinstance(value, LineValue):
            return value.text
        number = self.dialect.number(float(value))
        return f"({number})" if number.startswith("-") else number

    def lines_of(self, results: Iterable[str]) -> list[str]:
        """Return the lines for some results."""
        names, lines = set(_NAMES.findall(" ".join(results))), list[str]()
        for k in reversed(range(len(self.lines))):
            if f"a{k}" in names:
                names.update(_NAMES.findall(self.lines[k]))
                lines.append(self.lines[k])
        return lines[::-1]

    def write_line(self, function: str, *operands: object) -> LineValue:
        """Write a line with a function of values; return its value."""
        form = _FORMS.get(function) or self.dialect.forms.get(function)
        if form is None:
            raise NotInLines(f"the function {function}")
        return self._add_line(form.format(*map(self.result, operands)))

    def is_zero(self, value: object) -> bool:
        """Whether a value is the number 0."""
        return not isinstance(value, LineValue) and float(value) == 0.0  # type: ignore[arg-type]  # numbers else

    def _add_line(self, text: str) -> LineValue:
        name = f"a{len(self.lines)}"
        self.lines.append(self.dialect.declaration.format(name, text))
        return LineValue(self, name)
