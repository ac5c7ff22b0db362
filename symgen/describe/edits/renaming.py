"""Rename a part of a mechanism file wherever the file names it, or remove tables with what needs them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from symgen.base.errors import InputError, quote, suggest
from symgen.describe.bounds.keys import sections_of_files
from symgen.describe.edits.new_numbers import value_at_path
from symgen.describe.edits.snippet_tables import blocks_of_headers
from symgen.describe.edits.text_changes import Change, apply_changes
from symgen.describe.files.builder import toml_text
from symgen.describe.files.load import parse_toml
from symgen.describe.files.places import DocumentOutline, Path, outline_of_document
from symgen.describe.files.validate import collect_errors
from symgen.describe.formulas.identifiers import check_identifier

#: Keys whose texts are no formulas, in any table.
_WORDS = (
    *("between", "body", "reaction", "carrier", "clamp", "joint", "joints", "of", "pinion", "rack"),
    *("type", "unit", "note", "title", "source", "name", "coordinate", "hold", "label", "file", "colour"),
)
_NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w*")
#: Keys whose text, or texts in whose list, are names of bodies, and of joints.
_OF_BODIES = ("between", "body", "reaction", "carrier", "clamp")
_OF_JOINTS = ("joint", "joints", "of", "pinion", "rack")


def rename_in_text(text: str, path: str, name: str, source: str) -> str:
    """Return the text of a file in which something has another name, wherever the file names it.

    Parameters
    ----------
    text : str
        The text.
    path : str
        What gets another name, such as ``bodies.crank`` or ``bodies.crank.points.B``.
    name : str
        The new name.
    source : str
        The file, for messages.

    Raises
    ------
    InputError
        If there is nothing of that name, the new one is taken or no name, or the file would be wrong.
    """
    raw, parts = parse_toml(text, source), outline_of_document(text)
    where = _path_from_text(raw, path)
    check_identifier(name, f"{source}: {path}", "new")
    siblings = value_at_path(raw, where[:-1])
    if name in siblings and name != where[-1]:
        raise InputError(f"{source}: {path}", "a name that is free", quote(name))
    changes = {(m.start, m.end): name for m in parts.mentions if m.path == where}
    for span, value in _texts_to_change(raw, parts, where, name):
        changes[span] = value
    result = apply_changes(text, [Change(*span, value) for span, value in changes.items()])
    _refuse_new_problems(raw, parse_toml(result, source), source)
    return result


def remove_from_text(text: str, path: str, source: str) -> str:
    """Return the text of a file without a table, the joints and forces that need it, and parameters of these alone.

    Parameters
    ----------
    text : str
        The text.
    path : str
        What is taken out, such as ``bodies.crank``.
    source : str
        The file, for messages.

    Raises
    ------
    InputError
        If there is nothing of that name, or the file would be wrong: something else needs it.
    """
    raw, parts = parse_toml(text, source), outline_of_document(text)
    gone = [_path_from_text(raw, path)]
    for entry in gone:  # grows
        gone += [other for other in _users_of_removed(raw, entry) if other not in gone]
    gone += _parameters_of_removed(raw, parts, gone)
    if (
        not any(("bodies", body) not in gone for body in raw.get("bodies", {}))
        and ("mechanism", "title") in parts.values
    ):
        gone.append(("mechanism", "title"))  # it is about what was there
    spans = [span for entry in gone for span in _spans_of_table(entry, parts, text)]
    result = apply_changes(text, [Change(start, end, "") for start, end in _merge_spans(spans)])
    left = parse_toml(result, source)
    if left.get("bodies") or not raw.get("bodies"):  # with its last body gone, a file is where a drawing begins
        _refuse_new_problems(raw, left, source)
    return result


def _path_from_text(raw: Mapping[str, Any], path: str) -> Path:
    parts = path.split(".")
    value: Any = raw
    for part in parts:
        if not isinstance(value, Mapping) or part not in value:
            known = value if isinstance(value, Mapping) else ()
            raise InputError(path, "something that the file has", quote(part), suggest(part, known))
        value = value[part]
    if len(parts) not in (2, 4) or (len(parts) == 4 and parts[2] != "points") or parts[0] in ("mechanism", "run"):
        raise InputError(path, "an entry of a section, or a point of a body", "another key")
    return tuple(parts)


def _texts_to_change(
    raw: Mapping[str, Any], parts: DocumentOutline, where: Path, name: str
) -> Iterator[tuple[tuple[int, int], str]]:
    """Yield the characters inside texts and quoted keys that a new name changes, with what they become."""
    change = _changer_at_path(raw, where, name)
    for path, (start, end) in parts.values.items():
        value = value_at_path(raw, path)
        if isinstance(value, str) and (new := change(path, value)) != value:
            yield (start, end), toml_text(new)
    for mention in parts.mentions:
        key = str(mention.path[-1])
        if len(mention.path) > 2 and "." in key and (new := _formula_changer(where, name)(key)) != key:
            yield (mention.start, mention.end), toml_text(new)
        elif where[0] == "joints" and mention.path[-2:] == ("terms", where[1]):
            yield (mention.start, mention.end), name


def _formula_changer(where: Path, name: str) -> Callable[[str], str]:
    """Return what changes a formula: names before a dot, and parameters, which have no dot."""
    old = re.escape(str(where[-1]))
    if where[0] in ("bodies", "joints", "forces", "beams", *sections_of_files()) and len(where) == 2:
        pattern = re.compile(rf"(?<![\w.]){old}(?=\.)")
    elif len(where) == 4:
        pattern = re.compile(rf"(?<![\w.])({re.escape(str(where[1]))}\.){old}(?=\.)")
        return lambda text: pattern.sub(rf"\g<1>{name}", text)
    elif where[0] == "tables":
        pattern = re.compile(rf"(?<![\w.]){old}(?=\s*\()")
    else:
        pattern = re.compile(rf"(?<![\w.]){old}(?![\w.(])")
    return lambda text: pattern.sub(name, text)


def _changer_at_path(raw: Mapping[str, Any], where: Path, name: str) -> Callable[[Path, str], str]:
    """Return what changes the text at a path."""
    old, formula = str(where[-1]), _formula_changer(where, name)

    def change_text_at(path: Path, text: str) -> str:
        key = next((str(part) for part in reversed(path) if isinstance(part, str)), "")
        if where[0] == "bodies" and len(where) == 2 and key in _OF_BODIES:
            own = text == old or text.startswith(f"{old}.")  # an interface of a modal body
            return name + text[len(old) :] if own else text
        if where[0] == "joints" and key in _OF_JOINTS:
            return name + text[len(old) :] if text == old or text.startswith(f"{old}.") else text
        if where[0] == "outlines" and key == "outline":
            return name if text == old else text
        if key == "at" and isinstance(path[-1], int | str) and not _is_coordinate(path):
            return name if len(where) == 4 and text == old and _owner_of_point(raw, path) == where[1] else text
        if key in _WORDS or (key == "at" and not _is_coordinate(path)) or path[0] == "mechanism":
            return text
        return formula(text)

    return change_text_at


def _is_coordinate(path: Path) -> bool:
    """Whether a text in a list ``at`` is a coordinate and not the name of a point."""
    return len(path) >= 5 and isinstance(path[-1], int) and isinstance(path[-2], int)


def _owner_of_point(raw: Mapping[str, Any], path: Path) -> object:
    """Return the body of a point that a joint or force names."""
    entry = value_at_path(raw, path[:2])
    if isinstance(path[-1], int) and isinstance(entry.get("between"), list):
        return entry["between"][path[-1]] if path[-1] < len(entry["between"]) else None
    return entry.get("body")


def _users_of_removed(raw: Mapping[str, Any], gone: Path) -> Iterator[Path]:
    """Yield the joints and forces that cannot be without something."""
    if len(gone) != 2 or gone[0] not in ("bodies", "joints"):
        return
    keys = _OF_BODIES if gone[0] == "bodies" else _OF_JOINTS
    for section in ("joints", "forces"):
        for name, entry in raw.get(section, {}).items():
            named = [entry.get(key) for key in keys]
            named += list(entry.get("terms", ())) if gone[0] == "joints" else []
            owners = [x for value in named for x in (value if isinstance(value, list) else [value])]
            if any(x == gone[1] or (isinstance(x, str) and x.startswith(f"{gone[1]}.")) for x in owners):
                yield section, name


def _parameters_of_removed(raw: Mapping[str, Any], parts: DocumentOutline, gone: list[Path]) -> list[Path]:
    """Return the parameters that nothing reads any more once something is taken out which does."""
    read = dict[Path, set[str]]()
    for path in parts.values:
        value = value_at_path(raw, path)
        if isinstance(value, str) and path[-1] not in _WORDS:
            read[path] = set(_NAME.findall(value)) & raw.get("parameters", {}).keys()
    on_lines = {path for path in parts.values if len(path) == 2 and path[0] == "parameters"}
    if not any(header.path == ("parameters",) for header in parts.headers):
        return []
    found = list[Path]()
    while True:  # parameters read parameters
        lost, kept = set[str](), set[str]()
        for path, names in read.items():
            (lost if any(path[: len(entry)] == entry for entry in (*gone, *found)) else kept).update(names)
        more = [("parameters", name) for name in sorted(lost - kept)]
        more = [path for path in more if path in on_lines and path not in (*gone, *found)]
        if not more:
            return found
        found += more


def _spans_of_table(gone: Path, parts: DocumentOutline, text: str) -> list[tuple[int, int]]:
    """Return the characters of a table: of its headers' blocks with the comments above, else of its line."""
    found = []
    for header, (start, end) in zip(parts.headers, blocks_of_headers(parts, text), strict=True):
        if header.path[: len(gone)] == gone:
            found.append((_start_with_comments(text, start), _end_of_line(text, end)))
    if not found and gone in parts.values:
        mention = next(m for m in parts.mentions if m.path == gone)
        start = text.rfind("\n", 0, mention.start) + 1
        if text[start : mention.start].strip():
            raise InputError(".".join(map(str, gone)), "an entry on lines of its own", "one inside a table on one line")
        found.append((start, _end_of_line(text, parts.values[gone][1])))
    return found


def _start_with_comments(text: str, start: int) -> int:
    """Return where the comments right above a header begin; those at the top of a file stay."""
    at = start
    while at > 0:
        line = text.rfind("\n", 0, at - 1) + 1
        if not text[line:at].lstrip().startswith("#"):
            return at
        at = line
    return start


def _end_of_line(text: str, end: int) -> int:
    """Return the end of a line with one blank line after it."""
    at = text.find("\n", end)
    at = len(text) if at < 0 else at + 1
    following = text.find("\n", at)
    return following + 1 if following >= 0 and not text[at:following].strip() else at


def _merge_spans(spans: list[tuple[int, int]]) -> list[tuple[int, int]]:
    result = list[tuple[int, int]]()
    for start, end in sorted(spans):
        if result and start < result[-1][1]:
            result[-1] = (result[-1][0], max(end, result[-1][1]))
        else:
            result.append((start, end))
    return result


def _refuse_new_problems(before: Mapping[str, Any], after: Mapping[str, Any], source: str) -> None:
    """Refuse a change that makes something wrong.

    Raises
    ------
    InputError
        The first error, where there was none before.
    """
    if not collect_errors(before, source):
        for error in collect_errors(after, source):
            raise error
