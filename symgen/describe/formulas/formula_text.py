"""Expression tree to formula text; `symgen.describe.formulas.parser.parse` reads the same tree back."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.vocabulary.expressions import Expr, Name, Number, Reading, table_of

_INFIX: Mapping[str, tuple[str, int]] = {
    "or": (" or ", 1),
    "and": (" and ", 2),
    "lt": (" < ", 4),
    "le": (" <= ", 4),
    "gt": (" > ", 4),
    "ge": (" >= ", 4),
    "add": (" + ", 5),
    "sub": (" - ", 5),
    "mul": ("*", 6),
    "div": ("/", 6),
}
_CHOICE, _NOT, _COMPARISON, _SIGN, _POWER, _ATOM = 0, 3, 4, 7, 8, 9


def to_text(expression: Expr) -> str:
    """Return the formula of `expression`, with no more brackets than its shape needs."""
    return _text_and_precedence(expression)[0]


def file_value(expression: Expr) -> float | str:
    """Return an expression as written in a file: a number, or a formula."""
    return expression.value if isinstance(expression, Number) else to_text(expression)


def _text_in_brackets(expression: Expr, least: int) -> str:
    text, strength = _text_and_precedence(expression)
    return text if strength >= least else f"({text})"


def _text_and_precedence(expression: Expr) -> tuple[str, int]:
    """Return the text and the precedence of its outermost operator."""
    if isinstance(expression, Number):
        return repr(expression.value), _SIGN if repr(expression.value).startswith("-") else _ATOM
    if isinstance(expression, Name | Reading):
        return expression.name, _ATOM
    function, arguments = expression.function, expression.arguments
    if function in _INFIX:
        sign, strength = _INFIX[function]
        # A comparison of comparisons would read as a chain, so neither side may be one.
        left = strength + 1 if strength == _COMPARISON else strength
        return _text_in_brackets(arguments[0], left) + sign + _text_in_brackets(
            arguments[1], _right_precedence(strength)
        ), strength
    if function == "pow":
        return f"{_text_in_brackets(arguments[0], _ATOM)}**{_text_in_brackets(arguments[1], _ATOM)}", _POWER
    if function == "neg":
        return "-" + _text_in_brackets(arguments[0], _POWER), _SIGN
    if function == "not":
        return "not " + _text_in_brackets(arguments[0], _NOT), _NOT
    if function == "where":
        condition, yes, no = arguments
        return (
            f"{_text_in_brackets(yes, 1)} if {_text_in_brackets(condition, 1)} else {_text_in_brackets(no, _CHOICE)}",
            _CHOICE,
        )
    listed = ", ".join(to_text(argument) for argument in arguments)
    return f"{table_of(function) or function}({listed})", _ATOM


def _right_precedence(strength: int) -> int:
    """Return the least precedence of a right operand: a sign is bracketed there for readability only."""
    return _POWER if strength == _INFIX["mul"][1] else strength + 1
