"""Metadata of a model as arrays for compiled functions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from symgen.run.layout.compiled import ModelInfo

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


def entries_of(info: ModelInfo) -> tuple[Integers, Array]:
    """Return (row, column, slot or -1) of D's structural entries, flat, and the values of those without slot."""
    places = [(row, column, -1 if slot is None else slot) for row, column, _, slot in info.jacobian]
    constants = [constant or 0.0 for _, _, constant, _ in info.jacobian]
    return np.array(places, dtype=np.int64).ravel(), np.array(constants, dtype=np.float64)


def triplets_of_entries(info: ModelInfo, jacobian: Array) -> tuple[Integers, Integers, Array]:
    """Return rows, columns and values of D's structural entries, from the section ``jacobian`` of w."""
    entries, constants = entries_of(info)
    rows, columns, slots = entries.reshape(-1, 3).T
    return rows, columns, np.where(slots < 0, constants, jacobian[slots] if len(jacobian) else constants)


def marks_of_lengths(info: ModelInfo) -> Array:
    """Return 1 for coordinates that are lengths, else 0."""
    return np.array([quantity.unit == "m" for quantity in info.coordinates], dtype=np.float64)


def spins_of_bodies(info: ModelInfo) -> list[int]:
    """Return the body's first angular velocity for each angular velocity, -1 for others."""
    firsts = [j if quantity.unit == "rad/s" else -1 for j, quantity in enumerate(info.velocities)]
    for _, first in info.spins:
        firsts[first : first + 3] = [first] * 3
    return firsts


def joints_of_rows(info: ModelInfo) -> list[str]:
    """Return the joints with rows, in order of rows."""
    return list(dict.fromkeys(row.joint for row in info.rows))


def velocity_of_coordinate(coordinate: int, info: ModelInfo) -> int:
    """Return the index of the velocity of a coordinate other than an Euler parameter."""
    return coordinate - sum(1 for first, _ in info.spins if first < coordinate)
