"""Quantities that a start holds at set values, by index."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from symgen.run.layout.model_arrays import velocity_of_coordinate

if TYPE_CHECKING:
    from symgen.run.layout.compiled import ModelInfo


@dataclass(frozen=True)
class Held:
    """Quantities that a start holds while all others may change.

    Attributes
    ----------
    coordinates : mapping of int to float
        Values by index in q, Euler parameters excepted. They are reached in small steps from the described start.
    velocities : mapping of int to float
        Values by index in v. They are not projected if they contradict other specified ones.
    fixed : tuple of int
        Velocities whose coordinates stay as described; for an orientation in space all three of a body.
    joints, rates : mapping of int to float
        Values of joint coordinates and of their rates, by index. Values are also reached in small steps.
    """

    coordinates: Mapping[int, float] = field(default_factory=dict)
    velocities: Mapping[int, float] = field(default_factory=dict)
    fixed: tuple[int, ...] = ()
    joints: Mapping[int, float] = field(default_factory=dict)
    rates: Mapping[int, float] = field(default_factory=dict)

    @property
    def targets(self) -> tuple[float, ...]:
        """Values of coordinates, of joint coordinates and of their rates."""
        return *self.coordinates.values(), *self.joints.values(), *self.rates.values()

    @property
    def pattern(self) -> tuple[tuple[int, ...], ...]:
        """What is held, without the values."""
        return *(tuple(x) for x in (self.coordinates, self.velocities, self.joints, self.rates)), self.fixed

    def positions(self, info: ModelInfo) -> str:
        """Return the held positions and their values, in words."""
        items = [*((info.coordinates[i], x) for i, x in self.coordinates.items())]
        items += [(info.joint_coordinates[k], x) for k, x in self.joints.items()]
        return ", ".join(f"{q.name} = {x:.6g} {q.unit}" for q, x in items)

    def speeds(self, info: ModelInfo) -> str:
        """Return the held velocities and their values, in words."""
        items = [(info.velocities[j].name, info.velocities[j].unit, x) for j, x in self.velocities.items()]
        joints = info.joint_coordinates
        items += [(f"{joints[k].name}.rate", f"{joints[k].unit}/s", x) for k, x in self.rates.items()]
        return ", ".join(f"{name} = {x:.6g} {unit}" for name, unit, x in items)

    def described_words(self, info: ModelInfo) -> str:
        """Return the coordinates and orientations that stay as described, in words."""
        bodies = {info.coordinates[first].name.rpartition(".")[0]: at for first, at in info.spins}
        euler = {i for first, _ in info.spins for i in range(first, first + 4)}
        places = [i for i in range(info.nq) if i not in euler and i not in self.coordinates]
        names = [info.coordinates[i].name for i in places if velocity_of_coordinate(i, info) in self.fixed]
        return ", ".join([*names, *(f"{body}.orientation" for body, at in bodies.items() if at in self.fixed)])
