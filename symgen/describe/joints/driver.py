"""Driver: a coordinate is prescribed as a function of time."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.base.errors import quote
from symgen.base.vocabulary.expressions import ZERO
from symgen.base.vocabulary.measures import GROUND, Angle, Component, Holonomic, Marker, Measure, axes
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import BodyName, Point, Text, TimeFunction
from symgen.describe.parts.scope import CENTRE, Scope


class Driver(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A motor that makes a coordinate of a joint, a body or a point follow ``value(t)``.

    Parameters
    ----------
    joint : joint name
        The joint whose coordinate is driven (``angle`` of a revolute, ``displacement`` of a translational joint, ...).
    body : body name
        The body that is driven, instead of a joint.
    point : point
        The point of `body` that is driven; its centre of mass by default.
    coordinate : str
        Of a body ``"x"``, ``"y"`` or ``"theta"``, in space ``"x"``, ``"y"`` or ``"z"``; of a joint the one it reports,
        unless it reports several.
    value : function of time
        What the coordinate shall be [m or rad], an expression of t and parameters with two derivatives.

    Notes
    -----
    One row. Multiplier ``NAME.driver`` [N or N m]: acts on the first body of the joint (on the ground for a driven
    body) along the coordinate, so the driven body receives its opposite.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    value: TimeFunction
    joint: Text | None = None
    body: BodyName | None = None
    point: Point | None = None
    coordinate: Text | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to one row on the driven coordinate."""
        if (self.joint is None) == (self.body is None):
            got = "neither" if self.joint is None else "both"
            raise scope.error("", "either the key joint or the key body", got)
        value = scope.of_time("value", self.value)  # first: the driven joint may be wrong, which is told there
        bodies, measure, unit = self._drive_joint(scope) if self.joint is not None else self._drive_body(scope)
        row = Holonomic("driver", measure, value, unit)
        return Joint(scope.name, scope.kind, bodies, (row,))

    def _drive_joint(self, scope: Scope) -> tuple[tuple[str, ...], Measure, str]:
        if self.point is not None:
            raise scope.error("point", "no such key, as a joint is driven", "a point")
        joint, label, measure = scope.joint_coordinate(self.joint or "", self.coordinate)
        return joint.bodies, measure, Joint.unit(label)

    def _drive_body(self, scope: Scope) -> tuple[tuple[str, ...], Measure, str]:
        body = scope.body("body", self.body or "", ground=False)
        coordinates = ("x", "y", "z") if scope.spatial else ("x", "y")
        if not scope.spatial and scope.turns(body) and self.point is None:
            coordinates = ("x", "y", "theta")
        if self.coordinate not in coordinates:
            got = "no such key" if self.coordinate is None else quote(self.coordinate)
            raise scope.error("coordinate", " or ".join(f"'{name}'" for name in coordinates), got)
        if self.coordinate == "theta":
            return (GROUND, body), Angle(GROUND, body), "rad"
        point = scope.marker("point", body, CENTRE if self.point is None else self.point)
        axis = axes(GROUND, scope.dimension)[coordinates.index(self.coordinate)]
        return (GROUND, body), Component(Marker(GROUND, (ZERO,) * scope.dimension), point, axis), "m"


KIND = Driver
