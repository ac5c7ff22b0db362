"""The tokens of a formula: every character and word that has a place in one; what has none is named."""

from __future__ import annotations

import keyword
import math
import re

from symgen.base.errors import quote
from symgen.describe.formulas.formula_slips import hint_on_sign, hint_on_units

_TOKEN = re.compile(
    r"""(?P<space>\s+)
      | (?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?![A-Za-z0-9_.]))
      | (?P<word>[A-Za-z][A-Za-z0-9_]*|(?<=\.)_[0-9]+)
      | (?P<operator>\*\*|<=|>=|[-+*/<>(),.](?!=))""",
    re.VERBOSE,
)
_WORDS = frozenset({"and", "or", "not", "if", "else"})


def slip_in_tokens(text: str) -> tuple[str, str] | None:
    """Return what has no place in a formula and a hint, None where everything has one."""
    position = 0
    while position < len(text):
        token = _TOKEN.match(text, position)
        if token is None:
            return _wrong_token(text, position)
        if token.group("number") and not math.isfinite(float(token.group())):
            return "a number beyond 1.8e308", ""
        word = token.group("word")
        if word and keyword.iskeyword(word) and word not in _WORDS:
            return f"the word '{word}' at column {position + 1}", ""
        position = token.end()
    return (f"'//' at column {text.index('//') + 1}", "a division is written /") if "//" in text else None


def _wrong_token(text: str, position: int) -> tuple[str, str]:
    sign = text[position]
    if sign in "0123456789.":
        wrong = re.split(r"[^A-Za-z0-9_.]", text[position:], maxsplit=1)[0]
        return f"{quote(wrong)}, which is not a number, at column {position + 1}", hint_on_units(text)
    return f"the character {quote(sign)} at column {position + 1}", hint_on_sign(sign, text)


def deepest_bracket(text: str) -> int:
    """Return how deep brackets are nested."""
    deepest = depth = 0
    for sign in text:
        depth += {"(": 1, ")": -1}.get(sign, 0)
        deepest = max(deepest, depth)
    return deepest
