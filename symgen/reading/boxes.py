"""Formulas as small trees of boxes with widths, written as LaTeX, as MathML or as plain text."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from html import escape

#: Letters that names of quantities stand for: LaTeX, and the character.
GREEK = {
    **{"theta": (r"\theta", "θ"), "omega": (r"\omega", "ω"), "lambda": (r"\lambda", "λ"), "gamma": (r"\gamma", "γ")},
    **{"nu": (r"\nu", "ν"), "Phi": (r"\Phi", "Φ"), "alpha": (r"\alpha", "α"), "beta": (r"\beta", "β")},
    **{"eta": (r"\eta", "η"), "phi": (r"\varphi", "φ"), "mu": (r"\mu", "μ"), "delta": (r"\delta", "δ")},
}
#: Widths in units of the type's size, on the safe side.
_LETTER, _SMALL, _DIGIT, _SIGN = 0.6, 0.42, 0.51, 1.25
_SPECIAL = {
    **{"\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"},
    **{c: "\\" + c for c in "_&%$#"},
}
#: Fractions with these denominators read better with a point.
_DECIMAL = (2, 4, 5, 8, 10, 16, 20, 25, 40, 50, 80)


@dataclass(frozen=True, slots=True)
class Box:
    """A piece of a formula.

    Parameters
    ----------
    kind : str
        ``name``, ``number``, ``sign``, ``row``, ``bracket``, ``over``, ``power``, ``call``, ``cases`` or ``dot``.
    parts : tuple
        Smaller boxes, or texts.
    width : float
        In units of the type's size.
    """

    kind: str
    parts: tuple[Box, ...] = ()
    text: str = ""
    index: str = ""
    width: float = 0.0


def name(text: str) -> Box:
    """Return a name of the file, a letter of the notation or a shared term as it is typeset."""
    letter, index = letter_of(text)
    wide = _LETTER * (1 if letter in GREEK or len(letter) == 1 else 0.9 * len(letter))
    return Box("name", text=letter, index=index, width=wide + _SMALL * len(index) + 0.1)


def letter_of(text: str) -> tuple[str, str]:
    """Return the letter that a name is typeset with, and its index."""
    body, _, quantity = text.rpartition(".")
    if not body:
        found = re.fullmatch(r"([A-Za-z])_?(\d+)", text)
        return (found[1], found[2]) if found else (text, "")
    if quantity in ("c", "s"):
        return quantity, body
    if found := re.fullmatch(r"([vweα])([xyz0-3])", quantity):
        return ("omega" if found[1] == "w" else found[1]), f"{found[2]},{body}"
    if found := re.fullmatch(r"a([0-2])([0-2])", quantity):
        return "A", f"{int(found[1]) + 1}{int(found[2]) + 1},{body}"
    return quantity, body


def number(value: float) -> Box:
    """Return a literal: whole, a small fraction, or rounded to six digits."""
    if value == int(value) and abs(value) < 1e9:
        return _plain("number", str(int(value)))
    near = Fraction(value).limit_denominator(99)
    exact = abs(float(near) - value) <= 4e-16 * abs(value)
    if exact and abs(near.numerator) < 1000 and near.denominator not in _DECIMAL:
        return over(number(float(near.numerator)), number(float(near.denominator)))
    return _plain("number", f"{value:.6g}")


def _plain(kind: str, text: str) -> Box:
    mantissa, exponent, power = text.partition("e")
    wide = _DIGIT * len(mantissa) + (2.0 + _SMALL * len(power) if exponent else 0.0)
    return Box(kind, text=text, width=wide)


def is_number(box: Box) -> bool:
    """Whether a box is a literal."""
    return box.kind == "number" or (box.kind == "over" and all(p.kind == "number" for p in box.parts))


def atoms(box: Box) -> int:
    """Return how many names and literals a box has."""
    return sum(map(atoms, box.parts)) if box.parts else 1


def sign(text: str) -> Box:
    """Return an operator or relation."""
    return Box("sign", text=text, width=_SIGN)


def row(*parts: Box) -> Box:
    """Return boxes side by side."""
    return Box("row", parts, width=sum(p.width for p in parts) + 0.17 * max(0, len(parts) - 1))


def bracket(inside: Box) -> Box:
    """Return a box in brackets."""
    return Box("bracket", (inside,), width=inside.width + 1.1)


def over(above: Box, below: Box) -> Box:
    """Return a fraction."""
    return Box("over", (above, below), width=max(above.width, below.width) + 0.3)


def power(base: Box, exponent: Box) -> Box:
    """Return a power; of what has an index, the exponent stands behind it."""
    return Box("power", (base, exponent), width=base.width + 0.75 * exponent.width)


def transposed(base: Box) -> Box:
    """Return the transposed of a matrix."""
    return power(base, name("T"))


def call(function: str, arguments: Sequence[Box]) -> Box:
    """Return a function of arguments."""
    wide = 0.55 * len(function) + sum(a.width for a in arguments) + 1.0 * len(arguments) + 0.8
    return Box("call", tuple(arguments), text=function, width=wide)


def cases(pieces: Sequence[tuple[Box, Box | None]]) -> Box:
    """Return values with their conditions; None: otherwise."""
    flat = [p if p is not None else Box("name", text="otherwise", width=4.5) for pair in pieces for p in pair]
    wide = max(value.width for value, _ in pieces) + max((c.width if c else 4.5) for _, c in pieces) + 2.5
    return Box("cases", tuple(flat), width=wide)


def dot(base: Box) -> Box:
    """Return the rate of a quantity."""
    return Box("dot", (base,), width=base.width)


# -- LaTeX ----------------------------------------------------------------------------------------------------

_TEX_SIGNS = {
    **{"<=": r"\le", ">=": r"\ge", "!=": r"\ne", "and": r"\wedge", "or": r"\vee", "not": r"\neg", "*": r"\cdot"},
    ",": r",\;",
}
_TEX_FUNCTIONS = frozenset("sin cos tan sinh cosh tanh exp log min max".split())


def escaped(text: str) -> str:
    """Return a text as LaTeX prints it."""
    return "".join(_SPECIAL.get(c, c if c.isprintable() and ord(c) < 128 else f"[U+{ord(c):04X}]") for c in text)


def latex(box: Box) -> str:
    """Return a box as LaTeX."""
    parts = box.parts
    if box.kind == "name":
        base = GREEK[box.text][0] if box.text in GREEK else box.text if len(box.text) == 1 else _upright(box.text)
        return base + (rf"_{{{_index(box.index)}}}" if box.index else "")
    if box.kind == "number":
        mantissa, exponent, ten = box.text.partition("e")
        return rf"{mantissa} \cdot 10^{{{int(ten)}}}" if exponent else mantissa
    if box.kind == "sign":
        return _TEX_SIGNS.get(box.text, box.text)
    if box.kind == "row":
        return r" ".join(latex(p) for p in parts)
    if box.kind == "bracket":
        return rf"\left( {latex(parts[0])} \right)"
    if box.kind == "over":
        return rf"\frac{{{latex(parts[0])}}}{{{latex(parts[1])}}}"
    if box.kind == "power":
        return rf"{{{latex(parts[0])}}}^{{{latex(parts[1])}}}"
    if box.kind == "dot":
        return rf"\dot {{{latex(parts[0])}}}"
    if box.kind == "call":
        inside = ", ".join(latex(p) for p in parts)
        if box.text == "sqrt":
            return rf"\sqrt{{{inside}}}"
        if box.text == "abs":
            return rf"\left| {inside} \right|"
        head = f"\\{box.text}" if box.text in _TEX_FUNCTIONS else rf"\operatorname{{{escaped(box.text)}}}"
        simple = box.text in ("sin", "cos", "tan") and parts[0].kind == "name"
        return rf"{head} {inside}" if simple else rf"{head}\left( {inside} \right)"
    assert box.kind == "cases", "the last kind of box"
    lines = [
        f"{latex(value)} & " + (r"\text{otherwise}" if when.text == "otherwise" else rf"\text{{if }} {latex(when)}")
        for value, when in zip(parts[::2], parts[1::2], strict=True)
    ]
    return r"\begin{cases} " + r" \\ ".join(lines) + r" \end{cases}"


def _upright(text: str) -> str:
    return rf"\mathrm{{{escaped(text)}}}"


def _index(text: str) -> str:
    first, comma, body = text.partition(",")
    return f"{first},{_upright(body)}" if comma else first if first.isdigit() else _upright(first)


# -- MathML ----------------------------------------------------------------------------------------------------

_SIGNS = {"-": "−", "<=": "≤", ">=": "≥", "!=": "≠", "and": "∧", "or": "∨", "not": "¬", "*": "·"}


def mathml(box: Box) -> str:
    """Return a box as MathML, for presentation, without the element ``math`` around it."""
    parts = box.parts
    if box.kind == "name":
        letter = GREEK[box.text][1] if box.text in GREEK else box.text
        base = f"<mi>{escape(letter)}</mi>"
        return f"<msub>{base}<mtext>{escape(box.index)}</mtext></msub>" if box.index else base
    if box.kind == "number":
        mantissa, exponent, ten = box.text.partition("e")
        if exponent:
            return f"<mn>{mantissa}</mn><mo>·</mo><msup><mn>10</mn><mn>{int(ten)}</mn></msup>"
        return f"<mn>{mantissa}</mn>"
    if box.kind == "sign":
        return f"<mo>{escape(_SIGNS.get(box.text, box.text))}</mo>"
    if box.kind == "row":
        return "".join(_spaced(parts))
    if box.kind == "bracket":
        return f"<mrow><mo>(</mo>{mathml(parts[0])}<mo>)</mo></mrow>"
    if box.kind == "over":
        return f"<mfrac>{_one(parts[0])}{_one(parts[1])}</mfrac>"
    if box.kind == "power":
        return f"<msup>{_one(parts[0])}{_one(parts[1])}</msup>"
    if box.kind == "dot":
        return f'<mover accent="true">{_one(parts[0])}<mo>˙</mo></mover>'
    if box.kind == "call":
        inside = "<mo>,</mo>".join(mathml(p) for p in parts)
        if box.text == "sqrt":
            return f"<msqrt>{inside}</msqrt>"
        if box.text == "abs":
            return f"<mrow><mo>|</mo>{inside}<mo>|</mo></mrow>"
        head = f"<mi>{escape(box.text)}</mi><mo>&#8289;</mo>"
        simple = box.text in ("sin", "cos", "tan") and parts[0].kind == "name"
        return head + (inside if simple else f"<mrow><mo>(</mo>{inside}<mo>)</mo></mrow>")
    assert box.kind == "cases", "the last kind of box"
    lines = [
        f"<mtr><mtd>{mathml(value)}</mtd><mtd>{'' if when.text == 'otherwise' else '<mtext>if </mtext>'}"
        f"{mathml(when)}</mtd></mtr>"
        for value, when in zip(parts[::2], parts[1::2], strict=True)
    ]
    return f"<mrow><mo>{{</mo><mtable>{''.join(lines)}</mtable></mrow>"


def _spaced(parts: Sequence[Box]) -> list[str]:
    """Return parts with thin space between factors, which browsers do not add."""
    found: list[str] = []
    for before, part in zip((None, *parts), parts, strict=False):
        if before is not None and "sign" not in (before.kind, part.kind):
            found.append('<mspace width="0.17em"/>')
        found.append(mathml(part))
    return found


def _one(box: Box) -> str:
    text = mathml(box)
    return f"<mrow>{text}</mrow>" if box.kind in ("row", "call") or (box.kind == "number" and "e" in box.text) else text


def _whole(box: Box) -> Box:
    return bracket(box) if box.kind in ("row", "over", "power") else box


# -- plain text ----------------------------------------------------------------------------------------------------


def plain(box: Box) -> str:
    """Return a box as plain text."""
    parts = box.parts
    if box.kind in ("name", "number", "sign"):
        return f"{box.text}_{box.index}" if box.index else box.text
    if box.kind == "row":
        return " ".join(plain(p) for p in parts)
    if box.kind == "bracket":
        return f"({plain(parts[0])})"
    if box.kind == "over":
        return f"{plain(_whole(parts[0]))}/{plain(_whole(parts[1]))}"
    if box.kind == "power":
        return f"{plain(_whole(parts[0]))}^{plain(_whole(parts[1]))}"
    if box.kind == "dot":
        return f"{plain(parts[0])}'"
    if box.kind == "call":
        return f"{box.text}({', '.join(plain(p) for p in parts)})"
    assert box.kind == "cases", "the last kind of box"
    pairs = zip(parts[::2], parts[1::2], strict=True)
    return "; ".join(f"{plain(value)} if {plain(when)}" for value, when in pairs)
