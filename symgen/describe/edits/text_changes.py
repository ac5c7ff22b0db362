"""Changes of the text of a mechanism file: what they do not touch stays as it is, byte for byte."""

from __future__ import annotations

import re
from collections.abc import Iterable
from difflib import SequenceMatcher
from typing import NamedTuple

from symgen.base.errors import InputError

#: A decimal number of TOML, as numbers of mechanisms are written.
_NUMBER = re.compile(r"[-+]?(?:[0-9](?:_?[0-9])*)(?:\.[0-9](?:_?[0-9])*)?(?:[eE][-+]?[0-9](?:_?[0-9])*)?")


class Change(NamedTuple):
    """A part of a text, and what it becomes.

    Attributes
    ----------
    start, end : int
        First character, and the one after the last, counted from 0; nothing is removed where they are equal.
    text : str
        The new text.
    """

    start: int
    end: int
    text: str


def apply_changes(text: str, changes: Iterable[Change]) -> str:
    """Return a text with changes, which must not overlap.

    Raises
    ------
    InputError
        If they do.
    """
    parts, at = list[str](), 0
    for change in sorted(changes):
        if change.start < at:
            raise InputError("changes", "changes of different parts of the text", f"two at character {change.start}")
        parts += [text[at : change.start], change.text]
        at = change.end
    return "".join(parts) + text[at:]


def is_decimal_number(text: str) -> bool:
    """Whether a value of a file is written as a decimal number."""
    return _NUMBER.fullmatch(text) is not None


def utf16_places(text: str) -> list[int] | None:
    """Return the place in UTF-16 of each character and of the end, as pages count; None where both are the same."""
    if not text or max(text) < "\U00010000":
        return None
    places, at = list[int](), 0
    for character in text:
        places.append(at)
        at += 1 + (character >= "\U00010000")
    return [*places, at]


def keep_line_ends(text: str, before: str) -> str:
    """Return a text with the line ends of the text before it.

    Pages know one line end. Where a file has two kinds, lines that stayed keep theirs, and others have that of the
    first line.

    Parameters
    ----------
    text : str
        The new text; its lines end with a line feed.
    before : str
        The text of the file, with the line ends that it has.
    """
    if "\r\n" not in before:
        return text
    if before.count("\r\n") == before.count("\n"):
        return text.replace("\n", "\r\n")
    old = re.findall(r"[^\n]*\n|[^\n]+\Z", before)
    new = re.findall(r"[^\n]*\n|[^\n]+\Z", text)
    plain = [line.replace("\r\n", "\n") for line in old]
    usual = "\r\n" if old[0].endswith("\r\n") else "\n"
    lines = [line.replace("\n", usual) for line in new]
    for a, b, size in SequenceMatcher(None, plain, new, autojunk=False).get_matching_blocks():
        lines[b : b + size] = old[a : a + size]
    return "".join(lines)
