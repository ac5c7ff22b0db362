"""Everything that is wrong in the text of a mechanism file, each problem with its place."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from symgen.base.errors import InputError, sentence_of_parts
from symgen.describe.files.load import parse_toml, read_text
from symgen.describe.files.places import Path, Place, TextSpan, places_in_document
from symgen.describe.files.validate import collect_errors

_INDEX = re.compile(r"\[(\d+)\]")
_END = re.compile(r"[.\[]")
_AT = re.compile(r"\(at line (\d+), column (\d+)\)$")
#: Body or force that is a node or an element of a beam, whose table has the keys.
_PART_OF_BEAM = re.compile(r"(?:bodies|forces)\.(\w+)\.\w+(.*)")
_NOWHERE = Place(None, None)


class Problem(NamedTuple):
    """Something wrong in a file.

    Attributes
    ----------
    line : int
        Line of the key that is wrong, or of the nearest table around a key that is missing, or the last one where a
        section is missing; counted from 1, which the whole file has as well.
    where : str
        Path of the key, such as ``bodies.crank.mass``; empty for the whole file.
    expected, got, hint : str
        As in `InputError`.
    place : Place
        Place of the key, and of its value.
    """

    line: int
    where: str
    expected: str
    got: str
    hint: str
    place: Place

    @property
    def has_place(self) -> bool:
        """Whether it is about a part of the text, and not about the whole file."""
        return self.place != _NOWHERE

    def __str__(self) -> str:
        where = f"{self.where}: " if self.where else ""
        return f"{where}{sentence_of_parts(self.expected, self.got, self.hint)}"


def problems_of_text(text: str, source: str) -> tuple[Problem, ...]:
    """Return what is wrong in a mechanism file, in the order of its lines; nothing if it is valid.

    Of each table (a body, a joint, a parameter, an event) all keys that are wrong are reported, else the first formula
    that is, and nothing that only follows from a table that is wrong. Text that is no TOML has one problem.

    Parameters
    ----------
    text : str
        The text of the file.
    source : str
        The name of the file; meshes are sought beside a `Source`.
    """
    try:
        raw = parse_toml(text, source)
    except InputError as error:
        return (_problem_of_error(error, source, _place_of_syntax_error(error)),)
    found = places_in_document(text)
    end = Place(TextSpan(len(text.splitlines()) or 1, 1, 0), None)  # where a missing section would be written
    described = list[Problem]()
    for wrong in collect_errors(raw, source):
        place = _place_of_error(wrong, source, raw, found)
        if place == _NOWHERE and _path_in(wrong, source):
            place = end
        described.append(_problem_of_error(wrong, source, place))
    return tuple(sorted(described, key=lambda problem: problem.line))


def sentence_with_line(error: InputError) -> str:
    """Return the sentence of an error, with its line where it is about the text of a file."""
    sentence = str(error)
    if error.file is None or not sentence.startswith(source := error.file.name):
        return sentence
    try:
        text = read_text(error.file)
        raw = parse_toml(text, source)
        place = _place_of_error(error, source, raw, places_in_document(text))
    except InputError as slip:
        if str(slip) != sentence:  # the file was changed in the meantime
            return sentence
        place = _place_of_syntax_error(slip)
    return sentence if place == _NOWHERE else f"{source}:{place.line}{sentence.removeprefix(source)}"


def _problem_of_error(error: InputError, source: str, place: Place) -> Problem:
    return Problem(place.line, _path_in(error, source), error.expected, error.got, error.hint, place)


def _path_in(error: InputError, source: str) -> str:
    return "" if error.where == source else error.where.removeprefix(f"{source}: ")


def _place_of_syntax_error(error: InputError) -> Place:
    """Return the place of a syntax error of TOML; for other errors of the text none."""
    match = _AT.search(error.got)
    return _NOWHERE if match is None else Place(TextSpan(int(match[1]), int(match[2]), 0), None)


def _place_of_error(error: InputError, source: str, raw: Mapping[str, Any], found: Mapping[Path, Place]) -> Place:
    """Return the place of the innermost part of a file, with its content and its places, that an error leads to."""
    words = _path_in(error, source)
    part = _PART_OF_BEAM.match(words)
    if part is not None and part[1] in raw.get("beams", ()):
        words = f"beams.{part[1]}{part[2]}"
    path = _path_from_words(raw, words)
    if error.key and (*path, error.key) in found:
        path = (*path, error.key)
    return found.get(path, _NOWHERE)


def _path_from_words(value: object, words: str) -> Path:
    """Return the path of the innermost part of `value` that a path in words leads to; keys may contain dots."""
    path: Path = ()
    while words:
        if isinstance(value, Mapping):
            ends = (len(words), *(end.start() for end in reversed([*_END.finditer(words)])))
            key = next((words[:end] for end in ends if words[:end] in value), None)
            if key is None:
                break
            path, value, words = (*path, key), value[key], words[len(key) :].removeprefix(".")
        else:
            match = _INDEX.match(words)
            if match is None or not isinstance(value, list) or int(match[1]) >= len(value):
                break
            index = int(match[1])
            path, value, words = (*path, index), value[index], words[match.end() :].removeprefix(".")
    return path
