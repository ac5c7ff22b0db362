"""What formulas may read of a motion by dotted names: points of bodies, coordinates of joints, lengths of forces.

| written | is |
| --- | --- |
| ``arm.tip.x``, ``.y``, in space ``.z`` | a point's coordinate in the ground frame [m] |
| ``arm.tip.vx``, ``.vy``, ``.vz`` | its velocity [m/s] |
| ``arm.tip.ax``, ``.ay``, ``.az`` | its acceleration [m/s^2], where v' is known: in outputs |
| ``motor.angle``, ``slide.displacement``, ... | a coordinate that a joint reports, or a driver drives [rad, m] |
| ``motor.angle.rate`` | its rate; ``motor.rate`` where the joint has one coordinate |
| ``spring.length``, ``spring.angle``, ``spring.rate`` | of a force along one measure, once all forces are known |
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from symgen.describe.mechanism import Force, Joint
from symgen.vocabulary.expressions import ZERO, Expr, Reading
from symgen.vocabulary.measures import (
    GROUND,
    Angle,
    Bearing,
    Component,
    Distance,
    Holonomic,
    Marker,
    Measure,
    PointSpeed,
    Spin,
    Turn,
    axes,
)

if TYPE_CHECKING:
    from symgen.describe.scope import Model

#: What begins the names of a point's coordinates, by the order of the derivative.
_ORDERS = ("", "v", "a")
#: Orders that functions of state may use.
STATE = 1


def point_reading(name: str, marker: Marker, axis: str, order: int, dimension: int) -> Reading:
    """Return the reading of a point's coordinate along an axis of the ground, or of its derivative."""
    origin = Marker(GROUND, (ZERO,) * dimension)
    return Reading(name, Component(origin, marker, axes(GROUND, dimension)["xyz".index(axis)]), order)


def driven(joint: Joint) -> tuple[tuple[str, Measure], ...]:
    """Return the coordinates of a joint by label; of a driver the one that it drives."""
    if joint.coordinates or joint.kind != "driver":
        return joint.coordinates
    (row,) = joint.rows
    assert isinstance(row, Holonomic), "a driver has one row, on a coordinate"
    return (("angle" if row.unit == "rad" else "displacement", row.measure),)


def extent(force: Force) -> tuple[str, Measure] | None:
    """Return what the measure of a force along one measure is called, and the measure; None for other forces."""
    if len(force.efforts) != 1 or isinstance(force.efforts[0].measure, PointSpeed | Spin | Component):
        return None
    measure = force.efforts[0].measure
    word = "length" if isinstance(measure, Distance) else "angle" if isinstance(measure, Angle | Turn | Bearing) else ""
    return (word, measure) if word else None


class Readings:
    """The dotted names of a mechanism, looked up one by one: a file may have thousands of bodies.

    Parameters
    ----------
    model : Model
        What is known of the mechanism.
    order : int
        Largest derivative that may be read: 1 where v' is not known.
    """

    def __init__(self, model: Model, order: int = STATE) -> None:
        self._model, self._order = model, order
        self._dimension = 3 if model.space == "spatial" else 2

    def owners(self) -> Iterator[str]:
        """Yield the names of all bodies, joints and forces that have something to read."""
        yield from self._model.bodies
        yield from self._model.joint_names
        yield from self._model.forces

    def known(self, owner: str, where: str) -> tuple[str, ...]:
        """Return what can be read of a body, joint or force beside a body's own coordinates."""
        if owner in self._model.bodies:
            letters = [f"{order}{axis}" for order in _ORDERS[: self._order + 1] for axis in "xyz"[: self._dimension]]
            return tuple(f"{point}.{letter}" for point in self._model.points[owner] for letter in letters)
        measures = self._measures(owner, where)
        short = ("rate",) if len(measures) == 1 else ()
        return (*(name for label in measures for name in (label, f"{label}.rate")), *short)

    def find(self, path: tuple[str, ...], where: str) -> Expr | None:
        """Return what a dotted name means, None where it means nothing.

        Parameters
        ----------
        path : tuple of str
            The name, cut at its dots; the first part is an owner.
        where : str
            File and key, for messages about joints that are resolved on the way.
        """
        owner, *words = path
        name = ".".join(path)
        if owner in self._model.bodies:
            if len(words) != 2 or words[0] not in self._model.points[owner]:
                return None
            letter, axis = words[1][:-1], words[1][-1:]
            if letter not in _ORDERS[: self._order + 1] or axis not in tuple("xyz"[: self._dimension]):
                return None
            marker = Marker(owner, self._model.points[owner][words[0]])
            return point_reading(name, marker, axis, _ORDERS.index(letter), self._dimension)
        measures = self._measures(owner, where)
        if words == ["rate"] and len(measures) == 1:
            return Reading(name, next(iter(measures.values())), 1)
        order = 1 if len(words) == 2 and words[1] == "rate" else 0
        if len(words) != 1 + order or words[0] not in measures:
            return None
        return Reading(name, measures[words[0]], order)

    def _measures(self, owner: str, where: str) -> dict[str, Measure]:
        """Return the measures of a joint or force by label."""
        if owner in self._model.joint_names:
            return dict(driven(self._model.joint(owner, where)))
        found = extent(self._model.forces[owner]) if owner in self._model.forces else None
        return {} if found is None else dict([found])
