"""Numbers that a start keeps, and their places in its state."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from symgen.describe.parts.holds import ORIENTATION
from symgen.run.layout.model_arrays import velocity_of_coordinate
from symgen.run.starts.held import Held

if TYPE_CHECKING:
    from symgen.describe.formulas.start import Scalars
    from symgen.describe.mechanism import Hold
    from symgen.run.layout.compiled import ModelInfo


class Indices(NamedTuple):
    """Indices of what a start may hold, by name; the velocity of an orientation is its first one."""

    coordinates: dict[str, int]
    velocities: dict[str, int]
    joints: dict[str, int]
    spins: dict[str, int]


def indices_of(info: ModelInfo) -> Indices:
    """Return the indices of what starts of a model may hold."""
    kinds = info.coordinates, info.velocities, info.joint_coordinates
    coordinates, velocities, joints = ({quantity.name: i for i, quantity in enumerate(kind)} for kind in kinds)
    spins = {f"{info.coordinates[first].name.rpartition('.')[0]}.{ORIENTATION}": at for first, at in info.spins}
    return Indices(coordinates, velocities, joints, spins)


def held_quantities(
    info: ModelInfo,
    holds: Sequence[Hold],
    numbers: Scalars,
    v: Sequence[float | None],
    indices: Indices | None = None,
) -> Held:
    """Return the held quantities by index.

    Parameters
    ----------
    info : ModelInfo
        The model.
    holds : sequence of Hold
        From `symgen.describe.parts.holds.read_holds`.
    numbers : Scalars
        Values of the names in formulas.
    v : sequence of float or None
        Given velocities.
    indices : Indices, optional
        Those of the model, for many calls.
    """
    coordinates, velocities, joints, spins = indices or indices_of(info)
    values, speeds, places, rates = dict[int, float](), dict[int, float](), dict[int, float](), dict[int, float]()
    fixed = list[int]()
    for hold in holds:
        name, value = hold.name, None if hold.value is None else numbers.value(hold.value, f"start '{hold.name}'")
        if name in coordinates and value is None:
            fixed.append(velocity_of_coordinate(coordinates[name], info))
        elif name in coordinates:
            values[coordinates[name]] = float(value or 0.0)
        elif name in velocities:
            speed = v[velocities[name]] if value is None else value
            speeds[velocities[name]] = float(speed or 0.0)
        elif name in spins:
            fixed += range(spins[name], spins[name] + 3)
        elif "." in name:  # states of a file have names without a dot, and nothing holds them
            of, rate = name.removesuffix(".rate"), name.endswith(".rate")
            (rates if rate else places)[joints[of]] = float(value or 0.0)
    return Held(values, speeds, tuple(fixed), places, rates)
