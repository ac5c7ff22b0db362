"""A curve through bodies: cubic pieces that go on smoothly, as one formula of the way along it.

Piece k leads from station k to station k + 1, with the shape functions of a beam (Hermite's): places and tangents of
the stations determine it, so place and tangent go on from piece to piece. Each shape function is a table of the number
of pieces passed, which is 0 beyond the two pieces beside its station; the first and the last ones go on in straight
lines. An event ends steps where the piece changes and the curvature jumps (`symgen.describe.parts.passing_ropes`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from symgen.base.vocabulary.expressions import ZERO, Call, Expr, Reading, call, literal_of, product, sum_of_terms
from symgen.base.vocabulary.measures import GROUND, Component, Direction, Marker
from symgen.describe.mechanism import Vec
from symgen.describe.table_functions import PLACE_SHAPES, SLOPE_SHAPES

#: Weights of places for the slope at a station without a direction, by the place from it: at the start, inside, at the
#: end. They are exact for parabolas.
_DIFFERENCES = {"first": {0: -1.5, 1: 2.0, 2: -0.5}, "inner": {-1: -0.5, 1: 0.5}, "last": {-2: 0.5, -1: -2.0, 0: 1.5}}
_OF_TWO = {"first": {0: -1.0, 1: 1.0}, "last": {-1: -1.0, 0: 1.0}}


class Station(NamedTuple):
    """A point of a curve and, of a body that turns, the curve's direction there."""

    point: Marker
    along: Direction | None


def curve_formula(stations: Sequence[Station], step: Expr, passed: Expr, axis: Direction) -> Expr:
    """Return a coordinate of the place on a curve, in the frame of the ground.

    Parameters
    ----------
    stations : sequence of Station
        Two or more; all have a direction, or none has.
    step : Expr
        Way from one to the next [m].
    passed : Expr
        The way from the first one in steps.
    axis : Direction
        Of the coordinate.
    """
    weights: list[list[Expr]] = [[] for _ in stations]
    terms, last = list[Expr](), len(stations) - 1
    for i, station in enumerate(stations):
        where = {0: "first", last: "last"}.get(i, "inner")
        from_here = passed if i == 0 else call("sub", passed, literal_of(i))
        place, slope = (Call(tables[where].function, (from_here,)) for tables in (PLACE_SHAPES, SLOPE_SHAPES))
        weights[i].append(place)
        if station.along is not None:
            weights[i].append(call("neg", slope))
            ahead = tuple(
                sum_of_terms(x, product(step, e))
                for x, e in zip(station.point.point, station.along.vector, strict=True)
            )
            terms.append(product(slope, _coordinate(Marker(station.point.body, ahead), f"ahead{i}", axis)))
            continue
        for k, weight in (_DIFFERENCES if last > 1 else _OF_TWO)[where].items():
            weights[i + k].append(product(literal_of(weight), slope))
    return sum_of_terms(
        *(
            product(sum_of_terms(*own), _coordinate(station.point, f"station{i}", axis))
            for i, (station, own) in enumerate(zip(stations, weights, strict=True))
        ),
        *terms,
    )


def _coordinate(point: Marker, name: str, axis: Direction) -> Expr:
    """Return a coordinate of a point in the frame of the ground, whose axis is one of its own."""
    k = next(i for i, e in enumerate(axis.vector) if e != ZERO)
    if point.body == GROUND:
        return point.point[k]
    origin: Vec = (ZERO,) * len(point.point)
    return Reading(f"{name}.{'xyz'[k]}", Component(Marker(GROUND, origin), point, axis))
