"""Rope: a thread over sheaves, which keeps its length or stretches; in space through eyelets too."""

from __future__ import annotations

from typing import ClassVar, Literal

import msgspec

from symgen.base.vocabulary.expressions import (
    ZERO,
    Expr,
    call,
    literal_of,
)
from symgen.base.vocabulary.measures import GROUND, FormulaMeasure, Holonomic
from symgen.describe.joints._giving import force_of_pull, refuse_damping
from symgen.describe.joints._paired import Paired
from symgen.describe.joints._stops_of_rope import Stop
from symgen.describe.joints._way_of_rope import Way, way_of_rope
from symgen.describe.mechanism import Force, Joint
from symgen.describe.parts.fields import Axis, BodyName, Flag, Point, Scalar
from symgen.describe.parts.passing_ropes import RopeSheave
from symgen.describe.parts.scope import CENTRE, Scope
from symgen.describe.parts.triads import make_triad


class Sheave(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A sheave on the way of a rope, or an eyelet: a point through which it glides.

    Parameters
    ----------
    body : body name
        The body that carries it; the ground by default.
    at : point
        Its centre.
    radius : scalar
        [m], above 0; without it there is an eyelet.
    turn : {"left", "right"}
        Of a sheave, which way the rope turns round it, from the first end on; in space as seen against the axis.
    axis : direction
        Of a sheave in space, in the frame of the body. Its length does not matter.
    wound : bool
        Of a sheave, whether the rope is on it at the start: true for one that turns by more than half a turn although
        its straight way would pass by. By default it is unless the straight way passes by.
    """

    at: Point
    radius: Scalar | None = None
    turn: Literal["left", "right"] | None = None
    axis: Axis | None = None
    body: BodyName = GROUND
    wound: Flag | None = None


class Rope(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A rope between points of two bodies over sheaves, on which it glides freely.

    Parameters
    ----------
    between : pair of body names
        The bodies at its ends.
    at : pair of points
        The ends.
    over : list of tables
        The sheaves on its way, each ``{ body, at, radius, turn }``, in space with an `axis`; the rope turns round each
        by less than a turn at the start. It leaves a sheave whose arc has come to 0, passes by, and touches it again
        from the same side. In space what is before and after a sheave starts in its plane. Without `radius` there is an
        eyelet.
    length : scalar
        Length [m]; that of the way as the bodies are described to start by default.
    stiffness : scalar
        Of a rope that stretches, tension over stretch [N/m], above 0: it may go slack. Without it the rope keeps its
        length, and would push where its tension is below 0.
    damping : scalar
        Beside it, tension over the rate of the stretch [N s/m]; 0 by default. It adds or takes at most what the
        stiffness gives, so that the rope never pushes.

    Notes
    -----
    One row. Multiplier ``NAME.tension`` [N]. With `stiffness` there is a force in its place, which reports
    ``NAME.length`` [m] and ``NAME.force`` [N], below 0 where it pulls, as springs do; the joint then reports
    ``NAME.stretch`` [m], below 0 where the rope is slack. The state ``NAME.onK`` is 1 while the rope is on the sheave
    that is number K in `over`, else 0; the events ``NAME.leavesK`` and ``NAME.comesK`` change it.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    over: tuple[Sheave, ...] = ()
    length: Scalar | None = None
    stiffness: Scalar | None = None
    damping: Scalar | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the sum of straight parts and arcs."""
        refuse_damping(scope, self.stiffness, self.damping)
        bodies, way, length = self._way(scope)
        if self.stiffness is None:
            return Joint(scope.name, scope.kind, bodies, (Holonomic("tension", FormulaMeasure(way.length), length),))
        stretch = FormulaMeasure(call("sub", way.length, length))
        return Joint(scope.name, scope.kind, bodies, (), (("stretch", stretch),))

    def give(self, scope: Scope) -> Force | None:
        """Return the force in place of the row, None where there is a row."""
        if self.stiffness is None:
            return None
        bodies, way, length = self._way(scope)
        return force_of_pull(scope, bodies, "force", FormulaMeasure(way.length), length, self.stiffness, self.damping)

    def sheaves(self, scope: Scope) -> tuple[RopeSheave, ...]:
        """Return the sheaves that the rope may leave."""
        return self._way(scope)[1].sheaves

    def _way(self, scope: Scope) -> tuple[tuple[str, ...], Way, Expr]:
        """Return the bodies, the way, and the length of the rope."""
        (a, b), ends = self.ends(scope, turns=(False, False))
        stops = [Stop("at[0]", ends[0], ZERO), *(_stop(scope, i, x) for i, x in enumerate(self.over))]
        stops.append(Stop("at[1]", ends[1], ZERO))
        way = way_of_rope(scope, stops)
        length: Expr = literal_of(way.start)
        if self.length is not None:
            length = scope.constant("length", self.length, positive=True)
        carried = (stop.centre.body for stop in stops[1:-1] if stop.centre.body != GROUND)
        return tuple(dict.fromkeys((a, b, *carried))), way, length


def _stop(scope: Scope, i: int, sheave: Sheave) -> Stop:
    """Return a sheave, or an eyelet."""
    key = f"over[{i}]"
    axial = (("axis", sheave.axis),) if scope.spatial else ()
    if sheave.wound is not None and sheave.radius is None:
        raise scope.error(f"{key}.wound", "no such key without a radius", "one", "an eyelet holds the rope for good")
    if sheave.axis is not None and not scope.spatial:
        raise scope.error(f"{key}.axis", "no such key in the plane", "a direction")
    body = scope.body(f"{key}.body", sheave.body, turns=sheave.axis is not None)
    centre = scope.marker(f"{key}.at", body, CENTRE if sheave.at == CENTRE else sheave.at)
    for name, value in (("turn", sheave.turn), *axial):
        if (value is None) != (sheave.radius is None):
            expected, got = "the key of a sheave with a radius", "no such key"
            if value is not None:
                expected, got = "no such key without a radius", "one"
            raise scope.error(f"{key}.{name}", expected, got, "an eyelet has neither radius nor turn nor axis")
    if sheave.radius is None:
        return Stop(key, centre, ZERO)
    radius = scope.constant(f"{key}.radius", sheave.radius, positive=True)
    signed = radius if sheave.turn == "left" else call("neg", radius)
    triad = None if sheave.axis is None else make_triad(scope, body, sheave.axis, keys=(f"{key}.axis", ""))
    return Stop(key, centre, signed, triad, sheave.wound)


KIND = Rope
