"""Driver: a coordinate is prescribed as a function of time."""

from __future__ import annotations

import msgspec

from symgen.describe.fields import BodyName, Point, Text, TimeFunction
from symgen.describe.mechanism import Joint
from symgen.describe.names import quoted
from symgen.describe.scope import CENTRE, Scope
from symgen.errors import nearest
from symgen.vocabulary.expressions import ZERO
from symgen.vocabulary.measures import GROUND, X_AXIS, Y_AXIS, Angle, Component, Holonomic, Marker, Measure


class Driver(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A motor that makes a coordinate follow ``value(t)``: that of a joint, a body or a point.

    Parameters
    ----------
    joint : joint name
        The joint whose coordinate is driven (``angle`` of a revolute, ``displacement`` of a translational joint, ...).
    body : body name
        The body that is driven, instead of a joint.
    point : point
        The point of `body` that is driven; its centre of mass unless given.
    coordinate : str
        Of a body ``"x"``, ``"y"`` or ``"theta"``; of a joint the one it reports, unless it reports several.
    value : function of time
        What the coordinate shall be [m or rad], an expression of t and parameters with two derivatives.

    Notes
    -----
    One row. Multiplier ``NAME.driver`` [N or N m]: acts on the first body of the joint (on the ground for a driven
    body) along the coordinate, so the driven body receives its opposite.
    """

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
        bodies, measure = self._of_joint(scope) if self.joint is not None else self._of_body(scope)
        unit = "rad" if isinstance(measure, Angle) else "m"
        row = Holonomic("driver", measure, scope.of_time("value", self.value), unit)
        return Joint(name=scope.name, kind=scope.kind, bodies=bodies, rows=(row,))

    def _of_joint(self, scope: Scope) -> tuple[tuple[str, ...], Measure]:
        if self.point is not None:
            raise scope.error("point", "no such key, as a joint is driven", "a point")
        joint = scope.joint("joint", self.joint or "")
        known = dict(joint.coordinates)
        if not known:
            raise scope.error("joint", "a joint that has a coordinate", f"'{joint.name}', a {joint.kind} joint without")
        name = self.coordinate
        if name is None:
            if len(known) > 1:
                raise scope.error("coordinate", f"one of {', '.join(known)}", "no such key")
            name = next(iter(known))
        if name not in known:
            expected = f"a coordinate of joint '{joint.name}'"
            raise scope.error("coordinate", expected, quoted(name), nearest(name, known))
        return joint.bodies, known[name]

    def _of_body(self, scope: Scope) -> tuple[tuple[str, ...], Measure]:
        body = scope.body("body", self.body or "", ground=False)
        known = ("x", "y", "theta") if scope.turns(body) and self.point is None else ("x", "y")
        if self.coordinate not in known:
            got = "no such key" if self.coordinate is None else quoted(self.coordinate)
            raise scope.error("coordinate", " or ".join(f"'{name}'" for name in known), got)
        if self.coordinate == "theta":
            return (GROUND, body), Angle(GROUND, body)
        point = scope.marker("point", body, CENTRE if self.point is None else self.point)
        axis = X_AXIS if self.coordinate == "x" else Y_AXIS
        return (GROUND, body), Component(Marker(GROUND, (ZERO, ZERO)), point, axis)


KIND = Driver
