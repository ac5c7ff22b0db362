"""Named scalars with their units, and their numbers in a model."""

from __future__ import annotations

from typing import Any

import msgspec


class Quantity(msgspec.Struct, frozen=True):
    """A named scalar with its unit."""

    name: str
    unit: str


class Counted:
    """Base of classes with coordinates, velocities and constraint rows: their numbers."""

    __slots__ = ()

    coordinates: tuple[Quantity, ...]
    velocities: tuple[Quantity, ...]
    rows: tuple[Any, ...]

    @property
    def nq(self) -> int:
        """Number of coordinates."""
        return len(self.coordinates)

    @property
    def nv(self) -> int:
        """Number of velocities."""
        return len(self.velocities)

    @property
    def m(self) -> int:
        """Number of constraint rows."""
        return len(self.rows)
