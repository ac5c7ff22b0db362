"""Other numbers in the text of a file: comments, order and all else stay as they are."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any

from symgen.base.units import known_unit, read_amount, unit_of
from symgen.describe.edits.text_changes import Change, apply_changes
from symgen.describe.files.builder import to_toml
from symgen.describe.files.places import Path, outline_of_document


def text_with_numbers(text: str | None, raw: Mapping[str, Any], values: Mapping[Path, float]) -> str:
    """Return the text of a file with other numbers, each in the unit that it has there.

    Parameters
    ----------
    text : str, optional
        The text; without one, or where it says something else than the description by now, a new one is written.
    raw : mapping
        The description.
    values : mapping of tuple to float
        Numbers in SI units by the keys that lead to them; ``("parameters", NAME)`` is the value of a parameter.
    """
    numbers = dict[Path, float | str]()
    for path, value in values.items():
        entry = value_at_path(raw, path)
        if isinstance(entry, Mapping):
            numbers[(*path, "value")] = _number_as_written(entry["value"], value, str(entry.get("unit", "")))
        else:
            numbers[path] = _number_as_written(entry, value, "")
    if text is None or tomllib.loads(text) != raw:
        result: Any = raw
        for path, number in numbers.items():
            result = put_at_path(result, path, number)
        return to_toml(result)
    outline, changes = outline_of_document(text), list[Change]()
    for path, number in numbers.items():
        written = f'"{number}"' if isinstance(number, str) else repr(number)
        changes.append(Change(*outline.values[path], written))
    return apply_changes(text, changes)


def put_at_path(value: Any, path: Path, new: object) -> Any:
    """Return a copy of tables and lists on a path, with another end of it."""
    if not path:
        return new
    copied: Any = dict(value) if isinstance(value, Mapping) else list(value)
    copied[path[0]] = put_at_path(value[path[0]], path[1:], new)
    return copied


def value_at_path(raw: Any, path: Path) -> Any:
    """Return the value at the end of a path through tables and lists."""
    for part in path:
        raw = raw[part]
    return raw


def _number_as_written(before: object, value: float, unit: str) -> float | str:
    """Return a number as the one before it: a text with its unit stays one, else it is in the unit of its entry."""
    amount = read_amount(before) if isinstance(before, str) else None
    if amount is not None and amount.unit:
        return f"{float(unit_of(amount.unit, 'design').from_si(value))!r} {amount.unit}"
    return float(known_unit(unit).from_si(value))
