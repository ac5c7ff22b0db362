"""Formulas as small trees of boxes with widths, written as LaTeX, as MathML or as plain text."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
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


def name(text: str, whole: bool = False) -> Box:
    """Return a name of the file, a letter of the notation or a shared term as it is typeset; `whole`: without index."""
    letter, index = (text, "") if whole else letter_of(text)
    wide = _LETTER * (1 if letter in GREEK or len(letter) == 1 else 0.9 * len(letter))
    return Box("name", text=letter, index=index, width=wide + _SMALL * len(index) + 0.1)


def apart(names: Iterable[str]) -> dict[str, Box]:
    """Return names of one kind as they are typeset; where both ``l1`` and ``l_1`` are names, the first is whole."""
    known = set(names)
    return {text: name(text, whole=re.sub(r"^([A-Za-z])(\d+)$", r"\1_\2", text) in known - {text}) for text in known}


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


# -- notations -------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Notation:
    """How boxes are written.

    Parameters
    ----------
    forms : mapping
        Kinds of boxes with a fixed form, which has a place for each part.
    part : callable
        Writes a part that stands in such a form.
    others : mapping
        Kinds of boxes that are written by a function.
    """

    forms: Mapping[str, str]
    part: Callable[[Box], str]
    others: Mapping[str, Callable[[Box], str]]

    def write(self, box: Box) -> str:
        form = self.forms.get(box.kind)
        return self.others[box.kind](box) if form is None else form % tuple(map(self.part, box.parts))


def bare(box: Box) -> bool:
    """Whether a box is a function whose argument needs no bracket; a power of it would be read as one of that."""
    return box.kind == "call" and box.text in ("sin", "cos", "tan") and box.parts[0].kind == "name"


def _pairs(box: Box) -> list[tuple[Box, Box | None]]:
    """Return the values of cases with their conditions; None: otherwise."""
    pairs = zip(box.parts[::2], box.parts[1::2], strict=True)
    return [(value, None if when.text == "otherwise" else when) for value, when in pairs]


# -- LaTeX -----------------------------------------------------------------------------------------------------

_TEX_SIGNS = {
    **{"<=": r"\le", ">=": r"\ge", "!=": r"\ne", "and": r"\wedge", "or": r"\vee", "not": r"\neg", "*": r"\cdot"},
    ",": r",\;",
}
_TEX_FUNCTIONS = frozenset("sin cos tan sinh cosh tanh exp log min max".split())
_TEX_AROUND = {"sqrt": r"\sqrt{%s}", "abs": r"\left| %s \right|"}


def latex(box: Box) -> str:
    """Return a box as LaTeX."""
    return _LATEX.write(box)


def escaped(text: str) -> str:
    """Return a text as LaTeX prints it."""
    return "".join(_SPECIAL.get(c, c if c.isprintable() and ord(c) < 128 else f"[U+{ord(c):04X}]") for c in text)


def _tex_name(box: Box) -> str:
    base = GREEK[box.text][0] if box.text in GREEK else box.text if len(box.text) == 1 else _upright(box.text)
    return base + (rf"_{{{_index(box.index)}}}" if box.index else "")


def _tex_number(box: Box) -> str:
    mantissa, exponent, ten = box.text.partition("e")
    return rf"{mantissa} \cdot 10^{{{int(ten)}}}" if exponent else mantissa


def _tex_call(box: Box) -> str:
    inside = ", ".join(map(latex, box.parts))
    if box.text in _TEX_AROUND:
        return _TEX_AROUND[box.text] % inside
    head = f"\\{box.text}" if box.text in _TEX_FUNCTIONS else rf"\operatorname{{{escaped(box.text)}}}"
    return rf"{head} {inside}" if bare(box) else rf"{head}\left( {inside} \right)"


def _tex_cases(box: Box) -> str:
    lines = []
    for value, when in _pairs(box):
        condition = r"\text{otherwise}" if when is None else rf"\text{{if }} {latex(when)}"
        lines.append(f"{latex(value)} & {condition}")
    return r"\begin{cases} " + r" \\ ".join(lines) + r" \end{cases}"


def _upright(text: str) -> str:
    return rf"\mathrm{{{escaped(text)}}}"


def _index(text: str) -> str:
    first, comma, body = text.partition(",")
    return f"{first},{_upright(body)}" if comma else first if first.isdigit() else _upright(first)


_LATEX = _Notation(
    forms={"over": r"\frac{%s}{%s}", "power": "{%s}^{%s}", "bracket": r"\left( %s \right)", "dot": r"\dot {%s}"},
    part=latex,
    others={
        "name": _tex_name,
        "number": _tex_number,
        "sign": lambda box: _TEX_SIGNS.get(box.text, box.text),
        "row": lambda box: " ".join(map(latex, box.parts)),
        "call": _tex_call,
        "cases": _tex_cases,
    },
)

# -- MathML ----------------------------------------------------------------------------------------------------

_SIGNS = {"-": "−", "<=": "≤", ">=": "≥", "!=": "≠", "and": "∧", "or": "∨", "not": "¬", "*": "·"}
_AROUND = {"sqrt": "<msqrt>%s</msqrt>", "abs": "<mrow><mo>|</mo>%s<mo>|</mo></mrow>"}
_BRACKET = "<mrow><mo>(</mo>%s<mo>)</mo></mrow>"


def mathml(box: Box) -> str:
    """Return a box as MathML, for presentation, without the element ``math`` around it."""
    return _MATHML.write(box)


def _mathml_name(box: Box) -> str:
    base = f"<mi>{escape(GREEK[box.text][1] if box.text in GREEK else box.text)}</mi>"
    return f"<msub>{base}<mtext>{escape(box.index)}</mtext></msub>" if box.index else base


def _mathml_row(box: Box) -> str:
    """Write parts with thin space between factors, which browsers do not add."""
    found: list[str] = []
    for before, part in zip((None, *box.parts), box.parts, strict=False):
        if before is not None and "sign" not in (before.kind, part.kind):
            found.append('<mspace width="0.17em"/>')
        found.append(mathml(part))
    return "".join(found)


def _mathml_call(box: Box) -> str:
    inside = "<mo>,</mo>".join(map(mathml, box.parts))
    if box.text in _AROUND:
        return _AROUND[box.text] % inside
    return f"<mi>{escape(box.text)}</mi><mo>&#8289;</mo>" + (inside if bare(box) else _BRACKET % inside)


def _mathml_number(box: Box) -> str:
    mantissa, exponent, ten = box.text.partition("e")
    text = f"<mn>{mantissa}</mn>"
    return f"{text}<mo>·</mo><msup><mn>10</mn><mn>{int(ten)}</mn></msup>" if exponent else text


def _mathml_cases(box: Box) -> str:
    lines = []
    for value, when in _pairs(box):
        condition = "<mi>otherwise</mi>" if when is None else f"<mtext>if </mtext>{mathml(when)}"
        lines.append(f"<mtr><mtd>{mathml(value)}</mtd><mtd>{condition}</mtd></mtr>")
    return f"<mrow><mo>{{</mo><mtable>{''.join(lines)}</mtable></mrow>"


def _one(box: Box) -> str:
    """Write what has to be one element."""
    text = mathml(box)
    return f"<mrow>{text}</mrow>" if box.kind in ("row", "call") or (box.kind == "number" and "e" in box.text) else text


_MATHML = _Notation(
    forms={
        "over": "<mfrac>%s%s</mfrac>",
        "power": "<msup>%s%s</msup>",
        "dot": '<mover accent="true">%s<mo>˙</mo></mover>',
    },
    part=_one,
    others={
        "name": _mathml_name,
        "number": _mathml_number,
        "sign": lambda box: f"<mo>{escape(_SIGNS.get(box.text, box.text))}</mo>",
        "row": _mathml_row,
        "bracket": lambda box: _BRACKET % mathml(*box.parts),
        "call": _mathml_call,
        "cases": _mathml_cases,
    },
)

# -- plain text ------------------------------------------------------------------------------------------------


def plain(box: Box) -> str:
    """Return a box as plain text."""
    return _PLAIN.write(box)


def _plain_atom(box: Box) -> str:
    return f"{box.text}_{box.index}" if box.index else box.text


def _plain_cases(box: Box) -> str:
    return "; ".join(f"{plain(value)} if {'otherwise' if when is None else plain(when)}" for value, when in _pairs(box))


def _whole(box: Box) -> str:
    """Write what stands beside a sign of division or of a power."""
    return plain(bracket(box) if box.kind in ("row", "over", "power") else box)


_PLAIN = _Notation(
    forms={"over": "%s/%s", "power": "%s^%s"},
    part=_whole,
    others={
        **dict.fromkeys(("name", "number", "sign"), _plain_atom),
        "row": lambda box: " ".join(map(plain, box.parts)),
        "bracket": lambda box: f"({plain(*box.parts)})",
        "dot": lambda box: f"{plain(*box.parts)}'",
        "call": lambda box: f"{box.text}({', '.join(map(plain, box.parts))})",
        "cases": _plain_cases,
    },
)
