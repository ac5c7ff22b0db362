"""What a linkage is to do: three positions of a body, or points that one of its points passes in their order."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symgen.base.arguments import kind_of_value
from symgen.base.csv_tables import numbers_in_unit, read_csv_table, split_heading
from symgen.base.errors import InputError, quote, suggest

Array = NDArray[np.float64]

#: Points of a path, at least and at most.
FEWEST, MOST = 3, 20
#: Points, and positions, are at least so far apart, in parts of the size of the task.
APART = 1e-6
_UNITS = {"x": "m", "y": "m", "angle": "rad"}


@dataclass(frozen=True)
class SynthesisTask:
    """Positions of a body, or points of a path.

    Attributes
    ----------
    places : Array, shape (n, 2)
        Places of the point [m].
    angles : Array, shape (3,), or None
        Angles of the body [rad]; None for a path.
    """

    places: Array
    angles: Array | None

    @property
    def is_closed(self) -> bool:
        """Whether it is a path that ends where it begins."""
        return self.angles is None and bool(np.linalg.norm(self.places[-1] - self.places[0]) < APART * self.size)

    @property
    def size(self) -> float:
        """The larger side of the box about all places [m]."""
        return float(np.ptp(self.places, axis=0).max())

    def room(self, factor: float) -> tuple[Array, Array]:
        """Return the lowest and the highest place of pins: so many sizes about the middle of the task [m]."""
        middle = 0.5 * (self.places.min(axis=0) + self.places.max(axis=0))
        return middle - factor * self.size, middle + factor * self.size


def read_task(source: object) -> SynthesisTask:
    """Return the task of a table with the columns x and y, and angle where they are positions.

    Parameters
    ----------
    source : str, Path or mapping
        A CSV file, or columns by their headings, such as ``x`` or ``angle [deg]``; without units SI.

    Raises
    ------
    InputError
        If a column is missing or none of these, or the places are too few, too many, or in one place.
    """
    columns = dict(_columns(source))
    where = _whence(source)
    for name in columns:
        if name not in _UNITS:
            raise InputError(where, "the columns x and y, and angle for positions", quote(name), suggest(name, _UNITS))
    if "x" not in columns or "y" not in columns:
        raise InputError(where, "the columns x and y, and angle for positions", ", ".join(columns) or "none")
    sizes = {len(values) for values in columns.values()}
    if len(sizes) > 1:
        raise InputError(where, "columns of one length", f"{min(sizes)} and {max(sizes)} numbers")
    if not all(np.isfinite(values).all() for values in columns.values()):
        raise InputError(where, "finite numbers", "others")
    task = SynthesisTask(np.column_stack([columns["x"], columns["y"]]), columns.get("angle"))
    _check(where, task)
    return task


def _check(where: str, task: SynthesisTask) -> None:
    """Refuse places that no linkage can be found for."""
    count = len(task.places)
    if task.angles is not None and count != 3:
        raise InputError(where, "three positions, or a path without angles", f"{count} positions")
    if not FEWEST <= count <= MOST:
        raise InputError(where, f"{FEWEST} to {MOST} points", str(count))
    if task.size <= 0.0:
        raise InputError(where, "places that differ", "one place", "a pin turns a body about a place")
    steps = np.linalg.norm(np.diff(task.places, axis=0), axis=1) / task.size
    if task.angles is not None:
        steps = np.hypot(steps, np.abs(np.exp(1j * np.diff(task.angles)) - 1.0))
    if steps.min() < APART:
        k = int(np.argmin(steps))
        raise InputError(where, "places that differ from row to row", f"rows {k + 1} and {k + 2} in one place")


def _columns(source: object) -> Iterator[tuple[str, Array]]:
    """Yield names and numbers in SI units."""
    if isinstance(source, str | Path):
        if Path(source).suffix.lower() in (".toml", ".json"):
            raise InputError(
                str(source), "a CSV file with the columns x and y, and angle for positions", "another file"
            )
        table = read_csv_table(str(source), Path(source))
        for k, name in enumerate(table.names):
            yield name, np.array(table.numbers_in_unit(k, _UNITS[name]) if name in _UNITS else [])
    elif isinstance(source, Mapping):
        for heading, values in source.items():
            name, unit = split_heading(str(heading))
            try:
                numbers = np.asarray(values, dtype=np.float64).reshape(-1).tolist()
            except (TypeError, ValueError):
                raise InputError(f"synthesize: {name}", "numbers", kind_of_value(values)) from None
            yield name, np.array(numbers_in_unit(f"synthesize: {name}", numbers, unit, _UNITS.get(name, "")))
    else:
        raise InputError("synthesize: task", "a CSV file, or columns x, y and angle", kind_of_value(source))


def _whence(source: object) -> str:
    return str(source) if isinstance(source, str | Path) else "synthesize: task"
