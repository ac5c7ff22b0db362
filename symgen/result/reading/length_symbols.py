"""Lengths that are numbers in a file, as symbols: a paper wants l_1 where a file has 0.075."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

#: Keys whose numbers are lengths, by section; directions, angles and masses are left.
_KEYS = {
    "bodies": ("points", "centre_of_mass"),
    "joints": ("at", "length", "radius", "radii", "offset", "pitch", "centre", "on"),
    "forces": ("at", "free_length"),
}
_AXES, _WHEELS = ("x", "y", "z"), ("first", "second", "third")


def put_length_symbols(raw: Mapping[str, Any]) -> dict[str, Any]:
    """Return a description in which each length that is a number is a parameter ``l_1``, ``l_2``, ... of its value.

    A symbol belongs to the place of its number, in the order of the file, and says so in its note: two
    lengths that happen to have one value have two symbols. Only a point of a body that several joints or forces write
    with the same coordinates is one point. Zeros stay zeros, and a negative number is the symbol of its magnitude with
    a sign. The equations derived from it are those of the file with names in place of numbers.

    Parameters
    ----------
    raw : mapping
        The tables of a file, not yet validated.
    """
    parameters = raw.get("parameters", {})
    if not isinstance(parameters, Mapping):
        return dict(raw)  # errors are reported where the file is read
    symbols = _Symbols(parameters)
    description = dict(raw)
    for section, keys in _KEYS.items():
        tables = raw.get(section)
        if isinstance(tables, Mapping):
            description[section] = {
                name: symbols.rewrite_table(table, keys, f"{section}.{name}") if isinstance(table, Mapping) else table
                for name, table in tables.items()
            }
    if symbols.added:
        description["parameters"] = {**parameters, **symbols.added}
    return description


class _Symbols:
    """The symbols so far: parameters as a file has them."""

    def __init__(self, taken: Mapping[str, Any]) -> None:
        self.taken = taken
        self.added: dict[str, dict[str, Any]] = {}
        self._points: dict[tuple[str, tuple[float, ...]], Any] = {}

    def rewrite_table(self, table: Mapping[str, Any], keys: tuple[str, ...], place: str) -> dict[str, Any]:
        """Return a body, joint or force with symbols."""
        changed = dict(table)
        for key in keys:
            angle = key == "offset" and "ratio" in table  # of a gear
            if key in table and not angle:
                where = f"{place}.{key}"
                changed[key] = (
                    self._rewrite_points(table, where) if key == "at" else self._rewrite_value(table[key], where)
                )
        return changed

    def _rewrite_points(self, table: Mapping[str, Any], place: str) -> Any:
        """Return one point, or one for each of two bodies."""
        at, bodies = table["at"], table.get("between")
        if not isinstance(bodies, list) or not isinstance(at, list):
            return self._rewrite_point(at, table.get("body"), place)
        return [
            self._rewrite_point(part, body, f"{place}.{body}") for part, body in zip(at, bodies, strict=False)
        ] + at[2:]

    def _rewrite_point(self, point: object, body: object, place: str) -> Any:
        if not isinstance(point, list) or not all(map(_is_number, point)) or not isinstance(body, str):
            return self._rewrite_value(point, place)
        key = body, tuple(map(float, point))
        if key not in self._points:
            self._points[key] = self._rewrite_value(point, place)
        return self._points[key]

    def _rewrite_value(self, value: Any, place: str) -> Any:
        if isinstance(value, Mapping):
            return {key: self._rewrite_value(part, f"{place}.{key}") for key, part in value.items()}
        if isinstance(value, list):
            names = _WHEELS if place.endswith(".radii") else _AXES
            return [
                self._rewrite_value(part, f"{place}.{name}") for part, name in zip(value, names, strict=False)
            ] + value[3:]
        if not _is_number(value) or value == 0:
            return value
        number = len(self.added) + 1
        # `l1` and `l_1` are typeset alike
        while f"l_{number}" in self.taken or f"l{number}" in self.taken or f"l_{number}" in self.added:
            number += 1
        self.added[f"l_{number}"] = {"value": abs(float(value)), "unit": "m", "note": place}
        return f"l_{number}" if value > 0 else f"-l_{number}"


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
