"""A mechanism in other units of length, mass and time: file text to file text, exactly where factors are powers of two.

Numbers are multiplied by the factor of their key's dimension. A formula keeps its text: names of time, coordinates and
velocities in it are divided by their factors, and the formula is multiplied by that of what it gives. Parameters with a
unit are multiplied by its factor, and divided by it again in formulas; a formula that is but such a name stays one.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from benchmarks.mechanisms.toml import text as written

#: Powers of length, mass and time.
Dimension = tuple[int, int, int]

NONE: Dimension = (0, 0, 0)
LENGTH, MASS, TIME = (1, 0, 0), (0, 1, 0), (0, 0, 1)
SPEED, TURNING, INERTIA = (1, 0, -1), (0, 0, -1), (2, 1, 0)
FORCE, TORQUE = (1, 1, -2), (2, 1, -2)
#: Letters of units -> dimension.
_LETTERS = {"m": LENGTH, "kg": MASS, "s": TIME, "N": FORCE, "J": TORQUE, "W": (2, 1, -3), "rad": NONE, "1": NONE}


@dataclass(frozen=True)
class Units:
    """Factors by which numbers of length, mass and time are multiplied."""

    length: float = 1.0
    mass: float = 1.0
    time: float = 1.0

    def factor(self, dimension: Dimension) -> float:
        """Return the factor of a dimension."""
        return self.length ** dimension[0] * self.mass ** dimension[1] * self.time ** dimension[2]


def dimension_of(unit: str) -> Dimension | None:
    """Return the dimension of a unit such as ``"N s/m"`` or ``"kg m^2"``; None where it cannot be read."""
    total, sign = [0, 0, 0], 1
    for part in re.findall(r"/|\(|\)|[A-Za-z0-9^*]+", unit):
        if part == "/":
            sign = -1
        elif part not in ("(", ")", "*"):
            letters, _, power = part.partition("^")
            dimensions = _LETTERS.get(letters)
            if dimensions is None or (power and not power.lstrip("-").isdigit()):
                return None
            for k in range(3):
                total[k] += sign * dimensions[k] * int(power or 1)
    return (total[0], total[1], total[2]) if unit.strip() else None


class Rescaler:
    """One file being written in other units.

    Parameters
    ----------
    raw : mapping
        Its tables.
    units : Units
        The factors.
    """

    def __init__(self, raw: Mapping[str, Any], units: Units) -> None:
        self.raw, self.units = raw, units
        self.parameters = {
            name: dimension_of(str(entry.get("unit", ""))) if isinstance(entry, Mapping) else None
            for name, entry in raw.get("parameters", {}).items()
        }

    def scaled(self, value: Any, dimension: Dimension, words: Mapping[str, Dimension] | None = None) -> Any:
        """Return a number, a formula or a list of them in the other units."""
        if isinstance(value, list):
            return [self.scaled(item, dimension, words) for item in value]
        factor = self.units.factor(dimension)
        if not isinstance(value, str):
            return value if factor == 1.0 else float(value) * factor
        if self.parameters.get(value.strip()) == dimension:
            return value
        return _times(self._formula(value, words or {}), factor)

    def _formula(self, text: str, words: Mapping[str, Dimension]) -> str:
        """Return a formula whose names are brought back to the old units."""

        def replaced(match: re.Match[str]) -> str:
            name = match.group()
            dimension = self._name(name, words)
            return name if dimension is None else _times(name, 1.0 / self.units.factor(dimension))

        return re.sub(r"(?<![\w.])[A-Za-z]\w*(\.\w+)?(?!\w|\s*\()", replaced, text)

    def _name(self, name: str, words: Mapping[str, Dimension]) -> Dimension | None:
        body, _, label = name.partition(".")
        if label:
            if label in ("x", "y", "z"):
                return LENGTH
            return SPEED if label in ("vx", "vy", "vz") else TURNING if label in ("omega", "wx", "wy", "wz") else None
        return words.get(body, self.parameters.get(body))

    def point(self, value: Any) -> Any:
        """Return a point, which may be a name, in the other units."""
        return value if isinstance(value, str) else self.scaled(value, LENGTH)

    def points(self, table: Mapping[str, Any]) -> Any:
        """Return the points that a joint or force is at: one of each of its bodies, or one."""
        at = table["at"]
        return [self.point(one) for one in at] if "between" in table else self.point(at)

    # -- sections ------------------------------------------------------------------------------------------------------

    def file(self) -> dict[str, Any]:
        """Return the tables of the file in the other units."""
        changed: dict[str, Any] = dict(self.raw)
        head = dict(self.raw["mechanism"])
        if "gravity" in head:
            head["gravity"] = self.scaled(head["gravity"], (1, 0, -2))
        changed["mechanism"] = head
        run = {"until": 10.0, "step": 1e-3, **self.raw.get("run", {})}  # what holds where a file says nothing
        changed["run"] = {key: self.scaled(value, TIME) for key, value in run.items()}
        if "parameters" in self.raw:
            changed["parameters"] = {n: self._parameter(n, e) for n, e in self.raw["parameters"].items()}
        changed["bodies"] = {name: self._body(table) for name, table in self.raw["bodies"].items()}
        for section, change in (("joints", self._joint), ("forces", self._force)):
            if section in self.raw:
                changed[section] = {name: change(table) for name, table in self.raw[section].items()}
        return changed

    def _parameter(self, name: str, entry: Any) -> Any:
        dimension = self.parameters[name]
        if dimension is None:
            return entry
        return {**entry, "value": self.scaled(entry["value"], dimension)}

    def _body(self, table: Mapping[str, Any]) -> dict[str, Any]:
        dimensions = {"mass": MASS, "inertia": INERTIA, "velocity": SPEED, "angular_velocity": TURNING}
        changed = dict(table)
        for key, value in table.items():
            if key in dimensions:
                changed[key] = self.scaled(value, dimensions[key])
            elif key in ("position", "centre_of_mass", "inertia_at"):
                changed[key] = self.point(value)
            elif key == "points":
                changed[key] = {label: self.scaled(point, LENGTH) for label, point in value.items()}
        return changed

    def coordinate(self, joint: str | None, label: str | None) -> Dimension:
        """Return the dimension of a coordinate that a joint reports."""
        if label is None:
            kind = self.raw["joints"][joint]["type"] if joint else ""
            slides = kind in ("translational", "prismatic", "rolling", "pin-in-slot", "point-on-line")
            return LENGTH if slides else NONE
        return LENGTH if label.startswith("displacement") or label in ("x", "y", "z") else NONE

    def _joint(self, table: Mapping[str, Any]) -> dict[str, Any]:
        changed = dict(table)
        if "at" in table:
            changed["at"] = self.points(table)
        for key in ("on", "centre", "point"):
            if key in table:
                changed[key] = self.point(table[key])
        for key in ("length", "radius", "radii", "pitch"):
            if key in table:
                changed[key] = self.scaled(table[key], LENGTH)
        if table["type"] == "driver":
            dimension = self.coordinate(table.get("joint"), table.get("coordinate"))
            changed["value"] = self.scaled(table["value"], dimension, {"t": TIME})
        elif "ratio" in table:
            joints, labels = table.get("joints", (None, None)), table.get("coordinates", (None, None))
            (a, b) = (self.coordinate(j, label) for j, label in zip(joints, labels, strict=True))
            changed["ratio"] = self.scaled(table["ratio"], (a[0] - b[0], 0, 0))
            changed["offset"] = self.scaled(table.get("offset", 0.0), a)
        elif table["type"] == "coupling":
            changed |= self._coupling(table)
        elif table["type"] == "rows":
            changed["rows"] = [{"position": self.scaled(row["position"], LENGTH)} for row in table["rows"]]
        elif "offset" in table:
            changed["offset"] = self.scaled(table["offset"], LENGTH)
        return changed

    def _coupling(self, table: Mapping[str, Any]) -> dict[str, Any]:
        """Return the numbers of a coupling: its row has the dimension of its first coordinate."""
        powers = [self.coordinate(*text.split("."))[0] for text in (*table["terms"], table.get("of", "a.angle"))]
        whole, of = powers[0], powers[-1]
        terms = zip(table["terms"].items(), powers, strict=False)
        changed: dict[str, Any] = {
            "terms": {text: self.scaled(factor, (whole - n, 0, 0)) for (text, factor), n in terms}
        }
        changed["value"] = self.scaled(table["value"], (whole, 0, 0))
        if "of" in table:
            powers_of = enumerate(table["polynomial"])
            changed["polynomial"] = [self.scaled(c, (whole - k * of, 0, 0)) for k, c in powers_of]
        return changed

    def _force(self, table: Mapping[str, Any]) -> dict[str, Any]:
        changed = {key: self._force_key(table["type"], key, value) for key, value in table.items() if key != "at"}
        return {**changed, "at": self.points(table)} if "at" in table else changed

    def _force_key(self, kind: str, key: str, value: Any) -> Any:
        if kind == "bushing":
            return self._six(value, 1 if key == "damping" else 0) if key in ("stiffness", "damping") else value
        along = {"spring-damper": "length", "torsional-spring-damper": "angle", "torque": "angle", "force": ""}[kind]
        line = along == "length"
        effort = FORCE if kind in ("force", "spring-damper") else TORQUE
        words = {"t": TIME, "length": LENGTH, "rate": SPEED if line else TURNING}
        if key in ("force", "torque", "actuator"):
            return self.scaled(value, effort, words)
        if key == "potential":
            return self.scaled(value, TORQUE, {"length": LENGTH, "x": LENGTH, "y": LENGTH, "z": LENGTH})
        if key in ("stiffness", "damping"):
            time = -2 if key == "stiffness" else -1
            return self.scaled(value, (0 if line else 2, 1, time))
        return self.scaled(value, LENGTH) if key == "free_length" else value

    def _six(self, value: Any, time: int) -> Any:
        def entry(i: int, j: int, x: Any) -> Any:
            return self.scaled(x, ((i > 2) + (j > 2), 1, time - 2))

        if isinstance(value[0], list):
            return [[entry(i, j, x) for j, x in enumerate(row)] for i, row in enumerate(value)]
        return [entry(i, i, x) for i, x in enumerate(value)]


def _times(text: str, factor: float) -> str:
    return text if factor == 1.0 else f"(({text})*{factor!r})"


def rescaled(text: str, units: Units) -> str:
    """Return the text of a mechanism file in other units."""
    return written(Rescaler(tomllib.loads(text), units).file())


def back(units: Units, unit: str) -> Callable[[Any], Any]:
    """Return what takes numbers of a unit, as results name it, back to the old units."""
    dimension = dimension_of(unit) or NONE
    return lambda values: values / units.factor(dimension)
