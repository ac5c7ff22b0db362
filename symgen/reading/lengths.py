"""Lengths that are numbers in a file, as symbols: a paper wants l_1 where a file has 0.075."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

#: Keys whose numbers are lengths, by section; directions, angles and masses are left.
_KEYS = {
    "bodies": ("points", "centre_of_mass"),
    "joints": ("at", "length", "radius", "radii", "offset", "centre", "on"),
    "forces": ("at", "free_length"),
}


def with_symbols(raw: Mapping[str, Any]) -> dict[str, Any]:
    """Return a description in which each length that is a number is a parameter ``l_1``, ``l_2``, ... of its value.

    Numbers of one magnitude have one symbol. The equations derived from it are those of the file with names in place
    of numbers.

    Parameters
    ----------
    raw : mapping
        The tables of a file, not yet validated.
    """
    known: dict[float, str] = {}
    parameters = raw.get("parameters", {})
    taken = set(parameters) if isinstance(parameters, Mapping) else set()

    def symbol(value: float) -> str:
        size = abs(float(value))
        if size not in known:
            number = len(known) + 1
            while f"l_{number}" in taken:
                number += 1
            known[size] = f"l_{number}"
            taken.add(known[size])
        return known[size] if value > 0 else f"-{known[size]}"

    def replaced(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {key: replaced(part) for key, part in value.items()}
        if isinstance(value, list):
            return [replaced(part) for part in value]
        is_length = isinstance(value, int | float) and not isinstance(value, bool) and value != 0
        return symbol(value) if is_length else value

    found = dict(raw)
    for section, keys in _KEYS.items():
        tables = raw.get(section)
        if isinstance(tables, Mapping):
            found[section] = {
                name: {key: replaced(value) if key in keys else value for key, value in table.items()}
                if isinstance(table, Mapping)
                else table
                for name, table in tables.items()
            }
    if known and isinstance(parameters, Mapping):
        found["parameters"] = {**parameters, **{n: {"value": size, "unit": "m"} for size, n in known.items()}}
    return found
