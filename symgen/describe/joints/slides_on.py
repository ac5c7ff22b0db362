"""Slides on: a point of a body stays on a beam or a cable, and slides along it."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import msgspec

from symgen.base.errors import quote
from symgen.base.vocabulary.expressions import ZERO, Expr, Reading, call, literal_of
from symgen.base.vocabulary.measures import (
    GROUND,
    Component,
    Direction,
    FormulaMeasure,
    Holonomic,
    Marker,
    axes,
)
from symgen.base.vocabulary.rotations import IDENTITY
from symgen.describe.formulas.evaluate import scalar_values
from symgen.describe.joints._curve import Station, curve_formula
from symgen.describe.joints._space import rows_of_point_on_axis
from symgen.describe.joints._stops_of_rope import Stop, placed_stop
from symgen.describe.mechanism import AnyBody, Body, Joint, SpatialBody
from symgen.describe.parts.fields import Axis, BodyName, Point, Scalar, Text
from symgen.describe.parts.passing_ropes import CurveSlider
from symgen.describe.parts.scope import CENTRE, Scope
from symgen.describe.parts.triads import make_triad

#: Last word of the name of the body without mass whose place is the way along the curve.
SLIDER = "slider"


class StationTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A point of a curve.

    Parameters
    ----------
    body : body name
        Its body; the ground by default.
    at : point
        Its place on the body.
    axis : direction
        Of the curve there, in the frame of the body; without it the neighbours say it.
    """

    at: Point
    body: BodyName = GROUND
    axis: Axis | None = None


