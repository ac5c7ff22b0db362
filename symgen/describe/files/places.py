"""Places of keys and values in the text of a TOML document, which `tomllib` does not give."""

from __future__ import annotations

import re
import tomllib
from bisect import bisect_right
from typing import NamedTuple

#: Keys of tables and indices of arrays that lead to a value of a document.
Path = tuple[str | int, ...]

_BLANK = re.compile(r"(?:[ \t\r\n]++|\#[^\n]*+)*+")
_PART = re.compile(r"""[ \t]*+("(?:[^"\\\n]++|\\.)*+"|'[^'\n]*+'|[A-Za-z0-9_-]++)[ \t]*+""")
# Digits that contain a space are a date with a time.
_SCALAR = re.compile(
    r"""\"{3}(?:[^"\\]++|\\.|"{1,2}+(?!"))*+"{3,5}+ | '{3}(?:[^']++|'{1,2}+(?!'))*+'{3,5}+
      | "(?:[^"\\\n]++|\\.)*+" | '[^'\n]*+'
      | \d{4}-\d\d-\d\d[ ]\d\d:[^\s,\]}\#]++ | [^\s,\]}\#]++""",
    re.VERBOSE | re.DOTALL,
)


class TextSpan(NamedTuple):
    """A part of one line or more.

    Attributes
    ----------
    line, column : int
        Where it begins, each counted from 1; columns are characters.
    length : int
        Its characters, line ends included.
    """

    line: int
    column: int
    length: int


class Place(NamedTuple):
    """Where a document has a table, an array or another value.

    Attributes
    ----------
    key : Span or None
        The key, of a table the part of the first header or dotted key that names it; None for an item of an array.
    value : Span or None
        The value; None for tables and arrays that headers and dotted keys make.
    """

    key: TextSpan | None
    value: TextSpan | None

    @property
    def line(self) -> int:
        """Line of the key, or of the value of an item."""
        return (self.key or self.value or TextSpan(1, 1, 0)).line


def places_in_document(text: str) -> dict[Path, Place]:
    """Return the place of every table, array and value of a document, by its path.

    Parameters
    ----------
    text : str
        A document that `tomllib` reads without an error.
    """
    return _Scanner(text).places


class Header(NamedTuple):
    """The header of a table, or of an item of an array of tables.

    Attributes
    ----------
    path : Path
        The table.
    start, end : int
        First character of its line, and the one after its last bracket, counted from 0.
    """

    path: Path
    start: int
    end: int


class Mention(NamedTuple):
    """A key that is written: of a table once in each header and dotted key that leads through it.

    Attributes
    ----------
    path : Path
        What it is the key of.
    start, end : int
        Its characters, counted from 0.
    """

    path: Path
    start: int
    end: int


class DocumentOutline(NamedTuple):
    """The parts of a document by characters, for changes of its text.

    Attributes
    ----------
    values : dict
        First character of each written value, and the one after it, by its path.
    headers : tuple of Header
        In the order of the text.
    mentions : tuple of Mention
        In the order of the text.
    """

    values: dict[Path, tuple[int, int]]
    headers: tuple[Header, ...]
    mentions: tuple[Mention, ...]


def outline_of_document(text: str) -> DocumentOutline:
    """Return the parts of a document by characters.

    Parameters
    ----------
    text : str
        A document that `tomllib` reads without an error.
    """
    scanned = _Scanner(text)
    return DocumentOutline(scanned.values, tuple(scanned.headers), tuple(scanned.mentions))


class _Scanner:
    """A document being scanned, from its first character to the last one."""

    def __init__(self, text: str) -> None:
        self.text, self.at = text, 0
        self.places: dict[Path, Place] = {}
        self._starts = [0, *(end.end() for end in re.finditer("\n", text))]
        self._items: dict[Path, int] = {}  # items so far of arrays whose items have headers
        self.values: dict[Path, tuple[int, int]] = {}
        self.headers: list[Header] = []
        self.mentions: list[Mention] = []
        table: Path = ()
        self.pass_blank()
        while self.at < len(text):
            if text[self.at] == "[":
                table = self.pass_header()
            else:
                self.pass_pair(table)
            self.pass_blank()

    def span_between(self, start: int, end: int) -> TextSpan:
        line = bisect_right(self._starts, start)
        return TextSpan(line, start - self._starts[line - 1] + 1, end - start)

    def pass_blank(self) -> None:
        """Pass white space, line ends and comments."""
        self.at = self.pass_pattern(_BLANK).end()

    def pass_pattern(self, pattern: re.Pattern[str]) -> re.Match[str]:
        match = pattern.match(self.text, self.at)
        assert match is not None, f"no TOML at character {self.at}"
        return match

    def pass_character(self, character: str) -> bool:
        """Return whether `character` is next, and pass it."""
        passed = self.text.startswith(character, self.at)
        self.at += passed
        return passed

    def pass_key(self, table: Path = ()) -> list[tuple[str, TextSpan]]:
        """Pass a key of `table`; return its parts."""
        parts = list[tuple[str, TextSpan]]()
        while not parts or self.pass_character("."):
            match = self.pass_pattern(_PART)
            part = match[1]
            self.at = match.end()
            if part[0] in "\"'":
                part = tomllib.loads(f"key = {part}")["key"]
            parts.append((part, self.span_between(*match.span(1))))
            self.mentions.append(Mention((*table, *(name for name, _ in parts)), *match.span(1)))
        return parts

    def pass_header(self) -> Path:
        """Pass the header of a table or of an item; return its path."""
        item, start = self.text.startswith("[[", self.at), self.text.rfind("\n", 0, self.at) + 1
        self.at += 2 if item else 1
        parts = self.pass_key()
        self.at += 2 if item else 1
        path: Path = ()
        for i, (part, span) in enumerate(parts):
            path = (*path, part)
            self.places.setdefault(path, Place(span, None))
            if item and i == len(parts) - 1:
                self._items[path] = self._items.get(path, 0) + 1
            if path in self._items:
                path = (*path, self._items[path] - 1)
                self.places.setdefault(path, Place(span, None))
        self.headers.append(Header(path, start, self.at))
        return path

    def pass_pair(self, table: Path) -> None:
        """Pass a key and its value in `table`."""
        path = table
        for part, span in (parts := self.pass_key(table)):
            path = (*path, part)
            self.places.setdefault(path, Place(span, None))
        self.at += 1  # the equals sign
        self.pass_value(path, parts[-1][1])

    def pass_value(self, path: Path, key: TextSpan | None) -> None:
        """Pass a value whose path is `path`."""
        self.pass_blank()
        start = self.at
        self.places[path] = Place(key, self.span_between(start, start))  # in front of what it contains
        if self.pass_character("["):
            self.pass_items(path)
        elif self.pass_character("{"):
            self.pass_inline_table(path)
        else:
            self.at = self.pass_pattern(_SCALAR).end()
        self.places[path] = Place(key, self.span_between(start, self.at))
        self.values[path] = (start, self.at)

    def pass_items(self, path: Path) -> None:
        """Pass the items of an array, and its bracket."""
        index = 0
        self.pass_blank()
        while not self.pass_character("]"):
            self.pass_value((*path, index), None)
            self.pass_separator()
            index += 1

    def pass_inline_table(self, path: Path) -> None:
        """Pass the pairs of an inline table, and its brace."""
        self.pass_blank()
        while not self.pass_character("}"):
            self.pass_pair(path)
            self.pass_separator()

    def pass_separator(self) -> None:
        self.pass_blank()
        self.pass_character(",")
        self.pass_blank()
