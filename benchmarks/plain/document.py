"""A mechanism file as numbers: TOML read, parameters and constant formulas evaluated."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.plain.formulas import Lines, Tree, parsed, value
from benchmarks.plain.moving import Array
from benchmarks.plain.series import Number, plain


class Document:
    """A file with values for its parameters.

    Parameters
    ----------
    raw : mapping
        The tables of the file.
    parameters : mapping, optional
        Values in place of those of the file.

    Attributes
    ----------
    spatial : bool
        Whether the mechanism lives in space.
    dimension : int
        Number of components of a point.
    parameters, tables : dict
        Values and functions by name.
    """

    def __init__(self, raw: Mapping[str, Any], parameters: Mapping[str, float] | None = None) -> None:
        self.raw = raw
        self.spatial = raw["mechanism"].get("space", "planar") == "spatial"
        self.dimension = 3 if self.spatial else 2
        if any(table.get("interpolation", "linear") != "linear" for table in raw.get("tables", {}).values()):
            raise NotImplementedError("tables of smooth pieces")
        self.tables = {
            name: Lines(tuple(float(x) for x in table["x"]), tuple(float(y) for y in table["y"]))
            for name, table in raw.get("tables", {}).items()
        }
        self.parameters: dict[str, float] = {}
        for name, entry in raw.get("parameters", {}).items():
            content = entry["value"] if isinstance(entry, Mapping) else entry
            self.parameters[name] = self._number(content, {})
        self.parameters |= dict(parameters or {})
        self._values: Mapping[str, Number] = dict(self.parameters)

    @classmethod
    def read(cls, path: str | Path, parameters: Mapping[str, float] | None = None) -> Document:
        """Return the document of a file."""
        return cls(tomllib.loads(Path(path).read_text(encoding="utf-8")), parameters)

    def _number(self, entry: Any, names: Mapping[str, Number]) -> float:
        return plain(value(parsed(entry), names, self.tables)) if isinstance(entry, str) else float(entry)

    def number(self, entry: Any) -> float:
        """Return a number, or the value of a formula of parameters."""
        return self._number(entry, self._values)

    def array(self, entry: Any) -> Array:
        """Return numbers or formulas, nested as they are, as an array."""
        return np.array([self.array(x) if isinstance(x, list | tuple) else self.number(x) for x in entry])

    def vector(self, table: Mapping[str, Any], key: str) -> Array:
        """Return a vector of the file, 0 where there is none."""
        return self.array(table[key]) if key in table else np.zeros(self.dimension)

    def formula(self, entry: Any) -> Tree:
        """Return the tree of a number or a formula of time and state."""
        return parsed(entry) if isinstance(entry, str) else ("number", float(entry))

    @property
    def gravity(self) -> Array:
        """Gravitational acceleration [m/s^2]."""
        return self.vector(self.raw["mechanism"], "gravity")

    def section(self, name: str) -> Mapping[str, Mapping[str, Any]]:
        """Return the tables of a section."""
        section: Mapping[str, Mapping[str, Any]] = self.raw.get(name, {})
        return section
