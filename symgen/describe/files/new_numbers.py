"""Other numbers in a description and in the text of its file: comments, order and all else stay as they are."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any

from symgen.base.errors import InputError, quote
from symgen.base.units import known_unit, read_amount, unit_of
from symgen.describe.files.builder import to_toml
from symgen.describe.files.places import Path, outline_of_document
from symgen.describe.files.text_changes import Change, apply_changes
from symgen.describe.parts.own_units import entry_in_si


def with_numbers(raw: Mapping[str, Any], values: Mapping[Path, float]) -> dict[str, Any]:
    """Return a description with other numbers.

    Parameters
    ----------
    raw : mapping
        The description.
    values : mapping of tuple to float
        Numbers in SI units by the keys that lead to them; ``("parameters", NAME)`` is the value of a parameter.
    """
    result: Any = dict(raw)
    for path, value in values.items():
        new = entry_in_si(_value_at(raw, path), value) if path[0] in _WITH_UNITS else value
        result = put_at_path(result, path, new)
    whole: dict[str, Any] = result
    return whole


def text_with_numbers(text: str | None, raw: Mapping[str, Any], values: Mapping[Path, float]) -> str:
    """Return the text of a file with other numbers.

    Parameters
    ----------
    text : str, optional
        The text; without one, or where it says something else than the description by now, a new one is written.
    raw, values : mapping
        As for `with_numbers`.
    """
    if text is None or tomllib.loads(text) != raw:
        return to_toml(with_numbers(raw, values))
    outline, changes = outline_of_document(text), list[Change]()
    for path, value in values.items():
        entry, place = _value_at(raw, path), path
        if isinstance(entry, Mapping):
            place, entry, unit = (*path, "value"), entry["value"], str(entry.get("unit", ""))
        else:
            unit = ""
        if place not in outline.values:
            raise InputError("design", "a number that is written in the file", quote(".".join(map(str, path))))
        changes.append(Change(*outline.values[place], _written_number(entry, value, unit)))
    return apply_changes(text, changes)


#: Sections whose numbers may have units.
_WITH_UNITS = ("parameters",)


def put_at_path(value: Any, path: Path, new: object) -> Any:
    """Return a copy of tables and lists on a path, with another end of it."""
    if not path:
        return new
    copied: Any = dict(value) if isinstance(value, Mapping) else list(value)
    copied[path[0]] = put_at_path(value[path[0]], path[1:], new)
    return copied


def _value_at(raw: Any, path: Path) -> Any:
    for part in path:
        raw = raw[part]
    return raw


def _written_number(before: object, value: float, unit: str) -> str:
    """Return a number as it was written before: a text with its unit stays one, else it is in the unit of its entry."""
    amount = read_amount(before) if isinstance(before, str) else None
    if amount is not None and amount.unit:
        return f'"{float(unit_of(amount.unit, "design").from_si(value))!r} {amount.unit}"'
    return repr(float(known_unit(unit).from_si(value)))
