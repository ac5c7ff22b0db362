"""Aims and limits as people write them: ``peak(motor.effort)``, ``min(ram.y) <= -598 mm``, ``abs(mu) <= 0.75``."""

from __future__ import annotations

import re
from typing import NamedTuple

from symgen.analyses.search.sampled_motions import Taken
from symgen.base import arguments
from symgen.base.errors import InputError, quote, suggest
from symgen.base.units import Amount, read_amount

#: What an aim or a limit takes of a quantity over time.
WORDS = ("peak", "rms", "max", "min")
#: Other numbers of quantities over time, which sweeps know.
_OF_SWEEPS = ("mean", "range")
_CALL = re.compile(r"\s*([A-Za-z_]\w*)\s*\((.*)\)\s*", re.DOTALL)
_COMPARED = re.compile(r"(<=|>=|==|!=|<|>|=)")
#: The other way round.
_TURNED = {"<=": ">=", "<": ">", ">=": "<=", ">": "<"}


class WrittenLimit(NamedTuple):
    """A limit as it is written.

    Attributes
    ----------
    taken : Taken
        What is limited.
    side : str
        ``largest`` or ``smallest``.
    bound : Amount
        The number, with its unit if it has one.
    text : str
        The whole of it.
    """

    taken: Taken
    side: str
    bound: Amount
    text: str


def read_taken(where: str, text: str) -> Taken:
    """Return what a text takes of which quantity.

    Raises
    ------
    InputError
        If it is empty, or takes something else.
    """
    call = _CALL.fullmatch(text)
    if call is None or not _is_closed(call[2]):
        if not text.strip():
            raise InputError(where, "a quantity, such as peak(motor.effort)", quote(text))
        return Taken("", text.strip())
    word, inner = call[1], call[2].strip()
    if word in WORDS and not _has_comma(inner):
        return Taken(word, inner)
    if word in _OF_SWEEPS:
        raise InputError(where, f"{', '.join(WORDS[:-1])} or {WORDS[-1]} of a quantity", quote(word))
    return Taken("", text.strip())


def unknown_word(text: str) -> str:
    """Return the hint on a word that is near to one of `WORDS`, empty where a text begins otherwise."""
    call = _CALL.fullmatch(text)
    hint = "" if call is None else suggest(call[1], WORDS)
    return hint if hint.startswith("did you mean") else ""


def read_written_limits(where: str, text: object) -> list[WrittenLimit]:
    """Return the limits in a text: one, or the two of ``-0.75 <= mu <= 0.75``.

    Raises
    ------
    InputError
        If it is no comparison of a quantity with a number.
    """
    written = arguments.text(where, text)
    expected = "a quantity and a number, such as min(ram.y) <= -0.6 m or -0.75 <= mu <= 0.75"
    parts = [part.strip() for part in _COMPARED.split(written)]
    signs, sides = parts[1::2], parts[::2]
    if any(sign not in _TURNED for sign in signs):
        hint = "a number that is to be met has two limits, such as 0.499 <= Q <= 0.501"
        raise InputError(where, "<= or >=", quote(written), hint)
    if len(signs) not in (1, 2) or not all(sides):
        raise InputError(where, expected, quote(written))
    amounts = [read_amount(side) for side in sides]
    numbers = [i for i, amount in enumerate(amounts) if amount is not None]
    if numbers not in ([0], [1], [0, 2]) or len(signs) != len(numbers):
        raise InputError(where, expected, quote(written))
    at = 0 if numbers == [1] else 1
    taken, limits = read_taken(where, sides[at]), list[WrittenLimit]()
    for i in numbers:
        amount, sign = amounts[i], signs[-1] if i > at else _TURNED[signs[0]]
        assert amount is not None, "it is one of the numbers"
        limits.append(WrittenLimit(taken, "largest" if sign in ("<=", "<") else "smallest", amount, written.strip()))
    return limits


def _is_closed(inner: str) -> bool:
    """Whether the brackets of a text close one another, so that those around it belong together."""
    depth = 0
    for letter in inner:
        depth += (letter == "(") - (letter == ")")
        if depth < 0:
            return False
    return depth == 0


def _has_comma(inner: str) -> bool:
    """Whether a comma of a text is in no brackets."""
    depth = 0
    for letter in inner:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and depth == 0:
            return True
    return False