class SlidesOn(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A point of a body that slides along a beam or a cable: a trolley, a bead, a hook.

    Parameters
    ----------
    body : body name
        The body that slides.
    at : point
        Its point on the beam; the centre of mass by default.
    beam : beam name
        The beam or cable, without corners.
    along, step : list of tables, scalar
        In place of a beam, a smooth curve through points of bodies, ``{ body, at, axis }``, and the way from one to the
        next [m].

    Notes
    -----
    In the plane two rows, in space three. Multipliers ``NAME.x``, ``.y``, ``.z`` [N]: force on the body in ground axes.
    Reports ``NAME.displacement`` [m], the way along the unloaded beam from its start: the place of a point mass
    ``NAME.slider`` without mass on a line of the ground, whose rows are ``NAME.across`` or ``NAME.across1`` and
    ``.across2``. Ends of the beam are stops unless the joint has others.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    body: BodyName
    at: Point = CENTRE
    beam: Text | None = None
    along: tuple[StationTable, ...] | None = None
    step: Scalar | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the distance of the point from the place on the curve, along the axes of the ground."""
        body, point = self._point(scope)
        stations, step = self._curve(scope)
        _, way = self._way(scope)
        slider, start, along = way.b, way.a.point, way.along
        passed = call("div", Reading(f"{scope.name}.displacement", way), step)
        origin, rows = Marker(GROUND, (ZERO,) * scope.dimension), list[Holonomic]()
        for label, axis in zip("xyz", axes(GROUND, scope.dimension), strict=False):
            place = curve_formula(stations, step, passed, axis)
            own = Reading(f"{body}.{label}", Component(origin, point, axis))
            rows.append(Holonomic(label, FormulaMeasure(call("sub", place, own))))
        if scope.spatial:
            triad = make_triad(scope, GROUND, tuple(scope.value(e, "along") for e in along.vector))
            rows += rows_of_point_on_axis(Marker(GROUND, start), slider, triad)
        else:
            rows.append(Holonomic("across", Component(Marker(GROUND, start), slider, axes(GROUND, 2)[1])))
        others = dict.fromkeys(s.point.body for s in stations if s.point.body != GROUND)
        bodies = (body, *(name for name in others if name != body), slider.body)
        return Joint(scope.name, scope.kind, bodies, tuple(rows), (("displacement", way),))

    def _way(self, scope: Scope) -> tuple[Expr, Component]:
        """Return the length of a piece, and the way along the curve."""
        slider, (start, along) = Marker(f"{scope.name}.{SLIDER}", (ZERO,) * scope.dimension), self._line(scope)
        return self._curve(scope)[1], Component(Marker(GROUND, start), slider, along)

    def implied(self) -> Mapping[str, Any]:
        """Return the keys that a table has without naming them: stops at the ends."""
        if self.along is None:
            return {}
        count = len(self.along) - 1
        upper = count * self.step if isinstance(self.step, float | int) else f"{count}*({self.step})"
        return {"stop": {"lower": 0.0, "upper": upper}}

    def slider(self, scope: Scope) -> CurveSlider:
        """Return what the joint adds: a body without mass whose place is the way along the curve, and passages."""
        (step, way), stations = self._way(scope), len(self.along or ()) - 2
        passed = call("div", Reading(f"{scope.name}.displacement", way), step)
        return CurveSlider(scope.name, self._slider(scope), stations, passed)

    def _slider(self, scope: Scope) -> AnyBody:
        """Return the body without mass, nearest to the point at the start."""
        (start, along), (_, step) = self._line(scope), self._curve(scope)
        way = self._nearest_way(scope) * scope.value(step, "step")
        ends = zip(start, along.vector, strict=True)
        place = tuple(literal_of(scope.value(x, "along") + way * scope.value(e, "along")) for x, e in ends)
        name = f"{scope.name}.{SLIDER}"
        if scope.spatial:
            return SpatialBody(name, ZERO, position=place, orientation=IDENTITY)
        return Body(name, ZERO, position=place)

    def _point(self, scope: Scope) -> tuple[str, Marker]:
        body = scope.body("body", self.body, ground=False)
        return body, scope.marker("at", body, self.at)

    def _curve(self, scope: Scope) -> tuple[list[Station], Expr]:
        """Return the stations of the curve and the way from one to the next."""
        if self.along is None or self.step is None:
            got = "no such key" if self.beam is None else f"{quote(self.beam)}, which is none"
            raise scope.error("beam", "the name of a beam, or the keys along and step", got)
        if len(self.along) < 2:
            raise scope.error("along", "two points or more", str(len(self.along)))
        stations = list[Station]()
        for i, table in enumerate(self.along):
            key = f"along[{i}]"
            if (table.axis is None) != (self.along[0].axis is None):
                raise scope.error(f"{key}.axis", "a direction at all points or at none", "one of both")
            body = scope.body(f"{key}.body", table.body, turns=table.axis is not None)
            along = None if table.axis is None else scope.direction(f"{key}.axis", body, table.axis)
            stations.append(Station(scope.marker(f"{key}.at", body, table.at), along))
        return stations, scope.constant("step", self.step, positive=True)

    def _places(self, scope: Scope) -> list[tuple[float, ...]]:
        """Return the points of the curve as the bodies are described to start."""
        return [_place(scope, "along", station.point) for station in self._curve(scope)[0]]

    def _line(self, scope: Scope) -> tuple[tuple[Expr, ...], Direction]:
        """Return the line of the slider: along x of the ground, so that its rows fix velocities alone."""
        first, second, *_ = self._places(scope)
        if not math.dist(first, second) > 0.0:
            raise scope.error("along", "points apart from each other", "two at one place")
        n = scope.dimension
        return tuple(map(literal_of, first[:n])), axes(GROUND, n)[0]

    def _nearest_way(self, scope: Scope) -> float:
        """Return the way to the chord that is nearest to the point at the start, in steps."""
        point, places = _place(scope, "at", self._point(scope)[1]), self._places(scope)
        near = [_nearest(point, *ends) for ends in itertools.pairwise(places)]
        i = min(range(len(near)), key=lambda i: near[i][1])
        return i + near[i][0]


def _place(scope: Scope, key: str, point: Marker) -> tuple[float, ...]:
    """Return where a point is as the bodies are described to start."""
    return placed_stop(scope, scalar_values(scope.context.values), Stop(key, point, ZERO)).place


def _nearest(point: Sequence[float], a: Sequence[float], b: Sequence[float]) -> tuple[float, float]:
    """Return the part of a chord up to its nearest place to a point, and the distance."""
    along = [y - x for x, y in zip(a, b, strict=True)]
    square = math.fsum(e * e for e in along)
    part = math.fsum((p - x) * e for p, x, e in zip(point, a, along, strict=True)) / square if square else 0.0
    part = min(max(part, 0.0), 1.0)
    return part, math.dist(point, [x + part * e for x, e in zip(a, along, strict=True)])


KIND = SlidesOn
