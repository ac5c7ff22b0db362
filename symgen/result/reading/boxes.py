"""Formulas as small trees of boxes with widths; `symgen.result.reading.notations` writes them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

#: Letters that names of quantities stand for: LaTeX, and the character.
GREEK = {
    **{"theta": (r"\theta", "θ"), "omega": (r"\omega", "ω"), "lambda": (r"\lambda", "λ"), "gamma": (r"\gamma", "γ")},
    **{"nu": (r"\nu", "ν"), "Phi": (r"\Phi", "Φ"), "alpha": (r"\alpha", "α"), "beta": (r"\beta", "β")},
    **{"eta": (r"\eta", "η"), "phi": (r"\varphi", "φ"), "mu": (r"\mu", "μ"), "delta": (r"\delta", "δ")},
}
#: Widths in units of the type's size, on the safe side.
_LETTER, _SMALL, _DIGIT, _SIGN = 0.6, 0.42, 0.51, 1.25
#: Fractions with these denominators read better with a point.
_DECIMAL = (2, 4, 5, 8, 10, 16, 20, 25, 40, 50, 80)


@dataclass(frozen=True, slots=True)
class TextBox:
    """A piece of a formula.

    Parameters
    ----------
    kind : str
        ``name``, ``number``, ``sign``, ``row``, ``bracket``, ``over``, ``power``, ``call``, ``cases``, ``matrix`` or
        ``dot``.
    parts : tuple of Box
        Smaller boxes.
    text, index : str
        Letter and index of a name, digits of a number, function of a call, number of columns of a matrix. The index of
        a call is the name of its function for Python, where that is another one.
    width : float
        In units of the type's size.
    """

    kind: str
    parts: tuple[TextBox, ...] = ()
    text: str = ""
    index: str = ""
    width: float = 0.0


def name_box(text: str, whole: bool = False) -> TextBox:
    """Return a name of the file, a letter of the notation or a shared term as it is typeset; `whole`: without index."""
    letter, index = (text, "") if whole else letter_and_index(text)
    wide = _LETTER * (1 if letter in GREEK or len(letter) == 1 else 0.9 * len(letter))
    return TextBox("name", text=letter, index=index, width=wide + _SMALL * len(index) + 0.1)


def boxes_apart(names: Iterable[str]) -> dict[str, TextBox]:
    """Return names of one kind as they are typeset; if both ``l1`` and ``l_1`` are names, the first is whole."""
    every = set(names)
    return {
        text: name_box(text, whole=re.sub(r"^([A-Za-z])(\d+)$", r"\1_\2", text) in every - {text}) for text in every
    }


def letter_and_index(text: str) -> tuple[str, str]:
    """Return the letter that a name is typeset with, and its index."""
    body, _, quantity = text.rpartition(".")
    if not body:
        match = re.fullmatch(r"([A-Za-z])_?(\d+)", text)
        return (match[1], match[2]) if match else (text, "")
    if quantity in ("c", "s"):
        return quantity, body
    if match := re.fullmatch(r"([vweα])([xyz0-3])", quantity):
        return ("omega" if match[1] == "w" else match[1]), f"{match[2]},{body}"
    if match := re.fullmatch(r"a([0-2])([0-2])", quantity):
        return "A", f"{int(match[1]) + 1}{int(match[2]) + 1},{body}"
    return quantity, body


def literal_box(value: float, exact: bool = False) -> TextBox:
    """Return a literal: whole, a small fraction, or rounded to six digits; with all digits where `exact`."""
    if value == int(value) and abs(value) < (1e15 if exact else 1e9):
        return _width_of_digits(str(int(value)))
    if exact:
        return _width_of_digits(repr(value))
    near = Fraction(value).limit_denominator(99)
    exact = abs(float(near) - value) <= 4e-16 * abs(value)
    if exact and abs(near.numerator) < 1000 and near.denominator not in _DECIMAL:
        return fraction_box(literal_box(float(near.numerator)), literal_box(float(near.denominator)))
    return _width_of_digits(f"{value:.6g}")


def _width_of_digits(text: str) -> TextBox:
    mantissa, exponent, power = text.partition("e")
    wide = _DIGIT * len(mantissa) + (2.0 + _SMALL * len(power) if exponent else 0.0)
    return TextBox("number", text=text, width=wide)


def is_literal(box: TextBox) -> bool:
    """Whether a box is a literal."""
    return box.kind == "number" or (box.kind == "over" and all(p.kind == "number" for p in box.parts))


def count_atoms(box: TextBox) -> int:
    """Return the number of names and literals of a box."""
    return sum(map(count_atoms, box.parts)) if box.parts else 1


def sign_box(text: str) -> TextBox:
    """Return an operator or relation."""
    return TextBox("sign", text=text, width=_SIGN)


def row_box(*parts: TextBox) -> TextBox:
    """Return boxes side by side."""
    return TextBox("row", parts, width=sum(p.width for p in parts) + 0.17 * max(0, len(parts) - 1))


def bracket_box(inside: TextBox) -> TextBox:
    """Return a box in brackets."""
    return TextBox("bracket", (inside,), width=inside.width + 1.1)


def fraction_box(above: TextBox, below: TextBox) -> TextBox:
    """Return a fraction."""
    return TextBox("over", (above, below), width=max(above.width, below.width) + 0.3)


def power_box(base: TextBox, exponent: TextBox) -> TextBox:
    """Return a power; where the base has an index, the exponent follows it."""
    return TextBox("power", (base, exponent), width=base.width + 0.75 * exponent.width)


def transposed_box(base: TextBox) -> TextBox:
    """Return the transposed of a matrix."""
    return power_box(base, name_box("T"))


def function_box(function: str, arguments: Sequence[TextBox], python: str = "") -> TextBox:
    """Return a function of arguments; `python`: its name for Python, where that is another one."""
    wide = 0.55 * len(function) + sum(a.width for a in arguments) + 1.0 * len(arguments) + 0.8
    return TextBox("call", tuple(arguments), text=function, index=python, width=wide)


def matrix_box(entries: Sequence[Sequence[TextBox]]) -> TextBox:
    """Return a matrix."""
    widths = [max([box.width for box in column]) for column in zip(*entries, strict=True)]
    flat = tuple(box for line in entries for box in line)
    return TextBox("matrix", flat, text=str(len(widths)), width=sum(widths, 1.5) + len(widths))


def cases_box(pieces: Sequence[tuple[TextBox, TextBox | None]]) -> TextBox:
    """Return values with their conditions; None: otherwise."""
    flat = [p if p is not None else TextBox("name", text="otherwise", width=4.5) for pair in pieces for p in pair]
    wide = max(value.width for value, _ in pieces) + max((c.width if c else 4.5) for _, c in pieces) + 2.5
    return TextBox("cases", tuple(flat), width=wide)


def rate_box(base: TextBox) -> TextBox:
    """Return the rate of a quantity."""
    return TextBox("dot", (base,), width=base.width)
