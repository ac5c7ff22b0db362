"""Notations of formulas: boxes written as LaTeX, as MathML or as text."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from html import escape
from itertools import pairwise
from typing import ClassVar

from symgen.base.escapes import latex_text
from symgen.result.reading.boxes import GREEK, TextBox


class _Notation:
    """How boxes are written: a kind with a fixed form has a place there for each part, any other kind has a method."""

    forms: ClassVar[Mapping[str, str]] = {}

    def write(self, box: TextBox) -> str:
        """Return the text of a box."""
        form = self.forms.get(box.kind)
        return str(getattr(self, box.kind)(box)) if form is None else form % tuple(map(self.part, box.parts))

    def part(self, box: TextBox) -> str:
        """Return the text of a part in a fixed form."""
        return self.write(box)

    def join_parts(self, box: TextBox, between: str = ", ") -> str:
        """Return the text of all parts."""
        return between.join(map(self.write, box.parts))

    def lines(self, box: TextBox, form: str, between: str) -> list[str]:
        """Return the lines of a matrix in a form with one place, its entries joined by a separator."""
        entries, wide = [*map(self.write, box.parts)], int(box.text)
        return [form % between.join(entries[i : i + wide]) for i in range(0, len(entries), wide or 1)]


def needs_no_bracket(box: TextBox) -> bool:
    """Whether a box is a function whose argument needs no bracket; its power would be read as one of the argument."""
    return box.kind == "call" and box.text in ("sin", "cos", "tan") and box.parts[0].kind == "name"


def _pairs_of_cases(box: TextBox) -> list[tuple[TextBox, TextBox | None]]:
    """Return the values of cases with their conditions; None: otherwise."""
    pairs = zip(box.parts[::2], box.parts[1::2], strict=True)
    return [(value, None if when.text == "otherwise" else when) for value, when in pairs]


# -- LaTeX ------------------------------------------------------------------------------------------------------

_TEX_SIGNS = {
    **{"<=": r"\le", ">=": r"\ge", "!=": r"\ne", "and": r"\wedge", "or": r"\vee", "not": r"\neg", "*": r"\cdot"},
    ",": r",\;",
}
_TEX_FUNCTIONS = frozenset("sin cos tan sinh cosh tanh exp log min max".split())
_TEX_AROUND = {"sqrt": r"\sqrt{%s}", "abs": r"\left| %s \right|"}


class _Latex(_Notation):
    forms: ClassVar = {
        **{"over": r"\frac{%s}{%s}", "power": "{%s}^{%s}", "bracket": r"\left( %s \right)", "dot": r"\dot {%s}"}
    }

    def name(self, box: TextBox) -> str:
        base = (
            GREEK[box.text][0] if box.text in GREEK else box.text if len(box.text) == 1 else _upright_letters(box.text)
        )
        return base + (rf"_{{{_index_text(box.index)}}}" if box.index else "")

    def number(self, box: TextBox) -> str:
        mantissa, exponent, ten = box.text.partition("e")
        return rf"{mantissa} \cdot 10^{{{int(ten)}}}" if exponent else mantissa

    def sign(self, box: TextBox) -> str:
        return _TEX_SIGNS.get(box.text, box.text)

    def row(self, box: TextBox) -> str:
        return self.join_parts(box, " ")

    def call(self, box: TextBox) -> str:
        inside = self.join_parts(box)
        if box.text in _TEX_AROUND:
            return _TEX_AROUND[box.text] % inside
        head = f"\\{box.text}" if box.text in _TEX_FUNCTIONS else rf"\operatorname{{{latex_text(box.text)}}}"
        return rf"{head} {inside}" if needs_no_bracket(box) else rf"{head}\left( {inside} \right)"

    def cases(self, box: TextBox) -> str:
        lines = []
        for value, when in _pairs_of_cases(box):
            condition = r"\text{otherwise}" if when is None else rf"\text{{if }} {self.write(when)}"
            lines.append(f"{self.write(value)} & {condition}")
        return r"\begin{cases} " + r" \\ ".join(lines) + r" \end{cases}"

    def matrix(self, box: TextBox) -> str:
        lines, columns = r" \\ ".join(self.lines(box, "%s", " & ")), int(box.text)
        if columns <= 10:  # as many as the environment has
            return rf"\begin{{pmatrix}} {lines} \end{{pmatrix}}"
        return rf"\left( \begin{{array}}{{@{{}}{'c' * columns}@{{}}}} {lines} \end{{array}} \right)"


def _upright_letters(text: str) -> str:
    return rf"\mathrm{{{latex_text(text)}}}"


def _index_text(text: str) -> str:
    first, comma, body = text.partition(",")
    return f"{first},{_upright_letters(body)}" if comma else first if first.isdigit() else _upright_letters(first)


# -- MathML -----------------------------------------------------------------------------------------------------

_SIGNS = {"-": "−", "<=": "≤", ">=": "≥", "!=": "≠", "and": "∧", "or": "∨", "not": "¬", "*": "·"}
_AROUND = {"sqrt": "<msqrt>%s</msqrt>", "abs": "<mrow><mo>|</mo>%s<mo>|</mo></mrow>"}
#: Brackets of one line, and tall ones, which the page's style draws as borders: fonts without them for mathematics
#: have none that grow.
_BRACKET, _TALL = "<mrow><mo>(</mo>%s<mo>)</mo></mrow>", '<mrow class="tall">%s</mrow>'


def _brackets_around(inside: str) -> str:
    return (_TALL if "<mfrac" in inside or "<mtable" in inside else _BRACKET) % inside


class _Mathml(_Notation):
    forms: ClassVar = {
        "over": "<mfrac>%s%s</mfrac>",
        "power": "<msup>%s%s</msup>",
    }

    def dot(self, box: TextBox) -> str:
        """Write a rate: the dot is above the letter, its index beside both."""
        (base,) = box.parts
        if base.kind != "name":
            return f"<mover>{self.part(base)}<mo>˙</mo></mover>"
        return self._indexed(base, f"<mover>{self._letter(base)}<mo>˙</mo></mover>")

    def part(self, box: TextBox) -> str:
        """Write the box as one element."""
        text = self.write(box)
        several = box.kind in ("row", "call") or (box.kind == "number" and "e" in box.text)
        return f"<mrow>{text}</mrow>" if several else text

    def name(self, box: TextBox) -> str:
        return self._indexed(box, self._letter(box))

    def _letter(self, box: TextBox) -> str:
        return f"<mi>{escape(GREEK[box.text][1] if box.text in GREEK else box.text)}</mi>"

    def _indexed(self, box: TextBox, base: str) -> str:
        return f"<msub>{base}<mtext>{escape(box.index)}</mtext></msub>" if box.index else base

    def number(self, box: TextBox) -> str:
        mantissa, exponent, ten = box.text.partition("e")
        text = f"<mn>{mantissa}</mn>"
        return f"{text}<mo>·</mo><msup><mn>10</mn><mn>{int(ten)}</mn></msup>" if exponent else text

    def sign(self, box: TextBox) -> str:
        return f"<mo>{escape(_SIGNS.get(box.text, box.text))}</mo>"

    def row(self, box: TextBox) -> str:
        """Write parts with thin space between factors, which browsers do not add."""
        return _side_by_side_text(box, self.write, '<mspace width="0.17em"/>')

    def bracket(self, box: TextBox) -> str:
        return _brackets_around(self.join_parts(box))

    def call(self, box: TextBox) -> str:
        inside = self.join_parts(box, "<mo>,</mo>")
        if box.text in _AROUND:
            return _AROUND[box.text] % inside
        return f"<mi>{escape(box.text)}</mi><mo>&#8289;</mo>" + (
            inside if needs_no_bracket(box) else _brackets_around(inside)
        )

    def cases(self, box: TextBox) -> str:
        lines = []
        for value, when in _pairs_of_cases(box):
            condition = "<mi>otherwise</mi>" if when is None else f"<mtext>if </mtext>{self.write(when)}"
            lines.append(f"<mtr><mtd>{self.write(value)}</mtd><mtd>{condition}</mtd></mtr>")
        return f'<mtable class="cases">{"".join(lines)}</mtable>'

    def matrix(self, box: TextBox) -> str:
        lines = self.lines(box, "<mtr><mtd>%s</mtd></mtr>", "</mtd><mtd>")
        return f'<mtable class="tall">{"".join(lines)}</mtable>'


# -- text -------------------------------------------------------------------------------------------------------


class _Python(_Notation):
    """Text that Python and SymPy read, where names are whole."""

    forms: ClassVar = {"power": "%s**%s"}

    def part(self, box: TextBox) -> str:
        """Write an operand of a division or a power."""
        return f"({self.write(box)})" if box.kind in ("row", "over", "power") else self.write(box)

    def name(self, box: TextBox) -> str:
        return box.text

    number = name

    def sign(self, box: TextBox) -> str:
        return {"*": "*", "and": " & ", "or": " | ", "not": "~"}.get(box.text, f" {box.text} ")

    def row(self, box: TextBox) -> str:
        if len(box.parts) == 3 and box.parts[1].text == "!=":  # which Python decides for two expressions of SymPy
            return f"Ne({self.write(box.parts[0])}, {self.write(box.parts[2])})"
        text = _side_by_side_text(box, self.write, "*")
        return f"-{text[3:]}" if text.startswith(" - ") else text

    def bracket(self, box: TextBox) -> str:
        return f"({self.join_parts(box)})"

    def over(self, box: TextBox) -> str:
        above, below = box.parts
        return f"{self.write(above)}/{self.part(below)}"

    def call(self, box: TextBox) -> str:
        if box.text == "defined":  # nan differs from itself
            return f"Eq({self.join_parts(box)}, {self.join_parts(box)})"
        return f"{box.index or box.text}({self.join_parts(box)})"

    def cases(self, box: TextBox) -> str:
        pairs = (
            f"({self.write(value)}, {'True' if when is None else self.write(when)})"
            for value, when in _pairs_of_cases(box)
        )
        return f"Piecewise({', '.join(pairs)})"

    def matrix(self, box: TextBox) -> str:
        return f"[{', '.join(self.lines(box, '[%s]', ', '))}]"


class _Plain(_Python):
    """Text for people, as laws have it."""

    forms: ClassVar = {"over": "%s/%s", "power": "%s^%s"}

    def name(self, box: TextBox) -> str:
        return f"{box.text}_{box.index}" if box.index else box.text

    def sign(self, box: TextBox) -> str:
        return box.text

    def row(self, box: TextBox) -> str:
        return self.join_parts(box, " ")

    def dot(self, box: TextBox) -> str:
        return f"{self.join_parts(box)}'"


def _side_by_side_text(box: TextBox, write: Callable[[TextBox], str], between: str) -> str:
    """Return the text of parts side by side, with a separator between those that are no signs."""
    texts = [write(part) for part in box.parts]
    for i, (before, part) in enumerate(pairwise(box.parts)):
        if "sign" not in (before.kind, part.kind):
            texts[i] += between
    return "".join(texts)


#: Write boxes as LaTeX; as MathML, for presentation, without the element ``math`` around it; as text.
latex, mathml, python, plain = _Latex().write, _Mathml().write, _Python().write, _Plain().write
