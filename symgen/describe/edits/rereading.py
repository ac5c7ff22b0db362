"""A text in which only numbers differ from one that was read: it is read by these numbers, without another parser."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from itertools import accumulate
from typing import Any, NamedTuple

from symgen.describe.edits.new_numbers import put_at_path, value_at_path
from symgen.describe.files.load import parse_toml
from symgen.describe.files.places import DocumentOutline, Header, Mention, Path, outline_of_document

#: Numbers as most people write them; others are read by the parser.
_NUMBER = re.compile(r"[+-]?(?:0|[1-9][0-9]*+)(?:\.[0-9]++)?(?:[eE][+-]?[0-9]++)?+")
#: Characters of a number that is read here.
_LONGEST = 100


class WrittenNumber(NamedTuple):
    """A number of a text.

    Attributes
    ----------
    path : Path
        What it is.
    start, end : int
        Its characters, counted from 0.
    """

    path: Path
    start: int
    end: int


class ReadText(NamedTuple):
    """A text with what it says.

    Attributes
    ----------
    text : str
        The text.
    raw : dict
        Its tables.
    outline : DocumentOutline
        Its parts by characters.
    numbers : tuple of WrittenNumber
        In the order of the text.
    kind : object
        One for all texts that were read by their numbers alone: their tables differ in nothing else.
    """

    text: str
    raw: dict[str, Any]
    outline: DocumentOutline
    numbers: tuple[WrittenNumber, ...]
    kind: object

    def changed_numbers(self, before: ReadText) -> dict[Path, float]:
        """Return the numbers that are others than in a text of the same kind, by their paths."""
        return {
            new.path: float(value_at_path(self.raw, new.path))
            for new, old in zip(self.numbers, before.numbers, strict=True)
            if self.text[new.start : new.end] != before.text[old.start : old.end]
        }


def read_text_after(before: ReadText | None, text: str, source: str) -> ReadText:
    """Return a text as it is read, after another one, in which most of it may stand.

    Raises
    ------
    InputError
        If it is no TOML, or exceeds the bounds of a mechanism.
    """
    again = None if before is None else _read_by_numbers(before, text)
    if again is not None:
        return again
    raw = parse_toml(text, source)
    outline = outline_of_document(text)
    spans = sorted((start, end, path) for path, (start, end) in outline.values.items() if _is_number(text[start:end]))
    return ReadText(text, raw, outline, tuple(WrittenNumber(path, start, end) for start, end, path in spans), object())


def _is_number(text: str) -> bool:
    return len(text) <= _LONGEST and _NUMBER.fullmatch(text) is not None


def _read_by_numbers(before: ReadText, text: str) -> ReadText | None:
    """Return a text by its numbers; None where anything else differs."""
    old, numbers, raw, at, done = before.text, list[WrittenNumber](), before.raw, 0, 0
    ends, shifts = list[int](), list[int]()  # where numbers of another length end, and by how much
    for path, start, end in before.numbers:
        between = old[done:start]
        if not text.startswith(between, at):
            return None
        at += len(between)
        found = _NUMBER.match(text, at)
        if found is None or found.end() - at > _LONGEST:
            return None
        word = found[0]
        if word != old[start:end]:
            raw = put_at_path(raw, path, float(word) if set(word) & set(".eE") else int(word))
            ends.append(end)
            shifts.append(len(word) - (end - start))
        numbers.append(WrittenNumber(path, at, found.end()))
        at, done = found.end(), end
    if text[at:] != old[done:]:
        return None
    return ReadText(text, raw, _shift_outline(before.outline, ends, shifts), tuple(numbers), before.kind)


def _shift_outline(outline: DocumentOutline, ends: list[int], shifts: list[int]) -> DocumentOutline:
    """Return the outline of a text in which numbers that ended at some places have other lengths."""
    if not any(shifts):
        return outline
    by = list(accumulate(shifts, initial=0))

    def moved(place: int) -> int:
        return place + by[bisect_right(ends, place)]

    def moved_parts(parts: tuple[Any, ...], kind: type[Header] | type[Mention]) -> Iterator[Any]:
        for path, start, end in parts:
            yield kind(path, moved(start), moved(end))

    return DocumentOutline(
        {path: (moved(start), moved(end)) for path, (start, end) in outline.values.items()},
        tuple(moved_parts(outline.headers, Header)),
        tuple(moved_parts(outline.mentions, Mention)),
    )
